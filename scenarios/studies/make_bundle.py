"""Writes the scene and sweeps of the bundle: seven filaments, hexagonally packed 12 nm apart, joined by linkers.

Needs only Python:
    python3 scenarios/studies/make_bundle.py scenarios/studies
"""

import contextlib
import math
import sys
from pathlib import Path

SPACING, LENGTH, SEGMENTS, EVERY = 12.0, 300.0, 30, 30.0  # nm, nm, of each filament, nm between linkers

places = [(0.0, 0.0)] + [(SPACING * math.cos(a), SPACING * math.sin(a)) for a in (math.pi / 3 * i for i in range(6))]
pairs = [(i, j) for i in range(7) for j in range(i + 1, 7) if abs(math.dist(places[i], places[j]) - SPACING) < 1e-6]
assert len(pairs) == 12


def site(i, j):
    """Azimuth (deg) of filament j as seen from filament i."""
    return round(math.degrees(math.atan2(places[j][1] - places[i][1], places[j][0] - places[i][0])) % 360, 6)


def scene():
    print("// Seven filaments on a wall, hexagonally packed, 12 nm apart, joined every 30 nm by linkers that hold two points")
    print("// halfway between neighbours together. A force on every end bends them all. Written by make_bundle.py.")
    print("Scene(")
    print('    title: "A bundle of seven cross-linked filaments",')
    print("    filaments: [")
    for x, y in places:
        print(f"        Filament(sections: [Rod(from_nm: 0.0, to_nm: {LENGTH}, segments: {SEGMENTS})], at_nm: ({x:.6f}, {y:.6f}, 0.0),"
              " rod: RodModel(law: Constant)),")
    print("    ],")
    print("    clamps: [")
    for i in range(7):
        print(f"        Clamp(filament: {i}, end: Start),")
    print("    ],")
    print("    loads: [")
    for i in range(7):
        print(f"        EndForce(filament: {i}, end: End, force_pn: (0.02, 0.0, 0.0)),")
    print("    ],")
    print("    linkers: [")
    for k in range(1, round(LENGTH / EVERY) + 1):
        s = min(EVERY * k, LENGTH)
        for i, j in pairs:
            print(f"        Linker(filament: {i}, at_nm: {s}, radius_nm: {SPACING / 2}, azimuth_deg: {site(i, j)}, to: Site(filament: {j},"
                  f" at_nm: {s}, radius_nm: {SPACING / 2}, azimuth_deg: {site(j, i)}), stiffness_pn_per_nm: 10.0),")
    print("    ],")
    print("    output: (vtk: false),")
    print("    task: Equilibrium(),")
    print(")")


def sweep():
    linkers = round(LENGTH / EVERY) * len(pairs)
    print("// Linkers of ten stiffnesses, all alike. Written by make_bundle.py.")
    print("Sweep(")
    print('    title: "Deflection of a bundle against the stiffness of its linkers",')
    print('    scene: "bundle.ron",')
    print("    vary: [Rows(keys: [")
    for linker in range(linkers):
        print(f'        "linkers[{linker}].stiffness_pn_per_nm",')
    print("    ], rows: [")
    for stiffness in [1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e3, 1e4]:
        print(f"        [{', '.join([str(stiffness)] * linkers)}],")
    print("    ])],")
    print('    results: ["tip_displacement_nm[0]", "filaments[1].tip_displacement_nm[0]", "energy_pn_nm.elastic"],')
    print(")")


def push():
    linkers = round(LENGTH / EVERY) * len(pairs)
    print("// The end of an outer filament is pushed to its neighbours, with weak linkers, with and without repulsion.")
    print("// Written by make_bundle.py.")
    print("Sweep(")
    print('    title: "A filament pushed to its neighbours in a bundle",')
    print('    scene: "bundle.ron",')
    print("    set: [")
    for linker in range(linkers):
        print(f'        Set(key: "linkers[{linker}].stiffness_pn_per_nm", value: 0.01),')
    print("    ],")
    print("    vary: [")
    print('        List(key: "repulsion", values: [None, Repulsion()]),')
    print('        List(key: "loads[4].force_pn[0]", values: [0.1, 0.2, 0.4, 0.8, 1.6, 3.2]),')
    print("    ],")
    print('    results: ["filaments[4].tip_displacement_nm[0]", "tip_displacement_nm[0]", "filaments[1].tip_displacement_nm[0]"],')
    print(")")


for write, name in (scene, "bundle.ron"), (sweep, "bundle-sweep.ron"), (push, "bundle-push-sweep.ron"):
    with open(Path(sys.argv[1]) / name, "w") as file, contextlib.redirect_stdout(file):
        write()
