"""The dimension from periodic orbits, in floating point: independent of the code, no proof.

Jenkinson and Pollicott (2001): the dimension is the zero of the determinant of 1 - L_s,

    det(1 - z L_s) = exp(-sum over n of z^n / n sum of |m|^-s / (1 - 1/m)), at z = 1,

m the multiplier of (f^n)' at each fixed point of f^n. Its terms fall faster than exponentially.
"""

import math
from functools import cache
from itertools import product

ETA, NU = 0.2121, -0.2
TURNS = (4, 9)  # full turns of the table during the flights from I0 and from I1
_MIDDLES = (1.125, 1.295)


def _forms(y, t):
    """Equation (10) with its partial derivatives by y and t, typed by hand."""
    big_s, big_c = math.sin(ETA * t), math.cos(ETA * t)
    value = (1 + NU * math.sin(y)) * big_c + NU / ETA * math.cos(y) * big_s - 1
    by_y = NU * math.cos(y) * big_c - NU / ETA * math.sin(y) * big_s - NU * math.cos(y + t)
    by_t = NU * math.cos(y) * big_c - ETA * (1 + NU * math.sin(y)) * big_s - NU * math.cos(y + t)
    return value - NU * math.sin(y + t), by_y, by_t


def inverse(letter, x):
    """(g(x), f'(g(x))) by Newton's method for the phase y with f(y) = x."""
    y = _MIDDLES[letter]
    for _ in range(50):
        value, by_y, by_t = _forms(y, x - y + 2 * math.pi * TURNS[letter])
        step = value / (by_y - by_t)
        y -= step
        if abs(step) < 1e-16:
            break
    return y, 1 - by_y / by_t


@cache
def multiplier(word):
    """The multiplier of the periodic point of a word of letters 0 and 1."""
    x, before, last = 1.2, 0.0, 1.0
    while abs(x - before) > 1e-15 and last > 0:
        before = x
        for letter in reversed(word):
            x, _ = inverse(int(letter), x)
        last = abs(x - before) if abs(x - before) < last else 0.0
    result = 1.0
    for letter in reversed(word):
        x, slope = inverse(int(letter), x)
        result *= slope
    return result


def every(length):
    """All words of a length."""
    return map("".join, product("01", repeat=length))


def blocks(length):
    """The words of so many blocks 1, 01, 001: the first-return form of `without_000`."""
    return map("".join, product(("1", "01", "001"), repeat=length))


def determinant(s, longest, words):
    """The determinant, from the orbits up to a length: its Taylor polynomial in z at z = 1."""
    traces = [
        sum(m**-s / (1 - 1 / m) for m in map(multiplier, words(n))) for n in range(1, longest + 1)
    ]
    terms = [1.0]
    for n in range(1, longest + 1):
        terms.append(-sum(traces[k] * terms[n - 1 - k] for k in range(n)) / n)
    return math.fsum(terms)


def dimension(longest, words=every):
    """The zero of the determinant between 0.1 and 0.9."""
    low, high = 0.1, 0.9
    for _ in range(52):
        middle = (low + high) / 2
        if determinant(middle, longest, words) < 0:
            low = middle
        else:
            high = middle
    return low
