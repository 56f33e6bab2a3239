(* Covering graphs of a continuous map of the line: every path of arrows is followed by an orbit,
   every closed path by a periodic one. No numbers. *)
From Coq Require Import Reals Psatz Lia Classical List.
From Oscillator Require Import Graph.
Import ListNotations.
Open Scope R_scope.

Lemma near_below g c r : continuity_pt g c -> g c < r -> exists d, 0 < d /\ forall y, Rabs (y - c) < d -> g y < r.
Proof.
  intros C L. destruct (C (r - g c) ltac:(lra)) as (d & D & H). exists d. split; [lra|]. intros y Y.
  destruct (Req_dec y c) as [->|N]; [auto|].
  assert (G : Rabs (g y - g c) < r - g c).
  { apply H. split; [split; [exact I|auto]|exact Y]. }
  apply Rabs_def2 in G. lra.
Qed.

(* Where a continuous function first has a value. *)
Lemma first_hit g a b r : a <= b -> (forall x, a <= x <= b -> continuity_pt g x) -> g a <= r <= g b ->
  exists c, a <= c <= b /\ g c = r /\ forall x, a <= x < c -> g x < r.
Proof.
  intros ab C H. destruct (Req_dec (g a) r) as [E|N].
  { exists a. split; [lra|split; [auto|]]. intros x X. lra. }
  set (E := fun x => a <= x <= b /\ forall y, a <= y <= x -> g y < r).
  destruct (completeness E) as [c [U L]].
  { exists b. intros x [X _]. lra. }
  { exists a. split; [lra|]. intros y Y. replace y with a by lra. lra. }
  assert (ac : a <= c). { apply U. split; [lra|]. intros y Y. replace y with a by lra. lra. }
  assert (cb : c <= b). { apply L. intros x [X _]. lra. }
  assert (B : forall y, a <= y < c -> g y < r).
  { intros y Y. apply Rnot_le_lt. intros G. assert (c <= y); [|lra]. apply L. intros x [X Hx].
    apply Rnot_lt_le. intros Q. specialize (Hx y). lra. }
  assert (lo : ~ g c < r).
  { intros G. destruct (near_below g c r (C c ltac:(lra)) G) as (d & d0 & D).
    assert (c < b) by (destruct (Req_dec c b) as [->|]; lra).
    assert (M : Rmin b (c + d / 2) <= c); [|revert M; unfold Rmin; destruct Rle_dec; lra].
    pose proof (Rmin_l b (c + d / 2)) as M1. pose proof (Rmin_r b (c + d / 2)) as M2.
    apply U. split; [unfold Rmin; destruct Rle_dec; lra|]. intros y Y.
    destruct (Rlt_dec y c); [apply B; lra|]. apply D. rewrite Rabs_pos_eq; lra. }
  assert (hi : ~ r < g c).
  { intros G. destruct (near_below (fun x => - g x) c (- r)) as (d & d0 & D); [apply continuity_pt_opp, C; lra|lra|].
    assert (a < c) by (destruct (Req_dec a c) as [->|]; lra).
    pose proof (Rmax_l a (c - d / 2)). pose proof (Rmax_r a (c - d / 2)).
    assert (Rmax a (c - d / 2) < c) by (unfold Rmax; destruct Rle_dec; lra).
    specialize (B (Rmax a (c - d / 2)) ltac:(lra)).
    specialize (D (Rmax a (c - d / 2)) ltac:(rewrite Rabs_left1; lra)). lra. }
  exists c. split; [lra|split; [lra|exact B]].
Qed.

Lemma mirrored g s x : continuity_pt g (s - x) -> continuity_pt (fun y => - g (s - y)) x.
Proof.
  intros C. apply continuity_pt_opp. apply (continuity_pt_comp (fun y => s - y) g); auto.
  apply continuity_pt_minus; [apply continuity_pt_const; intros ? ?; auto|apply derivable_continuous_pt, derivable_pt_id].
Qed.

(* A part of [a, b] whose image is exactly [l, r], end to end. *)
Definition spans (g : R -> R) (a b l r : R) : Prop := g a <= l /\ r <= g b \/ g b <= l /\ r <= g a.

Lemma part_rising g a b l r : a <= b -> l <= r -> (forall x, a <= x <= b -> continuity_pt g x) ->
  g a <= l -> r <= g b -> exists p q, a <= p <= q /\ q <= b /\ g p = l /\ g q = r /\ forall x, p <= x <= q -> l <= g x <= r.
Proof.
  intros ab lr C L Rr. destruct (first_hit g a b r ab C ltac:(lra)) as (q & Q & Eq & Hq).
  destruct (first_hit (fun x => - g (a + q - x)) a q (- l)) as (c & Cc & Ec & Hc).
  - lra.
  - intros x X. apply mirrored, C. lra.
  - replace (a + q - a) with q by ring. replace (a + q - q) with a by ring. lra.
  - exists (a + q - c), q. repeat split; try lra.
    + destruct (Req_dec x (a + q - c)) as [->|]; [lra|].
      specialize (Hc (a + q - x) ltac:(lra)). replace (a + q - (a + q - x)) with x in Hc by ring. lra.
    + destruct (Req_dec x q) as [->|]; [lra|]. apply Rlt_le, Hq. lra.
Qed.

Lemma part g a b l r : a <= b -> l <= r -> (forall x, a <= x <= b -> continuity_pt g x) -> spans g a b l r ->
  exists p q, a <= p <= q /\ q <= b /\ spans g p q l r /\ forall x, p <= x <= q -> l <= g x <= r.
Proof.
  intros ab lr C [[L H]|[L H]].
  - destruct (part_rising g a b l r) as (p & q & P & Q & Ep & Eq & G); auto.
    exists p, q. unfold spans. repeat split; try apply G; auto; lra.
  - destruct (part_rising (fun x => - g x) a b (- r) (- l)) as (p & q & P & Q & Ep & Eq & G); try lra.
    { intros x X. apply continuity_pt_opp, C; auto. }
    exists p, q. unfold spans. repeat split; try (specialize (G x)); lra.
Qed.

(* Of finitely many properties one holds for points as near as one likes, if always one does. *)
Lemma frequent (T : Type) (P : T -> R -> Prop) c l :
  (forall e, 0 < e -> exists y t, In t l /\ P t y /\ Rabs (y - c) < e) ->
  exists t, In t l /\ forall e, 0 < e -> exists y, P t y /\ Rabs (y - c) < e.
Proof.
  induction l as [|a l IH]; intros H; [destruct (H 1 Rlt_0_1) as (y & t & [] & _)|].
  destruct (classic (forall e, 0 < e -> exists y, P a y /\ Rabs (y - c) < e)) as [A|A]; [exists a; split; [left|]; auto|].
  apply not_all_ex_not in A. destruct A as (d & A). apply imply_to_and in A. destruct A as [D A].
  destruct IH as (t & I & F); [|exists t; split; [right|]; auto].
  intros e E. destruct (H (Rmin e d) (Rmin_pos _ _ E D)) as (y & t & [<-|I] & Q & B); pose proof (Rmin_l e d); pose proof (Rmin_r e d).
  - exfalso. apply A. exists y. split; auto. lra.
  - exists y, t. split; auto. split; auto. lra.
Qed.

Fixpoint tuples (letters : list nat) (n : nat) : list (list nat) :=
  match n with O => [[]] | S n => flat_map (fun i => map (cons i) (tuples letters n)) letters end.

Lemma in_tuples letters n : forall (v : nat -> nat) k, (forall i, In (v i) letters) -> In (map v (seq k n)) (tuples letters n).
Proof.
  induction n as [|n IH]; intros v k H; simpl; [auto|]. apply in_flat_map. exists (v k). split; [apply H|].
  apply in_map, IH, H.
Qed.

Lemma cells_bounded cells : exists m M, m <= 0 <= M /\ forall i x, interval cells i x -> m <= x <= M.
Proof.
  unfold interval. induction cells as [|c l (m & M & O & B)].
  - exists 0, 0. split; [lra|]. intros [|i] x X; simpl in X; lra.
  - exists (Rmin m (fst c)), (Rmax M (snd c)). pose proof (Rmin_l m (fst c)). pose proof (Rmin_r m (fst c)).
    pose proof (Rmax_l M (snd c)). pose proof (Rmax_r M (snd c)). split; [lra|].
    intros [|i] x X; simpl in X; [lra|]. specialize (B i x X). lra.
Qed.

Lemma adherent_closed (L : R -> Prop) : (forall c, (forall e, 0 < e -> exists y, L y /\ Rabs (y - c) < e) -> L c) ->
  closed_set L.
Proof.
  intros H x X. apply NNPP. intros N. apply X, H. intros e E. apply NNPP. intros G. apply N.
  exists (mkposreal e E). intros y Y Ly. apply G. exists y. split; auto.
Qed.

Definition width (cells : list (R * R)) : R := fold_right (fun c s => Rabs (snd c - fst c) + s) 0 cells.

Lemma width_bound cells i x y : interval cells i x -> interval cells i y -> Rabs (x - y) <= width cells.
Proof.
  assert (P : forall l, 0 <= fold_right (fun c s => Rabs (snd c - fst c) + s) 0 l).
  { induction l as [|c l IH]; simpl; [lra|]. pose proof (Rabs_pos (snd c - fst c)). lra. }
  unfold width, interval. intros X Y. revert i X Y. induction cells as [|c l IH]; intros i X Y.
  - destruct i; simpl in *; replace (x - y) with 0 by lra; rewrite Rabs_R0; lra.
  - destruct i as [|i]; simpl in *; [|pose proof (IH i X Y); pose proof (Rabs_pos (snd c - fst c)); lra].
    specialize (P l). rewrite (Rabs_pos_eq (snd c - fst c)) by lra.
    assert (Rabs (x - y) <= snd c - fst c) by (apply Rabs_le; lra). lra.
Qed.

Section Paths.
Variable f : R -> R.
Variable cells : list (R * R).
Variable arrows : list (nat * nat).
Notation iter := (iter f).
Notation cell := (interval cells).
Notation K := (K f (interval cells) arrows).
Definition left (i : nat) : R := fst (nth i cells (0, 0)).
Definition right (i : nat) : R := snd (nth i cells (0, 0)).
Definition arrow (i j : nat) : Prop := In (i, j) arrows.
Hypothesis ends : forall i j, arrow i j -> left i <= right i /\ left j <= right j.
Hypothesis smooth : forall i j x, arrow i j -> cell i x -> continuity_pt f x.
Hypothesis cover : forall i j, arrow i j -> spans f (left i) (right i) (left j) (right j).

(* The first n steps. *)
Definition steps (w : nat -> nat) (n : nat) : Prop := forall k, (k < n)%nat -> arrow (w k) (w (S k)).
Definition visits (w : nat -> nat) (n : nat) (x : R) : Prop := forall k, (k <= n)%nat -> cell (w k) (iter k x).

Lemma iter_continuous w n : steps w n -> forall x, visits w n x -> continuity_pt (iter n) x.
Proof.
  induction n as [|n IH]; intros Pw x F; simpl.
  - apply derivable_continuous_pt, derivable_pt_id.
  - apply (continuity_pt_comp (iter n) f).
    + apply IH; [intros k K; apply Pw; lia|intros k K; apply F; lia].
    + apply (smooth (w n) (w (S n))); [apply Pw; lia|apply F; lia].
Qed.

Lemma along w n : steps w n -> left (w O) <= right (w O) -> exists p q, left (w O) <= p <= q /\ q <= right (w O) /\
  spans (iter n) p q (left (w n)) (right (w n)) /\ forall x, p <= x <= q -> visits w n x.
Proof.
  induction n as [|n IH]; intros Pw W.
  - exists (left (w O)), (right (w O)). split; [lra|split; [lra|split; [left; simpl; lra|]]].
    intros x X k K. assert (k = O) by lia. subst k. exact X.
  - assert (Pn : steps w n) by (intros k K; apply Pw; lia).
    destruct (IH Pn W) as (p & q & P & Q & Sp & F). assert (A : arrow (w n) (w (S n))) by (apply Pw; lia).
    pose proof (ends _ _ A) as [O1 O2]. pose proof (cover _ _ A) as Cv.
    destruct (part (iter n) p q (left (w n)) (right (w n))) as (p' & q' & P' & Q' & Sp' & G); auto; try lra.
    { intros x X. apply (iter_continuous w n Pn), F, X. }
    assert (E : iter n p' = left (w n) /\ iter n q' = right (w n) \/ iter n p' = right (w n) /\ iter n q' = left (w n)).
    { pose proof (G p' ltac:(lra)). pose proof (G q' ltac:(lra)). unfold spans in Sp'. lra. }
    destruct (part (iter (S n)) p' q' (left (w (S n))) (right (w (S n)))) as (p2 & q2 & P2 & Q2 & S2 & G2); auto; try lra.
    { intros x X. simpl. apply (continuity_pt_comp (iter n) f).
      - apply (iter_continuous w n Pn), F. lra.
      - apply (smooth _ _ _ A). apply G, X. }
    { unfold spans in *. simpl. destruct E as [[E1 E2]|[E1 E2]]; rewrite E1, E2; lra. }
    exists p2, q2. split; [lra|split; [lra|split; [exact S2|]]].
    intros x X k K. destruct (Nat.eq_dec k (S n)) as [->|]; [apply G2, X|]. apply (F x ltac:(lra)). lia.
Qed.

(* Every closed path is that of a periodic orbit. *)
Theorem periodic w n : (0 < n)%nat -> steps w n -> w n = w O -> exists x, iter n x = x /\ visits w n x.
Proof.
  intros n0 Pw E. destruct (ends _ _ (Pw O n0)) as [W _].
  destruct (along w n Pw W) as (p & q & P & Q & S & F). rewrite E in S.
  assert (C : forall x, p <= x <= q -> continuity_pt (fun x => iter n x - x) x).
  { intros x X. apply continuity_pt_minus; [apply (iter_continuous w n Pw), F, X|apply derivable_continuous_pt, derivable_pt_id]. }
  assert (Z : exists x, p <= x <= q /\ iter n x - x = 0).
  { unfold spans in S. destruct S as [[L H]|[L H]].
    - destruct (first_hit (fun x => iter n x - x) p q 0) as (c & Cc & Ec & _); auto; try lra. exists c; auto.
    - destruct (first_hit (fun x => - (iter n x - x)) p q 0) as (c & Cc & Ec & _); auto; try lra.
      { intros x X. apply (continuity_pt_opp (fun x => iter n x - x)), C, X. }
      exists c. split; auto. lra. }
  destruct Z as (x & X & Ex). exists x. split; [lra|apply F, X].
Qed.

(* The cells are closed: a limit of points that follow w for n steps does so. *)
Lemma limit w n c : steps w n -> (forall e, 0 < e -> exists y, Rabs (y - c) < e /\ visits w n y) -> visits w n c.
Proof.
  induction n as [|n IH]; intros Pw H.
  - intros k K. assert (k = O) by lia. subst k. change (left (w O) <= c <= right (w O)).
    split; apply Rnot_lt_le; intros G.
    + destruct (H (left (w O) - c) ltac:(lra)) as (y & Y & F). specialize (F O (le_n 0)). change (left (w O) <= y <= right (w O)) in F.
      apply Rabs_def2 in Y. lra.
    + destruct (H (c - right (w O)) ltac:(lra)) as (y & Y & F). specialize (F O (le_n 0)). change (left (w O) <= y <= right (w O)) in F.
      apply Rabs_def2 in Y. lra.
  - assert (Pn : steps w n) by (intros k K; apply Pw; lia).
    assert (Fn : visits w n c).
    { apply IH; auto. intros e E. destruct (H e E) as (y & Y & F). exists y. split; auto. intros k K. apply F. lia. }
    intros k K. destruct (Nat.eq_dec k (S n)) as [->|]; [|apply Fn; lia].
    assert (A : arrow (w n) (w (S n))) by (apply Pw; lia).
    assert (C : continuity_pt (iter (S n)) c).
    { simpl. apply (continuity_pt_comp (iter n) f); [apply (iter_continuous w n Pn), Fn|].
      apply (smooth _ _ _ A). apply Fn. lia. }
    change (left (w (S n)) <= iter (S n) c <= right (w (S n))). split; apply Rnot_lt_le; intros G.
    + destruct (near_below _ _ _ C G) as (d & d0 & D). destruct (H d d0) as (y & Y & F).
      specialize (D y Y). specialize (F (S n) (le_n _)). change (left (w (S n)) <= iter (S n) y <= right (w (S n))) in F. lra.
    + destruct (near_below (fun x => - iter (S n) x) c (- right (w (S n)))) as (d & d0 & D);
        [apply continuity_pt_opp, C|lra|]. destruct (H d d0) as (y & Y & F).
      specialize (D y Y). specialize (F (S n) (le_n _)). change (left (w (S n)) <= iter (S n) y <= right (w (S n))) in F. lra.
Qed.

(* Every infinite path has an orbit. *)
Theorem orbit w : (forall n, arrow (w n) (w (S n))) -> exists x, forall n, cell (w n) (iter n x).
Proof.
  intros Pa. assert (Pw : forall n, steps w n) by (intros n k _; apply Pa). destruct (ends _ _ (Pa O)) as [W _].
  assert (Ex : forall n, exists y, left (w O) <= y /\ visits w n y).
  { intros n. destruct (along w n (Pw n) W) as (p & q & P & Q & _ & F). exists p. split; [lra|apply F; lra]. }
  set (E := fun x => forall n, exists y, x <= y /\ visits w n y).
  destruct (completeness E) as [c [U L]].
  { exists (right (w O)). intros x X. destruct (X 0%nat) as (y & Y & F). specialize (F O (le_n 0)).
    change (left (w O) <= y <= right (w O)) in F. lra. }
  { exists (left (w O)). exact Ex. }
  assert (near : forall n e, 0 < e -> exists y, Rabs (y - c) < e /\ visits w n y).
  { intros n e e0. apply NNPP. intros No.
    assert (Hx : exists x, E x /\ c - e < x).
    { apply NNPP. intros G. assert (c <= c - e); [|lra]. apply L. intros x X. apply Rnot_lt_le. intros Q. apply G. eauto. }
    destruct Hx as (x & X & xc). assert (c + e <= c); [|lra]. apply U. intros k.
    destruct (X (Nat.max n k)) as (y & Y & F). exists y. split; [|intros j J; apply F; lia].
    apply Rnot_lt_le. intros G. apply No. exists y. split; [apply Rabs_def1; lra|intros j J; apply F; lia]. }
  exists c. intros n. apply (limit w n c (Pw n) (near n) n). lia.
Qed.

(* -- the itinerary: intervals from which arrows go are at least delta apart -- *)
Variable delta : R.
Hypothesis delta_pos : 0 < delta.
Hypothesis apart : forall i i' j j' x y, arrow i i' -> arrow j j' -> cell i x -> cell j y -> i <> j ->
  delta <= Rabs (x - y).
Notation path := (path arrows).
Notation follows := (follows f (interval cells)).

Lemma same i i' j j' x y : arrow i i' -> arrow j j' -> cell i x -> cell j y -> Rabs (x - y) < delta -> i = j.
Proof.
  intros A B X Y L. destruct (Nat.eq_dec i j) as [|N]; auto.
  pose proof (apart _ _ _ _ _ _ A B X Y N). lra.
Qed.

Lemma iter_add n k x : iter (n + k) x = iter n (iter k x).
Proof. induction n; simpl; congruence. Qed.

Lemma follows_period w p x : (0 < p)%nat -> (forall n, w (p + n)%nat = w n) -> iter p x = x -> visits w p x ->
  follows w x.
Proof.
  intros P W E V n. induction n as [n IH] using (well_founded_induction Wf_nat.lt_wf).
  destruct (Nat.le_gt_cases n p) as [L|L]; [apply V, L|].
  replace n with (p + (n - p))%nat at 1 by lia. rewrite W.
  replace n with (n - p + p)%nat at 2 by lia. rewrite iter_add, E. apply IH. lia.
Qed.

Lemma itinerary_theorem : itinerary_map f cells arrows.
Proof.
  split; [intros w W; apply (orbit w W)|]. split; [|split].
  - intros w p W P E. destruct (periodic w p P (fun k _ => W k)) as (x & X & V).
    { rewrite <- (E O). f_equal. lia. }
    exists x. split; auto. apply (follows_period w p); auto.
  - intros w v x W V F G n. apply (same _ _ _ _ _ _ (W n) (V n) (F n) (G n)).
    rewrite Rminus_eq_0, Rabs_R0. exact delta_pos.
  - intros w x n W F. induction n as [|n (e & E & H)].
    + exists delta. split; [exact delta_pos|]. intros v y V G D k L. assert (k = O) by lia. subst k.
      apply (same _ _ _ _ _ _ (V O) (W O) (G O) (F O)). exact D.
    + assert (C : continuity_pt (iter (S n)) x).
      { apply (iter_continuous w); [intros k _; apply W|intros k _; apply F]. }
      destruct (C delta delta_pos) as (d & D & N). exists (Rmin e d). split; [apply Rmin_pos; auto|].
      intros v y V G B k L. pose proof (Rmin_l e d). pose proof (Rmin_r e d).
      destruct (Nat.eq_dec k (S n)) as [->|]; [|apply (H v y V G); [lra|lia]].
      apply (same _ _ _ _ _ _ (V (S n)) (W (S n)) (G (S n)) (F (S n))).
      destruct (Req_dec y x) as [->|Ne]; [rewrite Rminus_eq_0, Rabs_R0; exact delta_pos|].
      apply N. split; [split; [exact I|auto]|]. change (Rabs (y - x) < d). lra.
Qed.

(* -- the points that follow a path are a compact set -- *)
Definition inside (i : nat) (x : R) : bool :=
  if Rle_dec (left i) x then (if Rle_dec x (right i) then true else false) else false.

Lemma inside_cell i x : inside i x = true <-> cell i x.
Proof.
  unfold inside, interval, left, right. destruct Rle_dec; [destruct Rle_dec|]; split; intros; try discriminate; tauto.
Qed.

Lemma adherent c : (forall e, 0 < e -> exists y, K y /\ Rabs (y - c) < e) ->
  forall n, exists w, steps w (S n) /\ visits w n c.
Proof.
  intros H n. set (letters := map fst arrows).
  destruct (frequent _ (fun l y => exists v, path v /\ follows v y /\ map v (seq 0 (S (S n))) = l) c (tuples letters (S (S n))))
    as (l & _ & F).
  { intros e E. destruct (H e E) as (y & (v & V & G) & D). exists y, (map v (seq 0 (S (S n)))). split; [|eauto].
    apply in_tuples. intros k. apply (in_map fst _ _ (V k)). }
  destruct (F 1 Rlt_0_1) as (y & (v & V & _ & E) & _). subst l. exists v. split; [intros k _; apply V|].
  apply limit; [intros k _; apply V|]. intros e E. destruct (F e E) as (z & (u & U & G & M) & D). exists z.
  split; auto. intros k L. replace (v k) with (u k); [apply G|].
  apply (proj1 map_ext_in_iff M). apply in_seq. lia.
Qed.

Lemma K_closed : closed_set K.
Proof.
  apply adherent_closed. intros c H. pose proof (adherent c H) as A.
  set (letter := fun n => match find (fun i => inside i (iter n c)) (map fst arrows) with Some i => i | None => 0%nat end).
  assert (Is : forall w n k, steps w (S n) -> visits w n c -> (k <= n)%nat -> letter k = w k).
  { intros w n k S V L. assert (Ar : arrow (w k) (w (Datatypes.S k))) by (apply S; lia). unfold letter.
    destruct (find _ _) as [i|] eqn:Fi.
    - apply find_some in Fi. destruct Fi as [I C]. apply inside_cell in C. apply in_map_iff in I.
      destruct I as ([i' j] & E & I). simpl in E. subst i'. apply (same _ _ _ _ _ _ I Ar C (V k L)).
      rewrite Rminus_eq_0, Rabs_R0. exact delta_pos.
    - pose proof (find_none _ _ Fi (w k) (in_map fst _ _ Ar)) as N. simpl in N.
      rewrite (proj2 (inside_cell _ _) (V k L)) in N. discriminate. }
  exists letter. split; intros n; destruct (A (S n)) as (w & S & V).
  - rewrite (Is w (Datatypes.S n) n S V ltac:(lia)), (Is w (Datatypes.S n) (Datatypes.S n) S V ltac:(lia)). apply S. lia.
  - rewrite (Is w (Datatypes.S n) n S V ltac:(lia)). apply V. lia.
Qed.

Lemma K_compact : compact K.
Proof.
  apply compact_P5; [apply K_closed|]. destruct (cells_bounded cells) as (m & M & _ & B). exists m, M.
  intros x (w & W & F). apply (B (w O) x (F O)).
Qed.

(* -- where f expands, a point is all that follows a path -- *)
Theorem semiconjugate_theorem : semiconjugate f cells arrows.
Proof. split; [apply itinerary_theorem|apply K_compact]. Qed.

Theorem conjugate_theorem m : 1 < m -> (forall i j x y, arrow i j -> cell i x -> cell i y ->
  m * Rabs (x - y) <= Rabs (f x - f y)) -> conjugate f cells arrows m.
Proof.
  intros m1 Ex. split; [apply semiconjugate_theorem|]. split; [exact m1|]. exists (width cells).
  intros n w v x y W V F G A. assert (P : 0 < m ^ n) by (apply pow_lt; lra).
  assert (E : forall k, (k <= n)%nat -> m ^ k * Rabs (x - y) <= Rabs (iter k x - iter k y)).
  { induction k as [|k IH]; intros L; simpl; [lra|]. specialize (IH ltac:(lia)).
    pose proof (G k) as Gk. rewrite <- (A k) in Gk by lia.
    pose proof (Ex _ _ _ _ (W k) (F k) Gk). assert (m * (m ^ k * Rabs (x - y)) <= m * Rabs (iter k x - iter k y))
      by (apply Rmult_le_compat_l; lra). lra. }
  specialize (E n (le_n n)). pose proof (G n) as Gn. rewrite <- (A n) in Gn by lia.
  pose proof (width_bound _ _ _ _ (F n) Gn). apply Rmult_le_reg_l with (m ^ n); auto.
  replace (m ^ n * (width cells / m ^ n)) with (width cells) by (field; lra). lra.
Qed.
End Paths.
