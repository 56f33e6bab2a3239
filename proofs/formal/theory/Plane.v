(* A checker of covering graphs of parallelograms in the plane, with one unstable direction and cones:
   where it computes true, each two-sided path is that of exactly one full orbit. *)
From Coq Require Import Reals ZArith Psatz Lia List Bool.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Float_full Interval Xreal.
From Oscillator Require Import Calculus Histories Crossed Numbers Graph Paths Entropy Formula Stages Checker.
Import ListNotations.
Open Scope R_scope.

(* The points (c + q1 u + q2 v) / unit, q1 and q2 in [-1, 1]; q1 is unstable. *)
Record hset := Hset { cx : Z; cy : Z; ux : Z; uy : Z; vx : Z; vy : Z }.
(* In coordinates |dx'/dx| >= p, |dx'/dy| <= q, |dy'/dx| <= r, |dy'/dy| <= s; the cones
   |dy| <= width |dx|; the rate at which orbits of one history draw near. *)
Record rates := Rates { p_ : Z; q_ : Z; r_ : Z; s_ : Z; width_ : Z; rate_ : Z }.

Section Plane.
Variable F : stage.
Variable power : nat.
Variables unit parts : positive.       (* numbers of sets, and rates, are in 1 / unit and 1 / parts *)
Variable sets : list hset.
Variable arrows : list (nat * nat).
Variable bound : rates.
Notation ratio := (ratio unit).
Notation part := (Numbers.ratio parts).
Notation set i := (nth i sets (Hset 0 0 (Zpos unit) 0 0 (Zpos unit))).
Notation det s := (ux s * vy s - vx s * uy s)%Z.

Definition quotient (n : Z) : formula := Div (Integer n) (Integer (Zpos unit)).
Definition charting (s : hset) : stage :=
  (Add (Add (quotient (cx s)) (Mul (quotient (ux s)) X)) (Mul (quotient (vx s)) Y),
   Add (Add (quotient (cy s)) (Mul (quotient (uy s)) X)) (Mul (quotient (vy s)) Y)).
Definition from_centre (V : formula) (n : Z) : formula := Sub (Mul (Integer (Zpos unit)) V) (Integer n).
Definition measuring (s : hset) : stage :=
  let x := from_centre X (cx s) in let y := from_centre Y (cy s) in
  (Div (Sub (Mul (Integer (vy s)) x) (Mul (Integer (vx s)) y)) (Integer (det s)),
   Div (Sub (Mul (Integer (ux s)) y) (Mul (Integer (uy s)) x)) (Integer (det s))).
(* The map from coordinates to coordinates. *)
Definition local (i j : nat) : list stage := charting (set i) :: repeat F power ++ [measuring (set j)].

(* A test of boxes [l, h] x [l', h'] / 64 on parts of [-1, 1]^2: first the unstable direction is cut. *)
Fixpoint halves (test : Z -> Z -> bool) (depth : nat) (l h : Z) : bool :=
  if test l h then true else match depth with
  | O => false
  | S n => let m := ((l + h) / 2)%Z in if halves test n l m then halves test n m h else false
  end.
Definition DEPTH := 6%nat.
Definition everywhere (test : Z -> Z -> Z -> Z -> bool) : bool :=
  halves (fun l h => halves (test l h) DEPTH (-64) 64) DEPTH (-64) 64.
Section Tests.
Variable bits : positive.
Notation prec := (F.PtoP bits).
Notation one := (I.fromZ prec 1).
Notation minus_one := (I.fromZ prec (-1)).
Notation side := (I.join minus_one one).
Notation image i j A B := (images bits (local i j) A B).

(* The face x = way is taken beyond the side of the same sign, or of the other one. *)
Definition beyond (i j : nat) (right same : bool) : bool :=
  always (fun B => match image i j (if right then one else minus_one) B with
    | Some (V, _) => if eqb right same then at_least bits 1 V 1 else at_most bits 1 V (-1)
    | None => false
    end) DEPTH side.
Notation within l h := (range bits 64 l h).
Definition radius (l h : Z) : Z := Z.max ((l + h) / 2 - l) (h - (l + h) / 2).
(* How far |y'| may be from its value in the middle of a box. *)
Definition spread (l h l' h' : Z) : I.type := number bits (64 * parts) (r_ bound * radius l h + s_ bound * radius l' h').
Definition clear (i j : nat) (l h l' h' : Z) : bool :=
  match image i j (within l h) (within l' h') with
  | Some (V, W) =>
    if above_zero (I.sub prec V one) || above_zero (I.sub prec minus_one V) || small bits 1 W 1 then true
    else match image i j (number bits 64 ((l + h) / 2)) (number bits 64 ((l' + h') / 2)) with
    | Some (_, W0) => ((-64 <=? l) && (h <=? 64) && (-64 <=? l') && (h' <=? 64))%Z && at_most bits 1 (I.add prec W0 (spread l h l' h')) 1 && at_least bits 1 (I.sub prec W0 (spread l h l' h')) (-1)
    | None => false
    end
  | None => false
  end.
Definition steep (i j : nat) (same : bool) (l h l' h' : Z) : bool :=
  match slopes bits (local i j) (within l h) (within l' h') (Matrix one (I.fromZ prec 0) (I.fromZ prec 0) one) with
  | Some J => at_least bits parts (if same then xx J else I.neg (xx J)) (p_ bound) && small bits parts (xy J) (q_ bound) &&
      small bits parts (yx J) (r_ bound) && small bits parts (yy J) (s_ bound)
  | None => false
  end.
Definition crossing (i j : nat) (same : bool) : bool :=
  if beyond i j false same then if beyond i j true same then
  if everywhere (clear i j) then everywhere (steep i j same)
  else false else false else false.
End Tests.

(* At one precision: what is false is bisected to the end, and that is slow with more bits. *)
Definition good_arrow (a : nat * nat) : bool :=
  if crossing 64 (fst a) (snd a) true then true else crossing 64 (fst a) (snd a) false.

(* A side of one of two parallelograms separates them: along the normal (a, b). *)
Definition separates (s t : hset) (ab : Z * Z) : bool :=
  let along x y := (fst ab * x + snd ab * y)%Z in
  (Z.abs (along (ux s) (uy s)) + Z.abs (along (vx s) (vy s)) + Z.abs (along (ux t) (uy t)) + Z.abs (along (vx t) (vy t))
    <? Z.abs (along (cx s - cx t) (cy s - cy t)))%Z.
Definition apart (i j : nat) : bool := let s := set i in let t := set j in
  (i =? j)%nat || existsb (separates s t) [(- uy s, ux s); (- vy s, vx s); (- uy t, ux t); (- vy t, vx t)]%Z.

Definition contracting : bool :=
  let '(Rates p q r s c k) := bound in let n := Zpos parts in
  (0 <? p)%Z && (0 <=? q)%Z && (0 <=? r)%Z && (0 <=? s)%Z && (0 <? c)%Z && (0 <=? k)%Z && (k <? n)%Z &&
  (n * n + q * c <=? k * p)%Z && (r * k + s * c <=? k * c)%Z.
Definition check_plane : bool :=
  contracting && forallb (fun s => negb (det s =? 0)%Z) sets &&
  forallb (fun a => (fst a <? length sets)%nat && (snd a <? length sets)%nat) arrows &&
  forallb (fun a => forallb (fun b => apart (fst a) (fst b)) arrows) arrows && forallb good_arrow arrows.

(* -- what it means -- *)
Definition map_ (z : R * R) : R * R := iter (Stages.apply F) power z.
Definition shapes : list (R * R * (R * R) * (R * R)) :=
  map (fun s => ((ratio (cx s), ratio (cy s)), (ratio (ux s), ratio (uy s)), (ratio (vx s), ratio (vy s)))) sets.
Definition chart (i : nat) (q : R * R) : R * R := Stages.apply (charting (set i)) q.
Definition coordinates (i : nat) (z : R * R) : R * R := Stages.apply (measuring (set i)) z.
Notation square := (box nat (fun _ => -1) (fun _ => 1) (fun _ => -1) (fun _ => 1)).
Notation cell := (parallelogram shapes).
Hypothesis checked : check_plane = true.

Lemma checks : contracting = true /\ (forall s, In s sets -> det s <> 0%Z) /\
  (forall a, In a arrows -> (fst a < length sets)%nat /\ (snd a < length sets)%nat) /\
  (forall a b, In a arrows -> In b arrows -> apart (fst a) (fst b) = true) /\
  forall a, In a arrows -> good_arrow a = true.
Proof.
  unfold check_plane in checked. rewrite !andb_true_iff, !forallb_forall in checked.
  destruct checked as [[[[C D] N] A] G]. repeat split; auto.
  - intros s I E. specialize (D s I). rewrite E in D. discriminate.
  - apply Nat.ltb_lt. specialize (N a H). apply andb_true_iff in N. apply N.
  - apply Nat.ltb_lt. specialize (N a H). apply andb_true_iff in N. apply N.
  - intros a b I J. specialize (A a I). rewrite forallb_forall in A. auto.
Qed.

Lemma signs : 0 <= part (r_ bound) /\ 0 <= part (s_ bound).
Proof.
  destruct checks as [C _]. unfold contracting in C. destruct bound. cbn [r_ s_]. rewrite !andb_true_iff, !Z.leb_le in C.
  rewrite <- (ratio_0 parts). split; apply ratio_le; tauto.
Qed.

Lemma det_not_0 i : IZR (ux (set i)) * IZR (vy (set i)) - IZR (vx (set i)) * IZR (uy (set i)) <> 0.
Proof.
  rewrite <- !mult_IZR, <- minus_IZR. apply not_0_IZR. destruct checks as (_ & D & _).
  destruct (nth_in_or_default i sets (Hset 0 0 (Zpos unit) 0 0 (Zpos unit))) as [I | ->]; [auto|simpl; lia].
Qed.

Lemma inverse i z : coordinates i (chart i z) = z /\ chart i (coordinates i z) = z.
Proof.
  pose proof (det_not_0 i). pose proof (unit_pos unit). destruct z as [x y].
  unfold coordinates, chart, Stages.apply, measuring, charting, from_centre, quotient. cbn [fst snd value].
  split; rewrite minus_IZR, !mult_IZR; f_equal; field; split; auto; lra.
Qed.

Lemma cells_are i z : cell i z <-> exists q, square i q /\ z = chart i q.
Proof.
  unfold parallelogram, shapes. pose proof (unit_pos unit) as U.
  set (shape := fun s : hset => ((ratio (cx s), ratio (cy s)), (ratio (ux s), ratio (uy s)), (ratio (vx s), ratio (vy s)))).
  assert (E : shape (Hset 0 0 (Zpos unit) 0 0 (Zpos unit)) = (0, 0, (1, 0), (0, 1))).
  { unfold shape. cbn [cx cy ux uy vx vy]. rewrite ratio_0. unfold Numbers.ratio.
    replace (IZR (Zpos unit) / IZR (Zpos unit)) with 1 by (field; lra). reflexivity. }
  rewrite <- E, (map_nth shape). unfold shape. cbn [fst snd]. unfold chart, box, Stages.apply, charting, quotient, Numbers.ratio. cbn [fst snd value]. split.
  - intros (a & b & A & B & ->). exists (a, b). cbn [fst snd]. split; [auto|f_equal; ring].
  - intros ([a b] & [A B] & ->). cbn [fst snd] in *. exists a, b. split; [auto|split; [auto|f_equal; ring]].
Qed.

Lemma run_local i j q : run (local i j) q = coordinates j (map_ (chart i q)).
Proof.
  unfold local, coordinates, map_, chart. cbn [run fold_left]. unfold run. rewrite fold_left_app. cbn [fold_left]. f_equal.
  generalize (Stages.apply (charting (set i)) q). induction power as [|n IH]; intros z; [reflexivity|].
  cbn [repeat fold_left]. rewrite IH. clear IH. induction n as [|n IH]; [reflexivity|]. cbn [iter]. rewrite IH. reflexivity.
Qed.

(* One relation. *)
Definition P (i j : nat) (q : R * R) : R := fst (run (local i j) q).
Definition Q (i j : nat) (q : R * R) : R := snd (run (local i j) q).
Definition way (same : bool) (x : R) : R := if same then x else - x.

Definition slope_there (i j : nat) (same : bool) (a b : R -> R) (t u v : R) : Prop :=
  exists m, is_derive (fun s => P i j (a s, b s)) t (xx m * u + xy m * v) /\
    is_derive (fun s => Q i j (a s, b s)) t (yx m * u + yy m * v) /\
    part (p_ bound) <= way same (xx m) /\ Rabs (xy m) <= part (q_ bound) /\
    Rabs (yx m) <= part (r_ bound) /\ Rabs (yy m) <= part (s_ bound).

Definition sloping (i j : nat) (same : bool) : Prop := forall (a b : R -> R) (t u v : R),
  -1 <= a t <= 1 -> -1 <= b t <= 1 -> is_derive a t u -> is_derive b t v -> slope_there i j same a b t u v.

Lemma differences i j same z z' : sloping i j same -> square i z -> square i z' ->
  part (p_ bound) * Rabs (fst z - fst z') <= Rabs (P i j z - P i j z') + part (q_ bound) * Rabs (snd z - snd z') /\
  Rabs (Q i j z - Q i j z') <= part (r_ bound) * Rabs (fst z - fst z') + part (s_ bound) * Rabs (snd z - snd z').
Proof.
  intros S [X Y] [X' Y'].
  destruct z as [x y], z' as [x' y']. cbn [fst snd] in *.
  set (a := fun t => x' + t * (x - x')). set (b := fun t => y' + t * (y - y')).
  assert (Da : forall t, is_derive a t (x - x')) by (intros t; unfold a; auto_derive; auto; ring).
  assert (Db : forall t, is_derive b t (y - y')) by (intros t; unfold b; auto_derive; auto; ring).
  assert (On : forall t, 0 <= t <= 1 -> -1 <= a t <= 1 /\ -1 <= b t <= 1) by (intros t T; unfold a, b; split; split; nra).
  assert (D : forall t, 0 <= t <= 1 -> slope_there i j same a b t (x - x') (y - y')).
  { intros t T. destruct (On t T). apply S; auto. }
  assert (E1 : (a 1, b 1) = (x, y)) by (unfold a, b; f_equal; ring).
  assert (E0 : (a 0, b 0) = (x', y')) by (unfold a, b; f_equal; ring).
  assert (M : forall f, (forall t, 0 <= t <= 1 -> ex_derive f t) -> exists c, 0 <= c <= 1 /\ f 1 - f 0 = Derive f c).
  { intros f Ex. destruct (mvt f (Derive f) 0 1) as (c & C & Q'); [lra|intros t T; apply Derive_correct, Ex, T|].
    exists c. split; [exact C|lra]. }
  pose proof (Rabs_pos (x - x')). pose proof (Rabs_pos (y - y')). split.
  - destruct (M (fun s => P i j (a s, b s))) as (c & C & E); [intros t T; destruct (D t T) as (m & Dm & _); eexists; exact Dm|].
    destruct (D c C) as (m & Dm & _ & Bp & Bq & _). rewrite (is_derive_unique _ _ _ Dm), E1, E0 in E. rewrite E.
    assert (p_le : part (p_ bound) <= Rabs (xx m)).
    { eapply Rle_trans; [exact Bp|]. destruct same; simpl; [apply Rle_abs|rewrite <- Rabs_Ropp; apply Rle_abs]. }
    pose proof (Rabs_triang (xx m * (x - x') + xy m * (y - y')) (- (xy m * (y - y')))) as Tr.
    replace (xx m * (x - x') + xy m * (y - y') + - (xy m * (y - y'))) with (xx m * (x - x')) in Tr by ring.
    rewrite Rabs_Ropp, !(Rabs_mult (xx m)), (Rabs_mult (xy m)) in Tr.
    assert (part (p_ bound) * Rabs (x - x') <= Rabs (xx m) * Rabs (x - x')) by (apply Rmult_le_compat_r; lra).
    assert (Rabs (xy m) * Rabs (y - y') <= part (q_ bound) * Rabs (y - y')) by (apply Rmult_le_compat_r; lra). lra.
  - destruct (M (fun s => Q i j (a s, b s))) as (c & C & E); [intros t T; destruct (D t T) as (m & _ & Dm & _); eexists; exact Dm|].
    destruct (D c C) as (m & _ & Dm & _ & _ & Br & Bs). rewrite (is_derive_unique _ _ _ Dm), E1, E0 in E. rewrite E.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult. apply Rplus_le_compat; apply Rmult_le_compat_r; lra.
Qed.

Record relation (i j : nat) (same : bool) : Prop := {
  re_left : forall g, -1 <= g <= 1 -> way same (P i j (-1, g)) <= -1;
  re_right : forall g, -1 <= g <= 1 -> 1 <= way same (P i j (1, g));
  re_clear : forall q, square i q -> -1 <= P i j q <= 1 -> -1 <= Q i j q <= 1;
  re_slope : sloping i j same
}.

Lemma side_holds bits x : -1 <= x <= 1 -> holds (I.join (I.fromZ (F.PtoP bits) (-1)) (I.fromZ (F.PtoP bits) 1)) x.
Proof. apply join_holds; apply I.fromZ_correct. Qed.

Lemma ratio_1 n : Numbers.ratio 1 n = IZR n.
Proof. unfold Numbers.ratio. field. Qed.

Lemma beyond_holds bits i j right same g : beyond bits i j right same = true -> -1 <= g <= 1 ->
  if eqb right same then 1 <= P i j (if right then 1 else -1, g) else P i j (if right then 1 else -1, g) <= -1.
Proof.
  intros B G. unfold beyond in B.
  set (x := if right then 1 else -1). set (A := if right then _ else _) in B.
  assert (X : holds A x) by (destruct right; apply I.fromZ_correct).
  refine (always_holds (fun y => if eqb right same then 1 <= P i j (x, y) else P i j (x, y) <= -1) _ DEPTH _ _ g B (side_holds _ _ G)).
  intros B' y T Y. destruct (images bits (local i j) A B') as [[V W]|] eqn:E; [|discriminate].
  destruct (images_hold bits _ _ _ _ _ (x, y) E X Y) as [H _]. unfold P.
  destruct (eqb right same); [apply (at_least_holds bits 1) with (2 := T) in H|apply (at_most_holds bits 1) with (2 := T) in H];
    rewrite ratio_1 in H; exact H.
Qed.

Notation r64 := (Numbers.ratio 64).
Lemma halves_holds (P : R -> Prop) test depth : (forall l h x, test l h = true -> r64 l <= x <= r64 h -> P x) ->
  forall l h x, halves test depth l h = true -> r64 l <= x <= r64 h -> P x.
Proof.
  intros T. induction depth as [|n IH]; intros l h x E X; cbn [halves] in E; (destruct (test l h) eqn:Q; [exact (T l h x Q X)|]); [discriminate|].
  destruct (halves test n l _) eqn:L; [|discriminate]. destruct (Rle_dec x (r64 ((l + h) / 2))); [apply (IH _ _ x L)|apply (IH _ _ x E)]; lra.
Qed.

Lemma everywhere_holds (P : R -> R -> Prop) test :
  (forall l h l' h' x y, test l h l' h' = true -> r64 l <= x <= r64 h -> r64 l' <= y <= r64 h' -> P x y) ->
  everywhere test = true -> forall x y, -1 <= x <= 1 -> -1 <= y <= 1 -> P x y.
Proof.
  assert (U : r64 (-64) = -1 /\ r64 64 = 1) by (unfold Numbers.ratio; split; field). destruct U as [U0 U1].
  intros T E x y X Y. apply (halves_holds (fun x => P x y) _ DEPTH) with (2 := E); [|lra].
  intros l h a Ta Ha. apply (halves_holds (P a) _ DEPTH) with (2 := Ta); [eauto|lra].
Qed.

Lemma middle l h x : r64 l <= x <= r64 h -> Rabs (x - r64 ((l + h) / 2)) <= r64 (radius l h) /\ r64 l <= r64 ((l + h) / 2) <= r64 h.
Proof.
  intros X. assert (L : (l <= h)%Z).
  { destruct (Z_le_gt_dec l h) as [|G]; auto. assert (H : (h < l)%Z) by lia. apply (ratio_lt 64) in H. lra. }
  assert (M : (l <= (l + h) / 2 <= h)%Z) by (split; [apply Z.div_le_lower_bound|apply Z.div_le_upper_bound]; lia).
  set (m := ((l + h) / 2)%Z) in *. assert (R1 : (m - l <= radius l h /\ h - m <= radius l h)%Z) by (unfold radius; fold m; lia).
  destruct R1 as [R1 R2]. apply (ratio_le 64) in R1, R2. destruct M as [M0 M1]. apply (ratio_le 64) in M0, M1.
  assert (Sub : forall a b, r64 (a - b) = r64 a - r64 b) by (intros; unfold Numbers.ratio; rewrite minus_IZR; field).
  rewrite Sub in R1, R2. split; [apply Rabs_le|]; lra.
Qed.

Lemma crossing_holds bits i j same : crossing bits i j same = true -> relation i j same.
Proof.
  unfold crossing. intros H. destruct (beyond bits i j false same) eqn:L; [|discriminate].
  destruct (beyond bits i j true same) eqn:Ri; [|discriminate].
  destruct (everywhere (clear bits i j)) eqn:Cl; [|discriminate].
  assert (Slo : sloping i j same).
  { intros a b t u v A B Da Db.
    refine (everywhere_holds (fun x y => forall (a b : R -> R) t, x = a t -> y = b t -> is_derive a t u -> is_derive b t v -> slope_there i j same a b t u v)
      _ _ H (a t) (b t) A B a b t eq_refl eq_refl Da Db).
    clear. intros l h l' h' x y T X Y a b t -> -> Da Db. unfold steep in T.
    destruct (slopes bits (local i j) _ _ _) as [J|] eqn:E; [|discriminate].
    destruct (slopes_hold bits _ _ _ _ _ a b t (Matrix 1 0 0 1) u v E (range_holds _ _ _ _ _ X) (range_holds _ _ _ _ _ Y)) as (m & (M1 & M2 & M3 & M4) & D1 & D2).
    + unfold held. cbn [xx xy yx yy]. split; [|split; [|split]]; apply I.fromZ_correct.
    + cbn [xx xy yx yy]. replace (1 * u + 0 * v) with u by ring. exact Da.
    + cbn [xx xy yx yy]. replace (0 * u + 1 * v) with v by ring. exact Db.
    + rewrite !andb_true_iff in T. destruct T as [[[Tp Tq] Tr] Ts]. exists m.
      split; [exact D1|split; [exact D2|split; [|split; [|split]; eapply small_holds; eassumption]]].
      apply (at_least_holds bits parts) with (2 := Tp). destruct same; auto using neg_holds. }
  split; [| | |exact Slo].
  - intros g G. pose proof (beyond_holds bits i j false same g L G) as B. unfold way. destruct same; cbn [eqb] in B; lra.
  - intros g G. pose proof (beyond_holds bits i j true same g Ri G) as B. unfold way. destruct same; cbn [eqb] in B; lra.
  - intros [x y] [X Y]. cbn [fst snd] in X, Y.
    revert X Y. refine (fun X Y => everywhere_holds (fun x y => -1 <= x <= 1 -> -1 <= y <= 1 -> -1 <= P i j (x, y) <= 1 -> -1 <= Q i j (x, y) <= 1) _ _ Cl x y X Y X Y).
    pose proof signs as signs. clear - Slo signs. intros l h l' h' x y T X Y Sx Sy. unfold clear in T.
    destruct (images bits (local i j) (range bits 64 l h) _) as [[V W]|] eqn:E; [|discriminate].
    destruct (images_hold bits _ _ _ _ _ (x, y) E (range_holds _ _ _ _ _ X) (range_holds _ _ _ _ _ Y)) as [HV HW].
    fold (P i j (x, y)) in HV. fold (Q i j (x, y)) in HW.
    destruct (_ || _) eqn:N in T.
    + rewrite !orb_true_iff in N. destruct N as [[N|N]|N].
      * apply (above_zero_holds _ _ (sub_holds _ _ _ _ HV (one_holds bits))) in N. lra.
      * apply (above_zero_holds _ _ (sub_holds _ _ _ _ (I.fromZ_correct (F.PtoP bits) (-1) : holds _ (-1)) HV)) in N. lra.
      * apply (small_holds bits 1 _ _ _ HW) in N. rewrite ratio_1 in N. apply Rabs_le_between in N. lra.
    + clear E N HV HW V W. destruct (middle l h x X) as [Dx Mx], (middle l' h' y Y) as [Dy My].
      set (c := r64 ((l + h) / 2)) in *. set (c' := r64 ((l' + h') / 2)) in *.
      destruct (images bits (local i j) _ _) as [[V W]|] eqn:E; [|discriminate].
      destruct (images_hold bits _ _ _ _ _ (c, c') E (number_holds _ _ _) (number_holds _ _ _)) as [_ HW]. fold (Q i j (c, c')) in HW.
      rewrite !andb_true_iff, !Z.leb_le in T. destruct T as [[[[[In0 In1] In2] In3] T] T'].
      apply (ratio_le 64) in In0, In1, In2, In3. pose proof (number_holds bits (64 * parts) (r_ bound * radius l h + s_ bound * radius l' h')) as HS.
      apply (at_most_holds bits 1 _ _ _ (add_holds _ _ _ _ HW HS)) in T. apply (at_least_holds bits 1 _ _ _ (sub_holds _ _ _ _ HW HS)) in T'.
      rewrite ratio_1 in T, T'. assert (Sq : Numbers.ratio (64 * parts) (r_ bound * radius l h + s_ bound * radius l' h') =
        part (r_ bound) * r64 (radius l h) + part (s_ bound) * r64 (radius l' h')).
      { pose proof (unit_pos parts). unfold Numbers.ratio. rewrite Pos2Z.inj_mul, plus_IZR, !mult_IZR. field. lra. }
      rewrite Sq in T, T'. intros _.
      assert (Corner : -1 <= c <= 1 /\ -1 <= c' <= 1) by (unfold Numbers.ratio in *; lra).
      destruct (differences i j same (x, y) (c, c') Slo (conj Sx Sy) Corner) as [_ Df]. cbn [fst snd] in Df.
      destruct signs as [r0 s0].
      assert (part (r_ bound) * Rabs (x - c) <= part (r_ bound) * r64 (radius l h)) by (apply Rmult_le_compat_l; auto).
      assert (part (s_ bound) * Rabs (y - c') <= part (s_ bound) * r64 (radius l' h')) by (apply Rmult_le_compat_l; auto).
      apply Rabs_le_between in Df. lra.
Qed.

Lemma arrow_relation i j : In (i, j) arrows -> exists same, relation i j same.
Proof.
  intros A. destruct checks as (_ & _ & _ & _ & G). specialize (G _ A). unfold good_arrow in G. cbn [fst snd] in G.
  destruct (crossing 64 i j true) eqn:E; eauto using crossing_holds.
Qed.

Lemma runs_across i j y g : In (i, j) arrows -> -1 <= y <= 1 -> -1 <= g <= 1 -> exists x, -1 <= x <= 1 /\ P i j (x, g) = y.
Proof.
  intros A Y G. destruct (arrow_relation i j A) as (same & [L Ri _ S]). specialize (L g G). specialize (Ri g G).
  destruct (first_hit (fun x => way same (P i j (x, g))) (-1) 1 (way same y)) as (x & X & E & _).
  - lra.
  - intros x X. apply continuity_pt_filterlim.
    assert (C : continuous (fun x => P i j (x, g)) x).
    { destruct (S (fun x => x) (fun _ => g) x 1 0 X G) as (m & D & _);
        [apply (is_derive_id x)|apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule))|].
      apply (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule)). eexists. exact D. }
    destruct same; [exact C|apply (continuous_opp (fun x => P i j (x, g))), C].
  - unfold way in *. destruct same; lra.
  - exists x. split; [exact X|]. unfold way in E. destruct same; lra.
Qed.

(* Sizes, and how far the sets are apart. *)
Definition extent (s : hset) : Z := (Z.abs (ux s) + Z.abs (uy s) + Z.abs (vx s) + Z.abs (vy s))%Z.
Definition largest : Z := fold_right (fun s n => extent s + n)%Z (2 * Zpos unit)%Z sets.

Lemma extent_le i : (0 <= extent (set i) <= largest)%Z.
Proof.
  assert (Pos : forall s, (0 <= extent s)%Z) by (intros s; unfold extent; lia). split; [apply Pos|]. unfold largest.
  assert (D : (extent (Hset 0 0 (Zpos unit) 0 0 (Zpos unit)) <= 2 * Zpos unit)%Z) by (unfold extent; cbn [ux uy vx vy]; lia).
  set (base := (2 * Zpos unit)%Z) in *. set (d := Hset 0 0 (Zpos unit) 0 0 (Zpos unit)) in *.
  assert (Rest : forall l, (base <= fold_right (fun s n => extent s + n) base l)%Z).
  { induction l as [|s l IH]; cbn [fold_right]; [lia|]. specialize (Pos s). lia. }
  clearbody base d. clear - Pos Rest D. revert i. induction sets as [|s l IH]; intros [|i]; cbn [nth fold_right]; auto.
  - specialize (Rest l). specialize (Pos d). lia.
  - specialize (IH i). specialize (Pos s). lia.
Qed.

Lemma separated i i' j j' z z' : In (i, i') arrows -> In (j, j') arrows -> cell i z -> cell j z' -> i <> j ->
  1 <= IZR (Zpos unit) * IZR largest * in_plane z z'.
Proof.
  intros A B Z Z' N. destruct checks as (_ & _ & _ & Ap & _). specialize (Ap _ _ A B). cbn [fst] in Ap.
  unfold apart in Ap. rewrite (proj2 (Nat.eqb_neq i j) N) in Ap. cbn [orb] in Ap. apply existsb_exists in Ap.
  destruct Ap as ([al be] & I & Sep). unfold separates in Sep. cbn [fst snd] in Sep. apply Z.ltb_lt in Sep.
  assert (Le : (Z.abs al <= largest /\ Z.abs be <= largest /\ Z.abs al + Z.abs be <= largest)%Z).
  { pose proof (extent_le i) as Ei. pose proof (extent_le j) as Ej. unfold extent in Ei, Ej.
    clear - I Ei Ej. destruct I as [E|[E|[E|[E|[]]]]]; injection E as <- <-; rewrite ?Z.abs_opp; lia. }
  apply cells_are in Z, Z'. destruct Z as ([x y] & [X Y] & ->), Z' as ([x' y'] & [X' Y'] & ->). cbn [fst snd] in *.
  set (s := set i) in *. set (t := set j) in *. pose proof (unit_pos unit) as U.
  set (W := fun z : R * R => IZR al * fst z + IZR be * snd z).
  assert (Wi : IZR (Zpos unit) * (W (chart i (x, y)) - W (chart j (x', y'))) = IZR (al * (cx s - cx t) + be * (cy s - cy t)) +
    IZR (al * ux s + be * uy s) * x + IZR (al * vx s + be * vy s) * y -
    IZR (al * ux t + be * uy t) * x' - IZR (al * vx t + be * vy t) * y').
  { unfold W, chart, Stages.apply, charting, quotient. fold s t. cbn [fst snd value].
    rewrite !plus_IZR, !mult_IZR, !minus_IZR. field. lra. }
  assert (Le' : (Z.abs (al * ux s + be * uy s) + Z.abs (al * vx s + be * vy s) + Z.abs (al * ux t + be * uy t) +
    Z.abs (al * vx t + be * vy t) + 1 <= Z.abs (al * (cx s - cx t) + be * (cy s - cy t)))%Z) by lia.
  apply IZR_le in Le'. rewrite !plus_IZR, !abs_IZR in Le'.
  assert (Sm : forall m r, -1 <= r <= 1 -> Rabs (m * r) <= Rabs m).
  { intros m r Hr. rewrite Rabs_mult. assert (Rabs r <= 1) by (apply Rabs_le; lra). pose proof (Rabs_pos m). nra. }
  assert (One : 1 <= Rabs (IZR (Zpos unit) * (W (chart i (x, y)) - W (chart j (x', y'))))).
  { rewrite Wi. pose proof (Sm (IZR (al * ux s + be * uy s)) x X) as S1. pose proof (Sm (IZR (al * vx s + be * vy s)) y Y) as S2.
    pose proof (Sm (IZR (al * ux t + be * uy t)) x' X') as S3. pose proof (Sm (IZR (al * vx t + be * vy t)) y' Y') as S4.
    set (c0 := IZR (al * (cx s - cx t) + be * (cy s - cy t))) in *.
    apply Rabs_le_between in S1, S2, S3, S4. revert Le' S1 S2 S3 S4. unfold Rabs at 5.
    destruct (Rcase_abs c0); intros; [rewrite Rabs_left1; lra|rewrite Rabs_pos_eq; lra]. }
  rewrite Rabs_mult, (Rabs_pos_eq (IZR (Zpos unit))) in One by lra.
  eapply Rle_trans; [exact One|]. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|].
  set (z := chart i (x, y)) in *. set (z' := chart j (x', y')) in *. unfold W, in_plane.
  replace (IZR al * fst z + IZR be * snd z - (IZR al * fst z' + IZR be * snd z')) with
    (IZR al * (fst z - fst z') + IZR be * (snd z - snd z')) by ring.
  set (M := Rmax (Rabs (fst z - fst z')) (Rabs (snd z - snd z'))).
  assert (M1 : Rabs (fst z - fst z') <= M) by apply Rmax_l. assert (M2 : Rabs (snd z - snd z') <= M) by apply Rmax_r.
  assert (M0 : 0 <= M) by (eapply Rle_trans; [apply Rabs_pos|exact M1]).
  eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
  destruct Le as (_ & _ & Le). apply IZR_le in Le. rewrite plus_IZR, !abs_IZR in Le.
  pose proof (Rabs_pos (IZR al)). pose proof (Rabs_pos (IZR be)).
  assert (Rabs (IZR al) * Rabs (fst z - fst z') <= Rabs (IZR al) * M) by (apply Rmult_le_compat_l; lra).
  assert (Rabs (IZR be) * Rabs (snd z - snd z') <= Rabs (IZR be) * M) by (apply Rmult_le_compat_l; lra).
  assert ((Rabs (IZR al) + Rabs (IZR be)) * M <= IZR largest * M) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Theorem plane_checked : followed_once nat (fun i j => In (i, j) arrows) cell (fun z z' => z' = map_ z) (part (rate_ bound)).
Proof.
  destruct checks as (C & _). unfold contracting in C. pose proof (unit_pos unit) as U. pose proof (unit_pos parts) as U'.
  pose proof (fun i j z z' (A : In (i, j) arrows) (Z : square i z) (Z' : square i z') => match arrow_relation i j A with
    ex_intro same R => differences i j same z z' (re_slope _ _ _ R) Z Z' end) as Df. pose proof separated as Sep. destruct bound as [p q r s c k] eqn:Eb.
  cbn [p_ q_ r_ s_ width_ rate_] in *. rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt in C.
  destruct C as [[[[[[[[C1 C2] C3] C4] C5] C6] C7] C8] C9].
  apply (ratio_lt parts) in C1, C5, C7. apply (ratio_le parts) in C2, C3, C4, C6. rewrite ratio_0 in *.
  assert (One : part (Zpos parts) = 1) by (unfold Numbers.ratio; field; lra). rewrite One in C7.
  assert (Sc : forall a b, part a * part b = IZR (a * b) / (IZR (Zpos parts) * IZR (Zpos parts)))
    by (intros; unfold Numbers.ratio; rewrite mult_IZR; field; lra).
  assert (I2 : 0 < / (IZR (Zpos parts) * IZR (Zpos parts))) by (apply Rinv_0_lt_compat, Rmult_lt_0_compat; lra).
  assert (R1 : 1 + part q * part c <= part k * part p).
  { apply IZR_le in C8. rewrite plus_IZR in C8. rewrite !Sc.
    replace 1 with (IZR (Zpos parts * Zpos parts) / (IZR (Zpos parts) * IZR (Zpos parts))) by (rewrite mult_IZR; field; lra).
    unfold Rdiv. rewrite <- Rmult_plus_distr_r. apply Rmult_le_compat_r; lra. }
  assert (R2 : part r * part k + part s * part c <= part k * part c).
  { apply IZR_le in C9. rewrite plus_IZR in C9. rewrite !Sc. unfold Rdiv. rewrite <- Rmult_plus_distr_r.
    apply Rmult_le_compat_r; lra. }
  assert (Inv : 0 < 2 / part c) by (apply Rdiv_lt_0_compat; lra).
  apply (crossed_theorem nat (fun i j => In (i, j) arrows) (fun _ => -1) (fun _ => 1) (fun _ => -1) (fun _ => 1)
    chart coordinates) with (P := P) (Q := Q) (p := part p) (q := part q) (r := part r) (s := part s) (c := part c)
    (e0 := 2 + 2 / part c) (largest := ratio largest * (1 + part c)); auto.
  - apply cells_are.
  - intros i. lra.
  - apply inverse.
  - intros i j z z' A _ _. unfold P, Q. rewrite run_local, <- surjective_pairing. split; intros E.
    + rewrite <- (proj1 (inverse j z')), E. reflexivity.
    + rewrite E. apply inverse.
  - intros i j y g A Y G. apply (runs_across i j y g A Y G).
  - intros i j z A Z Y. destruct (arrow_relation i j A) as (same & [_ _ Cl _]). apply (Cl z Z Y).
  - intros i i' j j' z A B Z Z'. destruct (Nat.eq_dec i j) as [|N]; auto. exfalso.
    specialize (Sep _ _ _ _ _ _ A B Z Z' N). unfold in_plane in Sep. rewrite !Rminus_eq_0, Rabs_R0, Rmax_left in Sep by lra. lra.
  - lra.
  - intros i j z z' A Z Z'. apply (Df i j z z' A Z Z').
  - intros i j z z' A Z Z'. apply (Df i j z z' A Z Z').
  - lra.
  - intros i. split; [lra|]. replace (part c * (2 + 2 / part c)) with (2 * part c + 2) by (field; lra). lra.
  - intros i e z z' [N1 N2]. assert (e0 : 0 <= e) by (eapply Rle_trans; [apply Rabs_pos|exact N1]).
    pose proof (extent_le i) as [_ Ex]. unfold extent in Ex. set (t := set i) in *.
    assert (Bd : forall m n : Z, (Z.abs m + Z.abs n <= largest)%Z ->
      Rabs (ratio m * (fst z - fst z') + ratio n * (snd z - snd z')) <= ratio largest * (1 + part c) * e).
    { intros m n L. eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
      assert (Am : forall m, Rabs (ratio m) = ratio (Z.abs m)).
      { intros x. unfold Numbers.ratio. unfold Rdiv. rewrite Rabs_mult, abs_IZR, (Rabs_pos_eq (/ _)); auto. apply Rlt_le, Rinv_0_lt_compat, U. }
      rewrite !Am. assert (Lr : ratio (Z.abs m) + ratio (Z.abs n) <= ratio largest) by (rewrite <- ratio_add; apply ratio_le, L).
      assert (Pm : 0 <= ratio (Z.abs m)) by (rewrite <- (ratio_0 unit); apply ratio_le; lia).
      assert (Pn : 0 <= ratio (Z.abs n)) by (rewrite <- (ratio_0 unit); apply ratio_le; lia).
      assert (Pc : 0 <= part c * e) by (apply Rmult_le_pos; lra).
      assert (ratio (Z.abs m) * Rabs (fst z - fst z') <= ratio (Z.abs m) * e) by (apply Rmult_le_compat_l; lra).
      assert (ratio (Z.abs n) * Rabs (snd z - snd z') <= ratio (Z.abs n) * (part c * e)) by (apply Rmult_le_compat_l; lra).
      assert (ratio (Z.abs m) * e <= ratio largest * e) by (apply Rmult_le_compat_r; lra).
      assert (ratio (Z.abs n) * (part c * e) <= ratio largest * (part c * e)) by (apply Rmult_le_compat_r; lra). lra. }
    assert (Ux : (Z.abs (ux t) + Z.abs (vx t) <= largest)%Z) by lia. assert (Uy : (Z.abs (uy t) + Z.abs (vy t) <= largest)%Z) by lia.
    apply Bd in Ux, Uy. unfold chart, Stages.apply, charting, quotient. fold t. cbn [fst snd value]. unfold Numbers.ratio in Ux, Uy |- *.
    match type of Ux with Rabs ?a <= _ => match goal with |- Rabs ?b <= _ /\ _ => replace b with a by ring end end.
    match type of Uy with Rabs ?a <= _ => match goal with |- _ /\ Rabs ?b <= _ => replace b with a by ring end end. auto.
Qed.

(* The entropy, where each set from which an arrow goes is also reached by one. *)
Variables (v : list Z) (p : nat) (g : Z).
Definition growing_plane : bool :=
  growing arrows (length sets) v p g && forallb (fun a => existsb (fun b => (snd b =? fst a)%nat) arrows) arrows.
Definition before (i : nat) : nat := match find (fun b => (snd b =? i)%nat) arrows with Some b => fst b | None => i end.

Theorem plane_growth : growing_plane = true -> entropy_at_least in_plane map_ cell arrows p g.
Proof.
  unfold growing_plane. rewrite andb_true_iff, forallb_forall. intros [Gr Back].
  assert (Bf : forall i i', In (i, i') arrows -> In (before i, i) arrows).
  { intros i i' A. specialize (Back _ A). apply existsb_exists in Back. destruct Back as ([a b] & I & E). cbn [fst snd] in E.
    apply Nat.eqb_eq in E. subst b. unfold before. destruct (find _ _) as [[a' b']|] eqn:Fi.
    - apply find_some in Fi. destruct Fi as [I' E']. cbn [fst snd] in *. apply Nat.eqb_eq in E'. subst b'. exact I'.
    - apply (find_none _ _ Fi) in I. cbn [snd] in I. rewrite Nat.eqb_refl in I. discriminate. }
  assert (Pos : 0 < / (IZR (Zpos unit) * IZR largest)).
  { pose proof (extent_le (length sets)) as E. rewrite nth_overflow in E by auto. unfold extent in E. cbn [ux uy vx vy] in E.
    apply Rinv_0_lt_compat, Rmult_lt_0_compat; [apply unit_pos|apply IZR_lt; lia]. }
  refine (growth_theorem arrows (length sets) _ v p g in_plane map_ cell (/ (IZR (Zpos unit) * IZR largest)) _ _ _ Pos _ Gr).
  - intros i j A. destruct checks as (_ & _ & N & _). apply (N _ A).
  - intros x. unfold in_plane. rewrite !Rminus_eq_0, Rabs_R0. apply Rmax_left. lra.
  - intros x y. unfold in_plane. rewrite (Rabs_minus_sym (fst x)), (Rabs_minus_sym (snd x)). reflexivity.
  - intros w W. destruct plane_checked as (_ & Xx & size & Or & _).
    set (h := fun n : Z => if (0 <=? n)%Z then w (Z.to_nat n) else Nat.iter (Z.to_nat (- n)) before (w 0%nat)).
    assert (Al : allowed nat (fun i j => In (i, j) arrows) h).
    { intros n. unfold h. destruct (Z.leb_spec 0 n) as [L|L].
      - rewrite (proj2 (Z.leb_le 0 (n + 1))) by lia. replace (Z.to_nat (n + 1)) with (S (Z.to_nat n)) by lia. apply W.
      - assert (It : forall k, exists i', In (Nat.iter k before (w 0%nat), i') arrows).
        { induction k as [|k (i' & IH)]; [eexists; apply W|]. eexists. simpl. apply (Bf _ _ IH). }
        replace (Z.to_nat (- n)) with (S (Z.to_nat (- (n + 1)))) by lia. cbn [Nat.iter nat_rect].
        destruct (It (Z.to_nat (- (n + 1)))) as (i' & I). apply Bf in I. destruct (Z.leb_spec 0 (n + 1)) as [L'|L'].
        + replace (n + 1)%Z with 0%Z in * by lia. exact I.
        + exact I. }
    destruct (Or h (fun n => Xx (from nat n h)) Al) as [_ O]. specialize (O (fun n => eq_refl)).
    exists (Xx (from nat 0 h)). assert (It : forall n, iter map_ n (Xx (from nat 0 h)) = Xx (from nat (Z.of_nat n) h)).
    { induction n as [|n IH]; [reflexivity|]. cbn [iter]. rewrite IH. destruct (O (Z.of_nat n)) as [_ E]. rewrite <- E. f_equal. f_equal. lia. }
    intros n. rewrite It. destruct (O (Z.of_nat n)) as [Ce _]. unfold h in Ce at 1.
    rewrite (proj2 (Z.leb_le 0 (Z.of_nat n))) in Ce by lia. rewrite Nat2Z.id in Ce. exact Ce.
  - intros i i' j j' x y A B X' Y' N. pose proof (separated _ _ _ _ _ _ A B X' Y' N) as S1.
    apply Rmult_le_reg_l with (IZR (Zpos unit) * IZR largest); [rewrite <- (Rinv_inv (_ * _)); apply Rinv_0_lt_compat, Pos|].
    rewrite Rinv_r; [exact S1|]. intros E. rewrite E, Rmult_0_l in S1. lra.
Qed.
End Plane.
