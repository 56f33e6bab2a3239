(* The number of paths of a graph, and the entropy of a map that follows them. No numbers. *)
From Coq Require Import Reals ZArith Psatz Lia List Bool.
From Oscillator Require Import Graph Paths.
Import ListNotations.
Open Scope R_scope.

Section Words.
Variable arrows : list (nat * nat).
Variable v : nat -> Z.                     (* weights *)

Definition successors (i : nat) : list nat := map snd (filter (fun a => fst a =? i)%nat arrows).

Lemma successor i j : In j (successors i) <-> In (i, j) arrows.
Proof.
  unfold successors. rewrite in_map_iff. split.
  - intros ([a b] & E & H). apply filter_In in H. destruct H as [H G]. apply Nat.eqb_eq in G. simpl in *. subst. auto.
  - intros H. exists (i, j). split; auto. apply filter_In. split; auto. apply Nat.eqb_refl.
Qed.

Lemma NoDup_successors i : NoDup arrows -> NoDup (successors i).
Proof.
  intros D. unfold successors. induction D as [|[a b] l N D IH]; simpl; [constructor|].
  destruct (Nat.eqb_spec a i) as [->|]; simpl; auto. constructor; auto. intros H.
  apply in_map_iff in H. destruct H as ([c e] & E & H). apply filter_In in H. destruct H as [H G].
  apply Nat.eqb_eq in G. simpl in *. subst. auto.
Qed.

(* The words of n + 1 letters from i along arrows to a letter of positive weight; their weight. *)
Fixpoint words (n i : nat) : list (list nat) :=
  match n with
  | O => if (v i =? 0)%Z then [] else [[i]]
  | S n => flat_map (fun j => map (cons i) (words n j)) (successors i)
  end.
Definition total (l : list Z) : Z := fold_right Z.add 0%Z l.
Fixpoint weight (n i : nat) : Z :=
  match n with O => v i | S n => total (map (weight n) (successors i)) end.

Definition word_path (l : list nat) : Prop := forall k, (S k < length l)%nat -> In (nth k l 0, nth (S k) l 0)%nat arrows.

Lemma words_are n : forall i l, In l (words n i) -> length l = S n /\ nth 0 l 0%nat = i /\ word_path l.
Proof.
  induction n as [|n IH]; intros i l; simpl.
  - destruct (v i =? 0)%Z; [intros []|]. intros [<-|[]]. repeat split. intros k H. simpl in H. lia.
  - rewrite in_flat_map. intros (j & J & H). apply in_map_iff in H. destruct H as (t & <- & H).
    destruct (IH j t H) as (L & Z & P). split; [simpl; congruence|]. split; auto.
    intros [|k] B; simpl in *; [rewrite Z; apply successor, J|apply P; lia].
Qed.

Lemma NoDup_prefixed (T : Type) (i : T) l : NoDup l -> NoDup (map (cons i) l).
Proof.
  induction 1 as [|a l N D IH]; simpl; constructor; auto. intros H. apply in_map_iff in H.
  destruct H as (b & E & H). congruence.
Qed.

Lemma NoDup_words n : NoDup arrows -> forall i, NoDup (words n i).
Proof.
  intros D. induction n as [|n IH]; intros i; simpl; [destruct (v i =? 0)%Z; repeat constructor; intros []|].
  pose proof (NoDup_successors i D) as S. induction S as [|j l N S IHl]; simpl; [constructor|].
  assert (A : forall w, In w (map (cons i) (words n j)) -> In w (flat_map (fun j => map (cons i) (words n j)) l) -> False).
  { intros w W V. apply in_map_iff in W. destruct W as (t & <- & W). apply in_flat_map in V.
    destruct V as (k & K & V). apply in_map_iff in V. destruct V as (u & E & V). injection E as E. subst u.
    apply words_are in W, V. destruct W as (_ & <- & _), V as (_ & V & _). rewrite V in N. auto. }
  pose proof (NoDup_prefixed _ i _ (IH j)) as P. revert P A. generalize (map (cons i) (words n j)).
  induction l0 as [|w t IHt]; simpl; intros P A; auto. inversion P; subst. constructor; [|apply IHt; auto; intros; eapply A; eauto].
  rewrite in_app_iff. intros [G|G]; [auto|]. apply (A w); auto.
Qed.

Lemma total_bound (T : Type) (g : T -> Z) (h : T -> nat) c l : (forall j, In j l -> (g j <= c * Z.of_nat (h j))%Z) ->
  (total (map g l) <= c * Z.of_nat (list_sum (map h l)))%Z.
Proof.
  induction l as [|j l IH]; simpl; intros H; [lia|]. specialize (IH (fun k K => H k (or_intror K))).
  specialize (H j (or_introl eq_refl)). nia.
Qed.

Lemma length_flat_map (S T : Type) (g : S -> list T) l :
  length (flat_map g l) = list_sum (map (fun j => length (g j)) l).
Proof. induction l; simpl; rewrite ?app_length; congruence. Qed.

Lemma count_words top : (forall i, 0 <= v i <= top)%Z -> forall n i, (weight n i <= top * Z.of_nat (length (words n i)))%Z.
Proof.
  intros B n. induction n as [|n IH]; intros i; simpl.
  - specialize (B i). destruct (Z.eqb_spec (v i) 0); simpl; lia.
  - rewrite length_flat_map.
    apply (total_bound _ (weight n) (fun j => length (map (cons i) (words n j)))).
    intros j _. rewrite map_length. auto.
Qed.

Variable p : nat.
Variable m : Z.
Hypothesis m_pos : (0 <= m)%Z.
Hypothesis grows : forall i, (m * v i <= weight p i)%Z.

Lemma weight_add n : forall i, (m * weight n i <= weight (n + p) i)%Z.
Proof.
  induction n as [|n IH]; intros i; simpl; auto.
  induction (successors i) as [|j l IHl]; simpl; [lia|]. specialize (IH j). rewrite Z.mul_add_distr_l. lia.
Qed.

Lemma growth q : forall i, (m ^ Z.of_nat q * v i <= weight (q * p) i)%Z.
Proof.
  induction q as [|q IH]; intros i; [change (m ^ Z.of_nat 0)%Z with 1%Z; simpl weight; lia|].
  pose proof (weight_add (q * p) i) as W. rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia. simpl Nat.mul.
  rewrite (Nat.add_comm p). specialize (IH i). rewrite <- Z.mul_assoc.
  assert (m * (m ^ Z.of_nat q * v i) <= m * weight (q * p) i)%Z by (apply Z.mul_le_mono_nonneg_l; auto). lia.
Qed.
End Words.

Section Followed.
Context {T : Type}.
Variable distance : T -> T -> R.
Hypothesis distance_0 : forall x, distance x x = 0.
Hypothesis distance_sym : forall x y, distance x y = distance y x.
Variable f : T -> T.
Variable cell : nat -> T -> Prop.
Variable arrows : list (nat * nat).
Notation arrow i j := (In (i, j) arrows).
Notation path := (path arrows).
Notation follows := (follows f cell).
Hypothesis once : NoDup arrows.
Hypothesis no_end : forall i j, arrow i j -> exists k, arrow j k.
Hypothesis followed : forall w, path w -> exists x, follows w x.
Variable delta : R.
Hypothesis delta_pos : 0 < delta.
Hypothesis apart : forall i i' j j' x y, arrow i i' -> arrow j j' -> cell i x -> cell j y -> i <> j ->
  delta <= distance x y.

(* A word, and then always the first arrow. *)
Definition onward (i : nat) : nat := hd 0%nat (successors arrows i).
Fixpoint extend (l : list nat) (k : nat) : nat :=
  match l, k with
  | [], _ => 0%nat
  | i :: _, O => i
  | [i], S k => Nat.iter (S k) onward i
  | _ :: t, S k => extend t k
  end.

Lemma arrow_onward i k : (exists j, arrow i j) -> arrow (Nat.iter k onward i) (Nat.iter (S k) onward i).
Proof.
  assert (A : forall i, (exists j, arrow i j) -> arrow i (onward i)).
  { intros a (j & J). apply successor in J. unfold onward. apply successor.
    destruct (successors arrows a); [destruct J|left; auto]. }
  induction k as [|k IH]; intros H; simpl; [apply A, H|]. apply A. eapply no_end, IH, H.
Qed.

Lemma extend_path l : l <> [] -> (exists j, arrow (nth 0 l 0%nat) j) -> word_path arrows l -> path (extend l).
Proof.
  induction l as [|i [|j t] IH]; intros N L P; [congruence| |].
  - intros [|k]; [apply (arrow_onward i 0 L)|apply (arrow_onward i (S k) L)].
  - assert (A : arrow i j) by (apply (P 0%nat); simpl; lia). intros [|k]; [destruct t; exact A|].
    apply (IH ltac:(discriminate) (no_end _ _ A)). intros q Q. apply (P (S q)). simpl in *. lia.
Qed.

Lemma extend_nth l : forall k, (k < length l)%nat -> extend l k = nth k l 0%nat.
Proof.
  induction l as [|i [|j t] IH]; intros k H; simpl in H; [lia|destruct k; [auto|lia]|].
  destruct k; [auto|]. apply (IH k). simpl. lia.
Qed.

(* As many points as words, any two apart before the words end. *)
Lemma two_words n l l' x y : length l = S n -> length l' = S n -> l <> l' -> path (extend l) -> path (extend l') ->
  follows (extend l) x -> follows (extend l') y -> exists k, (k <= n)%nat /\ delta <= distance (iter f k x) (iter f k y).
Proof.
  intros L L' N P P' X Y. apply Classical_Prop.NNPP. intros No. apply N.
  apply (nth_ext _ _ 0%nat 0%nat); [congruence|]. intros k B. rewrite <- !extend_nth by congruence.
  destruct (Nat.eq_dec (extend l k) (extend l' k)) as [|E]; auto. exfalso. apply No. exists k. split; [lia|].
  apply (apart _ _ _ _ _ _ (P k) (P' k) (X k) (Y k) E).
Qed.

Lemma points n ws : NoDup ws -> (forall l, In l ws -> length l = S n /\ word_path arrows l /\ exists j, arrow (nth 0 l 0%nat) j) ->
  exists xs, NoDup xs /\ length xs = length ws /\
    (forall x, In x xs -> exists l, In l ws /\ path (extend l) /\ follows (extend l) x) /\
    forall x y, In x xs -> In y xs -> x <> y -> exists k, (k <= n)%nat /\ delta <= distance (iter f k x) (iter f k y).
Proof.
  intros D H. induction D as [|l ws Nl D IH].
  { exists []. repeat split; [constructor|intros x []|intros x y []]. }
  destruct IH as (xs & Dx & L & Hx & Ap); [intros; apply H; right; auto|].
  destruct (H l (or_introl eq_refl)) as (Ll & P & A).
  assert (Pl : path (extend l)) by (apply extend_path; auto; destruct l; discriminate).
  destruct (followed _ Pl) as (x & Fx).
  assert (New : forall y, In y xs -> exists k, (k <= n)%nat /\ delta <= distance (iter f k x) (iter f k y)).
  { intros y Y. destruct (Hx y Y) as (l' & I' & P' & F'). apply (two_words n l l'); auto; [|congruence].
    apply H. right. auto. }
  exists (x :: xs). split; [|split; [simpl; congruence|split]].
  - constructor; auto. intros I. destruct (New x I) as (k & _ & B). rewrite distance_0 in B. lra.
  - intros y [<-|I]; [exists l; split; [left|]; auto|].
    destruct (Hx y I) as (l' & I' & Q). exists l'. split; [right|]; auto.
  - intros y z [<-|Y] [<-|Z] N; [congruence|auto| |auto].
    destruct (New y Y) as (k & B & C). exists k. rewrite distance_sym. auto.
Qed.

(* The entropy, from a vector v <= top with A^p v >= m v, A the matrix of the graph. *)
Theorem entropy_theorem v p m top i j : (0 <= m)%Z -> (forall i, (m * v i <= weight arrows v p i)%Z) ->
  (forall i, (0 <= v i <= top)%Z) -> (0 < v i)%Z -> arrow i j -> entropy_at_least distance f cell arrows p m.
Proof.
  intros M G Top V A. exists (IZR (v i) / IZR top), delta.
  assert (V0 : 0 < IZR (v i)) by (apply IZR_lt, V).
  assert (T0 : 0 < IZR top) by (apply IZR_lt; specialize (Top i); lia).
  split; [apply Rdiv_lt_0_compat; auto|split; [auto|]]. intros q.
  destruct (points (q * p) (words arrows v (q * p) i)) as (xs & D & L & F & S).
  - apply NoDup_words, once.
  - intros l I. destruct (words_are _ _ _ _ _ I) as (Ll & Z & P). rewrite Z. eauto.
  - exists xs. split; [auto|split; [|split]].
    + intros x I. destruct (F x I) as (l & _ & P & X). exists (extend l). auto.
    + pose proof (growth arrows v p m M G q i) as W. pose proof (count_words arrows v top Top (q * p) i) as C.
      rewrite L, INR_IZR_INZ, pow_IZR.
      assert (B : (m ^ Z.of_nat q * v i <= top * Z.of_nat (length (words arrows v (q * p) i)))%Z) by lia.
      apply IZR_le in B. rewrite !mult_IZR in B. apply Rmult_le_reg_l with (IZR top); auto.
      replace (IZR top * (IZR (v i) / IZR top * IZR (m ^ Z.of_nat q))) with (IZR (m ^ Z.of_nat q) * IZR (v i)) by (field; lra).
      exact B.
    + intros x y X Y N. rewrite (Nat.mul_comm p). apply S; auto.
Qed.
End Followed.

(* A^p v >= g v for the matrix A of the graph of `size` sets, in whole numbers. *)
Section Growing.
Variable arrows : list (nat * nat).
Variable size : nat.
Hypothesis numbers : forall i j, In (i, j) arrows -> (i < size)%nat /\ (j < size)%nat.
Variable v : list Z.
Variable p : nat.
Variable g : Z.
Definition step (u : list Z) : list Z :=
  map (fun i => total (map (fun j => nth j u 0%Z) (successors arrows i))) (seq 0 size).
Fixpoint distinct (l : list (nat * nat)) : bool :=
  match l with
  | [] => true
  | a :: t => negb (existsb (fun b => (fst a =? fst b)%nat && (snd a =? snd b)%nat) t) && distinct t
  end.
Definition growing : bool :=
  (length v =? size)%nat && (0 <=? g)%Z && forallb (Z.leb 0) v && distinct arrows &&
  forallb (fun a => existsb (fun b => (fst b =? snd a)%nat) arrows) arrows &&
  forallb (fun ab => (g * fst ab <=? snd ab)%Z) (combine v (Nat.iter p step v)) &&
  existsb (fun a => (0 <? nth (fst a) v 0)%Z) arrows.

Lemma distinct_NoDup l : distinct l = true -> NoDup l.
Proof.
  induction l as [|[a b] t IH]; intros H; constructor; simpl in H; apply andb_true_iff in H; destruct H as [H D]; auto.
  intros I. apply negb_true_iff, not_true_iff_false in H. apply H, existsb_exists. exists (a, b).
  rewrite !Nat.eqb_refl. auto.
Qed.

Lemma step_weight k : length v = size -> length (Nat.iter k step v) = size /\
  forall i, (i < size)%nat -> nth i (Nat.iter k step v) 0%Z = weight arrows (fun j => nth j v 0%Z) k i.
Proof.
  intros L. induction k as [|k [IL IH]]; simpl; [auto|]. unfold step at 1 3. rewrite map_length, seq_length. split; auto.
  intros i Hi. rewrite (nth_indep _ 0%Z (total (map (fun j => nth j (Nat.iter k step v) 0%Z) (successors arrows 0))))
    by (rewrite map_length, seq_length; auto).
  rewrite (map_nth (fun i => total (map (fun j => nth j (Nat.iter k step v) 0%Z) (successors arrows i)))).
  rewrite seq_nth by auto. simpl. f_equal. apply map_ext_in. intros j J. apply IH.
  apply successor in J. apply (numbers i j J).
Qed.

Theorem growth_theorem {T} (distance : T -> T -> R) f cell delta : (forall x, distance x x = 0) ->
  (forall x y, distance x y = distance y x) -> (forall w, path arrows w -> exists x, follows f cell w x) -> 0 < delta ->
  (forall i i' j j' x y, In (i, i') arrows -> In (j, j') arrows -> cell i x -> cell j y -> i <> j -> delta <= distance x y) ->
  growing = true -> entropy_at_least distance f cell arrows p g.
Proof.
  intros Zero Sym Fol Pos Apart. unfold growing. rewrite !andb_true_iff. intros [[[[[[L g0] P] D] N] W] E].
  apply Nat.eqb_eq in L. apply Z.leb_le in g0. apply existsb_exists in E. destruct E as ([i j] & A & V). apply Z.ltb_lt in V.
  rewrite forallb_forall in P, N, W.
  assert (P' : forall i, (0 <= nth i v 0)%Z).
  { intros k. destruct (Nat.lt_ge_cases k (length v)) as [K|K]; [apply Z.leb_le, P, nth_In, K|rewrite nth_overflow; lia]. }
  apply (entropy_theorem distance Zero Sym f cell arrows) with (delta := delta) (v := fun j => nth j v 0%Z) (top := total v) (i := i) (j := j); auto.
  - apply distinct_NoDup, D.
  - intros a b B. specialize (N _ B). apply existsb_exists in N. destruct N as ([c k] & C & Q). apply Nat.eqb_eq in Q.
    simpl in Q. subst c. eauto.
  - intros k. destruct (Nat.lt_ge_cases k size) as [K|K].
    + destruct (step_weight p L) as [SL SW]. rewrite <- (SW k K).
      specialize (W (nth k v 0%Z, nth k (Nat.iter p step v) 0%Z)). apply Z.leb_le, W.
      rewrite <- combine_nth by congruence. apply nth_In. rewrite combine_length. lia.
    + rewrite nth_overflow by lia. rewrite Z.mul_0_r.
      assert (Q : forall q k, (0 <= weight arrows (fun j => nth j v 0%Z) q k)%Z); [|apply Q].
      induction q as [|q IH]; intros a; simpl; [apply P'|]. induction (successors arrows a) as [|b l IHl]; simpl; [lia|].
      specialize (IH b). lia.
  - intros k. split; [apply P'|]. clear - P'. revert k. induction v as [|a l IH]; intros k; [destruct k; simpl; lia|].
    assert (Pl : forall i, (0 <= nth i l 0)%Z) by (intros q; apply (P' (S q))). pose proof (P' 0%nat) as P0. simpl in P0.
    destruct k as [|k]; simpl; [|specialize (IH Pl k); lia]. specialize (IH Pl (length l)). rewrite nth_overflow in IH; lia.
Qed.
End Growing.
