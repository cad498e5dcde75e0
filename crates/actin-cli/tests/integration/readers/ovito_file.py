"""Opens run.gsd with OVITO and checks shapes, orientations and bonds."""

import numpy as np
from ovito.io import import_file

states = np.load("run/states.npz")
pipeline = import_file("run.gsd")
assert pipeline.source.num_frames == states["time_ns"].size
last = pipeline.source.num_frames - 1
data = pipeline.compute(last)
particles, points = data.particles, states["s_nm"].size
assert particles.count == points + 4
assert abs(particles.positions[:points] - states["position_nm"][last]).max() < 1e-4
# OVITO stores x, y, z, w; both signs are the same rotation.
monomers = states["kind"] == 0
x, y, z, w = particles.orientations[:points][monomers].T
same = (np.stack([w, x, y, z]).T * states["quaternion"][last][states["frame_kind"] == 0]).sum(axis=1)
assert abs(abs(same) - 1).max() < 1e-6
# Cross-section of 38.5 nm^2.
radius = {t.name: t.radius for t in particles.particle_types.types}
assert abs(np.pi * radius["node"] ** 2 - 38.5) < 1e-4
shapes = np.array(particles["Aspherical Shape"])
assert abs(shapes[:points][monomers & (states["filament"] == 0)] - [1.9, 2.7, 2.7]).max() < 1e-6
bonds = data.particles.bonds
lengths = np.linalg.norm(np.diff(particles.positions[bonds.topology], axis=1)[:, 0], axis=1)
# No bond crosses the periodic boundary.
assert not np.array(bonds.pbc_vectors).any() and lengths.max() < 13.0
print(f"read {last + 1} frames of {particles.count} particles and {bonds.count} bonds")
