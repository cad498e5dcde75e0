"""Thermal energies of linked networks, relative to exact relations of thermal equilibrium.

Each relation is <v . grad U> = kT <div v> for displacements v. A change of one shear, stretch, bending or twist
displaces the rest of the filament rigidly, so that its linkers do work. `linker forces` displaces filaments along the
sums of their linkers' forces.
Needs numpy. From the folder of `actin sweep scenarios/studies/network-heat-sweep.ron`:
    python3 scenarios/studies/network-heat.py --network-heat-sweep sweeps/network-heat-sweep
"""

import re
from pathlib import Path

import numpy as np
import study

SEGMENT, SHEAR, BEND = 100.0, np.array([1.6e4, 1.6e4, 3.4e4]), np.array([3.9e4, 3.9e4, 1.3e4])  # nm, pN, pN nm^2
KT, BEGIN_NS = study.KT_298, 5e5
LINKER = re.compile(r"Linker\(\s*filament: (\d+),\s*at_nm: ([\d.]+).*?Site\(\s*filament: (\d+),\s*at_nm: ([\d.]+).*?"
                    r"stiffness_pn_per_nm: ([\d.]+),\s*rest_length_nm: ([\d.]+)", re.S)
KINDS = {"shear": [1, 1, 0], "stretch": [0, 0, 1], "bending": [1, 1, 0], "twist": [0, 0, 1]}


def into(q, v):
    """Vectors v in the axes of frames with the quaternions q (w, x, y, z)."""
    u = q[..., 1:]
    return v + 2 * np.cross(u, np.cross(u, v) - q[..., :1] * v)


def relations(run):
    """Both sides of each relation (pN nm) in all records."""
    file = study.states(run)
    count = int(file["filament"][-1]) + 1
    x, q = (file[key][file["time_ns"] > BEGIN_NS] for key in ("position_nm", "quaternion"))
    x, q = x.reshape(len(x), count, -1, 3), q.reshape(len(q), count, -1, 4)
    strain = into(q, np.diff(x, axis=2)) / SEGMENT - [0, 0, 1]
    a, b = q[:, :, :-1], q[:, :, 1:]
    w = (a * b).sum(-1, keepdims=True)
    v = a[..., :1] * b[..., 1:] - b[..., :1] * a[..., 1:] - np.cross(a[..., 1:], b[..., 1:])
    sine = np.linalg.norm(v, axis=-1, keepdims=True)
    turn = 2 * np.arctan2(sine, np.abs(w)) * np.sign(w) * v / sine
    found = np.array(LINKER.findall((run / "scene.ron").read_text()), dtype=float)
    filament, place, k, rest = found[:, 0:4:2].astype(int), found[:, 1:4:2], found[0, 4], found[:, 5]
    segment = np.maximum(np.ceil(place / SEGMENT - 1e-9).astype(int) - 1, 0)
    part = (place / SEGMENT - segment)[..., None]
    sites = (1 - part) * x[:, filament, segment] + part * x[:, filament, segment + 1]
    between = sites[:, :, 0] - sites[:, :, 1]
    length = np.linalg.norm(between, axis=-1)
    pull = k * (1 - rest / length)[..., None] * between  # gradient of the energy at the first site
    # Sums over the sites after segment j: force on its end, torque about the origin; own share of sites in segment j.
    after, torque, total = np.zeros_like(strain), np.zeros_like(strain), np.zeros((len(x), count, 3))
    own = np.zeros_like(strain)
    for (l, e), s in np.ndenumerate(segment):
        f, g = filament[l, e], pull[:, l] * (1 - 2 * e)
        after[:, f, :s] += g[:, None]
        torque[:, f, :s] += np.cross(sites[:, l, e], g)[:, None]
        own[:, f, s] += part[l, e] * g
        total[:, f] += g
    stretching = SEGMENT * strain * (SHEAR * strain + into(q, after + own))
    square = (turn**2).sum(-1, keepdims=True)
    angle = np.sqrt(square)
    haar = (angle / np.tan(angle / 2) - 2) / square * turn  # gradient of the density of rotation vectors
    torque = into(q, torque - np.cross(x[:, :, 1:], after))[:, :, :-1]
    for name, mask in KINDS.items():
        if name in ("shear", "stretch"):
            yield name, (stretching * mask).sum((1, 2, 3)), sum(mask) * KT * count * strain.shape[2]
        else:
            cross = np.cross(turn, turn * mask)
            axis = turn * mask + (1 - np.cos(angle)) / square * cross
            axis += (angle - np.sin(angle)) / angle**3 * np.cross(turn, cross)
            yield (name, (BEND / SEGMENT * turn**2 * mask + axis * torque).sum((1, 2, 3)),
                   KT * (sum(mask) + (haar * turn * mask).sum(-1)).sum((1, 2)))
    yield "linker forces", (total**2).sum((1, 2)), 2 * k * KT * (3 - 2 * rest / length).sum(1)


if __name__ == "__main__":
    options = study.arguments(["network-heat-sweep"], __doc__)
    lines = []
    for row in study.rows(options.network_heat_sweep):
        run = Path(options.network_heat_sweep) / "runs" / str(int(row["point"]))
        values = {name: "{:.3f} ± {:.3f}".format(*study.ratio(a, b)) for name, a, b in relations(run)}
        lines.append([row["arrangements[0].count"], row["linker_sets[0].per_filament"],
                      row["task.time_step_ns"] / 1e3, *values.values()])
    head = ["filaments", "linkers per filament", "step (us)", *values]
    study.put_table(options.page, head, lines, "network-heat")
