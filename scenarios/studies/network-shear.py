"""Shear modulus of periodic networks by number of linkers, with soft, measured and rigid twist.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/network-shear-sweep.ron`:
    python3 scenarios/studies/network-shear.py --network-shear-sweep sweeps/network-shear-sweep
"""

import numpy as np
import study

STRAIN = 0.005
LINKERS, MATERIAL = "linker_sets[0].per_filament", "arrangements[0].filament.rod.material"
STRESS = "observables.network_stress_xz_pa.last"
KINDS = {13.0: "0.001 C", 1.3e4: "C = 1.3e4 pN nm²", 1.3e7: "1000 C"}


def twist(row):
    """Twisting rigidity (pN nm^2)."""
    bend = row[MATERIAL].split("bend_pn_nm2:")[1]
    return study.vector(bend.replace("))", ")").strip())[2]


def read(sweep):
    """Shear moduli (Pa) of all seeds, by twisting rigidity and linkers per filament."""
    found = {}
    for row in study.rows(sweep):
        if row[STRESS] is not None:
            found.setdefault((twist(row), row[LINKERS]), []).append(row[STRESS] / STRAIN)
    return found


def main():
    options = study.arguments(["network-shear-sweep"], __doc__)
    found = read(options.network_shear_sweep)
    linkers = sorted({count for _, count in found})
    figure, panel = study.axes(width=4.6)
    for place, (key, label) in enumerate(KINDS.items()):
        known = [count for count in linkers if (key, count) in found]
        moduli = np.array([np.mean(found[key, count]) for count in known])
        spread = [[min(found[key, count]) for count in known], [max(found[key, count]) for count in known]]
        shifted = np.array(known) * 1.01 ** (place - 1)
        panel.errorbar(shifted, moduli, abs(np.array(spread) - moduli), fmt="o-", capsize=2, label=label)
    panel.set_yscale("log")
    panel.set_xlabel("linkers per filament")
    panel.set_ylabel("shear modulus (Pa)")
    panel.legend(fontsize=7)
    study.save(figure, f"{options.figures}/network-shear.svg")
    lines = [[f"{count:g}", *(" / ".join(f"{one:.3g}" for one in found.get((key, count), [])) for key in KINDS)]
             for count in linkers]
    study.put_table(options.page, ["linkers per filament", *(f"{label} (Pa)" for label in KINDS.values())], lines,
                    "network-shear")


if __name__ == "__main__":
    main()
