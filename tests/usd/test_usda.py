"""A result's USD scene is what the schemas want, and says what the result says.

A scene that is broken is told.
"""

import json
import re
import shutil

import numpy as np
import pytest
from check_usda import check
from conftest import NAMES, SAMPLE, delight
from usda import prims_below, read


def prims_of(folder):
    scene, = folder.glob("*.usda")
    return dict(prims_below(read(scene)))


def lights_of(folder):
    return {path: prim for path, prim in prims_of(folder).items() if prim.type.endswith("Light")}


def value_of(prim, name):
    return prim.attributes[name].value


def area_of(lamp):
    if lamp.type == "RectLight":
        return value_of(lamp, "inputs:width") * value_of(lamp, "inputs:height")
    discs = {"DiskLight": 1, "SphereLight": 4}[lamp.type]
    return discs * np.pi * value_of(lamp, "inputs:radius") ** 2


@pytest.mark.parametrize("room", ["sample", "vertices"])
def test_a_scene_is_as_the_schemas_have_it(room, request):
    scene, = request.getfixturevalue(room).glob("*.usda")
    assert check(scene) == []


def test_all_triangles_are_there(sample):
    report = json.loads((sample / "report.json").read_text())
    meshes = [prim for prim in prims_of(sample).values() if prim.type == "Mesh"]
    faces = sum(len(value_of(mesh, "faceVertexCounts")) for mesh in meshes)
    assert faces == report["scan"]["triangles"]
    assert {"scan.usda", "emission.exr"} <= {file["name"] for file in report["files"]}


def test_lamps_stand_where_they_are_and_send_what_they_send(sample):
    lamps = {}
    for prim in lights_of(sample).values():
        if "fixture" in prim.metadata.get("customData", {}):
            lamps.setdefault(prim.metadata["customData"]["fixture"], []).append(prim)
    fixtures = json.loads((sample / "lights.json").read_text())["fixtures"]
    assert {fixture["id"] for fixture in fixtures} == set(lamps) and len(lamps) >= 2
    for fixture in fixtures:
        sent = 0
        for lamp in lamps[fixture["id"]]:
            place = np.array(value_of(lamp, "xformOp:transform"))
            assert lamp.metadata["customData"]["name"].startswith(fixture["name"])
            assert np.linalg.norm(place[3, :3] - fixture["centre"]) < 0.25
            radiance = value_of(lamp, "inputs:intensity") * np.array(value_of(lamp, "inputs:color"))
            sent = sent + area_of(lamp) * radiance
        place = np.array(value_of(lamps[fixture["id"]][0], "xformOp:transform"))
        forward = -place[2, :3]  # it shines along its -z
        assert forward == pytest.approx(fixture["normal"], abs=1e-3)
        assert sent == pytest.approx(fixture["area"] * np.array(fixture["radiance"]), rel=1e-4)


def test_names_are_kept_beside_what_usd_can_call_things(vertices):
    meshes = [prim for prim in prims_of(vertices).values() if prim.type == "Mesh"]
    assert [mesh.metadata["customData"]["name"] for mesh in meshes] == NAMES[:-1] + ["mesh 5"]
    names = [mesh.name for mesh in meshes]
    assert names == ["_2nd_wall", "wall__a____b", "K_che___", "wall", "wall_2", "mesh_5"]


def test_vertices_shine_where_they_are_a_lamp(vertices):
    ceiling = prims_of(vertices)["/Room/Geometry/wall__a____b"]
    emission = value_of(ceiling, "primvars:emission")
    lamp, = json.loads((vertices / "lights.json").read_text())["fixtures"]
    shining = emission.any(axis=1)
    assert 0 < shining.sum() < 100
    wanted = np.tile(lamp["radiance"], (shining.sum(), 1))
    assert emission[shining] == pytest.approx(wanted, rel=1e-3)


def test_threads_change_no_byte(sample, tmp_path):
    delight(SAMPLE, "--usd", "-o", tmp_path / "one", "--threads", "1")
    for name in ("scan.usda", "emission.exr"):
        assert (tmp_path / "one" / name).read_bytes() == (sample / name).read_bytes()


def test_is_only_written_where_asked_for_and_never_over_a_strangers(tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "scan.usda").write_text("mine")
    refused = delight(SAMPLE, "--usd", "-o", out, check=False)
    assert refused.returncode == 1 and "scan.usda" in refused.stderr
    assert [file.name for file in out.iterdir()] == ["scan.usda"]
    delight(SAMPLE, "-o", out)
    assert (out / "scan.usda").read_text() == "mine" and not (out / "emission.exr").exists()
    delight(SAMPLE, "--usd", "--force", "-o", out)
    assert check(out / "scan.usda") == []
    delight(SAMPLE, "-o", out)  # the scene was of the former result
    assert not (out / "scan.usda").exists() and not (out / "emission.exr").exists()


BROKEN = [
    ("#usda 1.0", "#usd 1.0", "#usda 1.0"),
    ('upAxis = "Y"', 'upAxis = "Z"', "upAxis"),
    ('defaultPrim = "Room"', 'defaultPrim = "House"', "defaultPrim"),
    ('string light = "lamps"', 'string light = "none"', "variant none"),
    ('def Scope "Materials"', 'def Scope "9 materials"', "no name of a prim"),
    ("float inputs:roughness", "double inputs:roughness", "of type double"),
    ("float inputs:roughness", "float inputs:roughnes", "no such attribute"),
    ("uniform token subdivisionScheme", "token subdivisionScheme", "of type token"),
    ('subdivisionScheme = "none"', 'subdivisionScheme = "smooth"', "may not be smooth"),
    ("faceVertexCounts = [3, 3", "faceVertexCounts = [3, 4", "corners, but"),
    ("faceVertexCounts = [3, 3", "faceVertexCounts = [3, nan", "no usda|not all elements|no int"),
    ("faceVertexIndices = [", "faceVertexIndices = [9999999, ", "beyond its"),
    ("points = [(", "points = [(nan, 0, 0), (", "not all elements"),
    ("points = [(", "points = [(1e999, 0, 0), (", "no point3f"),
    ("points = [(", "points = [(-99, 0, 0), (", "extent"),
    ("primvars:st = [(", "primvars:st = [(0, 0), (", "values of"),
    ('interpolation = "vertex"', 'interpolation = "corner"', "interpolation"),
    ("normals = [(", "normals = [(1, 1, 1), (", "unit length|values of"),
    ("@./albedo.png@", "@./albedo.jpg@", "not there"),
    ("binding = </Room/Materials/page_0>", "binding = </Room/Materials/page_1>", "no material"),
    ("/albedo.outputs:rgb>", "/albedo.outputs:color>", "not there"),
    ("/albedo.outputs:rgb>", "/albedo.outputs:a>", "leads to a float"),
    ('["MaterialBindingAPI"]', '["OtherAPI"]', "MaterialBindingAPI"),
    ("float inputs:width", "bool inputs:normalize = 2\n            float inputs:width", "no bool"),
    ("float inputs:width", "bool inputs:normalize = 1\n    float inputs:width", "normalized"),
    ("active = false", "active = 7", "active"),
    ("active = false", "inactive = true", "inactive"),
    ("float inputs:intensity = ", "float inputs:intensity = -", "no brightness"),
    ("float inputs:width = ", "float inputs:width = -", "not above 0"),
    ("xformOp:transform = ((", "xformOp:transform = ((2", "more than a turn"),
    ('over "page_0"', 'over "page_7"', "nothing that is defined"),
    ('def RectLight "', 'def RectangleLight "', "no schema of a RectangleLight"),
    ('def Scope "Lights"\n    {', 'def Scope "Lights"\n    ', "has to be"),
]


@pytest.fixture(scope="module")
def small(sample, tmp_path_factory):
    """The folder of the sample's scene with two triangles of all."""
    folder = tmp_path_factory.mktemp("small")
    for name in ("albedo.png", "emission.exr"):
        shutil.copy(sample / name, folder)
    text = (sample / "scan.usda").read_text()
    for name, others in (("normals", 5), ("points", 3), ("primvars:st", 3)):
        text = re.sub(rf"({name} = \[(?:\([^)]*\), ){{{others}}}\([^)]*\))[^\]]*", r"\1", text)
    points = re.search(r"points = \[([^]]*)", text)[1]
    corners = np.array(re.findall(r"[^(), ]+", points), dtype=float).reshape(4, 3)
    ends = (corners.min(axis=0), corners.max(axis=0))
    extent = ", ".join(str(tuple(float(x) for x in end)) for end in ends)
    text = re.sub(r"extent = [^\n]*", f"extent = [{extent}]", text)
    text = re.sub(r"Counts = [^\n]*", "Counts = [3, 3]", text)
    text = re.sub(r"Indices = [^\n]*", "Indices = [0, 1, 2, 2, 1, 3]", text)
    (folder / "scan.usda").write_text(text)
    assert check(folder / "scan.usda") == []
    return folder


@pytest.mark.parametrize("right, wrong, complaint", BROKEN)
def test_a_broken_scene_is_told(small, right, wrong, complaint):
    text = (small / "scan.usda").read_text()
    assert right in text
    broken = small / "broken.usda"
    broken.write_text(text.replace(right, wrong, 1))
    told = check(broken)
    assert any(re.search(complaint, one) for one in told), told


def test_a_scene_that_ends_early_is_told(small):
    text = (small / "scan.usda").read_text()
    for end in range(1, len(text) - 2, 97):
        (small / "broken.usda").write_text(text[:end])
        assert check(small / "broken.usda"), end
