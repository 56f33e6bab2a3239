(* A checker of covering graphs in Coq: where it computes true, the theorems of Graph.v hold.
   Data: a formula, which iterate of it, intervals [l / d, r / d] in ascending order, arrows. *)
From Coq Require Import Reals ZArith Psatz Lia List Bool.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Float_full Interval Xreal.
From Oscillator Require Import Calculus Formula Graph Paths Entropy.
Import ListNotations.
Open Scope R_scope.

(* A test of intervals, on parts of one. (`if`, as Coq evaluates both sides of || and &&.) *)
Fixpoint always (test : I.type -> bool) (depth : nat) (B : I.type) : bool :=
  if test B then true else match depth with
  | O => false
  | S n => if always test n (fst (I.bisect B)) then always test n (snd (I.bisect B)) else false
  end.

Lemma always_holds (P : R -> Prop) test depth : (forall B x, test B = true -> holds B x -> P x) ->
  forall B x, always test depth B = true -> holds B x -> P x.
Proof.
  intros T. induction depth as [|n IH]; intros B x A H; simpl in A;
    (destruct (test B) eqn:Q; [exact (T B x Q H)|]); [discriminate|].
  destruct (always test n (fst (I.bisect B))) eqn:L; [|discriminate].
  destruct (I.bisect_correct B (Xreal x) H) as [G|G]; apply IH in G; auto.
Qed.

Definition precisions : list positive := [64; 256; 1024]%positive.
Definition sometime (test : positive -> bool) : bool :=
  fold_right (fun bits (rest : unit -> bool) _ => if test bits then true else rest tt) (fun _ => false) precisions tt.

Lemma sometime_holds test : sometime test = true -> exists bits, test bits = true.
Proof.
  unfold sometime. induction precisions as [|b l IH]; simpl; [discriminate|]. destruct (test b) eqn:Q; eauto.
Qed.

Section Iterates.
Variable e : formula.
Variable bits : positive.
Notation prec := (F.PtoP bits).

Fixpoint image (k : nat) (B : I.type) : option I.type :=
  match k with
  | O => Some B
  | S k => match image k B with
    | Some E => let V := enclose bits e E in if I.real V then Some V else None
    | None => None
    end
  end.

(* Of the derivative of the iterate, by the chain rule. *)
Fixpoint slope (k : nat) (B : I.type) : option I.type :=
  match k with
  | O => Some (I.fromZ prec 1)
  | S k => match image k B, slope k B with
    | Some E, Some D =>
      let S := enclose bits (diff e) E in
      if I.real S && I.real (enclose bits e E) then Some (I.mul prec S D) else None
    | _, _ => None
    end
  end.

Lemma image_holds k : forall B x E, image k B = Some E -> holds B x ->
  holds E (iter (value e) k x) /\ continuous (iter (value e) k) x.
Proof.
  induction k as [|k IH]; intros B x E H X; simpl in *.
  - injection H as <-. split; [exact X|apply continuous_id].
  - destruct (image k B) as [V|] eqn:Q; [|discriminate]. destruct (IH B x V Q X) as [HV C].
    destruct (I.real (enclose bits e V)) eqn:Re; [|discriminate]. injection H as <-.
    destruct (enclosed_real bits e V _ HV Re) as [D HE]. split; [exact HE|].
    apply (continuous_comp (iter (value e) k) (value e)); [exact C|apply continuous_value, D].
Qed.

Lemma slope_holds k : forall B x D, slope k B = Some D -> holds B x ->
  exists d, is_derive (iter (value e) k) x d /\ holds D d.
Proof.
  induction k as [|k IH]; intros B x D H X; simpl in *.
  - injection H as <-. exists 1. split; [apply (is_derive_id x)|apply I.fromZ_correct].
  - destruct (image k B) as [V|] eqn:Q; [|discriminate]. destruct (slope k B) as [W|] eqn:Q'; [|discriminate].
    destruct (image_holds k B x V Q X) as [HV _]. destruct (IH B x W Q' X) as (d & Dd & Hd).
    destruct (I.real (enclose bits (diff e) V)) eqn:R1; [|discriminate].
    destruct (I.real (enclose bits e V)) eqn:R2; [|discriminate]. injection H as <-.
    destruct (enclosed_real bits _ V _ HV R1) as [E1 H1]. destruct (enclosed_real bits _ V _ HV R2) as [E2 _].
    exists (value (diff e) (iter (value e) k x) * d). split; [|apply (I.mul_correct prec _ _ (Xreal _) (Xreal d)); auto].
    rewrite Rmult_comm. apply (is_derive_comp (value e) (iter (value e) k)); [apply derivative; auto|exact Dd].
Qed.
End Iterates.

Section Check.
Variable e : formula.
Variable power : nat.
Variable d : positive.
Variable ends : list (Z * Z).
Variable arrows : list (nat * nat).

Notation G := (iter (value e) power).
Definition fraction (n : Z) : R := IZR n / IZR (Zpos d).
Definition cells : list (R * R) := map (fun lr => (fraction (fst lr), fraction (snd lr))) ends.
Definition ends_of (i : nat) : Z * Z := nth i ends (0, 0)%Z.
Definition point (bits : positive) (n : Z) : I.type :=
  I.div (F.PtoP bits) (I.fromZ (F.PtoP bits) n) (I.fromZ (F.PtoP bits) (Zpos d)).
Definition box (bits : positive) (i : nat) : I.type :=
  I.join (point bits (fst (ends_of i))) (point bits (snd (ends_of i))).

Definition up_to (bits : positive) (V : I.type) (n : Z) : bool :=
  match I.sign_large (I.sub (F.PtoP bits) V (point bits n)) with Xlt | Xeq => true | _ => false end.
Definition from_ (bits : positive) (V : I.type) (n : Z) : bool :=
  match I.sign_large (I.sub (F.PtoP bits) V (point bits n)) with Xgt | Xeq => true | _ => false end.
Definition good_arrow (ij : nat * nat) : bool :=
  let (l, r) := ends_of (fst ij) in let (a, b) := ends_of (snd ij) in
  (fst ij <? length ends)%nat && (snd ij <? length ends)%nat &&
  sometime (fun bits => match image e bits power (point bits l), image e bits power (point bits r) with
    | Some L, Some R => (up_to bits L a && from_ bits R b) || (up_to bits R a && from_ bits L b)
    | _, _ => false
    end).
Definition DEPTH := 12%nat.
Definition good_source (i : nat) : bool := sometime (fun bits =>
  always (fun B => match image e bits power B with Some _ => true | None => false end) DEPTH (box bits i)).
Fixpoint ascending (l : list (Z * Z)) : bool :=
  match l with
  | (l, r) :: t => (l <? r)%Z && match t with (a, _) :: _ => (r <? a)%Z | [] => true end && ascending t
  | [] => true
  end.
Definition sources : list nat := nodup Nat.eq_dec (map fst arrows).
Definition check : bool := ascending ends && forallb good_source sources && forallb good_arrow arrows.

Lemma d_pos : 0 < IZR (Zpos d).
Proof. apply IZR_lt. lia. Qed.

Lemma point_holds bits n : holds (point bits n) (fraction n).
Proof.
  unfold holds, point. pose proof (I.div_correct (F.PtoP bits) _ _ _ _ (I.fromZ_correct (F.PtoP bits) n) (I.fromZ_correct (F.PtoP bits) (Zpos d))) as H.
  simpl in H. unfold Xdiv' in H. destruct (is_zero_spec (IZR (Zpos d))); [pose proof d_pos; lra|exact H].
Qed.

Lemma box_holds bits i x : fraction (fst (ends_of i)) <= x <= fraction (snd (ends_of i)) -> holds (box bits i) x.
Proof.
  intros H. unfold holds, box. apply (contains_connected _ (fraction (fst (ends_of i))) (fraction (snd (ends_of i)))); auto;
    apply I.join_correct; [left|right]; apply point_holds.
Qed.

Lemma up_to_le bits V n v : holds V v -> up_to bits V n = true -> v <= fraction n.
Proof.
  intros H U. unfold up_to in U. pose proof (I.sign_large_correct (I.sub (F.PtoP bits) V (point bits n))) as S.
  pose proof (I.sub_correct (F.PtoP bits) _ _ _ _ H (point_holds bits n)) as C.
  destruct (I.sign_large _); try discriminate; specialize (S _ C); simpl in S; [injection S|]; lra.
Qed.

Lemma from_ge bits V n v : holds V v -> from_ bits V n = true -> fraction n <= v.
Proof.
  intros H U. unfold from_ in U. pose proof (I.sign_large_correct (I.sub (F.PtoP bits) V (point bits n))) as S.
  pose proof (I.sub_correct (F.PtoP bits) _ _ _ _ H (point_holds bits n)) as C.
  destruct (I.sign_large _); try discriminate; specialize (S _ C); simpl in S; [injection S|]; lra.
Qed.

Lemma cells_ends i : (i < length ends)%nat -> left cells i = fraction (fst (ends_of i)) /\ right cells i = fraction (snd (ends_of i)).
Proof.
  intros L. unfold left, right, cells. rewrite (nth_indep _ (0, 0) (fraction 0, fraction 0)) by (rewrite map_length; auto).
  rewrite (map_nth (fun lr => (fraction (fst lr), fraction (snd lr))) ends (0, 0)%Z). auto.
Qed.

Hypothesis checked : check = true.

Lemma checks : ascending ends = true /\ (forall i, In i (map fst arrows) -> good_source i = true) /\
  forall a, In a arrows -> good_arrow a = true.
Proof.
  unfold check in checked. rewrite !andb_true_iff, !forallb_forall in checked. destruct checked as [[A S] B].
  split; auto. split; auto. intros i H. apply S, nodup_In, H.
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

Lemma numbers i j : arrow arrows i j -> (i < length ends)%nat /\ (j < length ends)%nat.
Proof.
  intros A. destruct checks as (_ & _ & H). specialize (H _ A). unfold good_arrow in H. simpl in H.
  destruct (ends_of i), (ends_of j). rewrite !andb_true_iff, !Nat.ltb_lt in H. tauto.
Qed.

Lemma fraction_le m n : (m <= n)%Z -> fraction m <= fraction n.
Proof.
  intros H. apply IZR_le in H. apply Rmult_le_compat_r; auto. apply Rlt_le, Rinv_0_lt_compat, d_pos.
Qed.

Lemma in_order i j : arrow arrows i j -> left cells i <= right cells i /\ left cells j <= right cells j.
Proof.
  intros A. destruct (numbers i j A) as [I J]. destruct checks as (As & _). pose proof (ascending_lt ends As) as L.
  destruct (cells_ends i I) as [-> ->], (cells_ends j J) as [-> ->].
  destruct (L i I) as [Li _], (L j J) as [Lj _]. split; apply fraction_le; unfold ends_of; lia.
Qed.

Lemma cell_box i j x : arrow arrows i j -> cell cells i x ->
  fraction (fst (ends_of i)) <= x <= fraction (snd (ends_of i)).
Proof. intros A X. destruct (cells_ends i (proj1 (numbers i j A))) as [<- <-]. exact X. Qed.

Lemma smooth i j x : arrow arrows i j -> cell cells i x -> continuity_pt G x.
Proof.
  intros A X. destruct checks as (_ & S & _). specialize (S i (in_map fst _ _ A)).
  apply sometime_holds in S. destruct S as (bits & S). apply continuity_pt_filterlim.
  apply (always_holds (fun x => continuous G x) _ DEPTH) with (2 := S).
  - intros B y T H. destruct (image e bits power B) as [V|] eqn:Q; [|discriminate]. apply (image_holds e bits power B y V Q H).
  - apply box_holds, (cell_box i j), X. exact A.
Qed.

Lemma cover i j : arrow arrows i j -> spans G (left cells i) (right cells i) (left cells j) (right cells j).
Proof.
  intros A. destruct (numbers i j A) as [I J]. destruct checks as (_ & _ & H). specialize (H _ A).
  unfold good_arrow in H. simpl in H.
  destruct (cells_ends i I) as [-> ->], (cells_ends j J) as [-> ->].
  destruct (ends_of i) as [l r], (ends_of j) as [a b]. simpl. rewrite !andb_true_iff in H. destruct H as [_ H].
  apply sometime_holds in H. destruct H as (bits & H).
  destruct (image e bits power (point bits l)) as [L|] eqn:QL; [|discriminate].
  destruct (image e bits power (point bits r)) as [R|] eqn:QR; [|discriminate].
  destruct (image_holds _ _ _ _ _ _ QL (point_holds bits l)) as [HL _].
  destruct (image_holds _ _ _ _ _ _ QR (point_holds bits r)) as [HR _].
  unfold spans. rewrite orb_true_iff, !andb_true_iff in H. destruct H as [[U V]|[U V]]; [left|right];
    split; eauto using up_to_le, from_ge.
Qed.

Definition delta : R := / IZR (Zpos d).

Lemma delta_pos : 0 < delta.
Proof. apply Rinv_0_lt_compat, d_pos. Qed.

Lemma apart i i' j j' x y : arrow arrows i i' -> arrow arrows j j' -> cell cells i x -> cell cells j y -> i <> j ->
  delta <= Rabs (x - y).
Proof.
  assert (Lt : forall i i' j j' x y, arrow arrows i i' -> arrow arrows j j' -> cell cells i x -> cell cells j y ->
    (i < j)%nat -> delta <= y - x).
  { intros p p' q q' u v A B U V L. apply (cell_box p p' u A) in U. apply (cell_box q q' v B) in V.
    destruct checks as (As & _). destruct (ascending_lt ends As q (proj1 (numbers q q' B))) as [_ F].
    specialize (F p L). assert (S : (snd (ends_of p) + 1 <= fst (ends_of q))%Z) by (unfold ends_of; lia).
    apply fraction_le in S. unfold fraction in S at 1. rewrite plus_IZR in S. unfold fraction, delta in *.
    unfold Rdiv in *. rewrite Rmult_plus_distr_r in S. lra. }
  intros A B X Y N. destruct (Nat.lt_gt_cases i j) as [T _]. destruct (T N) as [L|L].
  - pose proof (Lt _ _ _ _ _ _ A B X Y L). pose proof delta_pos. rewrite Rabs_minus_sym, Rabs_pos_eq; lra.
  - pose proof (Lt _ _ _ _ _ _ B A Y X L). pose proof delta_pos. rewrite Rabs_pos_eq; lra.
Qed.

Theorem graph_checked : semiconjugate G cells arrows.
Proof. apply (semiconjugate_theorem G cells arrows in_order smooth cover delta delta_pos apart). Qed.

(* |G'| >= m / n on each interval from which an arrow goes, with one sign. *)
Variables m n : positive.
Definition steep (way : bool) (bits : positive) (B : I.type) : bool :=
  match slope e bits power B with
  | Some D => match I.sign_large (I.sub (F.PtoP bits) (I.mul (F.PtoP bits) (if way then D else I.neg D) (I.fromZ (F.PtoP bits) (Zpos n)))
                (I.fromZ (F.PtoP bits) (Zpos m))) with Xgt | Xeq => true | _ => false end
  | None => false
  end.
Definition steep_source (i : nat) : bool :=
  sometime (fun bits => if always (steep true bits) DEPTH (box bits i) then true else always (steep false bits) DEPTH (box bits i)).
Definition expanding : bool := (n <? m)%positive && forallb steep_source sources.

Lemma steep_holds way bits B x : steep way bits B = true -> holds B x ->
  exists s, is_derive G x s /\ IZR (Zpos m) / IZR (Zpos n) <= if way then s else - s.
Proof.
  intros T H. unfold steep in T. destruct (slope e bits power B) as [D|] eqn:Q; [|discriminate].
  destruct (slope_holds _ _ _ _ _ _ Q H) as (s & Ds & Hs). exists s. split; [exact Ds|].
  assert (Hw : holds (if way then D else I.neg D) (if way then s else - s)).
  { destruct way; [exact Hs|apply (I.neg_correct D (Xreal s)), Hs]. }
  pose proof (I.mul_correct (F.PtoP bits) _ _ _ _ Hw (I.fromZ_correct (F.PtoP bits) (Zpos n))) as M.
  pose proof (I.sub_correct (F.PtoP bits) _ _ _ _ M (I.fromZ_correct (F.PtoP bits) (Zpos m))) as C.
  match type of T with match I.sign_large ?E with _ => _ end = true => pose proof (I.sign_large_correct E) as S end.
  assert (N : 0 < IZR (Zpos n)) by (apply IZR_lt; lia).
  assert (L : IZR (Zpos m) <= (if way then s else - s) * IZR (Zpos n)).
  { destruct (I.sign_large _); try discriminate; specialize (S _ C); simpl in S; [injection S|]; lra. }
  apply Rmult_le_reg_r with (IZR (Zpos n)); auto. replace (_ / _ * _) with (IZR (Zpos m)) by (field; lra). exact L.
Qed.

Lemma expands : expanding = true -> forall i j x y, arrow arrows i j -> cell cells i x -> cell cells i y ->
  IZR (Zpos m) / IZR (Zpos n) * Rabs (x - y) <= Rabs (G x - G y).
Proof.
  intros E. unfold expanding in E. rewrite andb_true_iff, forallb_forall in E. destruct E as [_ E].
  assert (Lt : forall i j x y, arrow arrows i j -> cell cells i x -> cell cells i y -> x < y ->
    IZR (Zpos m) / IZR (Zpos n) * (y - x) <= Rabs (G y - G x)).
  { intros i j x y A X Y L. apply (cell_box i j x A) in X. apply (cell_box i j y A) in Y.
    specialize (E i (proj2 (nodup_In _ _ _) (in_map fst _ _ A))). apply sometime_holds in E. destruct E as (bits & E).
    assert (W : exists way : bool, forall z, x <= z <= y -> exists s, is_derive G z s /\
      IZR (Zpos m) / IZR (Zpos n) <= if way then s else - s).
    { destruct (always (steep true bits) DEPTH (box bits i)) eqn:Q; [exists true|exists false]; intros z Z.
      - apply (always_holds (fun z => exists s, is_derive G z s /\ _) _ DEPTH (steep_holds _ bits) _ z Q), box_holds. lra.
      - apply (always_holds (fun z => exists s, is_derive G z s /\ _) _ DEPTH (steep_holds _ bits) _ z E), box_holds. lra. }
    destruct W as (way & W).
    destruct (mvt G (Derive G) x y L) as (c & C & D).
    { intros z Z. destruct (W z Z) as (s & S & _). rewrite (is_derive_unique _ _ _ S). exact S. }
    destruct (W c C) as (s & S & B). rewrite (is_derive_unique _ _ _ S) in D. rewrite D, Rabs_mult, (Rabs_pos_eq (y - x)) by lra.
    apply Rmult_le_compat_r; [lra|]. eapply Rle_trans; [exact B|]. destruct way; [apply Rle_abs|].
    rewrite <- Rabs_Ropp. apply Rle_abs. }
  intros i j x y A X Y. destruct (Rtotal_order x y) as [L|[->|L]].
  - rewrite Rabs_minus_sym, (Rabs_minus_sym (G x)), (Rabs_pos_eq (y - x)) by lra. apply (Lt i j); auto.
  - rewrite !Rminus_eq_0, Rabs_R0. lra.
  - rewrite (Rabs_pos_eq (x - y)) by lra. apply (Lt i j); auto.
Qed.

Theorem expansion_checked : expanding = true -> conjugate G cells arrows (IZR (Zpos m) / IZR (Zpos n)).
Proof.
  intros E. apply (conjugate_theorem G cells arrows in_order smooth cover delta delta_pos apart); [|apply (expands E)].
  unfold expanding in E. apply andb_true_iff in E. destruct E as [E _]. apply Pos.ltb_lt in E.
  assert (0 < IZR (Zpos n)) by (apply IZR_lt; lia). assert (IZR (Zpos n) < IZR (Zpos m)) by (apply IZR_lt; lia).
  apply Rmult_lt_reg_r with (IZR (Zpos n)); auto. replace (_ / _ * _) with (IZR (Zpos m)) by (field; lra). lra.
Qed.

(* A^p v >= g v for the matrix A of the graph, in whole numbers. *)
Variable v : list Z.
Variable p : nat.
Variable g : Z.
Definition step (u : list Z) : list Z :=
  map (fun i => total (map (fun j => nth j u 0%Z) (successors arrows i))) (seq 0 (length ends)).
Fixpoint distinct (l : list (nat * nat)) : bool :=
  match l with
  | [] => true
  | a :: t => negb (existsb (fun b => (fst a =? fst b)%nat && (snd a =? snd b)%nat) t) && distinct t
  end.
Definition growing : bool :=
  (length v =? length ends)%nat && (0 <=? g)%Z && forallb (Z.leb 0) v && distinct arrows &&
  forallb (fun a => existsb (fun b => (fst b =? snd a)%nat) arrows) arrows &&
  forallb (fun ab => (g * fst ab <=? snd ab)%Z) (combine v (Nat.iter p step v)) &&
  existsb (fun a => (0 <? nth (fst a) v 0)%Z) arrows.

Lemma distinct_NoDup l : distinct l = true -> NoDup l.
Proof.
  induction l as [|[a b] t IH]; intros H; constructor; simpl in H; apply andb_true_iff in H; destruct H as [H D]; auto.
  intros I. apply negb_true_iff, not_true_iff_false in H. apply H, existsb_exists. exists (a, b).
  rewrite !Nat.eqb_refl. auto.
Qed.

Lemma step_weight k : length v = length ends -> length (Nat.iter k step v) = length ends /\
  forall i, (i < length ends)%nat -> nth i (Nat.iter k step v) 0%Z = weight arrows (fun j => nth j v 0%Z) k i.
Proof.
  intros L. induction k as [|k [IL IH]]; simpl; [auto|]. unfold step at 1 3. rewrite map_length, seq_length. split; auto.
  intros i Hi. rewrite (nth_indep _ 0%Z (total (map (fun j => nth j (Nat.iter k step v) 0%Z) (successors arrows 0))))
    by (rewrite map_length, seq_length; auto).
  rewrite (map_nth (fun i => total (map (fun j => nth j (Nat.iter k step v) 0%Z) (successors arrows i)))).
  rewrite seq_nth by auto. simpl. f_equal. apply map_ext_in. intros j J. apply IH.
  apply successor in J. apply (numbers i j J).
Qed.

Theorem growth_checked : growing = true -> entropy_at_least G cells arrows p g.
Proof.
  unfold growing. rewrite !andb_true_iff. intros [[[[[[L g0] P] D] N] W] E].
  apply Nat.eqb_eq in L. apply Z.leb_le in g0. apply existsb_exists in E. destruct E as ([i j] & A & V). apply Z.ltb_lt in V.
  rewrite forallb_forall in P, N, W.
  assert (P' : forall i, (0 <= nth i v 0)%Z).
  { intros k. destruct (Nat.lt_ge_cases k (length v)) as [K|K]; [apply Z.leb_le, P, nth_In, K|rewrite nth_overflow; lia]. }
  apply (entropy_theorem G cells arrows) with (delta := delta) (v := fun j => nth j v 0%Z) (top := total v) (i := i) (j := j); auto.
  - apply distinct_NoDup, D.
  - intros a b B. specialize (N _ B). apply existsb_exists in N. destruct N as ([c k] & C & Q). apply Nat.eqb_eq in Q.
    simpl in Q. subst c. eauto.
  - apply (proj1 graph_checked).
  - apply delta_pos.
  - apply apart.
  - intros k. destruct (Nat.lt_ge_cases k (length ends)) as [K|K].
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
End Check.
