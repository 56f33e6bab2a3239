"""What takes long is made once in a run, by the worker that asks first; how much is tried."""

import dataclasses
import fcntl
import hashlib
import json
import os
import pickle
from functools import cache, wraps
from pathlib import Path

FOLDER = "TESTS_MADE_ONCE"  # in the environment: a folder of this run


def once(function):
    """Keep what a function returns, for this run; arguments are hashable and have a repr.

    Workers get their own copies, by pickle. Outside of pytest this is `functools.cache`.
    """

    @cache
    @wraps(function)
    def made(*arguments):
        folder = os.environ.get(FOLDER)
        if folder is None:
            return function(*arguments)
        key = f"{function.__module__} {function.__qualname__} {arguments!r}"
        path = Path(folder) / hashlib.sha256(key.encode()).hexdigest()
        with path.open("ab+") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            if not file.tell():
                file.write(pickle.dumps(function(*arguments)))
            file.seek(0)
            return pickle.load(file)

    return made


REPORTS = Path(__file__).parents[1] / "reports"


def committed():
    """The texts of committed certificates by name: reports, systems, cells of atlases."""
    found = [*REPORTS.glob("*.json"), *REPORTS.glob("systems/*/*.json")]
    texts = {str(path.relative_to(REPORTS)): path.read_text("utf-8") for path in sorted(found)}
    for path in sorted(REPORTS.glob("atlas/*/sample.jsonl")):
        for line in map(json.loads, path.read_text("utf-8").splitlines()[1:]):
            if line["certificate"]:
                name = f"atlas/{path.parent.name}/cell-{line['cell'].replace('/', '-')}.json"
                texts[name] = json.dumps(line["certificate"])
    return {name: text for name, text in texts.items() if '"steps"' in text}


@once
def report(name):
    """What the checker makes of a committed certificate."""
    from proofs.trusted.verify import check

    return check((REPORTS / f"{name}.json").read_text(encoding="utf-8"))


# -- how much a property test tries ----------------------------------------------------------------


@dataclasses.dataclass
class Effort:
    """Set once, before tests are collected."""

    quick: bool = False


EFFORT = Effort()


def examples(count, at_length=None):
    """How many to try: `at_length` in the whole suite, where it is given; else `count`."""
    return max(count // 5, 5) if EFFORT.quick else at_length or count
