"""The operator that takes the light out of the selected scan."""

from __future__ import annotations

import shutil
import tempfile

import bpy

from . import hints, preferences, process, program, room, scan_file, state
from .errors import Refusal
from .result import Result

LOOK_EVERY = 0.1  # s


class Job:
    """A scan on its way through relamp, in a temporary folder that goes with it."""

    def __init__(self, context: bpy.types.Context):
        self.folder = tempfile.mkdtemp(prefix="relamp-")
        try:
            objects = scan_file.scan_objects(context)
            settings = _settings(context, objects)
            program.find_program(settings.program)  # before the work of writing
            self.scan = scan_file.write_scan(context, objects, self.folder)
            command = program.command(settings, self.scan.path, self.scan.linear,
                                      f"{self.folder}/result")
            self.run = process.Run(command, self.scan.path)
        except BaseException:
            self.close()
            raise

    def finish(self, context: bpy.types.Context) -> bpy.types.Collection:
        self.run.check()
        result = Result(f"{self.folder}/result")
        objects = self.scan.objects()
        for thing in objects:
            former = state.room_of(thing)
            if former:
                room.remove(former)
        return room.build(context, self.scan, result, objects[0].name)

    def close(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)


class RELAMP_OT_delight(bpy.types.Operator):
    bl_idname = "relamp.delight"
    bl_label = "Take the Light out"
    bl_description = "Find the lamps of the selected scan, and its albedo without their light"
    bl_options = {"REGISTER", "UNDO"}

    job: Job | None = None  # of the running operator; one at a time

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.mode == "OBJECT" and RELAMP_OT_delight.job is None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """From a script: waits until it is done."""
        try:
            job = Job(context)
            try:
                process.wait(job.run)
                return self._done(context, job)
            finally:
                job.run.cancel()
                job.close()
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """From the panel: Blender goes on meanwhile."""
        if bpy.app.background:
            return self.execute(context)
        try:
            RELAMP_OT_delight.job = Job(context)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        context.window_manager.relamp_cancel = False
        self.timer = context.window_manager.event_timer_add(LOOK_EVERY, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "ESC" and event.value == "PRESS" or context.window_manager.relamp_cancel:
            self.cancel(context)
            self.report({"INFO"}, "relamp was cancelled; nothing has changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        job = RELAMP_OT_delight.job
        ended = job.run.poll()
        _show_progress(context, job.run)
        if not ended or context.mode != "OBJECT":  # meshes are not changed under a person's hands
            return {"PASS_THROUGH"}
        try:
            return self._done(context, job)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        finally:
            self.cancel(context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender calls this, too, when it quits or loads another file."""
        stop()
        context.window_manager.event_timer_remove(self.timer)
        if context.workspace:
            context.workspace.status_text_set(None)
        _redraw(context)

    def _done(self, context: bpy.types.Context, job: Job) -> set[str]:
        made = job.finish(context)
        for warning in made.relamp.warnings.splitlines():
            self.report({"WARNING"}, warning)
        self.report({"INFO"}, made.relamp.summary)
        return {"FINISHED"}


class RELAMP_OT_cancel(bpy.types.Operator):
    bl_idname = "relamp.cancel"
    bl_label = "Cancel"
    bl_description = "Stop relamp; nothing is changed"

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.window_manager.relamp_cancel = True
        return {"FINISHED"}


class RELAMP_OT_remove(bpy.types.Operator):
    bl_idname = "relamp.remove"
    bl_label = "Give the Scan back"
    bl_description = "Remove the lights and materials that relamp made; the scan is as it was"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.mode == "OBJECT" and state.room_of(context.object) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        room.remove(state.room_of(context.object))
        return {"FINISHED"}


CLASSES = (RELAMP_OT_delight, RELAMP_OT_cancel, RELAMP_OT_remove)


def stop() -> None:
    """Ends what runs, and leaves nothing of it."""
    job = RELAMP_OT_delight.job
    RELAMP_OT_delight.job = None
    if job:
        job.run.cancel()
        job.close()


def _settings(context: bpy.types.Context, objects: list[bpy.types.Object]) -> program.Settings:
    chosen, own = context.scene.relamp, preferences.current(context)
    return program.Settings(own.program if own else "", chosen.quality,
                            own.threads if own else 0, chosen.sun, chosen.allow_overlap,
                            hints.options(context.scene, objects))


def _show_progress(context: bpy.types.Context, run: process.Run) -> None:
    is_done = run.child.poll() == 0
    context.workspace.status_text_set(
        "relamp is done: go to Object Mode to see it" if is_done and context.mode != "OBJECT" else
        f"relamp: {100 * run.fraction:.0f} %, {run.stage}     Esc: cancel")
    _redraw(context)


def _redraw(context: bpy.types.Context) -> None:
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()
