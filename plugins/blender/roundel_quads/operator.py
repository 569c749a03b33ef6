# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator: it reads the object, makes quads in a thread of its own, and places them."""

import threading

import bpy
import roundel

from . import making, result, surface

#: Seconds between two looks at the thread.
PAUSE = 0.1
#: Events that turn and move the view.
LOOKING = {"MIDDLEMOUSE", "MOUSEMOVE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "TRACKPADPAN", "TRACKPADZOOM"}


class Job:
    """Quads in the making. What the thread tells, the main thread reads."""

    def __init__(self, given, request):
        self.share = 0.0
        self.stage = ""
        self.made = None
        self.error = None
        self._is_to_end = False
        self._thread = threading.Thread(target=self._run, args=(given, request), daemon=True)

    def start(self):
        self._thread.start()

    def end(self):
        """Asks for the best quads so far."""
        self._is_to_end = True

    @property
    def is_done(self):
        return not self._thread.is_alive()

    def _run(self, given, request):
        try:
            self.made = making.make(given, request, self._hear)
        except BaseException as error:
            # It is raised in the main thread.
            self.error = error

    def _hear(self, stage, share):
        self.stage, self.share = stage, share
        if self._is_to_end:
            raise KeyboardInterrupt


class ROUNDEL_OT_quads(bpy.types.Operator):
    """Make a mesh of quads that follows the shape. Esc ends early, with the best quads so far"""

    bl_idname = "object.roundel_quads"
    bl_label = "Make Quads"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and context.object is not None and context.object.type == "MESH"

    def execute(self, context):
        """Makes the quads at once, for scripts."""
        if not self._read(context):
            return {"CANCELLED"}
        try:
            made = making.make(self._given, self._request)
        except roundel.Error as error:
            return self._refused(error)
        return self._place(context, made)

    def invoke(self, context, _event):
        if not self._read(context):
            return {"CANCELLED"}
        self._job = Job(self._given, self._request)
        self._job.start()
        manager = context.window_manager
        self._timer = manager.event_timer_add(PAUSE, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        job = self._job
        if event.type == "ESC":
            job.end()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            # The view may turn; a change of the mesh would be lost.
            return {"PASS_THROUGH"} if event.type in LOOKING else {"RUNNING_MODAL"}
        if not job.is_done:
            text = f"Quads: {job.stage or 'reading'}, {100 * job.share:.0f} %. Esc: end with the best so far"
            context.workspace.status_text_set(text)
            return {"RUNNING_MODAL"}
        self._clean(context)
        if isinstance(job.error, KeyboardInterrupt):
            self.report({"WARNING"}, "Ended before there were any quads")
            return {"CANCELLED"}
        if job.error is not None:
            return self._refused(job.error)
        return self._place(context, job.made)

    def _read(self, context):
        subject = context.object
        settings = subject.data.roundel
        try:
            self._given = surface.of_object(subject, context.evaluated_depsgraph_get())
        except surface.Refused as error:
            self.report({"ERROR"}, str(error))
            return False
        self._subject = subject
        mirror = [axis for axis in "xyz" if axis in settings.mirror]
        self._request = making.Request(settings.count, settings.adapt, mirror)
        return True

    def _place(self, context, made):
        result.place(context, self._subject, made, self._given.is_smooth)
        self.report({"INFO"} if made.conforming else {"WARNING"}, made.words)
        return {"FINISHED"}

    def _refused(self, error):
        self.report({"ERROR"}, str(error))
        return {"CANCELLED"}

    def _clean(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)
