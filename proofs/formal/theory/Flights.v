(* A checker of covering graphs of the impact map after plastic impacts: where it computes true, the
   theorems of Graph.v hold of f, that takes a phase to the phase of the next impact. *)
From Coq Require Import Reals ZArith Psatz Lia List Bool.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Float_full Interval Xreal.
From Oscillator Require Import Impact Restitution Flight Corrected Numbers March Graph Paths Entropy Cells.
Import ListNotations.
Open Scope R_scope.

(* Launches of phases [a, b] / unit; times as steps: see March.v. *)
Record cut := Cut { first_phase : Z; last_phase : Z; lifts : list (Z * nat); flights : list (Z * nat); falls : list (Z * nat) }.
(* An interval of phases: the whole turns until its impacts, whether f rises there, pieces that cover
   it and more, its ends. *)
Record laps := Laps { turns : Z; rising : bool; cuts : list cut; left_end : cut; right_end : cut }.

Section Flights.
Variable bits unit : positive.
Notation prec := (F.PtoP bits).
Notation ratio := (ratio unit).
Notation number := (number bits unit).
Notation range := (range bits unit).
Variables side eta nu : Z.
Notation S' := (IZR side).
Notation E' := (ratio eta).
Notation N' := (ratio nu).
Hypothesis eta_pos : (0 < eta)%Z.
Notation f := (Corrected.f S' E' N').
Notation next := (Impact.next S' E' N').
Notation lift := (Corrected.lift S' E' N').
Notation regular := (Corrected.regular S' E' N').
Notation impact_time := (Flight.impact_time S' E' N').

Definition flown (p : cut) : option (Z * Z * Z) :=
  impact bits unit side eta nu 0 (first_phase p) (last_phase p) (Zneg unit) (Zpos unit) (lifts p) (flights p) (falls p).

Lemma velocities : ratio (Zneg unit) = -1 /\ ratio (Zpos unit) = 1 /\ ratio 0 = 0.
Proof. pose proof (unit_pos unit). unfold Numbers.ratio. rewrite <- Pos2Z.opp_pos, opp_IZR. split; [|split]; field; lra. Qed.

Lemma flown_branch p T u v : flown p = Some (T, u, v) ->
  branch S' E' N' (ratio (first_phase p)) (ratio (last_phase p)) (ratio T) (ratio u) (ratio v).
Proof.
  unfold flown. intros H. apply (impact_flights bits unit side eta nu 0 eta_pos) in H.
  destruct velocities as (V0 & V1 & V). rewrite V, V0, V1 in H. exact H.
Qed.

(* Phases and times of a piece's impacts. *)
Definition phases (p : cut) : I.type := range (first_phase p) (last_phase p).
Definition turned (k : Z) : I.type := I.mul prec (I.mul prec (I.fromZ prec 2) (I.pi prec)) (I.fromZ prec k).
Lemma turned_holds k : holds (turned k) (2 * PI * IZR k).
Proof. apply mul_holds; [apply mul_holds; [apply I.fromZ_correct|apply I.pi_correct]|apply I.fromZ_correct]. Qed.
(* All of V within one turn, and not at its ends. *)
Definition one_turn (V : I.type) : bool := above_zero V && above_zero (I.sub prec (turned 1) V).
Lemma one_turn_holds V v : holds V v -> one_turn V = true -> 0 < v < 2 * PI.
Proof.
  unfold one_turn. rewrite andb_true_iff. intros H [Lo Hi]. apply (above_zero_holds _ _ H) in Lo.
  apply (above_zero_holds _ _ (sub_holds _ _ _ _ (turned_holds 1) H)) in Hi. lra.
Qed.
Definition image (k : Z) (p : cut) : option I.type :=
  match flown p with
  | Some (_, u, v) => Some (I.sub prec (I.add prec (phases p) (range u v)) (turned k))
  | None => None
  end.

Lemma image_holds k p V phi : image k p = Some V -> ratio (first_phase p) <= phi <= ratio (last_phase p) ->
  holds V (lift phi - 2 * PI * IZR k).
Proof.
  unfold image. intros H P. destruct (flown p) as [[[T u] v]|] eqn:Q; [|discriminate]. injection H as <-.
  destruct (branch_time S' E' N' (eta_real unit eta eta_pos) _ _ _ _ _ (flown_branch p T u v Q) phi P) as [_ B].
  apply sub_holds; [apply add_holds; apply range_holds; [exact P|lra]|apply turned_holds].
Qed.

(* f' on a piece. *)
Definition sloped (p : cut) : I.type :=
  match flown p with
  | Some (_, u, v) =>
    let L := launched bits unit side eta nu 0 (phases p) (range (Zneg unit) (Zpos unit)) in
    let Q := angles bits (I.mul prec (number eta) (range u v)) (I.add prec (phases p) (range u v)) in
    let S := I.fromZ prec side in let E2 := I.mul prec (number eta) (number eta) in
    I.div prec (I.mul prec (I.div prec (ts Q) (number eta))
        (I.sub prec (I.mul prec (I.sub prec (rise L) S) (I.sub prec (I.fromZ prec 1) E2)) (I.mul prec S E2)))
      (March.rate bits L Q)
  | None => I.nai
  end.

Lemma sloped_holds p T u v phi : flown p = Some (T, u, v) -> ratio (first_phase p) <= phi <= ratio (last_phase p) ->
  holds (sloped p) (Corrected.rate S' E' N' phi).
Proof.
  intros Q P. pose proof (eta_real unit eta eta_pos) as E0. unfold sloped. rewrite Q.
  pose proof (flown_branch p T u v Q) as Br.
  destruct (branch_time S' E' N' E0 _ _ _ _ _ Br phi P) as [_ B].
  set (t := impact_time phi) in *.
  assert (Ht : holds (range u v) t) by (apply range_holds; lra).
  assert (Hp : holds (phases p) phi) by (apply range_holds, P).
  pose proof (number_holds bits unit eta) as HE. pose proof (I.fromZ_correct prec side : holds _ S') as HS.
  assert (At0 : is_at (angles bits (I.mul prec (number eta) (range u v)) (I.add prec (phases p) (range u v))) (E' * t) (phi + t))
    by (apply angles_at; auto using mul_holds, add_holds).
  assert (Z0 : ratio (Zneg unit) <= 0 <= ratio (Zpos unit)) by (destruct velocities as (-> & -> & _); lra).
  pose proof (launched_from bits unit side eta nu 0 eta_pos (phases p) (range (Zneg unit) (Zpos unit)) phi 0 Hp (range_holds _ _ _ _ _ Z0)) as L.
  pose proof (rate_holds bits unit side eta nu 0 _ _ _ L _ _ At0) as R. rewrite ratio_0 in R.
  unfold Corrected.rate, Flight.slope. fold t.
  replace (S' * (N' * sin phi * (1 - E' ^ 2) - E' ^ 2)) with ((S' * (1 + N' * sin phi) - S') * (1 - E' * E') - S' * (E' * E')) by ring.
  assert (Neg : gap_t S' E' N' phi t < 0) by (apply (branch_falls _ _ _ _ _ _ _ _ Br); lra).
  apply div_holds; [|exact R|lra]. apply mul_holds; [apply div_holds; [apply At0|exact HE|lra]|].
  destruct L as ([Ri _] & _). pose proof (one_holds bits). auto 10 using sub_holds, mul_holds.
Qed.

(* |f'| >= m / n, where that is asked. *)
Variable bound : option (positive * positive).
Definition steep (way : bool) (p : cut) : bool :=
  match bound with
  | Some (m, n) => at_least bits n (if way then sloped p else I.neg (sloped p)) (Zpos m)
  | None => true
  end.
Definition good_piece (k : Z) (way : bool) (p : cut) : bool :=
  match image k p with
  | Some V => one_turn V && steep way p
  | None => false
  end.

(* What is shown of each phase: f in closed form, and its derivative. *)
Definition flies (k : Z) (way : bool) (x : R) : Prop :=
  next x (f x) /\ f x = lift x - 2 * PI * IZR k /\ exists s, is_derive f x s /\
    match bound with Some (m, n) => IZR (Zpos m) / IZR (Zpos n) <= if way then s else - s | None => True end.

Lemma good_piece_flies k way p x : good_piece k way p = true -> ratio (first_phase p) < x < ratio (last_phase p) -> flies k way x.
Proof.
  unfold good_piece. intros H X. destruct (image k p) as [V|] eqn:Q; [|discriminate].
  rewrite andb_true_iff in H. destruct H as [It St].
  unfold image in Q. destruct (flown p) as [[[T u] v]|] eqn:Fl; [|discriminate].
  assert (Re : regular (ratio (first_phase p)) (ratio (last_phase p)))
    by apply (branch_regular S' E' N' (eta_real unit eta eta_pos) _ _ _ _ _ (flown_branch p T u v Fl)).
  assert (La : in_lap S' E' N' (ratio (first_phase p)) (ratio (last_phase p)) k).
  { intros phi P. assert (HV : holds V (lift phi - 2 * PI * IZR k)) by (apply (image_holds k p); [unfold image; rewrite Fl|]; auto).
    apply (one_turn_holds _ _ HV) in It. lra. }
  destruct (f_lift S' E' N' _ _ Re k La x ltac:(lra)) as [E U].
  split; [apply U; reflexivity|split; [exact E|]].
  exists (Corrected.rate S' E' N' x). split; [apply (f_derive S' E' N' _ _ Re k La x X)|].
  unfold steep in St. destruct bound as [[m n]|]; auto.
  assert (Hs : holds (sloped p) (Corrected.rate S' E' N' x)) by (apply (sloped_holds p T u v x Fl); lra).
  destruct way; apply (at_least_holds bits n) with (2 := St); auto using neg_holds.
Qed.

(* One piece after the other, each beginning before the last one ends. *)
Section Chain.
Variable T : Type.
Variables first last : T -> Z.
Fixpoint chain (test : T -> bool) (from to : Z) (l : list T) : bool :=
  match l with
  | [] => false
  | p :: t => if (first p <? from)%Z && (from <? last p)%Z && test p
      then if (to <? last p)%Z then true else chain test (last p) to t
      else false
  end.

Lemma chain_holds (P : R -> Prop) test : (forall p x, test p = true -> ratio (first p) < x < ratio (last p) -> P x) ->
  forall l from to, chain test from to l = true -> forall x, ratio from <= x <= ratio to -> P x.
Proof.
  intros Here. induction l as [|p l IH]; intros from to C x X; cbn [chain] in C; [discriminate|].
  destruct (_ && _) eqn:G in C; [|discriminate].
  rewrite !andb_true_iff, !Z.ltb_lt in G. destruct G as [[A B] Gp].
  apply (ratio_lt unit) in A, B.
  destruct (Rlt_dec x (ratio (last p))) as [Lt|Ge]; [apply (Here p x Gp); lra|].
  destruct (Z.ltb_spec to (last p)) as [D|D]; [apply (ratio_lt unit) in D; lra|].
  apply (IH (last p) to C). lra.
Qed.
End Chain.
Arguments chain {T}.
Arguments chain_holds {T}.

Variable ends : list (Z * Z).
Variable arrows : list (nat * nat).
Variable flown_from : list laps.
Notation ends_of := (ends_of ends).
Notation cells := (cells unit ends).
Notation sources := (sources arrows).
Definition laps_of (i : nat) : laps := let p := Cut 0 0 [] [] [] in nth i flown_from (Laps 0 true [] p p).
Definition at_phase (k : Z) (p : cut) (n : Z) : option I.type :=
  if (first_phase p =? n)%Z && (last_phase p =? n)%Z then image k p else None.
Definition spread (L R : I.type) (j : nat) : bool :=
  let (a, b) := ends_of j in
  (at_most bits unit L a && at_least bits unit R b) || (at_most bits unit R a && at_least bits unit L b).
Definition good_source (i : nat) : bool :=
  let (l, r) := ends_of i in let s := laps_of i in
  chain first_phase last_phase (good_piece (turns s) (rising s)) l r (cuts s) &&
  match at_phase (turns s) (left_end s) l, at_phase (turns s) (right_end s) r with
  | Some L, Some R => forallb (fun a => if (fst a =? i)%nat then spread L R (snd a) else true) arrows
  | _, _ => false
  end.
Definition check_flights : bool := placed ends arrows && forallb good_source sources.

Hypothesis checked : check_flights = true.

Lemma checks : placed ends arrows = true /\ forall i, In i sources -> good_source i = true.
Proof. unfold check_flights in checked. rewrite andb_true_iff, forallb_forall in checked. exact checked. Qed.

Lemma flies_there i x : In i sources -> within unit ends i x -> flies (turns (laps_of i)) (rising (laps_of i)) x.
Proof.
  intros S X. destruct checks as [_ H]. specialize (H i S). unfold good_source in H. unfold within in X.
  destruct (ends_of i) as [l r]. apply andb_true_iff in H. destruct H as [H _].
  apply (chain_holds first_phase last_phase _ _ (good_piece_flies _ _) _ _ _ H x X).
Qed.

Lemma continuous_there i x : In i sources -> within unit ends i x -> continuity_pt f x.
Proof.
  intros S X. destruct (flies_there i x S X) as (_ & _ & s & D & _).
  apply continuity_pt_filterlim, (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule)). exists s. exact D.
Qed.

Lemma at_phase_holds k p n V : at_phase k p n = Some V -> holds V (lift (ratio n) - 2 * PI * IZR k).
Proof.
  unfold at_phase. destruct (_ && _) eqn:E; [|discriminate]. rewrite andb_true_iff, !Z.eqb_eq in E. destruct E as [A B].
  intros H. apply (image_holds k p); auto. rewrite A, B. lra.
Qed.

Lemma covers_along i j : In (i, j) arrows ->
  spans f (ratio (fst (ends_of i))) (ratio (snd (ends_of i))) (ratio (fst (ends_of j))) (ratio (snd (ends_of j))).
Proof.
  intros A. pose proof (source arrows i j A) as S. destruct checks as [Pl H]. specialize (H i S).
  assert (Or : ratio (fst (ends_of i)) <= ratio (snd (ends_of i))).
  { destruct (numbers ends arrows Pl i j A) as [Li _]. pose proof (in_turn ends arrows Pl) as As.
    apply ratio_le. pose proof (proj1 (ascending_lt ends As i Li)) as B. unfold Cells.ends_of. lia. }
  pose proof (flies_there i) as F. unfold within in F. unfold good_source in H.
  destruct (ends_of i) as [l r]. cbn [fst snd] in *. apply andb_true_iff in H. destruct H as [_ H].
  destruct (at_phase _ (left_end _) l) as [L|] eqn:QL; [|discriminate].
  destruct (at_phase _ (right_end _) r) as [R|] eqn:QR; [|discriminate].
  rewrite forallb_forall in H. specialize (H _ A). cbn [fst snd] in H. rewrite Nat.eqb_refl in H.
  apply at_phase_holds in QL, QR.
  rewrite <- (proj1 (proj2 (F (ratio l) S ltac:(lra)))) in QL. rewrite <- (proj1 (proj2 (F (ratio r) S ltac:(lra)))) in QR.
  unfold spread in H. destruct (ends_of j) as [a b]. cbn [fst snd].
  unfold spans. rewrite orb_true_iff, !andb_true_iff in H. destruct H as [[U V]|[U V]]; [left|right];
    eauto using at_most_holds, at_least_holds.
Qed.

(* Each phase of an interval from which an arrow goes has a next impact, at phase f. *)
Theorem flights_land i j x : In (i, j) arrows -> interval cells i x -> next x (f x).
Proof.
  intros A X. apply (flies_there i x (source arrows i j A)), (cell_within unit ends arrows (proj1 checks) i j x A X).
Qed.

Theorem flights_growth v p g : growing arrows (length ends) v p g = true -> entropy_at_least on_line f (interval cells) arrows p g.
Proof. apply cells_growth; [apply checks|apply continuous_there|apply covers_along]. Qed.
End Flights.
Arguments chain {T}.
Arguments chain_holds _ {T}.

Theorem flights_conjugate bits unit side eta nu m n ends arrows flown_from : (0 < eta)%Z -> (n <? m)%positive = true ->
  check_flights bits unit side eta nu (Some (m, n)) ends arrows flown_from = true ->
  conjugate (Corrected.f (IZR side) (ratio unit eta) (ratio unit nu)) (cells unit ends) arrows (IZR (Zpos m) / IZR (Zpos n)).
Proof.
  intros E mn H. apply cells_conjugate.
  - apply (checks bits unit side eta nu _ ends arrows flown_from H).
  - apply (continuous_there bits unit side eta nu E _ ends arrows flown_from H).
  - apply (covers_along bits unit side eta nu E _ ends arrows flown_from H).
  - apply Pos.ltb_lt in mn. apply (ratio_lt n (Zpos n) (Zpos m)) in mn. unfold ratio in mn.
    pose proof (unit_pos n). replace (IZR (Zpos n) / IZR (Zpos n)) with 1 in mn by (field; lra). exact mn.
  - intros i S. exists (rising (laps_of flown_from i)). intros z Z.
    destruct (flies_there bits unit side eta nu E _ ends arrows flown_from H i z S Z) as (_ & _ & D). exact D.
Qed.

(* A branch of the impact time by computing, at parameters and ends that are written otherwise. *)
Lemma computed_branch bits unit side eta nu p T u v s e n a b t x y : (0 < eta)%Z ->
  flown bits unit side eta nu p = Some (T, u, v) -> IZR side = s -> ratio unit eta = e -> ratio unit nu = n ->
  ratio unit (first_phase p) = a -> ratio unit (last_phase p) = b -> ratio unit T = t -> ratio unit u = x -> ratio unit v = y ->
  branch s e n a b t x y.
Proof. intros E H <- <- <- <- <- <- <- <-. apply (flown_branch bits unit side eta nu E p T u v H). Qed.

(* The impacts of a cut lie between phases. *)
Definition lands bits unit side eta nu (k : Z) (p : cut) (l r : Z) : bool :=
  match image bits unit side eta nu k p with
  | Some V => at_least bits unit V l && at_most bits unit V r && (0 <=? l)%Z &&
      above_zero (I.sub (F.PtoP bits) (turned bits 1) (number bits unit r))
  | None => false
  end.

Lemma lands_holds bits unit side eta nu k p l r phi : (0 < eta)%Z -> lands bits unit side eta nu k p l r = true ->
  ratio unit (first_phase p) <= phi <= ratio unit (last_phase p) ->
  exists psi, Impact.next (IZR side) (ratio unit eta) (ratio unit nu) phi psi /\ ratio unit l <= psi <= ratio unit r.
Proof.
  unfold lands. intros E H P. destruct (image bits unit side eta nu k p) as [V|] eqn:Q; [|discriminate].
  rewrite !andb_true_iff, Z.leb_le in H. destruct H as [[[Lo Hi] L0] R1].
  pose proof (image_holds bits unit side eta nu E k p V phi Q P) as HV.
  unfold image in Q. destruct (flown bits unit side eta nu p) as [[[T u] v]|] eqn:Fl; [|discriminate].
  destruct (branch_time _ _ _ (eta_real unit eta E) _ _ _ _ _ (flown_branch bits unit side eta nu E p T u v Fl) phi P) as [I _].
  apply (at_least_holds bits unit _ _ _ HV) in Lo. apply (at_most_holds bits unit _ _ _ HV) in Hi.
  apply (ratio_le unit) in L0. rewrite ratio_0 in L0.
  pose proof (above_zero_holds _ _ (sub_holds _ _ _ _ (turned_holds bits 1) (number_holds bits unit r)) R1).
  eexists. split; [|split; [exact Lo|exact Hi]]. unfold Corrected.lift in *.
  exists (Flight.impact_time (IZR side) (ratio unit eta) (ratio unit nu) phi), k. split; [exact I|split; [reflexivity|lra]].
Qed.

(* A phase whose image lies in an interval, and the image of that in another one. *)
Definition lands_twice bits unit side eta nu k p l r k' p' l' r' : bool :=
  lands bits unit side eta nu k p l r && lands bits unit side eta nu k' p' l' r' &&
  (first_phase p' <=? l)%Z && (r <=? last_phase p')%Z.

Lemma computed_orbit bits unit side eta nu k p l r k' p' l' r' s e n x :
  lands_twice bits unit side eta nu k p l r k' p' l' r' = true -> (0 < eta)%Z ->
  IZR side = s -> ratio unit eta = e -> ratio unit nu = n -> ratio unit (first_phase p) = x -> ratio unit (last_phase p) = x ->
  exists y z, Impact.next s e n x y /\ ratio unit l <= y <= ratio unit r /\
    Impact.next s e n y z /\ ratio unit l' <= z <= ratio unit r'.
Proof.
  unfold lands_twice. rewrite !andb_true_iff, !Z.leb_le. intros [[[H G] A] B] E <- <- <- <- X.
  apply (ratio_le unit) in A, B.
  destruct (lands_holds bits unit side eta nu k p l r _ E H (conj (Rle_refl _) (Req_le_sym _ _ X))) as (y & Y & Y').
  destruct (lands_holds bits unit side eta nu k' p' l' r' y E G ltac:(lra)) as (z & Z & Z'). exists y, z. auto.
Qed.
