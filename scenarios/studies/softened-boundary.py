"""Energy per length of a stretch with cofilin that is resolved as a whole or in part, and near its boundary.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/softened-boundary-sweep.ron`:
    python3 scenarios/studies/softened-boundary.py --softened-boundary-sweep sweeps/softened-boundary-sweep
"""

import re

import numpy as np
import study

STRETCH = (120.0, 180.0)  # nm
BIN = 2 * 71.2 / 26  # two monomers (nm)


def resolved(sections):
    """Resolved part of the filament: what the sections of monomers cover."""
    spans = [tuple(map(float, span)) for span in re.findall(r"Ellipsoids\(from_nm: ([\d.]+), to_nm: ([\d.]+)", sections)]
    if not spans:
        return "rods"
    start, end = spans[0][0], spans[-1][1]
    if start == 0.0:
        return "monomers"
    inside = min(end, STRETCH[1]) - max(start, STRETCH[0])
    if inside < STRETCH[1] - STRETCH[0]:
        return f"{inside:g} nm of the stretch"
    return f"the stretch and {STRETCH[0] - start:g} nm on both sides"


def largest(points):
    """Largest energy per length (pN), and its place (nm)."""
    point = max(points, key=lambda point: point["energy_per_length_pn"])
    return point["energy_per_length_pn"], point["s_nm"]


def peaks(found):
    """Rows by the resolved part: range of peaks relative to monomers, and their largest displacement."""
    rows = []
    for kind in found[min(found)]:
        row = [kind]
        for runs in found.values():
            both = runs[kind].keys() & runs["monomers"].keys()
            own, monomers = (np.array([largest(runs[name][direction]) for direction in both]) for name in (kind, "monomers"))
            ratios, shifts = own[:, 0] / monomers[:, 0], abs(own[:, 1] - monomers[:, 1])
            row.append(f"{ratios.min():.2f} to {ratios.max():.2f}, {shifts.max():.0f} nm")
        rows.append(row)
    return rows


def beside_boundary(runs):
    """Energies per length by distance (nm) from the nearest boundary, positive in the stretch; averages of BIN."""
    points = [point for run in runs.values() for point in run]
    s, energies = (np.array([point[key] for point in points]) for key in ("s_nm", "energy_per_length_pn"))
    bins = np.floor(np.minimum(s - STRETCH[0], STRETCH[1] - s) / BIN)
    bare = energies[(bins >= -18) & (bins < -8)].mean()
    return {(k + 0.5) * BIN: energies[bins == k].mean() / bare for k in range(-5, 5)}


def main():
    options = study.arguments(["softened-boundary-sweep"], __doc__)
    sweep = options.softened_boundary_sweep
    found = {}
    for row in study.rows(sweep):
        x, y, _ = study.vector(row["path[0].set[0].turn_deg"])
        runs = found.setdefault(round(np.hypot(x, y)), {}).setdefault(resolved(row["filament.sections"]), {})
        if not row["failed"]:
            runs[round(np.degrees(np.arctan2(x, y)))] = study.rows(f"{sweep}/runs/{row['point']:.0f}", "profile.csv")
    heads = ["resolved", *(f"ends turned by {turn} deg" for turn in found)]
    study.put_table(options.page, heads, peaks(found), "softened-boundary")
    energies = {turn: beside_boundary(runs["monomers"]) for turn, runs in found.items()}
    heads = ["ends turned by (deg); distance into the stretch", *(f"{distance:+.1f} nm" for distance in energies[min(energies)])]
    lines = [[turn, *(f"{value:.2f}" for value in values.values())] for turn, values in energies.items()]
    study.put_table(options.page, heads, lines, "boundary-energy")


if __name__ == "__main__":
    main()
