"""The compiled theory, one for all test processes."""

import pytest

from tests.proofs.formal import coq


@pytest.fixture(scope="session")
def theory(tmp_path_factory, worker_id):
    """The folder with the compiled theory."""
    base = tmp_path_factory.getbasetemp()
    return coq.compiled_theory((base if worker_id == "master" else base.parent) / "theory")
