"""Judges of conclusions about single-impact orbits (section 4), by (16)-(18) and simulation."""

from fractions import Fraction
from functools import lru_cache

import flint
import numpy as np

from tests.oracles.motion import TURN, Gap, Impact, _Balls, ball, flight, inside, two_pi


def solutions(eta, nu, n):
    """The two phases of (17), sin(phi - theta) = -cos(theta)/nu, as balls; none, or None."""
    with flint.ctx.workprec(240):
        eta, nu = ball(eta), ball(nu)
        angle = two_pi() * n * eta
        alpha, beta = eta * (1 - angle.cos()), angle.sin()
        if not alpha > 0:
            return None
        theta = (beta / alpha).atan()
        sine = -theta.cos() / nu
        if abs(sine) > 1:
            return ()
        if not abs(sine) < 1:
            return None
        return theta + sine.asin(), theta + flint.arb.pi() - sine.asin()


def slope18(eta, nu, n, phi):
    """The slope, as printed in (18)."""
    with flint.ctx.workprec(240):
        eta, nu = ball(eta), ball(nu)
        s, c = (two_pi() * n * eta).sin(), (two_pi() * n * eta).cos()
        height = 1 + nu * phi.sin()
        top = nu / eta * phi.sin() * s - eta * height * s
        return top / (-eta * height * s + nu * phi.cos() * c - nu * phi.cos())


def _acceleration(eta, nu, phi):
    with flint.ctx.workprec(240):
        return Gap(_Balls, eta, nu, phi).start()[1]


def solution(view, rng):
    """Exactly one solution of (16) in the bracket; its slope, its launch; a gap below 0."""
    both = solutions(view.eta, view.nu, view.n)
    if both is None:
        return ["n eta is an integer, or the solutions coincide"]
    with flint.ctx.workprec(240):
        here = [x + k * two_pi() for x in both for k in (-2, -1, 0, 1, 2)]
        here = [x for x in here if inside(x, view.phase)]
        if len(here) != 1:
            return [f"{len(here)} solutions of (16) in the bracket"]
        slope, push = (
            slope18(view.eta, view.nu, view.n, here[0]),
            _acceleration(view.eta, view.nu, here[0]),
        )
        told = [] if inside(slope, view.multiplier) else [f"the slope is {slope.str(12)}"]
        if not inside(push, view.acceleration):
            told.append(f"the launch acceleration is {push.str(12)}")
        if view.first and is_orbit(view.eta, view.nu, view.n, here[0]) is False:
            told.append("another impact is the first")
        if view.early is not None:
            time = ball(view.early)
            below = Gap(_Balls, view.eta, view.nu, here[0]).at(time)[0] < 0
            if not (0 < time < view.n * two_pi() and below):
                told.append(f"the gap is not negative at {float(view.early):.6g}")
        return told


def is_orbit(eta, nu, n, phi):
    """Whether the first impact after a launch at phi is 2 pi n later; None if undecided."""
    push = _acceleration(eta, nu, phi)
    if push < 0:
        return False
    found = flight(eta, nu, phi, latest=TURN * n + 1)
    if found is None or not push > 0:
        return None
    return isinstance(found, Impact) and abs(float(found.time) - TURN * n) < 1e-7


_NEAR = Fraction(1, 10**9)  # how far from the ends of windows stable orbits are looked for


@lru_cache(maxsize=20_000)
def stable(eta, nu, n):
    """Whether there is an n-periodic single-impact orbit with |slope| < 1; None if undecided."""
    both = solutions(eta, nu, n)
    if both is None:
        return None
    answers = [False]
    for phi in both:
        slope = abs(slope18(eta, nu, n, phi))
        if not slope > 1:
            answers.append(is_orbit(eta, nu, n, phi) if slope < 1 else None)
    return True if True in answers else None if None in answers else False


def _shares(rng):
    return (Fraction(1, 10**6), 1 - Fraction(1, 10**6), Fraction(rng.randint(1, 999), 1000))


def eta_windows(view, rng):
    """Stable orbits with n periods exactly for eta between the ends."""
    return (_above if view.late is None else _below)(view, rng)


def _above(view, rng):
    told, ends = [], view.ends
    if not (0 < view.nu < 1 and 0 < view.low < 1):
        return ["nu, or the least eta, is not between 0 and 1"]
    count = len(ends)
    for n in {1, count, count + 1, rng.randint(1, count + 3)} - {0}:
        flip, stick = ends[n - 1] if n <= count else ((view.low,) * 2, (view.low,) * 2)
        tried = [view.low + (Fraction(1, 2 * n) - view.low) * share for share in _shares(rng)]
        for inner, outer in ((flip[1], flip[0]), (stick[0], stick[1])):
            width = max(outer - inner, inner - outer, Fraction(1, 10**12))
            tried += [
                outer + (outer - inner),
                inner + (inner - outer),
                outer - width,
                outer + width,
            ]
        if n > count:
            tried += [
                view.low + (Fraction(1, 2 * n) - view.low) * Fraction(k, 64) for k in range(1, 64)
            ]
        else:
            tried += [flip[1] + (stick[0] - flip[1]) * share for share in _shares(rng)]
        for eta in tried:
            if eta < view.low or any(low <= eta <= high for low, high in (flip, stick)):
                continue
            told += _window(
                stable(eta, view.nu, n),
                n <= count and flip[1] < eta < stick[0],
                f"eta = {float(eta):.12g}, n = {n}",
            )
    return told


def _below(view, rng):
    """For nu < 0: n eta < 1 between the ends, and n eta > 1 in the late window alone."""
    if not (-0.3 <= view.nu < 0 and 0 < view.low < 1):
        return ["nu is not in [-0.3, 0), or the least eta not between 0 and 1"]
    count, tried = len(view.ends), []
    for n in {1, 2, 3, count, count + 1, rng.randint(1, count + 3)}:
        first, last = view.ends[n - 1] if n <= count else ((Fraction(1, n),) * 2,) * 2
        low, high = max(view.low, Fraction(1, 2 * n)), Fraction(1, n)
        etas = [low + (high - low) * Fraction(k, 16) for k in range(1, 16)]
        etas += [first[1] + (last[0] - first[1]) * share for share in _shares(rng)]
        etas += [x + step for x in (*first, *last) for step in (-_NEAR, _NEAR)]
        tried += [(n, eta, (first, last)) for eta in etas if low < eta < high]
    late = view.late
    etas = [x + step for end in late for x in end for step in (-_NEAR, _NEAR)]
    etas += [late[0][1] + (late[1][0] - late[0][1]) * share for share in _shares(rng)]
    etas += [Fraction(k, 16) for k in range(25, 36)]
    tried += [(1, eta, late) for eta in etas]
    for _ in range(12):
        n, whole = rng.randint(2, 5), rng.randint(2, 6)
        tried.append((n, (whole - Fraction(rng.randint(1, 400), 1000)) / n, None))
    told = []
    for n, eta, ends in tried:
        if eta < view.low or (ends and any(low <= eta <= high for low, high in ends)):
            continue
        given = ends is not None and ends[0][1] < eta < ends[1][0]
        told += _window(stable(eta, view.nu, n), given, f"eta = {float(eta):.12g}, n = {n}")
    return told


def _window(own, given, where):
    return [] if own is None or own == given else [f"stable is {own} at {where}"]


def nu_windows(view, rng):
    """The same at fixed eta, for both signs of nu."""
    told = []
    for sign, windows in ((1, view.above), (-1, view.below)):
        known = {n: (first, last) for n, first, last in windows}
        most = int(1 / view.eta) + 1
        for n in {1, most, rng.randint(1, most), *list(known)[:3], *view.early[:1]}:
            first, last = known.get(n, ((Fraction(1),) * 2, (Fraction(1),) * 2))
            tried = [
                *_shares(rng),
                *(Fraction(k, 24) for k in range(1, 24 if n not in known else 1)),
            ]
            for low, high in (first, last):
                tried += [low - (high - low), high + (high - low)]
            if n in known:
                tried += [first[1] + (last[0] - first[1]) * share for share in _shares(rng)]
            for size in tried:
                if 0 < size < 1 and not any(low <= size <= high for low, high in (first, last)):
                    own = stable(view.eta, sign * size, n)
                    told += _window(
                        own, first[1] < size < last[0], f"nu = {float(sign * size):.12g}, n = {n}"
                    )
    return told


def contracting_but_none(eta, nu, periods):
    """Whether some solution with |slope| < 1 is no orbit."""
    for n in periods:
        for phi in solutions(eta, nu, n) or ():
            if abs(slope18(eta, nu, n, phi)) < 1 and is_orbit(eta, nu, n, phi) is False:
                return True
    return False


# -- which are stable: those that (14) and (15) repeat are launched, from a grid of phases ---------

_GRID = 4000
_LEAST = 1e-9  # relative velocity of an impact


def _repeated(eta, nu, epsilon, n, phi):
    """The velocity that (15) repeats after n turns from a phase, and what (14) leaves then."""
    angle, h, rate = TURN * n * eta, 1 + nu * np.sin(phi), nu * np.cos(phi)
    pushed = (1 + epsilon) * rate / eta
    gamma = (h * np.sin(angle) - pushed * np.cos(angle)) / (1 + epsilon * np.cos(angle))
    return gamma, h * np.cos(angle) + (epsilon * gamma + pushed) * np.sin(angle) - h


def repeating(eta, nu, epsilon, n):
    """Phases and velocities that (14) and (15) repeat after n turns."""
    grid = np.linspace(0, TURN, _GRID + 1)
    left = _repeated(eta, nu, epsilon, n, grid)[1]
    if np.abs(left).max() < 1e-9:  # n eta is an integer: all phases, without relative velocity
        return
    for k in np.flatnonzero(np.sign(left[:-1]) * np.sign(left[1:]) < 0):
        low, high = grid[k], grid[k + 1]
        for _ in range(60):
            middle = (low + high) / 2
            same = np.sign(_repeated(eta, nu, epsilon, n, middle)[1]) == np.sign(left[k])
            low, high = (middle, high) if same else (low, middle)
        yield low, _repeated(eta, nu, epsilon, n, low)[0]


def stable_count(eta, nu, epsilon, n):
    """How many orbits with one impact in n turns are stable; None where that is a near thing."""
    count = 0
    for phi, gamma in repeating(*map(float, (eta, nu, epsilon)), n):
        found = flight(eta, nu, Fraction(phi), epsilon, Fraction(gamma), latest=TURN * n + 1)
        if not isinstance(found, Impact):
            continue
        if abs(float(found.time) - TURN * n) > 1e-5 or float(found.speed) < _LEAST:
            continue
        size = max(abs(np.linalg.eigvals(np.array(found.derivative(), float))))
        if abs(size - 1) < 1e-6:
            return None
        count += size < 1
    return count


def stable_singles(view, rng):
    """One stable orbit for each n that is named, none for the others; and for some greater n."""
    told, more = [], (1, 2, 5) if view.is_complete else ()
    for n in (*range(1, view.most + 1), *(view.most + k for k in more)):
        count = stable_count(view.eta, view.nu, view.epsilon, n)
        if count not in (None, int(n in view.stable)):
            told.append(f"{count} stable orbits for n = {n}")
    return told
