//! Longitudinal and torsional vibrations of a clamped rod.
//!
//! Both are waves on a lattice of spacing `h`. Their modes equal the modes of the continuous rod at
//! the nodes (stretch) and at the middles of the segments (twist). The frequencies are `2 c/h sin(k
//! h/2)` with `k = (2m - 1) pi / 2L`.

use super::field::{Motion, build, frequency_of, set};
use actin_mechanics::Vector3;
use actin_sim::Assembly;
use std::f64::consts::PI;

const LENGTH: f64 = 160.0;
/// Mass per length (pN ns^2/nm^2): a monomer's mass over the rise.
const DENSITY: f64 = 0.0697 / (71.2 / 26.0);
const AREA: f64 = 38.5;
/// Stretching rigidity (pN) and twisting rigidity (pN nm^2).
const STRETCH: f64 = 3.4e4;
const TWIST: f64 = 1.3e4;
/// Amplitude of strain and twist (rad/nm), small enough for linear frequencies.
const AMPLITUDE: f64 = 1e-7;

#[derive(Clone, Copy, Debug)]
enum Wave {
    Stretch,
    Twist,
}

impl Wave {
    /// Speed of long waves (nm/ns): root of rigidity over inertia per length.
    fn speed(self) -> f64 {
        match self {
            Self::Stretch => (STRETCH / DENSITY).sqrt(),
            // A circular section of area A has the polar moment A^2 / 2 pi.
            Self::Twist => (TWIST / (DENSITY * AREA / (2.0 * PI))).sqrt(),
        }
    }

    fn motion(self, k: f64, s: f64) -> Motion {
        let z = Vector3::z() * (AMPLITUDE * self.speed() * (k * s).sin());
        let none = Vector3::zeros();
        let (velocity, spin) = match self {
            Self::Stretch => (z, none),
            Self::Twist => (none, z),
        };
        Motion {
            shift: none,
            turn: none,
            velocity,
            spin,
        }
    }

    fn fields(self, assembly: &Assembly, state: &actin_mechanics::State) -> Vec<(f64, f64)> {
        match self {
            Self::Stretch => {
                let points = assembly.points.iter().zip(state.points.position.iter());
                points.map(|(p, x)| (p.s_nm, x.z - p.s_nm)).collect()
            }
            Self::Twist => {
                let frame = |i: usize| {
                    let q = state.frames.orientation.get(i);
                    (assembly.frames[i].s_nm, actin_mechanics::rotation::log(q).z)
                };
                (0..state.frames.len()).map(frame).collect()
            }
        }
    }
}

/// Frequency of mode `m` (rad/ns), from the zeros of its amplitude over about twenty periods.
fn measured(wave: Wave, segments: usize, m: usize) -> f64 {
    let k = (m as f64 - 0.5) * PI / LENGTH;
    let period = 2.0 * PI / (k * wave.speed());
    let mut assembly = build(&format!(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: {segments})], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],
            task: Dynamics(duration_ns: {:?}, record_every_ns: {:?}),
        )",
        20.2 * period,
        0.005 * period,
    ));
    set(&mut assembly, &|s| wave.motion(k, s));
    let (trajectory, _) = actin_sim::Plan::new(&assembly).unwrap().run().unwrap();
    let amplitudes: Vec<(f64, f64)> = trajectory
        .records
        .iter()
        .map(|record| {
            let fields = wave.fields(&assembly, &record.state);
            let amplitude = fields.iter().map(|(s, u)| (k * s).sin() * u).sum();
            (record.at.value(), amplitude)
        })
        .collect();
    frequency_of(&amplitudes)
}

#[test]
fn stretching_and_twisting_frequencies_agree_with_the_lattice() {
    for wave in [Wave::Stretch, Wave::Twist] {
        for (segments, m) in [(16, 1), (16, 4), (32, 1), (32, 4)] {
            let h = LENGTH / segments as f64;
            let k = (m as f64 - 0.5) * PI / LENGTH;
            let lattice = 2.0 * wave.speed() / h * (0.5 * k * h).sin();
            let found = measured(wave, segments, m);
            // Zeros interpolated in 1/200 of a period are accurate to 1e-6 of twenty periods.
            assert!((found / lattice - 1.0).abs() < 2e-6, "{found} {lattice}");
        }
    }
}
