"""Error and run time of models of a scene."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from actin_filaments import _html, _plots
from actin_filaments._actin import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_KINDS: dict[str, Callable[[str], Any]] = {
    "candidate": str,
    "monomers": int,
    "segments": int,
    "is_best": "true".__eq__,
    "failure": str,
}


class Trade:
    """Models of a scene with their run times and their errors relative to the reference. `n` candidates.

    `print(trade)` shows the table of `actin trade`.
    """

    table: dict[str, NDArray[Any]]
    """Columns by name, `[n]` each, in the order of the runs.

    - `candidate` (name), `monomers`, `segments`, `wall_s` (run time, s);
    - `faster`: run time of the all-monomer model with the default step over `wall_s`;
    - `NAME error` of each compared item, `error` (the largest), `error_at_all_loads`: relative, NaN if unknown;
    - `is_best`, `failure` (empty if there is a result).
    """
    units: dict[str, str]
    """Unit of each compared item."""
    scenes: list[Scene]
    """Scene of each candidate, `[n]`."""
    best: Scene
    """Fastest scene within the target error; the reference if no faster candidate meets it."""
    best_name: str
    """Name of that candidate, or of the reference."""
    reference: dict[str, Any]
    """`name`, `scene`, `monomers`, `segments`, `wall_s` (s), `own_errors` (relative, of each item; `None` if unknown),
    `share` (fraction of the records within the budget), `is_settled` (true if `own_errors` are at most a third of
    `wanted_error`)."""
    left_out: list[str]
    """Quantities and parts of the scene that are not compared, with reasons."""
    scatter: dict[str, float | None] | None
    """Root mean square error of filaments with 64 sampled bonds, of each item; `None` if not computed."""
    wanted_error: float
    """Largest accepted relative error."""

    def __init__(
        self,
        *,
        text: str,
        csv: str,
        units: dict[str, str],
        scenes: list[Scene],
        best: int | None,
        reference: dict[str, Any],
        left_out: list[str],
        scatter: dict[str, float | None] | None,
        wanted_error: float,
    ) -> None:
        self._text = text
        self._csv = csv
        self.table = _table(csv)
        self.units = units
        self.scenes = scenes
        self.best = reference["scene"] if best is None else scenes[best]
        self.best_name = reference["name"] if best is None else str(self.table["candidate"][best])
        self.reference = reference
        self.left_out = left_out
        self.scatter = scatter
        self.wanted_error = wanted_error

    @property
    def warnings(self) -> list[dict[str, str]]:
        """Warnings on the reference: `code` and `message` of each."""
        if self.reference["is_settled"]:
            return []
        own = self.reference["own_errors"].items()
        errors = ", ".join(f"{name} " + ("unknown" if error is None else f"{100.0 * error:.2f} %") for name, error in own)
        message = f"the reference is itself off by more than a third of the wanted error: {errors}"
        return [{"code": "unknown-error", "message": message}]

    def to_csv(self) -> str:
        """The table as CSV, as in `trade.csv`."""
        return self._csv

    def plot(self, ax: Axes | None = None) -> Axes:
        """Plots error versus run time, both logarithmic, with the target error as a line. Returns the axes.

        Errors are those at all loads. Points are numbered as in the legend. Candidates with zero error or without a result
        are not shown. Raises `ImportError` without matplotlib.
        """
        if ax is None:
            ax = _plots.new_axes("Trade.plot", figsize=(10.0, 5.0))
        columns = (self.table[name].tolist() for name in ("wall_s", "error_at_all_loads", "candidate", "failure"))
        shown = [row for row in zip(*columns) if not row[3] and 0.0 < row[1] < np.inf]
        for number, (seconds, error, name, _) in enumerate(sorted(shown), 1):
            ax.plot(seconds, error, "o", label=f"{number} {name}")
            ax.annotate(str(number), (seconds, error), xytext=(3, 3), textcoords="offset points")
        ax.axhline(self.wanted_error, color="black", linestyle="--", label=f"wanted: {100.0 * self.wanted_error:g} %")
        ax.set(xscale="log", yscale="log", xlabel="time (s)", ylabel="largest relative error")
        ax.legend(fontsize="x-small", loc="upper left", bbox_to_anchor=(1.0, 1.0))
        return ax

    def __len__(self) -> int:
        return len(self.scenes)

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"Trade({len(self)} candidates; cheapest within {100.0 * self.wanted_error:g} %: {self.best_name})"

    def _repr_html_(self) -> str:
        columns = (self.table[name].tolist() for name in ("candidate", "wall_s", "error_at_all_loads", "failure"))
        rows = ((name, failure or f"{s:.3g} s, error {100.0 * error:.2f} %") for name, s, error, failure in zip(*columns))
        return _html.table(repr(self), rows)


def _table(text: str) -> dict[str, NDArray[Any]]:
    names, *rows = csv.reader(io.StringIO(text, newline=""))
    kinds = [_KINDS.get(name, _number) for name in names]
    return {name: np.array([kind(row[k]) for row in rows]) for k, (name, kind) in enumerate(zip(names, kinds))}


def _number(text: str) -> float:
    return float(text) if text else np.nan
