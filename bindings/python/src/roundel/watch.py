"""Watches a solve: the caller's function, the progress line on the terminal, and Ctrl-C."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Any, Callable, Optional, Union

from ._handle import Handle
from ._library import ffi, lib, text
from .errors import check


@dataclass(frozen=True)
class Event:
    """An event of a solve, with the state of the solve."""

    #: "progress", "log", "improved" or "raised"; later versions may add others.
    kind: str
    #: "eliminate", "factor", "round", "untangle", "quads", or "" if the event is not progress.
    phase: str
    #: The fraction of the phase that is done, from 0 to 1.
    fraction: float
    #: A line of text, or an empty string.
    text: str
    #: Seconds since the solve began.
    seconds: float
    #: Energy of the best solution so far; infinite before the first.
    energy: float
    #: The best lower bound so far; minus infinity before the first.
    lower_bound: float
    #: (energy - lower_bound) / abs(energy): 0 where they are equal, and infinite while either is
    #: infinite or an energy of 0 is above the bound.
    gap: float


#: A function of an event that returns a true value to end the solve, or True for a progress line on
#: stderr.
Progress = Union[bool, Callable[[Event], Any], None]


def _words(prefix: str, *words: str) -> dict[int, str]:
    return {getattr(lib, f"ROUNDEL_{prefix}_{word.upper()}"): word for word in words}


_KINDS = _words("EVENT", "progress", "log", "improved", "raised")
_PHASES = _words("PHASE", "eliminate", "factor", "round", "untangle", "quads")


class CancelToken:
    """A flag by which any thread may cancel a solve.

    >>> import roundel
    >>> token = roundel.CancelToken()
    >>> token.cancel()
    >>> token.is_cancelled
    True
    """

    def __init__(self) -> None:
        self._handle = Handle.made("roundel_cancel_token", lib.roundel_cancel_token_new)

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


class Watch:
    """The monitor of one call. The call releases Python's lock and takes it again for each event.

    Python runs a signal handler when the main thread next runs Python code, which is this callback.
    So a KeyboardInterrupt is raised in the callback, ends the solve, and is raised again by `check`.
    """

    def __init__(self, progress: Progress, cancel: Optional[CancelToken]) -> None:
        self._line = Line() if progress is True else None
        self._tell = self._line or (progress if callable(progress) else None)
        self._caught: Optional[BaseException] = None
        self._cancel = cancel
        self._callback = ffi.callback("roundel_callback", self._hear, error=1, onerror=self._catch)
        token = cancel._handle.pointer if cancel is not None else ffi.NULL
        size = ffi.sizeof("roundel_monitor")
        self.pointer = ffi.new("roundel_monitor *", [size, self._callback, ffi.NULL, token])

    def _hear(self, event: Any, _: Any) -> int:
        if self._caught is not None:
            return 1
        if self._tell is None:
            return 0
        return 1 if self._tell(_event(event)) else 0

    def _catch(self, _kind: Any, error: BaseException, _trace: Any) -> None:
        self._caught = error

    def check(self, status: int, variables: int = 0) -> None:
        """Raises the exception of the callback, or else that of the status."""
        if self._line is not None:
            self._line.end()
        if self._caught is not None:
            raise self._caught
        check(status, variables)


def _event(event: Any) -> Event:
    return Event(
        _KINDS.get(event.kind, "unknown"),
        _PHASES.get(event.phase, ""),
        event.fraction,
        text(event.text),
        event.seconds,
        event.energy,
        event.lower_bound,
        event.gap,
    )


class Line:
    """A progress line on stderr that is overwritten by each event."""

    def __init__(self) -> None:
        self._width = 0

    def __call__(self, event: Event) -> bool:
        if event.kind == "progress":
            line = f"{event.phase:9} {100 * event.fraction:3.0f} %  {event.seconds:.1f} s"
            sys.stderr.write("\r" + line.ljust(self._width))
            sys.stderr.flush()
            self._width = len(line)
        return False

    def end(self) -> None:
        if self._width > 0:
            sys.stderr.write("\n")
