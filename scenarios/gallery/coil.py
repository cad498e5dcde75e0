"""Turns one end of a filament by four turns and pushes the ends together: twist becomes writhe, and a loop forms."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
import numpy as np
from actin_filaments.scenes import (
    Clamp, Contour, EndReaction, Equilibrium, Filament, Force, LoadFactor, Rod, RodModel, Shift, Stage, Turn,
)

scene = af.Scene(
    title="Coiling of a twisted filament",
    filament=Filament(sections=[Rod(from_nm=0.0, to_nm=1000.0, segments=100)], rod=RodModel(law="Constant")),
    clamps=[Clamp(end="Start"), Clamp(end="End")],
    loads=[Force(at_nm=450.0, force_pn=[0.002, 0.0, 0.0])],
    path=[
        Stage(set=[LoadFactor(load=0, factor=1.0), Turn(end="End", turn_deg=[0.0, 0.0, 1440.0])]),
        Stage(set=[Shift(end="End", shift_nm=[0.0, 0.0, -420.0])]),
    ],
    observe=[Contour(), EndReaction(end="End")],
    task=Equilibrium(largest_step=0.02),
)
run = af.run(scene)
twist = run.observables["contour[0]_twist_turns"]
turns = 4.0 * np.clip(run.path, 0.0, 1.0)
writhe = turns - twist
couple = run.observables["reaction[0]_end_torque_z_pn_nm"][np.searchsorted(run.path, 1.0)]

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, (curve, shapes) = plt.subplots(1, 2, figsize=(7.2, 2.9), width_ratios=[1, 1.5])
curve.plot(run.path, turns, "--", color="black", label="link (turns of the end)")
curve.plot(run.path, twist, label="twist")
curve.plot(run.path, writhe, label="writhe")
curve.set(xlabel="stages of the path", ylabel="turns")
curve.legend()
for shade, at in zip((0.0, 0.35, 0.6, 0.85), (1.0, 1.3, 1.65, 2.0)):
    x, y, z = run.centre_line_nm[np.searchsorted(run.path, at - 1e-9)].T
    # Oblique view, in which the loop is open.
    shapes.plot(0.94 * z + 0.34 * x, 0.9 * y + 0.4 * x, color=plt.get_cmap()(shade), label=f"stage {at:g}")
shapes.plot([0, 200], [-100, -100], color="black")
shapes.text(100, -90, "200 nm", ha="center")
shapes.set(aspect="equal", ylim=(-110, 350))
shapes.set_axis_off()
shapes.legend(loc="upper right", ncols=2)
figure.savefig("coil.svg", metadata={"Date": None})
theory = 2.0 * np.pi * 4.0 * 1.3e4 / 1000.0
print(f"couple of 4 turns {couple:.1f} pN nm (C turns / length: {theory:.1f}); writhe of the loop {writhe[-1]:.2f} turns")
