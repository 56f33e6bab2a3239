(* A checker of covering graphs in Coq: where it computes true, the theorems of Graph.v hold.
   Data: a formula, which iterate of it, intervals [l / d, r / d] in ascending order, arrows. *)
From Coq Require Import Reals ZArith Psatz Lia List Bool.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Float_full Interval Xreal.
From Oscillator Require Import Numbers Formula Graph Paths Entropy Cells.
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
Definition restricted (x : R) : R := value e x 0.
Notation at_0 := (I.fromZ prec 0).

Fixpoint image (k : nat) (B : I.type) : option I.type :=
  match k with
  | O => Some B
  | S k => match image k B with
    | Some E => let V := enclose bits e E at_0 in if I.real V then Some V else None
    | None => None
    end
  end.

(* Of the derivative of the iterate, by the chain rule. *)
Fixpoint slope (k : nat) (B : I.type) : option I.type :=
  match k with
  | O => Some (I.fromZ prec 1)
  | S k => match image k B, slope k B with
    | Some E, Some D =>
      let S := enclose bits (diff true e) E at_0 in
      if I.real S && I.real (enclose bits e E at_0) then Some (I.mul prec S D) else None
    | _, _ => None
    end
  end.

Lemma zero_holds : holds at_0 0.
Proof. apply I.fromZ_correct. Qed.

Lemma image_holds k : forall B x E, image k B = Some E -> holds B x ->
  holds E (iter restricted k x) /\ continuous (iter restricted k) x.
Proof.
  induction k as [|k IH]; intros B x E H X; simpl in *.
  - injection H as <-. split; [exact X|apply continuous_id].
  - destruct (image k B) as [V|] eqn:Q; [|discriminate]. destruct (IH B x V Q X) as [HV C].
    destruct (I.real (enclose bits e V at_0)) eqn:Re; [|discriminate]. injection H as <-.
    destruct (enclosed_real bits e V _ _ _ HV zero_holds Re) as [D HE]. split; [exact HE|].
    apply (continuous_value (iter restricted k) (fun _ => 0)); [exact C|apply continuous_const|exact D].
Qed.

Lemma slope_holds k : forall B x D, slope k B = Some D -> holds B x ->
  exists d, is_derive (iter restricted k) x d /\ holds D d.
Proof.
  induction k as [|k IH]; intros B x D H X; simpl in *.
  - injection H as <-. exists 1. split; [apply (is_derive_id x)|apply I.fromZ_correct].
  - destruct (image k B) as [V|] eqn:Q; [|discriminate]. destruct (slope k B) as [W|] eqn:Q'; [|discriminate].
    destruct (image_holds k B x V Q X) as [HV _]. destruct (IH B x W Q' X) as (d & Dd & Hd).
    destruct (I.real (enclose bits (diff true e) V at_0)) eqn:R1; [|discriminate].
    destruct (I.real (enclose bits e V at_0)) eqn:R2; [|discriminate]. injection H as <-.
    destruct (enclosed_real bits _ V _ _ _ HV zero_holds R1) as [E1 H1]. destruct (enclosed_real bits _ V _ _ _ HV zero_holds R2) as [E2 _].
    exists (value (diff true e) (iter restricted k x) 0 * d). split; [|apply (I.mul_correct prec _ _ (Xreal _) (Xreal d)); auto].
    replace (_ * d) with (slope_of (iter restricted k) (fun _ => 0) x d 0 e) by (unfold slope_of; ring).
    apply derivative; auto. apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
Qed.
End Iterates.

Section Check.
Variable e : formula.
Variable power : nat.
Variable unit : positive.
Variable ends : list (Z * Z).
Variable arrows : list (nat * nat).
Notation G := (iter (restricted e) power).
Notation number := (fun bits => number bits unit).
Notation ends_of := (ends_of ends).
Notation cells := (cells unit ends).
Notation sources := (sources arrows).
Notation whole := (fun bits i => range bits unit (fst (ends_of i)) (snd (ends_of i))).

Definition good_arrow (ij : nat * nat) : bool :=
  let (l, r) := ends_of (fst ij) in let (a, b) := ends_of (snd ij) in
  sometime (fun bits => match image e bits power (number bits l), image e bits power (number bits r) with
    | Some L, Some R => (at_most bits unit L a && at_least bits unit R b) || (at_most bits unit R a && at_least bits unit L b)
    | _, _ => false
    end).
Definition DEPTH := 12%nat.
Definition good_source (i : nat) : bool := sometime (fun bits =>
  always (fun B => match image e bits power B with Some _ => true | None => false end) DEPTH (whole bits i)).
Definition check : bool := placed ends arrows && forallb good_source sources && forallb good_arrow arrows.
Hypothesis checked : check = true.

Lemma checks : placed ends arrows = true /\ (forall i, In i sources -> good_source i = true) /\
  forall a, In a arrows -> good_arrow a = true.
Proof.
  unfold check in checked. rewrite !andb_true_iff, !forallb_forall in checked. tauto.
Qed.

Lemma continuous_there i x : In i sources -> within unit ends i x -> continuity_pt G x.
Proof.
  intros S X. destruct checks as (_ & H & _). specialize (H i S).
  apply sometime_holds in H. destruct H as (bits & H). apply continuity_pt_filterlim.
  apply (always_holds (fun x => continuous G x) _ DEPTH) with (2 := H); [|apply range_holds, X].
  intros B y T HB. destruct (image e bits power B) as [V|] eqn:Q; [|discriminate]. apply (image_holds e bits power B y V Q HB).
Qed.

Lemma covers_along i j : In (i, j) arrows -> spans G (ratio unit (fst (ends_of i))) (ratio unit (snd (ends_of i)))
  (ratio unit (fst (ends_of j))) (ratio unit (snd (ends_of j))).
Proof.
  intros A. destruct checks as (_ & _ & H). specialize (H _ A). unfold good_arrow in H. cbn [fst snd] in H.
  destruct (ends_of i) as [l r], (ends_of j) as [a b]. cbn [fst snd].
  apply sometime_holds in H. destruct H as (bits & H).
  destruct (image e bits power (number bits l)) as [L|] eqn:QL; [|discriminate].
  destruct (image e bits power (number bits r)) as [R|] eqn:QR; [|discriminate].
  destruct (image_holds _ _ _ _ _ _ QL (number_holds bits unit l)) as [HL _].
  destruct (image_holds _ _ _ _ _ _ QR (number_holds bits unit r)) as [HR _].
  unfold spans. rewrite orb_true_iff, !andb_true_iff in H. destruct H as [[U V]|[U V]]; [left|right];
    eauto using at_most_holds, at_least_holds.
Qed.

Theorem graph_checked : semiconjugate G cells arrows.
Proof. apply cells_semiconjugate; [apply checks|apply continuous_there|apply covers_along]. Qed.

(* |G'| >= m / n on each interval from which an arrow goes, with one sign. *)
Variables m n : positive.
Definition steep (way : bool) (bits : positive) (B : I.type) : bool :=
  match slope e bits power B with
  | Some D => not_negative (I.sub (F.PtoP bits) (if way then D else I.neg D)
      (I.div (F.PtoP bits) (I.fromZ (F.PtoP bits) (Zpos m)) (I.fromZ (F.PtoP bits) (Zpos n))))
  | None => false
  end.
Definition steep_source (i : nat) : bool :=
  sometime (fun bits => if always (steep true bits) DEPTH (whole bits i) then true else always (steep false bits) DEPTH (whole bits i)).
Definition expanding : bool := (n <? m)%positive && forallb steep_source sources.

Lemma steep_holds way bits B x : steep way bits B = true -> holds B x ->
  exists s, is_derive G x s /\ IZR (Zpos m) / IZR (Zpos n) <= if way then s else - s.
Proof.
  intros T H. unfold steep in T. destruct (slope e bits power B) as [D|] eqn:Q; [|discriminate].
  destruct (slope_holds _ _ _ _ _ _ Q H) as (s & Ds & Hs). exists s. split; [exact Ds|].
  assert (Hw : holds (if way then D else I.neg D) (if way then s else - s)) by (destruct way; auto using neg_holds).
  pose proof (not_negative_holds _ _ (sub_holds _ _ _ _ Hw (number_holds bits n (Zpos m))) T) as P.
  unfold ratio in P. lra.
Qed.

Theorem expansion_checked : expanding = true -> conjugate G cells arrows (IZR (Zpos m) / IZR (Zpos n)).
Proof.
  unfold expanding. rewrite andb_true_iff, forallb_forall. intros [mn E].
  apply cells_conjugate; [apply checks|apply continuous_there|apply covers_along| |].
  - apply Pos.ltb_lt in mn. apply (ratio_lt n (Zpos n) (Zpos m)) in mn. unfold ratio in mn.
    pose proof (unit_pos n). replace (IZR (Zpos n) / IZR (Zpos n)) with 1 in mn by (field; lra). exact mn.
  - intros i S. specialize (E i S). apply sometime_holds in E. destruct E as (bits & E).
    destruct (always (steep true bits) DEPTH (whole bits i)) eqn:Q; [exists true|exists false]; intros z Z.
    + apply (always_holds _ _ DEPTH (steep_holds true bits) (whole bits i) z Q), range_holds, Z.
    + apply (always_holds _ _ DEPTH (steep_holds false bits) (whole bits i) z E), range_holds, Z.
Qed.

Theorem growth_checked v p g : growing arrows (length ends) v p g = true -> entropy_at_least on_line G (interval cells) arrows p g.
Proof. apply cells_growth; [apply checks|apply continuous_there|apply covers_along]. Qed.
End Check.
