(* Covering and expansion give the full shift on two symbols. No numbers, no impact map. *)
From Coq Require Import Reals Psatz Lia List.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Graph Paths.
Import ListNotations.
Open Scope R_scope.

Section Shift.
Variable N : R -> R -> Prop.
Variables A b0 a1 B : R.
Notation In_ := (In_ A b0 a1 B).
Notation itinerary := (itinerary N A b0 a1 B).
Notation stays := (stays N A B).
Notation visits := (Impact.visits N A b0 a1 B).
Notation cylinders := (cylinders N A b0 a1 B).
Notation full_shift := (full_shift N A b0 a1 B).

Variable f : R -> R.
Variable s : bool -> R.  (* 1 where f increases, -1 where it decreases *)
Variables m M : R.
Hypothesis order : A < b0 < a1 /\ a1 < B.
Hypothesis m_pos : 0 < m.
Hypothesis M_pos : 0 < M.
Hypothesis sign : forall i, s i = 1 \/ s i = -1.
Hypothesis N_f : forall i x y, In_ i x -> (N x y <-> y = f x).
Hypothesis expand : forall i x y, In_ i x -> In_ i y -> x <= y ->
  m * (y - x) <= s i * (f y - f x) <= M * (y - x).
Hypothesis smooth : forall i x, In_ i x -> continuity_pt f x.
Hypothesis cover : forall i y, A <= y <= B -> exists x, In_ i x /\ f x = y.
Hypothesis escape : forall x y, b0 < x < a1 -> N x y -> ~ A <= y <= B.

Lemma In_I i x : In_ i x -> A <= x <= B.
Proof. destruct i; unfold Impact.In_; lra. Qed.

Lemma sign_abs i z : Rabs (s i * z) = Rabs z.
Proof.
  destruct (sign i) as [-> | ->]; [f_equal; ring|]. rewrite <- (Rabs_Ropp z). f_equal; ring.
Qed.

Lemma expand_abs i x y : In_ i x -> In_ i y ->
  m * Rabs (x - y) <= Rabs (f x - f y) <= M * Rabs (x - y).
Proof.
  intros X Y. rewrite <- (sign_abs i (f x - f y)). destruct (Rle_dec x y) as [L|L].
  - pose proof (expand i x y X Y L) as H. rewrite (Rabs_minus_sym x).
    replace (s i * (f x - f y)) with (- (s i * (f y - f x))) by ring.
    rewrite Rabs_Ropp, !Rabs_pos_eq by nra. lra.
  - pose proof (expand i y x Y X ltac:(lra)). rewrite !Rabs_pos_eq by nra. lra.
Qed.

Definition g (i : bool) (y : R) : R := iota (fun x => In_ i x /\ f x = y).

Lemma g_spec i y : A <= y <= B -> In_ i (g i y) /\ f (g i y) = y.
Proof.
  intros Y. apply (iota_correct (V := R_CompleteNormedModule) (fun x => In_ i x /\ f x = y)).
  destruct (cover i y Y) as [x [X E]]. exists x. split; auto. intros z [Z F].
  destruct (expand_abs i x z X Z) as [L _]. rewrite E, F, Rminus_eq_0, Rabs_R0 in L.
  pose proof (Rabs_pos (x - z)). assert (Rabs (x - z) = 0) by nra.
  destruct (Req_dec (x - z) 0) as [|D]; [lra|]. apply Rabs_pos_lt in D. lra.
Qed.

Lemma g_contract i y z : A <= y <= B -> A <= z <= B -> Rabs (g i y - g i z) <= Rabs (y - z) / m.
Proof.
  intros Y Z. destruct (g_spec i y Y) as [P E]. destruct (g_spec i z Z) as [Q F].
  pose proof (expand_abs i _ _ P Q) as H. rewrite E, F in H.
  apply Rmult_le_reg_l with m; [lra|]. replace (m * (Rabs (y - z) / m)) with (Rabs (y - z))
    by (field; lra). lra.
Qed.

Lemma f_mono i x y : In_ i x -> In_ i y -> (x <= y <-> s i * f x <= s i * f y).
Proof.
  intros P Q. split; intros L.
  - pose proof (expand i x y P Q L). nra.
  - destruct (Rle_dec x y) as [|G]; auto. pose proof (expand i y x Q P ltac:(lra)). nra.
Qed.

(* The preimage of an interval in I0, or in I1, is an interval. *)
Lemma preimage i l r : A <= l <= B -> A <= r <= B -> l < r ->
  exists p q, In_ i p /\ In_ i q /\ p < q /\ q - p <= (r - l) / m /\
    forall x, In_ i x -> (l <= f x <= r <-> p <= x <= q).
Proof.
  intros L R LR.
  destruct (g_spec i l L) as [P El]. destruct (g_spec i r R) as [Q Er].
  pose proof (g_contract i l r L R) as W. rewrite (Rabs_minus_sym l), (Rabs_pos_eq (r - l)) in W by lra.
  apply Rabs_le_between in W. set (p := g i l) in *. set (q := g i r) in *.
  assert (F : forall x, In_ i x -> (p <= x <-> s i * f p <= s i * f x) /\
    (x <= q <-> s i * f x <= s i * f q) /\ (q <= x <-> s i * f q <= s i * f x) /\
    (x <= p <-> s i * f x <= s i * f p)) by (intros; repeat split; apply f_mono; auto).
  destruct (F p P) as (_ & Fp & Fq & _). rewrite El, Er in *.
  destruct (sign i) as [S1 | S1]; rewrite S1 in *; [exists p, q | exists q, p];
    (split; [auto|]; split; [auto|]; split; [|split; [lra|]]).
  1, 3: apply Rnot_le_lt; intros G; solve [apply Fq in G; lra | apply Fp in G; lra].
  all: intros x X; destruct (F x X) as (F1 & F2 & F3 & F4).
  - rewrite F1, F2. split; lra.
  - rewrite F3, F4. split; lra.
Qed.

(* The paper's claim H5. *)
Theorem preimages c d : A <= c -> c < d -> d <= B ->
  exists l0 r0 l1 r1, A <= l0 < r0 /\ r0 <= b0 /\ a1 <= l1 < r1 /\ r1 <= B /\
    forall x, A <= x <= B -> ((exists y, N x y /\ c <= y <= d) <-> l0 <= x <= r0 \/ l1 <= x <= r1).
Proof.
  intros C CD D.
  destruct (preimage false c d) as (l0 & r0 & L0 & R0 & O0 & _ & E0); try lra.
  destruct (preimage true c d) as (l1 & r1 & L1 & R1 & O1 & _ & E1); try lra.
  exists l0, r0, l1, r1. pose proof (N_f false) as N0. pose proof (N_f true) as N1.
  unfold Impact.In_ in *. do 4 (split; [lra|]). intros x X. split.
  - intros (y & Nx & Y). destruct (Rle_dec x b0) as [G|G]; [|destruct (Rle_dec a1 x) as [H|H]].
    + left. apply N0 in Nx; [|lra]. apply E0; [lra|]. subst y; auto.
    + right. apply N1 in Nx; [|lra]. apply E1; [lra|]. subst y; auto.
    + exfalso. apply (escape x y); auto; lra.
  - intros [Y | Y]; exists (f x); (split; [|first [apply E0; lra | apply E1; lra]]).
    + apply N0; [lra | auto].
    + apply N1; [lra | auto].
Qed.

Hypothesis m_gt_1 : 1 < m.

Lemma power n : 0 < m ^ n /\ forall c, c / m ^ S n = c / m ^ n / m.
Proof.
  assert (0 < m ^ n) by (apply pow_lt; lra). split; auto. intros c. simpl. field. lra.
Qed.

Lemma small c eps : 0 < eps -> exists n, c / m ^ n < eps.
Proof.
  intros E. destruct (Pow_x_infinity m ltac:(rewrite Rabs_pos_eq; lra) (c / eps + 1)) as [n H].
  exists n. specialize (H n (le_n n)). destruct (power n) as [P _]. rewrite Rabs_pos_eq in H by lra.
  apply Rmult_lt_reg_r with (m ^ n); auto. replace (c / m ^ n * m ^ n) with c by (field; lra).
  replace c with (eps * (c / eps)) by (field; lra). apply Rmult_lt_compat_l; lra.
Qed.

Lemma vanish d c : (forall n, Rabs d <= c / m ^ n) -> d = 0.
Proof.
  intros H. destruct (Req_dec d 0) as [|D]; auto. apply Rabs_pos_lt in D.
  destruct (small c _ D) as [n L]. specialize (H n). lra.
Qed.

(* The orbits of words that agree in n letters. *)
Definition along (w : word) (u : nat -> R) : Prop := forall k, In_ (w k) (u k) /\ N (u k) (u (S k)).

Lemma near n : forall w w' u v, (forall k, (k < n)%nat -> w k = w' k) -> along w u -> along w' v ->
  Rabs (u O - v O) <= (B - A) / m ^ n.
Proof.
  induction n; intros w w' u v E U V.
  - pose proof (In_I _ _ (proj1 (U O))). pose proof (In_I _ _ (proj1 (V O))).
    replace ((B - A) / m ^ 0) with (B - A) by (simpl; field). apply Rabs_le. lra.
  - specialize (IHn (shift w) (shift w') (fun k => u (S k)) (fun k => v (S k))
      ltac:(intros k K; apply E; lia) (fun k => U (S k)) (fun k => V (S k))). cbv beta in IHn.
    destruct (U O) as [U0 U1], (V O) as [V0 V1]. rewrite <- (E O) in V0 by lia.
    rewrite (proj1 (N_f _ _ _ U0) U1), (proj1 (N_f _ _ _ V0) V1) in IHn.
    pose proof (expand_abs _ _ _ U0 V0) as [H _]. rewrite (proj2 (power n)).
    set (e := (B - A) / m ^ n) in *. apply Rmult_le_reg_l with m; [lra|]. replace (m * (e / m)) with e by (field; lra). lra.
Qed.

(* A word is a path of the graph with two cells and all arrows. *)
Notation cells := [(A, b0); (a1, B)].
Notation code i := (if i : bool then 1%nat else 0%nat).

Lemma spanned i : spans f (left cells (code i)) (right cells (code i)) A B.
Proof.
  assert (E : In_ i (left cells (code i)) /\ In_ i (right cells (code i))) by (unfold Impact.In_, left, right; destruct i; simpl; lra).
  destruct E as [L R]. destruct (cover i A) as (x & X & Ex); [lra|]. destruct (cover i B) as (y & Y & Ey); [lra|].
  assert (O : forall z, In_ i z -> left cells (code i) <= z <= right cells (code i)) by (intros z Z; destruct i; exact Z).
  pose proof (proj1 (f_mono i _ _ L X) ltac:(apply O, X)). pose proof (proj1 (f_mono i _ _ Y R) ltac:(apply O, Y)).
  pose proof (proj1 (f_mono i _ _ L Y) ltac:(apply O, Y)). pose proof (proj1 (f_mono i _ _ X R) ltac:(apply O, X)).
  unfold spans. destruct (sign i) as [S | S]; rewrite S in *; lra.
Qed.

Lemma exists_X w : exists x, itinerary x w.
Proof.
  set (arrows := [(0, 0); (0, 1); (1, 0); (1, 1)]%nat).
  assert (Is : forall i j, arrow arrows i j -> exists c d : bool, i = code c /\ j = code d).
  { intros i j [E|[E|[E|[E|[]]]]]; injection E as <- <-;
      [exists false, false|exists false, true|exists true, false|exists true, true]; auto. }
  destruct (orbit f cells arrows) with (w := fun n => code (w n)) as (x & H).
  - intros i j C. destruct (Is i j C) as ([] & [] & -> & ->); unfold left, right; simpl; lra.
  - intros i j x C X. destruct (Is i j C) as (c & _ & -> & _). apply (smooth c). destruct c; exact X.
  - intros i j C. destruct (Is i j C) as (c & d & -> & ->). pose proof (spanned c) as S.
    unfold spans in *. destruct d; unfold left, right in *; simpl in *; lra.
  - intros n. unfold arrow. destruct (w n), (w (S n)); simpl; auto.
  - exists x, (fun n => iter f n x). split; [reflexivity|]. intros n.
    assert (I : In_ (w n) (iter f n x)) by (specialize (H n); destruct (w n); exact H). split; [exact I|]. apply (N_f _ _ _ I). reflexivity.
Qed.

Definition X (w : word) : R := iota (fun x => itinerary x w).

Lemma X_orbit w : exists u, u O = X w /\ along w u.
Proof.
  apply (iota_correct (V := R_CompleteNormedModule) (fun x => itinerary x w)). destruct (exists_X w) as (x & u & <- & U).
  exists (u O). split; [exists u; auto|]. intros y (v & <- & V). apply Rminus_diag_uniq, (vanish _ (B - A)). intros n.
  apply (near n w w); auto.
Qed.

Lemma X_close n w w' : (forall k, (k < n)%nat -> w k = w' k) -> Rabs (X w - X w') <= (B - A) / m ^ n.
Proof. intros E. destruct (X_orbit w) as (u & <- & U), (X_orbit w') as (v & <- & V). apply (near n w w'); auto. Qed.

Lemma itinerary_X x w : itinerary x w -> x = X w.
Proof.
  intros (u & <- & U). destruct (X_orbit w) as (v & <- & V). apply Rminus_diag_uniq, (vanish _ (B - A)). intros n.
  apply (near n w w); auto.
Qed.

Lemma X_itinerary w : itinerary (X w) w.
Proof. apply X_orbit. Qed.

Lemma X_In w : In_ (w O) (X w).
Proof. destruct (X_orbit w) as (u & <- & U). apply U. Qed.

Lemma X_N w : N (X w) (X (shift w)).
Proof.
  destruct (X_orbit w) as (u & E & U). rewrite <- E. replace (X (shift w)) with (u 1%nat); [apply U|].
  apply itinerary_X. exists (fun n => u (S n)). split; [reflexivity|]. intros n. apply U.
Qed.

Lemma X_f w : f (X w) = X (shift w).
Proof. symmetry. apply (N_f (w O)); [apply X_In|apply X_N]. Qed.

Lemma stays_X x : stays x -> exists w, x = X w.
Proof.
  intros [u [E H]].
  exists (fun n => if Rle_dec (u n) b0 then false else true).
  apply itinerary_X. exists u. split; auto. intros n. destruct (H n) as [I Nn]. split; auto.
  destruct (Rle_dec (u n) b0) as [L|L]; unfold Impact.In_; [lra|].
  destruct (Rle_dec a1 (u n)) as [G|G]; [lra|].
  exfalso. apply (escape (u n) (u (S n))); auto; [lra|]. apply H.
Qed.

Lemma X_apart n : forall w w', (forall k, (k < n)%nat -> w k = w' k) -> w n <> w' n ->
  (a1 - b0) / M ^ n <= Rabs (X w - X w').
Proof.
  induction n; intros w w' H D.
  - simpl. replace ((a1 - b0) / 1) with (a1 - b0) by field.
    pose proof (X_In w) as P. pose proof (X_In w') as Q.
    destruct (w O), (w' O); try congruence; unfold Impact.In_ in P, Q.
    + rewrite Rabs_pos_eq; lra.
    + rewrite Rabs_minus_sym, Rabs_pos_eq; lra.
  - assert (0 < M ^ n) by (apply pow_lt; auto).
    assert (IH : (a1 - b0) / M ^ n <= Rabs (X (shift w) - X (shift w'))).
    { apply IHn; auto. intros k K. apply (H (S k)). lia. }
    rewrite <- !X_f in IH. pose proof (X_In w) as P. pose proof (X_In w') as Q.
    rewrite <- (H O) in Q by lia. pose proof (expand_abs _ _ _ P Q) as [_ U].
    apply Rmult_le_reg_l with M; auto.
    replace (M * ((a1 - b0) / M ^ S n)) with ((a1 - b0) / M ^ n) by (simpl; field; lra). lra.
Qed.

Lemma X_injective w w' : X w = X w' <-> forall k, w k = w' k.
Proof.
  split; intros H.
  - assert (G : forall n k, (k < n)%nat -> w k = w' k).
    { induction n; intros k K; [lia|].
      destruct (Nat.eq_dec k n) as [->|]; [|apply IHn; lia].
      destruct (Bool.bool_dec (w n) (w' n)) as [|D]; auto. exfalso.
      pose proof (X_apart n w w' IHn D) as P. rewrite H, Rminus_eq_0, Rabs_R0 in P.
      assert (0 < (a1 - b0) / M ^ n) by (apply Rdiv_lt_0_compat; [lra | apply pow_lt; auto]).
      lra. }
    intros k. apply (G (S k)). lia.
  - apply Rminus_diag_uniq, (vanish _ (B - A)). intros n. apply X_close. auto.
Qed.

Theorem shift_theorem : full_shift m M.
Proof.
  exists X. split; [|split; [|split; [|split; [|split]]]].
  - intros x w. split; [apply itinerary_X|]. intros ->. apply X_itinerary.
  - intros x. split; [apply stays_X|]. intros [w ->].
    destruct (X_itinerary w) as [u [E H]]. exists u. split; auto. intros n.
    destruct (H n). split; auto. eapply In_I; eauto.
  - apply X_injective.
  - apply X_N.
  - apply X_close.
  - apply X_apart.
Qed.

Lemma visits_S n x w : visits (S (S n)) x w <-> In_ (w O) x /\ visits (S n) (f x) (shift w).
Proof.
  split.
  - intros (u & <- & P & Q). assert (P0 := P O ltac:(lia)). split; auto.
    exists (fun k => u (S k)). split; [|split].
    + apply (N_f _ _ _ P0), Q. lia.
    + intros k K. apply (P (S k)). lia.
    + intros k K. apply (Q (S k)). lia.
  - intros (P0 & u & E & P & Q).
    exists (fun k => match k with O => x | S k => u k end). split; [auto|split].
    + intros [|k] K; auto. apply (P k). lia.
    + intros [|k] K; [|apply Q; lia]. apply (N_f _ _ _ P0). auto.
Qed.

Lemma visits_word n : forall x w w', visits n x w -> visits n x w' ->
  forall k, (k < n)%nat -> w k = w' k.
Proof.
  intros x w w' (u & U & P & Q) (v & V & P' & Q').
  assert (E : forall k, (k < n)%nat -> u k = v k).
  { induction k; intros K; [congruence|]. assert (Ik := IHk ltac:(lia)).
    rewrite (proj1 (N_f _ _ _ (P k ltac:(lia))) (Q k K)).
    rewrite (proj1 (N_f _ _ _ (P' k ltac:(lia))) (Q' k K)). congruence. }
  intros k K. pose proof (P k K) as H. pose proof (P' k K) as H'. rewrite (E k K) in H.
  unfold Impact.In_ in H, H'. destruct (w k), (w' k); auto; lra.
Qed.

Theorem cylinder_theorem : cylinders m.
Proof.
  split; [|apply visits_word]. intros n. induction n; intros w.
  - exists (if w O then a1 else A), (if w O then B else b0). split; [|split].
    + destruct (w O); lra.
    + simpl. destruct (w O); lra.
    + intros x. split.
      * intros (u & <- & P & _). specialize (P O ltac:(lia)). unfold Impact.In_ in P.
        destruct (w O); auto.
      * intros H. exists (fun _ => x). split; [auto|split; intros k K; [|lia]].
        replace k with O by lia. unfold Impact.In_. destruct (w O); auto.
  - destruct (IHn (shift w)) as (l & r & LR & D & V).
    assert (HI : forall z, l <= z <= r -> A <= z <= B).
    { intros z Z. apply V in Z. destruct Z as (u & <- & P & _).
      apply (In_I _ _ (P O ltac:(lia))). }
    destruct (preimage (w O) l r) as (p & q & P & Q & L & W & E);
      [apply HI; lra | apply HI; lra | auto |].
    exists p, q. split; [auto|split].
    { rewrite (proj2 (power n)). eapply Rle_trans; [apply W|].
      apply Rmult_le_compat_r; auto. apply Rlt_le, Rinv_0_lt_compat. lra. }
    intros x. rewrite visits_S, V. split.
    + intros [X Y]. apply E; auto.
    + intros Y. assert (X : In_ (w O) x) by (unfold Impact.In_ in *; destruct (w O); lra).
      split; auto. apply E; auto.
Qed.

End Shift.
