"""Force over time while 500 nm are compressed to 350 nm at every resolution, compared with the elastica.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/compression-sweep.ron`:
    python3 scenarios/studies/compression.py --compression-sweep sweeps/compression-sweep
"""

import numpy as np
import study

LENGTH, BEND = 500.0, 3.9e4  # nm, pN nm^2


def elliptic(m):
    """Complete elliptic integrals K and E of the parameter m, by the arithmetic-geometric mean."""
    a, b, c, power, total = 1.0, np.sqrt(1 - m), np.sqrt(m), 1.0, 1 - m / 2
    while np.max(np.abs(c)) > 1e-15:
        a, b, c = (a + b) / 2, np.sqrt(a * b), (a - b) / 2
        total = total - power * c**2
        power *= 2
    k = np.pi / (2 * a)
    return k, k * total


def elastica(shortening):
    """Force (pN) on an inextensible rod between clamped ends at an end displacement (nm): four equal arcs, each
    with 1 - d/L = 2 E(m)/K(m) - 1 and F = 16 K(m)^2 B / L^2."""
    m = np.linspace(1e-9, 0.6, 4000)
    k, e = np.array([elliptic(x) for x in m]).T
    return np.interp(shortening, LENGTH * (2 - 2 * e / k), 16 * k**2 * BEND / LENGTH**2)


def name(row):
    sections, law = row["filament.sections"], row["filament.rod.law"]
    if "Rod" not in sections:
        return "monomers"
    return f"100 nm of monomers, {law}" if "Ellipsoids" in sections else f"rod, {law}"


def force(run):
    """Times (ns) and force (pN), the mean of both ends, in which drag cancels."""
    (time, pushed), (_, pulled) = (study.observed(run, f"reaction[0]_{end}_force_z_pn") for end in ("start", "end"))
    return time, (pushed - pulled) / 2


def main():
    options = study.arguments(["compression-sweep"], __doc__)
    figure, panel = study.axes(width=5.4, height=3.2)
    lines = []
    for i, row in enumerate(study.rows(options.compression_sweep)):
        run = f"{options.compression_sweep}/runs/{row['point']:.0f}"
        time, pressed = force(run)
        panel.plot(time, pressed, "-" if "rod," in name(row) else "--", color=f"C{i}", label=name(row))
        at = lambda share: np.interp(share * time[-1], time, pressed)
        lines.append([name(row), *(f"{at(x):.2f}" for x in (0.2, 0.5, 0.8, 1.0)), f"{row['shape.largest_distance_nm']:.1f}", f"{abs(row['shape.twist_turns']):.3f}"])
    way = np.linspace(0, 150, 200)
    panel.plot(time[-1] * way / 150, elastica(way), "k:", lw=1.0, label="elastica, B = 3.9e4 pN nm²")
    lines.append(["elastica", *(f"{elastica(x):.2f}" for x in (30, 75, 120, 150)), "", ""])
    panel.set_ylim(5, 8.5)
    panel.set_xlabel("time (ns); 0.1 nm/ns")
    panel.set_ylabel("force (pN)")
    panel.legend(fontsize=7)
    study.save(figure, f"{options.figures}/compression.svg")
    study.put_table(options.page, ["filament", "force (pN) at 470 nm", "425 nm", "380 nm", "350 nm",
                                   "largest distance from the axis (nm)", "turns of twist"], lines, "compression")


if __name__ == "__main__":
    main()
