"""Machine-checked verdicts on a paper about an oscillator that bounces on a vibrating table."""

from __future__ import annotations

from importlib.machinery import PathFinder
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from proofs.oscillator import Oscillator

__version__ = "0.1.0"
__all__ = ["Oscillator"]


def __getattr__(name: str) -> Any:
    """Load the library when it is asked for: the checker imports this package, too."""
    if name == "Oscillator":
        from proofs.oscillator import Oscillator

        return Oscillator
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def _check_neighbour() -> None:
    """Raise ImportError where `intervals` is another distribution's: there is one of that name."""
    found = PathFinder.find_spec("intervals")
    origin = Path(found.origin or "") if found else None
    if origin and not (origin.is_file() and b"IntervalArray" in origin.read_bytes()):
        raise ImportError(
            f"{origin} is not impact-proofs' own package intervals: pip uninstall intervals, "
            "then pip install --force-reinstall impact-proofs",
            name=__name__,
        )


_check_neighbour()
