"""What a prover found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

Tell = Callable[[str], None]


@dataclass
class Evidence:
    """What a prover found: its steps in order, and for each claim the steps that it rests on.

    Each of these comes with the conclusion that the prover's own arithmetic reached.
    """

    steps: dict[str, dict[str, Any]] = field(default_factory=dict)
    proofs: dict[str, list[tuple[str, object]]] = field(default_factory=dict)
