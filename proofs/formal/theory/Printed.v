(* Claim H11 with the paper's numbers: s_0 = 0.449... if rounded, not if truncated. *)
From Coq Require Import Reals Psatz.
From Interval Require Import Specific_stdz Specific_ops.
From Interval Require Tactic.
From Oscillator Require Import Claims.
Module Integers := SpecificFloat StdZRadix2.  (* Coq's own integers: no axioms on machine numbers *)
Module Exact := Tactic.IntervalTactic Integers.
Import Tactic Exact.
Open Scope R_scope.

Lemma root_near r0 r1 : 0 < r0 < 1 -> 0 < r1 < 1 -> moran r0 r1 (449 / 1000) < 1 < moran r0 r1 (4485 / 10000) ->
  exists s, (forall t, moran r0 r1 t = 1 <-> t = s) /\
    449 / 1000 - 5 / 10000 <= s < 449 / 1000 + 5 / 10000 /\ ~ 449 / 1000 <= s < 450 / 1000.
Proof.
  intros R0 R1 S. destruct (moran_root r0 r1 (4485 / 10000) (449 / 1000)) as (s & B & U); try lra.
  exists s. split; [auto|lra].
Qed.

(* With the printed ratios 0.1905 and 0.2381, and with the reciprocals of the slopes 5.25 and 4.2. *)
Theorem printed_root : exists s, (forall t, moran (1905 / 10000) (2381 / 10000) t = 1 <-> t = s) /\
  449 / 1000 - 5 / 10000 <= s < 449 / 1000 + 5 / 10000 /\ ~ 449 / 1000 <= s < 450 / 1000.
Proof. apply root_near; try lra. unfold moran, Rpower. split; interval with (i_prec 40). Qed.

Theorem reciprocal_root : exists s, (forall t, moran (100 / 525) (10 / 42) t = 1 <-> t = s) /\
  449 / 1000 - 5 / 10000 <= s < 449 / 1000 + 5 / 10000 /\ ~ 449 / 1000 <= s < 450 / 1000.
Proof. apply root_near; try lra. unfold moran, Rpower. split; interval with (i_prec 40). Qed.
