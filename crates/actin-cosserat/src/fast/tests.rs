//! Comparison of the vector kernels with the scalar path for each number of lanes.

mod collapsed;
#[path = "../../tests/integration/laws/fixtures.rs"]
mod fixtures;

use super::*;
use crate::{
    BendLaw, BendingElement, CubicShear, EndShear, EnergyGradient, Homogenised, JoinedElement,
    PolynomialStretch, Rigidities, RootedStretch, SegmentCurvature, SegmentLaw, SidedTwist,
    Stiffening, StraightRod, StretchLaw, TanhTwist, TwistLaw, TwistRise, TwistStretch, Walls,
};
use actin_mechanics::testing::{architectures, assert_same_with_any_lanes};
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use actin_mechanics::{Xorshift, perturb};
use fixtures::{STIFFENING, polynomial, rooted, sided};

fn material() -> RodMaterial {
    RodMaterial::new(Rigidities {
        shear: Vector3::new(1.6e4, 2.1e4, 3.4e4),
        bend: Vector3::new(3.9e4, 2.7e4, 1.3e4),
    })
    .unwrap()
}

/// Ranges that some twists exceed.
const SIDED: TwistLaw = TwistLaw::Sided(sided(0.06));
const ROOTED: TwistStretch = rooted(0.07);
const SHEAR: CubicShear = CubicShear {
    linear: [1e3, 2e3],
    cubic: 1e6,
};

/// Name, material, and law of twist and stretch.
type Named = (&'static str, RodMaterial, Option<TwistStretch>);

fn potential() -> RodMaterial {
    RodMaterial::homogenised(Homogenised::mean_filament())
}

fn heated() -> RodMaterial {
    RodMaterial::homogenised(Homogenised::heated_rod(10.0, 298.0).expect("10 nm is in range"))
}

fn laws() -> Vec<Named> {
    let constant = material();
    let tanh = (constant.with_twist(TwistLaw::Tanh(TanhTwist::published()))).unwrap();
    let sided = constant.with_twist(SIDED).unwrap();
    let bent = constant.with_bend(BendLaw::Stiffening(STIFFENING)).unwrap();
    let straight = sided.with_bend(BendLaw::Stiffening(STIFFENING)).unwrap();
    let sheared = straight.with_shear(SHEAR).unwrap();
    let slender = constant.with_shear(SHEAR).unwrap();
    let powers = polynomial(0.07);
    vec![
        ("constant", constant, None),
        ("published", tanh, Some(TwistStretch::published())),
        ("published", tanh, Some(powers)),
        ("published", tanh, None),
        ("published", tanh, Some(TwistStretch::linear(9e3, 3.4e4))),
        ("published", constant, Some(TwistStretch::published())),
        ("published", constant, Some(powers)),
        (
            "published",
            constant,
            Some(TwistStretch::linear(9e3, 3.4e4)),
        ),
        ("fitted", sheared, Some(ROOTED)),
        ("fitted", sheared, None),
        ("fitted", slender, None),
        ("fitted", slender, Some(ROOTED)),
        ("fitted, linear shear", straight, Some(ROOTED)),
        ("fitted, linear shear", bent, None),
        ("fitted, linear shear", sided, None),
        ("fitted, linear shear", constant, Some(ROOTED)),
        ("potential", potential(), None),
        ("potential", heated(), None),
    ]
}

/// Laws with rest curvature, for which missing elements must be masked.
fn bent() -> [Named; 2] {
    let kappa = Vector3::new(0.02, -0.01, 0.03);
    [kappa, kappa * 30.0].map(|kappa| {
        let material = material().with_rest_curvature(kappa).unwrap();
        ("bent", material, None)
    })
}

fn rod(segments: usize, walls: Walls, noise: &mut Xorshift) -> (State, RodLayout) {
    let mut state = State::default();
    let neighbour = StraightRod::uniform(1, 10.0);
    neighbour.push(&mut state).unwrap();
    let rod = StraightRod {
        start: noise.vector(),
        orientation: rotation::exp(noise.vector()),
        segment_lengths: (0..segments).map(|_| 10.0 + 4.0 * noise.sample()).collect(),
        walls,
        ..StraightRod::uniform(0, 0.0)
    };
    let layout = rod.push(&mut state).unwrap();
    neighbour.push(&mut state).unwrap();
    neighbour.push(&mut state).unwrap();
    (state, layout)
}

fn all_walls() -> [Walls; 4] {
    [(false, false), (true, false), (false, true), (true, true)]
        .map(|(start, end)| Walls { start, end })
}

fn joined(layout: &RodLayout, any: bool) -> [Vec<JoinedElement>; 2] {
    let element = |frames, rest_distance| JoinedElement {
        frames,
        element: BendingElement { rest_distance },
        curvature_difference: Vector3::new(2e-3, -1e-3, 5e-3),
    };
    let (frames, after) = (layout.frames(), layout.bending_chain().end);
    let start = vec![element([0, frames.start], 6.0)];
    let end = vec![
        element([frames.end - 1, after], 8.0),
        element([frames.end - 1, after + 1], 9.0),
    ];
    if any { [start, end] } else { [vec![], vec![]] }
}

fn extended(layout: &RodLayout, law: &Named, is_joined: bool) -> Option<ExtendedSegments> {
    let [start, end] = joined(layout, is_joined);
    let mut curvature = SegmentCurvature::new(layout, &start, &end);
    if law.1.potential().is_some() {
        curvature = curvature.with_ends(layout, [EndShear::Loose, EndShear::Blocked], [0.0; 2]);
    }
    SegmentLaw::from_material(&law.1, law.2).map(|law| ExtendedSegments { law, curvature })
}

fn add_reference(
    (layout, law): (&RodLayout, &Named),
    extended: Option<&ExtendedSegments>,
    state: &State,
    loads: &mut Loads,
) {
    let rod = EnergyGradient::new(layout.clone(), law.1);
    match extended.cloned() {
        None => rod.add_scalar_loads(state, loads),
        Some(ExtendedSegments { law, curvature }) => {
            (rod.with_extension(law, curvature)).add_scalar_loads(state, loads);
        }
    }
}

fn fast(layout: &RodLayout, law: &Named, extended: Option<&ExtendedSegments>) -> FastRod {
    FastRod::new(layout, &law.1, extended).expect("use a law with a kernel")
}

fn compare(a: &Loads, b: &Loads) -> (f64, f64) {
    let pairs = (a.force.iter().zip(b.force.iter())).chain(a.torque.iter().zip(b.torque.iter()));
    pairs.fold((0.0, 0.0), |(difference, largest), (a, b)| {
        let distance = (a - b).norm();
        assert!(!distance.is_nan());
        (f64::max(difference, distance), f64::max(largest, b.norm()))
    })
}

fn noisy_loads(state: &State, noise: &mut Xorshift) -> Loads {
    let mut loads = Loads::zeros(state);
    for i in 0..loads.force.len() {
        loads.force.set(i, noise.vector());
    }
    for i in 0..loads.torque.len() {
        loads.torque.set(i, noise.vector());
    }
    loads
}

/// Asserts that both paths agree to 1e-13 of the largest load, or of `scale` if larger.
fn assert_paths_agree(
    (state, layout): (&State, &RodLayout),
    law: &Named,
    is_joined: bool,
    scale: f64,
) {
    let extended = extended(layout, law, is_joined);
    let mut expected = noisy_loads(state, &mut Xorshift::new(2));
    let start = expected.clone();
    add_reference((layout, law), extended.as_ref(), state, &mut expected);
    let rod = fast(layout, law, extended.as_ref());
    for arch in architectures() {
        let mut loads = start.clone();
        rod.add_loads_on(arch, layout, state, &mut loads);
        let (difference, largest) = compare(&loads, &expected);
        let relative = difference / largest.max(scale);
        let (name, segments) = (law.0, layout.segments());
        assert!(
            relative < 1e-13,
            "{name}, {segments} segments: {relative:e}"
        );
    }
}

#[test]
fn loads_are_those_of_the_scalar_path() {
    let mut noise = Xorshift::new(1);
    for law in laws().iter().chain(&bent()) {
        for segments in (1..=9).chain([12, 15, 16, 17, 64]) {
            for walls in all_walls() {
                for (angle, is_joined) in [(0.01, false), (0.3, true), (1.0, false), (1.8, true)] {
                    let (mut state, layout) = rod(segments, walls, &mut noise);
                    perturb(&mut state, &mut noise, 0.5, angle);
                    flip_some(&mut state);
                    assert_paths_agree((&state, &layout), law, is_joined, 0.0);
                }
            }
        }
    }
}

#[test]
fn loads_are_the_same_with_any_number_of_lanes() {
    let mut noise = Xorshift::new(11);
    for law in laws().iter().chain(&bent()) {
        for (segments, angle) in [(1, 0.3), (9, 0.3), (31, 0.01), (64, 0.2), (65, 1.8)] {
            let walls = all_walls()[segments % 4];
            let (mut state, layout) = rod(segments, walls, &mut noise);
            perturb(&mut state, &mut noise, 0.5, angle);
            let extended = extended(&layout, law, true);
            let rod = fast(&layout, law, extended.as_ref());
            assert_same_with_any_lanes(|arch| {
                let mut loads = Loads::zeros(&state);
                rod.add_loads_on(arch, &layout, &state, &mut loads);
                let (f, t) = (loads.force, loads.torque);
                [f.x, f.y, f.z, t.x, t.y, t.z].concat()
            });
        }
    }
}

#[test]
fn loads_of_smooth_rods_are_those_of_the_scalar_path() {
    let mut noise = Xorshift::new(5);
    for law in laws().iter().chain(&bent()) {
        for angle in [1e-3, 1e-5] {
            let walls = Walls {
                start: true,
                end: false,
            };
            let (mut state, layout) = rod(30, walls, &mut noise);
            perturb(&mut state, &mut noise, angle, angle);
            // Strains are accurate to about 1e-15: at 3.4e4 pN over 14 nm, 1e-13 of this torque.
            assert_paths_agree((&state, &layout), law, true, 1e-2 * 3.4e4 * 14.0);
        }
    }
}

fn flip_some(state: &mut State) {
    for i in (0..state.frames.len()).step_by(3) {
        let q = state.frames.orientation.get(i);
        let negative = nalgebra::Unit::new_unchecked(-q.into_inner());
        state.frames.orientation.set(i, negative);
    }
}

fn fast_loads(state: &State, layout: &RodLayout, law: &Named) -> Loads {
    let extended = extended(layout, law, false);
    let mut loads = Loads::zeros(state);
    fast(layout, law, extended.as_ref()).add_loads(layout, state, &mut loads);
    loads
}

/// Lanes after the end must not contribute. Laws with a stretch at rest are skipped.
#[test]
fn a_rod_at_rest_has_no_loads() {
    let without_offset = |law: &TwistStretch| law.extension(0.0) == 0.0;
    for law in &laws() {
        let is_at_rest = |potential: &Homogenised| potential.form().rest() == 0.0;
        if !law.2.as_ref().is_none_or(without_offset) || !law.1.potential().is_none_or(is_at_rest) {
            continue;
        }
        for segments in 1..10 {
            let mut state = State::default();
            let layout = StraightRod::uniform(segments, 8.0)
                .push(&mut state)
                .unwrap();
            let loads = fast_loads(&state, &layout, law);
            assert!(compare(&loads, &Loads::zeros(&state)).0 == 0.0, "{}", law.0);
        }
    }
}

#[test]
fn the_smallest_angles_have_torques() {
    for angle in [5e-324, 1e-310, 1e-200, 1e-20] {
        let mut state = State::default();
        let layout = StraightRod::uniform(2, 10.0).push(&mut state).unwrap();
        let half = nalgebra::Quaternion::new(1.0, angle, 0.0, 0.0);
        let turned = UnitQuaternion::new_unchecked(half);
        state.frames.orientation.set(1, turned);
        let loads = fast_loads(&state, &layout, &laws()[0]);
        let expected = 3.9e4 * (0.1 * (2.0 * angle));
        // The smallest number is rounded in the division by the length.
        let couple = loads.torque.get(0).x;
        assert!(
            (couple - expected).abs() <= 1e-15 * expected + 2e-320,
            "{couple:e}"
        );
    }
}

#[test]
fn an_invalid_node_affects_its_neighbours_only() {
    for law in &laws() {
        let (mut state, layout) = rod(14, Walls::default(), &mut Xorshift::new(9));
        let broken = layout.points().start + 6;
        state.points.position.x[broken] = f64::NAN;
        let loads = fast_loads(&state, &layout, law);
        for (i, force) in loads.force.iter().enumerate() {
            let near = i.abs_diff(broken) <= 1;
            assert_eq!(force.iter().any(|f| f.is_nan()), near, "node {i}");
        }
        // Frames of the segments 5 and 6 next to the node.
        let first = layout.frames().start + 5;
        for (i, torque) in loads.torque.iter().enumerate() {
            let near = (first - 1..=first + 2).contains(&i);
            assert!(near || !torque.iter().any(|t| t.is_nan()), "frame {i}");
        }
    }
}

fn kind_of(law: &Named) -> Option<&'static str> {
    let (_, layout) = rod(3, Walls::default(), &mut Xorshift::new(9));
    let extended = extended(&layout, law, true);
    let rod = FastRod::new(&layout, &law.1, extended.as_ref())?;
    Some(match rod.0 {
        Kind::Constant(_) => "constant",
        Kind::Bent(_) => "bent",
        Kind::Published(_) => "published",
        Kind::Fitted(_) => "fitted",
        Kind::FittedLinearShear(_) => "fitted, linear shear",
        Kind::Potential(_) => "potential",
    })
}

#[test]
fn every_law_has_its_kernel() {
    for law in laws().iter().chain(&bent()) {
        assert_eq!(kind_of(law), Some(law.0));
    }
}

#[test]
fn other_laws_keep_the_scalar_path() {
    let constant = material();
    let two_sided = StretchLaw::Sided {
        tension: 3.4e4,
        compression: 1.7e4,
        width: 1e-3,
    };
    let stretched = constant.with_stretch(two_sided).unwrap();
    let with_tanh = |other: RodMaterial| {
        other
            .with_twist(TwistLaw::Tanh(TanhTwist::published()))
            .unwrap()
    };
    let bent = constant.with_bend(BendLaw::Stiffening(STIFFENING)).unwrap();
    let sheared = constant.with_shear(SHEAR).unwrap();
    let polynomial = Some(TwistStretch::published());
    for (material, xi) in [
        (stretched, None),
        (with_tanh(bent), None),
        (with_tanh(sheared), None),
        (with_tanh(constant), Some(ROOTED)),
        (bent, polynomial),
        (sheared, polynomial),
        (constant.with_twist(SIDED).unwrap(), polynomial),
    ] {
        assert_eq!(kind_of(&("", material, xi)), None);
    }
}

#[test]
fn rods_joined_to_many_others_keep_the_scalar_path() {
    let (_, layout) = rod(3, Walls::default(), &mut Xorshift::new(9));
    let [_, end] = joined(&layout, true);
    let has_loop = |count: usize| {
        let end: Vec<_> = end.iter().cycle().take(count).copied().collect();
        let law = SegmentLaw::from_material(&material(), Some(ROOTED)).unwrap();
        let curvature = SegmentCurvature::new(&layout, &[], &end);
        let segments = ExtendedSegments { law, curvature };
        FastRod::new(&layout, &material(), Some(&segments)).is_some()
    };
    assert!(has_loop(8));
    assert!(!has_loop(9));
}
