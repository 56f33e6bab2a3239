(* Theorems 3 and 4 of the paper, and measure zero, from the full shift alone. No numbers. *)
From Coq Require Import Reals Psatz Lia List Arith.Cantor Classical.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Chaos.
Import ListNotations.
Open Scope R_scope.

(* Words and numbers: the first n letters are the binary digits of one number below 2^n. *)
Definition tail (n : nat) (w : word) : word := fun k => w (n + k)%nat.
Definition rep (c p : nat) : word := fun k => Nat.testbit c (k mod p).

Lemma digits n : forall w : word, exists c, (c < 2 ^ n)%nat /\
  forall k, (k < n)%nat -> Nat.testbit c k = w k.
Proof.
  induction n; intros w. { exists O. split; simpl; lia. }
  destruct (IHn (shift w)) as [c [C D]]. exists (2 * c + Nat.b2n (w O))%nat. split.
  - simpl. destruct (w O); simpl; lia.
  - intros [|k] K.
    + destruct (w O); [apply Nat.testbit_odd_0|rewrite Nat.add_0_r; apply Nat.testbit_even_0].
    + change (w (S k)) with (shift w k). rewrite <- (D k) by lia. destruct (w O); simpl Nat.b2n.
      * apply Nat.testbit_odd_succ; lia.
      * rewrite Nat.add_0_r. apply Nat.testbit_even_succ; lia.
Qed.

Lemma digits_inj n c d : (c < 2 ^ n)%nat -> (d < 2 ^ n)%nat ->
  (forall k, (k < n)%nat -> Nat.testbit c k = Nat.testbit d k) -> c = d.
Proof.
  intros C D H. apply Nat.bits_inj. intros k. destruct (le_lt_dec n k); [|apply H; lia].
  rewrite <- (Nat.mod_small c (2 ^ n)), <- (Nat.mod_small d (2 ^ n)) by lia.
  rewrite !Nat.mod_pow2_bits_high; auto.
Qed.

Lemma periodic_mod n (w : word) : (0 < n)%nat -> (forall k, tail n w k = w k) ->
  forall k, w k = w (k mod n).
Proof.
  intros n0 H k. rewrite (Nat.div_mod k n) at 1 by lia.
  induction (k / n)%nat as [|q IH]; [f_equal; lia|]. rewrite <- IH, <- (H (n * q + k mod n)%nat).
  unfold tail. f_equal. lia.
Qed.

(* Diagonal: a word without a tail in a sequence T of words. *)
Lemma avoid (T : nat -> word) : exists w : word, forall q i, exists j, tail i w j <> T q j.
Proof.
  exists (fun n => let (q, i) := of_nat n in negb (T q (n - i)%nat)). intros q i.
  pose proof (to_nat_non_decreasing q i). exists (to_nat (q, i) - i)%nat. unfold tail.
  replace (i + (to_nat (q, i) - i))%nat with (to_nat (q, i)) by lia.
  rewrite cancel_of_to. destruct (T q _); discriminate.
Qed.

(* A word that contains all finite words: on its s-th diagonal the digits of the s-th pair. *)
Lemma everywhere : exists d : word, forall (w : word) n, exists i,
  forall k, (k < n)%nat -> tail i d k = w k.
Proof.
  exists (fun j => let (x, y) := of_nat j in Nat.testbit (fst (of_nat (x + y))) y). intros w n.
  destruct (digits n w) as [c [_ C]]. set (s := to_nat (c, n)).
  pose proof (to_nat_non_decreasing c n : (n + c <= s)%nat) as S.
  exists (to_nat (s, O)). intros k K. unfold tail.
  replace (to_nat (s, O) + k)%nat with (to_nat (s - k, k)%nat).
  - rewrite cancel_of_to. replace (s - k + k)%nat with s by lia. unfold s.
    rewrite cancel_of_to. apply C, K.
  - unfold to_nat. replace (k + (s - k))%nat with s by lia. replace (0 + s)%nat with s by lia. lia.
Qed.

(* The letter on which all words of a set agree. *)
Definition letter (P : word -> Prop) (n : nat) : bool :=
  if Rlt_dec 0 (iota (fun r => exists w, P w /\ r = if w n then 1 else 0)) then true else false.

Lemma letter_spec (P : word -> Prop) n w : P w -> (forall v, P v -> v n = w n) -> letter P n = w n.
Proof.
  intros Pw H. unfold letter.
  replace (iota _) with (if w n then 1 else 0); [destruct (w n), Rlt_dec; auto; lra|].
  set (Q := fun r : R => exists w, P w /\ r = if w n then 1 else 0).
  destruct (iota_correct (V := R_CompleteNormedModule) Q) as [v [Pv E]].
  - exists (if w n then 1 else 0). split; [exists w; auto|].
    intros r [v [Pv ->]]. rewrite (H v Pv). auto.
  - etransitivity; [|symmetry; exact E]. rewrite (H v Pv). auto.
Qed.

Lemma vanishing m c eps : 1 < m -> 0 <= c -> 0 < eps -> exists n, c / m ^ n < eps.
Proof.
  intros m1 c0 E. destruct (Pow_x_infinity m ltac:(rewrite Rabs_pos_eq; lra) ((c + 1) / eps)) as [n H].
  exists n. specialize (H n (le_n n)). assert (P : 0 < m ^ n) by (apply pow_lt; lra).
  rewrite Rabs_pos_eq in H by lra. apply Rmult_lt_reg_r with (m ^ n); auto.
  replace (c / m ^ n * m ^ n) with c by (field; lra).
  apply Rge_le, Rmult_le_compat_l with (r := eps) in H; [|lra].
  replace (eps * ((c + 1) / eps)) with (c + 1) in H by (field; lra). lra.
Qed.

Lemma NoDup_map (T U : Type) (f : T -> U) l : NoDup l ->
  (forall x y, In x l -> In y l -> f x = f y -> x = y) -> NoDup (map f l).
Proof.
  induction 1 as [|x l Nx Nl IH]; intros I; simpl; constructor.
  - rewrite in_map_iff. intros [y [E Y]]. apply Nx. rewrite (I x y); simpl; auto.
  - apply IH. intros; apply I; simpl; auto.
Qed.

(* What is asked of a set of words, that Theorems 3 and 4 hold of their points. *)
Record ample (W : word -> Prop) : Prop := {
  am_limit : forall w, (forall n, exists v, W v /\ forall k, (k <= n)%nat -> w k = v k) -> W w;
  am_tail : forall n w, W w -> W (tail n w);
  am_period : forall n, (0 < n)%nat -> exists w j, W w /\ (forall k, w (n + k)%nat = w k) /\
    forall k, (0 < k < n)%nat -> w (k + j)%nat <> w j;
  am_avoid : forall T : nat -> word, exists w, W w /\ forall q i, exists j, tail i w j <> T q j;
  am_dense : exists d, W d /\ forall w n, W w -> exists i, forall k, (k < n)%nat -> tail i d k = w k;
  am_other : forall w n, W w -> exists v j, W v /\ v j <> w j /\ forall k, (k < n)%nat -> v k = w k
}.

Lemma ample_all : ample (fun _ => True).
Proof.
  split; auto.
  - intros n n0. exists (fun k => Nat.eqb (k mod n) 0), O. split; [auto|split].
    + intros k. f_equal. rewrite Nat.add_mod, Nat.mod_same, Nat.add_0_l, Nat.mod_mod; lia.
    + intros k K. rewrite Nat.add_0_r, (Nat.mod_small k), Nat.mod_0_l by lia. destruct k; [lia|discriminate].
  - intros T. destruct (avoid T) as [w H]. eauto.
  - destruct everywhere as [d D]. eauto.
  - intros w n _. exists (fun k => if Nat.eqb k n then negb (w k) else w k), n. split; [auto|split].
    + rewrite Nat.eqb_refl. destruct (w n); discriminate.
    + intros k K. destruct (Nat.eqb_spec k n); auto. lia.
Qed.

Section Consequences.
Variable N : R -> R -> Prop.
Variables A b0 a1 B m M : R.
Hypothesis order : A < b0 < a1 /\ a1 < B.
Hypothesis m_gt_1 : 1 < m.
Hypothesis M_ge_1 : 1 <= M.
Hypothesis det : forall x y z, N x y -> N x z -> y = z.
Notation iterate := (iterate N).

Lemma iterate_det n : forall x y z, iterate n x y -> iterate n x z -> y = z.
Proof.
  induction n; simpl; intros x y z; [congruence|]. intros (u & U & Y) (v & V & Z).
  rewrite (det _ _ _ U V) in Y. eauto.
Qed.

Section Words.
Variable X : word -> R.
Variable W : word -> Prop.
Hypothesis W_ample : ample W.
Variable L : R -> Prop.
Hypothesis L_X : forall x, L x <-> exists w, W w /\ x = X w.
Hypothesis X_in : forall w, A <= X w <= B.
Hypothesis X_inj : forall w w', X w = X w' <-> forall k, w k = w' k.
Hypothesis X_N : forall w, N (X w) (X (shift w)).
Hypothesis close : forall n w w', (forall k, (k < n)%nat -> w k = w' k) ->
  Rabs (X w - X w') <= (B - A) / m ^ n.
Hypothesis apart : forall n w w', (forall k, (k < n)%nat -> w k = w' k) -> w n <> w' n ->
  (a1 - b0) / M ^ n <= Rabs (X w - X w').

Lemma X_L w : W w -> L (X w).
Proof. intros H. apply L_X. eauto. Qed.

Lemma iterate_X n : forall w y, iterate n (X w) y <-> y = X (tail n w).
Proof.
  induction n; intros w y; simpl. { split; intros H; subst; reflexivity. }
  split.
  - intros (z & Z & H). rewrite (det _ _ _ Z (X_N w)) in H. apply IHn in H. exact H.
  - intros H. exists (X (shift w)). split; [apply X_N|]. apply IHn. exact H.
Qed.

(* Points nearer than this share the first n + 1 letters. *)
Definition gap (n : nat) : R := (a1 - b0) / M ^ n.

Lemma gap_pos n : 0 < gap n.
Proof. apply Rdiv_lt_0_compat; [lra|]. apply pow_lt. lra. Qed.

Lemma share n w w' : Rabs (X w - X w') < gap n -> forall k, (k <= n)%nat -> w k = w' k.
Proof.
  intros H k. induction k as [k IH] using lt_wf_ind. intros K.
  destruct (Bool.bool_dec (w k) (w' k)) as [|D]; auto. exfalso.
  assert (G := apart k w w' ltac:(intros; apply IH; lia) D).
  assert (gap n <= (a1 - b0) / M ^ k); [|lra].
  apply Rmult_le_compat_l; [lra|]. apply Rinv_le_contravar; [apply pow_lt; lra|].
  apply Rle_pow; lra || lia.
Qed.

Lemma fixed_points n : (forall w, W w) -> (0 < n)%nat -> count L (fun x => iterate n x x) (2 ^ n).
Proof.
  intros All n0. exists (map (fun c => X (rep c n)) (seq 0 (2 ^ n))). split; [|split].
  - apply NoDup_map; [apply seq_NoDup|]. intros c d C D E. apply in_seq in C, D.
    apply (digits_inj n); try lia. intros k K. apply X_inj with (k := k) in E.
    unfold rep in E. rewrite Nat.mod_small in E; auto.
  - rewrite map_length. apply seq_length.
  - intros x. rewrite in_map_iff, L_X. split.
    + intros (c & <- & C). split; [eauto|]. apply iterate_X, X_inj. intros k. unfold tail, rep.
      f_equal. rewrite Nat.add_mod, Nat.mod_same, Nat.add_0_l, Nat.mod_mod; lia.
    + intros [(w & _ & ->) F]. apply iterate_X in F. destruct (digits n w) as (c & C & D).
      exists c. split; [|apply in_seq; lia]. apply X_inj. intros k. unfold rep.
      rewrite D by (apply Nat.mod_upper_bound; lia). symmetry. apply periodic_mod; auto.
      intros j. symmetry. apply X_inj, F.
Qed.

Lemma least_periods n : (0 < n)%nat -> exists x, L x /\ period N n x.
Proof.
  intros n0. destruct (am_period _ W_ample n n0) as (w & j & Ww & P & D). exists (X w).
  split; [apply X_L, Ww|split; [auto|split; [apply iterate_X, X_inj; intros k; symmetry; apply P|]]].
  intros k K H. apply iterate_X in H. apply (D k K). symmetry. apply (proj1 (X_inj _ _) H).
Qed.

(* The periodic words, and those of the orbits of a sequence: a word without these as a tail. *)
Definition orbits_of (e : nat -> R) (q : nat) : word := let (a, b) := of_nat q in let (c, d) := of_nat b in
  match a with O => rep c d | S _ => letter (fun w => iterate d (e c) (X w)) end.

Lemma avoids_orbits e w : (forall q i, exists j, tail i w j <> orbits_of e q j) ->
  nonperiodic N (X w) /\ forall k, ~ same_orbit N (X w) (e k).
Proof.
  intros H. split.
  - intros (i & n & y & n0 & I & P). apply iterate_X in I. subst y. apply iterate_X in P.
    assert (Q := proj1 (X_inj _ _) P). destruct (digits n (tail i w)) as (c & _ & C).
    destruct (H (to_nat (O, to_nat (c, n))) i) as [j J]. apply J. unfold orbits_of.
    rewrite !cancel_of_to. unfold rep. rewrite C by (apply Nat.mod_upper_bound; lia).
    apply (periodic_mod n (tail i w)); auto.
  - intros k (i & j & z & I & J). apply iterate_X in I. subst z.
    destruct (H (to_nat (1%nat, to_nat (k, j))) i) as [l G]. apply G. unfold orbits_of.
    rewrite !cancel_of_to. symmetry. apply letter_spec; auto. intros v V.
    apply X_inj. apply (iterate_det _ _ _ _ V J).
Qed.

Lemma uncountable (e : nat -> R) :
  exists x, L x /\ nonperiodic N x /\ forall k, ~ same_orbit N x (e k).
Proof. destruct (am_avoid _ W_ample (orbits_of e)) as (w & Ww & H). exists (X w). split; [apply X_L, Ww|apply (avoids_orbits e w H)]. Qed.

Lemma dense_orbit : exists x, L x /\ forall y eps, L y -> 0 < eps ->
  exists n z, iterate n x z /\ L z /\ Rabs (z - y) < eps.
Proof.
  destruct (am_dense _ W_ample) as (d & Wd & D). exists (X d). split; [apply X_L, Wd|]. intros y eps Y E.
  apply L_X in Y. destruct Y as (w & Ww & ->). destruct (vanishing m (B - A) eps) as [n V]; try lra.
  destruct (D w n Ww) as [i I]. exists i, (X (tail i d)).
  split; [apply iterate_X; auto|split; [apply X_L, am_tail; auto|]]. pose proof (close n _ _ I). lra.
Qed.

Lemma closed : closed_set L.
Proof.
  intros z Z. apply NNPP. intros H.
  assert (near : forall e, 0 < e -> exists w, W w /\ Rabs (X w - z) < e).
  { intros e E. apply NNPP. intros G. apply H. exists (mkposreal e E). intros y Y S. apply G.
    apply L_X in S. destruct S as (w & Ww & ->). eauto. }
  set (P := fun n w => Rabs (X w - z) < gap n / 2). set (w := fun n => letter (P n) n).
  assert (agree : forall n v, P n v -> forall k, (k <= n)%nat -> w k = v k).
  { intros n v V k K. destruct (near (gap k / 2)) as (u & _ & U); [pose proof (gap_pos k); lra|].
    assert (same : forall j a b, P j a -> P j b -> forall i, (i <= j)%nat -> a i = b i).
    { intros j a b Pa Pb. apply share. unfold P in Pa, Pb.
      replace (X a - X b) with ((X a - z) - (X b - z)) by ring.
      eapply Rle_lt_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    assert (Vk : P k v).
    { unfold P in *. eapply Rlt_le_trans; [apply V|]. unfold gap.
      apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; [lra|].
      apply Rinv_le_contravar; [apply pow_lt; lra|]. apply Rle_pow; lra || lia. }
    apply (letter_spec (P k)); auto. intros t Pt. apply (same k); auto. }
  assert (Ww : W w).
  { apply (am_limit _ W_ample). intros n. destruct (near (gap n / 2)) as (v & Wv & V); [pose proof (gap_pos n); lra|].
    exists v. split; [exact Wv|apply (agree n v V)]. }
  apply Z, L_X. exists w. split; [exact Ww|]. apply NNPP. intros D.
  assert (D' : 0 < Rabs (z - X w)) by (apply Rabs_pos_lt; lra).
  destruct (vanishing m (B - A) (Rabs (z - X w) / 2)) as [n V]; try lra.
  destruct (near (Rmin (gap n / 2) (Rabs (z - X w) / 2))) as (v & _ & G).
  { pose proof (gap_pos n). apply Rmin_pos; lra. }
  pose proof (Rmin_l (gap n / 2) (Rabs (z - X w) / 2)).
  pose proof (Rmin_r (gap n / 2) (Rabs (z - X w) / 2)).
  assert (C : Rabs (X w - X v) <= (B - A) / m ^ n).
  { apply close. intros k K. apply (agree n); [unfold P; lra|lia]. }
  assert (Rabs (z - X w) <= Rabs (X v - z) + Rabs (X w - X v)); [|lra].
  rewrite (Rabs_minus_sym (X v)), (Rabs_minus_sym (X w)).
  replace (z - X w) with ((z - X v) + (X v - X w)) by ring. apply Rabs_triang.
Qed.

Lemma perfect x eps : L x -> 0 < eps -> exists y, L y /\ y <> x /\ Rabs (y - x) < eps.
Proof.
  intros Lx E. apply L_X in Lx. destruct Lx as (w & Ww & ->). destruct (vanishing m (B - A) eps) as [n V]; try lra.
  destruct (am_other _ W_ample w n Ww) as (v & j & Wv & D & S). exists (X v). split; [apply X_L, Wv|split].
  - intros H. apply D, (proj1 (X_inj _ _) H).
  - eapply Rle_lt_trans; [apply (close n), S|apply V].
Qed.

Lemma no_interval x y : L x -> L y -> x < y -> exists z, x < z < y /\ ~ L z.
Proof.
  intros Lx Ly xy. apply NNPP. intros H.
  assert (all : forall z, x <= z <= y -> L z).
  { intros z Z. destruct (Req_dec z x) as [->|]; auto. destruct (Req_dec z y) as [->|]; auto.
    apply NNPP. intros G. apply H. exists z. split; [lra|auto]. }
  apply L_X in Lx. destruct Lx as (w & _ & Ex).
  assert (step : forall n z, x <= z <= y -> forall v, z = X v -> forall k, (k <= n)%nat -> w k = v k).
  { intros n. pose proof (gap_pos n) as gp.
    assert (G : forall i z, x <= z <= y -> z <= x + INR i * (gap n / 2) ->
      forall v, z = X v -> forall k, (k <= n)%nat -> w k = v k).
    { induction i as [|i IH]; intros z Zx Zi v Ev.
      - simpl in Zi. apply share. rewrite <- Ev, <- Ex, Rabs_minus_sym, Rabs_pos_eq; lra.
      - rewrite S_INR in Zi. set (z' := Rmax x (z - gap n / 2)).
        assert (Z' : x <= z' <= z /\ z - gap n / 2 <= z' /\ z' <= x + INR i * (gap n / 2)).
        { pose proof (Rmult_le_pos (INR i) (gap n / 2) (pos_INR i) ltac:(lra)).
          unfold z', Rmax. destruct Rle_dec; lra. }
        destruct (proj1 (L_X z') (all z' ltac:(lra))) as (u & _ & Eu). intros k K'.
        rewrite (IH z' ltac:(lra) ltac:(lra) u Eu k K'). apply (share n); auto.
        rewrite <- Eu, <- Ev, Rabs_minus_sym, Rabs_pos_eq; lra. }
    intros z Z. assert (H0 : 0 < gap n / 2 / (y - x)) by (apply Rdiv_lt_0_compat; lra).
    destruct (archimed_cor1 _ H0) as [q [Q q0]]. apply (G q z Z). apply lt_INR in q0. simpl in q0.
    apply Rmult_lt_compat_r with (r := INR q * (y - x)) in Q; [|apply Rmult_lt_0_compat; lra].
    replace (/ INR q * (INR q * (y - x))) with (y - x) in Q by (field; lra).
    replace (gap n / 2 / (y - x) * (INR q * (y - x))) with (INR q * (gap n / 2)) in Q
      by (field; lra). lra. }
  apply L_X in Ly. destruct Ly as (v & _ & Ey).
  assert (x = y); [|lra]. rewrite Ex, Ey. apply X_inj. intros k. apply (step k y); auto. lra.
Qed.

Lemma rich_X : rich N L.
Proof. split; [apply least_periods|split; [apply uncountable|apply dense_orbit]]. Qed.

Lemma cantor_X : cantor_set L.
Proof.
  split; [destruct (am_period _ W_ample 1) as (w & _ & Ww & _); [lia|exists (X w); apply X_L, Ww]|split; [|split; [apply perfect|apply no_interval]]].
  apply compact_P5; [apply closed|]. exists A, B. intros x Lx. apply L_X in Lx. destruct Lx as (w & _ & ->). auto.
Qed.

(* 2^n intervals of length 2 (B - A) / m^n cover the set. *)
Lemma null_X : 2 < m -> null L.
Proof.
  intros m2 eps E. destruct (vanishing (m / 2) (2 * (B - A)) eps) as [n V]; try lra.
  set (d := (B - A) / m ^ n).
  exists (map (fun c => (X (rep c n) - d, X (rep c n) + d)) (seq 0 (2 ^ n))). split; [|split].
  - intros i H. apply in_map_iff in H. destruct H as (c & <- & _). simpl.
    assert (0 < d) by (apply Rdiv_lt_0_compat, pow_lt; lra). lra.
  - intros x Lx. apply L_X in Lx. destruct Lx as (w & _ & ->). destruct (digits n w) as (c & C & D).
    exists (X (rep c n) - d, X (rep c n) + d). split; [apply in_map_iff; exists c; split; auto;
      apply in_seq; lia|]. simpl. apply Rcomplements.Rabs_le_between', close. intros k K.
    unfold rep. rewrite Nat.mod_small, D; auto.
  - rewrite map_map. simpl.
    assert (S : forall l, fold_right Rplus 0 (map (fun c => X (rep c n) + d - (X (rep c n) - d)) l)
      = INR (length l) * (2 * d)).
    { induction l; simpl fold_right; simpl length; rewrite ?S_INR; [simpl; ring|]. rewrite IHl. ring. }
    rewrite S, seq_length, pow_INR. replace (INR 2) with 2 by (simpl; ring).
    replace (2 ^ n * (2 * d)) with (2 * (B - A) / (m / 2) ^ n); auto. unfold d, Rdiv.
    rewrite Rpow_mult_distr, pow_inv by lra. field.
    split; apply pow_nonzero; lra.
Qed.
End Words.

(* What a full shift gives of the points of its words, and of all points that stay. *)
Lemma shift_words : full_shift N A b0 a1 B m M -> exists X, (forall x, stays N A B x <-> exists w, True /\ x = X w) /\
  (forall x w, itinerary N A b0 a1 B x w <-> x = X w) /\ (forall w, A <= X w <= B) /\
  (forall w w', X w = X w' <-> forall k, w k = w' k) /\ (forall w, N (X w) (X (shift w))) /\
  (forall n w w', (forall k, (k < n)%nat -> w k = w' k) -> Rabs (X w - X w') <= (B - A) / m ^ n) /\
  (forall n w w', (forall k, (k < n)%nat -> w k = w' k) -> w n <> w' n -> (a1 - b0) / M ^ n <= Rabs (X w - X w')).
Proof.
  intros (X & It & S & I & Nx & C & D). exists X. split; [|split; [exact It|split; [|auto]]].
  - intros x. rewrite S. split; [intros (w & E)|intros (w & _ & E)]; eauto.
  - intros w. destruct (proj2 (It _ _) eq_refl : itinerary N A b0 a1 B (X w) w) as (u & <- & H).
    destruct (H O) as [H0 _]. unfold In_ in H0. destruct (w O); lra.
Qed.

Hypothesis shifted : full_shift N A b0 a1 B m M.
Notation L := (stays N A B).

(* Theorem 3 of the paper. *)
Theorem chaos_theorem : chaos N L.
Proof.
  destruct (shift_words shifted) as (X & S & _ & In & I & Nx & C & D).
  split; [intros n n0; apply fixed_points with (X := X) (W := fun _ => True)|
    apply rich_X with (X := X) (W := fun _ => True)]; auto using ample_all.
Qed.

(* Theorem 4 of the paper. *)
Theorem cantor_theorem : cantor_set L.
Proof.
  destruct (shift_words shifted) as (X & S & _ & In & I & Nx & C & D).
  apply cantor_X with (X := X) (W := fun _ => True); auto using ample_all.
Qed.

(* Claim H10: slopes above 2 leave nothing of positive length. *)
Theorem null_theorem : 2 < m -> null L.
Proof. destruct (shift_words shifted) as (X & S & _ & _ & _ & _ & C & _). apply null_X with (X := X) (W := fun _ => True); auto. Qed.
End Consequences.

Lemma null_part (L L' : R -> Prop) : (forall x, L x -> L' x) -> null L' -> null L.
Proof.
  intros Sub H eps E. destruct (H eps E) as (l & O & C & S). exists l. split; [exact O|split; [|exact S]].
  intros x X. apply C, Sub, X.
Qed.

Lemma stays_part N A P B x : A <= P -> stays N P B x -> stays N A B x.
Proof. intros L (u & U & H). exists u. split; auto. intros n. destruct (H n). split; auto. lra. Qed.
