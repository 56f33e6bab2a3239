(* Covering and cone conditions in the plane give the two-sided full shift. No numbers, no impacts. *)
From Coq Require Import Reals ZArith Psatz Lia FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Rebounds.
Open Scope R_scope.

(* Cones: differences |dg| <= c |dx| go to such and grow p - q c times; those that go to
   c |dx'| <= |dg'| shrink. *)
Lemma cones p q r s c dx dg dx' dg' : 0 <= p -> 0 <= q -> 0 <= r -> 0 <= s -> 0 < c -> 0 <= dx -> 0 <= dg ->
  p * dx <= dx' + q * dg -> dg' <= r * dx + s * dg -> r + s * c <= c * (p - q * c) ->
  (dg <= c * dx -> (p - q * c) * dx <= dx' /\ dg' <= c * dx') /\
  (c * dx' <= dg' -> (c * p - r) * dg' <= c * (r * q + s * p) * dg).
Proof.
  intros p0 q0 r0 s0 c0 x0 g0 S T C. split; intros H.
  - assert (q * dg <= q * (c * dx)) by (apply Rmult_le_compat_l; lra).
    assert (s * dg <= s * (c * dx)) by (apply Rmult_le_compat_l; lra).
    assert ((r + s * c) * dx <= c * (p - q * c) * dx) by (apply Rmult_le_compat_r; lra).
    assert (E : (p - q * c) * dx <= dx') by lra. split; auto.
    assert (c * ((p - q * c) * dx) <= c * dx') by (apply Rmult_le_compat_l; lra). lra.
  - assert (c * p * dg' <= c * p * (r * dx + s * dg)) by (apply Rmult_le_compat_l; [apply Rmult_le_pos|]; lra).
    assert (c * r * (p * dx) <= c * r * (dx' + q * dg)) by (apply Rmult_le_compat_l; [apply Rmult_le_pos|]; lra).
    assert (r * (c * dx') <= r * dg') by (apply Rmult_le_compat_l; lra). lra.
Qed.

Section Crossed.
Variable N : R * R -> R * R -> Prop.
Variables A b0 a1 B g0 g1 : R.
Notation V := (rectangle A b0 a1 B g0 g1).
Notation I := (In_ A b0 a1 B).
Hypothesis order : A < b0 < a1 /\ a1 < B.
Hypothesis height_pos : g0 < g1.

(* N is (P, Q) on the rectangles. *)
Variables P Q : R * R -> R.
Hypothesis N_PQ : forall i z z', V i z -> (N z z' <-> z' = (P z, Q z)).
Hypothesis back : forall i j z z' y, V i z -> V j z' -> N z y -> N z' y -> z = z'.

(* Images of horizontal lines cover [A, B]; image velocities are allowed. *)
Hypothesis cover : forall i y g, A <= y <= B -> g0 <= g <= g1 -> exists x, I i x /\ P (x, g) = y.
Hypothesis into : forall i z, V i z -> g0 <= Q z <= g1.

(* Bounds p, q, r, s on differences as on the entries of DF. *)
Variables p q r s c k : R.
Hypothesis signs : 0 < p /\ 0 <= q /\ 0 <= r /\ 0 <= s /\ 0 < c /\ 0 <= k < 1.
Hypothesis stretch : forall i z z', V i z -> V i z' ->
  p * Rabs (fst z - fst z') <= Rabs (P z - P z') + q * Rabs (snd z - snd z').
Hypothesis shrink : forall i z z', V i z -> V i z' ->
  Rabs (Q z - Q z') <= r * Rabs (fst z - fst z') + s * Rabs (snd z - snd z').
Hypothesis rate_x : 1 + q * c <= k * p.
Hypothesis rate_g : r + s * c <= k * c.
Notation near := (near c).
Notation orbit := (orbit N A b0 a1 B g0 g1).

Lemma I_range i x : I i x -> A <= x <= B.
Proof. destruct i; unfold In_; lra. Qed.

(* The point on the line of velocity g that goes to phase y. *)
Definition solve (i : bool) (y g : R) : R := iota (fun x => I i x /\ P (x, g) = y).

Lemma solve_spec i y g : A <= y <= B -> g0 <= g <= g1 -> I i (solve i y g) /\ P (solve i y g, g) = y.
Proof.
  intros Y G. apply (iota_correct (V := R_CompleteNormedModule) (fun x => I i x /\ P (x, g) = y)).
  destruct (cover i y g Y G) as (x & X & E). exists x. split; auto.
  enough (U : forall x' : R, I i x' /\ P (x', g) = y -> x = x') by exact U. intros x' [X' E'].
  assert (H := stretch i (x, g) (x', g) (conj X G) (conj X' G)). simpl in H.
  rewrite E, E', !Rminus_eq_0, Rabs_R0 in H.
  destruct (Req_dec x x') as [|D]; auto. assert (0 < Rabs (x - x')) by (apply Rabs_pos_lt; lra). nra.
Qed.

Lemma near_sym e z z' : near e z z' -> near e z' z.
Proof. intros [X G]. split; rewrite Rabs_minus_sym; auto. Qed.

(* One step: bounds at the next phase, this velocity and the state before give bounds here. *)
Lemma step i j e z z' h h' y y' : V i z -> V i z' -> V j y -> V j y' ->
  Rabs (P (fst z, h) - P (fst z', h')) <= e -> Rabs (h - h') <= c * e -> g0 <= h <= g1 -> g0 <= h' <= g1 ->
  snd z = Q y -> snd z' = Q y' -> near e y y' -> near (k * e) z z'.
Proof.
  intros [Z1 Z2] [Z1' Z2'] Y Y' Hp Hh G G' E E' [Ny Ng].
  pose proof (stretch i (fst z, h) (fst z', h') (conj Z1 G) (conj Z1' G')) as S. simpl in S.
  pose proof (shrink j y y' Y Y') as T. rewrite <- E, <- E' in T.
  assert (0 <= e) by (eapply Rle_trans; [apply Rabs_pos|exact Hp]).
  assert (q * Rabs (h - h') <= q * (c * e)) by (apply Rmult_le_compat_l; lra).
  assert (r * Rabs (fst y - fst y') <= r * e) by (apply Rmult_le_compat_l; lra).
  assert (s * Rabs (snd y - snd y') <= s * (c * e)) by (apply Rmult_le_compat_l; lra).
  assert ((1 + q * c) * e <= k * p * e) by (apply Rmult_le_compat_r; lra).
  assert ((r + s * c) * e <= k * c * e) by (apply Rmult_le_compat_r; lra).
  split; [apply Rmult_le_reg_l with p|]; lra.
Qed.

(* Iterates that depend on ever more of the history. *)
Definition start (i : bool) : R * R := (if i then a1 else A, g0).
Fixpoint approx (n : nat) (w : history) : R * R :=
  match n with
  | O => start (w 0%Z)
  | S n => (solve (w 0%Z) (fst (approx n (from 1 w))) (snd (approx n w)), Q (approx n (from (-1) w)))
  end.

Lemma V_range i z : V i z -> A <= fst z <= B /\ g0 <= snd z <= g1.
Proof. intros [X G]. split; auto. apply (I_range i), X. Qed.

Lemma approx_V n : forall w, V (w 0%Z) (approx n w).
Proof.
  induction n as [|n IH]; intros w; simpl.
  - unfold start, rectangle, In_; simpl. destruct (w 0%Z); lra.
  - split; simpl; [apply solve_spec; apply (V_range _ _ (IH _))|apply (into _ _ (IH (from (-1) w)))].
Qed.

Definition e0 : R := (B - A) + (g1 - g0) / c.

Lemma e0_pos : 0 < e0.
Proof. unfold e0. assert (0 < (g1 - g0) / c) by (apply Rdiv_lt_0_compat; lra). lra. Qed.

Lemma V_near i z z' : V i z -> V i z' -> near e0 z z'.
Proof.
  intros Z Z'. apply V_range in Z, Z'. assert (0 < (g1 - g0) / c) by (apply Rdiv_lt_0_compat; lra).
  unfold e0. split; apply Rabs_le; [lra|].
  replace (c * (B - A + (g1 - g0) / c)) with (c * (B - A) + (g1 - g0)) by (field; lra).
  assert (0 < c * (B - A)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma agree_from (w w' : history) n m : (Z.abs m <= 1)%Z ->
  (forall j, (Z.abs j <= Z.of_nat (S n))%Z -> w j = w' j) ->
  forall j, (Z.abs j <= Z.of_nat n)%Z -> from m w j = from m w' j.
Proof. intros M H j J. apply H. lia. Qed.

Lemma approx_near n : forall w w' m m', (forall j, (Z.abs j <= Z.of_nat n)%Z -> w j = w' j) ->
  (n <= m)%nat -> (n <= m')%nat -> near (k ^ n * e0) (approx m w) (approx m' w').
Proof.
  induction n as [|n IH]; intros w w' m m' H M M'.
  - rewrite pow_O, Rmult_1_l. apply (V_near (w 0%Z)); [apply approx_V|].
    rewrite (H 0%Z) by lia. apply approx_V.
  - destruct m as [|m]; [lia|]. destruct m' as [|m']; [lia|].
    pose proof (IH _ _ m m' (agree_from w w' n 1 ltac:(lia) H) ltac:(lia) ltac:(lia)) as [Hx _].
    pose proof (IH _ _ m m' (agree_from w w' n (-1) ltac:(lia) H) ltac:(lia) ltac:(lia)) as Hb.
    assert (Hh : near (k ^ n * e0) (approx m w) (approx m' w')) by (apply IH; [intros j J; apply H; lia|lia|lia]).
    pose proof (approx_V (S m) w) as Z. pose proof (approx_V (S m') w') as Z'.
    pose proof (approx_V m (from (-1) w)) as Y. pose proof (approx_V m' (from (-1) w')) as Y'.
    rewrite <- (H 0%Z) in Z' by lia. unfold from at 1 in Y'. rewrite <- (H (-1 + 0)%Z) in Y' by lia.
    replace (k ^ S n * e0) with (k * (k ^ n * e0)) by (simpl; ring).
    apply (step (w 0%Z) _ _ _ _ (snd (approx m w)) (snd (approx m' w')) _ _ Z Z' Y Y'); auto;
      try apply (V_range _ _ (approx_V _ _)); try apply Hh.
    simpl. rewrite <- (H 0%Z) by lia.
    destruct (solve_spec (w 0%Z) (fst (approx m (from 1 w))) (snd (approx m w))) as [_ E1];
      try apply (V_range _ _ (approx_V _ _)).
    destruct (solve_spec (w 0%Z) (fst (approx m' (from 1 w'))) (snd (approx m' w'))) as [_ E2];
      try apply (V_range _ _ (approx_V _ _)).
    rewrite E1, E2. exact Hx.
Qed.

Lemma rate_vanishes eps : 0 < eps -> exists n, k ^ n * e0 < eps /\ c * (k ^ n * e0) < eps.
Proof.
  intros E. pose proof e0_pos as E0. assert (c0 : 0 < c) by lra.
  assert (M : 0 < e0 * (1 + c)) by (apply Rmult_lt_0_compat; lra).
  assert (D : 0 < eps / (e0 * (1 + c))) by (apply Rdiv_lt_0_compat; lra).
  destruct (pow_lt_1_zero k ltac:(rewrite Rabs_pos_eq; lra) _ D) as [n H']. exists n.
  specialize (H' n (le_n n)). rewrite Rabs_pos_eq in H' by (apply pow_le; lra).
  apply Rmult_lt_compat_r with (r := e0 * (1 + c)) in H'; [|lra].
  replace (eps / (e0 * (1 + c)) * (e0 * (1 + c))) with eps in H' by (field; split; lra).
  assert (T : 0 <= k ^ n * e0) by (apply Rmult_le_pos; [apply pow_le|]; lra).
  assert (0 <= c * (k ^ n * e0)) by (apply Rmult_le_pos; lra). lra.
Qed.

(* The limit, and how near it is. *)
Definition X (w : history) : R * R :=
  (real (Lim_seq (fun n => fst (approx n w))), real (Lim_seq (fun n => snd (approx n w)))).

Lemma cauchy (f : nat -> R) : (forall eps, 0 < eps -> exists n, forall m m', (n <= m)%nat -> (n <= m')%nat ->
  Rabs (f m - f m') < eps) -> is_lim_seq f (real (Lim_seq f)).
Proof.
  intros H. apply Lim_seq_correct', ex_lim_seq_cauchy_corr. intros eps.
  destruct (H eps (cond_pos eps)) as [n Hn]. exists n. auto.
Qed.

Lemma X_lim w : is_lim_seq (fun n => fst (approx n w)) (fst (X w)) /\ is_lim_seq (fun n => snd (approx n w)) (snd (X w)).
Proof.
  split; apply cauchy; intros eps E; destruct (rate_vanishes eps E) as (n & H1 & H2); exists n; intros m m' M M';
    destruct (approx_near n w w m m' ltac:(auto) M M'); simpl in *; lra.
Qed.

Lemma lim_close (f : nat -> R) (l a e : R) n : is_lim_seq f l -> (forall m, (n <= m)%nat -> Rabs (f m - a) <= e) -> Rabs (l - a) <= e.
Proof.
  intros L H. apply (is_lim_seq_incr_n f n) in L. assert (forall m, a - e <= f (m + n)%nat <= a + e).
  { intros m. specialize (H (m + n)%nat ltac:(lia)). apply Rabs_le_between in H. lra. }
  assert (a - e <= l) by (apply (is_lim_seq_le (fun _ => a - e) (fun m => f (m + n)%nat) (a - e) l);
    auto using is_lim_seq_const; apply H0).
  assert (l <= a + e) by (apply (is_lim_seq_le (fun m => f (m + n)%nat) (fun _ => a + e) l (a + e));
    auto using is_lim_seq_const; apply H0).
  apply Rabs_le. lra.
Qed.

Lemma X_near n w z : (forall m, (n <= m)%nat -> near (k ^ n * e0) (approx m w) z) -> near (k ^ n * e0) (X w) z.
Proof.
  intros H. destruct (X_lim w) as [L1 L2].
  split; [apply (lim_close _ _ _ _ n L1)|apply (lim_close _ _ _ _ n L2)]; intros m M; apply (H m M).
Qed.

Lemma X_close n w w' : (forall j, (Z.abs j <= Z.of_nat n)%Z -> w j = w' j) -> near (k ^ n * e0) (X w) (X w').
Proof.
  intros H. apply X_near. intros m M. apply near_sym, X_near. intros m' M'. apply near_sym, approx_near; auto.
Qed.

Lemma X_V w : V (w 0%Z) (X w).
Proof.
  destruct (X_lim w) as [L1 L2]. unfold rectangle, In_.
  assert (H : forall n, V (w 0%Z) (approx n w)) by (intros; apply approx_V). unfold rectangle, In_ in H.
  assert (C : forall (f : nat -> R) (l a b : R), is_lim_seq f l -> (forall n, a <= f n <= b) -> a <= l <= b).
  { intros f l a b L Hf. split.
    - apply (is_lim_seq_le (fun _ => a) f a l); auto using is_lim_seq_const. apply Hf.
    - apply (is_lim_seq_le f (fun _ => b) l b); auto using is_lim_seq_const. apply Hf. }
  split; [destruct (w 0%Z)|]; (eapply C; [eassumption|apply H]).
Qed.

Lemma same z z' : (forall n, near (k ^ n * e0) z z') -> z = z'.
Proof.
  intros H. assert (D : forall a b, (forall n, Rabs (a - b) <= k ^ n * e0 \/ Rabs (a - b) <= c * (k ^ n * e0)) -> a = b).
  { intros a b G. destruct (Req_dec a b) as [|D]; auto. exfalso.
    assert (D' : 0 < Rabs (a - b)) by (apply Rabs_pos_lt; lra).
    destruct (rate_vanishes _ D') as (n & H1 & H2). destruct (G n); lra. }
  destruct z, z'. f_equal; apply D; intros n; destruct (H n); auto.
Qed.

(* An orbit is at the limit of its history. *)
Lemma orbit_from w u n : orbit w u -> orbit (from n w) (fun j => u (n + j)%Z).
Proof. intros H j. unfold from. destruct (H (n + j)%Z) as [Hv Hn]. split; auto. rewrite Z.add_assoc. auto. Qed.

Lemma orbit_near n : forall w u m, orbit w u -> (n <= m)%nat -> near (k ^ n * e0) (approx m w) (u 0%Z).
Proof.
  induction n as [|n IH]; intros w u m H M.
  - rewrite pow_O, Rmult_1_l. apply (V_near (w 0%Z)); [apply approx_V|apply H].
  - destruct m as [|m]; [lia|]. replace (k ^ S n * e0) with (k * (k ^ n * e0)) by (simpl; ring).
    destruct (IH _ _ m (orbit_from w u 1 H) ltac:(lia)) as [Hx _]. pose proof (IH _ _ m H ltac:(lia)) as Hh.
    pose proof (IH _ _ m (orbit_from w u (-1) H) ltac:(lia)) as Hb. simpl in Hx, Hb.
    destruct (H 0%Z) as [V0 N0]. destruct (H (-1)%Z) as [V1 N1]. simpl in N0, N1.
    apply (N_PQ _ _ _ V0) in N0. apply (N_PQ _ _ _ V1) in N1.
    apply (step (w 0%Z) (w (-1)%Z) _ _ _ (snd (approx m w)) (snd (u 0%Z)) (approx m (from (-1) w)) (u (-1)%Z)); auto;
      try apply (V_range _ _ (approx_V _ _)); try apply (V_range _ _ V0); try apply Hh; try apply (approx_V (S m)).
    + apply (approx_V m (from (-1) w)).
    + destruct (solve_spec (w 0%Z) (fst (approx m (from 1 w))) (snd (approx m w))) as [_ E1];
        try apply (V_range _ _ (approx_V _ _)).
      simpl. rewrite E1, <- surjective_pairing. rewrite N0 in Hx. exact Hx.
    + rewrite N1. reflexivity.
Qed.

Lemma orbit_X w u : orbit w u -> forall n, u n = X (from n w).
Proof.
  intros H n. pose proof (orbit_from w u n H) as G. symmetry.
  replace (u n) with (u (n + 0)%Z) by (f_equal; lia). apply same. intros j. apply X_near. intros m M.
  apply (orbit_near j _ _ m G M).
Qed.

Lemma from_from a b w : from a (from b w) = from (b + a) w.
Proof. apply functional_extensionality. intros j. unfold from. f_equal. lia. Qed.

Lemma from_0 w : from 0 w = w.
Proof. apply functional_extensionality. intros j. reflexivity. Qed.

(* The limit is a fixed point. *)
Lemma X_fixed w : X w = (solve (w 0%Z) (fst (X (from 1 w))) (snd (X w)), Q (X (from (-1) w))).
Proof.
  set (z := (_, _)). pose proof (X_V (from 1 w)) as V1. pose proof (X_V w) as V0.
  pose proof (X_V (from (-1) w)) as Vb. apply V_range in V1. destruct (V_range _ _ V0) as [_ G0].
  destruct (solve_spec (w 0%Z) (fst (X (from 1 w))) (snd (X w))) as [S1 S2]; try tauto.
  assert (Vz : V (w 0%Z) z) by (split; [exact S1|apply (into _ _ Vb)]).
  apply same. intros [|n].
  - rewrite pow_O, Rmult_1_l. apply (V_near (w 0%Z)); auto.
  - replace (k ^ S n * e0) with (k * (k ^ n * e0)) by (simpl; ring).
    replace (k * (k ^ n * e0)) with (k ^ S n * e0) by (simpl; ring).
    apply X_near. intros [|m] M; [lia|].
    replace (k ^ S n * e0) with (k * (k ^ n * e0)) by (simpl; ring).
    assert (H : forall v, near (k ^ n * e0) (approx m v) (X v)).
    { intros v. apply near_sym, X_near. intros m' M'. apply approx_near; auto; lia. }
    apply (step (w 0%Z) _ _ _ _ (snd (approx m w)) (snd (X w)) (approx m (from (-1) w)) (X (from (-1) w))
      (approx_V (S m) w) Vz (approx_V m (from (-1) w)) Vb); auto;
      try apply (V_range _ _ (approx_V _ _)); try apply H.
    destruct (solve_spec (w 0%Z) (fst (approx m (from 1 w))) (snd (approx m w))) as [_ E1];
      try apply (V_range _ _ (approx_V _ _)).
    unfold z. cbn [fst approx]. rewrite E1, S2. apply (H (from 1 w)).
Qed.

Lemma X_N w : N (X w) (X (from 1 w)).
Proof.
  apply (N_PQ (w 0%Z)); [apply X_V|]. rewrite (surjective_pairing (X (from 1 w))). f_equal.
  - destruct (solve_spec (w 0%Z) (fst (X (from 1 w))) (snd (X w))) as [_ E].
    + apply (V_range _ _ (X_V (from 1 w))).
    + apply (V_range _ _ (X_V w)).
    + pose proof (f_equal fst (X_fixed w)) as F. cbn [fst] in F.
      rewrite <- F, <- surjective_pairing in E. symmetry. exact E.
  - rewrite (X_fixed (from 1 w)). cbn [snd]. rewrite from_from. change (1 + -1)%Z with 0%Z.
    rewrite from_0. reflexivity.
Qed.

Lemma X_orbit w : orbit w (fun n => X (from n w)).
Proof.
  intros n. split.
  - pose proof (X_V (from n w)) as H. unfold from at 1 in H. rewrite Z.add_0_r in H. exact H.
  - pose proof (X_N (from n w)) as H. rewrite from_from in H. exact H.
Qed.

Lemma disjoint i j z : V i z -> V j z -> i = j.
Proof. intros [H _] [H' _]. unfold In_ in H, H'. destruct i, j; auto; lra. Qed.

Lemma X_injective w w' : X w = X w' <-> forall n, w n = w' n.
Proof.
  split; [|intros H; f_equal; apply functional_extensionality, H]. intros E.
  assert (All : forall n, X (from n w) = X (from n w')).
  { assert (Z0 : X (from 0 w) = X (from 0 w')) by (rewrite !from_0; exact E).
    assert (Up : forall n, X (from (Z.of_nat n) w) = X (from (Z.of_nat n) w')).
    { induction n as [|n IH]; [exact Z0|]. replace (Z.of_nat (S n)) with (Z.of_nat n + 1)%Z by lia.
      destruct (X_orbit w (Z.of_nat n)) as [V1 N1], (X_orbit w' (Z.of_nat n)) as [V2 N2].
      apply (N_PQ _ _ _ V1) in N1. apply (N_PQ _ _ _ V2) in N2. rewrite N1, N2, IH. reflexivity. }
    assert (Down : forall n, X (from (- Z.of_nat n) w) = X (from (- Z.of_nat n) w')).
    { induction n as [|n IH]; [exact Z0|].
      destruct (X_orbit w (- Z.of_nat (S n))%Z) as [V1 N1], (X_orbit w' (- Z.of_nat (S n))%Z) as [V2 N2].
      replace (- Z.of_nat (S n) + 1)%Z with (- Z.of_nat n)%Z in N1, N2 by lia. rewrite <- IH in N2.
      apply (back _ _ _ _ _ V1 V2 N1 N2). }
    intros n. destruct (Z_le_gt_dec 0 n).
    - rewrite <- (Z2Nat.id n) by auto. apply Up.
    - replace n with (- Z.of_nat (Z.to_nat (- n)))%Z by lia. apply Down. }
  intros n. destruct (X_orbit w n) as [V1 _], (X_orbit w' n) as [V2 _]. rewrite <- All in V2.
  apply (disjoint _ _ _ V1 V2).
Qed.

Theorem crossed_theorem : two_sided_shift N A b0 a1 B g0 g1 c k e0.
Proof.
  exists X. split; [|split; [apply X_N|split; [apply X_injective|intros n w w'; apply X_close]]].
  intros w u. split; [apply orbit_X|]. intros H n. rewrite (H n), (H (n + 1)%Z). apply (X_orbit w n).
Qed.
End Crossed.
