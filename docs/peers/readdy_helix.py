"""The uniform helix of least energy under the rest lengths and angles of the ReaDDy model of actin, beside the helix as
that model builds it.

Constants: simularium/readdy-models, Allen Institute for Cell Science: monomer centres (nm) measured in PDB 7AQK, whose
mean distances and angles are the rest values; axis, rise and turn measured there; stiffness of bonds (kJ/mol/nm^2),
angles and dihedrals (kJ/mol). Needs numpy and scipy:
    python3 docs/peers/readdy_helix.py
"""

import numpy as np
from scipy.optimize import minimize

CENTRES = np.array([
    [19.126, 20.838, 27.757], [21.847, 24.171, 27.148], [24.738, 20.881, 26.671], [27.609, 24.061, 27.598],
    [30.382, 21.190, 25.725], [33.374, 23.553, 27.951], [36.075, 21.642, 25.060], [39.005, 22.861, 27.970],
])
AXIS, THROUGH = np.array([0.99873035, 0.01436705, -0.04828331]), np.array([0.0, 22.186136822, 28.273905592])
TURN, RISE = -(167.44857939 + 166.44837565) / 2, (2.795019154 + 2.811178372) / 2  # deg, nm
BONDS, ANGLES, DIHEDRAL = {1: 0.2 * 968.2, 2: 0.2 * 1437.5}, 1000.0, 1000.0
LENGTH = 500.0


def angle(a, b):
    return np.arccos(a @ b / np.linalg.norm(a) / np.linalg.norm(b))


def far(points, step):
    return np.mean(np.linalg.norm(points[step:] - points[:-step], axis=1))


def bent(points, first, last):
    """Mean angle at monomer i + first between monomers i and i + last."""
    return np.mean([angle(points[i] - points[i + first], points[i + last] - points[i + first]) for i in range(len(points) - last)])


def dihedral(points):
    a, b, c = np.diff(points[:4], axis=0)
    one, other = np.cross(a, b), np.cross(b, c)
    return np.arctan2(np.cross(one, other) @ b / np.linalg.norm(b), one @ other)


def helix(turn, rise, radius):
    i = np.arange(6)
    return np.stack([rise * i, radius * np.cos(np.radians(turn) * i), radius * np.sin(np.radians(turn) * i)], axis=1)


PLACES = {(1, 2): 1, (1, 3): 2, (2, 4): 1}  # and how many there are per monomer


def energy(points, with_dihedral):
    """kJ/mol per monomer; the dihedral's rest value is the mean angle between bonds, with the hand of the helix."""
    bonds = sum(k * (far(points, step) - far(CENTRES, step)) ** 2 for step, k in BONDS.items())
    angles = sum(n * ANGLES * (bent(points, *at) - bent(CENTRES, *at)) ** 2 for at, n in PLACES.items())
    rest = -np.mean([angle(CENTRES[i] - CENTRES[i + 1], CENTRES[i + 3] - CENTRES[i + 2]) for i in range(5)])
    return bonds + angles + with_dihedral * DIHEDRAL * (1 - np.cos(dihedral(points) - rest))


def main():
    arm = CENTRES[3] - THROUGH
    radius = np.linalg.norm(arm - arm @ AXIS * AXIS)
    print(f"as built: turn {TURN:.3f} deg, rise {RISE:.4f} nm, radius {radius:.4f} nm")
    for with_dihedral in (False, True):
        for free in (True, False):
            start = [TURN, radius, RISE] if free else [TURN, radius]
            helix_of = lambda x: helix(x[0], x[2] if free else RISE, x[1])
            best = minimize(lambda x: energy(helix_of(x), with_dihedral), start, method="Nelder-Mead",
                            options={"xatol": 1e-9, "fatol": 1e-13, "maxiter": 20000}).x
            turns = (best[0] - TURN) * LENGTH / RISE / 360
            longer = (best[2] / RISE - 1) * 100 if free else 0.0
            print(f"{'with' if with_dihedral else 'without'} dihedrals, length {'free' if free else 'held'}: "
                  f"{longer:+.2f} % longer, {turns:+.3f} turns in {LENGTH:.0f} nm, radius {best[1]:.3f} nm")


if __name__ == "__main__":
    main()
