//! How warm long waves are in long steps: the mean of `1 - cos` of the angle between segments of a free rod, over its
//! exact value, with friction along that differs from friction across.
//!
//! `cargo run --release -p actin-brownian --example long_waves -- 12 300 1000000 1 1.5 2.8`: segments of 40 nm,
//! step (ns), steps, seed, friction along and across (pN ns/nm^2).

#[path = "../tests/common/mod.rs"]
mod common;

use actin_brownian::mechanics::{Vector3, rotation};
use common::{advance, free_rod_with, friction_with, rigidities};

const SEGMENT: f64 = 40.0;
const KT: f64 = 4.11;
const BLOCKS: u64 = 20;
/// Segments between those that are compared.
const SPANS: [(usize, i32); 5] = [(1, 1), (2, 2), (5, 5), (10, 10), (20, 20)];

fn main() {
    let mut arguments = std::env::args().skip(1);
    let mut next = || arguments.next().expect("six arguments");
    let segments: usize = next().parse().expect("segments");
    let h: f64 = next().parse().expect("a step in ns");
    let steps: u64 = next().parse().expect("steps");
    let seed: u64 = next().parse().expect("a seed");
    let [along, across] = [(); 2].map(|()| next().parse().expect("a friction"));

    let friction = |rod: &_| friction_with(rod, [along, across, 150.0, 40.0]);
    let length = SEGMENT * segments as f64;
    let (mut system, mut stepper, rod) = free_rod_with(segments, length, (KT, seed), friction);
    let spans: Vec<_> = SPANS.into_iter().filter(|s| s.0 < segments).collect();
    let mut means = vec![Vec::new(); spans.len()];
    let warm = steps / 50;
    let each = steps / BLOCKS;
    advance(&mut system, &mut stepper, (0, warm), h, |_| ());
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
                for (sum, (span, _)) in sums.iter_mut().zip(&spans) {
                    let pairs = segments - span;
                    let cos: f64 = (0..pairs).map(|k| axis(k).dot(&axis(k + span))).sum();
                    *sum += 1.0 - cos / pairs as f64;
                }
            },
        );
        let sums = means.iter_mut().zip(sums);
        sums.for_each(|(means, sum)| means.push(sum / each as f64));
    }
    print(&means, &spans);
    let iterations = stepper.iterations() as f64 / (steps + warm) as f64;
    println!("{iterations:.2} iterations per step");
}

/// Prints the means of blocks over the exact values.
fn print(means: &[Vec<f64>], spans: &[(usize, i32)]) {
    let joint = rigidities().bend / (SEGMENT * KT);
    let cosine = mean_cosine(joint.x, joint.z);
    for (values, &(span, power)) in means.iter().zip(spans) {
        let (mean, error) = mean_and_error(values);
        let exact = 1.0 - cosine.powi(power);
        let (nm, ratio, error) = (SEGMENT * span as f64, mean / exact, error / exact);
        println!("over {nm:4.0} nm: {ratio:.4} +- {error:.4} of the exact value");
    }
}

/// The mean of independent values and its standard error.
fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, (squares / (n - 1.0) / n).sqrt())
}

/// The mean cosine of a joint's bend, turns `theta` of the weight `exp(-(a (x^2 + y^2) + b z^2) / 2)`, by the midpoint rule.
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
