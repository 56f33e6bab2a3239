"""Section 6, resonance: what R1 to R13 rest on."""

from __future__ import annotations

from proofs.trusted.paper.formulas import Equal
from proofs.trusted.paper.s6_resonance import displayed as eq

MODEL = (
    Equal(f"D({eq.MASS}, t, t) + {eq.MASS}", "0"),
    Equal(f"at({eq.MASS}, t=0)", f"at({eq.TABLE}, t=0)"),
    Equal(f"at(D({eq.MASS}, t), t=0)", eq.SPEED),
    Equal(f"-({eq.SPEED} - nu*cos(phi))/(-gamma - nu*cos(phi))", "epsilon"),
    Equal(f"{eq.MASS} - {eq.TABLE}", f"at({eq.S14}, d=t, phi1=phi + t)"),
    Equal(f"-D({eq.MASS}, t)", f"at({eq.S15}, d=t)"),
)
AMPLITUDES = (
    Equal(f"at(h*cos(d) + w*sin(d), {eq.POLAR})", eq.S30),
    Equal(f"at(h*sin(d) - w*cos(d), {eq.POLAR})", eq.S31),
)
MAP = (
    *MODEL,
    Equal(
        f"at({eq.S14}, d=2*t, phi1=phi + 2*t)",
        f"2*sin(t)*({eq.KICK}*cos(t) - sin(t))",
    ),
    Equal(f"at({eq.CLOSING}, d=2*t)", f"sin(2*t) - {eq.KICK}*cos(2*t)"),
    Equal("sin(2*t) - sin(t)/cos(t)*cos(2*t)", "sin(t)/cos(t)"),
)
ENTRIES = tuple(
    Equal(derived, printed)
    for derived, printed in zip(eq.DERIVED_JACOBIAN, eq.JACOBIAN, strict=True)
)
BY_ROOT = tuple(
    Equal(f"at({entry}, {eq.ROOT})", f"at({closed}, {eq.ROOT.partition(', ')[0]})")
    for entry, closed in zip(eq.JACOBIAN, eq.CLOSED_JACOBIAN, strict=True)
)
AT_REST = tuple(
    Equal(f"at({closed}, {eq.FIXED}{turned})", fixed)
    for closed, fixed, turned in zip(
        eq.CLOSED_JACOBIAN, eq.FIXED_JACOBIAN, ("", "", ", t=0", ", t=0"), strict=True
    )
)
EIGENVALUES = (
    Equal(eq.trace(eq.FIXED_JACOBIAN), "1 + epsilon"),
    Equal(eq.determinant(eq.FIXED_JACOBIAN), "epsilon"),
    Equal(eq.determinant(eq.CLOSED_JACOBIAN), "epsilon"),
)
OFF_THE_MAP = (
    *(
        Equal(f"at({entry}, {eq.FIXED})", value)
        for entry, value in zip(eq.JACOBIAN, eq.OFF_THE_MAP, strict=True)
    ),
    Equal(f"at({eq.trace(eq.OFF_THE_MAP)}, phi1=phi)", "1"),
    Equal(f"at({eq.determinant(eq.OFF_THE_MAP)}, phi1=phi)", "0"),
)
DIFFERENTIABLE = (*MAP, *ENTRIES, *BY_ROOT, *AT_REST, *EIGENVALUES)

PRODUCT = Equal("sin(a + d)*sin(b - d) - sin(a)*sin(b)", "sin(d)*sin(b - a - d)")
ALPHA_TURNS = Equal(
    f"at(D({eq.AMPLITUDE_SQUARE}, phi)/2, {eq.FIXED})",
    "nu*cos(phi)*(1 - epsilon*nu*sin(phi))",
)
ALPHA_ZERO = (
    Equal(f"at({eq.SPEED}, gamma={eq.ALPHA_ZERO})", "0"),
    Equal(f"at({eq.SPEED}, gamma={eq.ALPHA_ZERO_PRINTED})", "-(1 + epsilon)*(1 - nu)*cos(phi)"),
)


def _across(first: str, second: str, signs: tuple[int, int]) -> tuple[Equal, ...]:
    """Return that a printed vector solves the displayed equations, and what it leaves of (30)."""
    s_o, s_1 = signs
    return (
        Equal(first, f"{s_o}*(epsilon*({second}) - (1 + epsilon))"),
        Equal(second, f"{s_1}*(epsilon*({first}) + (1 + epsilon))"),
        Equal(
            f"at({eq.ACROSS14}, gamma=-({first})*cos(phi)/sin(phi))",
            f"-{s_1}*({second})*cos(phi)/sin(phi)*sin(2*phi)",
        ),
    )


VECTORS = tuple(
    lemma for (one, two), signs in eq.VECTORS.items() for lemma in _across(one, two, signs)
)
TEST = (
    Equal(f"at({eq.STICKING_SINES}, x=sin(phi), y=cos(phi), u=sin(d), v=cos(d))", eq.STICKING),
    Equal(f"{eq.STICKING} + nu*cos(phi + d) - nu*cos(phi)", eq.CLOSING),
    Equal(
        f"at({eq.STICKING_SINES}, nu=-5/2, epsilon=1/2, x=4/5, y=3/5, gamma=5/6, u=-3/5, v=4/5)",
        "17/30",
    ),
)
