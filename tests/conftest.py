"""What the whole suite shares: how much it tries, what is made once, and where its bytecode is."""

import gc
import os
import shutil
import sys
import tempfile

from tests import once
from tests.effort import EFFORT


def pytest_configure(config):
    """Try less in the quick part; keep bytecode where Python is told to write none.

    Beside the sources there is none then, as asked; but workers, and the processes that tests
    start, do not compile the same files again and again.
    """
    EFFORT.quick = config.option.markexpr == "not slow"
    if sys.dont_write_bytecode and config.pluginmanager.hasplugin("cacheprovider"):
        folder = str(config.cache.mkdir("bytecode"))
        sys.dont_write_bytecode, sys.pycache_prefix = False, folder
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        os.environ["PYTHONPYCACHEPREFIX"] = folder
    if not hasattr(config, "workerinput"):
        os.environ[once.FOLDER] = folder = tempfile.mkdtemp()
        config.add_cleanup(lambda: shutil.rmtree(folder))


def pytest_collection_finish():
    """Keep the garbage collector from going through thousands of collected tests every time."""
    gc.collect()
    gc.freeze()
