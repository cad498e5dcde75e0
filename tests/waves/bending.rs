//! Frequencies of slow bending of a clamped rod: rotary inertia of rigid segments, and mesh.

use super::field::{Motion, build, frequency_of, set};
use crate::theory::second_order_limit;
use actin_mechanics::Vector3;
use actin_sim::{Assembly, Trajectory};
use std::f64::consts::PI;

const LENGTH: f64 = 160.0;
/// Bending rigidity (pN nm^2) and mass per length (pN ns^2/nm^2).
const BEND: f64 = 3.9e4;
const DENSITY: f64 = 0.0697 / (71.2 / 26.0);

/// Mode of a slender cantilever: `beta L`, and the mean of `(L f')^2` over the mean of `f^2`.
struct Mode {
    beta_l: f64,
    slopes: f64,
}

const MODES: [Mode; 2] = [
    Mode {
        beta_l: 1.875_104_068_7,
        slopes: 4.647_8,
    },
    Mode {
        beta_l: 4.694_091_132_9,
        slopes: 32.417,
    },
];

impl Mode {
    /// Displacement and slope at an arc length (nm).
    fn shape(&self, s: f64) -> [f64; 2] {
        let (b, x) = (self.beta_l / LENGTH, self.beta_l * s / LENGTH);
        let ratio =
            (self.beta_l.cosh() + self.beta_l.cos()) / (self.beta_l.sinh() + self.beta_l.sin());
        let shape = x.cosh() - x.cos() - ratio * (x.sinh() - x.sin());
        let slope = b * (x.sinh() + x.sin() - ratio * (x.cosh() - x.cos()));
        [shape, slope]
    }

    fn slender(&self) -> f64 {
        (self.beta_l / LENGTH).powi(2) * (BEND / DENSITY).sqrt()
    }

    /// Frequency (rad/ns) on a mesh with a shear rigidity (pN), from the zeros of its amplitude
    /// over ten periods.
    fn measured(&self, segments: usize, inertia: &str, shear: f64) -> f64 {
        let period = 2.0 * PI / self.slender();
        let mut assembly = build(&format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: {segments})],
                    rod: RodModel(law: Constant, 
                        rotary_inertia: {inertia},
                        material: Rigidities(shear_pn: ({shear:?}, {shear:?}, 3.4e4), bend_pn_nm2: ({BEND:?}, {BEND:?}, 1.3e4)),
                    ),
                ),
                clamps: [Clamp(end: Start)],
                task: Dynamics(duration_ns: {:?}, record_every_ns: {:?}),
            )",
            10.2 * period,
            0.005 * period,
        ));
        set(&mut assembly, &|s| {
            let [shape, slope] = self.shape(s);
            Motion {
                shift: Vector3::zeros(),
                turn: Vector3::zeros(),
                velocity: Vector3::x() * (1e-4 * shape),
                spin: Vector3::y() * (1e-4 * slope),
            }
        });
        let (trajectory, _) = actin_sim::Plan::new(&assembly).unwrap().run().unwrap();
        self.frequency(&assembly, &trajectory)
    }

    fn frequency(&self, assembly: &Assembly, trajectory: &Trajectory) -> f64 {
        let amplitude = |state: &actin_mechanics::State| -> f64 {
            let points = assembly.points.iter().zip(state.points.position.iter());
            points.map(|(p, x)| self.shape(p.s_nm)[0] * x.x).sum()
        };
        let series = trajectory.records.iter();
        let series: Vec<_> = series
            .map(|r| (r.at.value(), amplitude(&r.state)))
            .collect();
        frequency_of(&series)
    }
}

/// Area of the cross-section (nm^2), and shear rigidity (pN).
const AREA: f64 = 38.5;
const SHEAR: f64 = 1.6e4;

/// To first order, rotary inertia and shear reduce the frequency by `(A / 4 pi + B / S) / 2` times
/// the mean squared slope over the mean squared displacement.
#[test]
fn the_first_flexural_frequency_agrees_with_the_beam() {
    let mode = &MODES[0];
    let slender = mode.slender();
    assert!((slender - 0.170).abs() < 5e-4, "{slender}");
    let radii = 0.5 * (AREA / (4.0 * PI) + BEND / SHEAR);
    let theory = slender * (1.0 - radii * mode.slopes / (LENGTH * LENGTH));
    let values = [8, 16, 32].map(|segments| mode.measured(segments, "CrossSection", SHEAR));
    assert!((values[1] / slender - 1.0).abs() < 0.01, "{values:?}");
    let limit = second_order_limit("first flexural frequency", values, theory, 0.05);
    // Second-order terms of the thickness and fourth-order terms of the mesh, each about 1e-6.
    assert!(limit.abs() < 1e-5, "{limit:e}");
}

/// By Rayleigh's quotient, rigid segments of length `h` lower a frequency by a relative `h^2/24`
/// times the mean squared slope over the mean squared displacement.
#[test]
fn rigid_segments_slow_bending_as_rayleigh_says() {
    println!(
        "mode, segments: rad/ns, against a slender rod, slower with rigid segments, as expected"
    );
    for (m, mode) in MODES.iter().enumerate() {
        for segments in [4, 8, 16].into_iter().skip(m) {
            let [section, rigid] =
                ["CrossSection", "RigidSegment"].map(|i| mode.measured(segments, i, 3.4e4));
            let (slower, h) = (1.0 - rigid / section, 1.0 / segments as f64);
            let expected = h * h / 24.0 * mode.slopes;
            println!(
                "{}, {segments}: {section:.5}, {:+.4}, {slower:.5}, {expected:.5}",
                m + 1,
                section / mode.slender() - 1.0
            );
            // Higher powers of the shift, and the mesh of the mode.
            assert!(
                (slower / expected - 1.0).abs() < 0.1 + 2.0 * expected,
                "{slower} {expected}"
            );
        }
    }
}
