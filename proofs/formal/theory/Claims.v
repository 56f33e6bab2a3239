(* The paper's claims H7, H11 and H16, each from what it needs. No numbers but its own. *)
From Coq Require Import Reals Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Calculus Flight.
Open Scope R_scope.

Section Map.
Variable N : R -> R -> Prop.
Variables A b0 a1 B s0 s1 m M : R.
Variable f : R -> R.
Hypothesis map : impact_map N A b0 a1 B s0 s1 m M f.
Notation In_ := (In_ A b0 a1 B).
Notation s i := (if i then s1 else s0).

Lemma image i x y : In_ i x -> N x y -> y = f x.
Proof. intros X. apply (locally_singleton _ _ (proj1 map i x X)). Qed.

Lemma expansion i x y : In_ i x -> In_ i y -> x <= y -> m * (y - x) <= s i * (f y - f x).
Proof.
  intros X Y L. destruct (Req_dec x y) as [->|D]; [nra|].
  destruct (mvt f (Derive f) x y) as [c [C E]]; [lra| |].
  - intros z Z. apply Derive_correct, (proj1 (proj2 map) i). destruct i; unfold Impact.In_ in *; lra.
  - assert (I : In_ i c) by (destruct i; unfold Impact.In_ in *; lra).
    destruct (proj1 (proj2 map) i c I) as (_ & _ & G & _). rewrite E. nra.
Qed.

(* Claim H7 as printed: where the left end c of an interval [c, d] in I0 moves to the right, no
   orbit stays in it for ever, so that the word 000... is no itinerary. *)
Theorem no_point c d a e : s0 = 1 -> 1 <= m -> In_ false c -> In_ false d ->
  (exists y, N c y /\ c < y) -> ~ exists x, itinerary N c d a e x (fun _ => false).
Proof.
  intros S m1 C D (y & Y & cy) (x & u & _ & H). unfold Impact.In_ in H.
  assert (G : forall n, c + INR n * (y - c) <= u n).
  { induction n as [|n IH]; [simpl; destruct (H O); lra|].
    destruct (H n) as [I Nn]. assert (In : In_ false (u n)) by (unfold Impact.In_ in *; lra).
    rewrite (image false _ _ In Nn), S_INR. pose proof (image false c y C Y) as E.
    pose proof (expansion false c (u n) C In ltac:(lra)) as F. simpl in F. rewrite S, <- E in F. nra. }
  destruct (archimed_cor1 ((y - c) / (d - c + 1))) as [n [Q n0]].
  - assert (c <= d) by (destruct (H O); lra). apply Rdiv_lt_0_compat; lra.
  - specialize (G n). destruct (H n) as [I _]. apply lt_INR in n0. simpl in n0.
    apply Rmult_lt_compat_r with (r := INR n * (d - c + 1)) in Q; [|apply Rmult_lt_0_compat; lra].
    replace (/ INR n * (INR n * (d - c + 1))) with (d - c + 1) in Q by (field; lra).
    replace ((y - c) / (d - c + 1) * (INR n * (d - c + 1))) with (INR n * (y - c)) in Q
      by (field; lra). lra.
Qed.
End Map.

(* Claim H11: Moran's equation has one root s, between two numbers where the sum is on both sides. *)
Definition moran (r0 r1 s : R) : R := Rpower r0 s + Rpower r1 s.

Lemma power_decreases r s t : 0 < r < 1 -> s < t -> Rpower r t < Rpower r s.
Proof. intros R L. apply exp_increasing. assert (ln r < 0) by (rewrite <- ln_1; apply ln_increasing; lra). nra. Qed.

Theorem moran_root r0 r1 lo hi : 0 < r0 < 1 -> 0 < r1 < 1 -> lo < hi ->
  moran r0 r1 hi < 1 < moran r0 r1 lo -> exists s, lo < s < hi /\ forall t, moran r0 r1 t = 1 <-> t = s.
Proof.
  intros R0 R1 L S. destruct (ivt (fun s => moran r0 r1 s - 1)
    (fun s => ln r0 * Rpower r0 s + ln r1 * Rpower r1 s) lo hi) as [s [I Z]]; try lra.
  - intros s _. unfold moran, Rpower. auto_derive; auto. ring.
  - exists s. split; auto. intros t. split; [|intros ->; lra]. intros T. unfold moran in *.
    destruct (Rtotal_order t s) as [G|[G|G]]; auto;
      pose proof (power_decreases r0 _ _ R0 G); pose proof (power_decreases r1 _ _ R1 G); lra.
Qed.

(* Claim H16: q decreases, and q(eta1 / eta0) = 0, whenever eta0 + eta1 < 1. *)
Theorem gap_function e0 e1 s : 0 < e0 -> 0 < e1 -> e0 + e1 < 1 -> moran e0 e1 s = 1 ->
  let q x := Rpower ((1 - e1) / e0 + x) s - 1 - Rpower x s in
  (forall x y, 0 < x < y -> q y < q x) /\ q (e1 / e0) = 0.
Proof.
  intros E0 E1 S R q. unfold moran in R.
  assert (s0 : 0 < s).
  { destruct (Rlt_dec 0 s) as [|H]; auto. exfalso. assert (P : forall r, 0 < r < 1 -> 1 <= Rpower r s).
    { intros r P. rewrite <- (Rpower_O r) by lra. destruct (Req_dec s 0) as [->|]; [lra|].
      apply Rlt_le, power_decreases; lra. }
    pose proof (P e0 ltac:(lra)). pose proof (P e1 ltac:(lra)). lra. }
  assert (s1 : s < 1).
  { destruct (Rlt_dec s 1) as [|H]; auto. exfalso. assert (P : forall r, 0 < r < 1 -> Rpower r s <= r).
    { intros r P. rewrite <- (Rpower_1 r) at 2 by lra. destruct (Req_dec s 1) as [->|]; [lra|].
      apply Rlt_le, power_decreases; lra. }
    pose proof (P e0 ltac:(lra)). pose proof (P e1 ltac:(lra)). lra. }
  assert (c0 : 0 < (1 - e1) / e0) by (apply Rdiv_lt_0_compat; lra).
  split.
  - set (c := (1 - e1) / e0) in *. clearbody c. intros x y [x0 xy].
    destruct (mvt q (fun x => s * (Rpower (c + x) (s - 1) - Rpower x (s - 1))) x y) as [z [Z E]]; auto.
    + intros z Z. unfold q, Rpower. auto_derive; [repeat split; auto; lra|].
      assert (T : forall w, 0 < w -> exp ((s - 1) * ln w) = exp (s * ln w) * / w).
      { intros w W. replace ((s - 1) * ln w) with (s * ln w + - ln w) by ring.
        rewrite exp_plus, exp_Ropp, exp_ln; auto. }
      rewrite !T by lra. field. split; lra.
    + assert (Rpower (c + z) (s - 1) < Rpower z (s - 1)).
      { unfold Rpower. apply exp_increasing.
        assert (ln z < ln (c + z)) by (apply ln_increasing; lra). nra. }
      assert (0 < s * (Rpower z (s - 1) - Rpower (c + z) (s - 1)) * (y - x))
        by (repeat apply Rmult_lt_0_compat; lra). lra.
  - unfold q. replace ((1 - e1) / e0 + e1 / e0) with (/ e0) by (field; lra).
    assert (D : forall x, 0 < x -> Rpower (x * / e0) s * Rpower e0 s = Rpower x s).
    { intros x X. rewrite Rpower_mult_distr by (try apply Rmult_lt_0_compat; try apply Rinv_0_lt_compat; lra).
      f_equal. field. lra. }
    pose proof (exp_pos (s * ln e0)) as P. fold (Rpower e0 s) in P.
    pose proof (D 1 ltac:(lra)) as D1. rewrite Rmult_1_l in D1. pose proof (D e1 E1) as D2.
    assert (U : Rpower 1 s = 1) by (unfold Rpower; rewrite ln_1, Rmult_0_r; apply exp_0).
    rewrite U in D1. apply Rmult_eq_reg_r with (Rpower e0 s); [|lra]. unfold Rdiv. nra.
Qed.
