"""Systems of equations that others publish as tests of solvers, and how the solver does on them.

Written from their definitions. Sources: More, Garbow, Hillstrom 1981, Testing unconstrained
optimization software (MGH), and extensions; the benchmarks of the COPRIN project (ALIAS) and of
IBEX; Floudas et al. 1999, Handbook of test problems (Floudas); IntervalRootFinding.jl, with Smiley,
Chun 2001 and Ratz 1996; Verschelde's collection of polynomial systems (PHC); Galias 2001.
"""
