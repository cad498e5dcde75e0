"""Motors that stay at the ends of filaments contract a bundle of mixed polarity; motors that leave the ends do not."""

from pathlib import Path

import actin_filaments as af
import matplotlib.pyplot as plt
from actin_filaments.scenes import Breaking, Brownian, Bundle, Crosslinkers, Filament, Output, Rod, RodModel, Stepping

filament = Filament(sections=[Rod(from_nm=0.0, to_nm=1000.0, segments=10)], rod=RodModel(law="Constant"))
motors = Crosslinkers(
    count=100, stiffness_pn_per_nm=0.5, rest_length_nm=20.0, attach_per_ns=1e-5, bind_per_ns=1e-5,
    unbinds=Breaking(rate_per_ns=1e-7),
    steps=Stepping(step_nm=5.5, rate_per_ns=2e-5, stall_pn=4.0, leaves_at_end=False),
    seed=2,
)
scene = af.Scene(
    title="Contraction by motors",
    arrangements=[
        Bundle(filament=filament, count=12, spacing_nm=20.0, stagger_nm=1500.0, mixed_polarity=True, seed=1),
    ],
    crosslinkers=[motors],
    observe=["Network"],
    output=Output(vtk=False),
    task=Brownian(duration_ms=4.0, temperature_k=298.0, seed=3),
)
run = af.run(scene)
leaving = af.run(scene.set("crosslinkers[0].steps.leaves_at_end", True))

plt.style.use(Path(__file__).with_name("gallery.mplstyle"))
figure, panels = plt.subplot_mosaic([["curve", "before"], ["curve", "after"]], figsize=(7.2, 3.0), width_ratios=[1, 1.5])
curve = panels["curve"]
for one, label in ((run, "motors stay at ends"), (leaving, "motors leave ends")):
    curve.plot(one.time_ns * 1e-6, one.observables["network_gyration_radius_nm"], label=label)
curve.set(xlabel="time (ms)", ylabel="radius of gyration (nm)", ylim=(405, 525))
curve.legend(loc="upper center")
for name, frame in (("before", run[0]), ("after", run[-1])):
    for k in range(12):
        first = run[0].centre_line_nm[run.filament == k, 2]
        x, _, z = frame.centre_line_nm[run.filament == k].T
        panels[name].plot(z, x, color="C0" if first[-1] > first[0] else "C1", linewidth=1.0)
    panels[name].set(aspect="equal", xlim=(-100, 2500), ylim=(-500, 500))
    panels[name].text(-100, 300, f"{frame.time_ns * 1e-6:g} ms")
    panels[name].set_axis_off()
panels["after"].plot([0, 500], [-400, -400], color="black")
panels["after"].text(250, -330, "500 nm", ha="center")
figure.savefig("contraction.svg", metadata={"Date": None})
start, end = run.observables["network_gyration_radius_nm"][[0, -1]]
print(f"radius of gyration {start:.0f} nm at the start, {end:.0f} nm after 4 ms")
