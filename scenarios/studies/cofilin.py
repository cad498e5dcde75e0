"""Persistence length and torsional rigidity of monomers without and with cofilin, from runs at 298 K.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/cofilin-heat-sweep.ron`:
    python3 scenarios/studies/cofilin.py --cofilin-heat-sweep sweeps/cofilin-heat-sweep
"""

import re

import numpy as np
import study

CORRELATION = "observables.tangent_correlation[0]_over_{}nm.mean"
NEAR, FAR = 22, 66  # nm
SPAN = 38 * 71.2 / 26  # distance of the frames between which the twist is measured (nm)
# Persistence length (um): McCullough and others, J. Mol. Biol. 381 (2008) 550. Torsional rigidity (pN nm^2):
# Prochniewicz and others, J. Mol. Biol. 353 (2005) 990.
PUBLISHED = {"published, bare": (9.8, 2300), "published, cofilin": (2.2, 130)}


def name(sections):
    found = re.findall(r"(lateral|longitudinal|turn)_\w+: (-?[\d.]+)", sections)
    return ", ".join(f"{key} {value}" for key, value in found) or "bare"


def inverse(values, factor):
    """`factor` over the mean of the values, and its standard error."""
    mean, error = np.mean(values), np.std(values, ddof=1) / len(values) ** 0.5
    return factor / mean, factor * error / mean**2


def main():
    options = study.arguments(["cofilin-heat-sweep"], __doc__)
    sweep = options.cofilin_heat_sweep
    runs = {}
    for row in study.rows(sweep, "runs.csv"):
        if row["status"] != "completed":
            continue
        near, far = (row[CORRELATION.format(distance)] for distance in (NEAR, FAR))
        observed = study.columns(f"{sweep}/runs/{row['run']:.0f}/observables.csv")
        twist = 2 * np.pi * observed["contour[0]_twist_turns"][observed["time_ns"] > 5.0]
        runs.setdefault(name(row["filament.sections"]), []).append((np.log(near / far) / (FAR - NEAR), twist))
    lines, bare = [], None
    for kind, values in runs.items():
        slopes, twists = ([value[k] for value in values] for k in (0, 1))
        mean = np.mean(twists)
        found = inverse(slopes, 1e-3), inverse([np.mean((twist - mean) ** 2) for twist in twists], study.KT_298 * SPAN)
        bare = bare or found
        ratios = [own[0] / first[0] for own, first in zip(found, bare)]
        lines.append([kind, f"{found[0][0]:.2f} ± {found[0][1]:.2f}", f"{ratios[0]:.3f}",
                      f"{found[1][0]:.0f} ± {found[1][1]:.0f}", f"{ratios[1]:.3f}"])
    for kind, values in PUBLISHED.items():
        ratios = [own / first for own, first in zip(values, PUBLISHED["published, bare"])]
        lines.append([kind, values[0], f"{ratios[0]:.3f}", values[1], f"{ratios[1]:.3f}"])
    heads = ["monomers", "persistence length (um; J. Mol. Biol. 381 (2008) 550)", "over bare", "torsional rigidity (pN nm^2; J. Mol. Biol. 353 (2005) 990)", "over bare"]
    study.put_table(options.page, heads, lines, "cofilin")


if __name__ == "__main__":
    main()
