(* From numeric facts on two rectangles to the two-sided shift of the rebounds. No numbers. *)
From Coq Require Import Reals ZArith Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Rebounds Flight Crossed.
Open Scope R_scope.

(* One flight: a launch that does not fall at first, then positive, then falling through 0. *)
Lemma one_flight (h h1 h2 : R -> R) T u v :
  (forall t, is_derive h t (h1 t)) -> (forall t, is_derive h1 t (h2 t)) ->
  h 0 = 0 -> 0 <= h1 0 -> 0 < T /\ T <= u /\ u < v ->
  (forall t, 0 <= t <= T -> 0 < h2 t) -> (forall t, T <= t <= u -> 0 < h t) ->
  (forall t, u <= t <= v -> h1 t < 0) -> h v < 0 ->
  exists t, u < t < v /\ h t = 0 /\ forall s, 0 < s < t -> 0 < h s.
Proof.
  intros D1 D2 Z0 Z1 O L F D E.
  assert (Up : forall s, 0 < s <= T -> 0 < h1 s).
  { intros s S. destruct (mvt h1 h2 0 s) as [c [C Q]]; [lra|auto|].
    assert (0 < h2 c) by (apply L; lra). nra. }
  assert (Launch : forall s, 0 < s <= T -> 0 < h s).
  { intros s S. destruct (mvt h h1 0 (s / 2)) as [c [C Q]]; [lra|auto|].
    destruct (mvt h h1 (s / 2) s) as [c' [C' Q']]; [lra|auto|].
    assert (0 < h1 c') by (apply Up; lra).
    assert (0 <= h1 c) by (destruct (Req_dec c 0) as [->|]; [auto|apply Rlt_le, Up; lra]). nra. }
  destruct (ivt h h1 u v) as [c [C Z]]; [lra|auto|split; [auto|apply F; lra]|].
  exists c. split; [auto|split; [auto|]]. intros s S.
  destruct (Rle_dec s T); [apply Launch; lra|]. destruct (Rle_dec s u); [apply F; lra|].
  destruct (mvt h h1 s c) as [d [? G]]; [lra|auto|]. assert (h1 d < 0) by (apply D; lra). nra.
Qed.

Section Model.
Variables side eta nu eps : R.
Hypothesis eta_pos : 0 < eta.
Notation kick := (kick eta nu eps).
Notation height := (height side eta nu eps).
Notation arrival := (arrival eta nu eps).
Notation rebound := (rebound side eta nu eps).

Definition height_t (phi g t : R) : R :=
  side * (- (1 + nu * sin phi) * (eta * sin (eta * t)) + kick phi g * (eta * cos (eta * t)) - nu * cos (phi + t)).
Definition height_tt (phi g t : R) : R :=
  side * (- (1 + nu * sin phi) * (eta ^ 2 * cos (eta * t)) - kick phi g * (eta ^ 2 * sin (eta * t)) + nu * sin (phi + t)).
Definition kick_p (phi : R) : R := - (nu / eta * (1 + eps) * sin phi).
Definition height_p (phi t : R) : R :=
  side * (nu * cos phi * cos (eta * t) + kick_p phi * sin (eta * t) - nu * cos (phi + t)).
Definition height_g (t : R) : R := side * (eps * sin (eta * t)).
Definition arrival_t (phi g t : R) : R :=
  (1 + nu * sin phi) * (eta * cos (eta * t)) + kick phi g * (eta * sin (eta * t)).
Definition arrival_p (phi t : R) : R := nu * cos phi * sin (eta * t) - kick_p phi * cos (eta * t).
Definition arrival_g (t : R) : R := - (eps * cos (eta * t)).

(* The entries of DF at an impact. *)
Definition DP_p (phi g t : R) : R := 1 - height_p phi t / height_t phi g t.
Definition DP_g (phi g t : R) : R := - (height_g t / height_t phi g t).
Definition DQ_p (phi g t : R) : R := arrival_p phi t - arrival_t phi g t * (height_p phi t / height_t phi g t).
Definition DQ_g (phi g t : R) : R := arrival_g t - arrival_t phi g t * (height_g t / height_t phi g t).

Lemma d_height_t phi g t : is_derive (height phi g) t (height_t phi g t).
Proof. unfold Rebounds.height, height_t. auto_derive; auto. ring. Qed.

Lemma d_height_tt phi g t : is_derive (height_t phi g) t (height_tt phi g t).
Proof. unfold height_t, height_tt. auto_derive; auto. ring. Qed.

Definition first (phi g t : R) : Prop :=
  0 < t /\ height phi g t = 0 /\ forall s, 0 < s < t -> 0 < height phi g s.

Lemma first_unique phi g s t : first phi g s -> first phi g t -> s = t.
Proof.
  intros (S0 & S1 & S2) (T0 & T1 & T2).
  destruct (Rtotal_order s t) as [L|[E|L]]; auto; [specialize (T2 s)|specialize (S2 t)]; lra.
Qed.

Definition time (phi g : R) : R := iota (first phi g).

Lemma time_spec phi g t : first phi g t -> time phi g = t.
Proof.
  intros I. apply (first_unique phi g); auto.
  apply (iota_correct (V := R_CompleteNormedModule) (first phi g)). exists t. split; auto.
  intros s S. apply (first_unique phi g); auto.
Qed.

(* What the numbers have to show for phases in [a, b] and velocities in [d, e]. *)
Record flights (a b d e T u v : R) : Prop := {
  fl_order : 0 < T /\ T <= u /\ u < v;
  fl_possible : forall phi g, a <= phi <= b -> d <= g <= e -> 0 <= side * (eps * (eta * g + nu * cos phi));
  fl_launch : forall phi g t, a <= phi <= b -> d <= g <= e -> 0 <= t <= T -> 0 < height_tt phi g t;
  fl_flight : forall phi g t, a <= phi <= b -> d <= g <= e -> T <= t <= u -> 0 < height phi g t;
  fl_fall : forall phi g t, a <= phi <= b -> d <= g <= e -> u <= t <= v -> height_t phi g t < 0;
  fl_end : forall phi g, a <= phi <= b -> d <= g <= e -> height phi g v < 0
}.

Section Flights.
Variables a b d e T u v : R.
Hypothesis Fl : flights a b d e T u v.

Lemma time_first phi g : a <= phi <= b -> d <= g <= e -> first phi g (time phi g) /\ u < time phi g < v.
Proof.
  intros P G. destruct Fl as [O Po L F D E].
  destruct (one_flight (height phi g) (height_t phi g) (height_tt phi g) T u v) as (t & U & Z & S); auto.
  - apply d_height_t.
  - apply d_height_tt.
  - unfold Rebounds.height. rewrite Rmult_0_r, sin_0, cos_0, Rplus_0_r. ring.
  - replace (height_t phi g 0) with (side * (eps * (eta * g + nu * cos phi))); auto.
    unfold height_t, Rebounds.kick. rewrite Rmult_0_r, sin_0, cos_0, Rplus_0_r. field. lra.
  - assert (I : first phi g t) by (split; [lra|auto]). rewrite (time_spec _ _ _ I). auto.
Qed.

Lemma time_bracket phi g x y : a <= phi <= b -> d <= g <= e -> u <= x -> y <= v ->
  0 < height phi g x -> x <= v -> u <= y -> height phi g y < 0 -> x < time phi g < y.
Proof.
  intros P G X Y Hx Xv Yu Hy. destruct (time_first phi g P G) as [(I0 & I1 & I2) [L M]].
  destruct Fl as [O Po La F D E]. split.
  - destruct (Rlt_dec x (time phi g)) as [|N]; auto. exfalso.
    destruct (Req_dec x (time phi g)) as [E1|]; [rewrite E1 in Hx; lra|].
    destruct (mvt (height phi g) (height_t phi g) (time phi g) x) as [c [C Q]]; [lra|intros; apply d_height_t|].
    assert (height_t phi g c < 0) by (apply D; auto; lra). nra.
  - destruct (Rlt_dec (time phi g) y) as [|N]; auto. exfalso.
    destruct (Req_dec y (time phi g)) as [E1|]; [rewrite E1 in Hy; lra|]. specialize (I2 y). lra.
Qed.

(* Along a line of states. *)
Section Line.
Variables f0 df c0 dc : R.
Definition ph (s : R) : R := f0 + s * df.
Definition ve (s : R) : R := c0 + s * dc.
Definition inside (s : R) : Prop := a < ph s < b /\ d < ve s < e.
Definition H (s t : R) : R := height (ph s) (ve s) t.
Definition H_s (s t : R) : R := height_p (ph s) t * df + height_g t * dc.

Lemma d_H_s s t : is_derive (fun s => H s t) s (H_s s t).
Proof.
  unfold H, H_s, Rebounds.height, Rebounds.kick, height_p, height_g, kick_p, ph, ve.
  auto_derive; auto. field. lra.
Qed.

Lemma inside_near s : inside s -> locally s (fun r => a <= ph r <= b /\ d <= ve r <= e).
Proof.
  intros [P G]. apply filter_and.
  - assert (C : continuous ph s) by (apply (ex_derive_continuous ph); unfold ph; auto_derive; auto).
    apply (C (fun p => a <= p <= b)), between_near, P.
  - assert (C : continuous ve s) by (apply (ex_derive_continuous ve); unfold ve; auto_derive; auto).
    apply (C (fun p => d <= p <= e)), between_near, G.
Qed.

Definition tau (s : R) : R := time (ph s) (ve s).

Lemma tau_continuous s : inside s -> forall ep : posreal, locally s (fun r => Rabs (tau r - tau s) < ep).
Proof.
  intros Is ep. destruct Is as [P G]. destruct (time_first (ph s) (ve s) ltac:(lra) ltac:(lra)) as [I L].
  fold (tau s) in I, L. set (t := tau s) in *. pose proof (cond_pos ep) as E.
  set (y := (t + Rmin v (t + ep)) / 2). set (x := (t + Rmax u (t - ep)) / 2).
  assert (Y : t < y < t + ep /\ u <= y <= v).
  { unfold y. pose proof (Rmin_l v (t + ep)). pose proof (Rmin_r v (t + ep)).
    assert (t < Rmin v (t + ep)) by (apply Rmin_glb_lt; lra). lra. }
  assert (X : t - ep < x < t /\ u <= x <= v).
  { unfold x. pose proof (Rmax_l u (t - ep)). pose proof (Rmax_r u (t - ep)).
    assert (Rmax u (t - ep) < t) by (apply Rmax_lub_lt; lra). lra. }
  assert (GX : 0 < H s x). { apply I. destruct Fl as [O _ _ _ _ _]. lra. }
  assert (GY : H s y < 0).
  { destruct I as (I0 & I1 & I2). destruct Fl as [O _ _ _ D _].
    destruct (mvt (H s) (height_t (ph s) (ve s)) t y) as [c [C Q]]; [lra|intros; apply d_height_t|].
    assert (height_t (ph s) (ve s) c < 0) by (apply D; lra). unfold H in Q. unfold H. nra. }
  assert (NX : locally s (fun r => 0 < H r x))
    by (apply (positive_near (fun r => H r x) s (H_s s x)); auto; apply d_H_s).
  assert (NY : locally s (fun r => 0 < - H r y)).
  { apply (positive_near (fun r => - H r y) s (- H_s s y)); [|lra].
    apply (is_derive_opp (fun r => H r y) s (H_s s y)). apply d_H_s. }
  generalize (filter_and _ _ (filter_and _ _ NX NY) (inside_near s (conj P G))). apply filter_imp.
  intros r [[QX QY] [Rp Rg]]. assert (x < tau r < y) by (apply time_bracket; auto; unfold H in *; lra).
  apply Rabs_def1; lra.
Qed.
End Line.
End Flights.
End Model.
