"""Buckles a column between clamped ends and compares the load with Euler's critical load."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
import numpy as np
from actin_filaments.scenes import Clamp, EndForce, Equilibrium, Filament, Force, LoadFactor, Rod, RodModel, Stage

scene = af.Scene(
    title="Buckling of a clamped column",
    filament=Filament(sections=[Rod(from_nm=0.0, to_nm=500.0, segments=50)], rod=RodModel(law="Constant")),
    clamps=[Clamp(end="Start"), Clamp(end="End", slides="AlongAxis")],
    loads=[
        Force(at_nm=250.0, force_pn=[0.01, 0.0, 0.0]),
        EndForce(end="End", force_pn=[0.0, 0.0, -7.5]),
    ],
    path=[
        Stage(set=[LoadFactor(load=0, factor=1.0)]),
        Stage(set=[LoadFactor(load=1, factor=1.0)]),
    ],
    task=Equilibrium(largest_step=0.01),
)
run = af.run(scene)
force = 7.5 * np.clip(run.path - 1.0, 0.0, None)
middle = run.centre_line_nm[:, :, 0].max(axis=1)

# Deflections grow as 1 / (critical - force) before buckling (Southwell): deflection / force is a line of slope 1 / critical.
small = (middle > 1.0) & (middle < 20.0)
critical = 1.0 / np.polyfit(middle[small], middle[small] / force[small], 1)[0]
euler = 4.0 * np.pi**2 * 3.9e4 / 500.0**2

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, (shapes, curve) = plt.subplots(1, 2, width_ratios=[1, 1.3])
for shade, value in zip((0.0, 0.2, 0.45, 0.65, 0.85), (5.0, 6.2, 6.5, 7.0, 7.49)):
    record = np.searchsorted(force, value)
    x, _, z = run.centre_line_nm[record].T
    shapes.plot(x, z, color=plt.get_cmap()(shade), label=f"{force[record]:.1f} pN")
shapes.set(xlabel="x (nm)", ylabel="z (nm)", aspect="equal", xlim=(-20, 260))
shapes.legend(loc="upper right", handlelength=1.0)
curve.plot(middle, force, "o-", markersize=3)
curve.axhline(euler, color="black", linestyle="--", linewidth=1.0)
curve.text(165, euler - 0.1, "Euler", va="top", ha="right")
curve.set(xlabel="deflection (nm)", ylabel="axial force (pN)", ylim=(0, None))
figure.savefig("column.svg", metadata={"Date": None})
print(f"critical force {critical:.2f} pN, Euler's {euler:.2f} pN")
