"""Draws a network of 100 filaments and 250 linkers in water, coloured by the tension of the linkers."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Line3DCollection

scene = af.Scene.from_file(Path(__file__).parents[1] / "random-network.ron")
run = af.run(scene.set("task.duration_ms", 0.4))
linkers = run.summary["linkers"]
ends = np.array([[linker["site_nm"], linker["anchor_nm"]] for linker in linkers])
tension = np.array([0.2 * linker["extension_nm"] for linker in linkers])

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure = plt.figure(figsize=(6.4, 4.6))
axes = figure.add_subplot(projection="3d")
last = run[-1].centre_line_nm
axes.add_collection(Line3DCollection([last[run.filament == k] for k in range(100)], color="0.6", linewidth=0.9))
drawn = axes.add_collection(Line3DCollection(ends, array=tension, clim=(-2.5, 2.5), linewidth=2.2))
low, high = last.min(axis=0), last.max(axis=0)
axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
axes.set_box_aspect(high - low, zoom=1.5)
axes.set_axis_off()
figure.colorbar(drawn, label="tension of a linker (pN)", shrink=0.7, pad=0.0)
figure.savefig("network.png", bbox_inches="tight")

squares = run.observables["network_linker_tension_rms_pn"][5:] ** 2
print(f"rms tension {np.sqrt(squares.mean()):.2f} pN; equipartition, sqrt(k kT): {np.sqrt(0.2 * 0.0138065 * 298.0):.2f} pN")
