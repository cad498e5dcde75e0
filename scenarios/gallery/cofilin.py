"""Bends and twists a filament whose middle is softened by cofilin, compared with a stepped beam."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
import numpy as np

scene = af.Scene.from_file(Path(__file__).parents[1] / "cofilin.ron")
found = af.equilibrium(scene)
profile = found.run.profile()
s = np.linspace(0.0, 160.0, 641)
soft = (s > 50.0) & (s < 110.0)
curvature = 0.001 * (160.0 - s) / 3.9e4 * np.where(soft, 5.0, 1.0)
twist = 0.5 / 1.3e4 * np.where(soft, 10.0, 1.0)

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, panels = plt.subplots(1, 2, figsize=(7.2, 2.9))
for axes, name, beam in zip(panels, ("curvature", "twist"), (curvature, twist)):
    axes.axvspan(50, 110, color="0.93", zorder=-1)
    axes.plot(s, 1e6 * beam, "--", color="black", linewidth=1.0, label="stepped beam")
    axes.plot(profile["s_nm"], 1e6 * profile[f"{name}_rad_per_nm"], "o", label="equilibrium")
    axes.set(xlabel="arc length (nm)", ylabel=f"{name} (1e-6 rad/nm)")
panels[1].legend(loc="upper right")
panels[1].set(ylim=(0, 480))
figure.savefig("cofilin.svg", metadata={"Date": None})
tip = 160.0 * np.mean(curvature * (160.0 - s))
print(f"tip displacement {found.tip_displacement_nm[0]:.4f} nm, of the stepped beam {tip:.4f} nm")
