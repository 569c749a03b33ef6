"""What `progress=True` shows: a line of tqdm where it is installed, and else one of our own."""

from __future__ import annotations

import math
import sys
import time
from typing import Any, Protocol

from .events import Event


class Display(Protocol):
    """Shows the events of one call."""

    def __call__(self, event: Event) -> bool:
        """Takes an event; never ends the call."""

    def end(self, done: bool) -> None:
        """The call has ended: with its result, or before it."""


def display() -> Display:
    """The display that can be had here."""
    try:
        from tqdm import tqdm  # type: ignore[import-untyped,unused-ignore]
    except ImportError:
        return Line()
    return Bar(tqdm)


def told(event: Event) -> str:
    """What is known of a call, in a few words."""
    words = [event.stage, f"{100 * event.share:3.0f} %"]
    if math.isfinite(event.energy):
        words.append(f"energy {event.energy:.6g}")
    # A gap of 100 % and more says no more than that there is a bound of no use.
    if event.gap < 1:
        words.append(f"gap {100 * event.gap:.2f} %")
    return "  ".join(words)


class Bar:
    """A line of tqdm: the stage, the share of the call that is done, energy and gap, and the time."""

    def __init__(self, tqdm: Any) -> None:
        self._bar = tqdm(bar_format="{desc} [{elapsed}]", leave=True, file=sys.stderr)
        self._shown = -math.inf

    def __call__(self, event: Event) -> bool:
        if event.kind == "progress":
            self._bar.set_description_str(told(event), refresh=False)
            now = time.monotonic()
            if now - self._shown > 0.1:
                self._shown = now
                self._bar.refresh()
        return False

    def end(self, done: bool) -> None:
        self._bar.set_description_str("done" if done else "stopped", refresh=False)
        self._bar.close()


class Line:
    """A line on stderr that is overwritten by each event."""

    def __init__(self) -> None:
        self._width = 0
        self._began = time.monotonic()

    def __call__(self, event: Event) -> bool:
        if event.kind == "progress":
            line = f"{told(event)}  {event.seconds:.1f} s"
            sys.stderr.write("\r" + line.ljust(self._width))
            sys.stderr.flush()
            self._width = len(line)
        return False

    def end(self, done: bool) -> None:
        if self._width > 0:
            line = f"{'done' if done else 'stopped'}  {time.monotonic() - self._began:.1f} s"
            sys.stderr.write("\r" + line.ljust(self._width) + "\n")
