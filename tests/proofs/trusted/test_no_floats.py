"""No float in the checker: its numbers are integers, rationals and enclosures, on every machine.

Its sources have no float literal, no name `float`, and of `math` what is exact alone; and while it
checks files no quotient and no power of its own is a float.
"""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
FILES = ("horseshoe", "chaos", "systems/henon/periodic-orbits", "systems/van-der-pol/stable")
MORE = ("dimension", "soft", "systems/billiard/orbits-2-1")
EXACT = {"isqrt", "gcd", "lcm", "prod", "comb", "factorial"}
INEXACT = {"math", "cmath", "random", "statistics", "decimal", "time"}

WATCHED = """
import ast, runpy, sys
from importlib.machinery import SourceFileLoader

class Watch(ast.NodeTransformer):
    def visit_BinOp(self, node):
        self.generic_visit(node)
        if not isinstance(node.op, ast.Div | ast.Pow):
            return node
        name = ast.Name("no_float", ast.Load())
        return ast.copy_location(ast.Call(name, [node], []), node)

def no_float(value):
    if isinstance(value, float | complex):
        raise SystemExit("a float in the checker")
    return value

plain = SourceFileLoader.get_code

def get_code(self, name):
    if not name.startswith("proofs.trusted"):
        return plain(self, name)
    path = self.get_filename(name)
    tree = Watch().visit(ast.parse(self.get_data(path)))
    return compile(ast.fix_missing_locations(tree), path, "exec")

import builtins
builtins.no_float = no_float
SourceFileLoader.get_code = get_code
sys.path.insert(0, "")
runpy.run_module("proofs.check", run_name="__main__", alter_sys=True)
"""


def floats(tree):
    """The places in a source at which there may be a float, by lines."""
    for node in ast.walk(tree):
        match node:
            case ast.Constant(value=float() | complex()) | ast.Name(id="float" | "complex"):
                yield node.lineno
            case ast.ImportFrom(module="math", names=names) if {x.name for x in names} - EXACT:
                yield node.lineno
            case ast.Import(names=names) if {x.name.split(".")[0] for x in names} & INEXACT:
                yield node.lineno


def test_the_sources_name_none():
    trusted = sorted((ROOT / "proofs" / "trusted").rglob("*.py"))
    assert len(trusted) > 100
    named = [(path.name, line) for path in trusted for line in floats(ast.parse(path.read_text()))]
    assert named == []


@pytest.mark.parametrize("text", ["0.5", "float(x)", "import math", "from math import sin", "2j"])
def test_it_would_be_seen(text):
    assert list(floats(ast.parse(text))) == [1]


def watched(files, code=WATCHED):
    paths = [f"reports/{name}.json" for name in files]
    return subprocess.run(
        [sys.executable, "-S", "-c", code, "--quiet", *paths],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


@pytest.mark.parametrize("files", [FILES, pytest.param(MORE, marks=pytest.mark.slow)])
def test_none_arises(files):
    done = watched(files)
    assert (done.returncode, done.stderr) == (0, "")


def test_one_that_arises_would_be_seen():
    code = WATCHED.replace("self.get_data(path)", 'self.get_data(path) + b"\\n1 / 3"')
    assert watched(FILES[:1], code).returncode != 0
