"""Conversion of records to PyVista."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import pyvista

    from actin_filaments.results import Run


def rotations(quaternion: np.ndarray) -> np.ndarray:
    """Converts quaternions `[m, 4]` (w, x, y, z) to rotation matrices `[m, 3, 3]`, body to lab."""
    w, x, y, z = np.moveaxis(quaternion, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def of_record(run: Run, record: int) -> pyvista.MultiBlock:
    """Returns lines through the nodes of rods, and an ellipsoid for each monomer."""
    import pyvista

    blocks = pyvista.MultiBlock()
    position = np.ascontiguousarray(run.position_nm[record])
    kinds = np.array(run.kind_names)[run.kind]
    nodes = np.flatnonzero(kinds == "node")
    if len(nodes):
        # A line ends before a point of another filament or a point that is not adjacent.
        breaks = (np.diff(nodes) > 1) | (np.diff(run.filament[nodes]) != 0)
        parts = np.split(np.arange(len(nodes)), np.flatnonzero(breaks) + 1)
        rod = pyvista.PolyData(position[nodes], lines=np.concatenate([[len(part), *part] for part in parts]))
        rod["s_nm"] = run.s_nm[nodes]
        rod["filament"] = run.filament[nodes]
        blocks["rod"] = rod
    monomers = np.flatnonzero(kinds == "monomer")
    if len(monomers):
        blocks["monomers"] = _ellipsoids(run, record, monomers, position)
    return blocks


def _ellipsoids(run: Run, record: int, monomers: np.ndarray, position: np.ndarray) -> pyvista.PolyData:
    import pyvista

    sphere = pyvista.Sphere(radius=1.0, theta_resolution=16, phi_resolution=12)
    points = np.asarray(sphere.points, np.float64)
    faces = np.asarray(sphere.faces, np.int64).reshape(-1, 4)
    turns = rotations(run.quaternion[record][run._bodies["frame"][monomers]])
    scaled = points[None] * run._bodies["semi_axes_nm"][monomers][:, None, :]
    placed = np.einsum("mij,mpj->mpi", turns, scaled) + position[monomers][:, None, :]
    offsets = len(points) * np.arange(len(monomers), dtype=np.int64)
    corners = faces[None, :, 1:] + offsets[:, None, None]
    threes = np.full((*corners.shape[:2], 1), 3)
    mesh = pyvista.PolyData(placed.reshape(-1, 3), np.concatenate([threes, corners], axis=2).ravel())
    mesh["s_nm"] = np.repeat(run.s_nm[monomers], len(points))
    mesh["filament"] = np.repeat(run.filament[monomers], len(points))
    return mesh
