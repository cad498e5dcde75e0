"""A softened middle: how the end's turn is shared out along the filament, beside stepped beams.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/softened-sweep.ron`:
    python3 scenarios/studies/softened.py --softened-sweep sweeps/softened-sweep
"""

import numpy as np
import study

BARE, SOFT, MIDDLE = range(3)
BENDING, TWIST = 5.0, 10.0  # how much softer the middle is to be
LISTED = [30.0, 60.0, 120.0, -30.0, -60.0, -120.0]  # turns in the table (deg)


def variant(row):
    sections = row["filament.sections"]
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
    """Couples (pN nm) and curvatures or twists (1/nm) of a filament that is the same all along."""
    points = [(abs(couple), np.radians(abs(turn)) / length)
              for (k, a, turn), (couple, _) in found.items() if (k, a) == (kind, axis) and turn * sign > 0]
    return np.array(sorted(points)).T


def shared(s, total, ratio, edges):
    """Turn along a beam of constant rigidities, `ratio` times less between the edges, under an end couple."""
    length = np.interp(s, [s[0], *edges, s[-1]], np.cumsum([0, edges[0] - s[0], ratio * (edges[1] - edges[0]), s[-1] - edges[1]]))
    return total * length / length[-1]


def powers(x, xs, ys):
    """Between points, and below the first two, by powers of x."""
    x, xs, ys = np.log(x), np.log(xs), np.log(ys)
    below = ys[0] + (x - xs[0]) * (ys[1] - ys[0]) / (xs[1] - xs[0])
    return np.exp(np.where(x < xs[0], below, np.interp(x, xs, ys)))


def expected(found, axis, sign, total, lengths, whole):
    """Share of the middle if each part follows the law measured on its own: the couple is one all along."""
    bare, soft = (law(found, kind, axis, sign, whole) for kind in (BARE, SOFT))
    couples = np.geomspace(1e-2 * soft[0][0], min(bare[0][-1], soft[0][-1]), 20000)
    parts = [powers(couples, *measured) * n for measured, n in zip((bare, soft), lengths)]
    at = np.argmin(abs(sum(parts) - total))
    return parts[1][at] / sum(parts)[at]


def slopes(s, angle, edges):
    """Slopes before, between and behind the edges, by least squares."""
    kinks = [np.ones_like(s), s, *(np.maximum(s - edge, 0) for edge in edges)]
    return np.cumsum(np.linalg.lstsq(np.array(kinks).T, angle, rcond=None)[0][1:])


def main():
    options = study.arguments(["softened-sweep"], __doc__)
    found = read(options.softened_sweep)
    figure, panels = study.axes(2, width=6.8)
    lines = []
    for panel, axis, ratio, shown in (panels[0], 1, BENDING, [30.0]), (panels[1], 2, TWIST, [120.0, -120.0]):
        for (kind, a, turn), (couple, run) in sorted(found.items()):
            if kind != MIDDLE or a != axis:
                continue
            s, vectors = study.turns(run)
            ends = [s[1], s[-2]]  # of the inner held monomers
            inside = (s >= ends[0]) & (s <= ends[1])
            s, angle = s[inside], vectors[inside, axis]
            edges = np.array([50.0, 100.0])
            total = np.radians(turn)
            # Turns of more than half a turn are rotation vectors of less: unwound along the filament.
            angle = np.unwrap(angle)
            middle = slopes(s, angle, edges)[1] * (edges[1] - edges[0]) / total
            whole = ends[1] - ends[0]
            stepped = shared(np.array([ends[0], *edges, ends[1]]), 1.0, ratio, edges)
            own = expected(found, axis, np.sign(turn), abs(total), (whole - 50, 50), whole)
            softer = [np.interp(abs(turn), *zip(*sorted((abs(t), c) for (k, a2, t), (c, _) in found.items()
                      if (k, a2) == (kind2, axis) and t * turn > 0))) for kind2 in (BARE, SOFT)]
            if turn in LISTED:
                lines.append(["bend" if axis == 1 else "twist", f"{turn:g}", f"{abs(softer[0] / softer[1]):.1f}",
                              f"{middle:.2f}", f"{own:.2f}", f"{stepped[2] - stepped[1]:.2f}"])
            if turn in shown:
                colour = f"C{shown.index(turn)}"
                panel.plot(s, np.degrees(study.smooth(s, angle, 8.0)), colour, label=f"monomers, {turn:+g}°")
                panel.plot(s, np.degrees(shared(s, total, ratio, edges)), "k--", lw=0.8)
                panel.plot(s, np.degrees(total * (s - s[0]) / whole), "k:", lw=0.8)
        panel.axvspan(50, 100, color="0.93", zorder=-1)
        panel.set_xlabel("arc length (nm)")
        panel.set_ylabel("bent by (°)" if axis == 1 else "twisted by (°)")
        panel.legend()
    study.save(figure, f"{options.figures}/softened.svg")
    study.put_table(options.page, ["end turned by", "deg", "softer all along by", "share of the middle: monomers",
                                   "each part by its own law", f"stepped beam, {BENDING:g} and {TWIST:g}"], lines)


main()
