"""Forces and torques from Python functions, for `System.add_loads`."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Array = NDArray[np.float64]


class Bodies(NamedTuple):
    """State of a `System`: argument of the functions of `System.add_loads`."""

    time: float
    """Time."""
    position: _Array
    """Positions of points, `[n, 3]`."""
    velocity: _Array
    """Velocities of points, `[n, 3]`."""
    quaternion: _Array
    """Orientations of frames, body to lab, `[m, 4]` in the order w, x, y, z."""
    angular_momentum: _Array
    """Angular momenta of frames, body frame, `[m, 3]`."""


class Loads(NamedTuple):
    """Forces and torques of a function of `System.add_loads`."""

    force: ArrayLike | None = None
    """Forces on points, lab frame, `[n, 3]`; by default zero."""
    torque: ArrayLike | None = None
    """Torques on frames, lab frame, `[m, 3]`; by default zero."""
    energy: float | Callable[[], float] | None = None
    """Potential energy, or a function that computes it; `None` for loads without potential."""
    stiffness: tuple[ArrayLike, ArrayLike, ArrayLike] | None = None
    """Second derivatives of the energy, `(a, b, blocks)`: indices of bodies `[k]` and `[k]`, and blocks `[k, 3, 3]`.

    Point i is body i, frame j is body n + j. Coordinates are displacements of points (lab frame) and rotation vectors
    of frames (body frame). Each pair a, b has one block, in the order a, b; the pairs are the same in all states.
    """


def to_loads(result: Loads | ArrayLike) -> Loads:
    """Returns loads as returned by a function, or loads without torques for an array of forces."""
    return result if isinstance(result, Loads) else Loads(force=result)


def of_positions(force: Callable[[_Array], ArrayLike], energy: Callable[[_Array], float] | None) -> Callable[[Bodies], Loads]:
    """Returns the loads of forces on points that depend on positions only."""

    def loads(bodies: Bodies) -> Loads:
        x = bodies.position
        return Loads(force=force(x), energy=None if energy is None else lambda: energy(x))

    return loads


def compiled(function: Any, *, conservative: bool = True) -> Callable[[Bodies], Loads]:
    """Returns a function for `System.add_loads` that calls compiled code.

    - `function`: a numba `cfunc`, a `ctypes` function, or the address of a C function
      `double f(int64_t n, int64_t m, double time, const double *position, const double *velocity,
      const double *quaternion, const double *angular_momentum, double *force, double *torque)`.
      It adds forces `[n, 3]` and torques `[m, 3]` (lab frame) to zeros and returns the energy.
    - `conservative`: `False` if the loads have no potential.
    """
    address = getattr(function, "address", function)
    if not isinstance(address, int):
        address = ctypes.cast(address, ctypes.c_void_p).value
    size, pointer = ctypes.c_int64, ctypes.c_void_p
    call = ctypes.CFUNCTYPE(ctypes.c_double, size, size, ctypes.c_double, *[pointer] * 6)(address or 0)
    # Buffers of the results, which are copied after each call.
    force, torque = np.zeros((0, 3)), np.zeros((0, 3))

    def loads(bodies: Bodies) -> Loads:
        nonlocal force, torque
        n, m = len(bodies.position), len(bodies.quaternion)
        if (len(force), len(torque)) != (n, m):
            force, torque = np.empty((n, 3)), np.empty((m, 3))
        force.fill(0.0)
        torque.fill(0.0)
        addresses = [array.__array_interface__["data"][0] for array in (*bodies[1:], force, torque)]
        energy = call(n, m, bodies.time, *addresses)
        return Loads(force, torque, energy if conservative else None)

    # Keeps the code in memory.
    loads.function = function  # type: ignore[attr-defined]
    return loads
