"""The native half of the package: see `actin`."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from actin._trade import Trade
from actin.results import Certificate, Fit, Run

__all__ = ["Progress", "Rod", "Scene", "System", "__version__", "carry_out", "fit", "fit_linear", "run", "trade"]

__version__: str

_Array = NDArray[np.float64]
_Path = str | os.PathLike[str]
_Clamp = Literal["Wall", "NodeAndFrame", "TwoNodesAndFrame", "Pin"]
_Scheme = Literal["position-verlet", "velocity-verlet", "pefrl", "vefrl", "forest-ruth", "suzuki"]

@final
class Scene:
    """Filaments, what holds, loads and links them, and what is computed.

    Keys and rules are those of scene files. In dictionaries a choice with keys is a dictionary of one
    (`{"Rod": {"from_nm": 0.0, "to_nm": 40.0}}`), one without is a string (`"Start"`). Scenes do not change: `set` and
    `reseed` return others. Everything that reads one raises `SceneError`.
    """

    def __new__(cls, **keys: Any) -> Scene:
        """A scene from its keys: `Scene(filament={...}, clamps=[...], task={...})`."""
    @staticmethod
    def from_dict(keys: Mapping[str, Any], folder: _Path = ...) -> Scene:
        """A scene from a dictionary; `folder` is where its files of points are."""
    @staticmethod
    def from_ron(text: str, folder: _Path = ...) -> Scene:
        """A scene from its text, as files have it."""
    @staticmethod
    def from_file(path: _Path) -> Scene:
        """A scene from its file."""
    def to_ron(self) -> str:
        """Its text, with every default."""
    def to_dict(self) -> Any:
        """Its keys, with every default that is not left out."""
    def set(self, key: str, value: Any) -> Scene:
        """The scene with a value at the path of a key: `scene.set("loads[0].force_pn[0]", -1.0)`."""
    def reseed(self, seed: int) -> Scene:
        """The scene with another seed of everything that it draws."""
    def check(self) -> dict[str, Any]:
        """What the scene resolves to and costs: `scene` (with time step), `counts`, `time_step_ns` and `steps` of a
        motion, `cost`, `notes`, and the time on one core as measured on the first 0.2 s: `seconds_per_step` and
        `seconds` of the whole run, `None` for an equilibrium that takes longer. Nothing is written."""
    @property
    def title(self) -> str:
        """What the scene shows, in words."""
    @property
    def task(self) -> Literal["Equilibrium", "Dynamics", "Brownian"]:
        """What is computed."""
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def _repr_html_(self) -> str: ...

@final
class Progress:
    """How far a run is."""

    @property
    def share(self) -> float:
        """Share of the run that is done, from 0 to 1."""
    @property
    def at(self) -> float:
        """Time (ns), stages of a path, or runs of a sweep."""
    @property
    def end(self) -> float:
        """What `at` will be at the end."""
    @property
    def unit(self) -> Literal["ns", "stages", "runs"]:
        """What `at` counts."""
    @property
    def steps(self) -> int:
        """Steps made."""
    @property
    def residual_force_pn(self) -> float:
        """Largest force on a free point."""
    @property
    def seconds(self) -> float:
        """Time since the run began."""

@final
class Rod:
    """Where a rod is among the bodies of a `System`."""

    @property
    def points(self) -> tuple[int, int]:
        """First point and the one behind the last."""
    @property
    def frames(self) -> tuple[int, int]:
        """First frame of a segment and the one behind the last; walls are not among them."""
    @property
    def start_wall(self) -> int | None:
        """The held frame before the first segment, if there is one."""
    @property
    def end_wall(self) -> int | None:
        """The held frame behind the last segment, if there is one."""
    @property
    def length(self) -> float:
        """Rest length."""

@final
class System:
    """Points, frames and interactions that are put together, moved and looked at by hand.

    Points have places `[n, 3]` and velocities, frames have orientations `[m, 4]` (w, x, y, z; body to lab) and angular
    momenta (body axes). Units are any that fit together; those of a scene are nm, pN and ns. Arrays are snapshots: those
    that are got do not change with the system and are not to be written to; set a whole array to change it.
    """

    position: _Array
    """Places of points, `[n, 3]`; may be set."""
    velocity: _Array
    """Velocities of points, `[n, 3]`; may be set."""
    quaternion: _Array
    """Orientations of frames, `[m, 4]`; may be set to what has unit length."""
    angular_momentum: _Array
    """Angular momenta of frames, body axes, `[m, 3]`; may be set."""

    def __new__(cls) -> System:
        """A system without bodies."""
    @staticmethod
    def from_scene(scene: Scene) -> System:
        """The bodies and interactions of a scene as built, with the method, time step, drag and heat of its task.

        In a motion, steps follow the factors of loads in time and the path of the scene. The path of equilibria is followed
        by `set_path`.
        """
    def add_points(self, position: ArrayLike, mass: ArrayLike) -> int:
        """Adds points at rest, `[k, 3]`, with a mass for all or for each; returns the index of the first."""
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
        """Adds a Cosserat rod along nodes `[k + 1, 3]`: k segments, each with a frame.

        `shear` are the rigidities S1, S2 (shear) and S3 (stretch), forces; `bend` B1, B2 (bending) and B3 (twist), forces
        times areas. Segments have rest `lengths`, those between the nodes by default. The first axis of each frame begins
        near `normal` and is carried along the nodes without twist. With `rest_shape="placed"` the rod is at rest as it is
        placed. `rigid_segments` adds the inertia of segments that turn as rigid pieces, which allows longer steps.
        """
    def add_springs(self, pairs: Sequence[Sequence[int]], stiffness: float, rest_length: float) -> None:
        """Adds springs between pairs of points."""
    def add_weight(self, acceleration: ArrayLike) -> int:
        """Adds the weight of all points; returns the index of its factor."""
    def add_force(self, points: Sequence[int], force: ArrayLike) -> int:
        """Adds a force that points share and that keeps its direction; returns the index of its factor."""
    def add_field(
        self,
        force: Callable[[_Array], ArrayLike],
        energy: Callable[[_Array], float] | None = None,
    ) -> None:
        """Adds forces on points that a function of all places gives, `[n, 3]` to `[n, 3]`, and their energy."""
    def apply_force(self, force: ArrayLike) -> None:
        """Forces on points, `[n, 3]`, beside all others until they are set again."""
    def apply_torque(self, torque: ArrayLike) -> None:
        """Torques on frames in lab axes, `[m, 3]`, beside all others until they are set again."""
    def hold(self, points: Sequence[int] = ..., frames: Sequence[int] = ...) -> None:
        """Holds points and frames where they are; those that are driven stop."""
    def release(self, points: Sequence[int] = ..., frames: Sequence[int] = ...) -> None:
        """Lets held points and frames go, from rest."""
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
        """Holds bodies and moves them as one: at each of `times`, which count from now and ascend from 0, they have a
        `displacement` `[t, 3]` and are turned by a `rotation` vector `[t, 3]` (rad, lab axes) from where they are now,
        about a place that moves along (that of the first point by default). Between times both change at constant rates;
        behind the last all stands still. Along `slides` the points are not moved but slide freely as one body."""
    def set_path(self, u: float) -> None:
        """Puts loads and held ends of a scene of equilibria where its path has them after `u` stages."""
    def set_factor(self, load: int, factor: float) -> None:
        """Sets the factor of a load: by its index in the scene, or as it was returned."""
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
        """Makes steps in time of length `h`, by default half the longest stable one.

        `drag` are the rates at which velocities and angular momenta decay, `thermal_energy` (k T) makes noise to go with
        them, with a `seed` of 1 by default. What is set stays for later steps. The default length is estimated again when
        bodies, terms or clamps have been added and when `scheme` changes. `step(a)` and `step(b)` together equal
        `step(a + b)` to the bit. Raises `RunFailed` where numbers explode; the system then is where it last was sound,
        which `steps` and `time` tell. Ctrl-C ends the steps.
        """
    def stable_step(self, scheme: _Scheme | None = None, safety: float = ...) -> float:
        """The longest stable time step of a method at the present stiffness, times `safety`."""
    def equilibrium(
        self, *, force: float = 1e-8, torque: float = 1e-8, iterations: int = 2000, turn_length: float = 1.0
    ) -> Certificate:
        """Moves the system to a stable equilibrium near it, at rest, by Newton's method.

        `force` and `torque` are the largest loads left on free bodies; a turn of 1 rad counts as a displacement by
        `turn_length`. A scene that asks for an equilibrium has its own settings. Raises `RunFailed`.
        """
    def loads(self) -> tuple[_Array, _Array]:
        """Forces on points (lab axes) and torques on frames (body axes) of all terms."""
    def energies(self) -> dict[str, float]:
        """Potential energies by term."""
    def curvature(self, rod: Rod) -> _Array:
        """Curvature of a rod at its joints, body axes, `[joints, 3]`: two of bending, one of twist."""
    def strain(self, rod: Rod) -> _Array:
        """Shear and stretch of a rod's segments, body axes, `[segments, 3]`: two of shear, one of stretch."""
    @property
    def mass(self) -> _Array:
        """Masses of points, `[n]`."""
    @property
    def free_points(self) -> list[bool]:
        """Whether each point is free."""
    @property
    def free_frames(self) -> list[bool]:
        """Whether each frame is free."""
    @property
    def kinetic_energy(self) -> float:
        """Kinetic energy of the free bodies."""
    @property
    def potential_energy(self) -> float:
        """Potential energy of all terms."""
    @property
    def time(self) -> float:
        """Time that steps have taken."""
    @property
    def steps(self) -> int:
        """Steps made."""

def run(
    scene: Scene,
    out: _Path | None = None,
    *,
    overwrite: bool = False,
    resume: bool = False,
    checkpoint_every_s: float = 60.0,
    progress: Callable[[Progress], object] | bool | None = None,
) -> Run:
    """Runs a scene: in memory, or into the run directory `out`.

    `overwrite` replaces an earlier run there, `resume` continues one that was interrupted, to the same bits. `progress`
    shows a bar (`True`, and by default on a terminal), nothing (`False`), or calls a function with a `Progress`.

    Raises `SceneError`; `RunFailed`, and on Ctrl-C `Interrupted`, with what was recorded; `OSError` for the directory.
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
    """Runs a scene with every monomer and in cheaper ways: errors and times of each, and the cheapest scene within an error.

    `quantities` are `tip`, `height`, `end-force`, `end-couple`, `energy`, `curvature`, `linker-force`, or beginnings of
    names of observables; by default the observables of the scene and its tips. `error` is the largest relative error
    that is accepted. Candidates within it also run at the shares `loads` of the loads. No run takes longer than
    `budget_s`. `all` adds finer meshes and other laws. `progress` prints the name of each run (`True`, and by default
    on a terminal), nothing (`False`), or calls a function with the name.

    Raises `SceneError`, `RunFailed` if the reference has no result, and on Ctrl-C `Interrupted` with the `trade` so far.
    """

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
    """Makes the runs of a sweep in a directory; returns how many there are and how many failed."""

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
    """Fits `function(x, p)`, an array like `y`, by Levenberg and Marquardt's method within `bounds`.

    The search begins at `start`, and at `drawn` more points between the bounds (8 where there is no start). `jacobian(x, p)`
    is `[points, parameters]`; differences by default. `deviations` are standard deviations of `y`, one or one each.
    Raises `ValueError` for data that make no sense, `ArithmeticError` where no search converges.
    """

def fit_linear(design: ArrayLike, y: ArrayLike, *, deviations: ArrayLike | None = None) -> Fit:
    """Fits a sum of the columns of `design`, `[points, parameters]`, by QR."""
