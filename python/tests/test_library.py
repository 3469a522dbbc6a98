"""Inspection, verification, films, and what a room says beside its albedo."""

import json

import numpy as np
import pytest
import relamp
from matplotlib.image import imread


@pytest.fixture(scope="module")
def folder(room, tmp_path_factory):
    folder = tmp_path_factory.mktemp("saved") / "room"
    room.save(folder)
    return folder


def test_emission_is_the_radiance_of_lights_json(room):
    lamp = max(room.lights.fixtures, key=lambda lamp: lamp.area)
    texels = room.fixtures == lamp.id
    assert texels.any()
    assert np.allclose(room.emission[texels], lamp.radiance)
    assert not room.emission[room.fixtures < 0].any()


def test_doubts_have_the_names_of_the_report(room, folder):
    shares = json.loads((folder / "report.json").read_text())["confidence"]["low"]
    assert set(shares) == set(relamp.DOUBTS[1:])
    known = {name for name in relamp.DOUBTS if (room.doubt == relamp.DOUBTS.index(name)).any()}
    assert {name for name, share in shares.items() if share > 0} <= known
    assert room.doubt.dtype == np.uint8 and room.doubt.max() < len(relamp.DOUBTS)
    assert (room.confidence[room.doubt > 0] < 0.51).all()


def test_correction_is_that_of_the_folder(room, folder):
    kept = np.rint(255 * imread(folder / "correction.png")).astype(int)
    assert (np.rint(200 * room.correction).astype(int) == kept).all()
    assert 0.2 < (room.correction > 0).mean() < 1 and room.correction.max() > 1


def test_nothing_is_corrected_by_the_thesis(sample):
    assert (relamp.delight(sample, solver="thesis").correction == 1).all()


def test_openings_and_camera_are_those_of_the_report(room, folder):
    report = json.loads((folder / "report.json").read_text())
    assert len(room.openings) == len(report["lights"]["openings"]) > 0
    assert room.openings[0].area == pytest.approx(report["lights"]["openings"][0]["area"], rel=1e-3)
    assert room.camera.contrast == pytest.approx(1.0, abs=0.2)
    assert len(room.camera.response) == 5


def test_inspection_is_that_of_the_program(sample):
    found = relamp.inspect(sample)
    assert found.triangles == 39855
    assert [(page.width, page.height) for page in found.pages] == [(1024, 1024)]
    assert 1e8 < found.cost.bytes < 1e9 and 1 < found.cost.core_seconds < 60
    assert found == relamp.inspect(relamp.read_scan(sample))
    with pytest.raises(ValueError, match="scale: the scan is read already"):
        relamp.inspect(relamp.read_scan(sample), scale=2.0)


def test_verification(folder, sample):
    found = relamp.verify(folder, samples=4, places=500, scan=sample)
    assert found == relamp.verify(folder, samples=4, places=500, scan=sample, threads=1)
    assert 0 < found.rms_error < found.rms_of_scan and len(found.bins) == 5
    with pytest.raises(ValueError, match="samples=1 is not between 2 and 65536"):
        relamp.verify(folder, samples=1)


def test_film(room, tmp_path):
    warnings = room.film(tmp_path / "film", fixtures={"all": "on"}, turntable=3, size=(32, 18), antialias=1)
    assert warnings == ()
    assert len(list((tmp_path / "film").glob("frame_*.png"))) == 3
    with pytest.raises(relamp.Error, match="film.txt"):
        room.film(tmp_path / "film.txt", turntable=3)
    with pytest.raises(ValueError, match="needs turntable"):
        room.film(tmp_path / "film")
    with pytest.raises(relamp.Error, match="nowhere.json"):
        room.film(tmp_path / "film", timeline="nowhere.json")


def test_parameters_of_the_thesis(sample):
    scan = relamp.read_scan(sample, longest_side=512)
    plain = relamp.delight(scan, solver="thesis", engine="cpu")
    flat = relamp.delight(scan, solver="thesis", engine="cpu", no_lpv=True, light_levels=4)
    assert not np.array_equal(plain.shading, flat.shading)
    for wrong, sentence in (
        ({"lpv_size": 4}, "lpv_size=4 is not between 8 and 128"),
        ({"attenuation": (0, 0, -1)}, "attenuation: -1 is not between 0 and"),
        ({"power": float("nan")}, "power=nan is not between"),
    ):
        with pytest.raises(ValueError, match=sentence):
            relamp.delight(scan, solver="thesis", **wrong)
    with pytest.raises(ValueError, match="power: only the thesis solver"):
        relamp.delight(scan, power=2)
