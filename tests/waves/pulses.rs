//! Reflection of pulses at a junction between rod and monomers.
//!
//! The measured value is the share of the energy in the rod after the reflection. Weakly twisted or
//! bent monomers are softer than the rod, and an axial pulse also twists them, so part of the
//! reflection is not due to the junction. A rod throughout gives the share due to the mesh and the
//! initial pulse.

use super::field::{Motion, build, set};
use crate::common::run;
use actin_mechanics::{State, Vector3};
use actin_sim::{Assembly, End, shape};
use std::f64::consts::TAU;

/// Mass per length (pN ns^2/nm^2) and polar moment per length (pN ns^2).
const DENSITY: f64 = 0.0697 / (71.2 / 26.0);
const POLAR: f64 = DENSITY * 38.5 / TAU;
/// Rigidities of the rod (pN; pN nm^2).
const STRETCH: f64 = 3.4e4;
const BEND: f64 = 3.9e4;
const TWIST: f64 = 1.3e4;
/// Distance, in widths of the pulse, at which it is negligible.
const REACH: f64 = 7.0;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Stretch with this largest strain.
    Axial(f64),
    /// Twist with this largest rate (rad/nm).
    Torsional(f64),
    /// Bending wave with this largest curvature (rad/nm), one wave within 1.5 widths.
    Flexural(f64),
}

/// Pulse with a width (standard deviation of its Gaussian, nm).
#[derive(Clone, Copy, Debug)]
struct Pulse {
    kind: Kind,
    width: f64,
}

impl Pulse {
    fn wave_number(self) -> f64 {
        TAU / (1.5 * self.width)
    }

    fn speed(self) -> f64 {
        match self.kind {
            Kind::Axial(_) => (STRETCH / DENSITY).sqrt(),
            Kind::Torsional(_) => (TWIST / POLAR).sqrt(),
            Kind::Flexural(_) => 2.0 * (BEND / DENSITY).sqrt() * self.wave_number(),
        }
    }

    /// Fields at a distance `x` (nm) from its middle, travelling towards larger `x`.
    fn motion(self, x: f64) -> Motion {
        let none = Vector3::zeros();
        let mut motion = Motion {
            shift: none,
            turn: none,
            velocity: none,
            spin: none,
        };
        match self.kind {
            Kind::Axial(strain) => {
                motion.shift.z = strain * self.step(x);
                motion.velocity.z = -self.speed() * strain * self.bell(x);
            }
            Kind::Torsional(rate) => {
                motion.turn.z = rate * self.step(x);
                motion.spin.z = -self.speed() * rate * self.bell(x);
            }
            Kind::Flexural(curvature) => {
                let amplitude = curvature / self.wave_number().powi(2);
                let difference = |f: &dyn Fn(f64) -> f64| {
                    let h = 1e-4 * self.width;
                    amplitude * (f(x + h) - f(x - h)) / (2.0 * h)
                };
                let (shift, speed) = (|x| self.packet(x).0, |x| self.packet(x).1);
                motion.shift.x = amplitude * shift(x);
                motion.velocity.x = amplitude * speed(x);
                motion.turn.y = difference(&shift);
                motion.spin.y = difference(&speed);
            }
        }
        motion
    }

    fn bell(self, x: f64) -> f64 {
        (-0.5 * (x / self.width).powi(2)).exp()
    }

    /// Minus the integral of the bell from `x` to infinity.
    fn step(self, x: f64) -> f64 {
        const PARTS: usize = 400;
        let end = (REACH + 3.0) * self.width;
        if x >= end {
            return 0.0;
        }
        let h = (end - x) / PARTS as f64;
        let inner: f64 = (1..PARTS).map(|k| self.bell(x + k as f64 * h)).sum();
        -h * (0.5 * (self.bell(x) + self.bell(end)) + inner)
    }

    /// Deflection and velocity of a bending wave in a Gaussian envelope, `y = Re z`, `z = bell
    /// exp(i k x)`, with `dz/dt = i sqrt(B/mu) z''` for one direction of travel.
    fn packet(self, x: f64) -> (f64, f64) {
        let (k, w2) = (self.wave_number(), self.width * self.width);
        let (sin, cos) = (k * x).sin_cos();
        let bell = self.bell(x);
        let (first, second) = (-x / w2 * bell, (x * x / w2 - 1.0) / w2 * bell);
        let velocity = (k * k * bell - second) * sin - 2.0 * k * first * cos;
        (bell * cos, (BEND / DENSITY).sqrt() * velocity)
    }
}

#[derive(Clone, Copy, Debug)]
enum Beyond {
    Monomers { weight: &'static str, seed: u64 },
    Rod,
}

fn filament(pulse: Pulse, segment: f64, beyond: Beyond) -> (Assembly, f64) {
    let enough = 2.0 * REACH * pulse.width;
    let count = (1_usize..1000)
        .find(|&n| n as f64 * segment >= enough)
        .unwrap();
    let (half, end) = (count as f64 * segment, 2.0 * count as f64 * segment);
    let time = enough / pulse.speed();
    let (sections, rest) = match beyond {
        Beyond::Monomers { weight, seed } => (
            format!(
                "Rod(from_nm: 0.0, to_nm: {half:?}, segments: {count}), \
                 Ellipsoids(from_nm: {half:?}, to_nm: {end:?})"
            ),
            format!(
                "monomers: (anchors: Independent, seed: {seed}), junction: (weight: {weight}),"
            ),
        ),
        Beyond::Rod => (
            format!("Rod(from_nm: 0.0, to_nm: {end:?}, segments: {})", 2 * count),
            String::new(),
        ),
    };
    let scene = format!(
        "Scene(
            filament: Filament(rod: RodModel(law: Constant), sections: [{sections}], {rest}),
            task: Dynamics(duration_ns: {time:?}, record_every_ns: {time:?}),
        )"
    );
    (build(&scene), half)
}

fn reflected(pulse: Pulse, segment: f64, beyond: Beyond) -> f64 {
    let (mut assembly, half) = filament(pulse, segment, beyond);
    let middle = half - REACH * pulse.width;
    set(&mut assembly, &|s| pulse.motion(s - middle));
    run(&mut assembly).unwrap();
    let (first, all) = energies(&assembly, half, segment);
    first / all
}

/// Energy of the rod before arc length `half`, and total energy (pN nm).
fn energies(assembly: &Assembly, half: f64, segment: f64) -> (f64, f64) {
    let state = assembly.system.state();
    // Parts of the joined end count as beyond.
    let is_before = |s: f64| s < half - 0.6 * segment;
    let points = assembly.points.iter().enumerate();
    let moving = points.filter(|(_, p)| is_before(p.s_nm)).map(|(i, _)| {
        let v = state.points.velocity.get(i);
        0.5 * v.norm_squared() / state.points.inverse_mass()[i]
    });
    let frames = assembly.frames.iter().enumerate();
    let turning = frames
        .filter(|(_, f)| is_before(f.s_nm))
        .map(|(i, _)| turning(state, i));
    let profile = shape::profile(assembly, state);
    let strained = profile.iter().filter(|p| is_before(p.s_nm)).map(|p| {
        let length = if p.s_nm == 0.0 {
            0.5 * segment
        } else {
            segment
        };
        p.energy_per_length_pn * length
    });
    let first = moving.chain(turning).chain(strained).sum();
    (first, assembly.system.total_energy())
}

fn turning(state: &State, i: usize) -> f64 {
    let l = state.frames.angular_momentum.get(i);
    0.5 * l.component_mul(&state.frames.inverse_moments(i)).dot(&l)
}

fn over_samplings(pulse: Pulse, segment: f64, weight: &'static str) -> (f64, f64) {
    const SEEDS: u64 = 4;
    let shares: Vec<f64> = (0..SEEDS)
        .map(|seed| reflected(pulse, segment, Beyond::Monomers { weight, seed }))
        .collect();
    let mean = shares.iter().sum::<f64>() / SEEDS as f64;
    let variance = shares.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (SEEDS - 1) as f64;
    (mean, variance.sqrt())
}

struct Shares {
    rod: f64,
    shared: (f64, f64),
    full: (f64, f64),
}

fn shares(kind: Kind, width: f64, segment: f64) -> Shares {
    let pulse = Pulse { kind, width };
    let of = |weight| over_samplings(pulse, segment, weight);
    let shares = Shares {
        rod: reflected(pulse, segment, Beyond::Rod),
        shared: of("Shared"),
        full: of("Full"),
    };
    println!(
        "{kind:?}, {width}, {segment}: {:.1e}, {:.4} +- {:.4}, {:.4} +- {:.4}",
        shares.rod, shares.shared.0, shares.shared.1, shares.full.0, shares.full.1
    );
    shares
}

/// A rod throughout reflects almost nothing; bending waves a few percent, since the initial wave
/// ignores shear and rotary inertia.
///
/// Axial pulses pass monomers with a few percent reflected. A twist of 1e-5 rad/nm is mostly
/// reflected, because monomers have almost no secant twisting rigidity there. It reaches the
/// rigidity of the rod within 0.03 rad/nm.
#[test]
fn reflection_follows_the_rigidity_of_monomers() {
    println!("pulse, width nm, segment nm: share reflected by rod, shared, full");
    for (width, segment) in [(20.0, 5.0), (40.0, 10.0)] {
        let axial = shares(Kind::Axial(1e-3), width, segment);
        assert!(axial.rod < 1e-5, "{}", axial.rod);
        assert!(axial.shared.0 < 0.06 && axial.full.0 < 0.06);
    }
    let twists = [1e-5, 1e-3, 2e-2].map(|rate| shares(Kind::Torsional(rate), 20.0, 5.0));
    for twist in &twists {
        assert!(twist.rod < 1e-5, "{}", twist.rod);
    }
    for pair in twists.windows(2) {
        assert!(pair[1].shared.0 < pair[0].shared.0 && pair[1].full.0 < pair[0].full.0);
    }
    assert!(twists[2].shared.0 < 0.1, "{:?}", twists[2].shared);
    let bends = [1e-5, 1e-3].map(|curvature| shares(Kind::Flexural(curvature), 40.0, 5.0));
    for bend in &bends {
        assert!(bend.rod < 0.03, "{}", bend.rod);
    }
    assert!(bends[1].shared.0 < bends[0].shared.0);
}

/// Monomers with blocked rotation have the stretching rigidity of the rod. With free rotation they
/// are twenty times softer at small forces, which explains the reflection of axial pulses.
#[test]
fn monomers_that_cannot_turn_resist_stretching_as_the_rod() {
    let resistance = |force: f64, end_clamp: &str| {
        let assembly = build(&format!(
            "Scene(
                filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 150.0)]),
                clamps: [Clamp(end: Start){end_clamp}],
                loads: [EndForce(end: End, force_pn: (0.0, 0.0, {force:?}))],
                task: Equilibrium(),
            )"
        ));
        let rest = assembly.tip_nm(&assembly.rest, End::End).z;
        let (trajectory, _) = actin_sim::Plan::new(&assembly).unwrap().run().unwrap();
        let last = trajectory.records.last().unwrap();
        let now = assembly.tip_nm(&last.state, End::End).z;
        force / (now / rest - 1.0)
    };
    for force in [0.34, 34.0] {
        let kept = resistance(force, ", Clamp(end: End, slides: AlongAxis)");
        let free = resistance(force, "");
        println!("{force} pN: {kept:.3e} pN kept from turning, {free:.3e} pN free to turn");
        // Two per cent below the rod: bonds of one sampling.
        assert!((kept / STRETCH - 1.0).abs() < 0.05, "{kept}");
        assert!(free < 0.7 * kept, "{free}");
    }
}
