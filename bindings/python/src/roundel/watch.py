"""Watches a call: the caller's function, the display on the terminal, cancelling and Ctrl-C."""

from __future__ import annotations

import signal
import threading
from typing import Any, Callable, Optional, TypeVar

from ._handle import Handle
from ._library import ffi, lib
from .errors import ArgumentTypeError, check, refusal
from .events import Progress, event_of
from .progress import Display, display

_Made = TypeVar("_Made")


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a call of this package: a KeyboardInterrupt that keeps the best result so far.

    `incumbent` is what the call would have returned, made from the best integers so far: a `Solution`, a
    `Field`, a `Map` or `Quads`. It is None if the call had no result yet. `map`, interrupted while it
    worked on the field, has the `Field`, of which `roundel.map(field)` makes the map. A second Ctrl-C
    while the result is finished changes nothing.

    Example::

        try:
            quads = roundel.quad("large.obj", quads=20000)
        except KeyboardInterrupt as stop:
            quads = stop.incumbent

    >>> import roundel
    >>> issubclass(roundel.Interrupted, KeyboardInterrupt)
    True
    """

    def __init__(self, incumbent: Any = None) -> None:
        super().__init__()
        #: The best result so far, or None.
        self.incumbent = incumbent

    def __str__(self) -> str:
        found = "nothing was found yet" if self.incumbent is None else f"the best so far is {self.incumbent!r}"
        return f"interrupted; {found}"


class CancelToken:
    """A flag by which any thread may cancel a solve: give it as the keyword `cancel`.

    >>> import roundel
    >>> token = roundel.CancelToken()
    >>> token.cancel()
    >>> token.is_cancelled
    True
    """

    def __init__(self) -> None:
        self._handle = Handle.made("roundel_cancel_token", lib.roundel_cancel_token_new)

    def __repr__(self) -> str:
        return f"<CancelToken: {'set' if self.is_cancelled else 'not set'}>"

    def cancel(self) -> None:
        """Asks every solve with this token to end."""
        check(lib.roundel_cancel_token_cancel(self._handle.pointer))

    def reset(self) -> None:
        """Withdraws the request, so that the token can be used again."""
        check(lib.roundel_cancel_token_reset(self._handle.pointer))

    @property
    def is_cancelled(self) -> bool:
        """Whether the token is set."""
        place = ffi.new("int32_t *")
        check(lib.roundel_cancel_token_is_cancelled(self._handle.pointer, place))
        return bool(place[0])


def _ended_by(error: BaseException) -> int:
    """How a call goes on after an exception of the callback: Ctrl-C finishes a result."""
    is_interrupt = isinstance(error, KeyboardInterrupt)
    return lib.ROUNDEL_FLOW_FINISH if is_interrupt else lib.ROUNDEL_FLOW_CANCEL


class Watch:
    """The monitor of one call. The call releases Python's lock and takes it again for each event.

    Python runs a signal handler when the main thread next runs Python code, which is the callback here.
    While the call lasts, the handler of Ctrl-C takes a note instead of raising KeyboardInterrupt, and the
    callback ends the call. So the library can finish a result, and none is lost between two lines.
    """

    def __init__(self, progress: Progress, cancel: Optional[CancelToken]) -> None:
        if cancel is not None and not isinstance(cancel, CancelToken):
            raise refusal(ArgumentTypeError, f"cancel should be a CancelToken, and is {cancel!r}")
        if progress not in (None, True, False) and not callable(progress):
            raise refusal(ArgumentTypeError, f"progress should be True or a function, and is {progress!r}")
        self._display: Optional[Display] = display() if progress is True else None
        self._tell = self._display or (progress if callable(progress) else None)
        self._caught: Optional[BaseException] = None
        self._interrupted = False
        self._replaced: Any = None
        self._cancel = cancel
        self._callback = ffi.callback("roundel_callback", self._hear, error=1, onerror=self._catch)
        token = cancel._handle.pointer if cancel is not None else ffi.NULL
        size = ffi.sizeof("roundel_monitor")
        self.pointer = ffi.new("roundel_monitor *", [size, self._callback, ffi.NULL, token])

    def __enter__(self) -> Watch:
        # Handlers belong to the main thread, and one that is not Python's own to whoever set it.
        main = threading.current_thread() is threading.main_thread()
        if main and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            self._replaced = signal.signal(signal.SIGINT, self._interrupt)
        return self

    def __exit__(self, *_: Any) -> None:
        if self._replaced is not None:
            signal.signal(signal.SIGINT, self._replaced)

    def _interrupt(self, _signal: int, _frame: Any) -> None:
        self._interrupted = True

    def _hear(self, event: Any, _: Any) -> int:
        if self._caught is not None:
            return _ended_by(self._caught)
        if self._interrupted:
            return lib.ROUNDEL_FLOW_FINISH
        ends = self._tell is not None and self._tell(event_of(event))
        return lib.ROUNDEL_FLOW_CANCEL if ends else lib.ROUNDEL_FLOW_CONTINUE

    def hears(self, kind: str, hear: Callable[..., bool]) -> Any:
        """A callback of another type for the same call. `hear` returns whether the call is to end."""

        def answer(*arguments: Any) -> int:
            if self._caught is not None:
                return _ended_by(self._caught)
            return lib.ROUNDEL_FLOW_CANCEL if hear(*arguments) else lib.ROUNDEL_FLOW_CONTINUE

        return ffi.callback(kind, answer, error=1, onerror=self._catch)

    def _catch(self, _kind: Any, error: BaseException, _trace: Any) -> int:
        self._caught = error
        return _ended_by(error)

    def result(self, status: int, made: Callable[[], _Made], variables: int = 0) -> _Made:
        """What the call made. Raises the exception of the callback, that of Ctrl-C, or that of the status.

        Called after the end of the context. `variables` is the length of a direction, as for `check`.
        """
        if self._display is not None:
            self._display.end(status == lib.ROUNDEL_OK and self._caught is None and not self._interrupted)
        if self._interrupted or isinstance(self._caught, KeyboardInterrupt):
            incumbent = made() if status == lib.ROUNDEL_OK else None
            raise Interrupted(incumbent) from self._caught
        if self._caught is not None:
            raise self._caught
        check(status, variables)
        return made()
