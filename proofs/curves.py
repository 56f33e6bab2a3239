"""Curves in the plane of eta and nu: where single-impact orbits fold, flip, or graze the table.

Of orbits with one impact in n table periods, with restitution epsilon: the curves of folds and of
flips in closed form, for all n and epsilon (C1). Curves on which the orbit touches the table on its
way, below |nu| = 1, followed and enclosed in boxes around all of each curve, with points to 15
places (C2). Where these meet folds or flips (C3). For n = 1 and 2, eta < 2. For plastic impacts and
all n: where orbits with a sticking phase end, other than by grazing, in closed form (C4).
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.curves")

from functools import partial

from proofs.shell.runner import run

EXAMPLES = """
  python -m proofs.curves --epsilon 0
  python -m proofs.curves --epsilon 0.3 --figure
"""

main = partial(run, "curves", description=__doc__, examples=EXAMPLES)
