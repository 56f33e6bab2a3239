"""The Coq text of lemmas, that `lemmas` fills in."""

HEAD = """(* Written by python -m proofs formal from the certificate with the digest
   {digest}.
   Not trusted: coqc proves every line. To be read: Impact.v, and the theorems stated here. *)
From Coq Require Import Reals ZArith Psatz Lia List.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Specific_stdz Specific_ops.
From Interval Require Tactic.
Module Integers := SpecificFloat StdZRadix2.
Module Exact := Tactic.IntervalTactic Integers.
Import Tactic Exact.
From Oscillator Require Import Impact Chaos Flight Shift Numbers March Corrected Flights Graph Cells
  Verdicts Consequences Lambda Claims.
Import ListNotations.
Open Scope R_scope.

Definition side := {side}.
Definition eta := {eta}.
Definition nu := {nu}.

Lemma eta_pos : 0 < eta. Proof. unfold eta; lra. Qed.
Notation gap := (Impact.gap side eta nu).
Notation gap_t := (Flight.gap_t side eta nu).
Notation gap_tt := (Flight.gap_tt side eta nu).
Notation slope := (Flight.slope side eta nu).
Notation impact_time := (Flight.impact_time side eta nu).
Notation rate := (Corrected.rate side eta nu).
Notation f := (Corrected.f side eta nu).
Notation first_impact := (Impact.first_impact side eta nu).
Notation next := (Impact.next side eta nu).
Notation slope_at := (Impact.slope_at side eta nu).
Lemma PI_near : 3141592653589793238462643383279 / 1000000000000000000000000000000 < PI
  < 3141592653589793238462643383280 / 1000000000000000000000000000000.
Proof. split; interval with (i_prec 120). Qed.
Ltac over E x := generalize (E x ltac:(lra)) PI_near; unfold lift; lra.
Ltac slopes r0 r1 b0 b1 := intros [|] x X; unfold In_ in X; exists (rate x);
  [split; [apply (slope_at_rate side eta nu _ _ b1); lra | generalize (r1 x X); lra] |
   split; [apply (slope_at_rate side eta nu _ _ b0); lra | generalize (r0 x X); lra]].
Ltac num := intros; unfold Impact.gap, Flight.slope, Flight.gap_t, Flight.gap_tt, Restitution.height_t,
  Restitution.height_tt, Rebounds.kick, side, eta, nu.
Ltac at_once := num; interval with (i_prec {bits}).
Ltac one p := num; interval with (i_bisect p, i_autodiff p, i_depth 60, i_prec {bits}).
Ltac two p t := num; interval with (i_bisect t, i_bisect p, i_depth 60, i_prec {bits}).
Ltac sloping p e := num; split; interval with (i_bisect p, i_bisect e, i_autodiff p, i_depth 60, i_prec {bits}).
"""

BRANCH = """
Lemma branch{i} : branch side eta nu {a} {b} {T} {u} {v}.
Proof.
  apply (computed_branch {bits} {unit} ({side}) {eta} ({nu}) {cut} {starts});
    [lia | vm_cast_no_check (eq_refl (Some {times})) | ..]; unfold ratio, side, eta, nu; cbn [first_phase last_phase]; field.
Qed.
"""

REGULAR = """
Lemma regular{i} : regular side eta nu {a} {b}.
Proof.{parts}
Qed.
"""
GLUED = "\n  apply (glue _ _ _ _ {b} {c}); [apply (branch_regular _ _ _ eta_pos _ _ _ _ _ branch{branch}) | | lra | lra | lra]."
LAST = "\n  apply (branch_regular _ _ _ eta_pos _ _ _ _ _ branch{branch})."

PIECE = """
Lemma {name} : forall phi, {p} <= phi <= {q} -> {lo} <= rate phi <= {hi}.
Proof.
  apply (piece side eta nu eta_pos _ _ _ _ _ branch{branch} _ _ {z} {r} {d}); [lra | intros; lra | lra | | | ].
  - one phi.
  - one phi.
  - sloping phi e.
Qed.
"""

RATE = """
Lemma rate_{set}{i} : forall phi, {x} <= phi <= {y} -> {lo} <= rate phi <= {hi}.
Proof.
  intros phi P.{cuts}
Qed.
"""

MONOTONE = """
Lemma monotone_{set}{i} : monotone side eta nu {a} {b} {x} {y} {s} {m} {M}.
Proof. split; [lra | first [left; lra | right; lra] | lra | intros phi P; generalize (rate_{set}{i} phi P); lra]. Qed.
"""

IMPACT = """
Lemma {name} : forall phi, {p} <= phi <= {q} -> {s} < impact_time phi < {t}.
Proof.
  intros phi P. apply (branch_bracket side eta nu eta_pos _ _ _ _ _ branch{branch});
    [lra | lra | lra | one phi | one phi].
Qed.
"""

LAP = """
Lemma lap{i} : in_lap side eta nu {a} {b} {k}.
Proof.
  apply (lap side eta nu _ _ regular{i} _ _ _ _ _ monotone_whole{i} _ {l} {r}).
  - intros p [P | P]; [generalize (before{i} p ltac:(lra)) | generalize (after{i} p ltac:(lra))];
      unfold lift; lra.
  - generalize PI_near; lra.
  - generalize PI_near; lra.
Qed.
"""

COVERS = """
Lemma covers_{set}{i} : covers side eta nu {a} {b} {x} {y} {s} {A} {B} {k}.
Proof.
  split; [apply lap{i} | destruct (Rlt_dec 0 {s}); try lra | destruct (Rlt_dec 0 {s}); try lra].
  - over end_{set}{i}_0 {x}.
  - over end_{set}{i}_1 {y}.
Qed.
"""

ESCAPE = """
(* No launch from [{p}, {q}] has its impact in [{A}, {B}]; each has one. *)
Lemma {name}{j}_launch : forall phi t, {p} <= phi <= {q} -> 0 <= t <= {T} -> 0 < gap_tt phi t.
Proof. two phi t. Qed.
Lemma {name}{j}_below : forall phi, {p} <= phi <= {q} -> gap phi {v} < 0.
Proof. one phi. Qed.
Lemma {name}{j} : forall phi, {p} <= phi <= {q} ->
  (exists psi, next phi psi) /\\ forall psi, next phi psi -> ~ {A} <= psi <= {B}.
Proof.
  intros phi P. split.
  {{ destruct (impact_exists side eta nu eta_pos phi {T} {v}) as [t I];
      [lra | intros; apply {name}{j}_launch; lra | lra | apply {name}{j}_below; lra |].
    apply (next_exists _ _ _ phi t I). }}
  intros psi. revert phi psi P. apply (escape side eta nu eta_pos {p} {q} {T} {A} {B} {K} {v});
    [lra | lra | lra | lra | generalize PI_near; lra | generalize PI_near; lra |
     apply {name}{j}_launch | | apply {name}{j}_below].
  intros k phi psi H P S.
  assert (C : {cases}) by lia.
  clear H; repeat destruct C as [-> | C]; try (subst k || destruct C); two phi psi.
Qed.
"""

AVOIDS = """
Lemma {name} : forall phi, {p} <= phi <= {q} ->
  (exists psi, next phi psi) /\\ forall psi, next phi psi -> ~ {A} <= psi <= {B}.
Proof.
  intros phi P.{cuts}
Qed.
"""
