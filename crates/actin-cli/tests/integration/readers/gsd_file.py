"""Opens run.gsd with the package gsd and compares it with states.npz of the same run."""

import re

import gsd.hoomd
import gsd.pygsd
import numpy as np

states = np.load("run/states.npz")
points = states["s_nm"].size
# The resolved scene contains the time step.
time_step_ns = float(re.search("time_step_ns: ([0-9.e-]+)", open("run/scene.ron").read()).group(1))
with gsd.hoomd.open("run.gsd") as trajectory:
    assert len(trajectory) == states["time_ns"].size > 2
    for i, frame in enumerate(trajectory):
        frame.validate()
        particles = frame.particles
        assert abs(frame.configuration.step * time_step_ns - states["time_ns"][i]) < 1e-9
        assert frame.log["time_ns"][0] == states["time_ns"][i]
        # Stored in single precision.
        assert (particles.position[:points] == states["position_nm"][i].astype(np.float32)).all()
        velocity = states["velocity_nm_per_ns"][i].astype(np.float32)
        assert (particles.velocity[:points] == velocity).all()
        monomers = states["kind"] == 0
        turned = states["quaternion"][i][states["frame_kind"] == 0].astype(np.float32)
        assert (particles.orientation[:points][monomers] == turned).all()
        # All particles are inside the box, less than half its size apart.
        box = frame.configuration.box[:3]
        assert (abs(particles.position) < box / 2).all()
        assert (np.ptp(particles.position, axis=0) < box / 2).all()

    # Two linkers: four end particles after the points.
    assert particles.N == points + 4
    names = np.array(particles.types)[particles.typeid]
    assert particles.types == ["monomer", "node", "monomer_1", "linker"]
    first, second = states["filament"] == 0, states["filament"] == 1
    assert (names[:points][monomers & first] == "monomer").all()
    assert (names[:points][monomers & second] == "monomer_1").all()
    assert (names[:points][~monomers] == "node").all()
    shapes = dict(zip(particles.types, particles.type_shapes))
    assert shapes["monomer"] == {"type": "Ellipsoid", "a": 1.9, "b": 2.7, "c": 2.7}
    assert shapes["monomer_1"] == {"type": "Ellipsoid", "a": 2.0, "b": 2.5, "c": 2.5}
    # Cross-section of 38.5 nm^2.
    assert abs(np.pi * shapes["node"]["diameter"] ** 2 / 4 - 38.5) < 1e-9
    assert (frame.log["particles/s_nm"][:points] == states["s_nm"]).all()
    assert (frame.log["particles/filament"][:points] == states["filament"]).all()

    # Masses of monomers and nodes per length, and moments of inertia of a solid ellipsoid.
    mass, moments = particles.mass, particles.moment_inertia
    monomer = 0.0697
    assert np.allclose(mass[:points][monomers], monomer, rtol=1e-6)
    per_nm = monomer / (71.2 / 26)
    rod = states["s_nm"][~monomers]
    assert np.isclose(mass[:points][~monomers].sum(), per_nm * np.ptp(rod), rtol=1e-6)
    for own, axes in ((first, (1.9, 2.7, 2.7)), (second, (2.0, 2.5, 2.5))):
        a, b, c = axes
        solid = monomer / 5 * np.array([b * b + c * c, a * a + c * c, a * a + b * b])
        assert np.allclose(moments[:points][monomers & own], solid, rtol=1e-6)
    assert not moments[:points][~monomers].any()
    assert not mass[points:].any() and not moments[points:].any()

    bonds = {name: frame.bonds.group[frame.bonds.typeid == i] for i, name in enumerate(frame.bonds.types)}
    count = {name: len(pairs) for name, pairs in bonds.items()}
    n = [int((monomers & one).sum()) for one in (first, second)]
    nodes = int((~monomers & first).sum())
    assert count == {
        "lateral": n[0] + n[1] - 2, "longitudinal": n[0] + n[1] - 4, "segment": nodes - 1, "junction": 2, "linker": 2,
    }, count
    # Helix at rest: rise 71.2 / 26 nm, 12 / 26 turn per monomer, radius 1.8 nm; single precision.
    rest = trajectory[0].particles.position
    far = {name: np.linalg.norm(np.diff(rest[pairs], axis=1), axis=2).ravel() for name, pairs in bonds.items()}
    rise, turn = 71.2 / 26, 2 * np.pi * 12 / 26
    helix = lambda steps: np.hypot(steps * rise, 3.6 * np.sin(steps * turn / 2))
    assert abs(far["lateral"] - helix(1)).max() < 1e-5
    assert abs(far["longitudinal"] - helix(2)).max() < 1e-5
    assert np.ptp(far["segment"]) < 1e-5 and abs(far["segment"].sum() - 30.0) < 1.0
    # The filament axes are 12 nm apart, and the fixed point is at 0.5 nm.
    assert abs(far["linker"] - [12.0, 0.5]).max() < 1e-5, far["linker"]

# The pure Python reader.
with open("run.gsd", "rb") as file:
    plain = gsd.pygsd.GSDFile(file)
    assert plain.schema == "hoomd" and plain.application.startswith("actin ")
    last = plain.read_chunk(frame=plain.nframes - 1, name="particles/position")
    assert (last == particles.position).all()
print(f"read {len(states['time_ns'])} frames of {particles.N} particles")
