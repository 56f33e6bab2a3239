"""Measure the errors of the binary64 kernels: `python -m tests.intervals.measure_errors`."""

import sys

import flint
import numpy as np

from intervals.elementary.binary64.arctangent import angle
from intervals.elementary.binary64.exponential import exp
from intervals.elementary.binary64.logarithm import sharp_log
from intervals.elementary.binary64.monotone import FUNCTIONS
from intervals.elementary.binary64.pair import Pair
from intervals.elementary.binary64.trigonometric import point_sincos
from tests.intervals.binary64_oracle import BITS, plane_points, points, true_at

KERNELS = {name: function.point for name, function in FUNCTIONS.items()}
KERNELS["sin"] = lambda x: point_sincos(x)[0]
KERNELS["cos"] = lambda x: point_sincos(x)[1]
KERNELS["atan2"] = lambda y, x: angle(Pair(np.abs(y)), Pair(x)).with_sign_of(y + 0.0)
KERNELS["hypot"] = lambda x, y: (Pair(x) * Pair(x) + Pair(y) * Pair(y)).sqrt()
KERNELS["power"] = lambda x, y: exp(Pair(y) * sharp_log(Pair(x)))
KERNELS["tan"] = lambda x: point_sincos(x)[0].normal() / point_sincos(x)[1].normal()


def proved(name, x):
    """Whether the theorem covers the points."""
    size = np.abs(x)
    if name in ("sin", "cos", "tan"):
        low, high, small = -1024.0, 1024.0, 2.0**-400
    else:
        function = FUNCTIONS[name]
        low, high, small = function.low, function.high, function.small
    return (x >= low) & (x <= high) & ((size >= small) | (size == 0))


def errors(name, *arguments):
    """Return the arguments that the theorem covers, the errors in units of u |result|, and k."""
    if len(arguments) == 1:
        arguments = (arguments[0][proved(name, arguments[0])],)
    with np.errstate(all="ignore"):
        value = KERNELS[name](*arguments)
    lows = np.broadcast_to(value.lo, value.hi.shape).tolist()
    columns = zip(*(x.tolist() for x in arguments), value.hi.tolist(), lows, strict=True)
    result = np.zeros(len(lows))
    with flint.ctx.workprec(BITS):
        for i, (*point, high, low) in enumerate(columns):
            exact = true_at(name, point)
            error = float(abs((exact - high) - low).upper())
            if high:
                result[i] = error / abs(high) * 2.0**53
            else:
                result[i] = 0.0 if exact == 0 else np.inf
    return arguments, result, value.k


def main(count=1_000_000):
    """Print the largest error of each kernel, and where it is."""
    for name in KERNELS:
        plane = name in ("atan2", "hypot", "power")
        x = plane_points(name, count, 1) if plane else (points(name, 5 * count // 4, 1),)
        x, error, k = errors(name, *x)
        worst = int(np.argmax(error))
        place = ", ".join(v[worst].item().hex() for v in x)
        print(f"{name:6} {error[worst]:8.5f} proved {k:.5f}, {len(error)} points, worst {place}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
