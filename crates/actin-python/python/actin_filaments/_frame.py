"""Records of a run one by one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pyvista

    from actin_filaments.results import Run

Array = NDArray[np.float64]


class Frame:
    """Record of a run: views of its arrays, for `n` points and `m` frames of reference."""

    run: Run
    """Run of the record."""
    index: int
    """Index of the record in the run, from 0."""

    def __init__(self, run: Run, index: int) -> None:
        self.run = run
        self.index = index

    @property
    def time_ns(self) -> float:
        """Time. Not available for equilibria."""
        return float(self.run.time_ns[self.index])

    @property
    def path(self) -> float:
        """Path parameter in stages. Not available for motions."""
        return float(self.run.path[self.index])

    @property
    def position_nm(self) -> Array:
        """Positions of points, `[n, 3]`, lab frame."""
        return self.run.position_nm[self.index]

    @property
    def centre_line_nm(self) -> Array:
        """Centre line, `[n, 3]`: nodes of rods, and centres of monomers moved to the filament axis."""
        return self.run.centre_line_nm[self.index]

    @property
    def velocity_nm_per_ns(self) -> Array:
        """Velocities of points, `[n, 3]`."""
        return self.run.velocity_nm_per_ns[self.index]

    @property
    def quaternion(self) -> Array:
        """Orientations, `[m, 4]` (w, x, y, z; body to lab)."""
        return self.run.quaternion[self.index]

    @property
    def angular_momentum(self) -> Array:
        """Angular momenta, `[m, 3]`, body frame (pN nm ns)."""
        return self.run.angular_momentum[self.index]

    @property
    def kinetic_pn_nm(self) -> float:
        """Kinetic energy."""
        return float(self.run.kinetic_pn_nm[self.index])

    @property
    def energies_pn_nm(self) -> dict[str, float]:
        """Energy of each term."""
        return {name: float(values[self.index]) for name, values in self.run.energies_pn_nm.items()}

    @property
    def observables(self) -> dict[str, float]:
        """Observables of the scene; NaN before the first value."""
        return {name: float(values[self.index]) for name, values in self.run.observables.items()}

    def profile(self) -> dict[str, Array]:
        """Returns fields along the filaments, as in `Run.profile`."""
        return self.run.profile(self.index)

    def to_pyvista(self) -> pyvista.MultiBlock:
        """Converts the record to PyVista, as in `Run.to_pyvista`."""
        return self.run.to_pyvista(self.index)

    def __repr__(self) -> str:
        is_path = self.run.scene.task == "Equilibrium"
        at = f"path {self.path:g}" if is_path else f"{self.time_ns:g} ns"
        return f"Frame({self.index}, {at})"
