"""The paper's theorems proved once, for all test processes: their folder has the theory."""

import pytest

from tests.proofs.formal import coq


@pytest.fixture(scope="session")
def proved(tmp_path_factory, worker_id):
    """The folder of the paper's theorems."""
    base = tmp_path_factory.getbasetemp()
    return coq.proved(base if worker_id == "master" else base.parent)
