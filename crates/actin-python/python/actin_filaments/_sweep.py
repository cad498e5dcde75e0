"""Sweeps of scenes over values and seeds."""

from __future__ import annotations

import csv
import math
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from actin_filaments import _html
from actin_filaments._actin import Progress, Scene, carry_out, emit_snakemake
from actin_filaments._optional import required
from actin_filaments.results import Run, load

if TYPE_CHECKING:
    import pandas


KINDS = {"run": int, "point": int, "seed": int, "status": str, "failure": str, "warnings": str}


class Sweep(Mapping[Any, Any]):
    """Results of a sweep: a mapping from the varied values to the runs, and a table.

    `sweep[-1.0, "Fitted"]` is the run with these values, in the order of `parameters`; one value needs no tuple. Runs are
    read on access. Without `out` their files are temporary and last as long as this object. `sweep["tip_nm[0]"]` is a
    column of the table.
    """

    columns: dict[str, NDArray[Any]]
    """One row for each run: varied values, `seed` of samples, status, results. Results of failed runs are NaN."""
    parameters: list[str]
    """Names of the varied columns, with `seed` if there are samples."""
    failed: int
    """Number of failed runs."""

    def __init__(self, columns: dict[str, NDArray[Any]], parameters: list[str], failed: int, folder: Path, kept: Any) -> None:
        self.columns = columns
        self.parameters = parameters
        self.failed = failed
        self._folder = folder
        # A temporary directory is removed with this object.
        self._kept = kept
        rows = zip(*(columns[name].tolist() for name in parameters)) if parameters else iter([()])
        self._runs = {key: number for number, key in enumerate(rows)}

    @overload
    def __getitem__(self, key: str) -> NDArray[Any]: ...
    @overload
    def __getitem__(self, key: tuple[Any, ...] | float) -> Run: ...
    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str) and key in self.columns:
            return self.columns[key]
        values = tuple(getattr(one, "tolist", lambda one=one: one)() for one in (key if isinstance(key, tuple) else (key,)))
        if values not in self._runs:
            known = ", ".join(map(str, [*self._runs][:5]))
            raise KeyError(f"no run and no column {key!r}; parameters {self.parameters} have the values {known}, ...")
        return load(self._folder / "runs" / str(self._runs[values]))

    def __iter__(self) -> Iterator[tuple[Any, ...]]:
        return iter(self._runs)

    def __len__(self) -> int:
        return len(self._runs)

    def __contains__(self, key: object) -> bool:
        return (key if isinstance(key, tuple) else (key,)) in self._runs

    def to_dataframe(self) -> pandas.DataFrame:
        """Converts the table to a data frame with one row for each run."""
        return required("pandas", "Sweep.to_dataframe").DataFrame(self.columns).set_index("run")

    def __repr__(self) -> str:
        return f"Sweep({len(self)} runs, {self.failed} failed; {', '.join(self.columns)})"

    def _repr_html_(self) -> str:
        rows = zip(*self.columns.values())
        shown = [(str(i), ", ".join(str(x) for x in row)) for i, row in zip(range(20), rows)]
        return _html.table(repr(self), shown)


def latin_hypercube(
    bounds: Mapping[str, tuple[float, float]], number: int, *, seed: int = 1
) -> dict[tuple[str, ...], list[tuple[float, ...]]]:
    """Returns values of keys for `sweep`, from a Latin hypercube between lower and upper bounds. Needs SciPy."""
    qmc = required("scipy.stats.qmc", "latin_hypercube")
    lower, upper = np.array(list(bounds.values()), float).T
    rows = qmc.scale(qmc.LatinHypercube(len(bounds), seed=seed).random(number), lower, upper)
    return {tuple(bounds): [tuple(row) for row in rows.tolist()]}


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

    - `vary`: values of keys, such as `{"loads[0].force_pn[0]": np.linspace(-2.0, 0.0, 5)}`; several keys form a grid. A
      tuple of keys is varied together, with a tuple for each set of values, as from `latin_hypercube`.
    - `results`: numbers of `summary.json`, as paths such as `"tip_displacement_nm[0]"`.
    - `samples`: number of runs of each point, with seeds `first_seed`, `first_seed + 1`, ...
    - `out`: sweep directory, which is kept; `resume` continues an earlier sweep in it.
    - `jobs`: number of simultaneous runs, each with one thread; by default the number of cores.

    A failed run is a row with the reason, not an error. Raises `SceneError` for invalid keys, values and results.
    """
    axes = [_axis(keys, values) for keys, values in vary.items()]
    kept = None
    if out is None:
        kept = tempfile.TemporaryDirectory(prefix="actin-sweep-")
        out, resume = Path(kept.name) / "sweep", False
    folder = Path(out)
    _, failed = carry_out(scene, folder, axes, list(results), samples, first_seed, jobs, resume, progress)
    with (folder / "runs.csv").open(newline="") as lines:
        names, *rows = csv.reader(lines)
    columns = {name: _column(name, [row[k] for row in rows]) for k, name in enumerate(names) if samples or name != "seed"}
    parameters = [key for keys, _ in axes for key in keys] + (["seed"] if samples else [])
    return Sweep(columns, parameters, failed, folder, kept)


def snakemake(
    scene: Scene,
    vary: Mapping[str | tuple[str, ...], Iterable[object]],
    results: Iterable[str],
    out: str | os.PathLike[str],
    *,
    samples: int = 0,
    first_seed: int = 1,
) -> int:
    """Writes the sweep of `sweep` as a Snakemake workflow for a cluster into the directory `out`. Returns the number of runs.

    `snakemake --cores all` in `out` makes the runs with the program `actin`; `sweep(..., out=out, resume=True)` reads them.
    """
    axes = [_axis(keys, values) for keys, values in vary.items()]
    return emit_snakemake(scene, Path(out), axes, list(results), samples, first_seed)


def _column(name: str, values: list[str]) -> NDArray[Any]:
    """Converts a column to numbers if possible; missing values become NaN."""
    if name in KINDS:
        return np.array([KINDS[name](value) for value in values])
    try:
        return np.array([float(value) if value else np.nan for value in values])
    except ValueError:
        return np.array(values)
