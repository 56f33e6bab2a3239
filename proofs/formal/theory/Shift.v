(* Covering and expansion give the full shift on two symbols. No numbers, no impact map. *)
From Coq Require Import Reals Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact.
Open Scope R_scope.

Section Shift.
Variable N : R -> R -> Prop.
Variables A b0 a1 B : R.
Notation In_ := (In_ A b0 a1 B).
Notation itinerary := (itinerary N A b0 a1 B).
Notation stays := (stays N A B).
Notation visits := (visits N A b0 a1 B).
Notation cylinders := (cylinders N A b0 a1 B).
Notation full_shift := (full_shift N A b0 a1 B).

Variable f : R -> R.
Variables m M : R.
Hypothesis order : A < b0 < a1 /\ a1 < B.
Hypothesis m_gt_1 : 1 < m.
Hypothesis M_pos : 0 < M.
Hypothesis N_f : forall i x y, In_ i x -> (N x y <-> y = f x).
Hypothesis expand : forall i x y, In_ i x -> In_ i y -> x <= y ->
  m * (y - x) <= f y - f x <= M * (y - x).
Hypothesis cover : forall i y, A <= y <= B -> exists x, In_ i x /\ f x = y.
Hypothesis escape : forall x y, b0 < x < a1 -> N x y -> ~ A <= y <= B.

Lemma In_I i x : In_ i x -> A <= x <= B.
Proof. destruct i; unfold Impact.In_; lra. Qed.

Lemma expand_abs i x y : In_ i x -> In_ i y ->
  m * Rabs (x - y) <= Rabs (f x - f y) <= M * Rabs (x - y).
Proof.
  intros X Y. destruct (Rle_dec x y) as [L|L].
  - pose proof (expand i x y X Y L).
    rewrite (Rabs_minus_sym x), (Rabs_minus_sym (f x)), !Rabs_pos_eq by nra. lra.
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

Lemma g_f i x : In_ i x -> A <= f x <= B -> g i (f x) = x.
Proof.
  intros X F. destruct (g_spec i (f x) F) as [G E].
  destruct (expand_abs i (g i (f x)) x G X) as [L _]. rewrite E, Rminus_eq_0, Rabs_R0 in L.
  pose proof (Rabs_pos (g i (f x) - x)). assert (Z : Rabs (g i (f x) - x) = 0) by nra.
  destruct (Req_dec (g i (f x) - x) 0) as [|D]; [lra|]. apply Rabs_pos_lt in D. lra.
Qed.

Lemma g_in i y : A <= y <= B -> A <= g i y <= B.
Proof. intros Y. apply (In_I i), g_spec; auto. Qed.

Lemma g_mono i y z : A <= y <= B -> A <= z <= B -> y <= z -> g i y <= g i z.
Proof.
  intros Y Z L. destruct (g_spec i y Y) as [P E]. destruct (g_spec i z Z) as [Q F].
  destruct (Rle_dec (g i y) (g i z)) as [|G]; auto.
  pose proof (expand i _ _ Q P ltac:(lra)). nra.
Qed.

Lemma g_contract i y z : A <= y <= B -> A <= z <= B -> Rabs (g i y - g i z) <= Rabs (y - z) / m.
Proof.
  intros Y Z. destruct (g_spec i y Y) as [P E]. destruct (g_spec i z Z) as [Q F].
  pose proof (expand_abs i _ _ P Q) as H. rewrite E, F in H.
  apply Rmult_le_reg_l with m; [lra|]. replace (m * (Rabs (y - z) / m)) with (Rabs (y - z))
    by (field; lra). lra.
Qed.

Fixpoint approx (n : nat) (w : word) : R :=
  match n with O => A | S n => g (w O) (approx n (shift w)) end.

Lemma approx_in n : forall w, A <= approx n w <= B.
Proof. induction n; intros w; simpl; [lra|]. apply g_in; auto. Qed.

Lemma approx_incr n : forall w, approx n w <= approx (S n) w.
Proof.
  induction n; intros w.
  - simpl. apply (g_in (w O) A). lra.
  - change (g (w O) (approx n (shift w)) <= g (w O) (approx (S n) (shift w))).
    apply g_mono; auto using approx_in.
Qed.

Definition X (w : word) : R := real (Lim_seq (fun n => approx n w)).

Lemma X_lim w : is_lim_seq (fun n => approx n w) (X w).
Proof.
  apply Lim_seq_correct'. apply (ex_finite_lim_seq_incr _ B).
  - intros n; apply approx_incr.
  - intros n; apply approx_in.
Qed.

Lemma X_in w : A <= X w <= B.
Proof.
  split.
  - apply (is_lim_seq_le (fun _ => A) (fun n => approx n w) A (X w)).
    intros n; apply approx_in. apply is_lim_seq_const. apply X_lim.
  - apply (is_lim_seq_le (fun n => approx n w) (fun _ => B) (X w) B).
    intros n; apply approx_in. apply X_lim. apply is_lim_seq_const.
Qed.

Lemma X_g w : X w = g (w O) (X (shift w)).
Proof.
  assert (L : is_lim_seq (fun n => approx (S n) w) (g (w O) (X (shift w)))).
  { apply is_lim_seq_spec. intros eps. pose proof (X_lim (shift w)) as H.
    apply is_lim_seq_spec in H. destruct (H eps) as [n0 Hn]. exists n0. intros n Ln.
    specialize (Hn n Ln). simpl.
    eapply Rle_lt_trans; [apply g_contract; [apply approx_in|apply X_in]|].
    eapply Rle_lt_trans; [|apply Hn].
    pose proof (Rabs_pos (approx n (shift w) - X (shift w))).
    apply Rmult_le_reg_l with m; [lra|].
    replace (m * (Rabs (approx n (shift w) - X (shift w)) / m))
      with (Rabs (approx n (shift w) - X (shift w))) by (field; lra). nra. }
  pose proof (is_lim_seq_incr_1 (fun n => approx n w) (X w)) as [I _].
  specialize (I (X_lim w)).
  pose proof (is_lim_seq_unique _ _ I) as E1. pose proof (is_lim_seq_unique _ _ L) as E2.
  rewrite E1 in E2. now inversion E2.
Qed.

Lemma X_In w : In_ (w O) (X w).
Proof. rewrite X_g. apply g_spec, X_in. Qed.

Lemma X_f w : f (X w) = X (shift w).
Proof. rewrite X_g at 1. apply g_spec, X_in. Qed.

Lemma X_N w : N (X w) (X (shift w)).
Proof. apply (N_f (w O)); [apply X_In|]. symmetry. apply X_f. Qed.

Fixpoint it (n : nat) (w : word) : word := match n with O => w | S n => shift (it n w) end.

Lemma it_at n : forall w k, it n w k = w (n + k)%nat.
Proof.
  induction n; intros w k; simpl; auto. unfold shift. rewrite IHn. f_equal. lia.
Qed.

Lemma X_itinerary w : itinerary (X w) w.
Proof.
  exists (fun n => X (it n w)). split; auto. intros n. split.
  - pose proof (X_In (it n w)) as H. rewrite it_at, Nat.add_0_r in H. auto.
  - apply X_N.
Qed.

Lemma near n : forall w u, (forall k, In_ (w k) (u k) /\ N (u k) (u (S k))) ->
  Rabs (u O - X w) <= (B - A) / m ^ n.
Proof.
  induction n; intros w u H.
  - simpl. pose proof (In_I _ _ (proj1 (H O))). pose proof (X_in w).
    replace ((B - A) / 1) with (B - A) by field. apply Rabs_le. lra.
  - destruct (H O) as [I0 N0]. assert (E := proj1 (N_f _ _ _ I0) N0).
    assert (I1 : A <= u 1%nat <= B) by apply (In_I _ _ (proj1 (H 1%nat))).
    specialize (IHn (shift w) (fun k => u (S k)) (fun k => H (S k))). simpl in IHn.
    rewrite X_g. rewrite <- (g_f (w O) (u O)), <- E by (rewrite <- ?E; auto).
    eapply Rle_trans; [apply g_contract; [auto|apply X_in]|].
    assert (0 < m ^ n) by (apply pow_lt; lra).
    replace ((B - A) / m ^ S n) with ((B - A) / m ^ n / m) by (simpl; field; lra).
    apply Rmult_le_compat_r; [|auto]. apply Rlt_le, Rinv_0_lt_compat. lra.
Qed.

Lemma vanish d c : (forall n, Rabs d <= c / m ^ n) -> d = 0.
Proof.
  intros H. destruct (Req_dec d 0) as [|D]; auto. apply Rabs_pos_lt in D. exfalso.
  assert (c0 : 0 < c) by (specialize (H O); simpl in H; lra).
  destruct (Pow_x_infinity m ltac:(rewrite Rabs_pos_eq; lra) (2 * c / Rabs d)) as [n Hn].
  specialize (Hn n (le_n n)). specialize (H n).
  assert (P : 0 < m ^ n) by (apply pow_lt; lra). rewrite Rabs_pos_eq in Hn by lra.
  assert (Rabs d * m ^ n <= c).
  { apply Rmult_le_compat_r with (r := m ^ n) in H; [|lra].
    replace (c / m ^ n * m ^ n) with c in H by (field; lra). lra. }
  apply Rge_le in Hn. apply Rmult_le_compat_l with (r := Rabs d) in Hn; [|lra].
  replace (Rabs d * (2 * c / Rabs d)) with (2 * c) in Hn by (field; lra). lra.
Qed.

Lemma itinerary_X x w : itinerary x w -> x = X w.
Proof.
  intros [u [<- H]]. apply Rminus_diag_uniq, (vanish _ (B - A)). intros n. apply near; auto.
Qed.

Lemma stays_X x : stays x -> exists w, x = X w.
Proof.
  intros [u [E H]].
  exists (fun n => if Rle_dec (u n) b0 then false else true).
  apply itinerary_X. exists u. split; auto. intros n. destruct (H n) as [I Nn]. split; auto.
  destruct (Rle_dec (u n) b0) as [L|L]; unfold Impact.In_; [lra|].
  destruct (Rle_dec a1 (u n)) as [G|G]; [lra|].
  exfalso. apply (escape (u n) (u (S n))); auto; [lra|]. apply H.
Qed.

Lemma X_close n : forall w w', (forall k, (k < n)%nat -> w k = w' k) ->
  Rabs (X w - X w') <= (B - A) / m ^ n.
Proof.
  induction n; intros w w' H.
  - simpl. pose proof (X_in w). pose proof (X_in w').
    replace ((B - A) / 1) with (B - A) by field. apply Rabs_le. lra.
  - rewrite (X_g w), (X_g w'), <- (H O) by lia.
    eapply Rle_trans; [apply g_contract; apply X_in|].
    assert (0 < m ^ n) by (apply pow_lt; lra).
    replace ((B - A) / m ^ S n) with ((B - A) / m ^ n / m) by (simpl; field; lra).
    apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|].
    apply IHn. intros k K. apply (H (S k)). lia.
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

Lemma f_mono i x y : In_ i x -> In_ i y -> (x <= y <-> f x <= f y).
Proof.
  intros P Q. split; intros L.
  - pose proof (expand i x y P Q L). nra.
  - destruct (Rle_dec x y) as [|G]; auto. pose proof (expand i y x Q P ltac:(lra)). nra.
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
    destruct (g_spec (w O) l (HI l ltac:(lra))) as [Gl El].
    destruct (g_spec (w O) r (HI r ltac:(lra))) as [Gr Er].
    exists (g (w O) l), (g (w O) r).
    assert (Lt : g (w O) l < g (w O) r).
    { destruct (Rlt_dec (g (w O) l) (g (w O) r)); auto.
      assert (f (g (w O) r) <= f (g (w O) l)) by (apply (proj1 (f_mono (w O) _ _ Gr Gl)); lra). lra. }
    split; [auto|split].
    + pose proof (expand (w O) _ _ Gl Gr ltac:(lra)) as [H _]. rewrite El, Er in H.
      assert (0 < m ^ n) by (apply pow_lt; lra).
      replace ((B - A) / m ^ S n) with ((B - A) / m ^ n / m) by (simpl; field; lra).
      apply Rmult_le_reg_l with m; [lra|].
      replace (m * ((B - A) / m ^ n / m)) with ((B - A) / m ^ n) by (field; lra). lra.
    + intros x. rewrite visits_S, V. split.
      * intros [P [Q Q']]. rewrite <- El in Q. rewrite <- Er in Q'.
        split; [apply (proj2 (f_mono (w O) _ _ Gl P)) | apply (proj2 (f_mono (w O) _ _ P Gr))]; auto.
      * intros [Q Q']. assert (P : In_ (w O) x).
        { unfold Impact.In_ in *. destruct (w O); lra. }
        split; auto. rewrite <- El at 1. rewrite <- Er at 1.
        split; [apply (proj1 (f_mono (w O) _ _ Gl P)) | apply (proj1 (f_mono (w O) _ _ P Gr))]; auto.
Qed.

End Shift.
