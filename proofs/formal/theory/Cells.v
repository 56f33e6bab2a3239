(* Arrows between intervals [l / unit, r / unit] of the line: where a map is continuous on the
   intervals and covers along the arrows, the theorems of Graph.v hold of it. *)
From Coq Require Import Reals ZArith Psatz Lia List Bool.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Calculus Numbers Graph Paths Entropy.
Import ListNotations.
Open Scope R_scope.

Section Cells.
Variable G : R -> R.
Variable unit : positive.
Variable ends : list (Z * Z).
Variable arrows : list (nat * nat).
Notation ratio := (ratio unit).

Definition cells : list (R * R) := map (fun lr => (ratio (fst lr), ratio (snd lr))) ends.
Definition ends_of (i : nat) : Z * Z := nth i ends (0, 0)%Z.
Definition within (i : nat) (x : R) : Prop := ratio (fst (ends_of i)) <= x <= ratio (snd (ends_of i)).
Fixpoint ascending (l : list (Z * Z)) : bool :=
  match l with
  | (l, r) :: t => (l <? r)%Z && match t with (a, _) :: _ => (r <? a)%Z | [] => true end && ascending t
  | [] => true
  end.
Definition sources : list nat := nodup Nat.eq_dec (map fst arrows).
Definition placed : bool :=
  ascending ends && forallb (fun ij => (fst ij <? length ends)%nat && (snd ij <? length ends)%nat) arrows.

Hypothesis well_placed : placed = true.
Hypothesis continuous_there : forall i x, In i sources -> within i x -> continuity_pt G x.
Hypothesis covers_along : forall i j, In (i, j) arrows ->
  spans G (ratio (fst (ends_of i))) (ratio (snd (ends_of i))) (ratio (fst (ends_of j))) (ratio (snd (ends_of j))).

Lemma source i j : arrow arrows i j -> In i sources.
Proof. intros A. apply nodup_In, (in_map fst _ _ A). Qed.

Lemma in_turn : ascending ends = true.
Proof. unfold placed in well_placed. apply andb_true_iff in well_placed. apply well_placed. Qed.

Lemma numbers i j : arrow arrows i j -> (i < length ends)%nat /\ (j < length ends)%nat.
Proof.
  intros A. unfold placed in well_placed. rewrite andb_true_iff, forallb_forall in well_placed.
  destruct well_placed as [_ H]. specialize (H _ A). rewrite andb_true_iff, !Nat.ltb_lt in H. exact H.
Qed.

Lemma cells_ends i : (i < length ends)%nat -> left cells i = ratio (fst (ends_of i)) /\ right cells i = ratio (snd (ends_of i)).
Proof.
  intros L. unfold left, right, cells. rewrite (nth_indep _ (0, 0) (ratio 0, ratio 0)) by (rewrite map_length; auto).
  rewrite (map_nth (fun lr => (ratio (fst lr), ratio (snd lr))) ends (0, 0)%Z). auto.
Qed.

Lemma ascending_lt l : ascending l = true -> forall j, (j < length l)%nat ->
  (fst (nth j l (0, 0)) < snd (nth j l (0, 0)))%Z /\
  forall i, (i < j)%nat -> (snd (nth i l (0, 0)) < fst (nth j l (0, 0)))%Z.
Proof.
  induction l as [|[a b] t IH]; intros A j L; simpl in L; [lia|]. cbn [ascending] in A.
  rewrite !andb_true_iff, Z.ltb_lt in A. destruct A as [[ab N] A]. specialize (IH A).
  destruct j as [|j]; [split; [exact ab|lia]|]. destruct (IH j ltac:(lia)) as [J F]. split; [exact J|].
  intros [|i] ij; [|apply (F i); lia]. destruct t as [|[a' b'] t]; [simpl in L; lia|]. apply Z.ltb_lt in N. simpl.
  destruct j as [|j]; [exact N|]. destruct (IH 0%nat ltac:(simpl; lia)) as [Z0 _]. specialize (F 0%nat ltac:(lia)).
  simpl in *. lia.
Qed.

Lemma in_order i j : arrow arrows i j -> left cells i <= right cells i /\ left cells j <= right cells j.
Proof.
  intros A. destruct (numbers i j A) as [I J]. pose proof (ascending_lt ends in_turn) as L.
  destruct (cells_ends i I) as [-> ->], (cells_ends j J) as [-> ->].
  destruct (L i I) as [Li _], (L j J) as [Lj _]. split; apply ratio_le; unfold ends_of; lia.
Qed.

Lemma cell_within i j x : arrow arrows i j -> interval cells i x -> within i x.
Proof. intros A X. unfold within. destruct (cells_ends i (proj1 (numbers i j A))) as [<- <-]. exact X. Qed.

Lemma smooth i j x : arrow arrows i j -> interval cells i x -> continuity_pt G x.
Proof. intros A X. apply (continuous_there i x (source i j A) (cell_within i j x A X)). Qed.

Lemma cover i j : arrow arrows i j -> spans G (left cells i) (right cells i) (left cells j) (right cells j).
Proof.
  intros A. destruct (numbers i j A) as [I J]. destruct (cells_ends i I) as [-> ->], (cells_ends j J) as [-> ->].
  apply covers_along, A.
Qed.

Definition delta : R := / IZR (Zpos unit).

Lemma delta_pos : 0 < delta.
Proof. apply Rinv_0_lt_compat, unit_pos. Qed.

Lemma apart i i' j j' x y : arrow arrows i i' -> arrow arrows j j' -> interval cells i x -> interval cells j y -> i <> j ->
  delta <= Rabs (x - y).
Proof.
  assert (Lt : forall i i' j j' x y, arrow arrows i i' -> arrow arrows j j' -> interval cells i x -> interval cells j y ->
    (i < j)%nat -> delta <= y - x).
  { intros p p' q q' u v A B U V L. apply (cell_within p p' u A) in U. apply (cell_within q q' v B) in V.
    destruct (ascending_lt ends in_turn q (proj1 (numbers q q' B))) as [_ F].
    specialize (F p L). assert (S : (snd (ends_of p) + 1 <= fst (ends_of q))%Z) by (unfold ends_of; lia).
    apply (ratio_le unit) in S. rewrite ratio_add in S. unfold within in U, V. unfold delta.
    replace (/ IZR (Zpos unit)) with (ratio 1) by (unfold Numbers.ratio, Rdiv; ring). lra. }
  intros A B X Y N. destruct (Nat.lt_gt_cases i j) as [T _]. destruct (T N) as [L|L].
  - pose proof (Lt _ _ _ _ _ _ A B X Y L). pose proof delta_pos. rewrite Rabs_minus_sym, Rabs_pos_eq; lra.
  - pose proof (Lt _ _ _ _ _ _ B A Y X L). pose proof delta_pos. rewrite Rabs_pos_eq; lra.
Qed.

Theorem cells_semiconjugate : semiconjugate G cells arrows.
Proof. apply (semiconjugate_theorem G cells arrows in_order smooth cover delta delta_pos apart). Qed.

(* |G'| >= m on each interval from which an arrow goes, with one sign. *)
Theorem cells_conjugate m : 1 < m ->
  (forall i, In i sources -> exists way : bool, forall z, within i z ->
     exists s, is_derive G z s /\ m <= if way then s else - s) ->
  conjugate G cells arrows m.
Proof.
  intros M E. apply (conjugate_theorem G cells arrows in_order smooth cover delta delta_pos apart m M).
  assert (Lt : forall i j x y, arrow arrows i j -> interval cells i x -> interval cells i y -> x < y ->
    m * (y - x) <= Rabs (G y - G x)).
  { intros i j x y A X Y L. apply (cell_within i j x A) in X. apply (cell_within i j y A) in Y.
    destruct (E i (source i j A)) as (way & W).
    assert (W' : forall z, x <= z <= y -> exists s, is_derive G z s /\ m <= if way then s else - s)
      by (intros z Z; apply W; unfold within in *; lra).
    destruct (mvt G (Derive G) x y L) as (c & C & D).
    { intros z Z. destruct (W' z Z) as (s & S & _). rewrite (is_derive_unique _ _ _ S). exact S. }
    destruct (W' c C) as (s & S & B). rewrite (is_derive_unique _ _ _ S) in D. rewrite D, Rabs_mult, (Rabs_pos_eq (y - x)) by lra.
    apply Rmult_le_compat_r; [lra|]. eapply Rle_trans; [exact B|]. destruct way; [apply Rle_abs|].
    rewrite <- Rabs_Ropp. apply Rle_abs. }
  intros i j x y A X Y. destruct (Rtotal_order x y) as [L|[->|L]].
  - rewrite Rabs_minus_sym, (Rabs_minus_sym (G x)), (Rabs_pos_eq (y - x)) by lra. apply (Lt i j); auto.
  - rewrite !Rminus_eq_0, Rabs_R0. lra.
  - rewrite (Rabs_pos_eq (x - y)) by lra. apply (Lt i j); auto.
Qed.

Theorem cells_growth v p g : growing arrows (length ends) v p g = true -> entropy_at_least on_line G (interval cells) arrows p g.
Proof.
  apply growth_theorem with (delta := delta); auto using delta_pos, numbers; [| | |exact apart].
  - intros x. unfold on_line. rewrite Rminus_eq_0. apply Rabs_R0.
  - intros x y. apply Rabs_minus_sym.
  - apply (proj1 cells_semiconjugate).
Qed.
End Cells.
