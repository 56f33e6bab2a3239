"""A text read by proofs.check and by the second reader."""

from tests.proofs.trusted import second_reader
from tests.proofs.trusted.mutations import outcome


def second(text):
    """The second reader's (accepted, rejected or malformed, the reason, verdicts)."""
    try:
        return "accepted", "", second_reader.read(text)
    except second_reader.NotACertificate as error:
        return "malformed", str(error), None
    except second_reader.NotAProof as error:
        return "rejected", str(error), None


def both(text):
    """Both outcomes and reasons, for the message of a failing test."""
    found, reason, report = outcome(text)
    verdicts = report and {claim.id: claim.verdict.value for claim in report.claims}
    other, why, read = second(text)
    return found, other, verdicts == read, f"{found}: {reason[:200]} | {other}: {why[:200]}"
