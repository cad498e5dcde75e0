"""Force against extension at 298 K, compared with a worm-like chain of finite length, clamped at one end.

Needs numpy and matplotlib. From the folder of `actin sweep scenarios/studies/extension-sweep.ron`:
    python3 scenarios/studies/extension.py --extension-sweep sweeps/extension-sweep
"""

import numpy as np
import study

LENGTH, BEND, STRETCH = 100.0, 3.9e4, 3.4e4  # nm, pN nm^2, pN: of the rod
# Monomers in a heat bath: persistence length in free motion, 11.7 um, and stretching rigidity of their cells,
# with free rotation (docs/measured/heat.md).
MONOMERS = {"bend": 11.7e3 * study.KT_298, "stretch": 2.0e4}


def finite_chain(force, length=LENGTH, bend=BEND, stretch=STRETCH):
    """Extension (nm) of a stiff chain with a clamped end: P. K. Purohit and others, Int. J. Non-Linear
    Mech. 43, 1056 (2008). Transverse angles have the modes sin((n + 1/2) pi s / L) with variances kT / (B q^2 + F)."""
    root = np.sqrt(bend * force)
    return length * (1 - study.KT_298 / (2 * root) * np.tanh(length * force / root) + force / stretch)


def long_chain(force, length=LENGTH, bend=BEND, stretch=STRETCH):
    """Extension (nm) of a long stiff chain (Odijk 1995)."""
    return length * (1 - study.KT_298 / (2 * np.sqrt(bend * force)) + force / stretch)


def segments(force, number=10, length=LENGTH, bend=BEND, stretch=STRETCH):
    """Extension (nm) of a rod of segments, from the inverse stiffness matrix of its transverse angles."""
    h = length / number
    matrix = np.diag(np.full(number, 2 * bend / h + force * h)) - bend / h * (np.eye(number, k=1) + np.eye(number, k=-1))
    matrix[0, 0] += bend / h  # the wall: half a segment
    matrix[-1, -1] -= bend / h
    return length * (1 + force / stretch) - h * study.KT_298 * np.trace(np.linalg.inv(matrix))


def main():
    options = study.arguments(["extension-sweep"], __doc__)
    found = {}
    for row in study.rows(options.extension_sweep, "runs.csv"):
        ends = [row[f"observables.tip[0]_z_nm.{what}"] for what in ("mean", "error")]
        kind = "monomers" if "Ellip" in row["filament.sections"] else "rod"
        found.setdefault((kind, row["loads[0].force_pn[2]"]), []).append(ends)
    figure, panel = study.axes(width=4.6, height=3.2)
    force = np.geomspace(0.1, 100.0, 200)
    panel.semilogx(force, long_chain(force), "k:", lw=0.8, label="worm-like chain without ends")
    panel.semilogx(force, finite_chain(force), "k-", lw=0.8, label="of 100 nm, clamped")
    lines, kinds = [], ["rod", "monomers"]
    for kind in kinds:
        forces = np.array(sorted(f for k, f in found if k == kind))
        runs = [np.array(found[kind, f])[:, 0] for f in forces]
        mean = np.array([r.mean() for r in runs])
        blocks = np.array([np.sqrt((np.array(found[kind, f])[:, 1] ** 2).sum()) / len(found[kind, f]) for f in forces])
        scatter = np.array([r.std(ddof=1) / np.sqrt(len(r)) for r in runs])
        # The larger of two estimates: blocks miss motions slower than a run, few runs scatter by chance.
        errors = np.maximum(blocks, scatter)
        panel.errorbar(forces, mean, errors, fmt="os"[kinds.index(kind)], color=f"C{kinds.index(kind)}", mfc="none",
                       capsize=2, label=kind)
        if kind == "monomers":
            # The length, which depends on temperature, is fitted.
            curve = finite_chain(forces, **MONOMERS)
            length = np.average(mean - curve, weights=errors**-2)
            panel.semilogx(force, finite_chain(force, **MONOMERS) + length, "C1-", lw=0.8,
                           label=f"softer in stretch, {-length:.2f} nm shorter")
        else:
            curve, length = np.array([segments(f) for f in forces]), 0.0
        for f, z, b, s, c in zip(forces, mean, blocks, scatter, curve + length):
            lines.append([kind, f"{f:g}", f"{z:.3f}", f"{b:.3f}", f"{s:.3f}", f"{c:.3f}", f"{(z - c) / max(b, s):+.1f}",
                          f"{long_chain(f):.2f}"])
    panel.set_ylim(97.5, 100.4)
    panel.set_xlabel("force (pN)")
    panel.set_ylabel("extension (nm)")
    panel.legend(fontsize=8)
    study.save(figure, f"{options.figures}/extension.svg")
    study.put_table(options.page, ["filament", "force (pN)", "extension (nm)", "error from blocks (nm)", "error from runs (nm)",
                                   "theory (nm)", "difference / larger error", "chain without ends (nm)"], lines, "extension")


if __name__ == "__main__":
    main()
