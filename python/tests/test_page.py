"""docs/guide/python.md is true: its code runs, prints what stands there, and draws its pictures."""

import doctest
import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGE = DOCS / "guide" / "python.md"
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LEAST_PSNR = 30  # dB, of one picture written as JPEG twice


@pytest.fixture(scope="module")
def worked(sample, tmp_path_factory):
    """A folder in which the page was worked through, and how many of its examples were wrong."""
    folder = tmp_path_factory.mktemp("page")
    (folder / "samples").symlink_to(sample.parents[1])
    parser, runner, names = doctest.DocTestParser(), doctest.DocTestRunner(), {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for number, block in enumerate(BLOCK.findall(PAGE.read_text(encoding="utf-8"))):
            example = parser.get_doctest(block, names, f"block {number}", str(PAGE), 0)
            runner.run(example, clear_globs=False)
            names = example.globs
    return folder, runner.summarize(verbose=False)


def test_code_prints_what_the_page_says(worked):
    _, results = worked
    assert results.attempted > 20
    assert results.failed == 0


@pytest.mark.parametrize("name", ["python_parts.jpg", "python_relit.jpg"])
def test_pictures_are_those_of_the_page(worked, name):
    folder, _ = worked
    assert f"../images/{name}" in PAGE.read_text(encoding="utf-8")
    drawn = imread(folder / name).astype(float)
    shown = imread(DOCS / "images" / name).astype(float)
    assert drawn.shape == shown.shape
    error = np.sqrt(np.mean((drawn - shown) ** 2))
    assert 20 * np.log10(255 / max(error, 1e-6)) > LEAST_PSNR
