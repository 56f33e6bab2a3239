(* Flights after an impact, by computing: data whose check gives a first impact that is transversal,
   for a box of phases and velocities. The height of the mass over the table is a combination of the
   sine and cosine of eta t and of phi + t: their enclosures are turned from step to step. *)
From Coq Require Import Reals ZArith Psatz Lia List Bool.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Float_full Interval Xreal.
From Oscillator Require Import Impact Rebounds Calculus Restitution Numbers.
Import ListNotations.
Open Scope R_scope.

Section March.
Variable bits : positive.
Variable unit : positive.
Notation prec := (F.PtoP bits).
Notation "a [+] b" := (I.add prec a b) (at level 50, left associativity).
Notation "a [-] b" := (I.sub prec a b) (at level 50, left associativity).
Notation "a [*] b" := (I.mul prec a b) (at level 40, left associativity).
Notation ratio := (ratio unit).
Notation number := (number bits unit).
Notation range := (range bits unit).
Notation number_holds := (number_holds bits unit).
Notation range_holds := (range_holds bits unit).
Notation ratio_lt := (ratio_lt unit).
Notation ratio_le := (ratio_le unit).
Notation ratio_add := (ratio_add unit).

(* Cosine and sine of two angles. *)
Record place := At { tc : I.type; ts : I.type; pc : I.type; ps : I.type }.
Definition is_at (P : place) (a b : R) : Prop :=
  holds (tc P) (cos a) /\ holds (ts P) (sin a) /\ holds (pc P) (cos b) /\ holds (ps P) (sin b).
Definition angles (A B : I.type) : place := At (I.cos prec A) (I.sin prec A) (I.cos prec B) (I.sin prec B).
Definition turn (P D : place) : place :=
  At (tc P [*] tc D [-] ts P [*] ts D) (ts P [*] tc D [+] tc P [*] ts D)
     (pc P [*] pc D [-] ps P [*] ps D) (ps P [*] pc D [+] pc P [*] ps D).

Lemma angles_at A B a b : holds A a -> holds B b -> is_at (angles A B) a b.
Proof.
  intros H G. unfold is_at, angles, holds; cbn [tc ts pc ps].
  repeat split; [apply (I.cos_correct prec A (Xreal a))|apply (I.sin_correct prec A (Xreal a))|
    apply (I.cos_correct prec B (Xreal b))|apply (I.sin_correct prec B (Xreal b))]; auto.
Qed.

Lemma turn_at P D a b c d : is_at P a b -> is_at D c d -> is_at (turn P D) (a + c) (b + d).
Proof.
  intros (A & B & C & E) (F & G & H & J). unfold is_at, turn; cbn [tc ts pc ps].
  rewrite !cos_plus, !sin_plus. repeat split; auto using add_holds, sub_holds, mul_holds.
Qed.

(* The parameters are numbers of that kind. *)
Variables side eta nu eps : Z.
Notation S' := (IZR side).
Notation E' := (ratio eta).
Notation N' := (ratio nu).
Notation P' := (ratio eps).
Hypothesis eta_pos : (0 < eta)%Z.
Lemma eta_real : 0 < E'.
Proof. rewrite <- (ratio_0 unit). apply ratio_lt, eta_pos. Qed.

Notation kick := (kick E' N' P').
Notation height := (height S' E' N' P').
Notation height_t := (height_t S' E' N' P').
Notation height_tt := (height_tt S' E' N' P').

(* Coefficients of the height, side (1 + nu sin phi) and side kick, with powers of eta, for phases and
   velocities of a box: computed once for all times. *)
Record launch := From { rise : I.type; push : I.type; rise1 : I.type; push1 : I.type;
  rise2 : I.type; push2 : I.type; wall : I.type }.
Definition is_from (L : launch) (phi g : R) : Prop :=
  let A := S' * (1 + N' * sin phi) in let K := S' * kick phi g in
  (holds (rise L) A /\ holds (push L) K) /\ (holds (rise1 L) (E' * A) /\ holds (push1 L) (E' * K)) /\
  (holds (rise2 L) (E' * (E' * A)) /\ holds (push2 L) (E' * (E' * K))) /\ holds (wall L) (S' * N').
Definition launched (PHI GAMMA : I.type) : launch :=
  let SIDE := I.fromZ prec side in let ETA := number eta in let NU := number nu in
  let A := SIDE [*] (I.fromZ prec 1 [+] NU [*] I.sin prec PHI) in
  let K := SIDE [*] (number eps [*] GAMMA [+] I.div prec NU ETA [*] (I.fromZ prec 1 [+] number eps) [*] I.cos prec PHI) in
  From A K (number eta [*] A) (number eta [*] K) (number eta [*] (number eta [*] A)) (number eta [*] (number eta [*] K)) (SIDE [*] NU).

Lemma launched_from PHI GAMMA phi g : holds PHI phi -> holds GAMMA g -> is_from (launched PHI GAMMA) phi g.
Proof.
  intros P G. pose proof (I.sin_correct prec PHI (Xreal phi) P) as Si. pose proof (I.cos_correct prec PHI (Xreal phi) P) as Co.
  pose proof eta_real. pose proof (number_holds eta) as HE. pose proof (number_holds nu) as HN. pose proof (number_holds eps) as HP.
  pose proof (I.fromZ_correct prec side) as HS. pose proof one_holds as H1.
  assert (A : holds (I.fromZ prec side [*] (I.fromZ prec 1 [+] number nu [*] I.sin prec PHI)) (S' * (1 + N' * sin phi)))
    by auto using mul_holds, add_holds.
  assert (K : holds (I.fromZ prec side [*] (number eps [*] GAMMA [+] I.div prec (number nu) (number eta) [*]
    (I.fromZ prec 1 [+] number eps) [*] I.cos prec PHI)) (S' * kick phi g)).
  { apply mul_holds; auto. unfold Rebounds.kick. apply add_holds; [auto using mul_holds|].
    apply mul_holds; [|auto]. apply mul_holds; [|auto using add_holds]. apply div_holds; auto. lra. }
  unfold is_from, launched; cbn [rise push rise1 push1 rise2 push2 wall]. auto 10 using mul_holds.
Qed.

Section Values.
Variable L : launch.
Definition level (P : place) : I.type :=
  rise L [*] tc P [+] push L [*] ts P [-] I.fromZ prec side [-] wall L [*] ps P.
Definition rate (P : place) : I.type := push1 L [*] tc P [-] rise1 L [*] ts P [-] wall L [*] pc P.
Definition bend (P : place) : I.type := wall L [*] ps P [-] rise2 L [*] tc P [-] push2 L [*] ts P.

Variables phi g : R.
Hypothesis from : is_from L phi g.

Lemma level_holds P t : is_at P (E' * t) (phi + t) -> holds (level P) (height phi g t).
Proof.
  intros (A & B & C & D). destruct from as ([R K] & _ & _ & W).
  replace (height phi g t) with (S' * (1 + N' * sin phi) * cos (E' * t) + S' * kick phi g * sin (E' * t) - S' - S' * N' * sin (phi + t))
    by (unfold Rebounds.height; ring).
  unfold level. pose proof (I.fromZ_correct prec side : holds _ _). auto 10 using add_holds, sub_holds, mul_holds.
Qed.
Lemma rate_holds P t : is_at P (E' * t) (phi + t) -> holds (rate P) (height_t phi g t).
Proof.
  intros (A & B & C & D). destruct from as (_ & [R K] & _ & W).
  replace (height_t phi g t) with (E' * (S' * kick phi g) * cos (E' * t) - E' * (S' * (1 + N' * sin phi)) * sin (E' * t) - S' * N' * cos (phi + t))
    by (unfold Restitution.height_t; ring).
  unfold rate. auto 10 using sub_holds, mul_holds.
Qed.
Lemma bend_holds P t : is_at P (E' * t) (phi + t) -> holds (bend P) (height_tt phi g t).
Proof.
  intros (A & B & C & D). destruct from as (_ & _ & [R K] & W).
  replace (height_tt phi g t) with (S' * N' * sin (phi + t) - E' * (E' * (S' * (1 + N' * sin phi))) * cos (E' * t) - E' * (E' * (S' * kick phi g)) * sin (E' * t))
    by (unfold Restitution.height_tt; ring).
  unfold bend. auto 10 using sub_holds, mul_holds.
Qed.
End Values.

(* Launches of phases [a, b] and velocities [d, e], seen from the middle of the phases. *)
Variables a b d e : Z.
Definition middle : R := (ratio a + ratio b) / 2.
Definition MIDDLE : I.type := I.div prec (number a [+] number b) (I.fromZ prec 2).
Definition ASIDE : I.type := range a b [-] MIDDLE.
Lemma middle_holds : holds MIDDLE middle.
Proof. apply div_holds; [apply add_holds; apply number_holds|apply I.fromZ_correct|lra]. Qed.

(* A step of h from a place P at time t, by what is asked of it. *)
Inductive stage := Launch | Flight | Fall.
Definition asked (k : stage) (phi g t : R) : Prop :=
  match k with Launch => 0 < height_tt phi g t | Flight => 0 < height phi g t | Fall => height_t phi g t < 0 end.
Definition good (k : stage) (L : launch) (BOX THERE : place) (STEP : I.type) (P : place) : bool :=
  match k with
  | Launch => above_zero (bend L (turn P BOX))
  | Flight => above_zero (level L (turn P THERE) [+] STEP [*] rate L (turn P BOX))
  | Fall => above_zero (I.neg (rate L (turn P BOX)))
  end.

(* Turned by a step of h; by up to h, from any of the phases; a time from the middle. *)
Definition ahead (h : Z) : place := angles (number eta [*] number h) (number h).
Definition about (h : Z) : place := angles (number eta [*] range 0 h) (ASIDE [+] range 0 h).
Definition seen (t : Z) : place := angles (number eta [*] number t) (MIDDLE [+] number t).
(* At a time between t and t + h. *)
Definition between (t h : Z) : place := turn (seen t) (about h).

Fixpoint march (test : place -> bool) (H : place) (n : nat) (P : place) : bool :=
  match n with O => true | S n => if test P then march test H n (turn P H) else false end.

(* Steps of h, n times; then others. *)
Fixpoint runs (k : stage) (L : launch) (start : Z) (l : list (Z * nat)) : option Z :=
  match l with
  | [] => Some start
  | (h, n) :: l =>
    if (0 <=? h)%Z && march (good k L (about h) (angles (number 0) ASIDE) (range 0 h)) (ahead h) n (seen start)
    then runs k L (start + Z.of_nat n * h) l else None
  end.

Section Box.
Variables phi g : R.
Hypothesis phase : ratio a <= phi <= ratio b.

Variable L : launch.
Hypothesis from_box : is_from L phi g.
Lemma aside_holds : holds ASIDE (phi - middle).
Proof. apply sub_holds; [apply range_holds; auto|apply middle_holds]. Qed.

Lemma seen_at t : is_at (seen t) (E' * ratio t) (middle + ratio t).
Proof.
  apply angles_at; [apply mul_holds; apply number_holds|apply add_holds; [apply middle_holds|apply number_holds]].
Qed.

Lemma about_at h P t r : is_at P (E' * t) (middle + t) -> t <= r <= t + ratio h -> is_at (turn P (about h)) (E' * r) (phi + r).
Proof.
  intros A Hr. assert (St : holds (range 0 h) (r - t)) by (apply range_holds; rewrite ratio_0; lra).
  replace (E' * r) with (E' * t + E' * (r - t)) by ring.
  replace (phi + r) with (middle + t + (phi - middle + (r - t))) by ring.
  apply turn_at; auto. apply angles_at; [apply mul_holds; [apply number_holds|auto]|].
  apply add_holds; [apply aside_holds|auto].
Qed.

Lemma between_at t h r : ratio t <= r <= ratio t + ratio h -> is_at (between t h) (E' * r) (phi + r).
Proof. apply about_at, seen_at. Qed.

Lemma good_holds k h P t : good k L (about h) (angles (number 0) ASIDE) (range 0 h) P = true ->
  is_at P (E' * t) (middle + t) -> forall s, t <= s <= t + ratio h -> asked k phi g s.
Proof.
  intros T A s Hs.
  pose proof (fun r => about_at h P t r A) as Box.
  destruct k; cbn [good asked] in *.
  - apply (above_zero_holds _ _ (bend_holds L phi g from_box _ _ (Box s Hs)) T).
  - assert (There : is_at (turn P (angles (number 0) ASIDE)) (E' * t) (phi + t)).
    { replace (E' * t) with (E' * t + 0) by ring. replace (phi + t) with (middle + t + (phi - middle)) by ring.
      apply turn_at; auto. apply angles_at; [rewrite <- (ratio_0 unit); apply number_holds|apply aside_holds]. }
    destruct (Req_dec t s) as [<-|N].
    + replace (height phi g t) with (height phi g t + 0 * height_t phi g t) by ring.
      refine (above_zero_holds _ _ _ T). apply add_holds; [apply level_holds; auto|].
      apply mul_holds; [apply range_holds; rewrite ratio_0; lra|]. apply rate_holds; [apply from_box|]. apply Box. lra.
    + destruct (mvt (height phi g) (height_t phi g) t s) as (c & C & D); [lra|intros; apply d_height_t|].
      replace (height phi g s) with (height phi g t + (s - t) * height_t phi g c) by lra.
      refine (above_zero_holds _ _ _ T). apply add_holds; [apply level_holds; auto|].
      apply mul_holds; [apply range_holds; rewrite ratio_0; lra|]. apply rate_holds; [apply from_box|]. apply Box. lra.
  - pose proof (above_zero_holds _ _ (neg_holds _ _ (rate_holds L phi g from_box _ _ (Box s Hs))) T). lra.
Qed.

Lemma march_holds k h test : (0 <= h)%Z -> test = good k L (about h) (angles (number 0) ASIDE) (range 0 h) ->
  forall n P t, march test (ahead h) n P = true -> is_at P (E' * t) (middle + t) ->
  forall s, t <= s <= t + ratio (Z.of_nat n * h) -> t < t + ratio (Z.of_nat n * h) -> asked k phi g s.
Proof.
  intros h0 Test. induction n as [|n IH]; intros P t M A s Hs Lt; cbn [march] in M.
  { simpl Z.of_nat in Lt. rewrite Z.mul_0_l, ratio_0 in Lt. lra. }
  destruct (test P) eqn:T; [|discriminate]. subst test. pose proof (ratio_le 0 h h0) as H0. rewrite ratio_0 in H0.
  replace (Z.of_nat (S n) * h)%Z with (h + Z.of_nat n * h)%Z in Hs, Lt by lia. rewrite ratio_add in Hs, Lt.
  destruct (Rle_dec s (t + ratio h)) as [Le|Gt]; [apply (good_holds k h P t T A s); lra|].
  apply (IH _ (t + ratio h) M); [|lra|lra].
  replace (E' * (t + ratio h)) with (E' * t + E' * ratio h) by ring.
  replace (middle + (t + ratio h)) with (middle + t + ratio h) by ring.
  apply turn_at; auto. apply angles_at; [apply mul_holds|]; apply number_holds.
Qed.

Lemma runs_later k l : forall start last, runs k L start l = Some last -> (start <= last)%Z.
Proof.
  induction l as [|[h n] l IH]; intros start last R; cbn [runs] in R; [injection R; lia|].
  destruct (_ && _) eqn:C in R; [|discriminate]. apply andb_true_iff in C. destruct C as [C _]. apply Z.leb_le in C.
  apply IH in R. nia.
Qed.

Lemma runs_hold k l : forall start last, runs k L start l = Some last -> (start < last)%Z ->
  forall t, ratio start <= t <= ratio last -> asked k phi g t.
Proof.
  induction l as [|[h n] l IH]; intros start last R O t Ht; cbn [runs] in R; [injection R; lia|].
  destruct (_ && _) eqn:C in R; [|discriminate]. apply andb_true_iff in C. destruct C as [C M]. apply Z.leb_le in C.
  pose proof (runs_later _ _ _ _ R) as Later. pose proof (ratio_add start (Z.of_nat n * h)) as Add.
  assert (Here : (start < start + Z.of_nat n * h)%Z -> t <= ratio (start + Z.of_nat n * h) -> asked k phi g t).
  { intros S T. apply ratio_lt in S. apply (march_holds k h _ C eq_refl n _ (ratio start) M (seen_at start)); lra. }
  destruct (Z.eq_dec start (start + Z.of_nat n * h)) as [E|E].
  - rewrite <- E in R. apply (IH _ _ R O t Ht).
  - destruct (Rle_dec t (ratio (start + Z.of_nat n * h))) as [T|T]; [apply Here; [nia|auto]|].
    destruct (Z.eq_dec (start + Z.of_nat n * h) last) as [F|F]; [rewrite <- F in Ht; lra|].
    apply (IH _ _ R); [lia|lra].
Qed.
End Box.

(* gap'' > 0 on the first runs, gap > 0 on the second, gap' < 0 on the third, gap < 0 at their end:
   the times before and after the impact. *)
Variables lifts flights falls : list (Z * nat).
Definition impact : option (Z * Z * Z) :=
  let L := launched (range a b) (range d e) in
  match runs Launch L 0 lifts with
  | None => None
  | Some T => match runs Flight L T flights with
    | None => None
    | Some u => match runs Fall L u falls with
      | None => None
      | Some v =>
        if (0 <? T)%Z && (T <? u)%Z && (u <? v)%Z &&
           not_negative (I.fromZ prec side [*] (number eps [*] (number eta [*] range d e [+] number nu [*] I.cos prec (range a b)))) &&
           above_zero (I.neg (level L (angles (number eta [*] number v) (range a b [+] number v))))
        then Some (T, u, v) else None
      end
    end
  end.

Theorem impact_flights T u v : impact = Some (T, u, v) ->
  Restitution.flights S' E' N' P' (ratio a) (ratio b) (ratio d) (ratio e) (ratio T) (ratio u) (ratio v).
Proof.
  unfold impact. set (L := launched (range a b) (range d e)). intros H.
  assert (From : forall phi g, ratio a <= phi <= ratio b -> ratio d <= g <= ratio e -> is_from L phi g)
    by (intros; apply launched_from; apply range_holds; auto).
  destruct (runs Launch L 0 lifts) as [T1|] eqn:RL; [|discriminate].
  destruct (runs Flight L T1 flights) as [u1|] eqn:RF; [|discriminate].
  destruct (runs Fall L u1 falls) as [v1|] eqn:RD; [|discriminate].
  destruct (_ && _) eqn:C in H; [|discriminate]. injection H as -> -> ->.
  rewrite !andb_true_iff, !Z.ltb_lt in C. destruct C as [[[[T0 Tu] uv] Po] En].
  pose proof (ratio_lt _ _ T0) as T0'. rewrite ratio_0 in T0'. pose proof (ratio_lt _ _ uv). pose proof (ratio_lt _ _ Tu).
  split.
  - lra.
  - intros phi g P G. refine (not_negative_holds _ _ _ Po).
    apply mul_holds; [apply I.fromZ_correct|]. apply mul_holds; [apply number_holds|].
    apply add_holds; apply mul_holds; try apply number_holds; [apply range_holds; auto|].
    apply (I.cos_correct prec _ (Xreal phi)), range_holds, P.
  - intros phi g t P G Ht. apply (runs_hold phi g P L (From phi g P G) Launch _ _ _ RL T0). rewrite ratio_0. exact Ht.
  - intros phi g t P G Ht. apply (runs_hold phi g P L (From phi g P G) Flight _ _ _ RF Tu t Ht).
  - intros phi g t P G Ht. apply (runs_hold phi g P L (From phi g P G) Fall _ _ _ RD uv t Ht).
  - intros phi g P G. pose proof (range_holds _ _ _ P) as HP.
    assert (A : is_at (angles (number eta [*] number v) (range a b [+] number v)) (E' * ratio v) (phi + ratio v)).
    { apply angles_at; [apply mul_holds; apply number_holds|apply add_holds; [auto|apply number_holds]]. }
    pose proof (above_zero_holds _ _ (neg_holds _ _ (level_holds L phi g (From phi g P G) _ _ A)) En). lra.
Qed.
End March.
