"""Confines a filament of 2 um to a sphere with a radius of 250 nm, in water at 298 K."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
import numpy as np
from actin_filaments.scenes import Brownian, Filament, Helix, Output, Repulsion, Rod, RodModel, Sphere
from mpl_toolkits.mplot3d.art3d import Line3DCollection

scene = af.Scene(
    title="Filament in a sphere",
    filament=Filament(
        sections=[Rod(from_nm=0.0, to_nm=2000.0, segments=50)],
        rod=RodModel(law="Constant"),
        at_nm=[180.0, 0.0, -10.0],
        shape=Helix(radius_nm=180.0, pitch_nm=12.0, azimuth_deg=180.0),
    ),
    repulsion=Repulsion(spheres=[Sphere(at_nm=[0.0, 0.0, 0.0], radius_nm=250.0, side="Inside")]),
    observe=["Energies"],
    output=Output(vtk=False),
    task=Brownian(duration_ms=1.0, temperature_k=298.0, time_step_ns=1000.0, seed=1),
)
run = af.run(scene)
radius = np.linalg.norm(run.centre_line_nm, axis=-1)

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure = plt.figure(figsize=(7.2, 3.4))
curve, space = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2, projection="3d")
curve.plot(run.time_ns / 1e3, radius.mean(axis=1), label="mean of the filament")
curve.plot(run.time_ns / 1e3, radius.max(axis=1), label="largest")
curve.axhline(250.0 - 3.7, color="black", linestyle="--", linewidth=1.0, label="wall minus radius of the filament")
curve.set(xlabel="time (us)", ylabel="distance from the centre (nm)", ylim=(170, 270))
curve.legend(loc="lower right")
line = run[-1].centre_line_nm
pieces = np.stack([line[:-1], line[1:]], axis=1)
space.add_collection(Line3DCollection(pieces, array=run.s_nm[1:], linewidth=2.5, capstyle="round"))
u, v = np.mgrid[0.0 : 2.0 * np.pi : 25j, 0.0 : np.pi : 13j]
ball = 250.0 * np.array([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)])
space.plot_wireframe(*ball, color="0.8", linewidth=0.4)
space.set_box_aspect((1, 1, 1), zoom=1.5)
space.set_axis_off()
figure.savefig("sphere.png")
print(f"largest distance from the centre {radius.max():.1f} nm, mean after 0.5 ms {radius[len(run) // 2 :].mean():.0f} nm")
