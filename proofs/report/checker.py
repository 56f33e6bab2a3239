"""The page with a checker in it: CPython as WebAssembly, the trusted folder, the certificates."""

from __future__ import annotations

import base64
import gzip
import io
import json
import re
import shutil
import subprocess
import tempfile
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import proofs
from proofs.trusted.files import read

VERSION = "314.0.7"  # of npm's pyodide
_MODULES = ("pyodide.mjs", "pyodide.asm.mjs")
_FILES = ("pyodide.asm.wasm", "python_stdlib.zip")
_EXPORTS = re.compile(r"export\s*\{.*?\b(\w+) as loadPyodide\b.*?\};?", re.DOTALL)
_WORKER = Path(__file__).parent / "templates" / "worker.js"
_LOCK = "pyodide-lock.json"
_CODE = """\
import json, sys
from proofs.trusted.certificate import Malformed
from proofs.trusted.verify import Rejected, check
def derive(text):
    try:
        return json.dumps({"claims": {x.id: x.verdict.value for x in check(text).claims}})
    except (Malformed, Rejected) as error:
        return json.dumps({"rejected": str(error)})
"""


class NoPyodide(OSError):
    """There is no pyodide where it was looked for."""


@contextmanager
def runtime(folder: Path | None) -> Iterator[Path]:
    """Yield a folder with pyodide's files: the one given, or what npm packs into a new one."""
    if folder is not None:
        for name in (*_MODULES, *_FILES, _LOCK):
            if not (folder / name).is_file():
                raise NoPyodide(f"no {name} in {folder}")
        yield folder
        return
    if shutil.which("npm") is None:
        raise NoPyodide("npm is missing: give pyodide's folder by --pyodide DIR")
    with tempfile.TemporaryDirectory() as scratch:
        command = ["npm", "pack", "--silent", f"pyodide@{VERSION}"]
        packed = subprocess.run(command, cwd=scratch, check=False, capture_output=True, text=True)
        if packed.returncode:
            raise NoPyodide(f"npm gives no pyodide@{VERSION}: {packed.stderr.strip()[-200:]}")
        shutil.unpack_archive(Path(scratch) / packed.stdout.split()[-1], scratch, filter="data")
        yield Path(scratch) / "package"


@dataclass(frozen=True)
class Checker:
    """What the page holds: files by name, compressed; pyodide's lock; what Python runs."""

    parts: Mapping[str, str]
    lock: str
    code: str = _CODE


def checker(pyodide: Path, folder: Path, files: Iterable[str]) -> Checker:
    """Return what derives again all that certificates of a folder prove; no package is loaded."""
    contents = {name: (pyodide / name).read_bytes() for name in _FILES}
    contents["worker.js"] = _worker(pyodide).encode()
    contents["trusted.zip"] = trusted()
    texts = {name.removesuffix(".json"): read(folder / name) for name in files}
    contents["certificates"] = json.dumps(texts).encode()
    lock_file = json.loads((pyodide / _LOCK).read_text(encoding="utf-8"))
    lock = json.dumps({**lock_file, "packages": {}}).replace("<", "\\u003c")
    return Checker({name: _packed(content) for name, content in contents.items()}, lock)


def _worker(pyodide: Path) -> str:
    """Return pyodide's two modules and our own code as one script.

    A page from the disk may start no module as a worker, and nothing in it may import another.
    """
    loader, module = ((pyodide / name).read_text(encoding="utf-8") for name in _MODULES)
    loader, count = _EXPORTS.subn(r"return \1;", loader)
    if count != 1 or module.count("export default ") != 1:
        raise NoPyodide(f"the modules in {pyodide} are not those of pyodide {VERSION}")
    module = module.replace("import.meta.url", "self.location.href")
    return "\n".join(
        [
            "self.importScripts = () => { throw new Error('no scripts'); };",
            module.replace("export default ", "const createPyodideModule = "),
            f"const loadPyodide = (() => {{{loader}\n}})();",
            _WORKER.read_text(encoding="utf-8"),
        ]
    )


def trusted() -> bytes:
    """Return the trusted folder as a ZIP archive, the same bytes each time."""
    root = Path(proofs.__file__).parent
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for path in sorted([root / "__init__.py", *(root / "trusted").rglob("*.py")]):
            name = str(path.relative_to(root.parent))
            archive.writestr(zipfile.ZipInfo(name), path.read_bytes())
    return file.getvalue()


def _packed(content: bytes) -> str:
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode("ascii")
