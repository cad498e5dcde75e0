use crate::common;
use actin_brownian::mechanics::{PointLoad, Vector3, rotation};
use common::{advance, free_rod, mean_and_error, rigidities, tip};

const KT: f64 = 4.11;
const BLOCKS: u64 = 20;
/// Numbers of Legendre polynomials and of quadrature points.
const DEGREES: usize = 120;
const PLACES: usize = 200;

/// Chain of segments of a length (nm) under an end force (pN).
#[derive(Clone, Copy)]
struct Chain {
    segments: usize,
    length: f64,
    force: f64,
}

impl Chain {
    fn contour(&self) -> f64 {
        self.length * self.segments as f64
    }

    /// Mean extension along the force, in blocks of steps of `h` (ns).
    fn run(&self, h: f64, steps: u64) -> Vec<f64> {
        let (mut system, mut stepper, rod) =
            free_rod(self.segments, self.contour(), (KT, 1), |state, rod| {
                let control = state.add_control(1.0);
                let ends = vec![(tip(rod), 1.0), (rod.points().start, -1.0)];
                let force = Vector3::z() * self.force;
                vec![Box::new(
                    PointLoad::new(state, ends, force, control).unwrap(),
                )]
            });
        let (warm, each) = (steps / 20, steps / BLOCKS);
        advance(&mut system, &mut stepper, (0, warm), h, |_| ());
        let of_block = |block: u64| {
            let first = warm + block * each;
            let mut extension = 0.0;
            let steps = (first, first + each);
            advance(&mut system, &mut stepper, steps, h, |system| {
                let x = &system.state().points.position;
                extension += (x.get(tip(&rod)) - x.get(rod.points().start)).z;
            });
            extension / each as f64
        };
        (0..BLOCKS).map(of_block).collect()
    }

    fn extension(&self) -> f64 {
        let joints = self.joint_moments();
        let df = 1e-3 * self.force;
        let logs = [-df, df].map(|d| self.log_partition(self.force + d, &joints));
        KT * (logs[1] - logs[0]) / (2.0 * df)
    }

    fn joint_moments(&self) -> Vec<f64> {
        const N: i32 = 30;
        let bend = rigidities().bend / (self.length * KT);
        assert!((bend.x - bend.y).abs() < 1e-12 * bend.x);
        let (mut sums, mut weight) = (vec![0.0; DEGREES], 0.0);
        let width = 6.0 / f64::from(N);
        let at = |k: i32| (f64::from(k) + 0.5) * width;
        for (i, j) in (0..N).flat_map(|i| (-N..N).map(move |j| (i, j))) {
            // Polar coordinates of the two bends.
            let unit = Vector3::new(at(i), 0.0, at(j));
            let theta = unit.component_div(&Vector3::new(bend.x, bend.y, bend.z).map(f64::sqrt));
            let half = 0.5 * theta.norm();
            let w = (-0.5 * unit.norm_squared()).exp() * (half.sin() / half).powi(2) * unit.x;
            let cosine = (rotation::exp(theta) * Vector3::z()).z;
            for (sum, p) in sums.iter_mut().zip(legendre(cosine)) {
                *sum += w * p;
            }
            weight += w;
        }
        sums.iter().map(|sum| sum / weight).collect()
    }

    fn log_partition(&self, force: f64, joints: &[f64]) -> f64 {
        let places = gauss_legendre();
        let shear = rigidities().shear;
        let of_segment = |c: f64| {
            let compliance = (1.0 - c * c) / shear.x + c * c / shear.z;
            let energy = force * c + 0.5 * force * force * compliance;
            ((energy - force) * self.length / KT).exp()
        };
        let weights: Vec<f64> = places.iter().map(|(c, _)| of_segment(*c)).collect();
        let polynomials: Vec<Vec<f64>> = places.iter().map(|(c, _)| legendre(*c)).collect();
        let (mut f, mut log) = (weights.clone(), 0.0);
        for _ in 1..self.segments {
            let mut moments = vec![0.0; DEGREES];
            for ((f, (_, weight)), p) in f.iter().zip(&places).zip(&polynomials) {
                moments
                    .iter_mut()
                    .zip(p)
                    .for_each(|(m, p)| *m += f * weight * p);
            }
            for (n, (moment, joint)) in moments.iter_mut().zip(joints).enumerate() {
                *moment *= joint * (n as f64 + 0.5);
            }
            for ((f, p), w) in f.iter_mut().zip(&polynomials).zip(&weights) {
                *f = w * p.iter().zip(&moments).map(|(p, m)| p * m).sum::<f64>();
            }
            let largest = f.iter().copied().fold(0.0, f64::max);
            for f in &mut f {
                *f /= largest;
            }
            log += largest.ln();
        }
        let last: f64 = f.iter().zip(&places).map(|(f, (_, w))| f * w).sum();
        log + last.ln() + force * self.contour() / KT
    }
}

fn legendre(c: f64) -> Vec<f64> {
    let mut p = vec![1.0, c];
    for n in 1..DEGREES - 1 {
        let k = n as f64;
        p.push(((2.0 * k + 1.0) * c * p[n] - k * p[n - 1]) / (k + 1.0));
    }
    p
}

fn gauss_legendre() -> Vec<(f64, f64)> {
    let n = PLACES as f64;
    let root = |k: usize| {
        let mut c = (std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut before, mut p) = (1.0, c);
            for m in 1..PLACES {
                let m = m as f64;
                (before, p) = (p, ((2.0 * m + 1.0) * c * p - m * before) / (m + 1.0));
            }
            slope = n * (c * p - before) / (c * c - 1.0);
            c -= p / slope;
        }
        (c, 2.0 / ((1.0 - c * c) * slope * slope))
    };
    (0..PLACES).map(root).collect()
}

/// The extension at 2 pN agrees within three standard errors.
#[test]
fn extension_is_exact_in_long_steps() {
    let chain = Chain {
        segments: 8,
        length: 40.0,
        force: 2.0,
    };
    let (mean, error) = mean_and_error(&chain.run(180.0, 20_000));
    let exact = chain.extension();
    println!("{mean} +- {error}, exact {exact}");
    assert!(error < 1e-3 * exact, "{error}");
    assert!(
        (mean - exact).abs() < 3.0 * error,
        "{mean} +- {error}, {exact}"
    );
}
