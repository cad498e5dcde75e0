"""Solver adapter for cosseratbench, a benchmark of rod solvers, which finds it when both packages are installed.

Rods are those of `System`, in SI units. Quasi-static scenarios with fixed ends are solved by Newton's method: the first
frame is the initial state, and all other frames are the equilibrium. Other scenarios are integrated by PEFRL.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from cosseratbench.scenario import End, EndCondition, Rod, Scenario
from cosseratbench.solver import Capability, Diverged
from cosseratbench.trajectory import Trajectory

from actin_filaments import RunFailed, System, __version__
from actin_filaments import Rod as Placed
from actin_filaments._pyvista import rotations

SHEAR_COEFFICIENT = 27.0 / 28.0
"""Timoshenko's shear coefficient of a circular cross-section, as in other solvers of the benchmark."""

CLAMPS: dict[EndCondition, Literal["Pin", "Wall"] | None] = {
    EndCondition.FREE: None,
    EndCondition.PINNED: "Pin",
    EndCondition.CLAMPED: "Wall",
}

RESIDUAL = 1e-9
"""Tolerance of the residual force relative to the total load; residual torques are multiplied by the length."""


class ActinSolver:
    """Runs scenarios without contact."""

    name = "actin"
    backend_version = __version__
    capabilities = frozenset({Capability.STRETCH, Capability.SHEAR})

    def __init__(self, time_step_scale: float = 1.0) -> None:
        # Half the stability limit times the given scale.
        self.safety = 0.5 * time_step_scale

    def settings(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> dict[str, object]:
        """Returns the numerical settings of a run."""
        if _is_static(scenario):
            return {"method": "Newton", "residual": RESIDUAL}
        system, _ = _build(scenario, n_elements)
        step, _ = self._steps(system, scenario, n_frames)
        return {"method": "PEFRL (explicit, order 4)", "time_step": step, "damping_rate": _damping(scenario)}

    def run(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> Trajectory:
        """Returns the trajectory of a scenario."""
        system, rods = _build(scenario, n_elements)
        times = np.linspace(0.0, scenario.duration, n_frames)
        if _is_static(scenario):
            frames = self._at_rest(system, rods, scenario, n_frames)
        else:
            frames = self._in_time(system, rods, scenario, n_frames)
        positions, directors = zip(*(_joined(frames, k) for k in range(len(rods))))
        return Trajectory(times, positions, directors)

    def _steps(self, system: System, scenario: Scenario, n_frames: int) -> tuple[float, int]:
        """Returns the time step and the number of steps per frame."""
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
    """Returns whether Newton's method applies. Moving ends pass through intermediate states, which are part of the result."""
    is_moved = any(rod.motion(end) is not None for rod in scenario.rods for end in End)
    return scenario.quasi_static and not is_moved


def _damping(scenario: Scenario) -> float:
    """Returns critical damping of the slowest mode for quasi-static scenarios, as in other solvers of the benchmark."""
    return 2.0 * scenario.slowest_frequency() if scenario.quasi_static else 0.0


def _loads(scenario: Scenario) -> float:
    """Returns the sum of the magnitudes of all loads."""
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
    """Adds a rod with the inertia of its cross-sections."""
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
    """Prescribes the motion of an end."""
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
    """Returns nodes and first directors of each rod."""
    position, d1 = system.position, rotations(system.quaternion)[:, :, 0]
    return [(position[slice(*rod.points)], d1[slice(*rod.frames)]) for rod in rods]


def _joined(frames: list[list[_Shape]], rod: int) -> _Shape:
    nodes, directors = zip(*(frame[rod] for frame in frames))
    return np.stack(nodes), np.stack(directors)
