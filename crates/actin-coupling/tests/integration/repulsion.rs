use actin_coupling::PeriodicCell;
use actin_coupling::repulsion::{
    Axis, Capsule, ContactParameters, Contacts, RepulsionError, Side, Tethers, Wall, WallContact,
};
use actin_mechanics::testing::{
    assert_are_second_derivatives, assert_is_balanced, assert_is_gradient, assert_is_invariant,
    loads_of,
};
use actin_mechanics::testing::{push_frame, push_point};
use actin_mechanics::{Interaction, Loads, State, Vector3, rotation};
use actin_mechanics::{Xorshift, perturb};
use std::f64::consts::PI;

const RADIUS: f64 = 3.5;
const STIFFNESS: f64 = 100.0;

fn parameters() -> ContactParameters {
    ContactParameters {
        radius: RADIUS,
        stiffness: STIFFNESS,
        apart: 30.0,
    }
}

fn chain(
    state: &mut State,
    (filament, from, along): (usize, Vector3, Vector3),
    (count, length): (usize, f64),
) -> Vec<Capsule> {
    let nodes: Vec<usize> = (0..=count)
        .map(|k| {
            let position = from + along.normalize() * (length * k as f64);
            let mass = 0.2;
            push_point(state, position, mass)
        })
        .collect();
    let of = |(k, pair): (usize, &[usize])| {
        let middle = (k as f64 + 0.5) * length;
        Capsule::new(Axis::Points([pair[0], pair[1]]), length, (filament, middle)).unwrap()
    };
    nodes.windows(2).enumerate().map(of).collect()
}

/// Adds monomers along z with centres 1.8 nm off the axis.
fn monomers(state: &mut State, filament: usize, from: Vector3, count: usize) -> Vec<Capsule> {
    let (rise, radius) = (2.7385, 1.8);
    let of = |k: usize| {
        let turn = rotation::exp(Vector3::z() * (2.9 * k as f64));
        let centre = from + Vector3::z() * (rise * k as f64) + turn * Vector3::x() * radius;
        let point = push_point(state, centre, 0.0697);
        let frame = push_frame(state, turn, [0.2, 0.15, 0.15]);
        let arms = [-0.5, 0.5].map(|h| Vector3::new(-radius, 0.0, h * rise));
        let axis = Axis::Body { point, frame, arms };
        Capsule::new(axis, rise, (filament, rise * k as f64)).unwrap()
    };
    (0..count).map(of).collect()
}

fn tangle() -> (State, Vec<Capsule>) {
    let mut state = State::default();
    let capsules = push_tangle(&mut state, 0);
    perturb(&mut state, &mut Xorshift::new(4), 0.3, 0.1);
    (state, capsules)
}

/// Adds three filaments with indices from `first`.
fn push_tangle(state: &mut State, first: usize) -> Vec<Capsule> {
    let (z, x) = (Vector3::z(), Vector3::x());
    let mut capsules = monomers(state, first, z * -8.0, 7);
    let across = (first + 1, x * -15.0 + Vector3::y() * 5.0, x + z * 0.1);
    capsules.extend(chain(state, across, (3, 10.0)));
    let slanted = (first + 2, Vector3::new(-12.0, 10.0, -4.0), x + z * 0.3);
    capsules.extend(chain(state, slanted, (3, 8.0)));
    capsules
}

/// Sheared box in which filaments of the [`tangle`] cross the faces.
fn cell(state: &mut State) -> PeriodicCell {
    PeriodicCell {
        size: Vector3::new(19.0, 16.0, 23.0),
        strain: 0.4,
        factor: state.add_control(0.5),
    }
}

/// Displaces the points of the last filament of the [`tangle`].
fn displace_last(state: &mut State, by: Vector3) {
    let count = state.points.len();
    for i in count - 4..count {
        state.points.position.add(i, by);
    }
}

/// Forces and energies equal the forces and energies of explicit copies of the filament.
#[test]
fn filaments_repel_each_other_across_faces() {
    let (mut state, capsules) = tangle();
    let mut cell = cell(&mut state);
    cell.size *= 10.0;
    let open = Contacts::new(capsules.clone(), parameters()).unwrap();
    let across = open.clone().with_cell(Some(cell));
    let (here, energy) = (loads_of(&open, &state), open.energy(&state));
    let gap = open.closest(&state).unwrap().gap;
    assert!(energy > 10.0, "no contact");
    for index in [[0, 0, 1], [-2, 5, -3]] {
        let mut away = state.clone();
        displace_last(&mut away, cell.displacement(index, &state));
        let there = loads_of(&across, &away);
        let difference = there.force.iter().zip(here.force.iter());
        let largest = difference.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        // Rounding of positions up to 1e3 nm times the stiffness.
        assert!(largest < 1e-9, "{index:?}: {largest:e}");
        assert!((across.energy(&away) - energy).abs() < 1e-9);
        let found = across.closest(&away).unwrap();
        assert!((found.gap - gap).abs() < 1e-11);
    }
}

/// Derivatives in a box that is smaller than the filaments, with contacts of a filament and its own
/// image and of neighbouring capsules with a common point.
#[test]
fn contacts_across_faces_have_a_gradient_and_conserve_momentum() {
    let (mut state, capsules) = tangle();
    let cell = cell(&mut state);
    let contacts = Contacts::new(capsules, parameters())
        .unwrap()
        .with_cell(Some(cell));
    assert!(contacts.energy(&state) > 100.0, "no contact");
    assert_is_gradient(&contacts, &state, 1e-3, 1e-8);
    assert_are_second_derivatives(&contacts, &state, 1e-3, 1e-7);
    let force: Vector3 = loads_of(&contacts, &state).force.iter().sum();
    assert!(force.norm() < 1e-11, "{force}");

    let mut alone = State::default();
    let along = Vector3::new(0.1, 1.0, 0.0);
    let capsules = chain(&mut alone, (0, Vector3::zeros(), along), (4, 10.0));
    let size = Vector3::new(5.0, 100.0, 100.0);
    let (strain, factor) = (0.0, alone.add_control(1.0));
    let own = PeriodicCell {
        size,
        strain,
        factor,
    };
    let contacts = Contacts::new(capsules, parameters())
        .unwrap()
        .with_cell(Some(own));
    assert!(contacts.energy(&alone) > 10.0, "no contact");
    assert_is_gradient(&contacts, &alone, 1e-3, 1e-8);
    assert_are_second_derivatives(&contacts, &alone, 1e-3, 1e-7);
}

/// Energies equal those among explicit copies. The virial equals the derivative of the energy with
/// respect to the strain: `dE/dg = sum r_z F_x`.
#[test]
fn images_are_equivalent_to_copies() {
    let (mut state, capsules) = tangle();
    let cell = cell(&mut state);
    let contacts = Contacts::new(capsules.clone(), parameters()).unwrap();
    let contacts = contacts.with_cell(Some(cell));
    let (mut all, mut copies) = (capsules, state.clone());
    let own = all.len();
    let range = || -3..=3;
    let indices = range().flat_map(|x| range().flat_map(move |y| range().map(move |z| [x, y, z])));
    for (k, index) in indices.filter(|index| *index != [0; 3]).enumerate() {
        let first = 3 * (k + 1);
        let (points, frames) = (copies.points.len(), copies.frames.len());
        all.extend(push_tangle(&mut copies, first));
        let shift = cell.displacement(index, &state);
        for (i, at) in state.points.position.iter().enumerate() {
            copies.points.position.set(points + i, at + shift);
        }
        for i in 0..state.frames.len() {
            let turn = state.frames.orientation.get(i);
            copies.frames.orientation.set(frames + i, turn);
        }
    }
    let open = Contacts::new(all, parameters()).unwrap();
    let energies = |contacts: &Contacts, state: &State| {
        let mut energies = vec![0.0; contacts.elements()];
        contacts.write_energies(state, &mut energies);
        energies
    };
    let (periodic, explicit) = (energies(&contacts, &state), energies(&open, &copies));
    for (a, b) in periodic.iter().zip(&explicit[..own]) {
        assert!((a - b).abs() < 1e-10 * (1.0 + b), "{a}, {b}");
    }
    let energy = |factor: f64| {
        let mut strained = state.clone();
        strained.controls[cell.factor] = factor;
        contacts.energy(&strained)
    };
    // The central difference has an error of second order in displacements of 0.1 % of a contact.
    let slope = (energy(0.5 + 1e-4) - energy(0.5 - 1e-4)) / 2e-4 / cell.strain;
    let virial = contacts.periodic_virial(&state);
    let expected = virial[(2, 0)];
    assert!((slope / expected - 1.0).abs() < 1e-5, "{slope}, {expected}");
}

#[test]
fn contacts_have_a_gradient_and_conserve_momentum() {
    let (state, capsules) = tangle();
    let contacts = Contacts::new(capsules, parameters()).unwrap();
    assert!(contacts.energy(&state) > 10.0, "no contact");
    // The kernel is not smooth at its edge, which limits the order of differences.
    assert_is_gradient(&contacts, &state, 1e-3, 1e-8);
    assert_are_second_derivatives(&contacts, &state, 1e-3, 1e-7);
    assert_is_balanced(&contacts, &state, 1e-13);
    assert_is_invariant(&contacts, &state, 1e-12);
}

#[test]
fn walls_are_the_gradient_of_their_energy() {
    let (state, capsules) = tangle();
    let centre = Vector3::new(1.0, 22.0, 2.0);
    let sphere = |radius, side| Wall::sphere(centre, radius, side);
    let axis = Vector3::new(1.0, 0.1, 0.4);
    let cylinder = |radius, side| Wall::cylinder(centre, axis, radius, side);
    for wall in [
        Wall::plane(Vector3::y() * -1.0, Vector3::new(0.2, 2.0, 0.1)),
        sphere(15.0, Side::Outside),
        sphere(23.0, Side::Inside),
        cylinder(15.0, Side::Outside),
        cylinder(23.0, Side::Inside),
    ] {
        let wall = wall.unwrap();
        let contact = WallContact::new(capsules.clone(), wall, RADIUS, STIFFNESS).unwrap();
        assert!(contact.energy(&state) > 1.0, "{wall:?}: no contact");
        assert_is_gradient(&contact, &state, 1e-3, 1e-8);
        assert_are_second_derivatives(&contact, &state, 1e-3, 1e-7);
    }
}

fn force_between(
    first: (Vector3, Vector3),
    second: (Vector3, Vector3),
    division: [(usize, f64); 2],
    across: Vector3,
) -> f64 {
    let mut state = State::default();
    let mut capsules = chain(&mut state, (0, first.0, first.1), division[0]);
    let others = state.points.len();
    capsules.extend(chain(&mut state, (1, second.0, second.1), division[1]));
    let contacts = Contacts::new(capsules, parameters()).unwrap();
    let loads = loads_of(&contacts, &state);
    let on_second: Vector3 = (others..state.points.len())
        .map(|i| loads.force.get(i))
        .sum();
    on_second.dot(&across)
}

/// Closed form `2 pi e d q^4` for any position and division. The errors of the sums grow if the
/// contact contains few points.
#[test]
fn crossing_force_does_not_depend_on_position_or_division() {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    for (d, bound) in [(2.333, 1e-4), (4.0, 1e-3), (5.5, 1e-2), (6.3, 5e-2)] {
        let q = 1.0 - d * d / (4.0 * RADIUS * RADIUS);
        let expected = 27.0 * STIFFNESS / (32.0 * PI) * 2.0 * PI * d * q.powi(4);
        for division in [(4, 10.0), (15, 2.7385), (2, 20.0), (40, 1.0)] {
            for shift in [0.0, 0.3, 1.1, 4.9] {
                let first = (x * (-20.0 + shift), x);
                let second = (y * -19.0 + z * d, y);
                let force = force_between(first, second, [division, (4, 10.0)], z);
                let error = (force / expected - 1.0).abs();
                assert!(error < bound, "{d}, {division:?}, {shift}: {error:e}");
            }
        }
    }
}

#[test]
fn parallel_filaments_have_the_force_per_length_of_the_integral() {
    let (y, z) = (Vector3::y(), Vector3::z());
    let reach = 2.0 * RADIUS;
    let per_length = |d: f64| {
        let (e, q) = (27.0 * STIFFNESS / (32.0 * PI), 1.0 - (d / reach).powi(2));
        256.0 / 315.0 * e * reach * 4.5 * q.powf(3.5) * 2.0 * d / (reach * reach)
    };
    for (d, bound) in [(3.0, 1e-4), (5.0, 1e-3), (6.3, 3e-2)] {
        for shift in [0.0, 0.7] {
            let second = (y * d + z * (20.0 + shift), z);
            let force = force_between((Vector3::zeros(), z), second, [(8, 10.0), (11, 2.7385)], y);
            let error = (force / (11.0 * 2.7385) / per_length(d) - 1.0).abs();
            assert!(error < bound, "{d}, {shift}: {error:e}");
        }
    }
}

/// The largest stiffness of a crossing equals the parameter; for parallel filaments it equals the
/// stiffness of tethers.
#[test]
fn greatest_stiffness_equals_the_parameter() {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let slope = |force: &dyn Fn(f64) -> f64, d: f64| (force(d - 1e-3) - force(d + 1e-3)) / 2e-3;
    let steps = || (20..70).map(|k| f64::from(k) * 0.1);
    let crossing = |d: f64| {
        let pieces = [(4, 10.0), (4, 10.0)];
        force_between((x * -20.0, x), (y * -20.0 + z * d, y), pieces, z)
    };
    let greatest = steps().map(|d| slope(&crossing, d)).fold(0.0, f64::max);
    assert!((greatest / STIFFNESS - 1.0).abs() < 2e-3, "{greatest}");
    let parallel = |d: f64| {
        let pieces = [(8, 10.0), (4, 10.0)];
        force_between((Vector3::zeros(), z), (y * d + z * 20.0, z), pieces, y) / 40.0
    };
    let greatest = steps().map(|d| slope(&parallel, d)).fold(0.0, f64::max);
    let contacts = Contacts::new(Vec::new(), parameters()).unwrap();
    let tether = contacts.greatest_stiffness() / 6.0;
    assert!(
        (greatest / tether - 1.0).abs() < 2e-3,
        "{greatest}, {tether}"
    );
}

#[test]
fn loads_do_not_depend_on_the_age_of_the_neighbour_list() {
    let (mut state, capsules) = tangle();
    let open = Contacts::new(capsules, parameters()).unwrap();
    let cell = cell(&mut state);
    check_age(&open, state.clone(), cell);
    check_age(&open.with_cell(Some(cell)), state, cell);
}

fn check_age(used: &Contacts, mut state: State, cell: PeriodicCell) {
    let mut noise = Xorshift::new(9);
    for _ in 0..200 {
        perturb(&mut state, &mut noise, 0.4, 0.05);
        state.controls[cell.factor] += 0.05 * noise.sample();
        let fresh = used.clone();
        assert_eq!(loads_of(used, &state), loads_of(&fresh, &state));
        assert_eq!(
            used.energy(&state).to_bits(),
            fresh.energy(&state).to_bits()
        );
        let blocks = |contacts: &Contacts| {
            let mut stiffness = actin_mechanics::Stiffness::default();
            let second = contacts.second_order().unwrap();
            second.add_stiffness(&state, &mut stiffness);
            stiffness
        };
        assert_eq!(blocks(used), blocks(&fresh));
        assert_eq!(used.closest(&state), fresh.closest(&state));
    }
}

#[test]
fn distant_parts_of_a_filament_repel_each_other() {
    let mut state = State::default();
    let (y, z) = (Vector3::y(), Vector3::z());
    let there = chain(&mut state, (0, Vector3::zeros(), z), (5, 10.0));
    let back = chain(&mut state, (0, y * 6.0 + z * 50.0, -z), (5, 10.0));
    let shifted = back.iter().map(|capsule| {
        let (first, middle) = (state.points.len() - 6, capsule.middle());
        let k = (middle / 10.0).floor();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 to 4"
        )]
        let first = first + k as usize;
        let middle = middle + 50.0 + 9.42;
        Capsule::new(Axis::Points([first, first + 1]), 10.0, (0, middle)).unwrap()
    });
    let capsules: Vec<Capsule> = there.into_iter().chain(shifted).collect();
    let contacts = Contacts::new(capsules, parameters()).unwrap();
    let mut energies = vec![0.0; contacts.elements()];
    contacts.write_energies(&state, &mut energies);
    let touched: Vec<bool> = energies.iter().map(|e| *e > 0.0).collect();
    // The last segment before the bend is 9.4 nm of contour from the first after it, and 19.4 nm
    // from the next.
    let expected = [true, true, true, true, false, false, true, true, true, true];
    assert_eq!(touched, expected);
}

#[test]
fn exploded_states_end_in_no_panic() {
    let (state, capsules) = tangle();
    let contacts = Contacts::new(capsules, parameters()).unwrap();
    for bad in [f64::NAN, f64::INFINITY, 1e200] {
        let mut broken = state.clone();
        broken.points.position.x[2] = bad;
        contacts.add_loads(&broken, &mut Loads::zeros(&broken));
        let _ = contacts.closest(&broken);
    }
}

/// `k L |x|^2 / 2` for a shift of 2 nm.
#[test]
fn tethers_hold_all_of_an_axis() {
    let mut state = State::default();
    let capsules = chain(&mut state, (0, Vector3::zeros(), Vector3::z()), (2, 10.0));
    let tethers = Tethers::new(&state, &capsules, RADIUS, 3.0);
    for i in 0..3 {
        state.points.position.add(i, Vector3::x() * 2.0);
    }
    assert!((tethers.energy(&state) - 3.0 * 20.0 * 2.0).abs() < 1e-10);
    assert_is_gradient(&tethers, &state, 1e-2, 1e-10);
}

#[test]
fn invalid_numbers_are_refused() {
    let key = |result: Result<(), RepulsionError>| result.unwrap_err().key;
    let contacts = |like| Contacts::new(Vec::new(), like).map(drop);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let of = |radius, stiffness, apart| ContactParameters {
            radius,
            stiffness,
            apart,
        };
        assert_eq!(key(contacts(of(bad, 1.0, 30.0))), "radius");
        assert_eq!(key(contacts(of(1.0, bad, 30.0))), "stiffness");
        assert_eq!(key(contacts(of(1.0, 1.0, bad))), "apart");
        let capsule = Capsule::new(Axis::Points([0, 1]), bad, (0, 0.0));
        assert_eq!(key(capsule.map(drop)), "length");
    }
    assert_eq!(
        key(contacts(ContactParameters {
            apart: 10.0,
            ..parameters()
        })),
        "apart"
    );
    let contact = |wall| WallContact::new(Vec::new(), wall, RADIUS, STIFFNESS).map(drop);
    let (zero, z) = (Vector3::zeros(), Vector3::z());
    let plane = |point, normal| Wall::plane(point, normal).map(drop);
    assert_eq!(key(plane(zero, zero)), "normal");
    assert_eq!(key(plane(z / 0.0, z)), "point of a wall");
    assert!(plane(zero, z * 1e-200).is_ok());
    assert_eq!(
        key(Wall::cylinder(zero, zero, 9.0, Side::Inside).map(drop)),
        "axis"
    );
    for wall in [
        |radius, side| Wall::sphere(Vector3::zeros(), radius, side),
        |radius, side| Wall::cylinder(Vector3::zeros(), Vector3::x(), radius, side),
    ] {
        assert_eq!(key(wall(-1.0, Side::Outside).map(drop)), "radius of a wall");
        let of = |side| contact(wall(3.0, side).unwrap());
        assert_eq!(key(of(Side::Inside)), "radius of a wall");
        assert!(of(Side::Outside).is_ok());
    }
}

/// Moves the second filament through an image of the first one, and an image of the second
/// through the first one by strain.
fn check_crossings_of_images(contacts: &Contacts, above: &State) {
    let mut state = above.clone();
    let cell = PeriodicCell {
        size: Vector3::new(60.0, 60.0, 60.0),
        strain: 1.0,
        factor: state.add_control(0.0),
    };
    let contacts = contacts.clone().with_cell(Some(cell));
    let moved = |by: Vector3, strain: f64| {
        let mut moved = state.clone();
        for i in moved.points.len() / 2..moved.points.len() {
            moved.points.position.add(i, by);
        }
        moved.controls[cell.factor] = strain;
        moved
    };
    let raised = |by: f64| moved(Vector3::z() * by, 0.0);
    let passes = |from: &State, to: &State| contacts.passes_through(from, to).is_some();
    assert!(passes(&state, &raised(60.0)) && !passes(&state, &raised(50.0)));
    assert!(passes(&raised(-50.0), &state) && !passes(&raised(50.0), &state));
    // Images are at x = -30 and 30 nm; the first filament ends at -20 and 20 nm.
    let beside = |strain: f64| moved(Vector3::new(29.0, 0.0, -63.0), strain);
    for (strain, crosses) in [(-0.1, false), (-0.4, true), (0.1, false)] {
        assert_eq!(passes(&beside(0.0), &beside(strain)), crosses, "{strain}");
    }
}

#[test]
fn crossings_are_detected() {
    let crossing = |height: f64, aside: f64| {
        let mut state = State::default();
        let x = Vector3::x();
        let mut capsules = chain(&mut state, (0, x * -20.0, x), (4, 10.0));
        let from = Vector3::new(1.0, -20.0 + aside, height);
        capsules.extend(chain(&mut state, (1, from, Vector3::y()), (4, 10.0)));
        (state, capsules)
    };
    let (above, capsules) = crossing(3.0, 0.0);
    let contacts = Contacts::new(capsules.clone(), parameters()).unwrap();
    let told = |from: &State, to: &State| contacts.passes_through(from, to).is_some();
    // Beyond the filament, within the limit, and past an end, each from near and from far.
    for start in [crossing(3.0, 0.0).0, crossing(50.0, 0.0).0] {
        for (height, aside, passes) in [
            (-3.0, 0.0, true),
            (-70.0, 0.0, true),
            (0.5, 0.0, true),
            (2.0, 0.0, false),
            (-3.0, 500.0, false),
        ] {
            let way = told(&start, &crossing(height, aside).0);
            assert_eq!(way, passes, "to {height}, {aside}");
        }
    }
    assert!(!told(&above, &above));
    check_crossings_of_images(&contacts, &above);
    let centre = Vector3::new(1.0, 4.0, 0.0);
    // Through the wall, whose axis is 1 nm off or crosses, and past it.
    for wall in [
        Wall::sphere(centre, 2.0, Side::Outside),
        Wall::cylinder(centre, Vector3::x(), 2.0, Side::Outside),
    ] {
        let wall = wall.unwrap();
        let wall = WallContact::new(capsules.clone(), wall, RADIUS, STIFFNESS).unwrap();
        for (aside, passes) in [(0.0, true), (100.0, false)] {
            let [above, below] = [5.0, -5.0].map(|height| crossing(height, aside).0);
            assert_eq!(wall.passes_through(&above, &below).is_some(), passes);
        }
    }
}
