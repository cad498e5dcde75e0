"""`System`: rods, points, fields, prescribed motion, steps and equilibria, with and without scenes."""

import pickle

import actin_filaments as af
import numpy as np
import pytest

BEND, SHEAR, TWIST = 3.9e4, 1.0e4, 1.3e4


def rod(system, segments=32, length=160.0, **keys):
    nodes = np.zeros((segments + 1, 3))
    nodes[:, 0] = np.linspace(0.0, length, segments + 1)
    keys = {"start": "Wall"} | keys
    return system.add_rod(
        nodes, shear=(SHEAR, SHEAR, 3.4e4), bend=(BEND, BEND, TWIST), mass_per_length=0.026, area=38.5, **keys
    )


def test_a_cantilever_agrees_with_beam_theory():
    """Euler-Bernoulli: F L^3 / (3 B); Timoshenko adds F L / S."""
    system = af.System()
    beam = rod(system)
    system.add_force([beam.points[1] - 1], (0.0, 0.0, -0.001))
    found = system.equilibrium()
    assert found.stable and found.residual_force < 1e-8
    theory = 0.001 * 160.0**3 / (3 * BEND) + 0.001 * 160.0 / SHEAR
    # The discretisation error is of order (h/L)^2.
    assert -system.position[-1, 2] == pytest.approx(theory, rel=1e-3)
    curvature = system.curvature(beam)
    assert np.linalg.norm(curvature[0]) == pytest.approx(0.001 * 160.0 / BEND, rel=0.03)
    assert np.abs(curvature[:, 2]).max() < 1e-12
    assert system.strain(beam).shape == (32, 3)


def test_twist_of_a_driven_end_reaches_the_other():
    """In a rod between two clamps, one of which is rotated, the twist is uniform."""
    system = af.System()
    beam = rod(system, segments=8, length=80.0, end="Wall")
    behind = beam.points[1] - 1
    system.drive([0.0, 5.0], points=[behind], frames=[beam.end_wall], rotation=[(0, 0, 0), (0.5, 0, 0)])
    h = system.stable_step()
    system.step(int(np.ceil(5.5 / h)), h=h, drag=(2.0, 2.0))
    system.equilibrium()
    twist = system.curvature(beam)[:, 2]
    assert twist == pytest.approx(0.5 / 80.0, rel=1e-9)
    assert system.energies()["rod"] == pytest.approx(0.5 * TWIST * 0.5**2 / 80.0, rel=1e-9)


def test_a_rod_that_is_placed_at_rest_stays():
    angle = np.linspace(0.0, np.pi / 2, 17)
    arc = 100.0 * np.stack([np.sin(angle), np.zeros(17), 1.0 - np.cos(angle)], axis=1)
    keys = dict(shear=(SHEAR, SHEAR, 3.4e4), bend=(BEND, BEND, TWIST), mass_per_length=0.026, area=38.5)
    straight, placed = af.System(), af.System()
    straight.add_rod(arc, **keys)
    placed.add_rod(arc, rest_shape="placed", **keys)
    length = np.linalg.norm(np.diff(arc, axis=0), axis=1).sum()
    # The elastic energy is stored in joints, which represent 15 of 16 segment lengths.
    assert straight.energies()["rod"] == pytest.approx(BEND * length * 15 / 16 / (2 * 100.0**2), rel=2e-2)
    assert placed.energies()["rod"] < 1e-20


@pytest.mark.parametrize(("scheme", "order"), [("position-verlet", 2), ("pefrl", 4)])
def test_integrators_have_their_order_on_a_field_of_python(scheme, order):
    def error(h):
        system = af.System()
        system.add_points([(1.0, 0.0, 0.0)], 1.0)
        system.velocity = [(0.0, 0.8, 0.0)]
        system.add_field(lambda x: -x / np.linalg.norm(x) ** 3, lambda x: float(-1.0 / np.linalg.norm(x)))
        energy = system.kinetic_energy + system.potential_energy
        system.step(round(2.0 / h), h=h, scheme=scheme)
        assert system.kinetic_energy + system.potential_energy == pytest.approx(energy, abs=1e-3)
        return system.position[0]

    exact = error(0.002)
    coarse, fine = (np.linalg.norm(error(h) - exact) for h in (0.04, 0.02))
    assert np.log2(coarse / fine) == pytest.approx(order, abs=0.3)


def test_a_field_that_raises_ends_the_steps():
    system = af.System()
    system.add_points([(1.0, 0.0, 0.0)], 1.0)
    system.add_field(lambda x: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        system.step(1000, h=0.1)
    shapes = af.System()
    shapes.add_points(np.zeros((2, 3)), [1.0, 2.0])
    shapes.add_field(lambda x: np.zeros(3))
    with pytest.raises(ValueError, match="force of a field must have shape"):
        shapes.loads()


def test_springs_weight_and_applied_loads():
    system = af.System()
    first = system.add_points([(0, 0, 0), (0, 0, -1.0)], [1.0, 2.0])
    system.hold([first])
    system.add_springs([(0, 1)], stiffness=10.0, rest_length=1.0)
    weight = system.add_weight((0, 0, -5.0))
    assert system.equilibrium().residual_force < 1e-8
    assert system.position[1, 2] == pytest.approx(-2.0)
    system.set_factor(weight, 0.0)
    system.apply_force([(0, 0, 0), (0, 0, -20.0)])
    system.equilibrium()
    assert system.position[1, 2] == pytest.approx(-3.0)
    force, torque = system.loads()
    assert np.allclose(force[1], 0.0, atol=1e-8) and force[0, 2] == pytest.approx(-20.0) and torque.shape == (0, 3)


def test_an_end_slides_under_its_load():
    system = af.System()
    beam = rod(system, segments=8, length=80.0, end="Wall")
    tip = beam.points[1] - 1
    still = np.zeros((2, 3))
    system.drive([0.0, 1.0], points=[tip], frames=[beam.end_wall], displacement=still, slides=(1, 0, 0))
    system.add_force([tip], (34.0, 0.0, 0.0))
    system.equilibrium()
    # A strain of F / S3.
    assert system.position[-1, 0] == pytest.approx(80.0 * (1 + 34.0 / 3.4e4))


def test_a_scene_by_hand_moves_as_its_run_does(motion):
    """The same scheme, step and forces give the same positions up to round-off."""
    run = af.run(motion)
    system = af.System.from_scene(motion)
    assert np.array_equal(system.position, run.position_nm[0])
    system.step(motion.check()["steps"])
    assert system.time == pytest.approx(1.0)
    assert np.abs(system.position - run.position_nm[-1]).max() < 1e-9
    assert system.energies()["rod"] == pytest.approx(run.energies_pn_nm["rod"][-1], rel=1e-9)


def test_a_scene_by_hand_finds_its_equilibrium(scene):
    system = af.System.from_scene(scene)
    assert system.equilibrium().stable
    assert np.abs(system.position - af.equilibrium(scene).position_nm).max() < 1e-6
    system.set_factor(0, 0.5)
    system.equilibrium()
    half = af.equilibrium(scene.set("loads[0].force_pn[0]", -1.0))
    assert np.abs(system.position - half.position_nm).max() < 1e-6


def test_diverging_steps_report_their_location(motion):
    system = af.System.from_scene(motion)
    before = system.position
    with pytest.raises(af.RunFailed) as caught:
        system.step(1000, h=1.0)
    assert caught.value.step > 0 and "nm" in caught.value.body
    assert np.array_equal(system.position, before) and system.steps == 0


@pytest.mark.parametrize(
    ("call", "error", "match"),
    [
        (lambda s: s.add_points([(0, 0)], 1.0), ValueError, "position must have shape"),
        (lambda s: s.add_points([(0, 0, np.nan)], 1.0), ValueError, "must be finite"),
        (lambda s: s.add_points([(0, 0, 0)], 0.0), ValueError, "mass must be positive"),
        (lambda s: s.add_springs([(0, 9)], 1.0, 1.0), ValueError, "must be two different ones"),
        (lambda s: s.add_force([9], (0, 0, 1)), IndexError, "no point 9"),
        (lambda s: s.set_factor(3, 1.0), IndexError, "no load 3"),
        (lambda s: s.step(1, h=0.1, scheme="euler"), ValueError, "unknown integration method"),
        (lambda s: s.step(1, h=-0.1), ValueError, "time step"),
        (lambda s: s.drive([1.0, 2.0], points=[0]), ValueError, "ascend from 0"),
        (lambda s: s.set_path(0.5), ValueError, "with a path"),
        (lambda s: setattr(s, "position", np.zeros((3, 3))), ValueError, "must have 1 rows"),
        (lambda s: rod(s, start="Nail"), ValueError, "no clamp is called"),
        (lambda s: rod(s, lengths=[1.0]), ValueError, "32 segments"),
        (lambda s: rod(s, normal=(1, 0, 0)), ValueError, "normal"),
    ],
)
def test_invalid_arguments_are_refused(call, error, match):
    system = af.System()
    system.add_points([(0.0, 0.0, 0.0)], 1.0)
    with pytest.raises(error, match=match):
        call(system)


def test_writing_into_a_snapshot_is_refused():
    """A write would have no effect."""
    system = af.System()
    system.add_points(np.zeros((2, 3)), 1.0)
    for name in ("position", "velocity", "quaternion", "angular_momentum"):
        assert not getattr(system, name).flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        system.position[0, 0] = 1.0
    system.position = system.position + 1.0
    assert system.position[1, 2] == 1.0


def test_quaternions_have_unit_length():
    system = af.System()
    rod(system, segments=2, length=10.0)
    system.quaternion = system.quaternion
    with pytest.raises(ValueError, match="length 1"):
        system.quaternion = 2.0 * system.quaternion


def test_noise_has_its_temperature():
    """Equipartition: 3 k T / 2 for each point, within four standard errors of 500 points."""
    system = af.System()
    system.add_points(np.zeros((500, 3)), 1.0)
    system.step(200, h=0.1, drag=(1.0, 1.0), thermal_energy=4.1, seed=3)
    expected = 1.5 * 500 * 4.1
    assert abs(system.kinetic_energy - expected) < 4 * 4.1 * np.sqrt(1.5 * 500)


def gas(seed=3, **keys):
    """Free points in a heat bath."""
    system = af.System()
    system.add_points(np.zeros((500, 3)), 1.0)
    return system, dict(h=0.1, drag=(0.5, 0.5), thermal_energy=4.1, seed=seed) | keys


def thread(**keys):
    """A vibrating rod without a heat bath."""
    system = af.System()
    beam = rod(system, segments=8, length=80.0)
    system.add_force([beam.points[1] - 1], (0.0, 0.0, -2.0))
    return system, keys


def driven(**keys):
    """A rod with a moving end."""
    system, keys = thread(**keys)
    system.drive([0.0, 1.0], points=[0], displacement=[(0, 0, 0), (0.0, 3.0, 0.0)])
    return system, keys


@pytest.mark.parametrize("make", [gas, thread, driven, lambda: thread(scheme="vefrl", drag=(0.1, 0.1))])
def test_steps_in_parts_are_the_same_steps(make):
    """State, time and number of steps are bitwise independent of the division into calls."""
    whole, keys = make()
    whole.step(137, **keys)
    for parts in ([137], [100, 37], [1] * 137, [64, 0, 3, 70]):
        system, keys = make()
        for number in parts:
            system.step(number, **keys)
        for name in ("position", "velocity", "quaternion", "angular_momentum"):
            assert np.array_equal(getattr(system, name), getattr(whole, name)), (name, parts[:3])
        assert (system.steps, system.time) == (137, whole.time)


def test_points_in_parts_of_steps_diffuse():
    """Mean square displacement of 500 points from thermal velocities: 6 kT / (m g^2) (g t - 1 + exp(-g t)), within five
    standard errors."""
    system, keys = gas()
    system.velocity = np.random.default_rng(1).normal(scale=np.sqrt(4.1), size=(500, 3))
    for _ in range(400):
        system.step(1, **keys)
    g, t = 0.5, system.time
    theory = 6 * 4.1 / g**2 * (g * t - 1 + np.exp(-g * t))
    squares = np.sum(system.position**2, axis=1)
    assert abs(squares.mean() - theory) < 5 * theory * np.sqrt(2 / 3 / 500)


def test_time_continues_when_the_step_changes():
    system, _ = thread()
    for number, h in ((10, 1e-3), (5, 2e-3), (7, 2e-3), (1, 1e-3)):
        system.step(number, h=h)
    # Rounding of a few additions.
    assert system.time == pytest.approx(0.035, rel=1e-14) and system.steps == 23
    with pytest.raises(af.RunFailed) as caught:
        system.step(1000, h=10.0)
    assert caught.value.time_ns == pytest.approx(0.035 + (caught.value.step - 23) * 10.0, rel=1e-12)
    assert system.time == pytest.approx(0.035, rel=1e-14)


def test_a_drive_begins_when_it_is_called():
    system, keys = thread()
    system.step(100, h=0.005)
    system.drive([0.0, 1.0], points=[0], displacement=[(0, 0, 0), (0.0, 3.0, 0.0)])
    assert np.array_equal(system.position[0], (0, 0, 0))
    system.step(100, h=0.005)
    assert system.position[0, 1] == pytest.approx(1.5, rel=1e-12)
    # The point is not moved by a new term, and remains in place when fixed.
    system.add_weight((0, 0, -1.0))
    assert system.position[0, 1] == pytest.approx(1.5, rel=1e-12)
    system.hold([0])
    system.step(100, h=0.005)
    assert system.position[0, 1] == pytest.approx(1.5, rel=1e-12)


def test_the_default_step_follows_the_stiffness():
    """The frequency of two points with a spring is sqrt(2 k / m)."""
    system = af.System()
    system.add_points([(0, 0, 0), (1.0, 0, 0)], 1.0)
    system.add_springs([(0, 1)], stiffness=10.0, rest_length=1.0)
    system.step(1)
    first = system.time
    system.add_springs([(0, 1)], stiffness=990.0, rest_length=1.0)
    system.step(1)
    # The estimated frequency is accurate to a percent.
    assert system.time - first == pytest.approx(first / 10, rel=0.03)
    second = system.time
    system.step(1, scheme="position-verlet")
    assert system.time - second == pytest.approx(system.stable_step("position-verlet"), rel=1e-9)
    system.step(1, h=1e-3)
    system.add_springs([(0, 1)], stiffness=1.0, rest_length=1.0)
    before = system.time
    system.step(1)
    assert system.time - before == pytest.approx(1e-3, rel=1e-9)


def test_the_seed_stays():
    system, keys = gas()
    system.step(1, **keys)
    system.step(1)
    again, keys = gas()
    again.step(2, **keys)
    assert np.array_equal(system.position, again.position)


FACTORS = [
    {"Ramp": {"duration_ns": 0.5}},
    {"Sine": {"period_ns": 0.5}},
    {"Table": {"time_ns": [0.0, 0.3, 1.0], "factor": [0.0, 1.0, -1.0]}},
]


@pytest.mark.parametrize("factor", FACTORS)
def test_a_scene_by_hand_follows_factors_in_time(motion, factor):
    force = {"end": "End", "force_pn": [-2.0, 0.0, 0.0], "factor": factor}
    scene = motion.set("loads", [{"Force": force}])
    run = af.run(scene)
    system = af.System.from_scene(scene)
    system.step(scene.check()["steps"])
    assert np.abs(system.position - run.position_nm[-1]).max() < 1e-9
    with pytest.raises(ValueError, match="load 0 follows the time"):
        system.set_factor(0, 0.5)


def test_a_scene_by_hand_follows_its_path(motion):
    shift = {"duration_ns": 0.6, "set": [{"Shift": {"end": "Start", "shift_nm": [0.0, 1.0, 0.0]}}]}
    scene = motion.set("path", [shift])
    run = af.run(scene)
    system = af.System.from_scene(scene)
    system.step(scene.check()["steps"])
    assert np.abs(system.position - run.position_nm[-1]).max() < 1e-9
    assert np.ptp(system.position[:, 1]) > 0.1
    with pytest.raises(ValueError, match="follows the time"):
        system.set_path(0.5)
    with pytest.raises(ValueError, match="clamp of the scene"):
        system.release([0])


def well(bodies):
    """Two points and a frame in harmonic wells, coupled."""
    a, b = bodies.position
    d = a - b - (1.0, 0.0, 0.0)
    third = 2.0 * bodies.quaternion[0, 1:] * np.sign(bodies.quaternion[0, 0])
    force = np.array([-3.0 * d - 2.0 * a, 3.0 * d - 2.0 * b])
    energy = 1.5 * d @ d + a @ a + b @ b + 0.5 * third @ third
    # The gradient of sum (2 q_i)^2 / 2 with respect to rotations.
    q = bodies.quaternion[0]
    torque = -np.sign(q[0]) * q[0] * third
    return force, torque[None], float(energy)


def wells(loads, **keys):
    system = af.System()
    beam = system.add_rod(
        [(0, 0, 0), (1, 0, 0)], shear=(1e-9,) * 3, bend=(1e-9,) * 3, mass_per_length=1.0, area=1.0
    )
    assert beam.points == (0, 2)
    system.position = [(0.3, 0.1, 0.0), (-0.2, 0.4, 0.6)]
    system.add_loads(loads, **keys)
    return system


def test_loads_of_a_function_have_equilibria():
    """With the stiffness of the function or with differences: a - b = 3/4 e_x at equal and opposite positions."""
    identity = np.eye(3)
    pairs = ([0, 1, 0, 2], [0, 1, 1, 2], [5 * identity, 5 * identity, -3 * identity, identity])

    def with_stiffness(bodies):
        force, torque, energy = well(bodies)
        return af.Loads(force, torque, energy, pairs)

    def without(bodies):
        return af.Loads(*well(bodies))

    for system in (wells(with_stiffness), wells(without, differences=True)):
        assert system.equilibrium(force=1e-8, torque=1e-8).stable
        # 3 (2 x - 1) + 2 x = 0
        assert system.position == pytest.approx(np.array([(0.375, 0, 0), (-0.375, 0, 0)]), abs=1e-8)
    with pytest.raises(ValueError, match="differences=True"):
        wells(without).equilibrium()
    with pytest.raises(ValueError, match="returns no energy"):
        wells(lambda bodies: well(bodies)[0]).equilibrium()


def test_differences_equal_the_stiffness_of_a_rod():
    """A rod is relaxed next to a copy of its bending loads: a spring of points by differences."""
    springs, field = af.System(), af.System()
    for system in (springs, field):
        system.add_points([(0, 0, 0), (1.0, 0, 0), (1.5, 1.0, 0)], 1.0)
        system.hold([0])
        system.add_weight((0, 0, -1.0))

    def force(x):
        d = np.diff(x, axis=0)
        length = np.linalg.norm(d, axis=1, keepdims=True)
        pull = 40.0 * (length - 1.0) * d / length
        return np.concatenate([pull, [(0, 0, 0)]]) - np.concatenate([[(0, 0, 0)], pull])

    def energy(x):
        return float(20.0 * ((np.linalg.norm(np.diff(x, axis=0), axis=1) - 1.0) ** 2).sum())

    springs.add_springs([(0, 1), (1, 2)], stiffness=40.0, rest_length=1.0)
    field.add_field(force, energy, differences=True)
    springs.equilibrium()
    field.equilibrium()
    assert field.position == pytest.approx(springs.position, abs=1e-6)
    assert field.potential_energy == pytest.approx(springs.potential_energy, rel=1e-12)


def test_loads_are_evaluated_once_for_each_state():
    calls = []
    system = af.System()
    system.add_points([(1.0, 0, 0)], 1.0)

    def spring(bodies):
        calls.append(bodies.time)
        x = bodies.position
        return af.Loads(-x, energy=0.5 * float((x**2).sum()))

    system.add_loads(spring, name="spring")
    system.step(10, h=0.01, scheme="position-verlet")
    assert 10 <= len(calls) - 1 <= 12
    before = len(calls)
    assert system.energies()["spring"] == pytest.approx(0.5 * system.position[0, 0] ** 2)
    system.loads()
    assert len(calls) - before <= 1


def test_loads_may_depend_on_time_and_velocity():
    """Stokes drag and a force in time: v = (1 - exp(-t)) for the force t e_x with m = drag = 1 gives v = t - 1 + exp(-t)."""
    system = af.System()
    system.add_points([(0, 0, 0)], 1.0)
    system.add_loads(lambda bodies: (bodies.time, 0, 0) - bodies.velocity)
    system.step(2000, h=1e-3, scheme="position-verlet")
    t = system.time
    # First order in the step, since the velocity is not symmetric in a kick.
    assert system.velocity[0, 0] == pytest.approx(t - 1 + np.exp(-t), abs=2e-3)


def test_compiled_loads_equal_the_function():
    ctypes = pytest.importorskip("ctypes")
    pointer = ctypes.POINTER(ctypes.c_double)

    @ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_int64, ctypes.c_int64, ctypes.c_double, *[pointer] * 6)
    def spring(n, m, time, position, velocity, quaternion, momentum, force, torque):
        for i in range(3 * n):
            force[i] = -position[i]
        return 0.5 * sum(position[i] ** 2 for i in range(3 * n))

    address = ctypes.cast(spring, ctypes.c_void_p).value
    ends = []
    for loads in (lambda b: af.Loads(-b.position, energy=0.5 * float((b.position**2).sum())),
                  af.compiled(spring), af.compiled(address)):
        system = af.System()
        system.add_points([(1.0, 0.5, 0), (0, 0, 2.0)], 1.0)
        system.add_loads(loads)
        system.step(100, h=0.01)
        ends.append(system.position)
    assert np.array_equal(ends[1], ends[0]) and np.array_equal(ends[2], ends[0])


def test_stiffness_of_other_shapes_is_refused():
    def system(stiffness):
        made = af.System()
        made.add_points([(1.0, 0, 0)], 1.0)
        return made.add_loads(lambda b: af.Loads(-b.position, energy=0.0, stiffness=stiffness))

    for stiffness, match in (
        (np.eye(3), "two lists"),
        (([0], [0], np.eye(3)), r"shape \(1, 3, 3\)"),
        (([0], [4], [np.eye(3)]), "block of body 4"),
    ):
        with pytest.raises(ValueError, match=match):
            system(stiffness)


def test_linkers_are_added_and_removed():
    """A linker to a fixed point bends a cantilever by k d = 3 B / L^3 w; without the linker the rod is straight."""
    system = af.System()
    beam = rod(system, segments=16, length=80.0)
    linker = system.add_linker((beam, 80.0), (80.0, 0.0, 4.0), stiffness=0.01)
    system.equilibrium()
    w = system.position[-1, 2]
    compliance = 80.0**3 / (3 * BEND) + 80.0 / SHEAR
    # The discretisation error is of order (h/L)^2, the geometric one of order (w/L)^2.
    assert w == pytest.approx(4.0 * compliance / (compliance + 100.0), rel=1e-2)
    assert set(system.energies()) >= {"linker"}
    system.remove(linker)
    assert "linker" not in system.energies()
    system.equilibrium()
    assert abs(system.position[-1, 2]) < 1e-6
    with pytest.raises(KeyError, match="no springs"):
        system.remove(linker)
    with pytest.raises(ValueError, match="from 0 to 80"):
        system.add_linker((beam, 81.0), (0, 0, 0), stiffness=1.0)
    with pytest.raises(IndexError, match="no filament 0"):
        system.add_linker((0, 1.0), (beam, 1.0), stiffness=1.0)


def test_linkers_of_scenes_act_at_their_arc_length(scene):
    """At a filament of a scene: monomers up to 40 nm, then a rod. The same as a linker of the scene."""
    for at in (20.0, 100.0):
        linker = {"at_nm": at, "anchor_nm": [10.0, 0.0, at], "stiffness_pn_per_nm": 0.5}
        expected = af.equilibrium(scene.set("linkers", [linker]))
        system = af.System.from_scene(scene)
        system.add_linker((0, at), (10.0, 0.0, at), stiffness=0.5)
        system.equilibrium()
        assert np.abs(system.position - expected.position_nm).max() < 1e-6


def test_copies_are_independent():
    system, keys = gas()
    system.step(10, **keys)
    copy = system.copy()
    system.step(10)
    assert copy.steps == 10
    copy.step(10)
    assert np.array_equal(copy.position, system.position)
    copy.apply_force(np.ones((500, 3)))
    assert copy.loads()[0].max() == 1.0 and system.loads()[0].max() == 0.0


def test_systems_of_scenes_are_pickled(motion):
    system = af.System.from_scene(motion)
    system.step(50)
    system.set_factor(0, 0.5)
    again = pickle.loads(pickle.dumps(system))
    for other in (system, again):
        other.step(50)
    assert np.array_equal(again.position, system.position) and again.time == system.time
    again.add_linker((0, 100.0), (0, 0, 0), stiffness=1.0)
    with pytest.raises(TypeError, match="can be pickled"):
        pickle.dumps(again)


BROWNIAN = {"Brownian": {"duration_ms": 1e-3, "temperature_k": 298.0, "time_step_ns": 50.0, "seed": 3}}


def water(temperature=298.0):
    filament = {"sections": [{"Rod": {"from_nm": 0.0, "to_nm": 400.0, "segments": 10}}]}
    task = {"Brownian": BROWNIAN["Brownian"] | {"temperature_k": temperature}}
    return af.Scene(filament=filament, task=task)


def test_a_scene_in_water_moves_as_its_run_does():
    """Up to rounding in another order of unknowns; bitwise for a copy and a pickle."""
    scene = water()
    expected = af.run(scene)[-1].position_nm
    system = af.System.from_scene(scene)
    assert system.stable_step() > 0.0
    system.step(7)
    parts = [system, system.copy(), pickle.loads(pickle.dumps(system))]
    for part in parts:
        part.step(13)
        assert np.array_equal(part.position, parts[0].position)
        assert np.abs(part.position - expected).max() < 1e-9
    with pytest.raises(ValueError, match="set in its task"):
        system.step(1, seed=4)


def test_loads_act_in_water():
    """Forces along a filament move it as forces of a scene do, up to its strain of 1e-5: v = F / zeta."""
    scene = water(temperature=0.0)
    ends = [{"EndForce": {"end": end, "force_pn": [0.0, 0.0, 0.055]}} for end in ("Start", "End")]
    expected = af.run(scene.set("loads", ends))[-1].position_nm[:, 2]
    system = af.System.from_scene(scene)
    start = system.position[:, 2]
    push = np.zeros((11, 3))
    push[:, 2] = 0.01
    number = system.add_loads(lambda b: af.Loads(push, energy=-float((push * b.position).sum())), differences=True)
    system.step(20)
    moved = system.position[:, 2]
    system.remove(number)
    system.step(20)
    assert (moved - start).min() > 0.1 and moved == pytest.approx(expected, abs=400 * 1e-5)
    # The stretched filament relaxes, and its centre stays.
    assert system.position[:, 2].mean() == pytest.approx(moved.mean(), abs=1e-3)
    system.add_points([(0, 0, 0)], 1.0)
    with pytest.raises(ValueError, match="no friction"):
        system.step(1)
