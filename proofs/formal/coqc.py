"""Run coqc on the theory and on a case, and read what it prints."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

THEORY = Path(__file__).parent / "theory"
NAME = "Oscillator"  # the logical name of the folder, in Coq
OPTIONS = ["-R", ".", NAME, "-w", "-ambiguous-paths"]
GET = "coqc is missing: apt-get install coq libcoq-interval libcoq-coquelicot"

REALS = frozenset(  # the axioms of the standard library's real numbers
    {
        "ClassicalDedekindReals.sig_forall_dec",
        "ClassicalDedekindReals.sig_not_dec",
        "Classical_Prop.classic",
        "FunctionalExtensionality.functional_extensionality_dep",
    }
)
_MACHINE = {
    "PrimInt63": """
        int add addc addcarryc addmuldiv compare div diveucl diveucl_21 eqb head0 land leb lor lsl
        lsr ltb lxor mod mul mulc sub subc subcarryc tail0""",
    "Uint63": """
        add_spec addc_def_spec addcarryc_def_spec addmuldiv_def_spec compare_def_spec div_spec
        diveucl_21_spec diveucl_def_spec eqb_correct eqb_refl head0_spec land_spec leb_spec lor_spec
        lsl_spec lsr_spec ltb_spec lxor_spec mod_spec mul_spec mulc_spec of_to_Z sub_spec
        subc_def_spec subcarryc_def_spec tail0_spec""",
    "PrimFloat": """
        float abs add classify compare div eqb frshiftexp ldshiftexp ltb mul next_down next_up
        normfr_mantissa of_uint63 opp sqrt sub""",
    "FloatAxioms": """
        Prim2SF_SF2Prim Prim2SF_valid SF2Prim_Prim2SF abs_spec add_spec classify_spec compare_spec
        div_spec eqb_spec frshiftexp_spec ldshiftexp_spec ltb_spec mul_spec next_down_spec
        next_up_spec normfr_mantissa_spec of_uint63_spec opp_spec sqrt_spec sub_spec""",
}
MACHINE = REALS | {  # and the specifications of machine integers and floats
    f"{module}.{name}" for module, names in _MACHINE.items() for name in names.split()
}


class Missing(RuntimeError):
    """Coq, or a library of it, is not there."""


class Refused(RuntimeError):
    """coqc does not accept a file: where it stops, and what it says."""

    def __init__(self, module: str, lemma: str, message: str) -> None:
        super().__init__(f"{module}.v: {lemma}: {message}")
        self.lemma = lemma


@dataclass(frozen=True)
class Accepted:
    """A file that coqc accepts: its output, the seconds and the kilobytes that it takes."""

    output: str
    seconds: float
    memory: int


def required(text: str) -> list[str]:
    """Return the modules of the theory that a file requires."""
    lists = re.findall(rf"^From {NAME} Require Import ([\w\s]+)\.", text, re.MULTILINE)
    return [name for names in lists for name in names.split()]


def order(text: str) -> list[str]:
    """Return the modules that a file needs, each after what it requires."""
    ordered: list[str] = []
    for name in required(text):
        before = order((THEORY / f"{name}.v").read_text())
        ordered += [each for each in [*before, name] if each not in ordered]
    return ordered


def copy_theory(folder: Path, modules: list[str]) -> None:
    """Copy modules of the theory to the folder where all is compiled."""
    for name in modules:
        shutil.copy(THEORY / f"{name}.v", folder / f"{name}.v")


def run(folder: Path, module: str) -> Accepted:
    """Compile one file of a folder, after those it requires; raise Missing or Refused."""
    if shutil.which("coqc") is None:
        raise Missing(GET)
    began = perf_counter()
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        command = ["coqc", "-time", *OPTIONS, f"{module}.v"]
        process = subprocess.Popen(command, cwd=folder, stdout=output, stderr=errors)
        try:
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        except BaseException:
            process.kill()
            process.wait()
            raise
        output.seek(0)
        errors.seek(0)
        said, wrong = output.read(), errors.read()
    if process.returncode:
        raise _refused((folder / f"{module}.v").read_text(), module, wrong)
    return Accepted(said, perf_counter() - began, usage.ru_maxrss)


def _refused(text: str, module: str, errors: str) -> Missing | Refused:
    """Return what the errors of coqc mean."""
    found = re.search(r'File ".*", line (\d+), characters .*\n((?:.*\n)*)', errors)
    line = int(found[1]) if found else 0
    message = " ".join((found[2] if found else errors).split())[:300]
    if "Cannot find a physical path" in message or "Unable to locate library" in message:
        return Missing(f"{GET} ({message})")
    before = "\n".join(text.splitlines()[:line])
    lemmas = re.findall(r"^(?:Lemma|Theorem) (\w+)", before, re.MULTILINE)
    return Refused(module, lemmas[-1] if lemmas else "the head of the file", message)


def axioms(output: str) -> list[str]:
    """Return what `Print Assumptions` lists: axioms, and definitions that escape a check."""
    _, _, listed = output.partition("\nAxioms:\n")
    words = [line.split()[0] for line in listed.splitlines() if line[:1].strip()]
    return [word for word in words if word != "Chars"]  # that line tells the time taken


def seconds(text: str, output: str, names: list[str]) -> dict[str, float]:
    """Return for each theorem the seconds since the one before, its lemmas counted."""
    taken = [
        (int(start), float(time))
        for start, time in re.findall(
            r"^Chars (\d+) - \d+ .*?\] ([\d.]+) secs", output, re.MULTILINE
        )
    ]
    result, begin = {}, 0
    for name in names:
        end = text.index("Qed.", text.index(f"Theorem {name} ")) + len("Qed.")
        result[name] = sum(time for start, time in taken if begin <= start < end)
        begin = end
    return result


def statements(text: str, names: list[str]) -> Callable[[str], str]:
    """Return what gives a theorem's statement, as it is written."""
    found = {name: text[text.index(f"Theorem {name} ") :] for name in names}
    return lambda name: " ".join(found[name].partition("\nProof.")[0].split())
