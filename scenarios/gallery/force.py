"""Adds a force written in Python: springs along a filament hold it on its axis, as an elastic foundation does."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
import numpy as np
from actin_filaments.scenes import Clamp, Drag, Dynamics, EndForce, Filament, Rod, RodModel

scene = af.Scene(
    title="Filament on an elastic foundation",
    filament=Filament(sections=[Rod(from_nm=0.0, to_nm=400.0, segments=40)], rod=RodModel(law="Constant")),
    clamps=[Clamp(end="Start")],
    loads=[EndForce(end="End", force_pn=[0.5, 0.0, 0.0])],
    task=Dynamics(duration_ns=40.0, drag=Drag(translational_per_ns=1.0, rotational_per_ns=1.0)),
)
STIFFNESS = 0.01  # pN/nm per nm of the filament
length = np.full(41, 10.0)
length[[0, -1]] = 5.0


def foundation(position):
    """Returns the forces of the springs on the nodes (pN)."""
    return -STIFFNESS * length[:, None] * position * [1.0, 1.0, 0.0]


system = af.System.from_scene(scene)
system.add_field(foundation)
shapes = []
while system.time < 40.0:
    system.step(100)
    shapes.append(system.position)
x, _, z = shapes[-1].T

# Semi-infinite beam on a foundation (Hetenyi).
decay = (STIFFNESS / (4.0 * 3.9e4)) ** 0.25
tip = 2.0 * 0.5 * decay / STIFFNESS
s = 400.0 - z
beam = tip * np.exp(-decay * s) * np.cos(decay * s)

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, axes = plt.subplots(figsize=(6.4, 2.9))
for shape in shapes[:12:2]:
    axes.plot(shape[:, 2], shape[:, 0], color="0.75", linewidth=0.8)
axes.plot(z, x, "o", label="at rest, with the force from Python")
axes.plot(z, beam, "--", color="black", linewidth=1.0, label="beam on an elastic foundation")
axes.set(xlabel="z (nm)", ylabel="x (nm)")
axes.legend(loc="upper left")
figure.savefig("force.svg", metadata={"Date": None})
print(f"tip displacement {x[-1]:.3f} nm, of the beam {tip:.3f} nm")
