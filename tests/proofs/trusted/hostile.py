"""Files made to eat the checker's time or memory, and how much of both each takes.

From the root, `python -m tests.proofs.trusted.hostile 1000` makes so many, has the command check
each in a process of its own, and prints the worst of each kind.
"""

import json
import os
import random
import subprocess
import sys
import tempfile
from contextlib import suppress
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import NamedTuple

from proofs.trusted.atlas import Region
from proofs.trusted.certificate import LEDGER, MANIFEST, MAX_BYTES
from proofs.trusted.paper import GROUPS
from tests.once import committed
from tests.proofs.trusted.edits import at, put, walk
from tests.proofs.trusted.kernel.hostile import HOSTILE, source_of
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

ROOT = Path(__file__).parents[3]
ROOM = MAX_BYTES - 100_000
MOST = 9_900  # entries of a list


# -- what is made ----------------------------------------------------------------------------------


@cache
def sources():
    """Texts of certificates that are accepted, by name."""
    return committed() | {f"lemma {name}": text(name) for name in EXAMPLES}


def compact(document):
    return json.dumps(document, separators=(",", ":"))


def picked(rng):
    """A certificate, and one of its steps: every rule as often as another."""
    steps = {}
    for name, held in sources().items():
        for step, made in json.loads(held)["steps"].items():
            steps.setdefault(made["rule"], []).append((name, step))
    rule = rng.choice(sorted(steps))
    name, step = rng.choice(steps[rule])
    return rule, json.loads(sources()[name]), step


def is_number(value):
    return isinstance(value, str) and value.lstrip("-").replace("/", "", 1).isdigit()


def places(document, step, accept):
    """The paths of all values in a witness that are as asked for."""
    base = ("steps", step, "witness")
    return [path for path, value in walk(at(document, base), base) if accept(value)]


def named_everywhere(document, names):
    """Have all claims rest on these steps."""
    if document["parameters"] is None or "left" not in document["parameters"]:
        document["claims"] = names
    else:
        room = 1 + ROOM // 3 // sum(map(len, names)) if names else 1
        for claim in document["claims"][:room]:
            claim["proof"] = names
        document["claims"] = document["claims"][:room]


def copies(rng):
    """One step thousands of times, each named by all claims."""
    rule, document, step = picked(rng)
    size = len(compact(document["steps"][step])) + 20
    count = max(1, min(MOST, (ROOM // 2 - len(compact(document))) // size))
    names = [f"c{k:x}" for k in range(count)]
    document["steps"] |= dict.fromkeys(names, document["steps"][step])
    named_everywhere(document, names)
    return f"copies of {rule}", compact(document)


def repeated(rng):
    """The lists of a witness as long as may be, by repeating what is there."""
    rule, document, step = picked(rng)
    lists = places(document, step, lambda value: isinstance(value, list) and value)
    for path in rng.sample(lists, min(len(lists), rng.choice((1, 1, 3)))):
        held = at(document, path)
        room = (ROOM - len(compact(document))) // (len(compact(held)) + 1)
        put(path, held * max(1, min(MOST // len(held), room)))(document)
    return f"long lists in {rule}", compact(document)


def finer(rng):
    """A list of increasing numbers cut as often as may be."""
    rule, document, step = picked(rng)

    def increases(value):
        numbers = isinstance(value, list) and len(value) > 1 and all(map(is_number, value))
        return numbers and [*map(Fraction, value)] == sorted(map(Fraction, value))

    lists = places(document, step, increases)
    for path in lists[:1] if lists else ():
        low, high = Fraction(at(document, path)[0]), Fraction(at(document, path)[-1])
        count = rng.choice((100, 1000, MOST))
        put(path, [str(low + (high - low) * k / count) for k in range(count + 1)])(document)
    return f"fine lists in {rule}", compact(document)


def digits(rng):
    """The numbers of a witness with thousands of digits, or whole numbers that are huge."""
    rule, document, step = picked(rng)
    numbers = places(document, step, is_number)
    count = rng.choice((1, 1, 10, 1000))
    places_of, huge = rng.choice((50, 500, 1450)), rng.choice((False, True))
    for path in rng.sample(numbers, min(count, len(numbers))):
        value = Fraction(at(document, path))
        if huge and value.denominator == 1:
            value = Fraction(rng.choice((50, 1000, 10**5, 10**9, 10**places_of)))
        else:
            value += Fraction(1, 10**places_of + 1)
        put(path, str(value))(document)
    return f"digits in {rule}", compact(document)


def swollen(rng):
    """The formulas of a certificate nested, or as high powers."""
    _, document, _ = picked(rng)
    formulas = []
    while not formulas:
        rule, document, step = picked(rng)
        if rule.startswith("formula") or document["functions"]:
            here = ("functions",) if document["functions"] else ("steps", step, "witness")
            held = walk(at(document, here), here)
            formulas = [p for p, v in held if isinstance(v, str) and not is_number(v) and v]
    path = rng.choice(formulas)
    inner = at(document, path)
    swell = rng.choice(
        (
            lambda: "(" * 4000 + inner + ")" * 4000,
            lambda: "+".join([f"({inner})"] * min(20_000, ROOM // (len(inner) + 3))),
            lambda: "*".join([f"(1+{inner})"] * 60),
            lambda: f"(({inner})+1)**{rng.choice((9, 99, 999999))}",
            lambda: "sin(" * 300 + inner + ")" * 300,
            lambda: f"((({inner})+x+y+1)**9)**9",
            lambda: f"{inner}+1/{'7' * 2900}",
        )
    )
    put(path, swell())(document)
    return f"formulas in {rule}", compact(document)


SHAPES = {
    "deep lists": lambda: "[" * 1_000_000,
    "deep objects": lambda: '{"a":' * 500_000,
    "a wide list": lambda: "[" + ",".join(f'"{k}"' for k in range(450_000)) + "]",
    "numbers": lambda: "[" + "1," * 1_990_000 + "1]",
    "numbers that differ": lambda: "[" + ",".join(map(str, range(10**6, 10**6 + 490_000))) + "]",
    "empty lists": lambda: "[" + "[]," * 1_300_000 + "[]]",
    "empty objects": lambda: "[" + "{}," * 1_300_000 + "{}]",
    "small objects": lambda: "[" + '{"":""},' * 440_000 + "{}]",
    "small lists": lambda: "[" + '[""],' * 790_000 + "[]]",
    "a wide object": lambda: "{" + ",".join(f'"{k}":""' for k in range(330_000)) + "}",
    "a field twice, often": lambda: "{" + '"a":"",' * 560_000 + '"a":""}',
    "too long": lambda: " " * (MAX_BYTES + 1),
    "one long text": lambda: json.dumps({"schema": "x" * ROOM}),
    "escapes": lambda: '{"schema": "' + "\\u0041" * (ROOM // 6) + '"}',
    "an escape in a name": lambda: '{"\\u001b[2J": "", "schema": 1}',
    "no text": lambda: "\ud800",
    "nothing": lambda: "",
}


def shapes(rng):
    """What is no certificate, by its size or depth, at the root or inside."""
    name = rng.choice(sorted(SHAPES))
    held = SHAPES[name]()
    if rng.random() < 0.5 and len(held) < MAX_BYTES - 1000:
        keys = ("parameters", "functions", "steps", "claims")
        inner = dict.fromkeys(keys, '""') | {rng.choice(keys): held}
        told = ",".join(f'"{key}":{value}' for key, value in inner.items())
        held = '{"schema":"impact-proofs.certificate/3",' + told + "}"
    return f"shape: {name}", held


def busy(rng):
    """Formulas, trees and maps in which work could hide."""
    name = rng.choice(sorted(HOSTILE))
    return f"busy: {name}", source_of(name)


FILES = copies, repeated, finer, digits, swollen, shapes, busy


def atlases(rng):
    """Atlases: cells without end, long lines, certificates as above."""
    region = Region(
        (Fraction(1, 5), Fraction(3, 10)), (Fraction(1, 10), Fraction(1, 5)), "horseshoe"
    )
    head, line = json.loads(region.text), {"verdict": "UNDECIDED", "kind": "", "says": ""}

    def cell(key, **more):
        eta, nu = ([str(end) for end in side] for side in region.sides(key))
        return compact({"cell": key, "eta": eta, "nu": nu, **line, "certificate": None, **more})

    name, lines = rng.choice(
        (
            ("many cells", lambda: [cell(f"0/{k:010}".translate(_DIGITS)) for k in range(90_000)]),
            ("a cell again", lambda: [cell("0/0")] * 100_000),
            ("long reasons", lambda: [cell("0/0", says="x" * ROOM)] * 9),
            ("long keys", lambda: [cell("0/0", cell="0/" + "0" * ROOM)] * 9),
            ("a wide line", lambda: ["[" + "[]," * 1_300_000 + "[]]"] * 9),
            ("certificates", lambda: [cell("0/0", certificate=inside(rng))] * 9),
            ("no cells", lambda: ["\n"] * 1_000_000),
        )
    )
    if rng.random() < 0.2:
        head["eta"][1] = f"{3 * 10**2900 + 1}/{10**2901}"
    return f"atlas: {name}", "\n".join([compact(head), *lines()])


_DIGITS = str.maketrans("456789", "012301")


def inside(rng):
    return json.loads(rng.choice((copies, repeated, finer, digits))(rng)[1])


def folders(rng, folder):
    """Manifests and ledgers, beside certificates as above, pipes, devices, links that go round."""
    schema = rng.choice((MANIFEST, LEDGER))
    names = [f"{name}.json" for name in GROUPS]
    entry = {"digest": "", "parameters": "", "made": "", "checked": "", "claims": ""}
    beside = rng.choice(("fifo", "link", "folder", "device", "certificates", "names", "itself"))
    for name in names:
        path = folder / name
        if beside == "fifo":
            os.mkfifo(path)
        elif beside == "link":
            path.symlink_to(name)
        elif beside == "folder":
            path.mkdir()
        elif beside == "device":
            path.symlink_to("/dev/zero")
        elif beside == "certificates":
            path.write_text(rng.choice((copies, repeated, digits))(rng)[1])
    if beside == "names":
        names = [f"{k:080}.json" for k in range(20_000)]
    if beside == "itself":
        names = ["MANIFEST.json", "ledger.json", "../x.json", "/dev/zero", "x\0.json"]
    if schema == MANIFEST:
        held = {"schema": schema, "files": dict.fromkeys(names, entry)}
    else:
        claims = [{"id": "H1", "file": name} for name in names]
        held = {"schema": schema, "claims": claims[:MOST]}
    return f"{schema.split('.')[1]}: {beside}", compact(held)


# -- how it is checked -----------------------------------------------------------------------------


class Taken(NamedTuple):
    """What a check took: CPU seconds, megabytes at the most; its status and what it said."""

    seconds: float
    megabytes: float
    status: int
    said: str
    kind: str


def made(seed, folder):
    """Write the hostile file of a number; return its kind and its place."""
    rng = random.Random(seed)
    maker = rng.choice((*FILES, *FILES, atlases, folders))
    kind, held = maker(rng, folder) if maker is folders else maker(rng)
    path = folder / "hostile.json"
    path.write_text(held, encoding="utf-8", errors="surrogatepass")
    return kind, path


ALONE = """
import sys, time
from proofs.check import main
status = main(sys.argv[1:])
held = open("/proc/self/status").read().partition("VmHWM:")[2].split()[0]
print(held, time.process_time())
sys.exit(status)
"""


def checked(kind, *files, options=()):
    """Have the command check files in a process of its own."""
    command = [sys.executable, "-S", "-O", "-c", ALONE, *map(str, files), *options]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, check=False)
    kilobytes, seconds = done.stdout.split()[-2:] if done.returncode in (0, 1, 2) else (0, 0)
    said = done.stderr.decode(errors="replace")
    return Taken(float(seconds), int(kilobytes) / 1024, done.returncode, said, kind)


def is_fair(taken):
    """Whether a check ended as it must: a status, and a line if there is anything wrong."""
    lines = taken.said.count("\n")
    return taken.status in (0, 1, 2) and lines <= 1 and "Traceback" not in taken.said


def main(count, first=0):
    """Print the worst of each kind, and of all."""
    all_taken = []
    with suppress(KeyboardInterrupt):
        for seed in range(first, first + count):
            with tempfile.TemporaryDirectory() as folder:
                taken = checked(*made(seed, Path(folder)))
            all_taken.append((taken, seed))
            if not is_fair(taken) or taken.seconds > 10 or taken.megabytes > 200:
                print(seed, taken._replace(said=taken.said[-200:]), flush=True)
    for what in (0, 1):
        print(f"worst by {Taken._fields[what]}, of {len(all_taken)}:")
        for taken, seed in sorted(all_taken, key=lambda x: -x[0][what])[:12]:
            print(f"  {taken.seconds:6.2f} s {taken.megabytes:6.0f} MB {seed:5} {taken.kind}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
