"""How much a property test tries: fewer examples in the quick part, which is run often."""

import dataclasses


@dataclasses.dataclass
class Effort:
    """Set once, before tests are collected."""

    quick: bool = False


EFFORT = Effort()


def examples(count):
    """The number of examples where the whole suite has `count`."""
    return max(count // 3, 8) if EFFORT.quick else count
