//! Rods with nonlinear laws.

mod fixtures;

use crate::common;
use actin_cosserat::{
    BendLaw, BendingElement, CubicShear, EndShear, EnergyGradient, Homogenised, JoinedElement,
    PaperBalance, PolynomialStretch, Rigidities, RigidityFactors, RodLayout, RodMaterial,
    RootedStretch, SegmentCurvature, SegmentLaw, SidedTwist, Stiffening, StraightRod, StretchLaw,
    TanhTwist, TwistLaw, TwistRise, TwistStretch,
};
use actin_mechanics::testing::{
    assert_is_balanced, assert_is_gradient, assert_is_invariant, assert_is_stiffness, derivative,
    loads_of,
};
use actin_mechanics::{Interaction, State, Vector3, rotation};
use actin_mechanics::{Xorshift, perturb};
use common::{ALL_WALLS, material, rod};
use fixtures::{STIFFENING, polynomial, rooted, sided};

/// Largest twist (rad/nm) of the data of laws, above all twists of these tests.
const RANGE: f64 = 0.2;

fn wide_twist() -> TanhTwist {
    let mut law = TanhTwist::published();
    for i in [0, 1, 3, 4, 5, 6] {
        law.lambda[i] *= 4.0;
    }
    law.range *= 4.0;
    law
}

fn constant() -> RodMaterial {
    RodMaterial::new(Rigidities::table4()).unwrap()
}

fn every_law() -> RodMaterial {
    let stretch = StretchLaw::Sided {
        tension: 3.4e4,
        compression: 1.7e4,
        width: 0.1,
    };
    let shear = CubicShear {
        linear: [1e3, 2e3],
        cubic: 1e5,
    };
    constant()
        .with_twist(TwistLaw::Tanh(wide_twist()))
        .and_then(|m| m.with_bend(BendLaw::Stiffening(STIFFENING)))
        .and_then(|m| m.with_stretch(stretch))
        .and_then(|m| m.with_shear(shear))
        .unwrap()
}

fn bent_at_rest(material: RodMaterial) -> RodMaterial {
    let kappa = Vector3::new(0.02, -0.03, 0.05);
    material.with_rest_curvature(kappa).unwrap()
}

#[test]
fn softened_laws_are_multiples() {
    let mut noise = Xorshift::new(31);
    let factors = RigidityFactors {
        shear: 0.5,
        stretch: 0.5,
        bend: 0.1,
        twist: 0.1,
    };
    for (name, material, _) in laws() {
        let softer = material.softened(&factors).unwrap();
        assert_eq!(softer.rest_curvature(), material.rest_curvature());
        for _ in 0..10 {
            let (sigma, kappa) = (0.1 * noise.vector(), 0.1 * noise.vector());
            let (force, couple) = (material.shear_force(sigma), material.bending_couple(kappa));
            let miss = (softer.shear_force(sigma) - 0.5 * force).norm() / force.norm();
            assert!(miss < 1e-14, "{name}: {miss:e}");
            let miss = (softer.bending_couple(kappa) - 0.1 * couple).norm() / couple.norm();
            assert!(miss < 1e-13, "{name}: {miss:e}");
        }
    }
    for value in [0.0, -1.0, f64::NAN] {
        let wrong = RigidityFactors {
            twist: value,
            ..factors
        };
        assert!(constant().softened(&wrong).is_err());
    }
}

/// Name, material, and law of twist and stretch.
type Named = (&'static str, RodMaterial, Option<TwistStretch>);

fn laws() -> Vec<Named> {
    let twisted = constant().with_twist(TwistLaw::Tanh(wide_twist())).unwrap();
    let bent = constant()
        .with_bend(BendLaw::Stiffening(STIFFENING))
        .unwrap();
    let sided = constant()
        .with_twist(TwistLaw::Sided(sided(RANGE)))
        .unwrap();
    let linear = TwistStretch::linear(9.35e3, 3.4e4);
    let bent_at_rest = bent_at_rest(every_law());
    vec![
        ("constant", constant(), None),
        ("B3(kappa)", twisted, None),
        ("xi(kappa)", constant(), Some(polynomial(RANGE))),
        ("published extension", twisted, Some(polynomial(RANGE))),
        ("coupling energy", twisted, Some(linear)),
        ("B_perp(kappa)", bent, None),
        ("all", every_law(), Some(polynomial(RANGE))),
        ("sided twist and rooted stretch", sided, Some(rooted(RANGE))),
        ("all, bent at rest", bent_at_rest, Some(polynomial(RANGE))),
        (
            "constant, bent at rest",
            self::bent_at_rest(constant()),
            None,
        ),
    ]
}

/// Perturbation (nm, rad), step and tolerances for a law.
struct Accuracy {
    seed: u64,
    moved: [f64; 2],
    step: f64,
    gradient: f64,
    stiffness: f64,
    balance: f64,
    invariance: f64,
}

/// Truncation and round-off are below 1e-12 for steps of 0.01 nm and rad.
const OF_CONSTANTS: Accuracy = Accuracy {
    seed: 31,
    moved: [2.5, 0.5],
    step: 0.01,
    gradient: 1e-10,
    stiffness: 1e-10,
    balance: 1e-14,
    invariance: 1e-13,
};

/// Laws vary over 0.3 rad per element: truncation below 1e-9.
const OF_LAWS: Accuracy = Accuracy {
    step: 0.003,
    gradient: 1e-9,
    stiffness: 1e-8,
    balance: 1e-13,
    invariance: 1e-12,
    ..OF_CONSTANTS
};

/// Small steps, because the third derivative is discontinuous at the onset of compression.
const OF_POTENTIALS: Accuracy = Accuracy {
    seed: 42,
    moved: [0.05, 0.1],
    step: 1e-4,
    gradient: 1e-7,
    stiffness: 1e-6,
    balance: 1e-12,
    invariance: 1e-11,
};

fn all() -> Vec<(Named, Accuracy)> {
    let potential = RodMaterial::homogenised(Homogenised::mean_filament());
    let laws = laws().into_iter().map(|law| (law, OF_LAWS));
    let others = [
        (("different constants", material(), None), OF_CONSTANTS),
        (("potential", potential, None), OF_POTENTIALS),
    ];
    laws.chain(others).collect()
}

/// Rod under a law. With coupling, both ends are joined to neighbouring rods; for potentials the
/// start blocks shear and the end is loose.
fn rod_of(layout: RodLayout, material: RodMaterial, law: Option<TwistStretch>) -> EnergyGradient {
    let joined = |frames, rest_distance| JoinedElement {
        frames,
        element: BendingElement { rest_distance },
        curvature_difference: Vector3::zeros(),
    };
    let frames = layout.frames();
    let start = joined([0, frames.start], 6.0);
    let end = joined([frames.end - 1, layout.bending_chain().end], 8.0);
    let mut curvature = SegmentCurvature::new(&layout, &[start], &[end]);
    if material.potential().is_some() {
        let ends = [EndShear::Blocked, EndShear::Loose];
        curvature = curvature.with_ends(&layout, ends, [0.0; 2]);
    }
    let rod = EnergyGradient::new(layout, material);
    match SegmentLaw::from_material(&material, law) {
        Some(law) => rod.with_extension(law, curvature),
        None => rod,
    }
}

fn rods(
    (_, material, law): &Named,
    accuracy: &Accuracy,
    segments: usize,
    noise: &mut Xorshift,
) -> Vec<(State, EnergyGradient)> {
    let each = ALL_WALLS.into_iter().flat_map(|walls| {
        let (mut state, layout) = rod(segments, walls, noise);
        let [shift, turn] = accuracy.moved;
        perturb(&mut state, noise, shift, turn);
        let alone = EnergyGradient::new(layout.clone(), *material);
        [
            (state.clone(), alone),
            (state, rod_of(layout, *material, *law)),
        ]
    });
    each.collect()
}

/// Checks every law on rods with these numbers of segments.
fn check_every_law(segments: &[usize], check: impl Fn(&EnergyGradient, &State, &Accuracy)) {
    for (law, accuracy) in all() {
        let mut noise = Xorshift::new(accuracy.seed);
        for &segments in segments {
            for (state, rod) in rods(&law, &accuracy, segments, &mut noise) {
                println!("{}, {segments} segments, {:?}", law.0, rod.layout());
                check(&rod, &state, &accuracy);
            }
        }
    }
}

#[test]
fn every_law_is_a_gradient_far_from_rest() {
    check_every_law(&[1, 2, 5], |rod, state, accuracy| {
        assert_is_gradient(rod, state, accuracy.step, accuracy.gradient);
    });
}

#[test]
fn every_law_has_its_stiffness() {
    check_every_law(&[1, 3], |rod, state, accuracy| {
        assert_is_stiffness(rod, state, accuracy.step, accuracy.stiffness);
    });
}

#[test]
fn every_law_is_balanced_and_invariant() {
    check_every_law(&[1, 2, 3, 4, 5, 6, 7, 8], |rod, state, accuracy| {
        assert_is_balanced(rod, state, accuracy.balance);
        assert_is_invariant(rod, state, accuracy.invariance);
    });
}

/// Straight free rod of ten segments of 10 nm with twist `k` (rad/nm) and uniform extension, under
/// published laws.
fn uniform(k: f64, extension: f64) -> (State, EnergyGradient) {
    let mut state = State::default();
    let layout = StraightRod::uniform(10, 10.0).push(&mut state).unwrap();
    for i in layout.points() {
        let rest = state.points.position.get(i);
        state.points.position.set(i, rest * extension);
    }
    for i in layout.frames() {
        let turn = rotation::exp(Vector3::z() * (10.0 * k * i as f64));
        state.frames.orientation.set(i, turn);
    }
    let twist = TwistLaw::Tanh(TanhTwist::published());
    let material = constant().with_twist(twist).unwrap();
    let law = SegmentLaw::from_material(&material, Some(TwistStretch::published())).unwrap();
    let curvature = SegmentCurvature::new(&layout, &[], &[]);
    let rod = EnergyGradient::new(layout, material).with_extension(law, curvature);
    (state, rod)
}

#[test]
fn uniform_twist_has_its_length_and_couple() {
    for k in [-0.06, -0.0462, -0.01, 0.002, 0.02, 0.0462, 0.08] {
        let xi = 1.0 + TwistStretch::published().extension(k);
        let (state, rod) = uniform(k, xi);
        let loads = loads_of(&rod, &state);
        for i in rod.layout().points() {
            // Compared with S3 = 3.4e4 pN.
            assert!(loads.force.get(i).norm() < 1e-9, "{k}, node {i}");
        }
        let couple = TanhTwist::published().secant(k) * k;
        for i in 0..10 {
            let expected = if i == 0 { couple } else { 0.0 } - if i == 9 { couple } else { 0.0 };
            let torque = loads.torque.get(i) - Vector3::z() * expected;
            assert!(torque.norm() < 1e-9, "{k}, frame {i}: {torque}");
        }
    }
}

/// Maxwell-Betti reciprocity.
#[test]
fn force_and_couple_are_reciprocal() {
    let k = 0.02;
    let couple = |e: f64| {
        let (state, rod) = uniform(k, 1.0 + e);
        let end = rod.layout().frames().end - 1;
        let loads = loads_of(&rod, &state);
        -(0..=end)
            .map(|i| loads.torque.get(i).z * i as f64)
            .sum::<f64>()
            * 10.0
    };
    let force = |k: f64| {
        let (state, rod) = uniform(k, 1.0);
        let end = rod.layout().points().end - 1;
        -loads_of(&rod, &state).force.get(end).z
    };
    let of_stretch = derivative(1e-4, couple);
    let of_twist = derivative(1e-4, |h| force(k + h)) * 100.0;
    assert!(of_stretch.abs() > 1e4, "nothing couples: {of_stretch}");
    assert!(
        (of_stretch / of_twist - 1.0).abs() < 1e-9,
        "{of_stretch} {of_twist}"
    );
}

#[test]
fn coupling_energy_is_the_printed_product() {
    let (c3, s3, b3) = (9.35e3, 3.4e4, 1.3e4);
    let (k, e) = (0.01, 0.002);
    let (state, rod) = uniform(k, 1.0 + e);
    let layout = rod.layout().clone();
    let law = SegmentLaw::from_material(&constant(), Some(TwistStretch::linear(c3, s3))).unwrap();
    let curvature = SegmentCurvature::new(&layout, &[], &[]);
    let rod = EnergyGradient::new(layout, constant()).with_extension(law, curvature);
    let mut energies = vec![0.0; rod.elements()];
    rod.write_energies(&state, &mut energies);
    let expected = 10.0 * (0.5 * s3 * e * e + c3 * e * k + 0.5 * (b3 + c3 * c3 / s3) * k * k);
    assert!((energies[4] + energies[13] - expected).abs() < 1e-12 * expected);
}

#[test]
fn only_the_printed_balance_does_work_around_a_cycle() {
    let around = |gradient: bool| {
        let steps = 400;
        let work = |i: usize| {
            let angle = std::f64::consts::TAU * (i as f64 + 0.5) / steps as f64;
            let (k, e) = (0.02 + 0.005 * angle.sin(), 0.01 * angle.cos());
            let (dk, de) = (0.005 * angle.cos(), -0.01 * angle.sin());
            let (state, rod) = uniform(k, 1.0 + e);
            let layout = rod.layout().clone();
            let loads = if gradient {
                loads_of(&rod, &state)
            } else {
                let curvature = SegmentCurvature::new(&layout, &[], &[]);
                let law = TwistStretch::published();
                let rod = PaperBalance::new(layout, *rod.material()).unwrap();
                let rod = rod.with_extension(law, curvature);
                loads_of(&rod, &state)
            };
            let turning = (0..10).map(|i| loads.torque.get(i).z * 10.0 * i as f64 * dk);
            let moving = (0..11).map(|i| loads.force.get(i).z * 10.0 * i as f64 * de);
            let rate: f64 = turning.chain(moving).sum();
            rate * std::f64::consts::TAU / steps as f64
        };
        (0..steps).map(work).sum::<f64>()
    };
    let (gradient, printed) = (around(true), around(false));
    println!("work around the cycle: gradient {gradient:.3e} pN nm, printed {printed:.3e} pN nm");
    // The midpoint rule is exact to round-off for a smooth cycle; the energy is about 500 pN nm.
    assert!(gradient.abs() < 1e-9, "{gradient}");
    assert!((printed - 421.0).abs() < 1.0, "{printed}");
}
