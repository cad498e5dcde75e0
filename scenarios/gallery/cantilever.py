"""Bends a cantilever with every monomer, and with monomers only at the wall."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
from actin_filaments.scenes import Clamp, Ellipsoids, EndForce, Equilibrium, Filament, Rod

scene = af.Scene(
    title="Bent cantilever",
    filament=Filament(sections=[Ellipsoids(from_nm=0.0, to_nm=160.0)]),
    clamps=[Clamp(end="Start")],
    loads=[EndForce(end="End", force_pn=[-1.0, 0.0, 0.0])],
    task=Equilibrium(),
)
mixed = scene.set("filament.sections", [Ellipsoids(from_nm=0.0, to_nm=40.0), Rod(from_nm=40.0, to_nm=160.0)])

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, axes = plt.subplots(figsize=(6.4, 2.3))
forces, tips = [-0.25, -0.5, -1.0], []
for colour, (label, model) in enumerate({"every monomer": scene, "40 nm of monomers, then a rod": mixed}.items()):
    for force in forces:
        found = af.equilibrium(model.set("loads[0].force_pn[0]", force))
        x, _, z = found.centre_line_nm.T
        axes.plot(z, -x, ["-", "--"][colour], color=f"C{colour}", label=label if force == -1.0 else None)
        if colour == 0:
            axes.annotate(f" {-force:g} pN", (z[-1], -x[-1]), va="bottom")
        if force == -1.0:
            tips.append(found.tip_displacement_nm[0])
axes.set(xlabel="z (nm)", ylabel="deflection (nm)", aspect="equal", xlim=(-5, 180))
axes.legend(loc="upper left")
figure.savefig("cantilever.svg", metadata={"Date": None})
print(f"tip displacement at 1 pN: {tips[0]:.2f} nm with every monomer, {tips[1]:.2f} nm with 40 nm of monomers")
