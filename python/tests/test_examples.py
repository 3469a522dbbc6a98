"""The examples run, on a draft, and write what they say."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", ["show", "sweep"])
def test_picture(name, sample, tmp_path):
    example(name).main(str(sample), str(tmp_path / "picture.png"), "draft")
    assert imread(tmp_path / "picture.png").std() > 0.05


def test_training_pairs(sample, tmp_path, capsys):
    example("training_pairs").main(str(tmp_path), "nowhere.glb", str(sample), quality="draft")
    assert "nowhere.glb" in capsys.readouterr().err
    tiles = sorted(tmp_path.glob("*.npz"))
    assert tiles
    with np.load(tiles[0]) as tile:
        assert tile["albedo"].shape == tile["scan"].shape == (128, 128, 3)
        assert np.isfinite(tile["scan"]).all()
