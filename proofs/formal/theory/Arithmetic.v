(* The checker's arithmetic, transcribed line by line from proofs/trusted/kernel/arithmetic.py
   (// is /, >> is Z.shiftr, both rounding down), and what it means that an enclosure holds a
   number. Loops have fuel; None: out of fuel, or Unproved. Only this file is to be trusted. *)
From Coq Require Import Reals ZArith List.
Open Scope bool_scope.
Open Scope Z_scope.

Record enclosure := Enclosure { lo : Z; hi : Z }.

(* X, in units of 2^-bits, holds the number x. *)
Definition holds (bits : Z) (X : enclosure) (x : R) : Prop :=
  (IZR (lo X) <= x * IZR (2 ^ bits) <= IZR (hi X))%R.

Definition ceil (a b : Z) : Z := - (- a / b).           (* -(-a // b) *)
Definition up (a n : Z) : Z := - Z.shiftr (- a) n.      (* -(-a >> n) *)

Section Bits.
Variable bits : Z.

Definition integer (n : Z) : enclosure := Enclosure (Z.shiftl n bits) (Z.shiftl n bits).
Definition fractions (a b c d : Z) : enclosure :=       (* of(a / b, c / d) *)
  Enclosure (Z.shiftl a bits / b) (- (Z.shiftl (- c) bits / d)).
Definition neg (X : enclosure) : enclosure := Enclosure (- hi X) (- lo X).
Definition add (X Y : enclosure) : enclosure := Enclosure (lo X + lo Y) (hi X + hi Y).
Definition sub (X Y : enclosure) : enclosure := Enclosure (lo X - hi Y) (hi X - lo Y).
Definition min4 (a b c d : Z) : Z := Z.min (Z.min a b) (Z.min c d).
Definition max4 (a b c d : Z) : Z := Z.max (Z.max a b) (Z.max c d).
Definition mul (X Y : enclosure) : enclosure :=
  let (a, b) := X in let (c, d) := Y in
  Enclosure (Z.shiftr (min4 (a * c) (a * d) (b * c) (b * d)) bits)
            (up (max4 (a * c) (a * d) (b * c) (b * d)) bits).
Definition scale (X : enclosure) (n : Z) : enclosure :=  (* X times an integer *)
  Enclosure (Z.min (lo X * n) (hi X * n)) (Z.max (lo X * n) (hi X * n)).
Definition div (X Y : enclosure) : option enclosure :=
  if (lo Y <=? 0) && (0 <=? hi Y) then None else
  let a := Z.shiftl (lo X) bits in let b := Z.shiftl (hi X) bits in
  let c := lo Y in let d := hi Y in
  Some (Enclosure (min4 (a / c) (a / d) (b / c) (b / d))
                  (max4 (ceil a c) (ceil a d) (ceil b c) (ceil b d))).
Definition pow (X : enclosure) (n : nat) : enclosure := Nat.iter (n - 1) (fun Y => mul Y X) X.
Definition hull (X Y : enclosure) : enclosure :=
  Enclosure (Z.min (lo X) (lo Y)) (Z.max (hi X) (hi Y)).
Definition meet (X Y : enclosure) : option enclosure :=
  let low := Z.max (lo X) (lo Y) in let high := Z.min (hi X) (hi Y) in
  if high <? low then None else Some (Enclosure low high).
End Bits.

(* _atan_inverse(n, bits), from its k-th term on *)
Fixpoint atan_inverse (fuel : nat) (n bits total k : Z) : option (Z * Z) :=
  match fuel with
  | O => None
  | S fuel =>
    let term := Z.shiftl 1 bits / ((2 * k + 1) * n ^ (2 * k + 1)) in
    if term =? 0 then Some (total, k + 1)
    else atan_inverse fuel n bits (total + if Z.odd k then - term else term) (k + 1)
  end.

Definition pi (fuel : nat) (bits : Z) : option enclosure :=
  let atan n := atan_inverse fuel n (bits + 16) 0 0 in
  match atan 18, atan 57, atan 239 with
  | Some (u, d), Some (v, e), Some (w, f) =>
    let total := 48 * u + 32 * v + -20 * w in
    let lost := 48 * d + 32 * e + 20 * f in
    Some (Enclosure (Z.shiftr (total - lost) 16) (- Z.shiftr (- total - lost) 16))
  | _, _, _ => None
  end.

(* The loop of _sincos: sums of sin and of cos, the last term, its number *)
Fixpoint series (fuel : nat) (r work sin cos term n : Z) : option (Z * Z * Z) :=
  match fuel with
  | O => None
  | S fuel =>
    if (term =? 0) || (term =? -1) then Some (sin, cos, n) else
    let n := n + 1 in
    let term := Z.shiftr (term * r) work / n in
    let signed := if Z.testbit n 1 then - term else term in
    if Z.odd n then series fuel r work (sin + signed) cos term n
    else series fuel r work sin (cos + signed) term n
  end.

(* v / 2^(bits + guard) up to error, within [-1, 1] *)
Definition clipped (bits guard v error : Z) : enclosure :=
  Enclosure (Z.max (Z.shiftr (v - error) guard) (- Z.shiftl 1 bits))
            (Z.min (- Z.shiftr (- v - error) guard) (Z.shiftl 1 bits)).

Definition bit_length (x : Z) : Z := if x =? 0 then 0 else Z.log2 (Z.abs x) + 1.
Definition guard_bits (x bits : Z) : Z := 12 + Z.max 0 (bit_length x - bits).

(* _sincos(x, bits): sin, cos, first, last *)
Definition sincos_at (fuel : nat) (x bits : Z) : option (enclosure * enclosure * Z * Z) :=
  let guard := guard_bits x bits in
  let work := bits + guard in
  match pi fuel work with
  | None => None
  | Some (Enclosure p q) =>
    let x := Z.shiftl x guard in
    let k := (4 * x + p) / (2 * p) in
    let r := Z.shiftr (Z.min (2 * x - k * p) (2 * x - k * q)) 1 in
    let r_hi := up (Z.max (2 * x - k * p) (2 * x - k * q)) 1 in
    match series fuel r work 0 (Z.shiftl 1 work) (Z.shiftl 1 work) 0 with
    | None => None
    | Some (s, c, n) =>
      let error := 3 * n + 2 + (r_hi - r) in
      let sin := clipped bits guard s error in
      let cos := clipped bits guard c error in
      let turned := match k mod 4 with
        | 0 => (sin, cos) | 1 => (cos, neg sin) | 2 => (neg sin, neg cos) | _ => (neg cos, sin)
        end in
      Some (turned, k - (if r <=? 0 then 1 else 0), k - (if r_hi <? 0 then 1 else 0))
    end
  end.

(* An extremum at turn quarters of the circle is put in. *)
Definition extremum (bits : Z) (values : enclosure * enclosure) (turn : Z) : enclosure * enclosure :=
  let (sin, cos) := values in
  let one := Z.shiftl 1 bits in
  match turn mod 4 with
  | 0 => (sin, Enclosure (lo cos) one)
  | 1 => (Enclosure (lo sin) one, cos)
  | 2 => (sin, Enclosure (- one) (hi cos))
  | _ => (Enclosure (- one) (hi sin), cos)
  end.

Definition turns (first last : Z) : list Z :=  (* range(first + 1, min(last, first + 4) + 1) *)
  map (fun i => first + 1 + Z.of_nat i) (seq 0 (Z.to_nat (Z.min last (first + 4) - first))).

Definition sincos (fuel : nat) (bits : Z) (X : enclosure) : option (enclosure * enclosure) :=
  match sincos_at fuel (lo X) bits with
  | None => None
  | Some (sin, cos, first, _) =>
    if lo X =? hi X then Some (sin, cos) else
    match sincos_at fuel (hi X) bits with
    | None => None
    | Some (sin_hi, cos_hi, _, last) =>
      Some (fold_left (extremum bits) (turns first last) (hull sin sin_hi, hull cos cos_hi))
    end
  end.
