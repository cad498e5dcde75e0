"""Sweeps force and rod law of a cantilever, and prints a table of the results. Needs pandas."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
from actin_filaments.scenes import Clamp, EndForce, Equilibrium, Filament, Rod

scene = af.Scene(
    title="Cantilever",
    filament=Filament(sections=[Rod(from_nm=0.0, to_nm=160.0, segments=16)]),
    clamps=[Clamp(end="Start")],
    loads=[EndForce(end="End", force_pn=[1.0, 0.0, 0.0])],
    task=Equilibrium(),
)
FORCE, LAW, TIP = "loads[0].force_pn[0]", "filament.rod.law", "tip_displacement_nm[0]"
forces = [0.1, 0.25, 0.5, 0.75, 1.0]
laws = ["Constant", "Fitted", "Homogenised"]
table = af.sweep(scene, {FORCE: forces, LAW: laws}, [TIP, "energy_pn_nm.elastic"], jobs=2, progress=False)

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, axes = plt.subplots(figsize=(5.6, 3.2))
for law in laws:
    rows = table[LAW] == law
    axes.plot(table[FORCE][rows], table[TIP][rows], "o-", label=law)
axes.set(xlabel="force (pN)", ylabel="tip displacement (nm)", xlim=(0, None), ylim=(0, None))
axes.legend()
figure.savefig("sweep.svg", metadata={"Date": None})
print(table.to_dataframe().pivot(index=FORCE, columns=LAW, values=TIP))
run = table[1.0, "Homogenised"]
print(f"{len(table)} runs; tip displacement at 1 pN under Homogenised {run.summary['tip_displacement_nm'][0]:.2f} nm")
