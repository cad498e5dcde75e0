"""Pushes the middle of a buckled filament to and fro between two plates: force against displacement has a loop."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
import numpy as np
from actin_filaments.scenes import (
    Clamp, Equilibrium, Filament, Force, LoadFactor, Plane, Repulsion, Rod, RodModel, Shift, Stage,
)

scene = af.Scene(
    title="Hysteresis of a buckled filament",
    filament=Filament(sections=[Rod(from_nm=0.0, to_nm=160.0, segments=32)], rod=RodModel(law="Constant")),
    clamps=[Clamp(end="Start"), Clamp(end="End")],
    loads=[Force(at_nm=80.0, force_pn=[60.0, 0.0, 0.0])],
    repulsion=Repulsion(filaments=False, planes=[
        Plane(at_nm=[0.0, -4.0, 0.0], normal=[0.0, 1.0, 0.0]),
        Plane(at_nm=[0.0, 4.0, 0.0], normal=[0.0, -1.0, 0.0]),
    ]),
    path=[
        Stage(set=[LoadFactor(load=0, factor=0.1)]),
        Stage(set=[Shift(end="End", shift_nm=[0.0, 0.0, -5.0])]),
        Stage(set=[LoadFactor(load=0, factor=1.0)]),
        Stage(set=[LoadFactor(load=0, factor=-1.0)]),
        Stage(set=[LoadFactor(load=0, factor=1.0)]),
    ],
    task=Equilibrium(largest_step=0.02, accept_jumps=True),
)
run = af.run(scene)
force = 60.0 * np.interp(run.path, range(6), [0.0, 0.1, 0.1, 1.0, -1.0, 1.0])
middle = run.centre_line_nm[:, np.argmin(abs(run.s_nm - 80.0)), 0]
loop = run.path >= 3.0
jumps = loop[1:] & (abs(np.diff(middle)) > 10.0)

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, (curve, shapes) = plt.subplots(1, 2, figsize=(7.2, 3.0), width_ratios=[1.5, 1])
curve.plot(force[loop], middle[loop], "o-", markersize=2.5)
curve.set(xlabel="force on the middle (pN)", ylabel="displacement of the middle (nm)")
before = np.flatnonzero(jumps)[0]
records = {"60 pN": np.searchsorted(run.path, 3.0), "before the jump": before, "after the jump": before + 1}
for shade, (label, record) in zip((0.0, 0.5, 0.85), records.items()):
    x, _, z = run.centre_line_nm[record].T
    shapes.plot(x, z, color=plt.get_cmap()(shade), label=label)
shapes.set(xlabel="x (nm)", ylabel="z (nm)", xlim=(-60, 60), aspect="equal")
shapes.legend(loc="upper left", handlelength=1.0, bbox_to_anchor=(0.65, 1.0))
figure.savefig("hysteresis.svg", metadata={"Date": None})
print(f"the filament snaps at {force[:-1][jumps][0]:.1f} and {force[:-1][jumps][1]:.1f} pN")
