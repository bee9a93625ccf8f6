import os

import pytest

import myotact

LINES = {"tissue.default": "line"}  # opens in a blink: what is asked does not depend on the tissue


@pytest.fixture
def scene():
    return myotact.Scene("elbow", set=LINES)


@pytest.fixture
def free_scene():
    """Every muscle has a level of its own."""
    return myotact.Scene("elbow", set=LINES, co_contraction=False)


@pytest.fixture(scope="session")
def tissue_scene():
    """Of finite elements: takes seconds to open; steps take 10 ms and more."""
    return myotact.Scene("elbow")


@pytest.fixture
def program():
    """The program of the same sources, or the test is left out."""
    path = os.environ.get("MYOTACT_PROGRAM", "")
    if not os.access(path, os.X_OK):
        pytest.skip("MYOTACT_PROGRAM names no program")
    return path
