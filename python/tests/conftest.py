"""One draft of the sample for all tests: a second of work."""

import os
from pathlib import Path

import pytest
import relamp

SAMPLE = Path(os.environ["RELAMP_SAMPLES"]) / "bedroom" / "scan.glb"


@pytest.fixture(scope="session")
def sample():
    return SAMPLE


@pytest.fixture(scope="session")
def room():
    return relamp.delight(SAMPLE, quality="draft")
