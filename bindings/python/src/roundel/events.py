"""The events of a solve."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Union

from ._library import lib, text


@dataclass(frozen=True)
class Event:
    """An event of a solve, with the state of the solve.

    A function given as `progress` is called with one:

    >>> import roundel
    >>> seen = []
    >>> field = roundel.field(roundel.Mesh.shape("torus", 200), progress=lambda event: seen.append(event.kind))
    >>> "progress" in seen
    True

    Attributes:

      kind: str
          "progress": a phase has gone on; "log": there is a line of text; "improved": there is a
          better solution than before; "raised": there is a better bound. Later versions may add
          others.
      phase: str
          "eliminate", "factor", "round", "untangle", "quads", or "" if the event is not progress.
      fraction: float
          The fraction of the phase that is done, from 0 to 1.
      text: str
          A line of text, or an empty string.
      seconds: float
          Seconds since the solve began.
      energy: float
          Energy of the best solution so far; infinite before the first.
      lower_bound: float
          The best lower bound so far; minus infinity before the first.
      gap: float
          (energy - lower_bound) / abs(energy): 0 where they are equal, and infinite while either is
          infinite or an energy of 0 is above the bound.
      share: float
          The share of the whole call that is done, from 0 to 1. It never falls.
      stage: str
          What the call works on: "solve", "field", "map", "quads" or "smooth".
    """

    kind: str
    phase: str
    fraction: float
    text: str
    seconds: float
    energy: float
    lower_bound: float
    gap: float
    share: float
    stage: str


#: A function of an event that returns a true value to end the solve, or True for a progress line on
#: stderr.
Progress = Union[bool, Callable[[Event], Any], None]


def _words(prefix: str, *words: str) -> dict[int, str]:
    return {getattr(lib, f"ROUNDEL_{prefix}_{word.upper()}"): word for word in words}


_KINDS = _words("EVENT", "progress", "log", "improved", "raised")
_STAGES = _words("STAGE", "solve", "field", "map", "quads", "smooth")
_PHASES = _words("PHASE", "eliminate", "factor", "round", "untangle", "quads")


def event_of(event: Any) -> Event:
    """The library's event, copied."""
    return Event(
        _KINDS.get(event.kind, "unknown"),
        _PHASES.get(event.phase, ""),
        event.fraction,
        text(event.text),
        event.seconds,
        event.energy,
        event.lower_bound,
        event.gap,
        event.share,
        _STAGES.get(event.stage, "unknown"),
    )
