"""The adapter of this package for cosseratbench, the benchmark of rod solvers: found by it where both are installed.

Rods are those of `System`, in SI units. What is asked for at rest, with ends that do not move, is solved by Newton's
method: the first frame is the start, all others are the equilibrium. All else is moved by PEFRL.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from cosseratbench.scenario import End, EndCondition, Rod, Scenario
from cosseratbench.solver import Capability, Diverged
from cosseratbench.trajectory import Trajectory

from actin import RunFailed, System, __version__
from actin import Rod as Placed
from actin._pyvista import rotations

SHEAR_COEFFICIENT = 27.0 / 28.0
"""Timoshenko's coefficient of a circular section, as the benchmark's other rods with shear have it."""

CLAMPS: dict[EndCondition, Literal["Pin", "Wall"] | None] = {
    EndCondition.FREE: None,
    EndCondition.PINNED: "Pin",
    EndCondition.CLAMPED: "Wall",
}

RESIDUAL = 1e-9
"""Forces left at rest, over all loads; torques over these times the length."""


class ActinSolver:
    """Runs scenarios without contact."""

    name = "actin"
    backend_version = __version__
    capabilities = frozenset({Capability.STRETCH, Capability.SHEAR})

    def __init__(self, time_step_scale: float = 1.0) -> None:
        # Half the stability limit, times any scale asked for.
        self.safety = 0.5 * time_step_scale

    def settings(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> dict[str, object]:
        """The numerical choices of a run."""
        if _is_static(scenario):
            return {"method": "Newton", "residual": RESIDUAL}
        system, _ = _build(scenario, n_elements)
        step, _ = self._steps(system, scenario, n_frames)
        return {"method": "PEFRL (explicit, order 4)", "time_step": step, "damping_rate": _damping(scenario)}

    def run(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> Trajectory:
        """The trajectory of a scenario."""
        system, rods = _build(scenario, n_elements)
        times = np.linspace(0.0, scenario.duration, n_frames)
        if _is_static(scenario):
            frames = self._at_rest(system, rods, scenario, n_frames)
        else:
            frames = self._in_time(system, rods, scenario, n_frames)
        positions, directors = zip(*(_joined(frames, k) for k in range(len(rods))))
        return Trajectory(times, positions, directors)

    def _steps(self, system: System, scenario: Scenario, n_frames: int) -> tuple[float, int]:
        """The time step, and how many of them make up a frame."""
        interval = scenario.duration / (n_frames - 1)
        steps = math.ceil(interval / system.stable_step("pefrl", self.safety))
        return interval / steps, steps

    def _at_rest(self, system: System, rods: list[Placed], scenario: Scenario, n_frames: int) -> list[list[_Shape]]:
        start = _shapes(system, rods)
        force, length = _loads(scenario), scenario.rods[0].length
        try:
            tolerance = RESIDUAL * force
            system.equilibrium(force=tolerance, torque=tolerance * length, turn_length=length / 100)
        except RunFailed as failure:
            raise Diverged(str(failure)) from failure
        return [start, *[_shapes(system, rods)] * (n_frames - 1)]

    def _in_time(self, system: System, rods: list[Placed], scenario: Scenario, n_frames: int) -> list[list[_Shape]]:
        step, steps = self._steps(system, scenario, n_frames)
        rate = _damping(scenario)
        frames = [_shapes(system, rods)]
        for _ in range(n_frames - 1):
            try:
                system.step(steps, h=step, scheme="pefrl", drag=(rate, rate))
            except RunFailed as failure:
                raise Diverged(str(failure), failure.time_ns) from failure
            frames.append(_shapes(system, rods))
        return frames


_Shape = tuple[np.ndarray, np.ndarray]


def _is_static(scenario: Scenario) -> bool:
    """Whether only the state at rest is asked for. Ends that are moved pass through states which count."""
    is_moved = any(rod.motion(end) is not None for rod in scenario.rods for end in End)
    return scenario.quasi_static and not is_moved


def _damping(scenario: Scenario) -> float:
    """Critical for the slowest mode where dissipation is allowed, as the benchmark's other solvers have it."""
    return 2.0 * scenario.slowest_frequency() if scenario.quasi_static else 0.0


def _loads(scenario: Scenario) -> float:
    """The size of all loads."""
    gravity = float(np.linalg.norm(scenario.gravity))
    weights = (rod.material.density * rod.area * rod.length * gravity for rod in scenario.rods)
    ends = (float(np.linalg.norm(load.force)) for rod in scenario.rods for load in rod.loads)
    return sum(weights) + sum(ends) or 1.0


def _build(scenario: Scenario, n_elements: int) -> tuple[System, list[Placed]]:
    system = System()
    rods = [_add(system, rod, n_elements) for rod in scenario.rods]
    if any(scenario.gravity):
        system.add_weight(scenario.gravity)
    for rod, placed in zip(scenario.rods, rods):
        for load in rod.loads:
            system.add_force([_end_point(placed, load.at)], load.force)
        for end in End:
            _drive(system, rod, placed, end)
    return system, rods


def _add(system: System, rod: Rod, n_elements: int) -> Placed:
    """A rod with its sections' own inertia."""
    material, area, second = rod.material, rod.area, rod.second_moment_of_area
    shear = SHEAR_COEFFICIENT * material.shear_modulus * area
    bend = material.youngs_modulus * second
    return system.add_rod(
        rod.nodes(n_elements),
        shear=(shear, shear, material.youngs_modulus * area),
        bend=(bend, bend, 2.0 * material.shear_modulus * second),
        mass_per_length=material.density * area,
        area=area,
        lengths=np.full(n_elements, rod.length / n_elements),
        normal=rod.normal,
        start=CLAMPS[rod.start],
        end=CLAMPS[rod.end],
    )


def _end_point(placed: Placed, end: End) -> int:
    first, behind = placed.points
    return first if end is End.START else behind - 1


def _drive(system: System, rod: Rod, placed: Placed, end: End) -> None:
    """Moves an end as its motion prescribes."""
    motion = rod.motion(end)
    if motion is None:
        return
    wall = placed.start_wall if end is End.START else placed.end_wall
    assert wall is not None, "an end that is driven is clamped"
    system.drive(
        motion.times,
        points=[_end_point(placed, end)],
        frames=[wall],
        displacement=motion.displacement,
        rotation=motion.rotation,
        slides=motion.slides_along,
    )


def _shapes(system: System, rods: list[Placed]) -> list[_Shape]:
    """Nodes and first directors of each rod."""
    position, d1 = system.position, rotations(system.quaternion)[:, :, 0]
    return [(position[slice(*rod.points)], d1[slice(*rod.frames)]) for rod in rods]


def _joined(frames: list[list[_Shape]], rod: int) -> _Shape:
    nodes, directors = zip(*(frame[rod] for frame in frames))
    return np.stack(nodes), np.stack(directors)
