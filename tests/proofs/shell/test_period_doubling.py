"""`python -m proofs.period_doubling`: the numbers, at any precision, and what it refuses."""

import json
from fractions import Fraction

import pytest
from flint import arb, ctx

from proofs.period_doubling import main


def answer(capsys, *arguments):
    assert main([*arguments, "--json", "-"]) == 0
    return json.loads(capsys.readouterr().out)


def expected(m, epsilon):
    """The closed forms, by Arb."""
    ctx.prec = 600
    e, c = arb(epsilon.numerator) / epsilon.denominator, 2 * arb.pi() * m
    alpha = 4 * (1 + e**2) / (1 + e)
    found = {
        "rho_flip": (alpha**2 + ((1 - e) * c) ** 2).sqrt() / (1 + e),
        "rho_saddle_node": (1 - e) / (1 + e) * c,
        "psi": (alpha / ((1 - e) * c)).atan(),
    }
    if epsilon == 0:
        found["f2_psi_rho"] = (4 + (arb.pi() * m) ** 2).sqrt() / 2
        found["f2_psi_psi_psi"] = -(3 * (arb.pi() * m) ** 2 + 2)
    return found


@pytest.mark.parametrize(("m", "epsilon"), [(1, "0"), (3, "1/5"), (7, "0"), (10**9, "0.999999")])
@pytest.mark.parametrize("digits", [5, 30, 100])
def test_against_arb(capsys, m, epsilon, digits):
    arguments = ("--m", str(m), "--epsilon", epsilon, "--digits", str(digits))
    found = answer(capsys, *arguments)
    for name, true in expected(m, Fraction(epsilon)).items():
        low, high = (Fraction(found[name][side]) for side in ("lower", "upper"))
        assert arb(low.numerator) / low.denominator < true
        assert true < arb(high.numerator) / high.denominator
        assert 0 < (high - low) * 10**digits <= 10 * abs(low)
    assert set(found) == {"schema", "m", "epsilon", *expected(m, Fraction(epsilon))}


def test_by_default_the_plastic_orbit_of_one_period(capsys):
    found = answer(capsys)
    assert (found["m"], found["epsilon"]) == ("1", "0")
    assert found["rho_flip"]["lower"].startswith("7.448383556474346")
    assert main([]) == 0
    assert "f2_psi_psi_psi  [-31.6088132" in capsys.readouterr().out


def test_digits_do_not_cancel(capsys):
    epsilon = str(1 - Fraction(1, 10**150))
    found = answer(capsys, "--epsilon", epsilon)["rho_saddle_node"]
    low, high = Fraction(found["lower"]), Fraction(found["upper"])
    assert 0 < (high - low) * 10**29 <= low


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--m", "0"], "whole number"),
        (["--m", "1.5"], "whole number"),
        (["--m", "-1"], "whole number"),
        (["--m", "1000000001"], "whole number"),
        (["--m", "x"], "whole number"),
        (["--epsilon", "1"], "epsilon is in [0, 1)"),
        (["--epsilon", "-0.1"], "epsilon is in [0, 1)"),
        (["--digits", "0"], "digits"),
    ],
)
def test_bad_input_is_one_line(capsys, arguments, message):
    with pytest.raises(SystemExit) as failure:
        main(arguments)
    out, err = capsys.readouterr()
    assert failure.value.code == 2 and out == ""
    assert message in err and err.count("\n") == 1


def test_help_has_examples(capsys):
    with pytest.raises(SystemExit):
        main(["--help"])
    assert "python -m proofs.period_doubling --m 3" in capsys.readouterr().out
