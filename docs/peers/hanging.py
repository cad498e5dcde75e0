"""The same rod, clamped level at one end, under its weight, in PyElastica and here.

Needs numpy, pyelastica (`pip install pyelastica`) and `actin` on the path (or in ACTIN):
    python3 docs/peers/hanging.py
"""

import json
import os
import subprocess
import tempfile
import time
from pathlib import Path

import elastica as ea
import numpy as np

LENGTH, RADIUS = 160.0, np.sqrt(38.5 / np.pi)  # nm
DENSITY = 0.0697 / (71.2 / 26.0) / 38.5  # 1e-21 kg / nm^3
YOUNG, SHEAR = 330.6, 55.1  # pN / nm^2
WEIGHT = 0.5  # nm / ns^2, downward


class World(ea.BaseSystemCollection, ea.Constraints, ea.Forcing, ea.Damping):
    """One rod with a clamp, weight and damping."""


def pyelastica(elements, duration=300.0):
    """Drop of the tip (nm), rigidities, seconds: moved in time with damping until it rests."""
    rod = ea.CosseratRod.straight_rod(
        elements, np.zeros(3), np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0]), LENGTH, RADIUS, DENSITY,
        youngs_modulus=YOUNG, shear_modulus=SHEAR,
    )
    world = World()
    world.append(rod)
    world.constrain(rod).using(ea.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,))
    world.add_forcing_to(rod).using(ea.GravityForces, acc_gravity=np.array([-WEIGHT, 0.0, 0.0]))
    step = 0.1 * LENGTH / elements / np.sqrt(YOUNG / DENSITY)
    world.dampen(rod).using(ea.AnalyticalLinearDamper, uniform_damping_constant=0.2, time_step=step)
    world.finalize()
    begin = time.perf_counter()
    stepper, now = ea.PositionVerlet(), np.float64(0.0)
    for _ in range(int(duration / step)):
        now = stepper.step(world, now, np.float64(step))
    seconds = time.perf_counter() - begin
    shear, bend = rod.shear_matrix[..., 0].diagonal(), rod.bend_matrix[..., 0].diagonal()
    return -rod.position_collection[0, -1], (shear, bend), seconds


def here(elements, rigidities, hold="Wall"):
    """The same from `Equilibrium`, with a clamp."""
    shear, bend = ("(" + ", ".join(repr(float(x)) for x in row) + ")" for row in rigidities)
    scene = f"""Scene(
    filament: Filament(
        sections: [Rod(from_nm: 0.0, to_nm: {LENGTH}, segments: {elements})],
        rod: RodModel(law: Constant, material: Rigidities(shear_pn: {shear}, bend_pn_nm2: {bend})),
    ),
    clamps: [Clamp(end: Start, hold: {hold})],
    loads: [Acceleration(acceleration_nm_per_ns2: (-{WEIGHT}, 0.0, 0.0))],
    output: (vtk: false, states: false),
    task: Equilibrium(),
)"""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "hanging.ron").write_text(scene)
        subprocess.run([os.environ.get("ACTIN", "actin"), "run", "hanging.ron", "--out", "run"], cwd=folder, check=True, capture_output=True)
        summary = json.loads((Path(folder) / "run/summary.json").read_text())
    return -summary["tip_displacement_nm"][0], summary["wall_s"]


def main():
    pyelastica(4, 1.0)  # compiles it
    print("| elements | PyElastica: drop of the tip (nm) | s | here, hold: NodeAndFrame (nm) | s | here, hold: Wall (nm) |")
    print("| --- | --- | --- | --- | --- | --- |")
    for elements in (8, 16, 32):
        drop, rigidities, seconds = pyelastica(elements)
        own, own_seconds = here(elements, rigidities, "NodeAndFrame")
        wall, _ = here(elements, rigidities)
        print(f"| {elements} | {drop:.3f} | {seconds:.1f} | {own:.3f} | {own_seconds:.3f} | {wall:.3f} |", flush=True)
    print(f"| 1024 | | | | | {here(1024, rigidities)[0]:.3f} |")


if __name__ == "__main__":
    main()
