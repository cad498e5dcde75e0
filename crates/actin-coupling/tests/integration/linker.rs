use actin_cosserat::{RodLayout, StraightRod};
use actin_coupling::{
    Anchor, Linker, LinkerAngles, LinkerEnd, LinkerError, LinkerKey, PeriodicCell, PeriodicImage,
    RodPlace, Site,
};
use actin_mechanics::testing::{
    assert_fluctuates, assert_is_balanced, assert_is_gradient, assert_is_invariant,
    assert_is_stiffness, loads_of, resultant, stiffness_matrix,
};
use actin_mechanics::testing::{push_frame, push_point};
use actin_mechanics::{Interaction, State, Vector3, rotation};
use actin_mechanics::{Xorshift, perturb};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// Rod of three segments of 10 nm along z with two monomers next to it, all perturbed.
struct Scene {
    state: State,
    rod: RodLayout,
    /// Point and frame of each monomer.
    monomers: [(usize, usize); 2],
}

fn scene(noise: &mut Xorshift) -> Scene {
    let mut state = State::default();
    let rod = StraightRod::uniform(3, 10.0).push(&mut state).unwrap();
    let monomers = [35.0, 38.0].map(|height| {
        let point = push_point(&mut state, Vector3::z() * height, 0.0697);
        let frame = push_frame(
            &mut state,
            rotation::exp(Vector3::z() * height),
            [0.2, 0.15, 0.15],
        );
        (point, frame)
    });
    perturb(&mut state, noise, 1.0, 0.8);
    Scene {
        state,
        rod,
        monomers,
    }
}

fn place(segment: usize, fraction: f64, radius: f64, azimuth: f64) -> RodPlace {
    RodPlace {
        segment,
        fraction,
        radius,
        azimuth,
    }
}

impl Scene {
    fn on_rod(&self, segment: usize, fraction: f64) -> Site {
        let place = place(segment, fraction, 1.8, 0.7 + fraction);
        Site::on_rod(&self.rod, place).unwrap()
    }

    fn on_monomer(&self, k: usize) -> Site {
        let (point, frame) = self.monomers[k];
        Site::on_monomer(point, frame, Vector3::new(0.5, -1.0, 0.3)).unwrap()
    }
}

fn anchor() -> LinkerEnd {
    LinkerEnd::Anchor(Anchor::fixed(Vector3::new(3.0, -2.0, 17.0)))
}

fn all(scene: &Scene, rest_length: f64) -> Vec<Linker> {
    let pairs = [
        (scene.on_rod(1, 0.3), anchor()),
        (scene.on_monomer(0), anchor()),
        (
            scene.on_rod(0, 0.25),
            LinkerEnd::Site(scene.on_rod(2, 0.75)),
        ),
        (scene.on_rod(1, 0.3), LinkerEnd::Site(scene.on_monomer(1))),
        (scene.on_monomer(0), LinkerEnd::Site(scene.on_monomer(1))),
        (scene.on_rod(0, 0.6), LinkerEnd::Site(scene.on_rod(1, 0.2))),
        (scene.on_rod(1, 0.2), LinkerEnd::Site(scene.on_rod(1, 0.9))),
    ];
    let linker = |(site, end)| Linker::new(site, end, 7.0, rest_length).unwrap();
    pairs.into_iter().map(linker).collect()
}

#[test]
fn loads_and_stiffness_are_derivatives() {
    let mut noise = Xorshift::new(11);
    for rest_length in [0.0, 0.9, 2.5, 40.0] {
        let scene = scene(&mut noise);
        for linker in all(&scene, rest_length) {
            // h = 0.01 nm and rad: truncation and rounding errors are below 1e-11 of 30 pN.
            assert_is_gradient(&linker, &scene.state, 0.01, 1e-9);
            assert_is_stiffness(&linker, &scene.state, 0.01, 1e-9);
            if rest_length == 0.0 {
                assert_fluctuates(&[&linker], &scene.state, 1e-12);
            }
        }
    }
}

#[test]
fn loads_and_stiffness_of_linkers_to_periodic_images() {
    let mut scene = scene(&mut Xorshift::new(14));
    let cell = PeriodicCell {
        size: Vector3::new(30.0, 40.0, 50.0),
        strain: 0.4,
        factor: scene.state.add_control(0.5),
    };
    for linker in all(&scene, 2.5) {
        let direct = linker.end_position(&scene.state);
        for index in [Some([-1, 0, 1]), None] {
            let linker = linker
                .clone()
                .with_image(Some(PeriodicImage { cell, index }));
            let shift = linker.end_position(&scene.state) - direct;
            if index.is_some() {
                assert!((shift - Vector3::new(-20.0, 0.0, 50.0)).norm() < 1e-13);
            }
            // h = 0.01 nm and rad, forces up to 400 pN.
            assert_is_gradient(&linker, &scene.state, 0.01, 1e-9);
            assert_is_stiffness(&linker, &scene.state, 0.01, 1e-9);
        }
    }
}

/// The nearest image is the nearest one of 125 images.
#[test]
fn nearest_images() {
    let mut state = State::default();
    let cell = PeriodicCell {
        size: Vector3::new(30.0, 40.0, 50.0),
        strain: -0.6,
        factor: state.add_control(0.5),
    };
    let mut noise = Xorshift::new(15);
    for _ in 0..100 {
        let short = noise.vector() * 4.0;
        let index = noise.vector().map(|x| (2.0 * x).round());
        let unstrained = index.component_mul(&cell.size);
        let d = short + unstrained + Vector3::x() * (-0.3 * unstrained.z);
        assert!((d + cell.to_nearest(d, &state) - short).norm() < 1e-12);
        let wrapped = cell.wrap(d, &state);
        assert!((cell.wrap(short, &state) - wrapped).norm() < 1e-12);
        assert!((0.0..=40.0).contains(&wrapped.y) && (0.0..=50.0).contains(&wrapped.z));
    }
}

#[test]
fn a_linker_within_a_rigid_body_does_nothing() {
    let scene = scene(&mut Xorshift::new(13));
    let (point, frame) = scene.monomers[1];
    let other = LinkerEnd::Site(Site::on_monomer(point, frame, Vector3::z()).unwrap());
    let linker = Linker::new(scene.on_monomer(1), other, 7.0, 0.5).unwrap();
    let (force, torque) = resultant(&scene.state, &loads_of(&linker, &scene.state));
    let stiffness = stiffness_matrix(&linker, &scene.state);
    assert!(linker.force(&scene.state).norm() > 1.0);
    assert!(force.norm() < 1e-12 && torque.norm() < 1e-12);
    assert!(stiffness.amax() < 1e-12, "{}", stiffness.amax());
}

/// Linkers with stiffness against tilt and twist between sites of different frames, at states far from the reference.
fn angular(scene: &mut Scene, rest_length: f64, noise: &mut Xorshift) -> Vec<Linker> {
    let built = all(scene, rest_length).into_iter().flat_map(|linker| {
        let angles = linker.angles_as_built((60.0, 25.0), &scene.state);
        let normal = LinkerAngles::normal_to_sites((60.0, 25.0)).unwrap();
        let both =
            angles.map(|angles| [angles, normal].map(|one| linker.clone().with_angles(Some(one))));
        both.into_iter().flatten()
    });
    let built: Vec<_> = built.collect();
    assert!(built.len() >= 4, "{}", built.len());
    perturb(&mut scene.state, noise, 0.5, 0.4);
    built
}

#[test]
fn angles_of_linkers_have_consistent_derivatives() {
    let mut noise = Xorshift::new(16);
    for rest_length in [0.0, 2.5, 0.0, 2.5] {
        let mut scene = scene(&mut noise);
        for linker in angular(&mut scene, rest_length, &mut noise) {
            // h = 0.01 nm and rad, torques up to 60 pN nm.
            assert_is_gradient(&linker, &scene.state, 0.01, 1e-8);
            assert_is_stiffness(&linker, &scene.state, 0.01, 1e-8);
            assert_is_balanced(&linker, &scene.state, 1e-12);
            assert_is_invariant(&linker, &scene.state, 1e-11);
            if rest_length == 0.0 {
                assert_fluctuates(&[&linker], &scene.state, 1e-12);
            }
        }
    }
}

proptest! {
    #[test]
    fn forces_and_torques_balance(seed: u64, slack in 0_usize..3) {
        let scene = scene(&mut Xorshift::new(seed));
        for linker in all(&scene, [0.0, 2.5, 40.0][slack]) {
            if let LinkerEnd::Site(_) = linker.end() {
                // Rounding of sums of about ten products; 1e-14 is exceeded in some of 20000 draws.
                assert_is_balanced(&linker, &scene.state, 1e-12);
                // Near the rest length cancellation dominates the energy.
                if slack == 0 {
                    assert_is_invariant(&linker, &scene.state, 1e-12);
                }
                continue;
            }
            let (force, torque) = resultant(&scene.state, &loads_of(&linker, &scene.state));
            let pull = linker.force(&scene.state);
            let moment = linker.end_position(&scene.state).cross(&pull);
            prop_assert!((force - pull).norm() <= 1e-14 * pull.norm());
            // Weights and arm of the site have one rounding error more than the position of the
            // anchor.
            prop_assert!((torque - moment).norm() <= 1e-13 * 60.0 * pull.norm());
        }
    }
}

#[test]
fn rod_and_monomer_sites_agree_at_the_same_point() {
    let mut noise = Xorshift::new(14);
    let mut scene = scene(&mut noise);
    let (first, second) = (scene.rod.points().start, scene.rod.points().start + 1);
    let frame = scene.rod.frames().start;
    let q = scene.state.frames.orientation.get(frame);
    let start = scene.state.points.position.get(first);
    scene
        .state
        .points
        .position
        .set(second, start + q * Vector3::z() * 10.0);
    for fraction in [0.0, 0.3, 1.0] {
        let on_rod = Site::on_rod(&scene.rod, place(0, fraction, 1.8, -2.0)).unwrap();
        let arm = on_rod.arm() + Vector3::z() * (10.0 * fraction);
        let on_monomer = Site::on_monomer(first, frame, arm).unwrap();
        let [rod, monomer] =
            [on_rod, on_monomer].map(|site| Linker::new(site, anchor(), 7.0, 1.0).unwrap());
        let state = &scene.state;
        // Rounding errors of positions of 20 nm.
        assert!((rod.site().position(state) - monomer.site().position(state)).norm() < 1e-13);
        assert!((rod.energy(state) / monomer.energy(state) - 1.0).abs() < 1e-13);
        let [(force, torque), expected] =
            [&rod, &monomer].map(|linker| resultant(state, &loads_of(linker, state)));
        assert!((force - expected.0).norm() < 1e-12 * force.norm());
        assert!((torque - expected.1).norm() < 1e-12 * torque.norm());
    }
}

#[test]
fn a_linker_pulls_by_its_extension() {
    let mut state = State::default();
    let rod = StraightRod::uniform(2, 10.0).push(&mut state).unwrap();
    let site = Site::on_rod(&rod, place(1, 0.25, 4.0, FRAC_PI_2)).unwrap();
    let end = LinkerEnd::Anchor(Anchor::fixed(Vector3::new(5.0, 4.0, 12.5)));
    let linker = Linker::new(site, end, 2.0, 2.0).unwrap();
    assert!((linker.energy(&state) - 9.0).abs() < 1e-14);
    let loads = loads_of(&linker, &state);
    let expected = [(0, 0.0), (1, 4.5), (2, 1.5)];
    for (node, force) in expected {
        assert!((loads.force.get(node) - Vector3::x() * force).norm() < 1e-14);
    }
    assert!((loads.torque.get(1) + Vector3::z() * 24.0).norm() < 1e-13);
    assert!(loads.torque.get(0).norm() == 0.0);
}

#[test]
fn limits_are_defined() {
    let scene = scene(&mut Xorshift::new(15));
    let site = scene.on_monomer(0);
    let at = site.position(&scene.state);
    let make = |shift: Vector3, rest_length| {
        let end = LinkerEnd::Anchor(Anchor::fixed(at + shift));
        Linker::new(site, end, 7.0, rest_length).unwrap()
    };
    let block = |linker: &Linker| {
        let point = 3 * scene.monomers[0].0;
        let matrix = stiffness_matrix(linker, &scene.state);
        matrix.fixed_view::<3, 3>(point, point).into_owned()
    };
    let none = make(Vector3::zeros(), 0.0);
    assert!(none.energy(&scene.state).abs() < f64::MIN_POSITIVE);
    assert_eq!(none.force(&scene.state), Vector3::zeros());
    assert_eq!(block(&none), nalgebra::Matrix3::identity() * 7.0);
    assert_is_stiffness(&none, &scene.state, 0.01, 1e-9);

    // The position of the anchor is rounded to 7e-15 nm.
    let slack = make(Vector3::x() * 2.0, 2.0);
    assert!(slack.force(&scene.state).norm() < 1e-12);
    let along = nalgebra::Matrix3::from_diagonal(&Vector3::new(7.0, 0.0, 0.0));
    assert!((block(&slack) - along).amax() < 1e-12);

    let shut = make(Vector3::zeros(), 2.0);
    assert!((shut.energy(&scene.state) - 14.0).abs() < 1e-13);
    assert_eq!(shut.force(&scene.state), Vector3::zeros());
    assert_eq!(block(&shut), nalgebra::Matrix3::identity() * -7.0);
}

#[test]
fn controls_move_an_anchor() {
    let mut scene = scene(&mut Xorshift::new(16));
    let site = scene.on_rod(1, 0.5);
    let position = site.position(&scene.state);
    scene.state.add_control(9.0);
    let anchor = Anchor::movable(&mut scene.state, position);
    let controls = anchor.controls.unwrap();
    assert!(scene.state.controls.ids().skip(1).eq(controls));
    let linker = Linker::new(site, LinkerEnd::Anchor(anchor), 7.0, 0.0).unwrap();
    assert_eq!(linker.force(&scene.state), Vector3::zeros());
    for (control, value) in controls.into_iter().zip([1.0, -2.0, 3.0]) {
        scene.state.controls[control] = value;
    }
    let expected = Vector3::new(7.0, -14.0, 21.0);
    // Rounding of the position of about 20 nm.
    assert!((linker.force(&scene.state) - expected).norm() < 1e-12);
}

#[test]
fn invalid_linkers_are_refused() {
    let scene = scene(&mut Xorshift::new(17));
    let on_rod = |segment, fraction, radius, azimuth| {
        Site::on_rod(&scene.rod, place(segment, fraction, radius, azimuth)).map(drop)
    };
    let refused = |key, value, rule| Err(LinkerError::Parameter { key, value, rule });
    let beyond = LinkerError::Segment {
        segment: 3,
        segments: 3,
    };
    assert_eq!(on_rod(3, 0.5, 1.8, 0.0), Err(beyond));
    for fraction in [-1e-9, 1.1] {
        let expected = refused(LinkerKey::Fraction, fraction, "from 0 to 1");
        assert_eq!(on_rod(0, fraction, 1.8, 0.0), expected);
    }
    let expected = refused(LinkerKey::Radius, -1.8, "finite and not negative");
    assert_eq!(on_rod(0, 0.5, -1.8, 0.0), expected);
    let infinite = f64::INFINITY;
    let expected = refused(LinkerKey::Azimuth, infinite, "finite");
    assert_eq!(on_rod(0, 0.5, 1.8, infinite), expected);
    let expected = refused(LinkerKey::Arm, infinite, "finite");
    let arm = Vector3::new(0.0, infinite, 0.0);
    assert_eq!(Site::on_monomer(0, 0, arm).map(drop), expected);

    let linker = |stiffness, rest_length, position| {
        let end = LinkerEnd::Anchor(Anchor::fixed(position));
        Linker::new(scene.on_monomer(0), end, stiffness, rest_length).map(drop)
    };
    for stiffness in [0.0, -1.0, infinite] {
        let expected = refused(LinkerKey::Stiffness, stiffness, "positive and finite");
        assert_eq!(linker(stiffness, 0.0, Vector3::zeros()), expected);
    }
    let expected = refused(LinkerKey::RestLength, -1.0, "finite and not negative");
    assert_eq!(linker(1.0, -1.0, Vector3::zeros()), expected);
    let expected = refused(LinkerKey::Anchor, infinite, "finite");
    assert_eq!(linker(1.0, 0.0, Vector3::new(infinite, 0.0, 0.0)), expected);
    assert!(on_rod(0, f64::NAN, 1.8, 0.0).is_err());
}
