"""The exceptions of the package, with attributes that say what they are about."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from actin._trade import Trade
    from actin.results import Run


class RunWarning(UserWarning):
    """A warning on the results of a run, with its code at the end: `... [law-range]`."""


class ActinError(Exception):
    """Any error of this package that has no closer class in Python."""


class SceneError(ActinError, ValueError):
    """A scene that cannot be read, or whose values break a rule."""

    key: str = ""
    """Path of the key, as in `filament.sections[1].to_nm`."""
    value: str = ""
    """The value as read; empty where it is a structure or is missing."""
    rule: str = ""
    """What is wrong, or what the value has to satisfy."""
    line: int | None = None
    """Line in the text of the scene, from 1; none of a scene that was no text."""
    column: int | None = None
    """Column in characters, from 1."""
    meant: str | None = None
    """The key or choice that was probably meant."""
    mistakes: list[SceneError] = []
    """Every mistake of a text, this one first; empty of a scene that was no text."""


class RunFailed(ActinError, ArithmeticError):
    """A run or a solve that broke, or whose result is none. `run` has what was recorded before."""

    run: Run | None = None
    """All records up to the last good one; none where there are none."""
    step: int | None = None
    """The step of a motion at which it was found, or the number of Newton's steps."""
    time_ns: float | None = None
    """The time of that step."""
    body: str | None = None
    """The body where it went wrong."""
    term: str | None = None
    """The term of the model that acts on it most strongly."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C in a run or a trade. `run` has what was recorded; a run directory has a checkpoint."""

    run: Run | None = None
    """All records so far; none where there are none."""
    trade: Trade | None = None
    """Candidates of a trade so far; `None` if the reference had not ended."""
