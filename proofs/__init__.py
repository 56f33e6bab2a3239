"""Machine-checked verdicts on a paper about an oscillator that bounces on a vibrating table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from proofs.oscillator import Oscillator

__version__ = "0.1.0"
__all__ = ["Oscillator"]


def __dir__() -> list[str]:
    """What `from proofs import` offers; the commands and parts are modules of their own."""
    return sorted({*__all__, "__version__"})


def __getattr__(name: str) -> Any:
    """Load the library when it is asked for: the checker imports this package, too."""
    if name == "Oscillator":
        from proofs.oscillator import Oscillator

        return Oscillator
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
