"""The Coq text of covering graphs of the impact map, that `flights` fills in."""

GRAPH = """
Definition cells{i} : list (R * R) := [{cells}].
Definition arrows{i} : list (nat * nat) := [{arrows}]%nat.
Definition numerators{i} := [{numerators}]%Z.
Definition flights{i} : list laps := [
{flights}].
Lemma checked{i} : check_flights {bits} {unit} ({side}) {eta} ({nu}) (Some ({m}, {n})%positive)
  numerators{i} arrows{i} flights{i} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
Lemma parameters{i} : IZR ({side}) = side /\\ ratio {unit} {eta} = eta /\\ ratio {unit} ({nu}) = nu.
Proof. unfold ratio, side, eta, nu. repeat split; field. Qed.
Lemma cells{i}_are : cells {unit} numerators{i} = cells{i}.
Proof.
  unfold cells, numerators{i}, cells{i}, ratio. cbn [map fst snd].
  repeat (apply (f_equal2 cons); [apply (f_equal2 pair); field |]). reflexivity.
Qed.
(* {says} *)
Theorem {name} : (forall a x, In a arrows{i} -> interval cells{i} (fst a) x -> next x (f x)) /\\
  conjugate f cells{i} arrows{i} ({m} / {n}).
Proof.
  destruct parameters{i} as (<- & <- & <-). rewrite <- cells{i}_are. split.
  - intros [a b]. apply (flights_land {bits} {unit} ({side}) {eta} ({nu}) ltac:(lia) _ _ _ _ checked{i}).
  - apply (flights_conjugate {bits} {unit} ({side}) {eta} ({nu}) {m} {n} _ _ _ ltac:(lia) eq_refl checked{i}).
Qed.
"""
ENTROPY = """
(* {says} *)
Theorem {name} : entropy_at_least on_line f (interval cells{i}) arrows{i} 1 {growth}.
Proof.
  destruct parameters{i} as (<- & <- & <-). rewrite <- cells{i}_are.
  apply (flights_growth {bits} {unit} ({side}) {eta} ({nu}) ltac:(lia) _ _ _ _ checked{i} {ones} 1 {growth}). reflexivity.
Qed.
"""
