"""MANIFEST.json and ledger.json against the certificates that they speak of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

from proofs.trusted.certificate import Reader, parse
from proofs.trusted.files import digest, parameters_to_json, read
from proofs.trusted.kernel.meter import metered
from proofs.trusted.numbers import show
from proofs.trusted.paper import BEYOND, GROUPS, find
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check


class Listed(NamedTuple):
    """A claim as it is listed."""

    id: str
    verdict: Verdict
    is_paper: bool  # whether at the paper's own parameters
    is_own: bool  # whether the claim is the project's, not the paper's


_FILES = 2  # how much all files may take together, where each may take 1
_FINDING = ("horseshoe", "sets", "dimension")  # commands that find sets
BESIDE = MappingProxyType({"horseshoe": ("N1", "N2"), "explore": BEYOND["rebounding"]})
"""Claims in files of these names beside those of the group that the name is."""


def command(file: str, of: Parameters, claims: Sequence[str] = ()) -> str:
    """Return the command that makes a certificate of this name, about these numbers and claims.

    What is usual is left out: the paper's numbers; but sets at another oscillator, where they would
    be found, and epsilon where impacts would be plastic.
    """
    group = file.removesuffix(".json")
    parts = [f"python -m proofs {group}"]
    options = ("eta", "nu", "left", "right", "interval", "slopes", "epsilon", "velocities", "reach")
    unusual = {"epsilon"} if group in BEYOND else set()
    if group in _FINDING and of.place != PAPER.place:
        unusual = {"left", "right"}
    for name in options:
        value = getattr(of, name)
        usual = (of.left[0], of.right[1]) if name == "interval" else getattr(PAPER, name)
        usual = None if name in unusual else usual
        if value is not None and value != usual:
            numbers = value if isinstance(value, tuple) else (value,)
            parts += [f"--{name}", *map(show, numbers)]
    return " ".join([*parts, *(["--only", *claims] if claims else [])])


def checking(file: str) -> str:
    """Return the command that checks a certificate, in its folder, wherever that is."""
    return f"python -I -m proofs.check {file}"


def check_manifest(source: str, folder: Path, work: int) -> list[Listed]:
    """Check every file that a manifest lists, and its entry; return the claims listed.

    An entry has the file's digest and parameters, the commands that make and check it, and what it
    proves: of each claim verdict and statement. Raises Malformed or Rejected where they differ.
    """
    listed: list[Listed] = []
    with metered(_FILES * work):
        _, files = parse(source).fields("schema", "files")
        for name, entry in files.entries():
            listed += _check_entry(folder, name, entry, work)
    return _some(listed, files)


def _check_entry(folder: Path, name: str, entry: Reader, work: int) -> Iterator[Listed]:
    digest_of, parameters, made, checked, claims = entry.fields(
        "digest", "parameters", "made", "checked", "claims"
    )
    text = _beside(folder, name, entry)
    group, report = name.removesuffix(".json"), check(text, work)
    of = report.parameters
    if not isinstance(of, Parameters):
        raise Rejected(f"{entry.path}: a file about formulas or a box decides no claim")
    _same(digest_of, digest(text))
    _same(parameters, parameters_to_json(of))
    _same(checked, checking(name))
    proved: dict[str, Any] = {}
    ids = [claim.id for claim in report.claims]
    if not {*ids} <= {*GROUPS.get(group, BEYOND.get(group, ())), *BESIDE.get(group, ())}:
        raise Rejected(f"{entry.path}: no command makes a file of this name and these claims")
    if made.string() not in (command(name, of), command(name, of, ids)):
        raise Rejected(f"{made.path}: the command is {command(name, of, ids)!r}")
    for claim in report.claims:
        proved[claim.id] = {"verdict": claim.verdict.value, "statement": claim.statement}
        yield Listed(claim.id, claim.verdict, of == PAPER, _is_own(claim.id))
    _same(claims, proved)


def check_ledger(source: str, folder: Path, work: int) -> list[Listed]:
    """Check that each entry of a ledger is one of the certificate that it names.

    Its member `coq`, names of theorems that Coq proves, is Coq's to check.
    Raises Malformed or Rejected where that is not so.
    """
    proved: dict[str, dict[str, Any]] = {}
    listed = []
    with metered(_FILES * work):
        _, claims_of = parse(source).fields("schema", "claims")
        for entry in claims_of.items():
            members = dict(entry.entries())
            if not {"id", "file"} <= set(members):
                raise entry.fail("an id and a file are expected")
            name = members["file"].string()
            if name not in proved:
                text = _beside(folder, name, members["file"])
                if check(text, work).parameters != PAPER:
                    raise Rejected(f"{entry.path}: the file is not about the paper's parameters")
                proved[name] = {x["id"]: x for x in parse(text).value["claims"]}
            own = dict(proved[name].get(members["id"].string(), {}))
            own.pop("proof", None)
            in_coq = [each.string() for each in members["coq"].items()] if "coq" in members else []
            _same(entry, {**own, "file": name, "coq": in_coq})
            own_id = own["id"]
            listed.append(Listed(own_id, Verdict(own["verdict"]), True, _is_own(own_id)))
    return _some(listed, claims_of)


def _is_own(claim: str) -> bool:
    row = find(claim)
    return row is not None and row.own


def _beside(folder: Path, name: str, reader: Reader) -> str:
    """Return the text of a file in the same folder."""
    if name not in {f"{group}.json" for group in (*GROUPS, *BEYOND)}:
        raise Rejected(f"{reader.path}: no command makes a file of this name in the same folder")
    try:
        return read(folder / name)
    except OSError as error:
        raise Rejected(f"{reader.path}: cannot be read: {error.strerror or error}") from None


def _same(given: Reader, own: Any) -> None:
    if given.value != own:
        raise Rejected(f"{given.path}: the file proves {str(own)[:100]!r}")


def _some(listed: list[Listed], reader: Reader) -> list[Listed]:
    if not listed:
        raise reader.fail("no claims")
    return listed
