"""Shared functions of the studies: tables and run directories, time series, figures and tables of a page.

Needs numpy and matplotlib.
"""

import csv
import re
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("svg")
matplotlib.rcParams.update({
    "svg.hashsalt": "study", "svg.fonttype": "none", "path.simplify_threshold": 0.5,
    "font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
    "lines.linewidth": 1.2, "lines.markersize": 4, "figure.constrained_layout.use": True,
})

import matplotlib.pyplot as plt  # noqa: E402

KT_298 = 1.380649e-2 * 298.0  # pN nm


def rows(sweep, name="table.csv"):
    """Rows of a sweep's table; numbers as floats, empty cells as None."""
    with open(Path(sweep) / name, newline="") as file:
        return [{key: number(cell) for key, cell in row.items()} for row in csv.DictReader(file)]


def number(cell):
    try:
        return float(cell)
    except ValueError:
        return cell or None


def vector(text):
    """Components of a vector in the format of tables: (0.0, 1.0, 0.0)."""
    return [float(x) for x in text.strip("()").split(",")]


def states(run):
    """Arrays of states.npz."""
    with np.load(Path(run) / "states.npz") as file:
        return {key: file[key] for key in file.files}


def columns(path):
    """Columns of a CSV file by their names; empty cells are NaN."""
    with open(path, newline="") as file:
        head, *body = csv.reader(file)
    values = np.array([[float(cell or "nan") for cell in line] for line in body])
    return dict(zip(head, values.T))


def observed(run, name):
    """Times (ns) and values of a column of observables.csv."""
    table = columns(Path(run) / "observables.csv")
    return table["time_ns"], table[name]


def ratio(left, right=1.0, blocks=10):
    """Ratio of the means of two series, and its standard error from blocks along the first axis."""
    left, right = np.broadcast_arrays(left, right)
    parts = [a.mean() / b.mean() for a, b in zip(np.array_split(left, blocks), np.array_split(right, blocks))]
    return left.mean() / right.mean(), np.std(parts, ddof=1) / blocks**0.5


def turns(run):
    """Arc lengths, and rotation vectors (lab, rad) of all frames from the first to the last record."""
    arrays = states(run)
    w, xyz = arrays["quaternion"][..., 0], arrays["quaternion"][..., 1:]
    # The product of the last orientation and the inverse of the first.
    real = w[-1] * w[0] + np.sum(xyz[-1] * xyz[0], axis=-1)
    imaginary = w[0][:, None] * xyz[-1] - w[-1][:, None] * xyz[0] - np.cross(xyz[-1], xyz[0])
    sine = np.linalg.norm(imaginary, axis=-1)
    angle = 2 * np.arctan2(sine, real)
    angle -= 2 * np.pi * np.round(angle / (2 * np.pi))
    return arrays["frame_s_nm"], imaginary * (angle / np.where(sine == 0, 1, sine))[:, None]


def smooth(s, values, reach=18.0):
    """Moving averages over half a turn of the helix on both sides, which remove the alternation of monomers."""
    return np.array([values[abs(s - x) <= min(reach, x - s[0], s[-1] - x) + 1e-9].mean(axis=0) for x in s])


def axes(columns=1, rows=1, width=6.4, height=2.9, **more):
    return plt.subplots(rows, columns, figsize=(width, height), **more)


def save(figure, path):
    """Writes a reproducible SVG: equal numbers give equal bytes."""
    figure.savefig(path, metadata={"Date": None, "Creator": None})
    print(path)


def put_table(page, head, lines, name):
    """Replaces a table of a page, between the comments `generated: NAME` and `end`."""
    table = "\n".join("| " + " | ".join(map(str, line)) + " |" for line in [head, ["---"] * len(head), *lines])
    print(table)
    if page is None:
        return
    text = Path(page).read_text()
    block = re.compile(rf"(<!-- generated: {name} -->\n).*?(\n<!-- end -->)", re.S)
    assert block.search(text), f"{page} has no block {name}"
    Path(page).write_text(block.sub(lambda m: m[1] + "\n" + table + "\n" + m[2], text))


def arguments(sweeps, doc):
    """Folders of the sweeps or runs, folder of the figures, page whose table is replaced (none by default)."""
    import argparse

    parser = argparse.ArgumentParser(description=doc)
    for name in sweeps:
        parser.add_argument(f"--{name}", default=f"sweeps/{name}")
    parser.add_argument("--figures", default=".")
    parser.add_argument("--page")
    return parser.parse_args()
