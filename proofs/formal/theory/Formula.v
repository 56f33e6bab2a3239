(* Formulas of one variable: their values, their enclosures, and their derivatives. *)
From Coq Require Import Reals ZArith Psatz List.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Float_full Interval Xreal Basic.
From Oscillator Require Import Numbers.
Open Scope R_scope.

Inductive formula :=
  | X | Integer (n : Z) | Pi
  | Neg (a : formula) | Add (a b : formula) | Sub (a b : formula) | Mul (a b : formula) | Div (a b : formula)
  | Power (a : formula) (n : nat) | Sqrt (a : formula) | Exp (a : formula) | Log (a : formula)
  | Sin (a : formula) | Cos (a : formula).

Fixpoint value (e : formula) (x : R) : R :=
  match e with
  | X => x | Integer n => IZR n | Pi => PI
  | Neg a => - value a x
  | Add a b => value a x + value b x | Sub a b => value a x - value b x
  | Mul a b => value a x * value b x | Div a b => value a x / value b x
  | Power a n => value a x ^ n
  | Sqrt a => sqrt (value a x) | Exp a => exp (value a x) | Log a => ln (value a x)
  | Sin a => sin (value a x) | Cos a => cos (value a x)
  end.

(* No division by 0, no root of a negative number, no logarithm of a number <= 0. *)
Fixpoint defined (e : formula) (x : R) : Prop :=
  match e with
  | X | Integer _ | Pi => True
  | Add a b | Sub a b | Mul a b => defined a x /\ defined b x
  | Div a b => defined a x /\ defined b x /\ value b x <> 0
  | Sqrt a => defined a x /\ 0 <= value a x
  | Log a => defined a x /\ 0 < value a x
  | Neg a | Power a _ | Exp a | Sin a | Cos a => defined a x
  end.

Fixpoint diff (e : formula) : formula :=
  match e with
  | X => Integer 1 | Integer _ | Pi => Integer 0
  | Neg a => Neg (diff a)
  | Add a b => Add (diff a) (diff b) | Sub a b => Sub (diff a) (diff b)
  | Mul a b => Add (Mul (diff a) b) (Mul a (diff b))
  | Div a b => Div (Sub (Mul (diff a) b) (Mul a (diff b))) (Power b 2)
  | Power a n => Mul (Mul (Integer (Z.of_nat n)) (diff a)) (Power a (pred n))
  | Sqrt a => Div (diff a) (Mul (Integer 2) (Sqrt a))
  | Exp a => Mul (diff a) (Exp a) | Log a => Div (diff a) a
  | Sin a => Mul (diff a) (Cos a) | Cos a => Neg (Mul (diff a) (Sin a))
  end.

Lemma continuous_value e x : defined e x -> continuous (value e) x.
Proof.
  induction e; simpl; intros D.
  - apply continuous_id.
  - apply continuous_const.
  - apply continuous_const.
  - apply (continuous_opp (value e)); auto.
  - apply (continuous_plus (value e1) (value e2)); tauto.
  - apply (continuous_minus (value e1) (value e2)); tauto.
  - apply (continuous_mult (value e1) (value e2)); tauto.
  - apply (continuous_mult (value e1) (fun x => / value e2 x)); [tauto|].
    apply (continuous_comp (value e2) Rinv); [tauto|]. apply continuous_Rinv. tauto.
  - induction n as [|n IH]; simpl; [apply continuous_const|].
    apply (continuous_mult (value e) (fun x => value e x ^ n)); auto.
  - apply (continuous_comp (value e) sqrt); [tauto|apply continuous_sqrt].
  - apply (continuous_comp (value e) exp); [auto|apply continuous_exp].
  - apply (continuous_comp (value e) ln); [tauto|apply continuous_ln; tauto].
  - apply (continuous_comp (value e) sin); [auto|apply continuous_sin].
  - apply (continuous_comp (value e) cos); [auto|apply continuous_cos].
Qed.

Lemma derivative e x : defined e x -> defined (diff e) x -> is_derive (value e) x (value (diff e) x).
Proof.
  induction e; simpl; intros D E.
  - apply (is_derive_id x).
  - apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
  - apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
  - apply (is_derive_opp (value e)); auto.
  - apply (is_derive_plus (value e1) (value e2)); tauto.
  - apply (is_derive_minus (value e1) (value e2)); tauto.
  - apply (is_derive_mult (value e1) (value e2)); [tauto|tauto|apply Rmult_comm].
  - replace (value e2 x * (value e2 x * 1)) with (value e2 x ^ 2) by ring.
    apply (is_derive_div (value e1) (value e2)); tauto.
  - rewrite <- INR_IZR_INZ. apply (is_derive_pow (value e) n). tauto.
  - apply (is_derive_sqrt (value e)); [tauto|]. destruct D as [_ [L|Z]]; [auto|exfalso].
    destruct E as (_ & _ & N). apply N. rewrite <- Z, sqrt_0. ring.
  - apply (is_derive_comp exp (value e)); [apply is_derive_exp|tauto].
  - apply (is_derive_comp ln (value e)); [apply is_derive_ln; tauto|tauto].
  - apply (is_derive_comp sin (value e)); [apply is_derive_sin|tauto].
  - rewrite Ropp_mult_distr_r. apply (is_derive_comp cos (value e)); [apply is_derive_cos|tauto].
Qed.

Section Enclose.
Variable bits : positive.
Notation prec := (F.PtoP bits).

Definition root (A : I.type) : I.type := match I.sign_large A with Xgt | Xeq => I.sqrt prec A | _ => I.nai end.

Fixpoint enclose (e : formula) (B : I.type) : I.type :=
  match e with
  | X => B | Integer n => I.fromZ prec n | Pi => I.pi prec
  | Neg a => I.neg (enclose a B)
  | Add a b => I.add prec (enclose a B) (enclose b B)
  | Sub a b => I.sub prec (enclose a B) (enclose b B)
  | Mul a b => I.mul prec (enclose a B) (enclose b B)
  | Div a b => I.div prec (enclose a B) (enclose b B)
  | Power a n => I.power_int prec (enclose a B) (Z.of_nat n)
  | Sqrt a => root (enclose a B)
  | Exp a => I.exp prec (enclose a B) | Log a => I.ln prec (enclose a B)
  | Sin a => I.sin prec (enclose a B) | Cos a => I.cos prec (enclose a B)
  end.

(* The value, or nothing: what is not defined is contained in no interval with ends. *)
Definition extended (e : formula) (x : R) (v : ExtendedR) : Prop :=
  match v with Xreal r => defined e x /\ r = value e x | Xnan => True end.

Lemma enclosed e B x : holds B x -> exists v, contains (I.convert (enclose e B)) v /\ extended e x v.
Proof.
  intros H. induction e; simpl; unfold extended in *.
  - exists (Xreal x). split; simpl; auto.
  - exists (Xreal (IZR n)). split; [apply I.fromZ_correct|simpl; auto].
  - exists (Xreal PI). split; [apply I.pi_correct|simpl; auto].
  - destruct IHe as (v & C & V). exists (Xneg v). split; [apply I.neg_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. auto.
  - destruct IHe1 as (v & C & V), IHe2 as (w & D & W). exists (Xadd v w). split; [apply I.add_correct; auto|].
    destruct v, w; simpl; auto. destruct V as [V ->], W as [W ->]. auto.
  - destruct IHe1 as (v & C & V), IHe2 as (w & D & W). exists (Xsub v w). split; [apply I.sub_correct; auto|].
    destruct v, w; simpl; auto. destruct V as [V ->], W as [W ->]. auto.
  - destruct IHe1 as (v & C & V), IHe2 as (w & D & W). exists (Xmul v w). split; [apply I.mul_correct; auto|].
    destruct v, w; simpl; auto. destruct V as [V ->], W as [W ->]. auto.
  - destruct IHe1 as (v & C & V), IHe2 as (w & D & W). exists (Xdiv v w). split; [apply I.div_correct; auto|].
    destruct v, w; simpl; auto. destruct V as [V ->], W as [W ->]. unfold Xdiv'.
    destruct (is_zero_spec (value e2 x)); auto.
  - destruct IHe as (v & C & V). exists (Xpower_int v (Z.of_nat n)). split; [apply I.power_int_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. unfold Xpower_int'.
    destruct n; simpl; [auto|]. rewrite SuccNat2Pos.id_succ. auto.
  - destruct IHe as (v & C & V). unfold root. pose proof (I.sign_large_correct (enclose e B)) as S.
    destruct (I.sign_large (enclose e B)); try (exists Xnan; rewrite I.nai_correct; simpl; auto; fail);
      exists (Xsqrt v); (split; [apply I.sqrt_correct, C|]); specialize (S v C).
    + subst v. simpl in *. destruct V as [V <-]. repeat split; auto; lra.
    + destruct v; simpl in *; [auto|]. destruct V as [V ->]. tauto.
  - destruct IHe as (v & C & V). exists (Xexp v). split; [apply I.exp_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. auto.
  - destruct IHe as (v & C & V). exists (Xln v). split; [apply I.ln_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. unfold Xln'. destruct (is_positive_spec (value e x)); simpl; auto.
  - destruct IHe as (v & C & V). exists (Xsin v). split; [apply I.sin_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. auto.
  - destruct IHe as (v & C & V). exists (Xcos v). split; [apply I.cos_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. auto.
Qed.

Lemma enclosed_real e B x : holds B x -> I.real (enclose e B) = true -> defined e x /\ holds (enclose e B) (value e x).
Proof.
  intros H Re. destruct (enclosed e B x H) as (v & C & V). rewrite I.real_correct in Re. unfold holds.
  destruct (I.convert (enclose e B)) eqn:Q; [discriminate|]. destruct v; [destruct C|].
  destruct V as [V ->]. auto.
Qed.
End Enclose.
