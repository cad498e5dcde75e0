"""Distribution of the end's turn along a filament with a softened middle, compared with stepped beams.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/softened-sweep.ron`:
    python3 scenarios/studies/softened.py --softened-sweep sweeps/softened-sweep
"""

import numpy as np
import study

BARE, SOFT, MIDDLE, CONSTANT, FITTED, HOMOGENISED = range(6)
LAWS = {"Constant": CONSTANT, "Fitted": FITTED, "Homogenised": HOMOGENISED}
BENDING, TWIST = 5.0, 10.0  # softening factors of the middle
EDGES = np.array([50.0, 100.0])  # nm
LISTED = [30.0, 60.0, 120.0, -30.0, -60.0, -120.0]  # turns in the table (deg)


def variant(row):
    sections = row["filament.sections"]
    if "Rod" in sections:
        return LAWS[row["filament.rod.law"]]
    if sections.count("Ellipsoids") > 1:
        return MIDDLE
    return SOFT if "altered" in sections else BARE


def read(sweep):
    """By variant and turn (deg): couple (pN nm) about the axis of the turn, and run directory."""
    found = {}
    for row in study.rows(sweep):
        turn = study.vector(row["path[0].set[0].turn_deg"])
        axis = 1 if turn[1] else 2
        couple = row.get(f"end_reactions.end.torque_pn_nm[{axis}]")
        if couple is not None:
            found[variant(row), axis, turn[axis]] = couple, f"{sweep}/runs/{row['point']:.0f}"
    return found


def law(found, kind, axis, sign, length):
    """Couples (pN nm) and curvatures or twists (1/nm) of a uniform filament."""
    points = [(abs(couple), np.radians(abs(turn)) / length)
              for (k, a, turn), (couple, _) in found.items() if (k, a) == (kind, axis) and turn * sign > 0]
    return np.array(sorted(points)).T


def shared(s, total, ratio, edges):
    """Turn along a beam with constant rigidities, smaller by `ratio` between the edges, under an end couple."""
    length = np.interp(s, [s[0], *edges, s[-1]], np.cumsum([0, edges[0] - s[0], ratio * (edges[1] - edges[0]), s[-1] - edges[1]]))
    return total * length / length[-1]


def powers(x, xs, ys):
    """Interpolation and extrapolation towards zero by powers of x."""
    x, xs, ys = np.log(x), np.log(xs), np.log(ys)
    below = ys[0] + (x - xs[0]) * (ys[1] - ys[0]) / (xs[1] - xs[0])
    return np.exp(np.where(x < xs[0], below, np.interp(x, xs, ys)))


def expected(found, axis, sign, total, lengths, whole):
    """Share of the middle if each part follows the law of a uniform filament at the same couple."""
    bare, soft = (law(found, kind, axis, sign, whole) for kind in (BARE, SOFT))
    couples = np.geomspace(1e-2 * soft[0][0], min(bare[0][-1], soft[0][-1]), 20000)
    parts = [powers(couples, *measured) * n for measured, n in zip((bare, soft), lengths)]
    at = np.argmin(abs(sum(parts) - total))
    return parts[1][at] / sum(parts)[at]


def slopes(s, angle, edges):
    """Slopes before, between and after the edges, by least squares."""
    kinks = [np.ones_like(s), s, *(np.maximum(s - edge, 0) for edge in edges)]
    return np.cumsum(np.linalg.lstsq(np.array(kinks).T, angle, rcond=None)[0][1:])


def along(run, axis):
    """Arc lengths between the held cross-sections, and turns (rad) about an axis there."""
    s, vectors = study.turns(run)
    if s[1] - s[0] < 4:  # the inner one of two held monomers
        s, vectors = s[1:-1], vectors[1:-1]
    return s, np.unwrap(vectors[:, axis])


def share(run, axis, total):
    """Share of the middle in the turn."""
    s, angle = along(run, axis)
    return slopes(s, angle, EDGES)[1] * (EDGES[1] - EDGES[0]) / total


def main():
    options = study.arguments(["softened-sweep"], __doc__)
    found = read(options.softened_sweep)
    figure, panels = study.axes(2, width=6.8)
    lines = []
    for panel, axis, ratio, shown in (panels[0], 1, BENDING, [30.0]), (panels[1], 2, TWIST, [120.0, -120.0]):
        for turn in sorted({t for kind, a, t in found if a == axis}):
            couples = [found[kind, axis, turn][0] for kind in (BARE, SOFT) if (kind, axis, turn) in found]
            if turn not in LISTED or len(couples) < 2:
                continue
            total = np.radians(turn)
            runs = [found[kind, axis, turn][1] for kind in (MIDDLE, HOMOGENISED, FITTED, CONSTANT)]
            s, angle = along(runs[0], axis)
            whole = s[-1] - s[0]
            own = expected(found, axis, np.sign(turn), abs(total), (whole - 50, 50), whole)
            places = np.array([s[0], *EDGES, s[-1]])
            beam = shared(places, 1.0, ratio, EDGES)
            lines.append(["bend" if axis == 1 else "twist", f"{turn:+g}", f"{couples[0] / couples[1]:.1f}",
                          *(f"{share(run, axis, total):.2f}" for run in runs), f"{own:.2f}", f"{beam[2] - beam[1]:.2f}"])
            if turn in shown:
                colour = f"C{shown.index(turn)}"
                panel.plot(s, np.degrees(study.smooth(s, angle, 8.0)), colour, label=f"monomers, {turn:+g}°")
                rod = along(runs[2], axis)
                panel.plot(rod[0], np.degrees(rod[1]), "o", color=colour, mfc="none", ms=3, label="rod, Fitted")
                panel.plot(places, turn * beam, "k--", lw=0.8)
                panel.plot(places[[0, -1]], [0, turn], "k:", lw=0.8)
        panel.axvspan(*EDGES, color="0.93", zorder=-1)
        panel.set_xlabel("arc length (nm)")
        panel.set_ylabel("bent by (°)" if axis == 1 else "twisted by (°)")
        panel.legend(fontsize=7)
    study.save(figure, f"{options.figures}/softened.svg")
    study.put_table(options.page, ["end turned by", "deg", "softer all along by", "share of the middle: monomers",
                                   "rod, `Homogenised`", "rod, `Fitted`", "rod, `Constant`", "each part by its own law",
                                   f"stepped beam, {BENDING:g} and {TWIST:g}"], lines, "softened")


if __name__ == "__main__":
    main()
