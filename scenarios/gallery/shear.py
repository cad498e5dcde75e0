"""Measures the shear modulus of periodic networks with 6 to 16 linkers per filament."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
import numpy as np
from actin_filaments.scenes import (
    Equilibrium, Filament, LinkersBetween, Output, PeriodicBox, Random, Rod, RodModel, SettingShear, Stage,
)

filament = Filament(sections=[Rod(from_nm=0.0, to_nm=600.0, segments=8)], rod=RodModel(law="Constant"))


def network(per_filament: float) -> af.Scene:
    """Creates the scene. Its filaments and linkers are listed, so that `scene.set` cannot change their rules."""
    linkers = LinkersBetween(
        per_filament=per_filament, reach_nm=60.0, site_spacing_nm=9.0, stiffness_pn_per_nm=10.0, seed=1
    )
    return af.Scene(
        title="Shear of a periodic network",
        arrangements=[Random(filament=filament, count=40, box_nm=[600.0, 600.0, 600.0], seed=1)],
        linker_sets=[linkers],
        periodic=PeriodicBox(size_nm=[600.0, 600.0, 600.0], strain=0.002),
        path=[Stage(set=[SettingShear(factor=1.0)])],
        observe=["Network"],
        output=Output(vtk=False),
        task=Equilibrium(),
    )


scene = network(10.0)
counts = [6.0, 8.0, 10.0, 13.0, 16.0]
runs = [af.run(network(count)) for count in counts]
moduli = [run.observables["network_stress_xz_pa"][-1] / 0.002 for run in runs]

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, (space, curve) = plt.subplots(1, 2, figsize=(7.2, 3.4))
for k in range(40):
    x, _, z = runs[2].centre_line_nm[-1][runs[2].filament == k].T
    space.plot(x, z, color="0.5", linewidth=0.8)
for linker in runs[2].summary["linkers"]:
    ends = np.array([linker["site_nm"], linker["anchor_nm"]])
    space.plot(*ends[:, [0, 2]].T, color="C1", linewidth=1.2)
space.add_patch(plt.Rectangle((-300, -300), 600, 600, fill=False))
space.set(aspect="equal", xlabel="x (nm)", ylabel="z (nm)")
curve.semilogy(counts, moduli, "o-")
curve.set(xlabel="linkers per filament", ylabel="shear modulus (Pa)")
figure.savefig("shear.svg", metadata={"Date": None})
print(f"shear modulus {moduli[0]:.1f} Pa with 6 linkers per filament, {moduli[-1]:.0f} Pa with 16")
