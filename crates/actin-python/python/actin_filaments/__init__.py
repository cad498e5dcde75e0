"""Actin filaments at two resolutions: rigid ellipsoid monomers and Cosserat rods.

Scenes: `Scene`, whose parts are dictionaries or classes of `actin_filaments.scenes`; `equilibrium`, `run`, `sweep`,
`trade`, `load`. Step by step: `System`. Least squares: `fit`, `fit_linear`. Units of scenes are nm, pN and ns; `System`
and fits accept any consistent units.
"""

from actin_filaments._actin import Progress, Rod, Scene, System, __version__, fit, fit_linear, run, trade
from actin_filaments._equilibrium import equilibrium
from actin_filaments._frame import Frame
from actin_filaments._loads import Bodies, Loads, compiled
from actin_filaments._page import Page
from actin_filaments._sweep import Sweep, latin_hypercube, snakemake, sweep
from actin_filaments._trade import Trade
from actin_filaments.errors import ActinError, Interrupted, RunFailed, RunWarning, SceneError
from actin_filaments.results import Certificate, Equilibrium, Fit, Run, load

__all__ = [
    "ActinError",
    "Bodies",
    "Certificate",
    "Equilibrium",
    "Fit",
    "Frame",
    "Interrupted",
    "Loads",
    "Page",
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
    "compiled",
    "equilibrium",
    "fit",
    "fit_linear",
    "latin_hypercube",
    "load",
    "run",
    "snakemake",
    "sweep",
    "trade",
]
