"""Opens run.simularium with the package simulariumio and compares it with states.npz of the same run."""

import numpy as np
from scipy.spatial.transform import Rotation
from simulariumio import FileConverter, InputFileData, JsonWriter

states = np.load("run/states.npz")
converter = FileConverter(InputFileData("run.simularium"))
data = converter._data
agents = data.agent_data
assert (agents.times == states["time_ns"]).all()
assert (data.time_units.name, data.spatial_units.name) == ("ns", "nm")
assert data.meta_data.trajectory_title == "two <filaments>"

monomers, n = states["kind"] == 0, int((states["kind"] == 0).sum())
for i in range(len(agents.times)):
    # All monomers, one rod, two linkers.
    assert agents.n_agents[i] == n + 3
    names = np.array(agents.types[i])
    balls = np.char.startswith(names, "monomer")
    assert abs(agents.positions[i][: n + 3][balls] - states["position_nm"][i][monomers]).max() < 1e-4
    w, x, y, z = states["quaternion"][i][states["frame_kind"] == 0].T
    turned = Rotation.from_quat(np.stack([x, y, z, w], axis=1))
    drawn = Rotation.from_euler("XYZ", agents.rotations[i][: n + 3][balls])
    # Stored in single precision.
    assert (turned.inv() * drawn).magnitude().max() < 1e-5
    rod = list(names).index("rod")
    nodes = agents.subpoints[i][rod][: int(agents.n_subpoints[i][rod])].reshape(-1, 3)
    assert abs(nodes - states["position_nm"][i][~monomers]).max() < 1e-4
assert sorted(set(names)) == ["linker", "monomer", "monomer_1", "rod"]
for name, largest, smallest in [("monomer", 2.7, 1.9), ("monomer_1", 2.5, 2.0)]:
    shown = data.agent_data.display_data[name]
    assert shown.display_type.value == "OBJ" and shown.url == f"run_{name}.obj"
    assert abs(agents.radii[0][: n + 3][names == name] - largest).max() < 1e-6
    corners = [line.split()[1:] for line in open(shown.url) if line.startswith("v ")]
    span = abs(np.array(corners, float)).max(axis=0)
    # Semi-axes relative to the largest; x is the thin axis. Accuracy of 24 facets.
    assert abs(span[0] * largest - smallest).max() < 0.03 and abs(span[2] - 1.0) < 1e-6, span
# The data can be written again.
assert JsonWriter.format_trajectory_data(data)["trajectoryInfo"]["totalSteps"] == len(agents.times)
print(f"read {len(agents.times)} frames of {n + 3} agents")
