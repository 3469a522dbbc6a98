"""Annotations and stub hold for a person's type checker."""

import subprocess
from pathlib import Path

import relamp


def test_types_hold_under_mypy(tmp_path):
    package = Path(relamp.__file__).parent
    checked = subprocess.run(
        ["mypy", "--strict", f"--cache-dir={tmp_path}", str(package)], capture_output=True, text=True, check=False
    )
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_wrong_use_is_found(tmp_path):
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import relamp\nrelamp.delight('a.glb', quality=3)\nrelamp.delight('a.glb').albedos\n")
    checked = subprocess.run(
        ["mypy", "--strict", f"--cache-dir={tmp_path}", wrong.name],
        cwd=tmp_path,
        env={"MYPYPATH": str(Path(relamp.__file__).parents[1]), "PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert 'has no attribute "albedos"' in checked.stdout
    assert 'Argument "quality"' in checked.stdout
