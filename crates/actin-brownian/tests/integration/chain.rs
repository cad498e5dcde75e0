use crate::common;
use actin_brownian::mechanics::{PointLoad, UnitQuaternion, Vector3, Xorshift, rotation};
use common::{advance, free_rod, rigidities, tip};

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

    /// Distances of the ends and extensions along the force, in blocks of steps of `h` (ns).
    fn run(&self, h: f64, steps: u64) -> [Vec<Vec<f64>>; 2] {
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
        let mut found = [Vec::new(), Vec::new()];
        for block in 0..BLOCKS {
            let first = warm + block * each;
            let (mut distances, mut extensions) = (Vec::new(), Vec::new());
            advance(
                &mut system,
                &mut stepper,
                (first, first + each),
                h,
                |system| {
                    let x = &system.state().points.position;
                    let ends = x.get(tip(&rod)) - x.get(rod.points().start);
                    distances.push(ends.norm());
                    extensions.push(ends.z);
                },
            );
            found[0].push(distances);
            found[1].push(extensions);
        }
        found
    }

    fn joint(&self, random: &mut Xorshift) -> UnitQuaternion {
        let spread = (rigidities().bend / (KT * self.length)).map(|a| a.recip().sqrt());
        loop {
            let theta = Vector3::from_fn(|_, _| normal(random)).component_mul(&spread);
            let half = 0.5 * theta.norm();
            if 0.5 * (random.sample() + 1.0) < (half.sin() / half).powi(2) {
                return rotation::exp(theta);
            }
        }
    }

    fn drawn(&self, random: &mut Xorshift) -> f64 {
        let spread = (rigidities().shear * (self.length / KT)).map(|a| a.recip().sqrt());
        let (mut q, mut ends) = (UnitQuaternion::identity(), Vector3::zeros());
        for _ in 0..self.segments {
            let strain = Vector3::from_fn(|_, _| normal(random)).component_mul(&spread);
            ends += q * (Vector3::z() + strain) * self.length;
            q *= self.joint(random);
        }
        ends.norm()
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

fn normal(random: &mut Xorshift) -> f64 {
    let u = 0.5 * (random.sample() + 1.0);
    let phase = std::f64::consts::PI * random.sample();
    (-2.0 * (1.0 - u).ln()).sqrt() * phase.cos()
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

fn mean_and_error(blocks: &[Vec<f64>], of: impl Fn(f64) -> f64) -> (f64, f64) {
    let means: Vec<f64> = blocks
        .iter()
        .map(|block| block.iter().map(|x| of(*x)).sum::<f64>() / block.len() as f64)
        .collect();
    let n = means.len() as f64;
    let mean = means.iter().sum::<f64>() / n;
    let squares: f64 = means.iter().map(|m| (m - mean).powi(2)).sum();
    (mean, (squares / (n - 1.0) / n).sqrt())
}

/// The extension at 2 pN agrees within three standard errors.
#[test]
fn extension_is_exact_in_long_steps() {
    let chain = Chain {
        segments: 8,
        length: 40.0,
        force: 2.0,
    };
    let [_, extensions] = chain.run(180.0, 20_000);
    let ((mean, error), exact) = (mean_and_error(&extensions, |x| x), chain.extension());
    println!("{mean} +- {error}, exact {exact}");
    assert!(error < 1e-3 * exact, "{error}");
    assert!(
        (mean - exact).abs() < 3.0 * error,
        "{mean} +- {error}, {exact}"
    );
}

/// The error of the extension of 1 um is below a thousandth. The result of Odijk for a continuous
/// chain is printed.
#[test]
#[ignore = "takes minutes"]
fn force_and_extension() {
    for (force, h, steps) in [
        (0.5, 180.0, 200_000),
        (2.0, 180.0, 200_000),
        (10.0, 180.0, 100_000),
        (10.0, 31.0, 200_000),
        (2.0, 1000.0, 100_000),
        (10.0, 1000.0, 100_000),
    ] {
        let chain = Chain {
            segments: 25,
            length: 40.0,
            force,
        };
        let (mean, error) = mean_and_error(&chain.run(h, steps)[1], |x| x);
        let bend = rigidities().bend.x;
        let slack = 0.5 * KT / (force * bend).sqrt();
        let odijk = 1000.0 * (1.0 - slack + force / rigidities().shear.z);
        let exact = chain.extension();
        println!(
            "{force} pN, {h} ns: missing {:.3} +- {error:.3} of 1000 nm, the chain {:.3}, without ends {:.3}",
            1000.0 - mean,
            1000.0 - exact,
            1000.0 - odijk
        );
        assert!((mean - exact).abs() < 1e-3 * chain.contour() + 3.0 * error);
    }
}

/// Distribution of the end distance of a free rod of 1 um, compared with samples of the exact
/// chain: mean square within four standard errors, and deciles within a tenth. The result of Kratky
/// and Porod is printed.
#[test]
#[ignore = "takes minutes"]
fn distances_of_the_ends() {
    let chain = Chain {
        segments: 25,
        length: 40.0,
        force: 0.0,
    };
    let mut random = Xorshift::new(3);
    let mut drawn: Vec<f64> = (0..400_000).map(|_| chain.drawn(&mut random)).collect();
    drawn.sort_by(f64::total_cmp);
    let squares = drawn.iter().map(|r| r * r).sum::<f64>() / drawn.len() as f64;
    let [distances, _] = chain.run(1000.0, 500_000);
    let (mean, error) = mean_and_error(&distances, |r| r * r);
    let lp = rigidities().bend.x / KT;
    let contour = chain.contour();
    let porod = 2.0 * lp * contour * (1.0 - lp / contour * (1.0 - (-contour / lp).exp()));
    println!(
        "mean square {mean:.1} +- {error:.1}, drawn {squares:.1}, Kratky and Porod {porod:.1} nm^2"
    );
    assert!((mean - squares).abs() < 4.0 * error);
    let mut chi = 0.0;
    for part in 0..10 {
        let bound = |k: usize| drawn.get(k * drawn.len() / 10).copied();
        let from = if part == 0 {
            0.0
        } else {
            bound(part).unwrap_or(0.0)
        };
        let to = bound(part + 1).unwrap_or(f64::INFINITY);
        let inside = |r: f64| f64::from(u8::from(from <= r && r < to));
        let (share, error) = mean_and_error(&distances, inside);
        chi += ((share - 0.1) / error).powi(2);
        println!("{from:.2} to {to:.2} nm: {share:.4} +- {error:.4}");
        assert!((share - 0.1).abs() < 0.01);
    }
    println!("chi^2 {chi:.1} of ten parts");
}

/// At 10 pN the error of the extension is below a thousandth for all steps.
#[test]
#[ignore = "takes minutes"]
fn tension_and_step() {
    let chain = Chain {
        segments: 8,
        length: 40.0,
        force: 10.0,
    };
    let exact = chain.extension();
    for (h, steps) in [
        (1.0, 400_000),
        (8.0, 200_000),
        (31.0, 100_000),
        (180.0, 50_000),
    ] {
        let (mean, error) = mean_and_error(&chain.run(h, steps)[1], |x| x);
        assert!(
            (mean - exact).abs() < 1e-3 * chain.contour(),
            "{h} ns: {mean} +- {error}, {exact}"
        );
    }
}
