"""Frequency response of a driven end: amplitude and phase, compared with a damped Euler-Bernoulli beam.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/sine-sweep.ron`:
    python3 scenarios/studies/sine.py --sine-sweep sweeps/sine-sweep
"""

import re

import numpy as np
import study

LENGTH, FORCE, BEND = 100.0, 0.1, 3.9e4  # nm, pN, pN nm^2
DENSITY = 0.0697 / (71.2 / 26.0)  # ag/nm
SETTLED = 200.0  # ns: 10 times the slowest decay


def receptance(omega, drag):
    """Receptance of the free end of a cantilever (nm/pN): beta^4 = (rho w^2 - i rho g w)/B."""
    beta = (DENSITY * omega * (omega - 1j * drag) / BEND) ** 0.25
    x = beta * LENGTH
    return (np.sin(x) * np.cosh(x) - np.cos(x) * np.sinh(x)) / (BEND * beta**3 * (1 + np.cos(x) * np.cosh(x)))


def measured(run, period):
    """Receptance from the motion of the end, by least squares over whole periods, and relative residual."""
    time, place = study.observed(run, "tip[0]_x_nm")
    begin = time[-1] - period * np.floor((time[-1] - min(SETTLED, 0.5 * time[-1])) / period)
    late = time >= begin - 1e-9
    phase = 2 * np.pi * time[late] / period
    parts = np.array([np.sin(phase), np.cos(phase), np.ones_like(phase)]).T
    (sine, cosine, _), left, *_ = np.linalg.lstsq(parts, place[late], rcond=None)
    rest = np.sqrt(left.sum() / late.sum() * 2) / np.hypot(sine, cosine)
    return (sine + 1j * cosine) / FORCE, rest


def main():
    options = study.arguments(["sine-sweep"], __doc__)
    found = {}
    for row in study.rows(options.sine_sweep):
        kinds = ["rod" if "Ellip" not in row["filament.sections"] else "monomers"]
        if "Ellip" in row["filament.sections"] and "Rod" in row["filament.sections"]:
            kinds = ["half of each"]
        period = float(re.search(r"period_ns: ([\d.]+)", row["loads[0].factor"])[1])
        drag = row["task.drag.translational_per_ns"]
        run = f"{options.sine_sweep}/runs/{row['point']:.0f}"
        found.setdefault((kinds[0], drag), []).append((period, *measured(run, period)))
    figure, panels = study.axes(2, width=6.8)
    drags = sorted({drag for _, drag in found})
    omega = np.geomspace(0.03, 5.0, 600)
    for drag, style in zip(drags, ["-", "--"]):
        theory = receptance(omega, drag)
        panels[0].loglog(omega, abs(theory), "k" + style, lw=0.8, label=f"beam, drag {drag:g}/ns")
        panels[1].semilogx(omega, np.degrees(np.unwrap(np.angle(theory))), "k" + style, lw=0.8)
    lines = []
    for (kind, drag), points in found.items():
        period, response, rest = map(np.array, zip(*sorted(points)))
        w = 2 * np.pi / period
        marker = {"rod": "o", "half of each": "s", "monomers": "^"}[kind]
        colour = f"C{['rod', 'half of each', 'monomers'].index(kind)}"
        theory = receptance(w, drag)
        phase = np.angle(response / theory) + np.interp(w, omega, np.unwrap(np.angle(receptance(omega, drag))))
        label = kind if drag == drags[0] else None
        panels[0].loglog(w, abs(response), marker, color=colour, mfc="none", label=label)
        panels[1].semilogx(w, np.degrees(phase), marker, color=colour, mfc="none")
        error = abs(response / theory - 1)
        lines.append([kind, f"{drag:g}", f"{abs(response).max():.1f}", f"{period[abs(response).argmax()]:g}",
                      f"{100 * np.median(error):.1f}", f"{100 * np.median(rest):.1f}"])
    for panel, label in zip(panels, ["displacement over force (nm/pN)", "phase (°)"]):
        panel.set_xlabel("angular frequency (rad/ns)")
        panel.set_ylabel(label)
    panels[0].legend(fontsize=8)
    study.save(figure, f"{options.figures}/sine.svg")
    study.put_table(options.page, ["filament", "drag (1/ns)", "largest response (nm/pN)", "at period (ns)",
                                   "median difference from the beam (%)", "not at the driven frequency (%)"], lines, "sine")


if __name__ == "__main__":
    main()
