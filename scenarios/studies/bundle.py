"""Deflection of a bundle of seven filaments against the stiffness of its linkers, compared with a frame of beam elements.

Needs numpy and matplotlib. From the folder of `actin sweep` of bundle-sweep.ron and bundle-push-sweep.ron:
    python3 scenarios/studies/bundle.py
"""

import math

import numpy as np
import study

LENGTH, ELEMENTS, EVERY, SPACING, FORCE = 300.0, 30, 3, 12.0, 0.02  # nm, per filament, elements, nm, pN on each
EA, GA, EI, GJ = 3.4e4, 1.6e4, 3.9e4, 1.3e4  # pN, pN, pN nm^2, pN nm^2
PLACES = np.array([(0.0, 0.0)] + [(SPACING * math.cos(a), SPACING * math.sin(a)) for a in np.arange(6) * math.pi / 3])
PAIRS = [(i, j) for i in range(7) for j in range(i + 1, 7) if abs(math.dist(PLACES[i], PLACES[j]) - SPACING) < 1e-6]


def element(h):
    """Stiffness of a beam element along z for (ux, uy, uz, tx, ty, tz) of both nodes, exact with shear (Przemieniecki)."""
    k = np.zeros((12, 12))
    for axis, rigidity in (2, EA), (5, GJ):
        k[np.ix_([axis, axis + 6], [axis, axis + 6])] += rigidity / h * np.array([[1, -1], [-1, 1]])
    phi = 12 * EI / (GA * h * h)
    for u, t, sign in (0, 4, 1.0), (1, 3, -1.0):
        at = [u, t, u + 6, t + 6]
        block = np.array([
            [12, 6 * h, -12, 6 * h],
            [6 * h, (4 + phi) * h * h, -6 * h, (2 - phi) * h * h],
            [-12, -6 * h, 12, -6 * h],
            [6 * h, (2 - phi) * h * h, -6 * h, (4 + phi) * h * h],
        ]) * EI / (h**3 * (1 + phi))
        signs = np.array([1, sign, 1, sign])
        k[np.ix_(at, at)] += block * np.outer(signs, signs)
    return k


def deflection(stiffness, force=FORCE):
    """Displacement of the end of the middle filament (nm) by linear statics."""
    nodes = ELEMENTS + 1
    matrix = np.zeros((7 * nodes * 6,) * 2)
    one = element(LENGTH / ELEMENTS)
    for filament in range(7):
        for e in range(ELEMENTS):
            at = slice((filament * nodes + e) * 6, (filament * nodes + e + 2) * 6)
            matrix[at, at] += one
    for i, j in PAIRS:
        half = (PLACES[j] - PLACES[i]) / 2
        for node in range(EVERY, nodes, EVERY):
            # Relative displacement of the joined points: u_i + t_i x r - u_j + t_j x r.
            arm = np.array([[0, 0, half[1]], [0, 0, -half[0]], [-half[1], half[0], 0]])
            apart = np.zeros((3, len(matrix)))
            a, b = ((f * nodes + node) * 6 for f in (i, j))
            apart[:, a : a + 3], apart[:, a + 3 : a + 6] = np.eye(3), -arm
            apart[:, b : b + 3], apart[:, b + 3 : b + 6] = -np.eye(3), -arm
            used = np.r_[a : a + 6, b : b + 6]
            matrix[np.ix_(used, used)] += stiffness * apart[:, used].T @ apart[:, used]
    free = np.array([d for d in range(len(matrix)) if d // 6 % nodes])
    loads = np.zeros(len(matrix))
    loads[[(f * nodes + ELEMENTS) * 6 for f in range(7)]] = force
    moved = np.zeros(len(matrix))
    moved[free] = np.linalg.solve(matrix[np.ix_(free, free)], loads[free])
    return moved[ELEMENTS * 6]


def pushed(panel, sweep):
    """Smallest distance of two axes against the force on an outer filament; rows of the table."""
    lines = {}
    for row in study.rows(sweep):
        arrays = study.states(f"{sweep}/runs/{row['point']:.0f}")
        place, filament = arrays["position_nm"][-1], arrays["filament"]
        parts = [place[filament == f] for f in range(7)]
        least = min(np.linalg.norm(a[:, None] - b[None], axis=-1).min() for i, a in enumerate(parts) for b in parts[:i])
        force = row["loads[4].force_pn[0]"]
        moved = [row[f"filaments[{f}].tip_displacement_nm[0]"] for f in (4, 1)]
        lines.setdefault(row["repulsion"] in (None, "None"), []).append((force, least, *moved))
    for without, points in lines.items():
        force, least, *_ = np.array(sorted(points)).T
        panel.semilogx(force, least, "s--" if without else "o-", mfc="none", label="without" if without else "with repulsion")
    panel.axhline(7.4, color="0.6", lw=0.8, ls=":")
    panel.text(min(force), 7.5, "twice the radius", fontsize=8, color="0.4")
    panel.set_xlabel("force on one end (pN)")
    panel.set_ylabel("least distance of axes (nm)")
    panel.legend(fontsize=8)
    both = zip(*(sorted(lines[without]) for without in (True, False)))
    return [[f"{a[0]:g}", *(f"{x:.2f}" for x in (a[1], b[1], a[2], b[2], a[3], b[3]))] for a, b in both]


def main():
    options = study.arguments(["bundle-sweep", "bundle-push-sweep"], __doc__)
    rows = study.rows(options.bundle_sweep)
    stiffness = np.array([row["linkers[0].stiffness_pn_per_nm"] for row in rows])
    tips = np.array([row["tip_displacement_nm[0]"] for row in rows])
    apart = 7 * EI
    together = 7 * EI + EA * (PLACES[:, 0] ** 2).sum()
    rigidity = 7 * FORCE * LENGTH**3 / 3 / tips
    curve = np.geomspace(stiffness.min(), stiffness.max(), 25)
    frame = np.array([deflection(k) for k in curve])
    figure, (panel, beside) = study.axes(2, width=6.8)
    panel.loglog(curve, 7 * FORCE * LENGTH**3 / 3 / frame / EI, "k-", lw=0.8, label="frame of beam elements")
    panel.loglog(stiffness, rigidity / EI, "o", mfc="none", label="bundle")
    for value, label in (apart, "seven filaments apart: 7"), (together, f"seven as one beam: {together / EI:.0f}"):
        panel.axhline(value / EI, color="0.6", lw=0.8, ls=":")
        panel.text(stiffness.min(), value / EI * 1.06, label, fontsize=8, color="0.4")
    panel.set_xlabel("stiffness of a linker (pN/nm)")
    panel.set_ylabel("rigidity / that of one filament")
    panel.legend(loc="center right")
    push = pushed(beside, options.bundle_push_sweep)
    study.save(figure, f"{options.figures}/bundle.svg")
    lines = [[f"{k:g}", f"{t:.4f}", f"{deflection(k):.4f}", f"{r / EI:.1f}"] for k, t, r in zip(stiffness, tips, rigidity)]
    study.put_table(options.page, ["linker (pN/nm)", "end displacement (nm)", "frame of beam elements (nm)",
                                   "rigidity / one filament"], lines, "bundle")
    study.put_table(options.page, ["force (pN)", "least distance of axes (nm)", "with repulsion", "its displacement (nm)",
                                   "with repulsion", "displacement of the opposite one (nm)", "with repulsion"], push, "bundle-push")


if __name__ == "__main__":
    main()
