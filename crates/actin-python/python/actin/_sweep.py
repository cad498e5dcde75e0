"""Sweeps of scenes over values and seeds."""

from __future__ import annotations

import csv
import math
import os
import tempfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from actin import _html
from actin._actin import Progress, Scene, carry_out


class Sweep:
    """Results of a sweep, as columns by name."""

    columns: dict[str, NDArray[Any]]
    """One row for each run: varied values, seed, status, results. Results of failed runs are NaN."""
    failed: int
    """Number of failed runs."""

    def __init__(self, columns: dict[str, NDArray[Any]], failed: int) -> None:
        self.columns = columns
        self.failed = failed

    def __getitem__(self, column: str) -> NDArray[Any]:
        return self.columns[column]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def __repr__(self) -> str:
        return f"Sweep({len(self)} runs, {self.failed} failed; {', '.join(self.columns)})"

    def _repr_html_(self) -> str:
        rows = zip(*self.columns.values())
        shown = [(str(i), ", ".join(str(x) for x in row)) for i, row in zip(range(20), rows)]
        return _html.table(repr(self), shown)


def ron(value: object) -> str:
    """Converts a value to RON: numbers, Booleans, lists `[...]`, tuples `(...)`; a string is RON text."""
    if isinstance(value, str):
        return value
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        number = float(value)
        return repr(number) if math.isfinite(number) else str(number).replace("nan", "NaN")
    if isinstance(value, tuple):
        return "(" + ", ".join(ron(each) for each in value) + ")"
    if isinstance(value, (list, np.ndarray)):
        return "[" + ", ".join(ron(each) for each in value) + "]"
    raise TypeError(f"a sweep varies numbers, strings, lists and tuples, not {value!r}")


def _axis(keys: str | tuple[str, ...], values: Iterable[object]) -> tuple[list[str], list[list[str]]]:
    if isinstance(keys, str):
        return [keys], [[ron(value)] for value in values]
    return list(keys), [[ron(value) for value in row] for row in values]  # type: ignore[attr-defined]


def sweep(
    scene: Scene,
    vary: Mapping[str | tuple[str, ...], Iterable[object]],
    results: Iterable[str],
    *,
    samples: int = 0,
    first_seed: int = 1,
    out: str | os.PathLike[str] | None = None,
    jobs: int | None = None,
    resume: bool = False,
    progress: Callable[[Progress], object] | bool | None = None,
) -> Sweep:
    """Runs a scene for all combinations of values, with several seeds each, on all cores.

    - `vary`: values of keys, such as `{"loads[0].force_pn[0]": [...]}`. A tuple of keys is varied together, with a tuple
      for each set of values.
    - `results`: numbers of `summary.json`, as paths such as `"tip_displacement_nm[0]"`.
    - `samples`: number of runs of each point, with seeds `first_seed`, `first_seed + 1`, ...
    - `out`: sweep directory, which is kept; `resume` continues an earlier sweep in it.
    - `jobs`: number of simultaneous runs, each with one thread; by default the number of cores.

    A failed run is a row with the reason, not an error. Raises `SceneError` for invalid keys, values and results.
    """
    axes = [_axis(keys, values) for keys, values in vary.items()]
    if out is None:
        with tempfile.TemporaryDirectory(prefix="actin-sweep-") as folder:
            return _make(scene, Path(folder) / "sweep", axes, list(results), samples, first_seed, jobs, False, progress)
    return _make(scene, Path(out), axes, list(results), samples, first_seed, jobs, resume, progress)


def _make(
    scene: Scene,
    out: Path,
    axes: list[tuple[list[str], list[list[str]]]],
    results: list[str],
    samples: int,
    first_seed: int,
    jobs: int | None,
    resume: bool,
    progress: Any,
) -> Sweep:
    _, failed = carry_out(scene, out, axes, results, samples, first_seed, jobs, resume, progress)
    with (out / "runs.csv").open(newline="") as lines:
        names, *rows = csv.reader(lines)
    return Sweep({name: _column([row[k] for row in rows]) for k, name in enumerate(names)}, failed)


def _column(values: list[str]) -> NDArray[Any]:
    """Converts a column to numbers if possible; missing values become NaN."""
    try:
        return np.array([float(value) if value else np.nan for value in values])
    except ValueError:
        return np.array(values)
