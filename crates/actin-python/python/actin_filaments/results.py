"""Results of runs, equilibria and fits.

Arrays are read-only and are not copied on access.
"""

from __future__ import annotations

import csv
import json
import os
import sys
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from actin_filaments import _actin, _exports, _html, _plots
from actin_filaments._actin import Scene
from actin_filaments._frame import Frame
from actin_filaments._page import Page
from actin_filaments.errors import RunWarning

if TYPE_CHECKING:
    import pandas
    import pyvista
    import xarray
    from matplotlib.axes import Axes

    from actin_filaments._trade import Trade

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class Certificate:
    """Stability of an equilibrium, from the eigenvalues of its stiffness matrix."""

    negative_eigenvalues: int
    """Number of negative eigenvalues; an equilibrium with any is a saddle."""
    unresolved_eigenvalues: int
    """Number of neutral modes (zero-stiffness modes and rigid motions), whose eigenvalues are zero within `resolution`."""
    resolution: float
    """Smallest magnitude at which an eigenvalue is distinguishable from zero (pN/nm)."""
    residual_force: float
    """Largest residual force on a free point."""
    residual_torque: float
    """Largest residual torque on a free frame."""
    iterations: int
    """Number of Newton iterations."""

    @property
    def stable(self) -> bool:
        """True if all eigenvalues are positive: a minimum of the energy."""
        return self.negative_eigenvalues == 0 and self.unresolved_eigenvalues == 0

    @property
    def words(self) -> str:
        """Description: stable, stable up to neutral modes, or a saddle."""
        negative, neutral = self.negative_eigenvalues, self.unresolved_eigenvalues
        if negative > 0:
            return f"a saddle with {negative} negative eigenvalue{'s' if negative > 1 else ''}"
        return "stable" if neutral == 0 else f"stable up to {neutral} neutral mode{'s' if neutral > 1 else ''}"


@dataclass(frozen=True)
class Fit:
    """Result of a least-squares fit."""

    parameters: Array
    """Fitted values."""
    errors: Array
    """Standard errors; NaN for parameters that are not determined by the data."""
    covariance: Array
    """Covariance matrix of the parameters."""
    residuals: Array
    """Observations minus model."""
    statuses: list[str]
    """Status of each parameter: `Determined`, `Weak`, `Undetermined`, `AtLowerBound`, `AtUpperBound`, `Held`."""
    chi_squared: float
    """Sum of squared residuals, each divided by its standard deviation."""
    degrees_of_freedom: int
    """Number of observations minus the rank of the Jacobian."""
    condition: float
    """Condition number: largest amplification of relative errors of the data."""
    agreeing_starts: int
    """Number of starts that converged to the same minimum."""
    starts: int
    """Number of starts."""

    def _repr_html_(self) -> str:
        rows = zip(self.parameters, self.errors, self.statuses)
        shown = [(f"p[{i}]", f"{p:.6g} ± {error:.2g} ({status})") for i, (p, error, status) in enumerate(rows)]
        freedom = f"{self.chi_squared:.4g} for {self.degrees_of_freedom} degrees of freedom"
        return _html.table("Fit", [*shown, ("chi squared", freedom)])


class Run:
    """Results of a run: arrays over `T` records, `n` points and `m` frames, and a summary.

    A run is also the sequence of its records: `run[-1]`, `run[::10]`, `for frame in run`.
    """

    scene: Scene
    """Resolved scene, with all defaults."""
    summary: dict[str, Any]
    """Contents of `summary.json`."""
    directory: Path | None = None
    """Run directory; `None` for a run in memory."""

    def __init__(
        self, *, scene: Scene, summary: dict[str, Any], arrays: dict[str, Array], bodies: dict[str, Any]
    ) -> None:
        self.scene = scene
        self.summary = summary
        self._arrays = arrays
        self._bodies = bodies

    @staticmethod
    def open(path: str | os.PathLike[str]) -> Run:
        """Reads a run directory; of an unfinished run, the records up to its checkpoint. See `load`."""
        return load(path)

    @property
    def status(self) -> str:
        """`converged`, `completed`, `interrupted`, `failed`, or `unfinished` (a checkpoint without results)."""
        return self.summary["status"]

    @property
    def certificate(self) -> Certificate | None:
        """Stability of the last record; `None` if it is not an equilibrium."""
        found = self.summary["stability"]
        if found is None:
            return None
        return Certificate(
            negative_eigenvalues=found["negative_eigenvalues"],
            unresolved_eigenvalues=found["unresolved_eigenvalues"],
            resolution=found["resolution_pn_per_nm"],
            residual_force=self.summary["residual"]["force_pn"],
            residual_torque=self.summary["residual"]["torque_pn_nm"],
            iterations=self.summary["work"]["newton_iterations"],
        )

    @property
    def notes(self) -> list[str]:
        """All notes on the scene and the run, including warnings."""
        return self.summary["notes"]

    @property
    def warnings(self) -> list[dict[str, str]]:
        """Warnings about the scene and the run: `code` and `message` of each."""
        return self.summary.get("warnings", [])

    @property
    def time_ns(self) -> Array:
        """Time of each record, `[T]`. Not available for equilibria."""
        if self.scene.task == "Equilibrium":
            raise AttributeError("an equilibrium has no time: its records are in path")
        return self._arrays["at"]

    @property
    def path(self) -> Array:
        """Path parameter of each record in stages, `[T]`. Not available for motions."""
        if self.scene.task != "Equilibrium":
            raise AttributeError("a motion has no path: its records are in time_ns")
        return self._arrays["at"]

    @property
    def position_nm(self) -> Array:
        """Positions of points, `[T, n, 3]`, lab frame."""
        return self._arrays["position_nm"]

    @property
    def centre_line_nm(self) -> Array:
        """Centre line, `[T, n, 3]`: nodes of rods, and centres of monomers moved to the filament axis."""
        return self._arrays["centre_line_nm"]

    @property
    def velocity_nm_per_ns(self) -> Array:
        """Velocities of points, `[T, n, 3]`."""
        return self._arrays["velocity_nm_per_ns"]

    @property
    def quaternion(self) -> Array:
        """Orientations of frames, `[T, m, 4]` (w, x, y, z; body to lab)."""
        return self._arrays["quaternion"]

    @property
    def angular_momentum(self) -> Array:
        """Angular momenta of frames, `[T, m, 3]`, body frame (pN nm ns)."""
        return self._arrays["angular_momentum"]

    @property
    def s_nm(self) -> Array:
        """Arc length of points at rest, `[n]`."""
        return self._bodies["s_nm"]

    @property
    def kind(self) -> Indices:
        """Kind of each point, `[n]`, an index of `kind_names`."""
        return self._bodies["kind"]

    @property
    def kind_names(self) -> list[str]:
        """Names of the kinds of points."""
        return self._bodies["kind_names"]

    @property
    def filament(self) -> Indices:
        """Filament of each point, `[n]`."""
        return self._bodies["filament"]

    @property
    def frame_s_nm(self) -> Array:
        """Arc length of frames at rest, `[m]`."""
        return self._bodies["frame_s_nm"]

    @property
    def frame_kind(self) -> Indices:
        """Kind of each frame, `[m]`."""
        return self._bodies["frame_kind"]

    @property
    def frame_filament(self) -> Indices:
        """Filament of each frame, `[m]`."""
        return self._bodies["frame_filament"]

    @property
    def kinetic_pn_nm(self) -> Array:
        """Kinetic energy of each record, `[T]`."""
        return self._arrays["kinetic_pn_nm"]

    @property
    def residual_force_pn(self) -> Array:
        """Largest force on a free point of each record, `[T]`."""
        return self._arrays["residual_force_pn"]

    @property
    def residual_torque_pn_nm(self) -> Array:
        """Largest torque on a free frame of each record, `[T]`."""
        return self._arrays["residual_torque_pn_nm"]

    @cached_property
    def energies_pn_nm(self) -> dict[str, Array]:
        """Energy of each term, `[T]` each."""
        all_of: dict[str, Array] = {}
        for k, name in enumerate(self._bodies["terms"]):
            energy = self._arrays["energies"][:, k]
            all_of[name] = all_of[name] + energy if name in all_of else energy
        return all_of

    @property
    def observables(self) -> dict[str, Array]:
        """Observables of the scene, `[T]` each; NaN before the first value."""
        return {name: self._arrays["observed"][:, k] for k, name in enumerate(self._bodies["columns"])}

    @property
    def tip_nm(self) -> Array:
        """Position of the tip of filament 0 in the last record."""
        if self.status == "unfinished":
            return self.centre_line_nm[-1, np.flatnonzero(self.filament == 0)[-1]]
        return np.array(self.summary["tip_nm"])

    def to_pyvista(self, record: int = -1) -> pyvista.MultiBlock:
        """Converts a record to PyVista blocks: `rod` (lines through nodes) and `monomers` (ellipsoids), if present."""
        from actin_filaments._pyvista import of_record

        return of_record(self, record)

    def to_dataframe(self) -> pandas.DataFrame:
        """Converts time or path, energies, residuals and observables to a table with one row for each record."""
        return _exports.to_dataframe(self)

    def to_xarray(self) -> xarray.Dataset:
        """Converts all arrays to a data set with named dimensions and coordinates."""
        return _exports.to_xarray(self)

    def to_mdanalysis(self) -> Any:
        """Converts to an MDAnalysis `Universe` with points as atoms and filaments as residues (angstrom, ps)."""
        return _exports.to_mdanalysis(self)

    def to_gsd(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> list[Path]:
        """Writes a GSD file for OVITO, HOOMD-blue or MDAnalysis. Returns the written files.

        Positions are centres of monomers and nodes of rods, in single precision and relative to the centre of the box.
        """
        return _exports.export(self, "gsd", path, overwrite)

    def to_simularium(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> list[Path]:
        """Writes a file for the Simularium viewer, and its meshes next to it. Returns the written files."""
        return _exports.export(self, "simularium", path, overwrite)

    def to_vtk(self, folder: str | os.PathLike[str], *, overwrite: bool = False) -> list[Path]:
        """Writes a `.vtp` file for each record and `run.pvd` for ParaView into a folder. Returns the written files."""
        return _exports.export(self, "vtk", folder, overwrite)

    def profile(self, record: int = -1) -> dict[str, Array]:
        """Returns fields along all filaments: `filament`, `s_nm`, `curvature_rad_per_nm`, `twist_rad_per_nm` (relative to
        the helix), `energy_per_length_pn`, and internal loads: `tension_pn` (negative in compression), `shear_pn`,
        `moment_pn_nm` (bending) and `torque_pn_nm`."""
        with _exports.folder(self) as directory:
            return _actin.profile(directory, self[record].index)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Plots energies, and observables in further panels. Returns the axes of the energies.

        With `ax`, plots only energies. Raises `ImportError` without Matplotlib.
        """
        return _plots.of_run(self, ax)

    def plot_profile(self, field: str = "curvature", record: int = -1, ax: Axes | None = None) -> Axes:
        """Plots `curvature`, `twist`, `energy`, `tension`, `shear`, `moment` or `torque` along the filaments, of the first 20 of them. Returns the axes."""
        return _plots.of_profile(self, field, record, ax)

    def view(self) -> Page:
        """Returns the run as an interactive page, which a notebook shows."""
        if self.directory is not None:
            return Page(_actin.page(self.directory))
        with _exports.folder(self) as directory:
            return Page(_actin.page(directory))

    @overload
    def __getitem__(self, record: int) -> Frame: ...
    @overload
    def __getitem__(self, record: slice) -> list[Frame]: ...
    def __getitem__(self, record: int | slice) -> Frame | list[Frame]:
        chosen = range(len(self))[record]
        return [Frame(self, index) for index in chosen] if isinstance(chosen, range) else Frame(self, chosen)

    def __iter__(self) -> Iterator[Frame]:
        return (Frame(self, index) for index in range(len(self)))

    def __len__(self) -> int:
        return len(self._arrays["at"])

    def __repr__(self) -> str:
        counts = self.summary["counts"]
        return (
            f"Run({self.status}, {len(self)} record{'' if len(self) == 1 else 's'}, {counts['monomers']} monomers, "
            f"{counts['segments']} segments)"
        )

    def _repr_html_(self) -> str:
        return _html.table(repr(self), _rows(self))


def _vector(v: list[float]) -> str:
    return "(" + ", ".join(f"{x:.4f}" for x in v) + ")"


def _rows(run: Run) -> list[tuple[str, str]]:
    """Rows of the HTML representation."""
    summary = run.summary
    if run.status == "unfinished":
        return [("scene", summary["scene"] or "untitled"), ("status", "unfinished: records up to the checkpoint")]
    energy = summary["energy_pn_nm"]
    rows = [
        ("scene", summary["scene"] or "untitled"),
        ("tip displacement", f"{_vector(summary['tip_displacement_nm'])} nm"),
        ("energy", f"{energy['total']:.6g} pN nm (elastic {energy['elastic']:.6g})"),
        ("residual", f"{summary['residual']['force_pn']:.1e} pN, {summary['residual']['torque_pn_nm']:.1e} pN nm"),
    ]
    certificate = run.certificate
    if certificate is not None:
        rows.append(("certificate", certificate.words))
    if summary.get("failure"):
        rows.append(("failure", summary["failure"]))
    rows += [(f"warning: {each['code']}", each["message"]) for each in run.warnings]
    messages = {each["message"] for each in run.warnings}
    rows += [("note", note) for note in run.notes if note not in messages]
    return [*rows, ("time", f"{summary['wall_s']:.2f} s")]


class Equilibrium:
    """Equilibrium of a scene: the last record of a run of equilibria."""

    run: Run
    """Run along the whole path."""
    certificate: Certificate
    """Stability of the state."""

    def __init__(self, run: Run) -> None:
        certificate = run.certificate
        if certificate is None:
            raise ValueError("the run has no certificate: its last record is not an equilibrium")
        self.run = run
        self.certificate = certificate

    @property
    def position_nm(self) -> Array:
        """Positions of points, `[n, 3]`, lab frame."""
        return self.run.position_nm[-1]

    @property
    def centre_line_nm(self) -> Array:
        """Centre line, `[n, 3]`."""
        return self.run.centre_line_nm[-1]

    @property
    def quaternion(self) -> Array:
        """Orientations of frames, `[m, 4]` (w, x, y, z; body to lab)."""
        return self.run.quaternion[-1]

    @property
    def s_nm(self) -> Array:
        """Arc length of points at rest, `[n]`."""
        return self.run.s_nm

    @property
    def tip_nm(self) -> Array:
        """Position of the tip of filament 0."""
        return self.run.tip_nm

    @property
    def tip_displacement_nm(self) -> Array:
        """Displacement of that tip from its initial position."""
        return np.array(self.run.summary["tip_displacement_nm"])

    @property
    def energy_pn_nm(self) -> float:
        """Potential energy including loads."""
        return self.run.summary["energy_pn_nm"]["potential"]

    @property
    def elastic_pn_nm(self) -> float:
        """Elastic energy, without loads."""
        return self.run.summary["energy_pn_nm"]["elastic"]

    @property
    def lowest_eigenvalue(self) -> float | None:
        """Lowest non-neutral eigenvalue of the stiffness (pN/nm), if requested by `lowest_eigenvalue` of the task."""
        return self.run.summary["lowest_stiffness_eigenvalue"]

    @property
    def summary(self) -> dict[str, Any]:
        """Contents of `summary.json`."""
        return self.run.summary

    def to_pyvista(self) -> pyvista.MultiBlock:
        """Converts the state to PyVista, as in `Run.to_pyvista`."""
        return self.run.to_pyvista()

    def plot_profile(self, field: str = "curvature", ax: Axes | None = None) -> Axes:
        """Plots a field along the filaments, as in `Run.plot_profile`."""
        return self.run.plot_profile(field, ax=ax)

    def view(self) -> Page:
        """Returns the run as an interactive page, which a notebook shows."""
        return self.run.view()

    def __repr__(self) -> str:
        words = "stable" if self.certificate.stable else "not known to be stable"
        return f"Equilibrium({words}, energy {self.energy_pn_nm:.6g} pN nm)"

    def _repr_html_(self) -> str:
        return _html.table(repr(self), _rows(self.run))


def emit_warnings(found: Run | Trade) -> None:
    """Emits the warnings of a run or a trade, with the location of the caller outside this package."""
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "actin_filaments":
        level, frame = level + 1, frame.f_back
    for each in found.warnings:
        warnings.warn(f"{each['message']} [{each['code']}]", RunWarning, stacklevel=level)


_FORMAT = 1
"""Newest known format of run directories."""


def load(path: str | os.PathLike[str]) -> Run:
    """Reads a run directory.

    Energies are named after the columns of `energies.csv`. Raises `OSError` if a file is missing and `ValueError` for
    a newer format. An unfinished run has the records up to its checkpoint and the status `unfinished`.
    """
    folder = Path(path)
    if not (folder / "summary.json").exists() and (folder / "checkpoint.bin").exists():
        return _unfinished(folder)
    summary = json.loads((folder / "summary.json").read_text())
    if summary.get("format", 1) > _FORMAT:
        raise ValueError(f"{folder} has the format version {summary['format']}: this version of actin_filaments reads up to {_FORMAT}")
    scene = Scene.from_file(folder / "scene.ron")
    arrays: dict[str, Array] = {}
    bodies: dict[str, Any] = {}
    if (folder / "states.npz").exists():
        with np.load(folder / "states.npz") as states:
            read = {name: states[name] for name in states.files}
        for name in ("position_nm", "velocity_nm_per_ns", "centre_line_nm", "quaternion", "angular_momentum"):
            arrays[name] = read[name]
        for name in ("s_nm", "frame_s_nm"):
            bodies[name] = read[name]
        for name in ("kind", "filament", "frame_kind", "frame_filament"):
            bodies[name] = read[name].astype(np.int64)
        bodies["kind_names"] = [str(name) for name in read["kind_names"]]
        bodies |= _monomers(scene, bodies)
    clock, table = _table(folder / "energies.csv")
    arrays["at"] = clock
    for name in ("kinetic_pn_nm", "residual_force_pn", "residual_torque_pn_nm"):
        arrays[name] = table.pop(name)
    bodies["terms"] = [name.removesuffix("_pn_nm") for name in table]
    arrays["energies"] = np.stack(list(table.values()), axis=1)
    observed = _table(folder / "observables.csv")[1] if (folder / "observables.csv").exists() else {}
    bodies["columns"] = list(observed)
    arrays["observed"] = np.stack(list(observed.values()), axis=1) if observed else np.empty((len(clock), 0))
    for array in arrays.values():
        array.flags.writeable = False
    run = Run(scene=scene, summary=summary, arrays=arrays, bodies=bodies)
    run.directory = folder
    return run


def _unfinished(folder: Path) -> Run:
    found = _actin.unfinished(folder)
    summary = {"scene": found["scene"].title, "status": "unfinished", "counts": found.pop("counts")}
    summary |= {"stability": None, "notes": [], "warnings": []}
    run = Run(summary=summary, **found)
    run.directory = folder
    return run


def _table(path: Path) -> tuple[Array, dict[str, Array]]:
    """Reads a CSV file: its first column, and the others by name."""
    with path.open(newline="") as lines:
        names, *rows = csv.reader(lines)
    columns = np.array([[float(x) if x else np.nan for x in row] for row in rows]).reshape(len(rows), len(names))
    return columns[:, 0], dict(zip(names[1:], columns.T[1:]))


def _monomers(scene: Scene, bodies: dict[str, Any]) -> dict[str, Any]:
    """Returns the frame of each point (-1 for nodes), and the semi-axes of monomers."""
    monomer = bodies["kind_names"].index("monomer")
    frame = np.full(len(bodies["kind"]), -1)
    frame[bodies["kind"] == monomer] = np.flatnonzero(bodies["frame_kind"] == monomer)
    keys = scene.to_dict()
    filaments = keys["filaments"] if "filaments" in keys else [keys["filament"]]
    axes = np.array([filament["monomers"]["semi_axes_nm"] for filament in filaments])
    return {"frame": frame, "semi_axes_nm": axes[bodies["filament"]]}
