"""Files of results: whole or not at all, one writer at a time in a folder.

Files are written beside their places, under the names `.<file>.<process>.part`, and renamed when
all are written; what a process left that was killed is cleared by the next that writes there. The
folder itself is locked meanwhile (flock), so that nobody else writes between what one run reads
there and writes there.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from proofs.shell.cli import Parser

Put = Callable[[str, str | bytes | Iterator[str]], None]
"""Takes a name in the folder, and what the file is to hold, or an iterator over its lines."""


@contextmanager
def writing(folder: Path) -> Iterator[Put]:
    """Yield what writes files to the folder, all or none, nobody else writing there meanwhile.

    Raises OSError where that fails, or would replace what is no regular file, such as a device.
    """
    folder.mkdir(parents=True, exist_ok=True)
    parts: dict[Path, Path] = {}

    def put(name: str, content: str | bytes | Iterator[str]) -> None:
        _check_place(folder / name)
        parts[folder / name] = part = folder / f".{name}.{os.getpid()}.part"
        with part.open("wb") as file:
            for each in [content] if isinstance(content, str | bytes) else content:
                file.write(each.encode() if isinstance(each, str) else each)
            file.flush()
            os.fsync(file.fileno())

    with _locked(folder):
        for left in folder.glob(".*.[0-9]*.part"):
            left.unlink(missing_ok=True)
        try:
            yield put
            for path, part in parts.items():
                part.replace(path)
        finally:
            for part in parts.values():
                part.unlink(missing_ok=True)


def write_files(folder: Path, files: Mapping[str, str]) -> None:
    """Write files by their names, which may be in folders inside the folder."""
    for inner in sorted({Path(name).parent for name in files}):
        with writing(folder / inner) as put:
            for name, content in files.items():
                if Path(name).parent == inner:
                    put(Path(name).name, content)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Wait until nobody else holds the folder, and hold it.

    Where the system has no such locks, nothing is held: two runs may lose each other's entries.
    """
    try:
        import fcntl
    except ImportError:
        yield
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


def _check_place(path: Path) -> None:
    """Raise OSError where a file would replace what is none: a rename takes a device's place."""
    if path.exists() and not path.is_file():
        raise OSError(f"{path.name} is not a regular file")


@contextmanager
def refusing(parser: Parser, target: str | Path) -> Iterator[None]:
    """Leave with one line where the work inside cannot write the target."""
    try:
        yield
    except OSError as error:
        parser.error(f"cannot write {str(target)!r}: {error.strerror or error}")


def check_folder(parser: Parser, folder: Path) -> None:
    """Leave with one line if nothing can be written to the folder, before any work is done."""
    with refusing(parser, folder), writing(folder):
        trial = folder / f".trial.{os.getpid()}.part"
        try:
            trial.touch()
        finally:  # an interrupt leaves nothing behind
            trial.unlink(missing_ok=True)


def check_targets(parser: Parser, *targets: str | None) -> None:
    """Leave with one line if files cannot be written or two are one, before any work is done.

    targets: names, "-" for the screen, None for no file.
    """
    wanted = [target for target in targets if target is not None]
    if len({_path(target) for target in wanted}) < len(wanted):
        parser.error(f"two outputs to {wanted[0]} exclude each other")
    for target in wanted:
        if target != "-":
            with refusing(parser, target):
                _check_place(_path(target))
            check_folder(parser, _path(target).parent)


def write_target(parser: Parser, target: str | None, content: Callable[[], str]) -> None:
    """Write what `content` returns to the file or the screen; leave with one line on failure."""
    if target == "-":
        print(content(), end="")
    elif target is not None:
        path = _path(target)
        with refusing(parser, target), writing(path.parent) as put:
            put(path.name, content())


def _path(target: str) -> Path:
    """Return the file itself: what a link leads to is replaced, not the link."""
    return Path(os.path.realpath(target))
