"""Runs as tables, data sets and files of other programs."""

from __future__ import annotations

import csv
import json
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from actin_filaments import _actin
from actin_filaments._optional import required

if TYPE_CHECKING:
    from actin_filaments.results import Run

STATES = ("position_nm", "velocity_nm_per_ns", "centre_line_nm", "quaternion", "angular_momentum")


def clock(run: Run) -> str:
    """Name of the coordinate of records."""
    return "path" if run.scene.task == "Equilibrium" else "time_ns"


def columns(run: Run) -> dict[str, Any]:
    """Returns numbers of all records by name."""
    energies = {f"{name}_pn_nm": values for name, values in run.energies_pn_nm.items()}
    own = {name: run._arrays[name] for name in ("kinetic_pn_nm", "residual_force_pn", "residual_torque_pn_nm")}
    return {clock(run): run._arrays["at"], **energies, **own, **run.observables}


def to_dataframe(run: Run) -> Any:
    pandas = required("pandas", "Run.to_dataframe")
    return pandas.DataFrame(columns(run)).rename_axis("record")


def to_xarray(run: Run) -> Any:
    xarray = required("xarray", "Run.to_xarray")
    at, points, frames = clock(run), "point", "frame"
    shapes = {
        "position_nm": (at, points, "axis"),
        "velocity_nm_per_ns": (at, points, "axis"),
        "centre_line_nm": (at, points, "axis"),
        "quaternion": (at, frames, "component"),
        "angular_momentum": (at, frames, "axis"),
    }
    values = {name: (dimensions, run._arrays[name]) for name, dimensions in shapes.items() if name in run._arrays}
    numbers = columns(run)
    times = numbers.pop(at)
    coordinates: dict[str, Any] = {at: times}
    if values:
        coordinates |= {"axis": ["x", "y", "z"], "component": ["w", "x", "y", "z"]}
        coordinates |= {"s_nm": (points, run.s_nm), "filament": (points, run.filament), "frame_s_nm": (frames, run.frame_s_nm)}
        coordinates["kind"] = points, np.array(run.kind_names)[run.kind]
    return xarray.Dataset(
        {**values, **{name: ((at,), column) for name, column in numbers.items()}},
        coords=coordinates,
        attrs={"title": run.scene.title, "scene": run.scene.to_ron()},
    )


def to_mdanalysis(run: Run) -> Any:
    package = required("MDAnalysis", "Run.to_mdanalysis")
    filaments, residues = np.unique(run.filament, return_inverse=True)
    universe = package.Universe.empty(
        len(run.filament), len(filaments), atom_resindex=residues, residue_segindex=np.arange(len(filaments)),
        n_segments=len(filaments), trajectory=True,
    )
    universe.add_TopologyAttr("names", np.array(run.kind_names)[run.kind].tolist())
    universe.add_TopologyAttr("resids", filaments.tolist())
    times = run._arrays["at"]
    # Angstrom and picoseconds.
    step = 1000.0 * float(times[1] - times[0]) if len(times) > 1 else 1.0
    universe.load_new(10.0 * np.asarray(run.position_nm, np.float32), order="fac", dt=step)
    return universe


def export(run: Run, kind: str, path: str | os.PathLike[str], overwrite: bool) -> list[Path]:
    """Writes a run to a file or folder of another program."""
    with folder(run) as directory:
        return [Path(file) for file in _actin.export(directory, kind, Path(path), overwrite)]


@contextmanager
def folder(run: Run) -> Iterator[Path]:
    """Directory of a run: its own, or a temporary one of a run in memory."""
    if run.directory is not None and (run.directory / "states.npz").exists():
        yield run.directory
        return
    if "position_nm" not in run._arrays:
        raise ValueError("the run has no states: `output.states` of the scene is false")
    keys = run.scene.to_dict()
    if keys.get("crosslinkers") or any(linker.get("kinetics") for linker in keys.get("linkers", [])):
        raise ValueError("a run in memory does not keep the events of its linkers: write a directory with run(..., out=...)")
    with tempfile.TemporaryDirectory(prefix="actin-run-") as temporary:
        # Pages without a title have the name of the folder.
        directory = Path(temporary) / "run"
        directory.mkdir()
        _write(run, directory)
        yield directory


def _write(run: Run, directory: Path) -> None:
    (directory / "scene.ron").write_text(run.scene.to_ron(), encoding="utf-8")
    (directory / "summary.json").write_text(json.dumps(run.summary), encoding="utf-8")
    states: dict[str, Any] = {name: run._arrays[name] for name in STATES}
    states |= {"s_nm": run.s_nm, clock(run): run._arrays["at"]}
    np.savez(directory / "states.npz", **states)
    table = columns(run)
    observed = set(run.observables)
    energies = {name: values for name, values in table.items() if name not in observed}
    names = list(run.energies_pn_nm)
    energies["total_pn_nm"] = sum(run.energies_pn_nm[name] for name in names) + run.kinetic_pn_nm
    _table(directory / "energies.csv", energies)
    if observed:
        _table(directory / "observables.csv", {clock(run): table[clock(run)], **run.observables})


def _table(path: Path, table: dict[str, Any]) -> None:
    with path.open("w", newline="", encoding="utf-8") as lines:
        writer = csv.writer(lines)
        writer.writerow(table)
        writer.writerows(zip(*(np.asarray(column).tolist() for column in table.values())))
