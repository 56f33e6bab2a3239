"""Theorems about impacting systems and maps, each with a certificate that others can check."""

from __future__ import annotations

from importlib.machinery import PathFinder
from pathlib import Path
from typing import TYPE_CHECKING, Any

from proofs.version import VERSION

if TYPE_CHECKING:
    from proofs.map import Map
    from proofs.oscillator import Oscillator
    from proofs.system import System
    from proofs.theorem import Theorem

__version__ = VERSION
__all__ = ["Map", "Oscillator", "System", "Theorem"]


def __dir__() -> list[str]:
    """What `from proofs import` offers; the commands and parts are modules of their own."""
    return sorted({*__all__, "__version__"})


def __getattr__(name: str) -> Any:
    """Load the library when it is asked for: the checker imports this package, too."""
    if name in __all__:
        from importlib import import_module

        return getattr(import_module(f"proofs.{name.lower()}"), name)
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
