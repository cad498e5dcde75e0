"""500 nm of filament compressed to 350 nm at seven resolutions, compared with ReaDDy and Cytosim; causes of bending out of plane.

Needs numpy and matplotlib. From the folder of the sweeps subcell-sweep, subcell-heat-sweep and subcell-why-sweep:
    python3 scenarios/studies/subcell.py
"""

import csv
from pathlib import Path

import numpy as np
import study

METRICS = ["mean_distance_nm", "peak_asymmetry", "non_coplanarity", "supertwist_deg"]
THEIRS = ["average_perp_distance", "peak_asymmetry", "non_coplanarity", "twist_angle"]
DIGITS = [1, 3, 4, 0]


def published():
    """Rows of the published table."""
    with open(Path(__file__).parent / "subcell.csv", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def name(row):
    sections = row["filament.sections"]
    if "Ellipsoids" not in sections:
        return "rod"
    lower = float(sections.split("Ellipsoids(from_nm: ")[1].split(",")[0])
    return "monomers" if lower == 0 else f"{500 - 2 * lower:.0f} nm of monomers"


def shown(values, digits):
    """Mean and standard deviation, or the value if there is only one."""
    values = np.array(values, float)
    # Adding zero converts -0.0 to 0.0.
    text = f"{round(values.mean(), digits) + 0.0:.{digits}f}"
    return text if len(values) == 1 else f"{text} ± {values.std(ddof=1):.{digits}f}"


def at(run, points, metric):
    """Relative times of the compression, 0 to 1, and values."""
    time, values = study.observed(run, f"buckling[0]_{points}_points_{metric}")
    text = (Path(run) / "scene.ron").read_text()
    stages = [float(part.split(",")[0].split(")")[0]) for part in text.split("duration_ns: ")[1:-1]]
    begin, push = sum(stages[:-1]), stages[-1]
    return (time - begin) / push, values


def line(label, runs):
    """Final values of runs as a row: four metrics of 50 points, and the supertwist of 200."""
    last = lambda points, metric: [at(run, points, metric)[1][-1] for run in runs]
    cells = [shown(last(50, metric), digits) for metric, digits in zip(METRICS, DIGITS)]
    return [label, *cells, shown(last(200, "supertwist_deg"), 0)]


def runs(sweep, row):
    """Run directories of a row of its table."""
    with open(Path(sweep) / "runs.csv", newline="") as file:
        return [f"{sweep}/runs/{r['run']}" for r in csv.DictReader(file) if float(r["point"]) == row["point"]]


def why(row):
    """Difference of the row of the sweep from the plain rod."""
    path = row["path"]
    if "Turn" in path:
        return f"rod, turned by {float(path.split('0.0, 0.0, ')[1].split(')')[0]):.0f} deg first"
    if "duration_ns: 1500" not in path:
        return "rod, 30 times faster"
    return "rod, one end pinned" if "Pin" in row["clamps[1]"] else f"rod, {row['filament.rod.law']}"


def theirs(lines, panels):
    rows = published()
    for simulator, label, colour in [("readdy", "ReaDDy", "k"), ("cytosim", "Cytosim", "0.6")]:
        of = [row for row in rows if row["simulator"] == simulator]
        slowest = [row for row in of if row["velocity"] == "4.7"]
        times = sorted({float(row["normalized_time"]) for row in slowest})
        value = lambda time, key: [float(r[key]) for r in of if float(r["normalized_time"]) == time]
        lines.append([f"{label}, 20 runs", *(shown(value(1.0, k), d) for k, d in zip(THEIRS, DIGITS)), ""])
        if simulator == "readdy":
            lines.append([f"{label}, before it is pressed", *(shown(value(0.0, k)[:1], d) for k, d in zip(THEIRS, DIGITS)), ""])
        for panel, key in zip(panels, ["non_coplanarity", "twist_angle"]):
            slow = [[float(r[key]) for r in slowest if float(r["normalized_time"]) == time] for time in times]
            mean, spread = np.mean(slow, axis=1), np.std(slow, axis=1, ddof=1)
            panel.plot(times, mean, color=colour, lw=2, label=f"{label}, 4.7 µm/s, mean ± sd of 5")
            panel.fill_between(times, mean - spread, mean + spread, color=colour, alpha=0.2, lw=0)


def main():
    options = study.arguments(["subcell-sweep", "subcell-heat-sweep", "subcell-why-sweep"], __doc__)
    figure, panels = study.axes(columns=2, width=7.2, height=3.1)
    lines = []
    theirs(lines, panels)
    plain, turned = [], []
    for row in study.rows(options.subcell_sweep):
        turn = row["path[0].set[0].turn_deg[2]"]
        is_turned = turn != 0
        directories = runs(options.subcell_sweep, row)
        label = name(row) + (f", turned by {turn:.0f} deg first" if is_turned else "")
        (turned if is_turned else plain).append(line(label, directories))
        if name(row) in ("monomers", "rod"):
            colour, style = ("C0" if name(row) == "rod" else "C3"), ("-" if is_turned else "--")
            for panel, metric in zip(panels, ["non_coplanarity", "supertwist_deg"]):
                panel.plot(*at(directories[0], 50, metric), style, color=colour, label=label)
    heat, reasons = [], []
    if Path(options.subcell_heat_sweep).exists():
        for row in study.rows(options.subcell_heat_sweep):
            found = runs(options.subcell_heat_sweep, row)
            heat.append(line(f"{name(row)}, 298 K, {len(found)} runs", found))
    if Path(options.subcell_why_sweep).exists():
        for row in study.rows(options.subcell_why_sweep):
            reasons.append(line(why(row), runs(options.subcell_why_sweep, row)))
    for panel, text in zip(panels, ["non-coplanarity", "supertwist (deg), 50 points"]):
        panel.set_xlim(0, 1)
        panel.set_xlabel("share of the way from 500 to 350 nm")
        panel.set_ylabel(text)
    panels[0].set_ylim(-0.001, 0.03)
    panels[0].legend(fontsize=6.5)
    study.save(figure, f"{options.figures}/subcell.svg")
    study.put_table(options.page, ["filament at 350 nm", "mean distance from the line of the ends (nm)", "asymmetry of the peak",
                                   "non-coplanarity", "supertwist (deg)", "the same, 200 points"],
                    [*lines, *plain, *heat, *turned, *reasons], "subcell")


if __name__ == "__main__":
    main()
