"""Measures the persistence length of 1 um in water at 298 K from the correlation of tangents."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
import numpy as np
from actin_filaments.scenes import Output, TangentCorrelation

scene = af.Scene.from_file(Path(__file__).parents[1] / "studies/water.ron")
distances = np.arange(40.0, 801.0, 80.0)
scene = scene.with_(
    {"task.duration_ms": 40.0, "task.record_every_ns": 4e4},
    observe=[TangentCorrelation(over_nm=distance) for distance in distances],
    output=Output(vtk=False),
    burn_in_ns=4e6,
)
run = af.run(scene)
found = [run.summary["observables"][f"tangent_correlation[0]_over_{distance:g}nm"] for distance in distances]
means, errors = (np.array([one[key] for one in found]) for key in ("mean", "error"))

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, (shapes, curve) = plt.subplots(1, 2, figsize=(7.2, 3.0))
for frame in run[::50]:
    line = frame.centre_line_nm - frame.centre_line_nm[0]
    # In the plane of the first tangent and the end.
    tangent = line[1] / np.linalg.norm(line[1])
    along = line @ tangent
    across = line - np.outer(along, tangent)
    shapes.plot(along, across @ across[-1] / np.linalg.norm(across[-1]), color="C0", alpha=0.5, linewidth=0.8)
shapes.set(xlabel="along the first tangent (nm)", ylabel="across (nm)", aspect="equal")
theory = 3.9e4 / (0.0138065 * 298.0)
curve.errorbar(distances, means, errors, fmt="o", label="run")
curve.plot(distances, np.exp(-distances / theory), "--", color="black", linewidth=1.0, label="exp(-s kT / B)")
curve.set(xlabel="distance s (nm)", ylabel="mean cosine of tangents")
curve.legend()
figure.savefig("persistence.svg", metadata={"Date": None})
length = 1e-3 * found[2]["persistence_length_nm"]
print(f"persistence length {length:.1f} um; B / kT: {1e-3 * theory:.1f} um")
