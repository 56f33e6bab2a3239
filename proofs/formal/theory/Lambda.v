(* The set of the paper's Theorems 3 and 4, from a point P of I0 on: where f(P) is in I0 and f^2(P)
   between I0 and I1, it is the words without 000. No numbers. *)
From Coq Require Import Reals Psatz Lia List Bool Arith.Cantor Classical.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Chaos Calculus Consequences.
Import ListNotations.
Open Scope R_scope.

(* No three letters 0 in turn. *)
Definition free (w : word) : Prop := forall k, w k || w (S k) || w (S (S k)) = true.

Lemma free_tail n w : free w -> free (tail n w).
Proof. intros F k. unfold tail. rewrite !Nat.add_succ_r. apply F. Qed.

(* A word without a tail in a sequence of words: every other letter is 1. *)
Lemma free_avoid (T : nat -> word) : exists w : word, free w /\ forall q i, exists j, tail i w j <> T q j.
Proof.
  exists (fun n => if Nat.even n then true else let (q, i) := of_nat (Nat.div2 n) in negb (T q (n - i)%nat)). split.
  - intros k. rewrite (Nat.even_succ k), <- Nat.negb_even. destruct (Nat.even k); [reflexivity|]. rewrite orb_true_r. reflexivity.
  - intros q i. pose proof (to_nat_non_decreasing q i). exists (2 * to_nat (q, i) + 1 - i)%nat. unfold tail.
    replace (i + (2 * to_nat (q, i) + 1 - i))%nat with (S (2 * to_nat (q, i))) by lia.
    rewrite Nat.even_succ, Nat.odd_mul, Nat.div2_succ_double, cancel_of_to. cbn [Nat.odd Nat.even negb andb].
    replace (S (2 * to_nat (q, i)) - i)%nat with (2 * to_nat (q, i) + 1 - i)%nat by lia.
    destruct (T q _); discriminate.
Qed.

(* A third 0 in turn is turned into 1: the last two letters are kept in mind. *)
Fixpoint mended (d : word) (n : nat) : bool * bool * bool :=
  match n with
  | O => (true, true, d O)
  | S n => let '(_, b, c) := mended d n in (b, c, d (S n) || negb (b || c))
  end.
Definition mend (d : word) : word := fun n => snd (mended d n).

Lemma mended_state d n : mended d (S (S n)) = (mend d n, mend d (S n), mend d (S (S n))).
Proof. unfold mend. cbn [mended]. destruct (mended d n) as [[a b] c]. reflexivity. Qed.

Lemma mend_free d : free (mend d).
Proof.
  intros k. pose proof (mended_state d k) as E. unfold mend at 3. rewrite E. cbn [snd].
  unfold mend in *. cbn [mended] in *. destruct (mended d k) as [[a b] c]. cbn [snd] in *.
  destruct c, (d (S k)), (d (S (S k))), b; reflexivity.
Qed.

(* After a letter 1 the words of the set are kept. *)
Lemma mend_keeps d w i n : free w -> d i = true -> (forall k, (k < n)%nat -> d (S i + k)%nat = w k) ->
  forall k, (k < n)%nat -> mend d (S i + k)%nat = w k.
Proof.
  intros F D E. assert (G : forall k, (k <= n)%nat -> let s := mended d (i + k)%nat in
    snd s = (if k then true else w (k - 1)%nat) /\ (k = O \/ snd (fst s) = if (k - 1)%nat then true else w (k - 2)%nat)).
  { induction k as [|k IH]; intros K s.
    - subst s. rewrite Nat.add_0_r. split; auto. destruct i; cbn [mended]; [exact D|].
      destruct (mended d i) as [[a b] c]. cbn [snd]. rewrite D. reflexivity.
    - specialize (IH ltac:(lia)). subst s. rewrite Nat.add_succ_r. cbn [mended]. cbn zeta in IH.
      destruct (mended d (i + k)) as [[a b] c]. cbn [fst snd] in *. destruct IH as [C B].
      rewrite Nat.sub_succ, Nat.sub_0_r. split; [|right; rewrite C; destruct k; [reflexivity|f_equal; lia]].
      specialize (E k ltac:(lia)). replace (S i + k)%nat with (S (i + k)) in E by lia. rewrite E.
      destruct k as [|[|k]]; subst c; [destruct (w O), b; reflexivity|cbn; destruct B as [B|B]; [discriminate|]; cbn in B; subst b; destruct (w 1%nat); reflexivity|].
      destruct B as [B|B]; [discriminate|]. replace (S (S k) - 1)%nat with (S k) in * by lia. replace (S (S k) - 2)%nat with k in * by lia.
      cbn in B. subst b. specialize (F k). destruct (w k), (w (S k)), (w (S (S k))); auto; discriminate. }
  intros k K. specialize (G (S k) ltac:(lia)). cbn zeta in G. rewrite Nat.sub_succ, Nat.sub_0_r in G.
  unfold mend. replace (S i + k)%nat with (i + S k)%nat by lia. apply G.
Qed.

Lemma ample_free : ample free.
Proof.
  split.
  - intros w H k. destruct (H (S (S k))) as (v & F & E). rewrite !E by lia. apply F.
  - apply free_tail.
  - intros n n0. exists (fun k => negb (Nat.eqb (k mod n) 1)), 1%nat. split; [|split].
    + intros k. destruct (Nat.eqb_spec (k mod n) 1) as [E|]; [|reflexivity]. destruct (Nat.eqb_spec (S k mod n) 1) as [E'|]; [|reflexivity].
      exfalso. assert (n1 : (1 < n)%nat) by (destruct (Nat.eq_dec n 1) as [->|]; [rewrite Nat.mod_1_r in E; discriminate|lia]).
      replace (S k) with (k + 1)%nat in E' by lia. rewrite Nat.add_mod, E, Nat.mod_small with (a := 1%nat) in E' by lia.
      destruct (Nat.eq_dec n 2) as [->|]; [discriminate|]. rewrite Nat.mod_small in E'; lia.
    + intros k. do 2 f_equal. rewrite Nat.add_mod, Nat.mod_same, Nat.add_0_l, Nat.mod_mod; lia.
    + intros k K. rewrite (Nat.mod_small 1) by lia. cbn. destruct (Nat.eqb_spec ((k + 1) mod n) 1) as [E|]; [|discriminate].
      destruct (Nat.eq_dec (k + 1) n) as [Q|]; [rewrite Q, Nat.mod_same in E; lia|]. rewrite Nat.mod_small in E; lia.
  - apply free_avoid.
  - destruct everywhere as [d D]. exists (mend d). split; [apply mend_free|]. intros w n F.
    destruct (D (fun k => match k with O => true | S k => w k end) (S n)) as [i I]. exists (S i).
    intros k K. apply (mend_keeps d w i n F); auto.
    + pose proof (I O ltac:(lia)) as Q. unfold tail in Q. rewrite Nat.add_0_r in Q. exact Q.
    + intros j J. pose proof (I (S j) ltac:(lia)) as Q. unfold tail in Q. rewrite Nat.add_succ_r in Q. exact Q.
  - intros w n F. set (other j b k := if Nat.eqb k j then b else w k).
    assert (Go : forall j b, (n <= j)%nat -> free (other j b) -> b <> w j -> exists v j, free v /\ v j <> w j /\ forall k, (k < n)%nat -> v k = w k).
    { intros j b J Fr D. exists (other j b), j. unfold other at 2 3. rewrite Nat.eqb_refl. split; [auto|split; [auto|]].
      intros k K. destruct (Nat.eqb_spec k j); auto. lia. }
    destruct (classic (exists j, (n <= j)%nat /\ w j = false)) as [(j & J & Wj)|No].
    + apply (Go j true J); [|rewrite Wj; discriminate]. intros k. specialize (F k). unfold other.
      destruct (Nat.eqb k j), (Nat.eqb (S k) j), (Nat.eqb (S (S k)) j); rewrite ?Bool.orb_true_r; auto.
    + assert (One : forall j, (n <= j)%nat -> w j = true).
      { intros j J. destruct (w j) eqn:Wj; auto. exfalso. eauto. }
      apply (Go (S n) false); [lia| |rewrite One by lia; discriminate]. intros k. specialize (F k). unfold other.
      destruct (Nat.eqb_spec k (S n)), (Nat.eqb_spec (S k) (S n)), (Nat.eqb_spec (S (S k)) (S n)); try lia; auto;
        rewrite ?(One k), ?(One (S k)) by lia; rewrite ?orb_true_r; reflexivity.
Qed.

Section Lambda.
Variable N : R -> R -> Prop.
Variables A b0 a1 B m M : R.
Hypothesis order : A < b0 < a1 /\ a1 < B.
Hypothesis m_gt_1 : 1 < m.
Hypothesis M_ge_1 : 1 <= M.
Hypothesis det : forall x y z, N x y -> N x z -> y = z.
Variable f : R -> R.
Hypothesis rises : impact_map N A b0 a1 B 1 1 m M f.
Hypothesis shifted : full_shift N A b0 a1 B m M.
Variables P y z : R.
Hypothesis in0 : A <= P <= b0.
Hypothesis first_image : N P y /\ A <= y <= b0.
Hypothesis second_image : N y z /\ b0 < z < a1.
Notation L := (stays N A B).
Notation Lambda := (stays N P B).

Lemma increasing x x' v v' : In_ A b0 a1 B false x -> In_ A b0 a1 B false x' -> N x v -> N x' v' -> x < x' -> v < v'.
Proof.
  intros X X' V V' Lt. destruct rises as (Near & Der & _).
  assert (Is : forall s t, In_ A b0 a1 B false s -> N s t -> t = f s).
  { intros s t Is H. destruct (Near false s Is) as [e E]. apply (E s (ball_center s e) t), H. }
  rewrite (Is _ _ X V), (Is _ _ X' V'). unfold In_ in X, X'.
  destruct (mvt f (Derive f) x x') as (c & C & D); [lra| |].
  { intros s S. apply Derive_correct, (Der false). unfold In_. lra. }
  destruct (Der false c) as (_ & _ & Lo & _); [unfold In_; lra|]. nra.
Qed.

Section Words.
Variable X : word -> R.
Hypothesis X_stays : forall x, L x <-> exists w, True /\ x = X w.
Hypothesis X_it : forall x w, itinerary N A b0 a1 B x w <-> x = X w.
Hypothesis X_inj : forall w w', X w = X w' <-> forall k, w k = w' k.
Hypothesis X_N : forall w, N (X w) (X (shift w)).

Lemma X_in w : In_ A b0 a1 B (w O) (X w).
Proof. destruct (proj2 (X_it _ _) eq_refl : itinerary N A b0 a1 B (X w) w) as (u & <- & H). apply (H O). Qed.

Lemma beyond w : P <= X w <-> w O || w 1%nat || w 2%nat = true.
Proof.
  pose proof (X_in w) as I0. pose proof (X_in (shift w)) as I1. pose proof (X_in (shift (shift w))) as I2.
  pose proof (X_N w) as N0. pose proof (X_N (shift w)) as N1. unfold shift in I1 at 1. unfold shift in I2 at 1 2.
  set (x0 := X w) in *. set (x1 := X (shift w)) in *. set (x2 := X (shift (shift w))) in *.
  destruct first_image as [F1 Y], second_image as [F2 Z].
  assert (InP : In_ A b0 a1 B false P) by exact in0. assert (InY : In_ A b0 a1 B false y) by exact Y.
  destruct (w O) eqn:W0; [split; auto; unfold In_ in I0; lra|].
  destruct (w 1%nat) eqn:W1.
  { split; auto. intros _. unfold In_ in I1. destruct (Rle_dec P x0) as [|G]; auto. exfalso.
    pose proof (increasing x0 P x1 y I0 InP N0 F1 ltac:(lra)). lra. }
  destruct (w 2%nat) eqn:W2; unfold In_ in I2.
  - split; auto. intros _. destruct (Rle_dec P x0) as [|G]; auto. exfalso.
    pose proof (increasing x0 P x1 y I0 InP N0 F1 ltac:(lra)).
    pose proof (increasing x1 y x2 z I1 InY N1 F2 ltac:(lra)). lra.
  - split; [|discriminate]. intros H. exfalso.
    destruct (Req_dec P x0) as [E|D].
    + rewrite E in F1. pose proof (det _ _ _ F1 N0) as E1. rewrite E1 in F2. pose proof (det _ _ _ F2 N1). lra.
    + pose proof (increasing P x0 y x1 InP I0 F1 N0 ltac:(lra)).
      pose proof (increasing y x1 z x2 InY I1 F2 N1 ltac:(lra)). lra.
Qed.

Lemma step n w : N (X (tail n w)) (X (tail (S n) w)).
Proof.
  replace (X (tail (S n) w)) with (X (shift (tail n w))); [apply X_N|]. apply X_inj. intros k. unfold shift, tail. f_equal. lia.
Qed.

(* The phases that stay are those of the words without 000. *)
Lemma words x : Lambda x <-> exists w, free w /\ x = X w.
Proof.
  split.
  - intros (u & U & H). destruct (proj1 (X_stays x)) as (w & _ & W).
    { exists u. split; auto. intros n. destruct (H n). split; auto. lra. }
    exists w. split; auto. intros k.
    assert (E : forall n, u n = X (tail n w)).
    { induction n as [|n IH]; [rewrite U, W; reflexivity|].
      apply (det (u n)); [apply H|]. rewrite IH. apply step. }
    pose proof (beyond (tail k w)) as Q. unfold tail at 2 3 4 in Q. rewrite Nat.add_0_r, Nat.add_1_r in Q.
    replace (k + 2)%nat with (S (S k)) in Q by lia. apply Q. rewrite <- E. apply H.
  - intros (w & F & ->). exists (fun n => X (tail n w)). split; [reflexivity|]. intros n. split; [split|apply step].
    + apply beyond. unfold tail. rewrite Nat.add_0_r, Nat.add_1_r. replace (n + 2)%nat with (S (S n)) by lia. apply F.
    + pose proof (X_in (tail n w)) as I. destruct (tail n w 0%nat); unfold In_ in I; lra.
Qed.

End Words.

Theorem lambda_rich : rich N Lambda.
Proof.
  destruct (shift_words N A b0 a1 B m M order shifted) as (X & S & It & In & I & Nx & C & D).
  apply rich_X with (A := A) (b0 := b0) (a1 := a1) (B := B) (m := m) (X := X) (W := free); auto using ample_free. apply words; auto.
Qed.

Theorem lambda_cantor : cantor_set Lambda.
Proof.
  destruct (shift_words N A b0 a1 B m M order shifted) as (X & S & It & In & I & Nx & C & D).
  apply cantor_X with (A := A) (b0 := b0) (a1 := a1) (B := B) (m := m) (M := M) (X := X) (W := free); auto using ample_free. apply words; auto.
Qed.
End Lambda.
