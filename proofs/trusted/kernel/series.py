"""Taylor series of the solutions of x' = f(x), for all that begin in a box, by the operations of f.

A coefficient is a ball: the reals within r units of m units of 2^-bits. Coefficients are times h^k,
h the step, so that a series is one in s = t / h, and no power of h is needed. A sum of products is
exact but for one rounding.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import lcm
from operator import mul
from typing import NamedTuple

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import size
from proofs.trusted.kernel.expression import Tape
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.normalform import MOST_DIGITS
from proofs.trusted.kernel.operations import Enclosures

Ball = tuple[int, int]
Form = dict[int, Fraction]  # a linear combination of nodes, by their places

_LARGEST = 256  # a coefficient beyond 2^256 is not followed
_LONGEST = 12  # terms of a combination that is not yet a node
_GIVEN = ("number", "variable")
_COSTS = {"combination": 1, "rate": 1, "*": 2, "square": 2}  # of a coefficient; 3 for the others
_ONE, _ZERO = 0, Fraction(0)  # the node of the number 1


class Node(NamedTuple):
    """An operation on earlier nodes; of a combination `factors` over `divisor` are the factors."""

    op: str
    arguments: tuple[int, ...] = ()
    factors: tuple[int, ...] = ()
    divisor: int = 1


class Program:
    """The rates of some variables as formulas of all of them, ready for series.

    rates: from the number of a variable to the place of its rate on the tape; the other variables
    are constant. parts: places that have to be defined as well. Sums and multiples are put
    together, so that a node is a product, a function, or a combination that one of these needs.
    """

    def __init__(
        self, tape: Tape, rates: Mapping[int, int], parts: Iterable[int], variables: int
    ) -> None:
        self.nodes = [Node("number"), *(Node("variable") for _ in range(variables))]
        self._forms: dict[int, Form] = {}
        self._combinations: dict[tuple[tuple[int, Fraction], ...], int] = {}
        for place in tape.order((*rates.values(), *parts)):
            op, arguments, datum = tape.nodes[place]
            form = self._form(op, [self._forms[i] for i in arguments], datum)
            METER.get().spend(10 + 2 * len(form))  # and for the room that it takes
            self._forms[place] = {self._node(form): Fraction(1)} if len(form) > _LONGEST else form
        self.rates = {1 + x: _combination(self._forms[root]) for x, root in rates.items()}
        long = [n for node in (*self.nodes, *self.rates.values()) for n in node.factors]
        costs = (_COSTS.get(node.op, 3) for node in self.nodes if node.op not in _GIVEN)
        self.weight = sum(costs) + len(self.rates) + sum(n.bit_length() >> 6 for n in long)

    def _form(self, op: str, forms: list[Form], datum: Fraction) -> Form:
        match op:
            case "number":
                form = {_ONE: datum} if datum else {}
            case "variable":
                form = {1 + int(datum): Fraction(1)}
            case "+" | "-":
                form = _sum(forms[0], forms[1], 1 if op == "+" else -1)
            case "negative":
                form = _sum({}, forms[0], -1)
            case "*" if (number := next(filter(_is_number, forms), None)) is not None:
                other = forms[1] if number is forms[0] else forms[0]
                form = _sum({}, other, number.get(_ONE, _ZERO))
            case "/" if forms[1] and _is_number(forms[1]):
                form = _sum({}, forms[0], 1 / forms[1][_ONE])
            case _:
                form = {self._nonlinear(op, list(map(self._node, forms)), datum): Fraction(1)}
        return form

    def _nonlinear(self, op: str, places: list[int], datum: Fraction) -> int:
        match op:
            case "^":
                place = self._power(places[0], int(datum))
            case "*" if places[0] == places[1]:
                place = self._add("square", places[0])
            case "sin" | "cos":  # each needs the other, and the rate of the argument
                rate = self._add("rate", places[0])
                sin = self._add("sin", places[0], rate, rate + 2)
                cos = self._add("cos", places[0], rate, sin)
                place = sin if op == "sin" else cos
            case "exp":
                place = self._add("exp", places[0], self._add("rate", places[0]))
            case "log" | "atan":  # (log a)' = a' / a, (atan a)' = a' / (1 + a^2)
                divisor, one = places[0], Fraction(1)
                if op == "atan":
                    divisor = self._node({_ONE: one, self._add("square", divisor): one})
                place = self._add(op, places[0], len(self.nodes) + 1, divisor)
                self._add("rate", place)
            case "*" | "/" | "sqrt" | "pi":
                place = self._add(op, *places)
            case _:
                raise Unproved(f"no series of {op}")
        return place

    def _power(self, place: int, n: int) -> int:
        if n < 0:
            return self._add("/", _ONE, self._power(place, -n))
        if n == 1:
            return place
        half = self._power(place, n // 2)
        square = self._add("square", half)
        return self._add("*", square, place) if n % 2 else square

    def _node(self, form: Form) -> int:
        """Return the node of a combination, a new one where there is none."""
        if len(form) == 1 and 1 in form.values():
            return next(iter(form))
        key = tuple(sorted(form.items()))
        if key not in self._combinations:
            self._combinations[key] = len(self.nodes)
            self.nodes.append(_combination(form))
        return self._combinations[key]

    def _add(self, op: str, *arguments: int) -> int:
        self.nodes.append(Node(op, arguments))
        return len(self.nodes) - 1


def _is_number(form: Form) -> bool:
    return form.keys() <= {_ONE}


def _sum(one: Form, two: Form, factor: Fraction | int) -> Form:
    """Return one + factor two."""
    total = dict(one)
    for place, value in two.items():
        total[place] = total.get(place, _ZERO) + factor * value
    if any(size(value) > MOST_DIGITS for value in total.values()):
        raise Unproved("a factor with too many digits")
    return {place: value for place, value in total.items() if value}


def _combination(form: Form) -> Node:
    divisor = lcm(*(value.denominator for value in form.values()))
    factors = tuple(int(value * divisor) for value in form.values())
    return Node("combination", tuple(form), factors, divisor)


class Series:
    """The coefficients of the solutions that begin in a box, as many as are asked for.

    start: all variables of the program. step: h, a dyadic number.
    """

    def __init__(self, program: Program, start: Sequence[Enclosure], step: Fraction) -> None:
        self.program, self.step, self.bits = program, step, start[0].bits
        self._numbers = Enclosures(self.bits)
        # of each node: midpoints, radii, |m|, |m| + r, a list each
        lists: list[list[list[int]]] = [[[] for _ in program.nodes] for _ in range(4)]
        self._m, self._r, self._u, self._g = lists
        self._store(_ONE, 1 << self.bits, 0)
        for place, x in enumerate(start, 1):
            self._store(place, *ball(x))

    def coefficients(self, k: int) -> list[Enclosure]:
        """Return the k-th coefficients of the variables that have rates, in their order."""
        places = list(self.program.rates)
        while len(self._m[places[0]]) <= k:
            self._advance(len(self._m[places[0]]) - 1)
        return [self._at(place, k) for place in places]

    def _advance(self, k: int) -> None:
        """Compute the k-th coefficients of what the rates need, then the next ones of variables."""
        METER.get().spend(4 + self.program.weight * (1 + (k * (4 + (self.bits >> 6)) >> 6)))
        for place, node in enumerate(self.program.nodes):
            if node.op not in _GIVEN:
                self._store(place, *self._coefficient(place, node, k))
            elif len(self._m[place]) == k:  # a constant
                self._store(place, 0, 0)
        top, below = self.step.numerator, self.step.denominator * (k + 1)
        for place, rate in self.program.rates.items():
            m, r = self._combined(rate, k)
            self._store(place, *_divided(m * top, r * top, rate.divisor * below))

    def _store(self, place: int, m: int, r: int) -> None:
        u = abs(m)
        if (u + r) >> (self.bits + _LARGEST):
            raise Unproved("a series that grows beyond 2^256")
        self._m[place].append(m)
        self._r[place].append(r)
        self._u[place].append(u)
        self._g[place].append(u + r)

    def _coefficient(self, place: int, node: Node, k: int) -> Ball:
        """Return the k-th coefficient of an operation: the value, or by Leibniz."""
        op, a = node.op, node.arguments
        match op:
            case "combination":
                result = _divided(*self._combined(node, k), node.divisor)
            case "*":
                result = self._product(a[0], a[1])
            case "square" if k:
                result = self._square(a[0], k)
            case "rate":  # of a, times h: k a_k
                result = self._m[a[0]][k] * k, self._r[a[0]][k] * k
            case _:
                result = self._later(place, op, a, k) if k else self._first(op, a)
        return result

    def _later(self, place: int, op: str, a: Sequence[int], k: int) -> Ball:
        """Return the k-th coefficient of a function, by its differential equation, or an inverse.

        (sin a)' = a' cos a, and so on; b q = a; q q = a; a q' = a' for q = log a.
        """
        match op:
            case "pi":
                return 0, 0
            case "sin" | "cos" | "exp":
                m, r = self._part(a[1], place if op == "exp" else a[2], 1, k, k)
                return _divided(-m if op == "cos" else m, r, k)
            case "/":
                rest, divisor = self._part(place, a[1], 0, k - 1, k), self._at(a[1], 0)
            case "sqrt":
                rest, divisor = self._part(place, place, 1, k - 1, k), self._at(place, 0) * 2
            case _:  # log and atan, whose rate, the next node, is known for i < k
                rest = _divided(*self._part(a[1], a[2], 1, k - 1, k), k)
                divisor = self._at(a[2], 0)
        m, r = self._m[a[0]][k] - rest[0], self._r[a[0]][k] + rest[1]
        return ball(Enclosure(m - r, m + r, self.bits) / divisor)

    def _first(self, op: str, a: Sequence[int]) -> Ball:
        """Return the coefficient of order 0: the value."""
        values = [self._at(place, 0) for place in a[: 2 if op == "/" else 1]]
        if op == "square":
            return ball(self._numbers.apply("^", values, Fraction(2)))
        return ball(self._numbers.apply(op, values, _ZERO))

    def _combined(self, node: Node, k: int) -> Ball:
        """Return the k-th coefficient of a combination, times its divisor."""
        m = r = 0
        for place, factor in zip(node.arguments, node.factors, strict=True):
            m += factor * self._m[place][k]
            r += abs(factor) * self._r[place][k]
        return m, r

    def _product(self, a: int, b: int) -> Ball:
        """Return the sum of all a_i b_(k-i), k being the last order that there is of both."""
        m = sum(map(mul, self._m[a], reversed(self._m[b])))
        r = sum(map(mul, self._r[a], reversed(self._g[b])))
        return self._scaled(m, r + sum(map(mul, self._u[a], reversed(self._r[b]))))

    def _square(self, a: int, k: int) -> Ball:
        """Return the same for b = a: twice the sum for i < k/2, and the middle one."""
        half = (k + 1) // 2
        m = 2 * sum(map(mul, self._m[a][:half], reversed(self._m[a])))
        r = sum(map(mul, self._r[a][:half], reversed(self._g[a])))
        r = 2 * (r + sum(map(mul, self._u[a][:half], reversed(self._r[a]))))
        if k % 2 == 0:
            m += self._m[a][half] ** 2
            r += self._r[a][half] * (self._g[a][half] + self._u[a][half])
        return self._scaled(m, r)

    def _part(self, a: int, b: int, first: int, last: int, k: int) -> Ball:
        """Return the sum of a_i b_(k-i), first <= i <= last."""
        i, j = slice(first, last + 1), slice(k - last, k - first + 1)
        m = sum(map(mul, self._m[a][i], reversed(self._m[b][j])))
        r = sum(map(mul, self._r[a][i], reversed(self._g[b][j])))
        return self._scaled(m, r + sum(map(mul, self._u[a][i], reversed(self._r[b][j]))))

    def _scaled(self, m: int, r: int) -> Ball:
        return m >> self.bits, (r >> self.bits) + 2

    def _at(self, place: int, k: int) -> Enclosure:
        m, r = self._m[place][k], self._r[place][k]
        return Enclosure(m - r, m + r, self.bits)


def _divided(m: int, r: int, divisor: int) -> Ball:
    """Return a ball around another one over a positive integer; exact where the quotient is."""
    quotient, rest = divmod(m, divisor)
    return quotient, -(-r // divisor) + (rest > 0)


def ball(x: Enclosure) -> Ball:
    """Return a ball around an enclosure."""
    m = (x.lo + x.hi) >> 1
    return m, x.hi - m
