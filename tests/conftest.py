"""What the whole suite shares: how much it tries, what is made once, and where its caches are."""

import gc
import os
import sys
from contextlib import suppress
from tempfile import TemporaryDirectory

import pytest
from platformdirs import user_cache_path

from tests import once
from tests.once import EFFORT, examples


def pytest_configure(config):
    """Try less in the quick part; leave the user's cache alone, but for the theory that Coq has
    compiled, whose name is a digest of it; keep bytecode where Python is told to write none.

    Beside the sources there is none then, as asked; but workers, and the processes that tests
    start, do not compile the same files again and again.
    """
    if sys.dont_write_bytecode and config.pluginmanager.hasplugin("cacheprovider"):
        folder = str(config.cache.mkdir("bytecode"))
        sys.dont_write_bytecode, sys.pycache_prefix = False, folder
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        os.environ["PYTHONPYCACHEPREFIX"] = folder
    from hypothesis import settings  # after that: pytest rewrites its 90 files, 3 s if none is kept

    EFFORT.quick = config.option.markexpr == "not slow"
    settings.register_profile("suite", deadline=None, max_examples=examples(100))  # noisy machines
    settings.load_profile("suite")
    if not hasattr(config, "workerinput"):
        folder_of_run = TemporaryDirectory()
        config.add_cleanup(folder_of_run.cleanup)
        compiled = user_cache_path("impact-proofs") / "coq"
        os.environ[once.FOLDER] = os.environ["XDG_CACHE_HOME"] = folder_of_run.name
        own = user_cache_path("impact-proofs", ensure_exists=True) / "coq"
        with suppress(OSError):  # else the theory is compiled for this run alone
            compiled.mkdir(parents=True, exist_ok=True)
            own.symlink_to(compiled)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Have all that is long be slow as well: `-m 'not slow'` takes the place of 'not long'.

    Of the cases of one test, the quick part takes the first and the last, of tables marked `every`
    all.
    """
    cases = {}
    for item in items:
        if item.get_closest_marker("long"):
            item.add_marker(pytest.mark.slow)
        if not (item.get_closest_marker("slow") or item.get_closest_marker("every")):
            cases.setdefault(item.nodeid.partition("[")[0], []).append(item)
    if EFFORT.quick:
        left = {case for every in cases.values() for case in every[1:-1]}
        config.hook.pytest_deselected(items=left)
        items[:] = [item for item in items if item not in left]


def pytest_collection_finish():
    """Keep the garbage collector from going through thousands of collected tests every time."""
    gc.collect()
    gc.freeze()
