"""How much a property test tries: fewer examples in the quick part, which is run often."""

import dataclasses


@dataclasses.dataclass
class Effort:
    """Set once, before tests are collected."""

    quick: bool = False


EFFORT = Effort()


def examples(count, at_length=None):
    """How many to try: `at_length` in the whole suite, where it is given; else `count`."""
    return max(count // 5, 5) if EFFORT.quick else at_length or count
