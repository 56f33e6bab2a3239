(* Maps of the plane by formulas, one after the other: enclosures of images and of derivatives. *)
From Coq Require Import Reals ZArith Psatz List Bool.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Float_full Interval Xreal.
From Oscillator Require Import Numbers Formula.
Import ListNotations.
Open Scope R_scope.

Definition stage := (formula * formula)%type.
Definition apply (s : stage) (z : R * R) : R * R := (value (fst s) (fst z) (snd z), value (snd s) (fst z) (snd z)).
Definition run (l : list stage) (z : R * R) : R * R := fold_left (fun z s => apply s z) l z.

(* The derivatives of x and of y, by x and by y. *)
Record matrix (T : Type) := Matrix { xx : T; xy : T; yx : T; yy : T }.
Arguments Matrix {T}. Arguments xx {T}. Arguments xy {T}. Arguments yx {T}. Arguments yy {T}.

Section Enclosed.
Variable bits : positive.
Notation prec := (F.PtoP bits).
Notation "a [+] b" := (I.add prec a b) (at level 50, left associativity).
Notation "a [*] b" := (I.mul prec a b) (at level 40, left associativity).

Fixpoint images (l : list stage) (A B : I.type) : option (I.type * I.type) :=
  match l with
  | [] => Some (A, B)
  | s :: l => let V := enclose bits (fst s) A B in let W := enclose bits (snd s) A B in
    if I.real V then if I.real W then images l V W else None else None
  end.

Fixpoint slopes (l : list stage) (A B : I.type) (M : matrix I.type) : option (matrix I.type) :=
  match l with
  | [] => Some M
  | s :: l =>
    let V := enclose bits (fst s) A B in let W := enclose bits (snd s) A B in
    let D w e := enclose bits (diff w e) A B in
    let a := D true (fst s) in let b := D false (fst s) in let c := D true (snd s) in let d := D false (snd s) in
    if forallb I.real [V; W; a; b; c; d] then
      slopes l V W (Matrix (a [*] xx M [+] b [*] yx M) (a [*] xy M [+] b [*] yy M)
                           (c [*] xx M [+] d [*] yx M) (c [*] xy M [+] d [*] yy M))
    else None
  end.

Lemma images_hold l : forall A B V W z, images l A B = Some (V, W) -> holds A (fst z) -> holds B (snd z) ->
  holds V (fst (run l z)) /\ holds W (snd (run l z)).
Proof.
  induction l as [|s l IH]; intros A B V W z H X Y; simpl in H; [injection H as <- <-; auto|].
  destruct (I.real (enclose bits (fst s) A B)) eqn:R1; [|discriminate].
  destruct (I.real (enclose bits (snd s) A B)) eqn:R2; [|discriminate].
  apply (IH _ _ _ _ (apply s z) H); apply enclosed_real; auto.
Qed.

Definition held (M : matrix I.type) (m : matrix R) : Prop :=
  holds (xx M) (xx m) /\ holds (xy M) (xy m) /\ holds (yx M) (yx m) /\ holds (yy M) (yy m).

(* Along a curve with the derivative m (u, v). *)
Lemma slopes_hold l : forall A B M N (a b : R -> R) t m u v, slopes l A B M = Some N ->
  holds A (a t) -> holds B (b t) -> held M m ->
  is_derive a t (xx m * u + xy m * v) -> is_derive b t (yx m * u + yy m * v) ->
  exists n, held N n /\ is_derive (fun s => fst (run l (a s, b s))) t (xx n * u + xy n * v) /\
    is_derive (fun s => snd (run l (a s, b s))) t (yx n * u + yy n * v).
Proof.
  induction l as [|s l IH]; intros A B M N a b t m u v H X Y (M1 & M2 & M3 & M4) Da Db; cbn [slopes] in H.
  - injection H as <-. exists m. unfold held. auto.
  - destruct (forallb I.real _) eqn:Re; [|discriminate]. cbn [forallb] in Re. rewrite !andb_true_iff in Re.
    destruct Re as (R1 & R2 & R3 & R4 & R5 & R6 & _).
    destruct (enclosed_real bits _ _ _ _ _ X Y R1) as [D1 H1], (enclosed_real bits _ _ _ _ _ X Y R2) as [D2 H2],
      (enclosed_real bits _ _ _ _ _ X Y R3) as [D3 H3], (enclosed_real bits _ _ _ _ _ X Y R4) as [_ H4],
      (enclosed_real bits _ _ _ _ _ X Y R5) as [D5 H5], (enclosed_real bits _ _ _ _ _ X Y R6) as [_ H6].
    pose proof (derivative a b t _ _ (fst s) Da Db D1 D3) as E1. pose proof (derivative a b t _ _ (snd s) Da Db D2 D5) as E2.
    unfold slope_of in E1, E2.
    set (w1 := value (diff true (fst s)) (a t) (b t)) in *. set (w2 := value (diff false (fst s)) (a t) (b t)) in *.
    set (w3 := value (diff true (snd s)) (a t) (b t)) in *. set (w4 := value (diff false (snd s)) (a t) (b t)) in *.
    apply (IH _ _ _ _ (fun r => value (fst s) (a r) (b r)) (fun r => value (snd s) (a r) (b r)) t
      (Matrix (w1 * xx m + w2 * yx m) (w1 * xy m + w2 * yy m) (w3 * xx m + w4 * yx m) (w3 * xy m + w4 * yy m))
      u v H H1 H2).
    + unfold held; cbn [xx xy yx yy]. auto 10 using add_holds, mul_holds.
    + cbn [xx xy yx yy]. replace ((w1 * xx m + w2 * yx m) * u + (w1 * xy m + w2 * yy m) * v) with
        (w1 * (xx m * u + xy m * v) + w2 * (yx m * u + yy m * v)) by ring. exact E1.
    + cbn [xx xy yx yy]. replace ((w3 * xx m + w4 * yx m) * u + (w3 * xy m + w4 * yy m) * v) with
        (w3 * (xx m * u + xy m * v) + w4 * (yx m * u + yy m * v)) by ring. exact E2.
Qed.
End Enclosed.
