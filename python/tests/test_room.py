import gc
import os
import subprocess

import numpy as np
import pytest
import relamp


def test_albedo_times_shading_is_the_scan(room):
    albedo, shading, sure = room.albedo, room.shading, room.confidence > 0.9
    assert albedo.shape == shading.shape == (512, 512, 3)
    assert albedo.dtype == shading.dtype == np.float32
    assert sure.mean() > 0.05
    # An albedo is no brighter than paper, and the light in a room is not the same everywhere.
    assert 0 <= albedo.min() and albedo.max() <= 0.91
    assert shading[sure].std() > 0.1


def test_arrays_are_looked_at_where_they_lie(room):
    assert np.shares_memory(room.albedo, room.pages[0].albedo)
    assert not room.albedo.flags.writeable
    with pytest.raises(ValueError):
        room.albedo[0, 0, 0] = 1.0


def test_array_outlives_its_room(sample):
    short = relamp.delight(sample, quality="draft")
    positions, fixtures = short.positions, short.fixtures
    before = positions.copy(), fixtures.copy()
    del short
    gc.collect()
    assert (positions == before[0]).all() and (fixtures == before[1]).all()


def test_geometry_is_that_of_the_surface(room):
    lengths = np.linalg.norm(room.normals, axis=-1)
    there = lengths > 0
    assert there.mean() > 0.3
    assert np.allclose(lengths[there], 1, atol=1e-4)
    assert (room.positions[~there] == 0).all()


def test_fixtures_lie_where_lights_say(room):
    for fixture in room.lights.fixtures:
        its = room.positions[room.fixtures == fixture.id]
        if len(its):
            assert np.linalg.norm(its.mean(axis=0) - fixture.centre) < 0.5
    assert any((room.fixtures == fixture.id).any() for fixture in room.lights.fixtures)


def test_cross_validation_says_that_albedo_is_more_even(room):
    validation = room.cross_validation
    assert validation.pairs > 100 and validation.albedo < validation.scan
    assert validation.gain == pytest.approx(20 * np.log10(validation.scan / validation.albedo), 0.01)


def test_saves_what_the_program_writes(room, sample, tmp_path):
    report = room.save(tmp_path / "python", usd=True)
    program = os.environ["RELAMP_PROGRAM"]
    options = ["--quality", "draft", "--usd", "-q"]
    command = [program, "delight", sample, *options, "-o", tmp_path / "program"]
    subprocess.run(command, check=True)
    for name in ("albedo.exr", "shading.exr", "emission.exr", "lights.json", "fixtures.png", "scan.glb", "scan.usda"):
        ours, its = ((tmp_path / who / name).read_bytes() for who in ("python", "program"))
        assert ours == its, name
    assert report["crossValidation"]["pairs"] == room.cross_validation.pairs


def test_a_folder_that_is_in_the_way_is_a_sentence(room, tmp_path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(relamp.Error, match="file"):
        room.save(tmp_path / "file")
    assert (tmp_path / "file").read_text() == "mine"


def test_light_is_linear(room):
    """Twice the lamp is twice the light, to a half float's rounding."""
    half, full = (room.bake(fixtures={0: share})[0] for share in ("50%", "on"))
    lit = full > 0.05
    assert lit.mean() > 0.1
    assert np.allclose(full[lit] / half[lit], 2, atol=0.02)


def test_dark_room_is_black(room):
    assert room.relight().picture(size=(32, 18), exposure=0.0).max() < 8


def test_light_after_one_that_was_interrupted_is_the_same(room):
    """What an interrupted light has left must not be in the next."""
    whole = room.bake(fixtures={"all": "on"})[0]

    def refuse(stage, share):
        raise KeyboardInterrupt

    lamps = [{"type": "sphere", "position": [1, 1, z], "radius": 0.2, "radiance": [9, 9, 9]} for z in (-2, -1, 0, 1)]
    with pytest.raises(KeyboardInterrupt):
        room.relight({"lights": lamps * 40}, progress=refuse)
    assert (room.bake(fixtures={"all": "on"})[0] == whole).all()


def test_picture_from_a_camera(room):
    relit = room.relight(fixtures={"all": "on"})
    low, high = room.positions.min(axis=(0, 1)), room.positions.max(axis=(0, 1))
    camera = relamp.Camera(position=tuple((low + high) / 2), target=tuple(high))
    picture = relit.picture(camera, size=(64, 36))
    light = relit.picture(camera, size=(64, 36), linear=True)
    assert picture.shape == light.shape == (36, 64, 3)
    assert picture.dtype == np.uint8 and light.dtype == np.float32
    assert picture.std() > 5 and np.isfinite(light).all()


def test_light_by_dict_or_file_or_a_sentence(room, tmp_path):
    lamp = {"lights": [{"type": "point", "position": [1.5, 1.5, 1.5], "lumens": 80000}]}
    assert room.relight(lamp).radiance[0].mean() > 0.02
    with pytest.raises(relamp.Error, match="fixtures.*must be a list"):
        room.relight({"fixtures": 3})
    assert any("lumenz" in warning for warning in room.relight({"lumenz": 1}).warnings)
    with pytest.raises(relamp.Error, match="nowhere"):
        room.relight(tmp_path / "nowhere.json")
    with pytest.raises(relamp.Error, match="7=on"):
        room.relight(fixtures={7: "on"})
