"""A program that mypy and pyright check in strict mode; pytest runs it."""

from pathlib import Path

import actin_filaments as af
import numpy as np
from actin_filaments.scenes import Clamp, Dynamics, Ellipsoids, EndForce, Equilibrium, Filament, Rod, RodModel

scene = af.Scene(
    filament=Filament(
        sections=[Ellipsoids(from_nm=0.0, to_nm=np.float64(20.0)), Rod(from_nm=20.0, to_nm=80.0)],
        rod=RodModel(law="Fitted"),
    ),
    clamps=[Clamp(end="Start"), {"end": "End", "slides": "Freely"}],
    loads=[EndForce(end="End", force_pn=np.array([-2.0, 0.0, 0.0]))],
    task=Equilibrium(),
)
found = af.equilibrium(scene)
print(found.certificate.stable, found.centre_line_nm.max(axis=0))
motion = scene.with_({"task": Dynamics(duration_ns=0.1, record_every_ns=0.05)}, title="motion")
run = af.run(motion)
heights = [float(frame.position_nm[-1, 0]) for frame in run[1:]]
last: af.Frame = run[-1]
files: list[Path] = run.to_gsd("typed.gsd", overwrite=True)
table = af.sweep(scene, {"loads[0].force_pn[0]": np.linspace(-1.0, 0.0, 2)}, ["tip_nm[0]"])
each: af.Run = table[-1.0]
print(heights, last, files, each.status, table["tip_nm[0]"].size)
