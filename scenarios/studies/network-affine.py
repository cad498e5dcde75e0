"""Shear moduli of periodic networks relative to the affine estimate.

In the estimate, filaments are stretched by linkers whose other ends follow the strain of the box:

    G = mu rho / 15 (1 - tanh(xi) / xi),   xi = L / 2 sqrt(n k / (L mu))

with the stretching rigidity `mu`, the length per volume `rho`, the length `L`, the ends of linkers per filament `n`
and their stiffness `k`. From the folder of `actin sweep scenarios/studies/network-affine-sweep.ron`:
    python3 scenarios/studies/network-affine.py --network-affine-sweep sweeps/network-affine-sweep
"""

import math

import study

STRETCH, LENGTH, BOX, LINKER = 3.4e4, 600.0, 700.0, 10.0
PA = 1e6  # per pN/nm^2
MATERIAL = "arrangements[0].filament.rod.material"


def affine(filaments, linkers):
    """Shear modulus (Pa) of `filaments` with `linkers` per filament."""
    xi = LENGTH / 2 * math.sqrt(2 * linkers * LINKER / (LENGTH * STRETCH))
    return PA * STRETCH * filaments * LENGTH / BOX**3 / 15 * (1 - math.tanh(xi) / xi)


if __name__ == "__main__":
    options = study.arguments(["network-affine-sweep"], __doc__)
    found = {}
    for row in study.rows(options.network_affine_sweep):
        counts = row["arrangements[0].count"], row["linker_sets[0].per_filament"]
        modulus = row["observables.network_stress_xz_pa.last"] / row["periodic.strain"]
        kind = "rigid" if "3.9e8" in row[MATERIAL] else "flexible"
        found.setdefault(counts, {})[kind] = f"{modulus:.3g} ({modulus / affine(*counts):.2g})"
    lines = [
        [f"{counts[0]:g}", f"{counts[1]:g}", f"{affine(*counts):.3g}", moduli["flexible"], moduli.get("rigid", "")]
        for counts, moduli in found.items()
    ]
    head = ["filaments", "linkers per filament", "affine (Pa)", "actin (Pa, of affine)", "rigid"]
    study.put_table(options.page, head, lines, "network-affine")
