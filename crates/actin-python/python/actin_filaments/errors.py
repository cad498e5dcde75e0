"""Exceptions of the package."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from actin_filaments._trade import Trade
    from actin_filaments.results import Run


class RunWarning(UserWarning):
    """A warning about the results of a run; the text ends with its code: `... [law-range]`."""


class ActinError(Exception):
    """Base class of errors of this package."""

    code: str = "error"
    """Stable name of the kind of error, in the manner of `RunWarning`."""
    key: str = ""
    """Path of the key in the scene, as in `filament.sections[1].to_nm`; empty if none is to blame."""
    value: str = ""
    """Value of the key; empty for a structure or a missing value."""


class SceneError(ActinError, ValueError):
    """The scene cannot be read, or a value violates a rule."""

    code = "invalid-scene"
    rule: str = ""
    """Violated rule."""
    line: int | None = None
    """Line in the text of the scene, from 1; `None` without text."""
    column: int | None = None
    """Column in characters, from 1."""
    meant: str | None = None
    """Suggested key or choice."""
    mistakes: list[SceneError] = []
    """All mistakes of a text, in order; empty without text."""


class RunFailed(ActinError, ArithmeticError):
    """A run or solve failed.

    `code`: `diverged`, `path-ended`, `saddle`, `load-below-residual`, `model-limit`, `twist-lost`, `hinge-slipped`, or
    `run-failed`.
    """

    code = "run-failed"
    run: Run | None = None
    """Records before the failure; `None` without records."""
    step: int | None = None
    """Time step at which the failure was found, or number of Newton iterations."""
    time_ns: float | None = None
    """Time of that step."""
    body: str | None = None
    """Body at which the failure occurred."""
    term: str | None = None
    """Force term that acts most strongly on that body."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a run or a trade. A run directory contains a checkpoint."""

    code = "interrupted"
    key = ""
    value = ""
    run: Run | None = None
    """Records so far; `None` without records."""
    trade: Trade | None = None
    """Results of a trade so far; `None` before the reference has ended."""
