"""Opens run.gsd with MDAnalysis and checks positions, names and bonds."""

import MDAnalysis
import numpy as np

states = np.load("run/states.npz")
universe = MDAnalysis.Universe("run.gsd")
points = states["s_nm"].size
assert len(universe.trajectory) == states["time_ns"].size
for i, _ in enumerate(universe.trajectory):
    assert abs(universe.atoms.positions[:points] - states["position_nm"][i]).max() < 1e-4
assert len(universe.select_atoms("type monomer monomer_1")) == (states["kind"] == 0).sum()
# Bonds connect each filament, including its junction, and the two ends of each linker.
pieces = sorted(len(piece) for piece in universe.atoms.fragments)
assert pieces == [2, 2, *sorted(np.bincount(states["filament"]))], pieces
print(f"read {len(universe.trajectory)} frames of {len(universe.atoms)} atoms and {len(universe.bonds)} bonds")
