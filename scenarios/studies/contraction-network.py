"""Contraction of flat networks by number of motors and crosslinkers: change of the radius of gyration.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/contraction-network-sweep.ron`:
    python3 scenarios/studies/contraction-network.py --contraction-network-sweep sweeps/contraction-network-sweep
"""

import study

FILAMENTS, COUNTS = 60, ["crosslinkers[0].count", "crosslinkers[1].count"]

if __name__ == "__main__":
    options = study.arguments(["contraction-network-sweep"], __doc__)
    found = {}
    for row in study.rows(options.contraction_network_sweep):
        run = f"{options.contraction_network_sweep}/runs/{row['point']:g}"
        _, radius = study.observed(run, "network_gyration_radius_nm")
        _, bound = study.observed(run, "network_bound_linkers")
        change = 100 * (radius[-1] / radius[0] - 1)
        found.setdefault(tuple(row[key] for key in COUNTS), []).append((change, bound[-1] / FILAMENTS))
    lines = [
        [*(f"{count / FILAMENTS:.2g}" for count in counts),
         *(" / ".join(f"{one:.1f}" for one in values) for values in zip(*runs))]
        for counts, runs in found.items()
    ]
    head = ["motors per filament", "crosslinkers", "change of the radius of gyration (%)", "bound connectors"]
    study.put_table(options.page, head, lines, "contraction-network")
