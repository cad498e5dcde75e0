"""Native module of the package `actin_filaments`."""

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from actin_filaments._loads import Bodies, Loads
from actin_filaments._page import Page
from actin_filaments._trade import Trade
from actin_filaments.results import Certificate, Fit, Run
from actin_filaments.scenes import SceneKeys

__all__ = [
    "Progress",
    "Rod",
    "Scene",
    "System",
    "__version__",
    "carry_out",
    "emit_snakemake",
    "export",
    "fit",
    "fit_linear",
    "page",
    "profile",
    "run",
    "scene_schema",
    "trade",
    "unfinished",
]

__version__: str

_Array = NDArray[np.float64]
_Path = str | os.PathLike[str]
_Clamp = Literal["Wall", "NodeAndFrame", "TwoNodesAndFrame", "Pin"]
_Scheme = Literal["position-verlet", "velocity-verlet", "pefrl", "vefrl", "forest-ruth", "suzuki"]

@final
class Scene:
    """Model and task: filaments, clamps, loads, linkers, and the computation.

    Keys and rules are those of scene files. In dictionaries, a choice with keys is a dictionary with one entry
    (`{"Rod": {"from_nm": 0.0, "to_nm": 40.0}}`), and a choice without keys is a string (`"Start"`). Scenes are
    immutable: `set` and `reseed` return new scenes. Invalid scenes raise `SceneError`.
    """

    def __new__(cls, **keys: Unpack[SceneKeys]) -> Scene:
        """Creates a scene from its keys: `Scene(filament={...}, clamps=[...], task={...})`."""
    @staticmethod
    def from_dict(keys: Mapping[str, Any], folder: _Path = ...) -> Scene:
        """Creates a scene from a dictionary. Paths of point files are relative to `folder`."""
    @staticmethod
    def from_ron(text: str, folder: _Path = ...) -> Scene:
        """Creates a scene from the text of a scene file."""
    @staticmethod
    def from_file(path: _Path) -> Scene:
        """Reads a scene file."""
    def to_ron(self) -> str:
        """Returns the text of the scene, with all defaults."""
    def to_dict(self) -> Any:
        """Returns the keys of the scene, with defaults except omitted ones."""
    def set(self, key: str, value: Any) -> Scene:
        """Returns the scene with another value of a key: `scene.set("loads[0].force_pn[0]", -1.0)`."""
    def with_(self, changes: Mapping[str, Any] | None = None, /, **keys: Any) -> Scene:
        """Returns the scene with other values: `scene.with_({"linkers[*].stiffness_pn_per_nm": 2.0}, title="stiff")`.

        A key is a path as in `set`, or has `[*]` for all elements of a list.
        """
    def view(self) -> Page:
        """Returns the initial state as an interactive page, which a notebook shows."""
    def reseed(self, seed: int) -> Scene:
        """Returns the scene with all its seeds set."""
    def check(self) -> dict[str, Any]:
        """Resolves the scene and estimates its cost. Writes nothing.

        Keys: `scene` (with time step), `counts`, `time_step_ns` and `steps` of a motion, `cost`, `notes`, and run
        times on one core, measured for up to 0.2 s: `seconds_per_step` and `seconds` of the whole run, which are
        `None` for an equilibrium that takes longer.
        """
    @property
    def title(self) -> str:
        """Title of the scene."""
    @property
    def task(self) -> Literal["Equilibrium", "Dynamics", "Brownian"]:
        """Kind of computation."""
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def _repr_html_(self) -> str: ...
    def _page(self) -> str:
        """Returns the HTML page of the initial state."""

@final
class Progress:
    """Progress of a run."""

    @property
    def share(self) -> float:
        """Completed fraction of the run, from 0 to 1."""
    @property
    def at(self) -> float:
        """Time (ns), stages of a path, or runs of a sweep."""
    @property
    def end(self) -> float:
        """Final value of `at`."""
    @property
    def unit(self) -> Literal["ns", "stages", "runs"]:
        """Unit of `at`: `ns`, `stages` or `runs`."""
    @property
    def steps(self) -> int:
        """Number of time steps made."""
    @property
    def residual_force_pn(self) -> float:
        """Largest force on a free point (pN)."""
    @property
    def seconds(self) -> float:
        """Time since the start of the run (s)."""

@final
class Rod:
    """Indices of a rod's bodies in a `System`."""

    @property
    def points(self) -> tuple[int, int]:
        """First point, and one past the last."""
    @property
    def frames(self) -> tuple[int, int]:
        """First frame of a segment, and one past the last; frames of walls are not included."""
    @property
    def start_wall(self) -> int | None:
        """Fixed frame before the first segment, if there is a wall."""
    @property
    def end_wall(self) -> int | None:
        """Fixed frame after the last segment, if there is a wall."""
    @property
    def length(self) -> float:
        """Rest length."""

@final
class System:
    """Points, frames and interactions that are assembled and advanced step by step.

    Points have positions `[n, 3]` and velocities; frames have orientations `[m, 4]` (w, x, y, z; body to lab)
    and angular momenta (body frame). Any consistent units can be used; scenes use nm, pN and ns. Arrays are
    read-only copies: assign a whole array to change the state.
    """

    position: _Array
    """Positions of points, `[n, 3]`, which can be set."""
    velocity: _Array
    """Velocities of points, `[n, 3]`, which can be set."""
    quaternion: _Array
    """Orientations of frames, body to lab, `[m, 4]` in the order w, x, y, z. Can be set to unit quaternions."""
    angular_momentum: _Array
    """Angular momenta of frames, body frame, `[m, 3]`, which can be set."""

    def __new__(cls) -> System:
        """Creates a system without bodies."""
    @staticmethod
    def from_scene(scene: Scene) -> System:
        """Creates the system of a scene in its initial state, with the method, time step, drag and noise of its task.

        In a motion, steps follow load factors over time and the path of the scene. For equilibria, `set_path` moves
        along the path. Steps of a `Brownian` scene have its fluid and its noise.
        """
    def add_points(self, position: ArrayLike, mass: ArrayLike) -> int:
        """Adds points `[k, 3]` at rest, with one mass for all or one each. Returns the index of the first."""
    def add_rod(
        self,
        nodes: ArrayLike,
        *,
        shear: ArrayLike,
        bend: ArrayLike,
        mass_per_length: float,
        area: float,
        lengths: ArrayLike | None = None,
        normal: ArrayLike | None = None,
        start: _Clamp | None = None,
        end: _Clamp | None = None,
        rest_shape: Literal["straight", "placed"] = "straight",
        rigid_segments: bool = False,
    ) -> Rod:
        """Adds a Cosserat rod along nodes `[k + 1, 3]`, with k segments and a frame on each.

        - `shear`: rigidities S1, S2 (shear) and S3 (stretch), in units of force.
        - `bend`: rigidities B1, B2 (bending) and B3 (twist), in units of force times area.
        - `lengths`: rest lengths of segments; by default the distances between nodes.
        - `normal`: approximate direction of the first axis of the first frame, which is transported along the nodes
          without twist.
        - `rest_shape`: `"placed"` makes the given shape stress-free.
        - `rigid_segments`: adds the rotational inertia of rigid segments, which allows longer time steps.
        """
    def add_springs(self, pairs: Sequence[Sequence[int]], stiffness: float, rest_length: float) -> int:
        """Adds springs between pairs of points. Returns a number for `remove`."""
    def add_linker(
        self,
        place: tuple[Rod | int, float],
        to: tuple[Rod | int, float] | ArrayLike,
        *,
        stiffness: float,
        rest_length: float = 0.0,
    ) -> int:
        """Adds a linker: a spring between two places on axes of filaments, or between a place and a fixed point. Returns a
        number for `remove`.

        - `place`, `to`: `(rod, s)`, or `(index of a filament of the scene, s)` with the arc length `s`; `to` can also be
          a fixed position `[3]`.
        """
    def add_weight(self, acceleration: ArrayLike) -> int:
        """Adds the weight of all points. Returns the index of its factor."""
    def add_force(self, points: Sequence[int], force: ArrayLike) -> int:
        """Adds a force of constant direction, divided equally among points. Returns the index of its factor."""
    def add_field(
        self,
        force: Callable[[_Array], ArrayLike],
        energy: Callable[[_Array], float] | None = None,
        *,
        differences: bool = False,
    ) -> int:
        """Adds forces on points as a function of all positions, `[n, 3]` to `[n, 3]`, and optionally their energy.
        Returns a number for `remove`.

        - `differences`: as in `add_loads`.
        """
    def add_loads(
        self, function: Callable[[Bodies], Loads | ArrayLike], *, differences: bool = False, name: str = "field"
    ) -> int:
        """Adds the loads of `function(bodies)`, where `bodies` has `time`, `position`, `velocity`, `quaternion` and
        `angular_momentum`. Returns a number for `remove`.

        The function returns `Loads`, or an array of forces `[n, 3]`. It is called once for each evaluation of the loads:
        once a step by position Verlet, four times by PEFRL, several times in an equilibrium or a `Brownian` step, which
        require energy and stiffness. It is called here as well, with the present state.

        - `differences`: computes a missing stiffness from differences of the loads, in six calls for each body.
        - `name`: name of the term in `energies`.
        """
    def remove(self, number: int) -> None:
        """Removes springs, a linker, a field or loads, by the number returned when they were added."""
    def copy(self) -> System:
        """Returns an independent copy in the present state. Functions of fields are shared."""
    def __copy__(self) -> System: ...
    def __deepcopy__(self, memo: dict[int, Any], /) -> System: ...
    def apply_force(self, force: ArrayLike) -> None:
        """Sets additional forces on points, `[n, 3]`, replacing those of earlier calls."""
    def apply_torque(self, torque: ArrayLike) -> None:
        """Sets additional torques on frames, lab frame, `[m, 3]`, replacing those of earlier calls."""
    def hold(self, points: Sequence[int] = ..., frames: Sequence[int] = ...) -> None:
        """Fixes points and frames at their current positions and orientations, and ends their prescribed motion."""
    def release(self, points: Sequence[int] = ..., frames: Sequence[int] = ...) -> None:
        """Releases fixed points and frames, at rest."""
    def drive(
        self,
        times: ArrayLike,
        *,
        points: Sequence[int] = ...,
        frames: Sequence[int] = ...,
        displacement: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
        about: ArrayLike | None = None,
        slides: ArrayLike | None = None,
    ) -> None:
        """Prescribes a rigid motion of points and frames.

        - `times`: times since now, ascending from 0. Between them, displacement and rotation vector are
          interpolated linearly; after the last, the bodies are fixed.
        - `displacement`: `[t, 3]`, relative to the current positions.
        - `rotation`: rotation vectors `[t, 3]` (rad, lab frame), relative to the current orientations.
        - `about`: centre of rotation, which moves with the displacement; by default the first point.
        - `slides`: direction along which the points slide freely as one body.
        """
    def set_path(self, u: float) -> None:
        """Sets loads and clamps to their values after `u` stages of the path, for a scene of equilibria."""
    def set_factor(self, load: int, factor: float) -> None:
        """Sets the factor of a load, by its index in the scene or as returned when it was added."""
    def step(
        self,
        number: int = 1,
        *,
        h: float | None = None,
        scheme: _Scheme | None = None,
        drag: Sequence[float] | None = None,
        thermal_energy: float | None = None,
        seed: int | None = None,
    ) -> None:
        """Makes time steps of length `h`, by default half the longest stable time step.

        - `scheme`: splitting method.
        - `drag`: damping rates of velocities and of angular momenta.
        - `thermal_energy`: k T of the noise that balances the drag; `seed` is 1 by default.

        Settings are kept for later calls. The default `h` is estimated again after bodies, terms or clamps have
        been added and after `scheme` has changed. `step(a)` and `step(b)` together equal `step(a + b)` bitwise.
        Ctrl-C ends the steps. For a `Brownian` scene, `h` is the only setting: fluid and noise are those of the scene.

        Raises `RunFailed` if the motion diverges. The system then is in the last valid state, at `steps` and
        `time`.
        """
    def stable_step(self, scheme: _Scheme | None = None, safety: float = ...) -> float:
        """Returns the longest stable time step of a method at the current stiffness, times `safety`."""
    def equilibrium(
        self, *, force: float = 1e-8, torque: float = 1e-8, iterations: int = 2000, turn_length: float = 1.0
    ) -> Certificate:
        """Moves the system to a nearby stable equilibrium by Newton's method, and sets velocities to zero.

        - `force`, `torque`: tolerances of the residual on free bodies.
        - `turn_length`: displacement that counts as much as a rotation of 1 rad.

        A scene with the task `Equilibrium` uses its own settings. Raises `RunFailed`.
        """
    def loads(self) -> tuple[_Array, _Array]:
        """Returns the total forces on points (lab frame) and torques on frames (body frame)."""
    def energies(self) -> dict[str, float]:
        """Returns the potential energy of each term."""
    def curvature(self, rod: Rod) -> _Array:
        """Returns the curvature of a rod at its joints, body frame, `[joints, 3]`: two of bending, one of twist."""
    def strain(self, rod: Rod) -> _Array:
        """Returns the strain of a rod's segments, body frame, `[segments, 3]`: two of shear, one of stretch."""
    @property
    def mass(self) -> _Array:
        """Masses of points, `[n]`."""
    @property
    def free_points(self) -> list[bool]:
        """True for each free point."""
    @property
    def free_frames(self) -> list[bool]:
        """True for each free frame."""
    @property
    def kinetic_energy(self) -> float:
        """Kinetic energy of the free bodies."""
    @property
    def potential_energy(self) -> float:
        """Potential energy of all terms."""
    @property
    def time(self) -> float:
        """Simulated time."""
    @property
    def steps(self) -> int:
        """Number of time steps made."""

def run(
    scene: Scene,
    out: _Path | None = None,
    *,
    overwrite: bool = False,
    resume: bool = False,
    checkpoint_every_s: float = 60.0,
    progress: Callable[[Progress], object] | bool | None = None,
) -> Run:
    """Runs a scene in memory, or in the run directory `out`.

    - `overwrite`: replaces an earlier run.
    - `resume`: continues an interrupted run, or extends a completed motion to a longer duration; the results are
      bitwise identical to those of a single run.
    - `progress`: `True` shows a bar (the default on a terminal), `False` shows nothing; a function is called
      with a `Progress`.

    Raises `SceneError`; `OSError` for the directory; `RunFailed`, and on Ctrl-C `Interrupted`, with the results
    so far.
    """

def trade(
    scene: Scene,
    *,
    quantities: Sequence[str] = ...,
    error: float = 0.02,
    loads: Sequence[float] = ...,
    budget_s: float = 60.0,
    all: bool = False,
    progress: Callable[[str], object] | bool | None = None,
) -> Trade:
    """Compares the error and run time of cheaper models of a scene with the all-monomer model.

    - `quantities`: `tip`, `height`, `end-force`, `end-couple`, `energy`, `curvature`, `linker-force`, or
      prefixes of observables; by default the observables of the scene and the tip displacements.
    - `error`: largest accepted relative error.
    - `loads`: fractions of the loads at which models within the error run again.
    - `budget_s`: longest time of one run (s).
    - `all`: also compares models with finer meshes and other rod laws.
    - `progress`: `True` prints the name of each run (the default on a terminal), `False` prints nothing; a
      function is called with the name.

    Raises `SceneError`; `RunFailed` if the reference has no result; on Ctrl-C `Interrupted` with the `trade` so
    far.
    """

def scene_schema() -> str:
    """Returns the JSON schema of scenes."""

def page(directory: _Path) -> str:
    """Returns the HTML page of a run directory, which may be unfinished."""

def export(directory: _Path, format: str, out: _Path, overwrite: bool) -> list[Path]:
    """Exports a run directory to `gsd`, `simularium` or `vtk`, and returns the written files."""

def profile(directory: _Path, record: int) -> dict[str, _Array]:
    """Returns the fields along all filaments in a record, by name."""

def unfinished(directory: _Path) -> dict[str, Any]:
    """Returns the scene, the counts and the records of a run directory with a checkpoint and without results."""

def carry_out(
    scene: Scene,
    out: _Path,
    vary: Sequence[tuple[Sequence[str], Sequence[Sequence[str]]]],
    results: Sequence[str],
    samples: int,
    first_seed: int,
    jobs: int | None,
    resume: bool,
    progress: Callable[[Progress], object] | bool | None,
) -> tuple[int, int]:
    """Makes the runs of a sweep in a directory. Returns the numbers of runs and of failed runs."""

def emit_snakemake(
    scene: Scene,
    out: _Path,
    vary: Sequence[tuple[Sequence[str], Sequence[Sequence[str]]]],
    results: Sequence[str],
    samples: int,
    first_seed: int,
) -> int:
    """Writes a sweep with a Snakemake workflow into a directory. Returns the number of runs."""

def fit(
    function: Callable[[Any, _Array], ArrayLike],
    x: Any,
    y: ArrayLike,
    start: ArrayLike | None = None,
    *,
    bounds: Sequence[tuple[float, float]] | None = None,
    deviations: ArrayLike | None = None,
    jacobian: Callable[[Any, _Array], ArrayLike] | None = None,
    drawn: int = 0,
    seed: int = 1,
) -> Fit:
    """Fits `function(x, p)`, an array with the shape of `y`, by the Levenberg-Marquardt method.

    - `start`: initial parameters.
    - `bounds`: lower and upper bounds of each parameter.
    - `drawn`: number of random starts between the bounds in addition to `start` (8 without `start`).
    - `jacobian`: `jacobian(x, p)`, `[points, parameters]`; by default finite differences.
    - `deviations`: standard deviations of `y`, one or one each.

    Raises `ValueError` for invalid data, `ArithmeticError` if no search converges.
    """

def fit_linear(design: ArrayLike, y: ArrayLike, *, deviations: ArrayLike | None = None) -> Fit:
    """Fits a linear combination of the columns of `design`, `[points, parameters]`, by QR decomposition."""
