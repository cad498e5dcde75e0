//! Bending energy in long steps: mean of `1 - cos` of the angle between segments of a free rod,
//! over its exact value.

use crate::common;
use actin_brownian::mechanics::{Vector3, rotation};
use common::{
    FRICTION, FrictionPerLength, advance, free_rod, free_rod_with, mean_and_error, rigidities,
};

const KT: f64 = 4.11;
const BLOCKS: u64 = 20;

/// Means of `1 - cos` over spans of segments and their standard errors, relative to the exact
/// values. The rod has `segments` of a length (nm).
fn warmth((segments, segment): (usize, f64), h: f64, steps: u64, spans: &[u16]) -> Vec<(f64, f64)> {
    warmth_with(FRICTION, (segments, segment), (h, steps), spans)
}

fn warmth_with(
    friction: FrictionPerLength,
    (segments, segment): (usize, f64),
    (h, steps): (f64, u64),
    spans: &[u16],
) -> Vec<(f64, f64)> {
    let rod = (segments, segment * segments as f64);
    let (mut system, mut stepper, rod) = free_rod_with(friction, rod, (KT, 1), |_, _| Vec::new());
    let (warm, each) = (steps / 50, steps / BLOCKS);
    advance(&mut system, &mut stepper, (0, warm), h, |_| ());
    let mut means = vec![Vec::new(); spans.len()];
    for block in 0..BLOCKS {
        let mut sums = vec![0.0; spans.len()];
        let first = warm + block * each;
        advance(
            &mut system,
            &mut stepper,
            (first, first + each),
            h,
            |system| {
                let q = &system.state().frames.orientation;
                let axis = |k: usize| q.get(rod.frames().start + k) * Vector3::z();
                for (sum, &span) in sums.iter_mut().zip(spans) {
                    let pairs = segments - usize::from(span);
                    let cos: f64 = (0..pairs)
                        .map(|k| axis(k).dot(&axis(k + usize::from(span))))
                        .sum();
                    *sum += 1.0 - cos / pairs as f64;
                }
            },
        );
        let sums = means.iter_mut().zip(sums);
        sums.for_each(|(means, sum)| means.push(sum / each as f64));
    }
    let joint = rigidities().bend / (segment * KT);
    let cosine = mean_cosine(joint.x, joint.z);
    let exact = spans.iter().map(|&span| 1.0 - cosine.powi(i32::from(span)));
    let found = means.iter().map(|means| mean_and_error(means)).zip(exact);
    found
        .map(|((mean, error), exact)| (mean / exact, error / exact))
        .collect()
}

/// The joint relaxes ten times within a step. Torques of the stress about the frame axes would add
/// 12 % to its energy.
#[test]
fn bending_energy_of_a_joint_is_exact() {
    let found = warmth((2, 100.0), 4000.0, 20_000, &[1]);
    println!("{found:?}");
    assert!((found[0].0 - 1.0).abs() < 0.03, "{found:?}");
}

/// Prints the table of the module documentation of `stepper`. The error between neighbours is at most 1 % for segments
/// below a fiftieth of the persistence length; for longer ones it is at most 0.6 times this ratio.
#[test]
#[ignore = "takes seven minutes"]
fn accuracy_of_long_steps() {
    let cases = [
        (12_u16, 40.0, 100.0),
        (12, 40.0, 300.0),
        (12, 40.0, 1000.0),
        (25, 40.0, 300.0),
        (25, 40.0, 1389.0),
        (12, 100.0, 4000.0),
        (2, 400.0, 1.84e6),
        (12, 400.0, 1.84e6),
        (12, 400.0, 6.1e4),
        (2, 1000.0, 7.2e7),
        (12, 1000.0, 7.2e7),
        (12, 1000.0, 2.4e6),
    ];
    for (segments, segment, h) in cases {
        let span = (segments - 1).min(10);
        let found = warmth((segments.into(), segment), h, 400_000, &[1, span]);
        let rows = found
            .iter()
            .map(|(mean, error)| format!("{mean:.4} +- {error:.4}"));
        let rows = rows.collect::<Vec<_>>().join(" | ");
        println!("| {segments} of {segment} nm | {h} | {rows} |");
        let ratio = segment * KT / rigidities().bend.x;
        let bound = (0.6 * ratio).max(0.01) + 3.0 * found[0].1;
        assert!((found[0].0 - 1.0).abs() < bound, "{found:?}");
    }
}

/// Two segments in steps that resolve bending, but neither stretch nor twist. For isotropic friction,
/// the derivatives of the two stretches and of the twist give the factor
/// `sqrt(1 - 0.36 cos^2) (angle/2) / tan(angle/2)` of the density.
#[test]
#[ignore = "takes a minute"]
fn stretch_and_twist_are_rigid_in_long_steps() {
    let [_, across, about, _] = FRICTION;
    let segment = 1000.0;
    let friction = [across, across, about, 0.0];
    let found = warmth_with(friction, (2, segment), (2e5, 4_000_000), &[1]);
    let stiffness = rigidities().bend.x / (segment * KT);
    let mean = |factor: fn(f64) -> f64| {
        let angles = (1..600).map(|k| 0.005 * f64::from(k));
        let (sum, weight) = angles.fold((0.0, 0.0), |(sum, weight), angle| {
            let elastic = angle.sin() * (-0.5 * stiffness * angle * angle).exp();
            let w = elastic * factor(angle);
            (sum + w * (1.0 - angle.cos()), weight + w)
        });
        sum / weight
    };
    let rigid = mean(|angle| {
        let stretch = (1.0 - 0.36 * angle.cos().powi(2)).sqrt();
        stretch * 0.5 * angle / (0.5 * angle).tan()
    }) / mean(|_| 1.0);
    let (found, error) = found[0];
    println!("{found:.4} +- {error:.4}, rigid: {rigid:.4}");
    assert!((found - rigid).abs() < 3.0 * error + 0.004);
    assert!((found - 1.0).abs() > 3.0 * error);
}

/// Rods of long segments spin by ten turns in a step of the relaxation time of a segment.
#[test]
fn coarse_rods_need_few_iterations() {
    let h = 7.2e7;
    let (mut system, mut stepper, _) = free_rod(12, 12_000.0, (KT, 3), |_, _| Vec::new());
    let steps = 300;
    advance(&mut system, &mut stepper, (0, steps), h, |_| ());
    assert!(stepper.iterations() < 7 * steps, "{}", stepper.iterations());
}

/// Mean cosine of the bend angle of a joint for rotations with the weight
/// `exp(-(a (x^2 + y^2) + b z^2) / 2)`.
fn mean_cosine(a: f64, b: f64) -> f64 {
    const N: i32 = 40;
    let (mut sum, mut weight) = (0.0, 0.0);
    let width = 6.0 / f64::from(N);
    let at = |k: i32| (f64::from(k) + 0.5) * width;
    for (i, j, k) in
        (-N..N).flat_map(|i| (-N..N).flat_map(move |j| (-N..N).map(move |k| (i, j, k))))
    {
        let unit = Vector3::new(at(i), at(j), at(k));
        let theta = unit.component_div(&Vector3::new(a, a, b).map(f64::sqrt));
        let half = 0.5 * theta.norm();
        let w = (-0.5 * unit.norm_squared()).exp() * (half.sin() / half).powi(2);
        sum += w * (rotation::exp(theta) * Vector3::z()).z;
        weight += w;
    }
    sum / weight
}
