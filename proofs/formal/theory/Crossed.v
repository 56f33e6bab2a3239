(* Boxes in the plane that a map takes across each other along arrows, with cones: each two-sided path
   of arrows is that of exactly one full orbit. No numbers. *)
From Coq Require Import Reals ZArith Psatz Lia FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Histories.
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
Variable letter : Type.
Variable arrow : letter -> letter -> Prop.

(* The set of a letter is a box in coordinates of its own. *)
Variables x0 x1 y0 y1 : letter -> R.
Definition box (i : letter) (q : R * R) : Prop := x0 i <= fst q <= x1 i /\ y0 i <= snd q <= y1 i.
Variable chart coordinates : letter -> R * R -> R * R.
Variable boxed : letter -> R * R -> Prop.
Hypothesis boxes : forall i z, boxed i z <-> exists q, box i q /\ z = chart i q.
Hypothesis order : forall i, x0 i <= x1 i /\ y0 i <= y1 i.
Hypothesis charted : forall i q, coordinates i (chart i q) = q.

(* The map in coordinates: on a box, where its image is in another box. *)
Variable N : R * R -> R * R -> Prop.
Variables P Q : letter -> letter -> R * R -> R.
Hypothesis N_PQ : forall i j q q', arrow i j -> box i q -> box j q' ->
  (N (chart i q) (chart j q') <-> q' = (P i j q, Q i j q)).

(* Images of horizontal lines run across the box, and do not leave it through the other sides. *)
Hypothesis across : forall i j y g, arrow i j -> x0 j <= y <= x1 j -> y0 i <= g <= y1 i ->
  exists x, x0 i <= x <= x1 i /\ P i j (x, g) = y.
Hypothesis into : forall i j q, arrow i j -> box i q -> x0 j <= P i j q <= x1 j -> y0 j <= Q i j q <= y1 j.
Hypothesis disjoint : forall i i' j j' z, arrow i i' -> arrow j j' -> boxed i z -> boxed j z -> i = j.

(* Bounds p, q, r, s on differences as on the entries of the derivative. *)
Variables p q r s c k : R.
Hypothesis signs : 0 < p /\ 0 <= q /\ 0 <= r /\ 0 <= s /\ 0 < c /\ 0 <= k < 1.
Hypothesis stretch : forall i j z z', arrow i j -> box i z -> box i z' ->
  p * Rabs (fst z - fst z') <= Rabs (P i j z - P i j z') + q * Rabs (snd z - snd z').
Hypothesis shrink : forall i j z z', arrow i j -> box i z -> box i z' ->
  Rabs (Q i j z - Q i j z') <= r * Rabs (fst z - fst z') + s * Rabs (snd z - snd z').
Hypothesis rate_x : 1 + q * c <= k * p.
Hypothesis rate_g : r * k + s * c <= k * c.

(* What charts make of differences, and the size of all boxes. *)
Variables e0 largest : R.
Hypothesis e0_pos : 0 < e0.
Hypothesis small : forall i, x1 i - x0 i <= e0 /\ y1 i - y0 i <= c * e0.
Definition near (e : R) (z z' : R * R) : Prop := Rabs (fst z - fst z') <= e /\ Rabs (snd z - snd z') <= c * e.
Hypothesis chart_near : forall i e z z', near e z z' ->
  Rabs (fst (chart i z) - fst (chart i z')) <= largest * e /\ Rabs (snd (chart i z) - snd (chart i z')) <= largest * e.

Notation history := (history letter).
Notation from := (from letter).
Notation allowed := (allowed letter arrow).
Notation orbit := (orbit letter boxed N).

(* The point of a box on the line of height g that goes to y. *)
Definition solve (i j : letter) (y g : R) : R := iota (fun x => x0 i <= x <= x1 i /\ P i j (x, g) = y).

Lemma solve_unique i j x g y : arrow i j -> x0 i <= x <= x1 i -> y0 i <= g <= y1 i -> P i j (x, g) = y ->
  solve i j y g = x.
Proof.
  intros A X G E. apply (iota_unique (V := R_CompleteNormedModule)); auto.
  enough (U : forall x' : R, x0 i <= x' <= x1 i /\ P i j (x', g) = y -> x' = x) by exact U. intros x' [X' E']. pose proof (stretch i j (x, g) (x', g) A (conj X G) (conj X' G)) as H. simpl in H.
  rewrite E, E', !Rminus_eq_0, Rabs_R0 in H.
  destruct (Req_dec x x') as [|D]; auto. assert (0 < Rabs (x - x')) by (apply Rabs_pos_lt; lra). nra.
Qed.

Lemma solve_spec i j y g : arrow i j -> x0 j <= y <= x1 j -> y0 i <= g <= y1 i ->
  x0 i <= solve i j y g <= x1 i /\ P i j (solve i j y g, g) = y.
Proof.
  intros A Y G. destruct (across i j y g A Y G) as (x & X & E). rewrite (solve_unique i j x g y); auto.
Qed.

Lemma solve_near i j y y' h h' e : arrow i j -> x0 j <= y <= x1 j -> x0 j <= y' <= x1 j ->
  y0 i <= h <= y1 i -> y0 i <= h' <= y1 i -> Rabs (y - y') <= e -> Rabs (h - h') <= c * e ->
  Rabs (solve i j y h - solve i j y' h') <= k * e.
Proof.
  intros A Y Y' H H' Dy Dh. destruct (solve_spec i j y h A Y H) as [X E], (solve_spec i j y' h' A Y' H') as [X' E'].
  pose proof (stretch i j (solve i j y h, h) (solve i j y' h', h') A (conj X H) (conj X' H')) as S. simpl in S.
  rewrite E, E' in S. assert (0 <= e) by (eapply Rle_trans; [apply Rabs_pos|exact Dy]).
  assert (q * Rabs (h - h') <= q * (c * e)) by (apply Rmult_le_compat_l; lra).
  assert ((1 + q * c) * e <= k * p * e) by (apply Rmult_le_compat_r; lra).
  apply Rmult_le_reg_l with p; lra.
Qed.

(* A point anew, from those after and before it. *)
Definition renewed (h i j : letter) (before here after : R * R) : R * R :=
  (solve i j (fst after) (snd here), Q h i (solve h i (fst here) (snd before), snd before)).

Lemma renewed_box h i j b z a : arrow h i -> arrow i j -> box h b -> box i z -> box j a -> box i (renewed h i j b z a).
Proof.
  intros A A' [_ B] [Zx Zy] [Ax _]. destruct (solve_spec h i (fst z) (snd b) A Zx B) as [X E].
  split; simpl; [apply solve_spec; auto|]. apply into; auto; [split; auto|]. rewrite E. exact Zx.
Qed.

Lemma renewed_near h i j e b b' z z' a a' : arrow h i -> arrow i j -> box h b -> box h b' -> box i z -> box i z' ->
  box j a -> box j a' -> near e b b' -> near e z z' -> near e a a' ->
  near (k * e) (renewed h i j b z a) (renewed h i j b' z' a').
Proof.
  intros A A' [_ B] [_ B'] [Zx Zy] [Zx' Zy'] [Ax _] [Ax' _] [_ Nb] [Nz Nh] [Na _].
  split; simpl; [apply solve_near; auto|].
  destruct (solve_spec h i (fst z) (snd b) A Zx B) as [X _], (solve_spec h i (fst z') (snd b') A Zx' B') as [X' _].
  pose proof (solve_near h i _ _ _ _ e A Zx Zx' B B' Nz Nb) as Sn.
  pose proof (shrink h i (solve h i (fst z) (snd b), snd b) (solve h i (fst z') (snd b'), snd b') A (conj X B) (conj X' B')) as T.
  simpl in T. assert (0 <= e) by (eapply Rle_trans; [apply Rabs_pos|exact Nz]).
  assert (r * Rabs (solve h i (fst z) (snd b) - solve h i (fst z') (snd b')) <= r * (k * e)) by (apply Rmult_le_compat_l; lra).
  assert (s * Rabs (snd b - snd b') <= s * (c * e)) by (apply Rmult_le_compat_l; lra).
  assert ((r * k + s * c) * e <= k * c * e) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Lemma near_sym e z z' : near e z z' -> near e z' z.
Proof. intros [X G]. split; rewrite Rabs_minus_sym; auto. Qed.

Lemma box_near i z z' : box i z -> box i z' -> near e0 z z'.
Proof. intros [Zx Zy] [Zx' Zy']. destruct (small i). split; apply Rabs_le; lra. Qed.

Lemma allowed_from n w : allowed w -> allowed (from n w).
Proof. intros A m. unfold Histories.from. rewrite Z.add_assoc. apply A. Qed.

Lemma arrows w : allowed w -> arrow (w (-1)%Z) (w 0%Z) /\ arrow (w 0%Z) (w 1%Z).
Proof. intros A. split; [apply (A (-1)%Z)|apply (A 0%Z)]. Qed.

(* Iterates that depend on ever more of the history. *)
Fixpoint approx (n : nat) (w : history) : R * R :=
  match n with
  | O => (x0 (w 0%Z), y0 (w 0%Z))
  | S n => renewed (w (-1)%Z) (w 0%Z) (w 1%Z) (approx n (from (-1) w)) (approx n w) (approx n (from 1 w))
  end.

Lemma approx_box n : forall w, allowed w -> box (w 0%Z) (approx n w).
Proof.
  induction n as [|n IH]; intros w A; simpl.
  - unfold box; simpl. pose proof (order (w 0%Z)). lra.
  - destruct (arrows w A). apply renewed_box; auto.
    + apply (IH (from (-1) w)), allowed_from, A.
    + apply (IH (from 1 w)), allowed_from, A.
Qed.

Lemma agree_from (w v : history) n m : (Z.abs m <= 1)%Z ->
  (forall j, (Z.abs j <= Z.of_nat (S n))%Z -> w j = v j) ->
  forall j, (Z.abs j <= Z.of_nat n)%Z -> from m w j = from m v j.
Proof. intros M H j J. apply H. lia. Qed.

Lemma approx_near n : forall w v m m', allowed w -> allowed v -> (forall j, (Z.abs j <= Z.of_nat n)%Z -> w j = v j) ->
  (n <= m)%nat -> (n <= m')%nat -> near (k ^ n * e0) (approx m w) (approx m' v).
Proof.
  induction n as [|n IH]; intros w v m m' A A' H M M'.
  - rewrite pow_O, Rmult_1_l. apply (box_near (w 0%Z)); [apply approx_box, A|].
    rewrite (H 0%Z) by lia. apply approx_box, A'.
  - destruct m as [|m]; [lia|]. destruct m' as [|m']; [lia|]. cbn [approx].
    rewrite <- (H 0%Z), <- (H 1%Z), <- (H (-1)%Z) by lia.
    replace (k ^ S n * e0) with (k * (k ^ n * e0)) by (simpl; ring).
    pose proof (fun d => allowed_from d w A) as F. pose proof (fun d => allowed_from d v A') as F'.
    destruct (arrows w A). apply renewed_near; auto.
    + apply (approx_box m (from (-1) w)), F.
    + pose proof (approx_box m' (from (-1) v) (F' (-1)%Z)) as B. unfold Histories.from at 1 in B.
      rewrite <- (H (-1 + 0)%Z) in B by lia. exact B.
    + apply approx_box, A.
    + rewrite (H 0%Z) by lia. apply approx_box, A'.
    + apply (approx_box m (from 1 w)), F.
    + pose proof (approx_box m' (from 1 v) (F' 1%Z)) as B. unfold Histories.from at 1 in B.
      rewrite <- (H (1 + 0)%Z) in B by lia. exact B.
    + apply IH; auto; [apply agree_from; auto; lia|lia|lia].
    + apply IH; auto; [intros j J; apply H; lia|lia|lia].
    + apply IH; auto; [apply agree_from; auto; lia|lia|lia].
Qed.

Lemma rate_vanishes eps : 0 < eps -> exists n, k ^ n * e0 < eps /\ c * (k ^ n * e0) < eps.
Proof.
  intros E. assert (c0 : 0 < c) by lra.
  assert (M : 0 < e0 * (1 + c)) by (apply Rmult_lt_0_compat; lra).
  assert (D : 0 < eps / (e0 * (1 + c))) by (apply Rdiv_lt_0_compat; lra).
  destruct (pow_lt_1_zero k ltac:(rewrite Rabs_pos_eq; lra) _ D) as [n H']. exists n.
  specialize (H' n (le_n n)). rewrite Rabs_pos_eq in H' by (apply pow_le; lra).
  apply Rmult_lt_compat_r with (r := e0 * (1 + c)) in H'; [|lra].
  replace (eps / (e0 * (1 + c)) * (e0 * (1 + c))) with eps in H' by (field; split; lra).
  assert (T : 0 <= k ^ n * e0) by (apply Rmult_le_pos; [apply pow_le|]; lra).
  assert (0 <= c * (k ^ n * e0)) by (apply Rmult_le_pos; lra). lra.
Qed.

(* The limit, in coordinates, and how near it is. *)
Definition limit (w : history) : R * R :=
  (real (Lim_seq (fun n => fst (approx n w))), real (Lim_seq (fun n => snd (approx n w)))).

Lemma cauchy (f : nat -> R) : (forall eps, 0 < eps -> exists n, forall m m', (n <= m)%nat -> (n <= m')%nat ->
  Rabs (f m - f m') < eps) -> is_lim_seq f (real (Lim_seq f)).
Proof.
  intros H. apply Lim_seq_correct', ex_lim_seq_cauchy_corr. intros eps.
  destruct (H eps (cond_pos eps)) as [n Hn]. exists n. auto.
Qed.

Lemma limit_is w : allowed w ->
  is_lim_seq (fun n => fst (approx n w)) (fst (limit w)) /\ is_lim_seq (fun n => snd (approx n w)) (snd (limit w)).
Proof.
  intros A. split; apply cauchy; intros eps E; destruct (rate_vanishes eps E) as (n & H1 & H2); exists n; intros m m' M M';
    destruct (approx_near n w w m m' A A ltac:(auto) M M'); simpl in *; lra.
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

Lemma limit_near n w z : allowed w -> (forall m, (n <= m)%nat -> near (k ^ n * e0) (approx m w) z) ->
  near (k ^ n * e0) (limit w) z.
Proof.
  intros A H. destruct (limit_is w A) as [L1 L2].
  split; [apply (lim_close _ _ _ _ n L1)|apply (lim_close _ _ _ _ n L2)]; intros m M; apply (H m M).
Qed.

Lemma limit_close n w v : allowed w -> allowed v -> (forall j, (Z.abs j <= Z.of_nat n)%Z -> w j = v j) ->
  near (k ^ n * e0) (limit w) (limit v).
Proof.
  intros A A' H. apply limit_near; auto. intros m M. apply near_sym, limit_near; auto.
  intros m' M'. apply near_sym, approx_near; auto.
Qed.

Lemma limit_box w : allowed w -> box (w 0%Z) (limit w).
Proof.
  intros A. destruct (limit_is w A) as [L1 L2].
  assert (C : forall (f : nat -> R) (l a b : R), is_lim_seq f l -> (forall n, a <= f n <= b) -> a <= l <= b).
  { intros f l a b L Hf. split.
    - apply (is_lim_seq_le (fun _ => a) f a l); auto using is_lim_seq_const. apply Hf.
    - apply (is_lim_seq_le f (fun _ => b) l b); auto using is_lim_seq_const. apply Hf. }
  split; (eapply C; [eassumption|intros n; apply (approx_box n w A)]).
Qed.

Lemma same z z' : (forall n, near (k ^ n * e0) z z') -> z = z'.
Proof.
  intros H. assert (D : forall a b, (forall n, Rabs (a - b) <= k ^ n * e0 \/ Rabs (a - b) <= c * (k ^ n * e0)) -> a = b).
  { intros a b G. destruct (Req_dec a b) as [|D]; auto. exfalso.
    assert (D' : 0 < Rabs (a - b)) by (apply Rabs_pos_lt; lra).
    destruct (rate_vanishes _ D') as (n & H1 & H2). destruct (G n); lra. }
  destruct z, z'. f_equal; apply D; intros n; destruct (H n); auto.
Qed.

(* An orbit, in coordinates. *)
Definition tour (w : history) (a : Z -> R * R) : Prop := forall n, box (w n) (a n) /\
  a (n + 1)%Z = (P (w n) (w (n + 1)%Z) (a n), Q (w n) (w (n + 1)%Z) (a n)).

Lemma tour_from w a n : tour w a -> tour (from n w) (fun j => a (n + j)%Z).
Proof. intros T m. unfold Histories.from. destruct (T (n + m)%Z) as [B E]. rewrite Z.add_assoc. auto. Qed.

Lemma tour_renewed w a : allowed w -> tour w a ->
  a 0%Z = renewed (w (-1)%Z) (w 0%Z) (w 1%Z) (a (-1)%Z) (a 0%Z) (a 1%Z).
Proof.
  intros A T. destruct (T (-1)%Z) as [B E], (T 0%Z) as [B' E'], (arrows w A) as [A1 A2]. simpl in E, E'.
  unfold renewed. rewrite (solve_unique (w 0%Z) (w 1%Z) (fst (a 0%Z))); auto; try apply B';
    [|rewrite E', <- surjective_pairing; reflexivity].
  rewrite (solve_unique (w (-1)%Z) (w 0%Z) (fst (a (-1)%Z))); auto; try apply B;
    [|rewrite E, <- surjective_pairing; reflexivity].
  rewrite <- (surjective_pairing (a (-1)%Z)), E. reflexivity.
Qed.

Lemma tour_near n : forall w a m, allowed w -> tour w a -> (n <= m)%nat -> near (k ^ n * e0) (approx m w) (a 0%Z).
Proof.
  induction n as [|n IH]; intros w a m A T M.
  - rewrite pow_O, Rmult_1_l. apply (box_near (w 0%Z)); [apply approx_box, A|apply T].
  - destruct m as [|m]; [lia|]. replace (k ^ S n * e0) with (k * (k ^ n * e0)) by (simpl; ring).
    rewrite (tour_renewed w a A T). cbn [approx]. destruct (arrows w A).
    pose proof (fun d => allowed_from d w A) as F. apply renewed_near; auto; try apply T; try (apply approx_box; auto; fail).
    + apply (approx_box m (from (-1) w)), F.
    + apply (approx_box m (from 1 w)), F.
    + apply (IH _ _ m (F (-1)%Z) (tour_from w a (-1) T)). lia.
    + apply (IH _ _ m A T). lia.
    + apply (IH _ _ m (F 1%Z) (tour_from w a 1 T)). lia.
Qed.

Lemma tour_limit w a : allowed w -> tour w a -> forall n, a n = limit (from n w).
Proof.
  intros A T n. symmetry. replace (a n) with (a (n + 0)%Z) by (f_equal; lia).
  apply same. intros j. apply limit_near; [apply allowed_from, A|]. intros m M.
  apply (tour_near j _ _ m (allowed_from n w A) (tour_from w a n T) M).
Qed.

Lemma from_from a b w : from a (from b w) = from (b + a) w.
Proof. apply functional_extensionality. intros j. unfold Histories.from. f_equal. lia. Qed.

Lemma from_0 w : from 0 w = w.
Proof. apply functional_extensionality. intros j. reflexivity. Qed.

(* The limit is a fixed point, so that it runs on. *)
Lemma limit_renewed w : allowed w ->
  limit w = renewed (w (-1)%Z) (w 0%Z) (w 1%Z) (limit (from (-1) w)) (limit w) (limit (from 1 w)).
Proof.
  intros A. pose proof (fun d => allowed_from d w A) as F. destruct (arrows w A) as [A1 A2].
  pose proof (limit_box (from (-1) w) (F (-1)%Z)) as Bb. pose proof (limit_box w A) as B0.
  pose proof (limit_box (from 1 w) (F 1%Z)) as B1.
  apply same. intros [|n].
  - rewrite pow_O, Rmult_1_l. apply (box_near (w 0%Z)); auto. apply renewed_box; auto.
  - apply limit_near; auto. intros [|m] M; [lia|]. replace (k ^ S n * e0) with (k * (k ^ n * e0)) by (simpl; ring).
    assert (H : forall v, allowed v -> near (k ^ n * e0) (approx m v) (limit v)).
    { intros v Av. apply near_sym, limit_near; auto. intros m' M'. apply approx_near; auto; lia. }
    cbn [approx]. apply renewed_near; auto.
    + apply (approx_box m (from (-1) w)), F.
    + apply approx_box, A.
    + apply (approx_box m (from 1 w)), F.
Qed.

Lemma limit_tour w : allowed w -> tour w (fun n => limit (from n w)).
Proof.
  intros A.
  assert (Runs : forall v, allowed v -> P (v 0%Z) (v 1%Z) (limit v) = fst (limit (from 1 v))).
  { intros v Av. destruct (arrows v Av) as [_ A2]. pose proof (limit_box _ (allowed_from 1 v Av)) as [B1 _].
    pose proof (limit_box v Av) as [_ B0]. destruct (solve_spec (v 0%Z) (v 1%Z) _ _ A2 B1 B0) as [_ E].
    pose proof (f_equal fst (limit_renewed v Av)) as G. cbn [fst renewed] in G.
    rewrite <- G, <- surjective_pairing in E. exact E. }
  assert (Step : forall v, allowed v -> limit (from 1 v) = (P (v 0%Z) (v 1%Z) (limit v), Q (v 0%Z) (v 1%Z) (limit v))).
  { intros v Av. rewrite (Runs v Av), (surjective_pairing (limit (from 1 v))) at 1. f_equal.
    pose proof (f_equal snd (limit_renewed _ (allowed_from 1 v Av))) as G. cbn [snd renewed] in G.
    rewrite from_from in G. change (1 + -1)%Z with 0%Z in G. rewrite from_0 in G. rewrite G.
    change (Q (v 0%Z) (v 1%Z) (solve (v 0%Z) (v 1%Z) (fst (limit (from 1 v))) (snd (limit v)), snd (limit v)) =
      Q (v 0%Z) (v 1%Z) (limit v)).
    destruct (arrows v Av) as [_ A2]. pose proof (limit_box v Av) as [Bx By].
    rewrite (solve_unique (v 0%Z) (v 1%Z) (fst (limit v))); auto; rewrite <- surjective_pairing; auto. }
  intros n. split.
  - pose proof (limit_box _ (allowed_from n w A)) as B. unfold Histories.from at 1 in B. rewrite Z.add_0_r in B. exact B.
  - pose proof (Step _ (allowed_from n w A)) as G. rewrite from_from in G. unfold Histories.from at 2 3 5 6 in G.
    rewrite Z.add_0_r in G. exact G.
Qed.

(* Orbits and their coordinates. *)
Lemma chart_coordinates i z : boxed i z -> box i (coordinates i z) /\ chart i (coordinates i z) = z.
Proof. intros Z. apply boxes in Z. destruct Z as (a & B & ->). rewrite charted. auto. Qed.

Lemma orbit_tour w u : allowed w -> orbit w u -> tour w (fun n => coordinates (w n) (u n)).
Proof.
  intros A O n. destruct (O n) as [B M], (O (n + 1)%Z) as [B' _].
  destruct (chart_coordinates _ _ B) as [C E], (chart_coordinates _ _ B') as [C' E']. split; auto.
  apply N_PQ; auto. rewrite E, E'. exact M.
Qed.

Definition X (w : history) : R * R := chart (w 0%Z) (limit w).

Lemma X_at n w : X (from n w) = chart (w n) (limit (from n w)).
Proof. unfold X. unfold Histories.from at 1. rewrite Z.add_0_r. reflexivity. Qed.

Lemma orbit_X w u : allowed w -> (orbit w u <-> forall n, u n = X (from n w)).
Proof.
  intros A. split.
  - intros O n. destruct (O n) as [B _]. destruct (chart_coordinates _ _ B) as [_ E].
    rewrite X_at, <- (tour_limit w _ A (orbit_tour w u A O) n), E. reflexivity.
  - intros E n. pose proof (limit_tour w A) as T. destruct (T n) as [B F], (T (n + 1)%Z) as [B' _].
    rewrite !E, !X_at. split; [apply boxes; exists (limit (from n w)); auto|]. apply N_PQ; auto.
Qed.

Theorem crossed_theorem : followed_once letter arrow boxed N k.
Proof.
  split; [lra|]. exists X, (largest * e0). split; [apply orbit_X|split; [|split]].
  - intros w u m A O E. rewrite orbit_X in O by auto. intros n. rewrite !O.
    replace (from (m + n) w) with (from n w); auto. apply functional_extensionality. intros j.
    unfold Histories.from. rewrite <- (E (n + j)%Z). f_equal. lia.
  - intros w v u A A' O O' n. apply (disjoint _ _ _ _ (u n) (A n) (A' n)); [apply O|apply O'].
  - intros n w v A A' H. unfold X. rewrite <- (H 0%Z) by lia.
    replace (k ^ n * (largest * e0)) with (largest * (k ^ n * e0)) by ring.
    apply chart_near, limit_close; auto.
Qed.

(* Where no two states of the boxes have one image in them, a point knows its past. *)
Theorem known_past : (forall i j z z' y, boxed i z -> boxed j z' -> N z y -> N z' y -> z = z') ->
  (forall i z y y', boxed i z -> N z y -> N z y' -> y = y') -> one_to_one letter boxed N.
Proof.
  intros Back Det w v u t O O' E.
  assert (Up : forall n, u (Z.of_nat n) = t (Z.of_nat n)).
  { induction n as [|n IH]; [exact E|]. replace (Z.of_nat (S n)) with (Z.of_nat n + 1)%Z by lia.
    destruct (O (Z.of_nat n)) as [B M], (O' (Z.of_nat n)) as [_ M']. rewrite <- IH in M'. apply (Det _ _ _ _ B M M'). }
  assert (Down : forall n, u (- Z.of_nat n)%Z = t (- Z.of_nat n)%Z).
  { induction n as [|n IH]; [exact E|].
    destruct (O (- Z.of_nat (S n))%Z) as [B M], (O' (- Z.of_nat (S n))%Z) as [B' M'].
    replace (- Z.of_nat (S n) + 1)%Z with (- Z.of_nat n)%Z in M, M' by lia. rewrite <- IH in M'.
    apply (Back _ _ _ _ _ B B' M M'). }
  intros n. destruct (Z_le_gt_dec 0 n).
  - rewrite <- (Z2Nat.id n) by auto. apply Up.
  - replace n with (- Z.of_nat (Z.to_nat (- n)))%Z by lia. apply Down.
Qed.
End Crossed.
