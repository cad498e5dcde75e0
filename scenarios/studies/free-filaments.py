"""Diffusion and relaxation of free filaments, relative to the discrete friction.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/free-filaments-sweep.ron`:
    python3 scenarios/studies/free-filaments.py --free-filaments-sweep sweeps/free-filaments-sweep
"""

import flicker
import numpy as np
import study

flicker.LENGTH, flicker.SEGMENTS = LENGTH, SEGMENTS = 1000.0, 10
KT, STEP, P = study.KT_298, LENGTH / SEGMENTS, LENGTH / (2 * flicker.RADIUS)
ALONG = 2 * np.pi * flicker.VISCOSITY / (np.log(P) - 0.207 + 0.98 / P - 0.133 / P**2)  # friction per length
ACROSS, ENDS = flicker.friction()
DRAG, BENDING = flicker.chain()
RATES, SHAPES = (values[..., 2:6] for values in flicker.eigenmodes(DRAG, BENDING))
ARM = np.arange(SEGMENTS + 1) * STEP - LENGTH / 2


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def show(pair):
    return "{:.3f} ± {:.3f}".format(*pair)


def parts(x):
    """Axis of the slowest rotation, its squared size, and amplitudes of bending modes 1 to 4, for nodes (..., n, 3)."""
    arm = np.einsum("n,...nx->...x", DRAG @ ARM, x)
    bent = np.einsum("nm,...nx->...mx", DRAG @ SHAPES, x)
    axis = unit(arm)[..., None, :]
    return axis[..., 0, :], (arm**2).sum(-1), bent - (bent * axis).sum(-1, keepdims=True) * axis


def mobility(tangent):
    """Mobility (nm/(pN ns)) of bent filaments as rigid bodies without rotation."""
    across = np.full(SEGMENTS, ACROSS * STEP)
    across[[0, -1]] += ENDS
    less = np.einsum("s,tfsx,tfsy->tfxy", across - ALONG * STEP, tangent, tangent)
    return np.linalg.inv(across.sum() * np.eye(3) - less)


def rows(run, h):
    file = study.states(run)
    x = file["position_nm"][file["time_ns"] > 5e5].reshape(-1, 100, SEGMENTS + 1, 3)
    lag, time = 4, 2e4  # records of 5 us
    axis, size, bent = parts(x)
    free = mobility(unit(np.diff(x, axis=2)))
    forward = np.einsum("tfx,tfxy,tfy->tf", axis, free, axis)
    sideways = (np.trace(free, axis1=-2, axis2=-1) - forward) / 2
    moved = np.einsum("n,tfnx->tfx", DRAG.sum(0) / DRAG.sum(), x[lag:] - x[:-lag])
    ahead = (moved * axis[:-lag]).sum(-1) ** 2
    aside = ((moved**2).sum(-1) - ahead) / 2
    turned = 1 - (axis[lag:] * axis[:-lag]).sum(-1)
    turning = ARM @ DRAG @ ARM / size
    for name, left, right in (("along", ahead, forward), ("across", aside, sideways), ("of rotation", turned, turning)):
        yield h, f"diffusion {name} / theory", show(study.ratio(left.T, 2 * KT * time * right[:-lag].T)), ""
    chains = np.cumsum(np.pad(flicker.drawn() * STEP, ((0, 0), (1, 0), (0, 0))), axis=1)
    exact = (parts(chains)[2] ** 2).sum(-1).mean(0)
    for m, rate in enumerate(RATES):
        a = bent[:, :, m]
        variance = study.ratio((a**2).sum(-1).T, exact[m])
        yield h, f"mode {m + 1}, {1e-3 / rate:.3g} us: variance / chain", show(variance), ""
        kept = study.ratio((a[1:] * a[:-1]).sum(-1).T, (a[:-1] ** 2).sum(-1).T)
        theory = "{:.3f}, in steps {:.3f}".format(np.exp(-rate * 5e3), (1 + rate * h) ** (-5e3 / h))
        yield h, f"mode {m + 1}: correlation after 5 us", show(kept), theory


if __name__ == "__main__":
    options = study.arguments(["free-filaments-sweep"], __doc__)
    lines = []
    for row in study.rows(options.free_filaments_sweep):
        lines += rows(f"{options.free_filaments_sweep}/runs/{row['point']:g}", row["task.time_step_ns"])
    study.put_table(options.page, ["step (ns)", "quantity", "measured", "theory"], lines, "free-filaments")
