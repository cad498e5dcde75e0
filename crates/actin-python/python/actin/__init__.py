"""Actin filaments at two resolutions: rigid ellipsoid monomers and Cosserat rods.

Scenes: `Scene`, `equilibrium`, `run`, `sweep`, `trade`, `load`. Step by step: `System`. Least squares: `fit`,
`fit_linear`. Units of scenes are nm, pN and ns; `System` and fits accept any consistent units.
"""

from actin._actin import Progress, Rod, Scene, System, __version__, fit, fit_linear, run, trade
from actin._equilibrium import equilibrium
from actin._sweep import Sweep, sweep
from actin._trade import Trade
from actin.errors import ActinError, Interrupted, RunFailed, RunWarning, SceneError
from actin.results import Certificate, Equilibrium, Fit, Run, load

__all__ = [
    "ActinError",
    "Certificate",
    "Equilibrium",
    "Fit",
    "Interrupted",
    "Progress",
    "Rod",
    "Run",
    "RunFailed",
    "RunWarning",
    "Scene",
    "SceneError",
    "Sweep",
    "System",
    "Trade",
    "__version__",
    "equilibrium",
    "fit",
    "fit_linear",
    "load",
    "run",
    "sweep",
    "trade",
]
