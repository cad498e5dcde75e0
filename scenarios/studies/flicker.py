"""Bending modes of a free filament in water: variances and relaxation times, compared with an exact chain and experiments.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/flicker-sweep.ron`:
    python3 scenarios/studies/flicker.py --flicker-sweep sweeps/flicker-sweep
"""

from pathlib import Path

import numpy as np
import study

LENGTH, SEGMENTS, BEND, TWIST = 5000.0, 50, 3.9e4, 1.3e4  # nm, pN nm^2
VISCOSITY, RADIUS = 0.89, 3.5  # mPa s, nm
MODES = np.arange(1, 7)
STEP = LENGTH / SEGMENTS
MIDDLES = (np.arange(SEGMENTS) + 0.5) * STEP
# Persistence lengths (um) from bending modes of single filaments with phalloidin: F. Gittes and others, J. Cell Biol. 120
# (1993) 923; C. P. Brangwynne and others, Biophys. J. 93 (2007) 346. H. Isambert and others, J. Biol. Chem. 270 (1995)
# 11437, measured 18 with phalloidin and 9 without.
MEASURED = {"Gittes 1993": 17.7, "Brangwynne 2007": 17.0}


def modes(tangents):
    """Amplitudes (nm^(1/2)) of the cosine modes of the tangents (..., segments, 3), perpendicular to their mean direction."""
    mean = tangents.mean(axis=-2, keepdims=True)
    mean /= np.linalg.norm(mean, axis=-1, keepdims=True)
    across = tangents - mean * (tangents * mean).sum(axis=-1, keepdims=True)
    cosines = np.cos(np.pi * MODES[:, None] * MIDDLES / LENGTH)
    return np.sqrt(2 / LENGTH) * STEP * np.einsum("ms,...sx->...mx", cosines, across)


def variance(amplitudes):
    """Mean squares per transverse direction."""
    return 0.5 * (amplitudes**2).sum(axis=-1).mean(axis=0)


def directions(run):
    """Tangents of all records: third body axes of the segments."""
    w, x, y, z = np.moveaxis(study.states(run)["quaternion"], -1, 0)
    return np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x**2 + y**2)], axis=-1)


def drawn(number=20000):
    """Tangents of independent chains with the same segments."""
    random = np.random.default_rng(1)
    spread = np.sqrt(study.KT_298 * STEP / np.array([BEND, BEND, TWIST]))
    axes = np.tile(np.eye(3), (number, 1, 1))
    tangents = [axes[:, :, 2]]
    for _ in range(SEGMENTS - 1):
        turn = random.normal(size=(number, 3)) * spread
        angle = np.linalg.norm(turn, axis=1)[:, None, None]
        a, b, c = (turn / angle[:, 0]).T
        zero = np.zeros(number)
        cross = np.moveaxis(np.array([[zero, -c, b], [c, zero, -a], [-b, a, zero]]), -1, 0)
        rotation = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
        axes = axes @ rotation
        tangents.append(axes[:, :, 2])
    return np.stack(tangents, axis=1)


def friction():
    """Transverse drag of a cylinder, per length and at each end (Tirado and others 1984)."""
    p = LENGTH / (2 * RADIUS)
    whole = 4 * np.pi * VISCOSITY * LENGTH / (np.log(p) + 0.839 + 0.185 / p + 0.233 / p**2)
    turning = np.pi * VISCOSITY * LENGTH**3 / (3 * (np.log(p) - 0.662 + 0.917 / p - 0.05 / p**2))
    ends = 3 * turning / LENGTH**2 - whole / 4
    return (whole - 2 * ends) / LENGTH, ends


def chain():
    """Friction and stiffness of the transverse displacements of the nodes of a straight chain."""
    between, ends = friction()
    nodes = SEGMENTS + 1
    drag = np.zeros((nodes, nodes))
    for k in range(SEGMENTS):
        drag[k : k + 2, k : k + 2] += between * STEP * np.array([[2, 1], [1, 2]]) / 6
    drag[0, 0] += ends
    drag[-1, -1] += ends
    second = np.diff(np.eye(nodes), n=2, axis=0)
    return drag, BEND / STEP**3 * second.T @ second


def eigenmodes(drag, stiffness):
    """Decay rates (1/ns), and shapes of unit friction."""
    root = np.linalg.inv(np.linalg.cholesky(drag))
    rates, vectors = np.linalg.eigh(root @ stiffness @ root.T)
    return rates, root.T @ vectors


def decay():
    """Times (ns) in which the modes of a slightly bent chain fall to 1/e, from all its eigenmodes."""
    rates, shapes = eigenmodes(*chain())
    rates, shapes = rates[2:], shapes[:, 2:]
    slopes = np.diff(shapes, axis=0) / STEP
    # Without the mean direction, as in `modes`.
    cosines = np.cos(np.pi * MODES[:, None] * MIDDLES / LENGTH)
    weights = (cosines @ (slopes - slopes.mean(axis=0))) ** 2 / rates
    times = np.geomspace(1e3, 1e9, 3000)
    found = []
    for weight in weights:
        left = (weight[:, None] * np.exp(-rates[:, None] * times)).sum(axis=0) / weight.sum()
        found.append(np.interp(-1, np.log(left[::-1] + 1e-300), times[::-1]))
    return np.array(found)


def fall(amplitudes, every):
    """Times (ns) in which the correlations of a series fall to 1/e."""
    found = []
    for k in range(len(MODES)):
        series = amplitudes[:, k]
        lags = np.arange(0, min(len(series) // 4, 400))
        left = np.array([(series[: len(series) - lag] * series[lag:]).sum(axis=-1).mean() for lag in lags])
        left /= left[0]
        below = np.argmax(left < np.exp(-1)) if (left < np.exp(-1)).any() else len(left) - 1
        pair = np.log(np.maximum(left[below - 1 : below + 1], 1e-9))
        found.append(every * (below - 1 + (pair[0] + 1) / (pair[0] - pair[1])))
    return np.array(found)


def shapes(panel, tangents):
    """A dozen shapes, aligned with their mean directions and centred."""
    for k, frame in enumerate(tangents[:: max(1, len(tangents) // 12)][:12]):
        places = np.cumsum(np.vstack([np.zeros(3), frame * STEP]), axis=0)
        places -= places.mean(axis=0)
        # Projection on the plane of largest bending.
        _, _, axes = np.linalg.svd(places)
        along, aside = places @ axes[0], places @ axes[1]
        panel.plot(along / 1e3, aside / 1e3 * (-1) ** k, lw=0.8, color=f"C{k % 10}")
    panel.set_aspect("equal")
    panel.set_xlabel("um")


def main():
    options = study.arguments(["flicker-sweep"], __doc__)
    runs = sorted(path.parent for path in Path(options.flicker_sweep).rglob("states.npz"))
    series, variances, times = [], [], []
    for run in runs:
        time = study.states(run)["time_ns"]
        tangents = directions(run)[len(time) // 10 :]
        series.append(tangents)
        amplitudes = modes(tangents)
        variances.append(variance(amplitudes))
        times.append(fall(amplitudes, time[1] - time[0]))
    error = lambda values: np.std(values, axis=0, ddof=1) / np.sqrt(len(values))  # noqa: E731
    found, spread = np.mean(variances, axis=0), error(variances)
    times, times_spread = np.mean(times, axis=0), error(times)
    exact, theory = variance(modes(drawn())), decay()
    ideal = (LENGTH / (np.pi * MODES)) ** 2
    lines = [[n, f"{v:.2f} ± {s:.2f}", f"{x:.2f}", f"{i / v / 1e3:.1f} ± {i / v**2 * s / 1e3:.1f}", f"{t / 1e6:.2f} ± {u / 1e6:.2f}",
              f"{d / 1e6:.2f}"]
             for n, v, s, x, i, t, u, d in zip(MODES, found, spread, exact, ideal, times, times_spread, theory)]
    figure, panels = study.axes(width=7.2, height=2.6, columns=3, gridspec_kw={"width_ratios": [1.6, 1, 1]})
    shapes(panels[0], series[0])
    panels[1].errorbar(MODES, found, spread, fmt="o", mfc="none", label="in steps of 10 us")
    panels[1].loglog(MODES, exact, "k-", lw=0.8, label="exact chain")
    for (name, lp), dash in zip(MEASURED.items(), ["--", ":"]):
        panels[1].loglog(MODES, ideal / (1e3 * lp), "C1" + dash, lw=0.8, label=f"{name}, {lp:g} um")
    panels[1].set_ylabel("variance of the mode (nm)")
    panels[2].errorbar(MODES, times / 1e6, times_spread / 1e6, fmt="o", mfc="none")
    panels[2].loglog(MODES, theory / 1e6, "k-", lw=0.8, label="small bends")
    panels[2].set_ylabel("falls to 1/e in (ms)")
    for panel in panels[1:]:
        panel.set_xlabel("mode")
        panel.set_xticks(MODES, map(str, MODES))
        panel.minorticks_off()
        panel.legend(fontsize=6, loc="lower left")
    study.save(figure, f"{options.figures}/flicker.svg")
    study.put_table(options.page, ["mode", "variance (nm)", "exact chain (nm)", "persistence length (um)",
                                   "falls to 1/e in (ms)", "theory of small bending (ms)"], lines, "flicker")


if __name__ == "__main__":
    main()
