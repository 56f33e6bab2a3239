(* Containment: the checker's pi, sine and cosine. *)
From Coq Require Import Reals ZArith Psatz Lia List Machin.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Arithmetic Operations Flight.
Open Scope R_scope.

Ltac real := match goal with |- @eq _ ?a ?b => change (@eq R a b) end.

Lemma power_derive n c x : is_derive (fun x => c * x ^ S n / INR (S n)) x (c * x ^ n).
Proof.
  assert (INR (S n) <> 0) by (apply not_0_INR; lia).
  apply (is_derive_ext (fun x => c / INR (S n) * x ^ S n)). { intros; real; unfold Rdiv; ring. }
  replace (c * x ^ n) with (c / INR (S n) * (INR (S n) * 1 * x ^ pred (S n))) by (real; simpl pred; field; auto).
  apply is_derive_scal, is_derive_pow. apply (is_derive_id x).
Qed.

(* A function with E(0) = 0 and |E'(t)| <= c |t|^n is at most c |x|^(n + 1) / (n + 1). *)
Lemma compare (E dE : R -> R) c n x : E 0 = 0 -> (forall t, is_derive E t (dE t)) ->
  (forall t, Rabs (dE t) <= c * Rabs t ^ n) -> Rabs (E x) <= c * Rabs x ^ S n / INR (S n).
Proof.
  intros E0 D B. destruct (Req_dec x 0) as [->|x0].
  { rewrite E0, !Rabs_R0. simpl. unfold Rdiv. rewrite Rmult_0_l, Rmult_0_r, Rmult_0_l. lra. }
  assert (Sign : forall z, exists u, Rabs u = 1 /\ Rabs z = u * z /\ z = u * Rabs z).
  { intros z. destruct (Rle_dec 0 z); [exists 1|exists (-1)];
      [rewrite Rabs_R1, Rabs_pos_eq by lra|rewrite Rabs_m1, Rabs_left by lra]; lra. }
  destruct (Sign (E x)) as (u & U & -> & _), (Sign x) as (s & S1 & _ & X). apply Rabs_pos_lt in x0.
  destruct (mvt (fun t => minus (c * t ^ S n / INR (S n)) (u * E (s * t)))
    (fun t => minus (c * t ^ n) (u * (s * dE (s * t)))) 0 (Rabs x)) as [t [T H]]; auto.
  - intros t _. apply (is_derive_minus (V := R_NormedModule)); [apply power_derive|].
    apply is_derive_scal. apply (is_derive_comp (V := R_NormedModule) E); [apply D|].
    auto_derive; auto. ring.
  - change (c * Rabs x ^ S n / INR (S n) - u * E (s * Rabs x) - (c * 0 ^ S n / INR (S n) - u * E (s * 0))
      = (c * t ^ n - u * (s * dE (s * t))) * (Rabs x - 0)) in H.
    rewrite <- X, Rmult_0_r, E0, (pow_ne_zero (S n)) in H by discriminate.
    specialize (B (s * t)). rewrite Rabs_mult, S1, Rmult_1_l, (Rabs_pos_eq t) in B by lra.
    pose proof (Rle_abs (u * (s * dE (s * t)))) as A. rewrite !Rabs_mult, U, S1 in A.
    unfold Rdiv in *. rewrite !Rmult_0_r, Rmult_0_l in H. nra.
Qed.

(* -- sine and cosine -- *)

(* The Taylor polynomial of sin(a + x), of degree n. *)
Fixpoint taylor (a : R) (n : nat) (x : R) : R :=
  match n with
  | O => sin a
  | S m => taylor a m x + sin (a + INR n * (PI / 2)) * x ^ n / INR (fact n)
  end.

Lemma taylor_derive n : forall a x, is_derive (taylor a (S n)) x (taylor (a + PI / 2) n x).
Proof.
  assert (T : forall n a x, is_derive (fun x => sin (a + INR (S n) * (PI / 2)) * x ^ S n / INR (fact (S n))) x
    (sin (a + PI / 2 + INR n * (PI / 2)) * x ^ n / INR (fact n))).
  { intros k a x. pose proof (INR_fact_neq_0 k). assert (INR (S k) <> 0) by (apply not_0_INR; lia).
    apply (is_derive_ext (fun x => sin (a + INR (S k) * (PI / 2)) / INR (fact k) * x ^ S k / INR (S k))).
    { intros t. real. rewrite fact_simpl, mult_INR. field. auto. }
    replace (a + PI / 2 + INR k * (PI / 2)) with (a + INR (S k) * (PI / 2)) by (rewrite S_INR; ring).
    replace (sin (a + INR (S k) * (PI / 2)) * x ^ k / INR (fact k)) with
      (sin (a + INR (S k) * (PI / 2)) / INR (fact k) * x ^ k) by (real; field; auto).
    apply power_derive. }
  induction n as [|n IH]; intros a x.
  - apply (is_derive_ext (fun x => plus (sin a) (sin (a + INR 1 * (PI / 2)) * x ^ 1 / INR (fact 1)))).
    { reflexivity. }
    replace (taylor _ _ _) with (plus 0 (sin (a + PI / 2 + INR 0 * (PI / 2)) * x ^ 0 / INR (fact 0))).
    + apply (is_derive_plus (V := R_NormedModule)); [|apply T].
      apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
    + unfold plus; simpl. rewrite Rmult_0_l, !Rplus_0_r, Rplus_0_l. field.
  - apply (is_derive_plus (V := R_NormedModule) (taylor a (S n))); [apply IH|apply T].
Qed.

Lemma taylor_error n : forall a x, Rabs (sin (a + x) - taylor a n x) <= Rabs x ^ S n / INR (fact (S n)).
Proof.
  assert (D : forall a x, is_derive (fun x => sin (a + x)) x (sin (a + PI / 2 + x))).
  { intros a x. replace (a + PI / 2 + x) with (PI / 2 + (a + x)) by ring. rewrite <- cos_sin.
    auto_derive; auto. ring. }
  assert (E0 : forall n a, sin (a + 0) - taylor a n 0 = 0).
  { intros k a. rewrite Rplus_0_r. induction k as [|k IH]; [simpl; ring|].
    change (taylor a (S k) 0) with (taylor a k 0 + sin (a + INR (S k) * (PI / 2)) * 0 ^ S k / INR (fact (S k))).
    rewrite (pow_ne_zero (S k)) by discriminate. unfold Rdiv. lra. }
  induction n as [|n IH]; intros a x.
  - replace (Rabs x ^ 1 / INR (fact 1)) with (1 * Rabs x ^ 1 / INR 1) by (simpl; field).
    apply (compare (fun x => minus (sin (a + x)) (sin a)) (fun t => minus (sin (a + PI / 2 + t)) 0) 1 0 x).
    + apply (E0 O).
    + intros t. apply (is_derive_minus (V := R_NormedModule)); [apply D|].
      apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
    + intros t. unfold minus, plus, opp; simpl. rewrite Ropp_0, Rplus_0_r, Rmult_1_r.
      apply Rabs_le, SIN_bound.
  - pose proof (INR_fact_neq_0 (S n)). assert (INR (S (S n)) <> 0) by (apply not_0_INR; lia).
    replace (Rabs x ^ S (S n) / INR (fact (S (S n)))) with (/ INR (fact (S n)) * Rabs x ^ S (S n) / INR (S (S n))).
    + apply (compare (fun x => minus (sin (a + x)) (taylor a (S n) x))
        (fun t => minus (sin (a + PI / 2 + t)) (taylor (a + PI / 2) n t)) _ (S n) x).
      * apply E0.
      * intros t. apply (is_derive_minus (V := R_NormedModule)); [apply D|apply taylor_derive].
      * intros t. rewrite Rmult_comm. apply IH.
    + rewrite (fact_simpl (S n)), mult_INR. field. auto.
Qed.
