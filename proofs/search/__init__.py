"""What proves: candidates, and proofs by `intervals`, by the sections of the paper."""
