(* Formulas of two variables: their values, their enclosures, and their derivatives. *)
From Coq Require Import Reals ZArith Psatz List.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Float_full Interval Xreal Basic.
From Oscillator Require Import Numbers.
Open Scope R_scope.

Inductive formula :=
  | X | Y | Integer (n : Z) | Pi
  | Neg (a : formula) | Add (a b : formula) | Sub (a b : formula) | Mul (a b : formula) | Div (a b : formula)
  | Power (a : formula) (n : nat) | Sqrt (a : formula) | Exp (a : formula) | Log (a : formula)
  | Sin (a : formula) | Cos (a : formula).

Fixpoint value (e : formula) (x y : R) : R :=
  match e with
  | X => x | Y => y | Integer n => IZR n | Pi => PI
  | Neg a => - value a x y
  | Add a b => value a x y + value b x y | Sub a b => value a x y - value b x y
  | Mul a b => value a x y * value b x y | Div a b => value a x y / value b x y
  | Power a n => value a x y ^ n
  | Sqrt a => sqrt (value a x y) | Exp a => exp (value a x y) | Log a => ln (value a x y)
  | Sin a => sin (value a x y) | Cos a => cos (value a x y)
  end.

(* No division by 0, no root of a negative number, no logarithm of a number <= 0. *)
Fixpoint defined (e : formula) (x y : R) : Prop :=
  match e with
  | X | Y | Integer _ | Pi => True
  | Add a b | Sub a b | Mul a b => defined a x y /\ defined b x y
  | Div a b => defined a x y /\ defined b x y /\ value b x y <> 0
  | Sqrt a => defined a x y /\ 0 <= value a x y
  | Log a => defined a x y /\ 0 < value a x y
  | Neg a | Power a _ | Exp a | Sin a | Cos a => defined a x y
  end.

(* The derivative by x, if by_x, or by y. *)
Fixpoint diff (by_x : bool) (e : formula) : formula :=
  match e with
  | X => Integer (if by_x then 1 else 0) | Y => Integer (if by_x then 0 else 1)
  | Integer _ | Pi => Integer 0
  | Neg a => Neg (diff by_x a)
  | Add a b => Add (diff by_x a) (diff by_x b) | Sub a b => Sub (diff by_x a) (diff by_x b)
  | Mul a b => Add (Mul (diff by_x a) b) (Mul a (diff by_x b))
  | Div a b => Div (Sub (Mul (diff by_x a) b) (Mul a (diff by_x b))) (Power b 2)
  | Power a n => Mul (Mul (Integer (Z.of_nat n)) (diff by_x a)) (Power a (pred n))
  | Sqrt a => Div (diff by_x a) (Mul (Integer 2) (Sqrt a))
  | Exp a => Mul (diff by_x a) (Exp a) | Log a => Div (diff by_x a) a
  | Sin a => Mul (diff by_x a) (Cos a) | Cos a => Neg (Mul (diff by_x a) (Sin a))
  end.

(* Along a curve. *)
Section Curve.
Variables a b : R -> R.
Variable t : R.
Notation along e := (fun s => value e (a s) (b s)).

Lemma continuous_value e : continuous a t -> continuous b t -> defined e (a t) (b t) -> continuous (along e) t.
Proof.
  intros A B. induction e; simpl; intros D.
  - exact A.
  - exact B.
  - apply continuous_const.
  - apply continuous_const.
  - apply (continuous_opp (along e)); auto.
  - apply (continuous_plus (along e1) (along e2)); tauto.
  - apply (continuous_minus (along e1) (along e2)); tauto.
  - apply (continuous_mult (along e1) (along e2)); tauto.
  - apply (continuous_mult (along e1) (fun s => / value e2 (a s) (b s))); [tauto|].
    apply (continuous_comp (along e2) Rinv); [tauto|]. apply continuous_Rinv. tauto.
  - induction n as [|n IH]; simpl; [apply continuous_const|].
    apply (continuous_mult (along e) (fun s => value e (a s) (b s) ^ n)); auto.
  - apply (continuous_comp (along e) sqrt); [tauto|apply continuous_sqrt].
  - apply (continuous_comp (along e) exp); [auto|apply continuous_exp].
  - apply (continuous_comp (along e) ln); [tauto|apply continuous_ln; tauto].
  - apply (continuous_comp (along e) sin); [auto|apply continuous_sin].
  - apply (continuous_comp (along e) cos); [auto|apply continuous_cos].
Qed.

Variables da db : R.
Definition slope_of (e : formula) : R := value (diff true e) (a t) (b t) * da + value (diff false e) (a t) (b t) * db.

Lemma derivative e : is_derive a t da -> is_derive b t db -> defined e (a t) (b t) ->
  defined (diff true e) (a t) (b t) -> is_derive (along e) t (slope_of e).
Proof.
  intros A B. unfold slope_of. induction e; simpl; intros D E.
  - replace (1 * da + 0 * db) with da by ring. exact A.
  - replace (0 * da + 1 * db) with db by ring. exact B.
  - replace (0 * da + 0 * db) with 0 by ring. apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
  - replace (0 * da + 0 * db) with 0 by ring. apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
  - match goal with |- is_derive _ _ ?d => replace d with (- slope_of e) by (unfold slope_of; ring) end.
    apply (is_derive_opp (along e)). apply IHe; tauto.
  - match goal with |- is_derive _ _ ?d => replace d with (slope_of e1 + slope_of e2) by (unfold slope_of; ring) end.
    apply (is_derive_plus (along e1) (along e2)); [apply IHe1|apply IHe2]; tauto.
  - match goal with |- is_derive _ _ ?d => replace d with (slope_of e1 - slope_of e2) by (unfold slope_of; ring) end.
    apply (is_derive_minus (along e1) (along e2)); [apply IHe1|apply IHe2]; tauto.
  - match goal with |- is_derive _ _ ?d => replace d with
      (slope_of e1 * value e2 (a t) (b t) + value e1 (a t) (b t) * slope_of e2) by (unfold slope_of; ring) end.
    apply (is_derive_mult (along e1) (along e2)); [apply IHe1|apply IHe2|apply Rmult_comm]; tauto.
  - match goal with |- is_derive _ _ ?d => replace d with
      ((slope_of e1 * value e2 (a t) (b t) - value e1 (a t) (b t) * slope_of e2) / value e2 (a t) (b t) ^ 2)
      by (unfold slope_of; field; tauto) end.
    apply (is_derive_div (along e1) (along e2)); [apply IHe1|apply IHe2|]; tauto.
  - match goal with |- is_derive _ _ ?d => replace d with (INR n * slope_of e * value e (a t) (b t) ^ pred n)
      by (unfold slope_of; rewrite INR_IZR_INZ; ring) end.
    apply (is_derive_pow (along e) n). apply IHe; tauto.
  - assert (L : 0 < value e (a t) (b t)).
    { destruct D as [_ [L|Z]]; [auto|exfalso]. destruct E as (_ & _ & N). apply N. rewrite <- Z, sqrt_0. ring. }
    match goal with |- is_derive _ _ ?d => replace d with (slope_of e / (2 * sqrt (value e (a t) (b t))))
      by (unfold slope_of; field; apply Rgt_not_eq, sqrt_lt_R0, L) end.
    apply (is_derive_sqrt (along e)); [apply IHe; tauto|exact L].
  - match goal with |- is_derive _ _ ?d => replace d with (slope_of e * exp (value e (a t) (b t))) by (unfold slope_of; ring) end.
    apply (is_derive_comp exp (along e)); [apply is_derive_exp|apply IHe; tauto].
  - match goal with |- is_derive _ _ ?d => replace d with (slope_of e * / value e (a t) (b t)) by (unfold slope_of; field; lra) end.
    apply (is_derive_comp ln (along e)); [apply is_derive_ln; tauto|apply IHe; tauto].
  - match goal with |- is_derive _ _ ?d => replace d with (slope_of e * cos (value e (a t) (b t))) by (unfold slope_of; ring) end.
    apply (is_derive_comp sin (along e)); [apply is_derive_sin|apply IHe; tauto].
  - match goal with |- is_derive _ _ ?d => replace d with (slope_of e * - sin (value e (a t) (b t))) by (unfold slope_of; ring) end.
    apply (is_derive_comp cos (along e)); [apply is_derive_cos|apply IHe; tauto].
Qed.
End Curve.

Section Enclose.
Variable bits : positive.
Notation prec := (F.PtoP bits).

Definition root (A : I.type) : I.type := match I.sign_large A with Xgt | Xeq => I.sqrt prec A | _ => I.nai end.

Fixpoint enclose (e : formula) (A B : I.type) : I.type :=
  match e with
  | X => A | Y => B | Integer n => I.fromZ prec n | Pi => I.pi prec
  | Neg a => I.neg (enclose a A B)
  | Add a b => I.add prec (enclose a A B) (enclose b A B)
  | Sub a b => I.sub prec (enclose a A B) (enclose b A B)
  | Mul a b => I.mul prec (enclose a A B) (enclose b A B)
  | Div a b => I.div prec (enclose a A B) (enclose b A B)
  | Power a n => I.power_int prec (enclose a A B) (Z.of_nat n)
  | Sqrt a => root (enclose a A B)
  | Exp a => I.exp prec (enclose a A B) | Log a => I.ln prec (enclose a A B)
  | Sin a => I.sin prec (enclose a A B) | Cos a => I.cos prec (enclose a A B)
  end.

(* The value, or nothing: what is not defined is contained in no interval with ends. *)
Definition extended (e : formula) (x y : R) (v : ExtendedR) : Prop :=
  match v with Xreal r => defined e x y /\ r = value e x y | Xnan => True end.

Lemma enclosed e A B x y : holds A x -> holds B y -> exists v, contains (I.convert (enclose e A B)) v /\ extended e x y v.
Proof.
  intros H G. induction e; simpl; unfold extended in *.
  - exists (Xreal x). split; simpl; auto.
  - exists (Xreal y). split; simpl; auto.
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
    destruct (is_zero_spec (value e2 x y)); auto.
  - destruct IHe as (v & C & V). exists (Xpower_int v (Z.of_nat n)). split; [apply I.power_int_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. unfold Xpower_int'.
    destruct n; simpl; [auto|]. rewrite SuccNat2Pos.id_succ. auto.
  - destruct IHe as (v & C & V). unfold root. pose proof (I.sign_large_correct (enclose e A B)) as S.
    destruct (I.sign_large (enclose e A B)); try (exists Xnan; rewrite I.nai_correct; simpl; auto; fail);
      exists (Xsqrt v); (split; [apply I.sqrt_correct, C|]); specialize (S v C).
    + subst v. simpl in *. destruct V as [V <-]. repeat split; auto; lra.
    + destruct v; simpl in *; [auto|]. destruct V as [V ->]. tauto.
  - destruct IHe as (v & C & V). exists (Xexp v). split; [apply I.exp_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. auto.
  - destruct IHe as (v & C & V). exists (Xln v). split; [apply I.ln_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. unfold Xln'. destruct (is_positive_spec (value e x y)); simpl; auto.
  - destruct IHe as (v & C & V). exists (Xsin v). split; [apply I.sin_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. auto.
  - destruct IHe as (v & C & V). exists (Xcos v). split; [apply I.cos_correct, C|].
    destruct v; simpl; [auto|]. destruct V as [V ->]. auto.
Qed.

Lemma enclosed_real e A B x y : holds A x -> holds B y -> I.real (enclose e A B) = true ->
  defined e x y /\ holds (enclose e A B) (value e x y).
Proof.
  intros H G Re. destruct (enclosed e A B x y H G) as (v & C & V). rewrite I.real_correct in Re. unfold holds.
  destruct (I.convert (enclose e A B)) eqn:Q; [discriminate|]. destruct v; [destruct C|].
  destruct V as [V ->]. auto.
Qed.
End Enclose.
