"""Times 400 short runs as a sweep on one core and on two, and one by one; prints the overhead of the sweep.

Needs only Python, and actin on the path or in ACTIN:
    python3 scenarios/studies/time_sweep.py [RUNS]
"""

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SCENE = """Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 40.0), Rod(from_nm: 40.0, to_nm: 80.0)],
        monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Dynamics(duration_ns: 30.0, record_every_ns: 3.0, drag: (translational_per_ns: 0.3, rotational_per_ns: 0.3)),
)"""
SWEEP = """Sweep(
    scene: "scene.ron",
    vary: [Grid(key: "loads[0].force_pn[0]", from: -4.0, to: -0.2, number: %d)],
    samples: Samples(number: 20),
    results: ["tip_displacement_nm[0]"],
)"""
ACTIN = os.environ.get("ACTIN", "actin")


def timed(commands):
    """Wall time and processor time (s) of commands, one after the other."""
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    for command in commands:
        subprocess.run(command, check=True, capture_output=True)
    wall, after = time.perf_counter() - started, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 400
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        Path("scene.ron").write_text(SCENE)
        Path("sweep.ron").write_text(SWEEP % (number // 20))
        print(f"{number} runs; load before: {os.getloadavg()[0]:.1f}")
        sweep = [timed([[ACTIN, "sweep", "sweep.ron", "--out", f"s{jobs}", "--jobs", str(jobs)]]) for jobs in (1, 2)]
        runs = [Path("s1/runs") / str(run) for run in range(number)]
        inside = sum(json.loads((run / "summary.json").read_text())["wall_s"] for run in runs)
        alone = timed([[ACTIN, "run", str(run / "scene.ron"), "--out", f"r{run.name}"] for run in runs])
        tables = [Path(f"s{jobs}/table.csv").read_bytes() for jobs in (1, 2)]
        assert tables[0] == tables[1]
    print("| | wall (s) | processor (s) |\n|---|---|---|")
    for name, (wall, processor) in zip(["sweep, one core", "sweep, two cores", "the same runs one by one"], [*sweep, alone]):
        print(f"| {name} | {wall:.1f} | {processor:.1f} |")
    print(f"steps of all runs: {inside:.1f} s of wall time")
    for name, i in ("wall", 0), ("processor", 1):
        print(f"the sweep adds {100 * (sweep[0][i] / alone[i] - 1):+.1f} % of {name} time to its runs")


main()
