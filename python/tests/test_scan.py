import numpy as np
import pytest
import relamp


def box(size=64):
    """The inside of a cube of 3 m, each wall a third of the texture's width and half its height."""
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    positions, uv, triangles = [], [], []
    for axis in range(3):
        for side in range(2):
            wall = np.insert(corners, axis, side, axis=1) * 3
            first = len(positions) * 4
            flip = (side == 0) == (axis == 1)
            order = [[0, 1, 2], [0, 2, 3]] if flip else [[0, 2, 1], [0, 3, 2]]
            triangles += (np.array(order) + first).tolist()
            positions.append(wall)
            uv.append((corners * 0.98 + 0.01 + [axis, side]) / [3, 2])
    texture = np.full((size, size * 3 // 2, 3), 120, np.uint8)
    texture[: size // 8, : size // 8] = 255
    return dict(
        positions=np.concatenate(positions),
        triangles=np.array(triangles, np.int64),
        uv=np.concatenate(uv).astype(np.float32),
        texture=texture,
    )


def test_arrays_become_a_room(tmp_path):
    scan = relamp.Scan(**box(), name="cube")
    assert (scan.name, scan.triangle_count, scan.page_count) == ("cube", 12, 1)
    room = relamp.delight(scan, quality="draft")
    assert room.albedo.shape == (64, 96, 3)
    room.save(tmp_path / "cube")
    assert (tmp_path / "cube" / "cube.glb").exists()


def test_strides_and_types_do_not_matter():
    arrays = box()
    same = dict(
        positions=np.asfortranarray(arrays["positions"].astype(np.float64)),
        triangles=arrays["triangles"].astype(np.uint16),
        uv=np.repeat(arrays["uv"], 2, axis=0)[::2],
        texture=arrays["texture"][::-1][::-1],
    )
    one, other = (relamp.delight(relamp.Scan(**a), quality="draft") for a in (arrays, same))
    assert (one.albedo == other.albedo).all()


@pytest.mark.parametrize(
    "name, change, word",
    [
        ("positions", lambda a: a[:, :2], "positions must be"),
        ("positions", lambda a: a.astype(int), "positions must be"),
        ("positions", lambda a: a * np.nan, "lie at no place"),
        ("uv", lambda a: a[:-1], "uv has"),
        ("triangles", lambda a: a - 5, "no index"),
        ("triangles", lambda a: a + 10**6, "refers to vertex"),
        ("triangles", lambda a: a.astype(float), "triangles must be"),
        ("triangles", lambda a: a[:0], "triangle"),
        ("texture", lambda a: a[..., 0], "texture must be"),
        ("texture", lambda a: a.astype(np.uint16), "texture must be"),
        ("texture", lambda a: a * np.float32(np.nan), "NaN"),
        ("texture", lambda a: a[:0], "texture must be"),
    ],
)
def test_wrong_array_is_a_sentence(name, change, word):
    arrays = box()
    arrays[name] = change(arrays[name])
    with pytest.raises((ValueError, relamp.Error), match=word):
        relamp.Scan(**arrays)


def test_what_is_no_array_is_refused():
    arrays = box()
    arrays["positions"] = [["a", "b", "c"]]
    with pytest.raises((TypeError, ValueError)):
        relamp.Scan(**arrays)


def test_broken_file_is_a_sentence(tmp_path):
    (tmp_path / "broken.glb").write_bytes(b"glTF" + bytes(60))
    with pytest.raises(relamp.Error, match="broken.glb"):
        relamp.delight(tmp_path / "broken.glb")
