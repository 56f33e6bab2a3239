"""What can go wrong, named: each error is a hypothesis that did not hold."""


class IntervalError(ArithmeticError):
    """The root of every error that this package raises on purpose."""


class DomainError(IntervalError):
    """An argument leaves the natural domain of the function: division by 0, log of -1."""


class Undecided(IntervalError):
    """A comparison or a proof step that the enclosures at hand do not decide."""


HINT = (
    "it stands for many numbers at once; use minimum, maximum, abs or sign, or split the box "
    "where the function changes"
)
"""What to do instead of a branch in a function."""
