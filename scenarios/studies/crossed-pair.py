"""Energy, diffusion and relaxation of two crossed filaments with one linker, relative to theory.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/crossed-pair-sweep.ron`:
    python3 scenarios/studies/crossed-pair.py --crossed-pair-sweep sweeps/crossed-pair-sweep
"""

import flicker
import numpy as np
import study

flicker.LENGTH, flicker.SEGMENTS = 1000.0, 10
KT, NODES = study.KT_298, flicker.SEGMENTS + 1
DRAG, BENDING = flicker.chain()
SITE = np.eye(NODES)[NODES // 2]


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def show(pair):
    return "{:.3f} ± {:.3f}".format(*pair)


def means(k, rest):
    """Mean square of the extension (nm^2) and mean length (nm): the length L has the density L^2 exp(-U/kT)."""
    length = np.linspace(1e-3, rest + 12 * np.sqrt(KT / k), 20000)
    square = (length - rest) ** 2
    weights = length**2 * np.exp(-0.5 * k * square / KT)
    return np.average(square, weights=weights), np.average(length, weights=weights)


def correlations(k, h, times):
    """Correlations of the extension across both filaments: exact, and in steps of h."""
    link = np.concatenate([SITE, -SITE])
    rates, shapes = flicker.eigenmodes(np.kron(np.eye(2), DRAG), np.kron(np.eye(2), BENDING) + k * np.outer(link, link))
    rates = np.maximum(rates, 1e-12)
    share = k * (link @ shapes) ** 2 / rates
    return [(share @ np.exp(-rates * t), share @ (1 + rates * h) ** (-t / h)) for t in times]


def rows(run, h, k, rest):
    x = study.states(run)["position_nm"].reshape(-1, 2, NODES, 3)
    vector = np.einsum("tnx,n->tx", x[:, 0] - x[:, 1], SITE)
    length = np.linalg.norm(vector, axis=-1)[100:]
    square, mean = means(k, rest)
    case = f"{k:g}", f"{rest:g}", f"{h:g}"
    yield *case, "energy / theory", show(study.ratio((length - rest) ** 2, square)), ""
    yield *case, "mean length / theory", show(study.ratio(length, mean)), ""
    if rest:
        return
    normal = np.cross(*unit(x[:, :, -1] - x[:, :, 0]).swapaxes(0, 1))
    start = np.flatnonzero(np.linalg.norm(normal, axis=-1)[:-2] > 0.5)
    normal = unit(normal)[start]
    centre = np.einsum("n,tfnx->tx", DRAG.sum(0) / (2 * DRAG.sum()), x)
    moved = ((centre[start + 2] - centre[start]) * normal).sum(-1) ** 2
    yield *case, "diffusion across both filaments / theory", show(study.ratio(moved, KT / DRAG.sum() * 2e4)), ""
    for lag, theory in zip((1, 2), correlations(k, h, (1e4, 2e4))):
        kept = study.ratio((vector[start + lag] * normal).sum(-1) * (vector[start] * normal).sum(-1), KT / k)
        expected = "{:.3f}, in steps {:.3f}".format(*theory)
        yield *case, f"correlation of the extension after {10 * lag} us", show(kept), expected


if __name__ == "__main__":
    options = study.arguments(["crossed-pair-sweep"], __doc__)
    lines = []
    for row in study.rows(options.crossed_pair_sweep):
        lines += rows(f"{options.crossed_pair_sweep}/runs/{row['point']:g}", row["task.time_step_ns"],
                      row["linkers[0].stiffness_pn_per_nm"], row.get("linkers[0].rest_length_nm", 0.0))
    head = ["linker (pN/nm)", "rest length (nm)", "step (ns)", "quantity", "measured", "theory"]
    study.put_table(options.page, head, lines, "crossed-pair")
