"""What goes on in Blender's window while relamp works: Esc, Cancel, clicks on the scan, undo.

A window draws between the steps of a script, so these are those of a generator that a timer calls.
"""

from __future__ import annotations

import os
import sys
import time
import traceback
from collections.abc import Iterator

import bpy
import scenes
from relamp_addon import state
from relamp_addon.delight import RELAMP_OT_delight

PATIENCE = 120  # s, where much else runs


def begin() -> None:
    steps = _steps()

    def step() -> float:
        try:
            return next(steps)
        except StopIteration:
            print("all that a person does in the window is done", flush=True)
            os._exit(0)
        except BaseException:
            traceback.print_exc()
            sys.stderr.flush()
            os._exit(1)

    bpy.context.preferences.view.show_splash = False
    bpy.app.timers.register(step, first_interval=0.5, persistent=True)


def _steps() -> Iterator[float]:
    """Yields seconds to wait until the next."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.ops.import_scene.gltf(filepath=f"{scenes.SAMPLE}/scan.glb")
    scenes.look_by(f"{scenes.SAMPLE}/camera.json", 160, 90)
    bpy.data.objects["camera"].select_set(False)
    view = _view()
    view["area"].spaces.active.region_3d.view_perspective = "CAMERA"
    yield 0.3
    yield from _ends_by("Esc")
    yield from _ends_by("Cancel")
    yield from _a_click_is_a_hint()
    yield from _is_done_and_undone()
    yield from _goes_with_its_file()


def _ends_by(how: str) -> Iterator[float]:
    bpy.context.scene.relamp.quality = "high"
    _call(bpy.ops.relamp.delight)
    job = RELAMP_OT_delight.job
    assert job, "it does not run"
    while job.run.fraction == 0:
        yield 0.1
    assert not bpy.ops.relamp.delight.poll(), "a second one could begin"
    if how == "Esc":
        _event("ESC", "PRESS", 0.5, 0.5)
        _event("ESC", "RELEASE", 0.5, 0.5)
    else:
        bpy.ops.relamp.cancel()
    yield from _until(lambda: RELAMP_OT_delight.job is None, how)
    assert job.run.child.returncode == 130, job.run.child.returncode
    assert not os.path.exists(job.folder)
    assert not state.rooms()


def _a_click_is_a_hint() -> Iterator[float]:
    _call(bpy.ops.relamp.hint, kind="SAME")
    for across in (0.4, 0.6):
        yield 0.2
        _event("MOUSEMOVE", "NOTHING", across, 0.5)
        _event("LEFTMOUSE", "PRESS", across, 0.5)
        _event("LEFTMOUSE", "RELEASE", across, 0.5)
    yield from _until(lambda: len(bpy.context.scene.relamp.hints) > 0, "the second click")
    hint, = bpy.context.scene.relamp.hints
    assert hint.thing == hint.other == bpy.data.objects["scan"]
    apart = max(abs(a - b) for a, b in zip(hint.place, hint.other_place))
    assert apart > 0.3, apart
    bpy.context.scene.relamp.hints.clear()


def _is_done_and_undone() -> Iterator[float]:
    bpy.context.scene.relamp.quality = "draft"
    bpy.data.objects["scan"].select_set(True)
    _call(bpy.ops.relamp.delight)
    job = RELAMP_OT_delight.job
    yield from _until(lambda: RELAMP_OT_delight.job is None, "the draft")
    assert not os.path.exists(job.folder)
    assert len(state.rooms()) == 1 and state.rooms()[0].relamp.mode == "ALBEDO"
    yield 0.2
    bpy.ops.ed.undo()
    yield 0.2
    assert not state.rooms()
    slot, = bpy.data.objects["scan"].material_slots
    assert slot.material.name == "Material_0"


def _goes_with_its_file() -> Iterator[float]:
    """And does not come back into the next one."""
    scan = bpy.data.objects["scan"]
    bpy.context.view_layer.objects.active = scan
    scan.select_set(True)
    bpy.context.scene.relamp.quality = "high"
    _call(bpy.ops.relamp.delight)
    job = RELAMP_OT_delight.job
    while job.run.fraction == 0:
        yield 0.1
    with bpy.context.temp_override(**_view()):
        bpy.ops.wm.read_homefile(use_factory_startup=True, load_ui=True)
    yield 0.5
    assert job.run.child.returncode == 130, job.run.child.returncode
    assert not os.path.exists(job.folder)
    assert RELAMP_OT_delight.job is None


def _until(is_so, what: str) -> Iterator[float]:
    begin = time.monotonic()
    while not is_so():
        assert time.monotonic() - begin < PATIENCE, f"{what} did not come to an end"
        yield 0.1


def _view() -> dict:
    window = bpy.context.window_manager.windows[0]
    area = next(one for one in window.screen.areas if one.type == "VIEW_3D")
    region = next(one for one in area.regions if one.type == "WINDOW")
    return {"window": window, "screen": window.screen, "area": area, "region": region}


def _call(operator, **keywords) -> None:
    """As a button of the sidebar does."""
    with bpy.context.temp_override(**_view()):
        assert operator("INVOKE_DEFAULT", **keywords) == {"RUNNING_MODAL"}


def _event(kind: str, value: str, across: float, up: float) -> None:
    """At a place of the 3D view, in shares of it."""
    region = _view()["region"]
    _view()["window"].event_simulate(type=kind, value=value,
                                     x=region.x + int(region.width * across),
                                     y=region.y + int(region.height * up))
