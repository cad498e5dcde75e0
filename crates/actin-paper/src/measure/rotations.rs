//! Relative rotations of cross-sections of a filament in a heat bath.
//!
//! At the distance `s`, `<cos theta> = exp(-s / lp)` and `<phi^2> - <phi>^2 = s kT / C`. Here `theta`
//! is the tilt of the axis, `phi` the rotation about it, `lp` the persistence length and `C` the
//! twisting rigidity. The mean `<phi>` is not zero, since heat untwists filaments.

use actin_integrate::{Bath, Composition, Drag, advance_in, largest_frequency, stable_step};
use actin_mechanics::{State, UnitQuaternion, rotation};
use actin_sim::{
    Assembly, BOLTZMANN_PN_NM_PER_K, BodyKind, DragModel, Dynamics, Filament, Scene, Thermal,
};

const ROOM_K: f64 = 298.0;
/// Thermal energy at 298 K (pN nm).
pub(crate) const ROOM_PN_NM: f64 = BOLTZMANN_PN_NM_PER_K * ROOM_K;
/// Drag rate (1/ns), near critical for the slowest bending mode of 110 nm.
const DRAG: f64 = 5.0;
/// Time before the first sample, ten relaxation times of the slowest bending mode, and time between
/// samples (ns).
const WARM_UP_NS: f64 = 5.0;
const APART_NS: f64 = 0.25;
const SAMPLES: u32 = 400;

/// Means over samples of one filament, indexed by the separation of frames.
#[derive(Clone, Debug, PartialEq)]
pub struct RotationCorrelations {
    /// Indices of the frames, which are equally spaced.
    pub frames: Vec<usize>,
    /// `<cos theta>`.
    pub cosine: Vec<f64>,
    /// `<phi>` (rad) of each pair of frames.
    pub mean_twist: Vec<Vec<f64>>,
    /// `<phi^2>` (rad^2).
    pub square_twist: Vec<f64>,
}

impl RotationCorrelations {
    /// Zero means for the monomers and segments of a filament, without the cross-sections at its ends and junctions,
    /// which are closer to the next frame.
    pub fn new(assembly: &Assembly) -> Self {
        let is_sampled = |&i: &usize| {
            matches!(
                assembly.frames[i].kind,
                BodyKind::Monomer | BodyKind::Segment
            )
        };
        Self::between((0..assembly.frames.len()).filter(is_sampled).collect())
    }

    fn between(frames: Vec<usize>) -> Self {
        let count = frames.len();
        Self {
            frames,
            cosine: vec![0.0; count],
            mean_twist: (0..count).map(|k| vec![0.0; count - k]).collect(),
            square_twist: vec![0.0; count],
        }
    }

    /// Adds one of `samples` samples: the mean over all pairs of frames at each separation. The
    /// axis of the filament at `rest` is z.
    pub fn add(&mut self, rest: &State, state: &State, samples: usize) {
        let (q0, q) = (&rest.frames.orientation, &state.frames.orientation);
        // Rotations from rest, in the axes of the filament at rest.
        let frames = self.frames.iter();
        let turns: Vec<UnitQuaternion> = frames.map(|&i| q.get(i) * q0.get(i).inverse()).collect();
        for k in 0..turns.len() {
            let pairs = turns.iter().zip(&turns[k..]);
            let weight = 1.0 / (pairs.len() * samples) as f64;
            for ((a, b), mean_twist) in pairs.zip(&mut self.mean_twist[k]) {
                let relative = a.inverse() * b;
                let (x, y) = (relative.i, relative.j);
                // Element (3, 3) of the rotation matrix.
                self.cosine[k] += weight * (1.0 - 2.0 * (x * x + y * y));
                let phi = rotation::log(relative).z;
                *mean_twist += phi / samples as f64;
                self.square_twist[k] += weight * phi * phi;
            }
        }
    }

    /// `-ln <cos theta>` over replicas at separation `k`.
    pub fn tilt(replicas: &[&Self], k: usize) -> f64 {
        -mean(replicas, |turns| turns.cosine[k]).ln()
    }

    /// Variance of `phi` over replicas at separation `k` (rad^2), about the mean of each pair: mean
    /// rotations near the ends differ.
    pub fn twist_variance(replicas: &[&Self], k: usize) -> f64 {
        let pairs = replicas[0].mean_twist[k].len();
        let firsts = (0..pairs).map(|i| mean(replicas, |turns| turns.mean_twist[k][i]));
        let squares: f64 = firsts.map(|first| first * first).sum();
        mean(replicas, |turns| turns.square_twist[k]) - squares / pairs as f64
    }
}

fn mean(replicas: &[&RotationCorrelations], value: impl Fn(&RotationCorrelations) -> f64) -> f64 {
    let sum: f64 = replicas.iter().map(|turns| value(turns)).sum();
    sum / replicas.len() as f64
}

/// Rotations of a free filament in a heat bath at 298 K. The time step is a share of the stability
/// limit at rest; replicas differ in their noise.
pub(crate) fn turns_in_bath(
    filament: Filament,
    (scheme, share): (&Composition, f64),
    replica: u64,
) -> Result<RotationCorrelations, String> {
    let scene = Scene::new(filament, heated(replica + 1));
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let frequency = largest_frequency(&assembly.system).map_err(|e| e.to_string())?;
    let step = stable_step(scheme, frequency, share).map_err(|e| e.to_string())?;
    let drag = Drag::new(DRAG, DRAG).map_err(|e| e.to_string())?;
    let bath = Bath::new(drag, ROOM_PN_NM, replica + 1).map_err(|e| e.to_string())?;
    let (warm_up, apart) = (steps_in(WARM_UP_NS, step), steps_in(APART_NS, step));
    let mut turns = RotationCorrelations::new(&assembly);
    advance_in(&mut assembly.system, scheme, step, warm_up, &bath, 0);
    for sample in 0..SAMPLES {
        let first = warm_up + u64::from(sample) * apart;
        advance_in(&mut assembly.system, scheme, step, apart, &bath, first);
        turns.add(&assembly.rest, assembly.system.state(), SAMPLES as usize);
    }
    Ok(turns)
}

/// Motion in a heat bath at 298 K, which selects the law of rods.
fn heated(seed: u64) -> Dynamics {
    Dynamics {
        drag: DragModel::rates_per_ns([DRAG; 2]),
        thermal: Some(Thermal {
            temperature_k: ROOM_K,
            seed,
        }),
        ..Dynamics::new(WARM_UP_NS)
    }
}

/// Persistence length (nm) and twisting rigidity over kT (nm) with their standard errors. The
/// slopes between 1/5 and 3/5 of the length exclude local fluctuations of single monomers. The
/// distance between frames is `apart_nm`.
pub(crate) fn far_lengths(all: &[RotationCorrelations], apart_nm: f64) -> [(f64, f64); 2] {
    let count = all[0].cosine.len();
    let (from, to) = (count / 5, 3 * count / 5);
    let slope = |value: &dyn Fn(&[&RotationCorrelations], usize) -> f64| {
        jackknife(all, |chosen| {
            (to - from) as f64 * apart_nm / (value(chosen, to) - value(chosen, from))
        })
    };
    [
        slope(&RotationCorrelations::tilt),
        slope(&RotationCorrelations::twist_variance),
    ]
}

/// Number of steps of `h` in a duration, rounded up.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the conversion saturates, and durations are positive"
)]
pub fn steps_in(duration: f64, h: f64) -> u64 {
    (duration / h).ceil() as u64
}

/// Jackknife estimate over all replicas, with its standard error.
pub fn jackknife<T>(replicas: &[T], estimate: impl Fn(&[&T]) -> f64) -> (f64, f64) {
    let all: Vec<&T> = replicas.iter().collect();
    let whole = estimate(&all);
    let n = all.len() as f64;
    let squares = (0..all.len()).map(|leave| {
        let rest: Vec<&T> = all[..leave]
            .iter()
            .chain(&all[leave + 1..])
            .copied()
            .collect();
        (estimate(&rest) - whole).powi(2)
    });
    let square: f64 = squares.sum();
    (whole, (square * (n - 1.0) / n).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::{Frame, Inertia, Vector3};

    /// The jackknife error of a mean is the usual standard error: `sqrt(5/12)` for 1, 2, 3, 4.
    #[test]
    fn the_jackknife_of_a_mean_is_its_standard_error() {
        let mean = |chosen: &[&f64]| chosen.iter().copied().sum::<f64>() / chosen.len() as f64;
        let (value, error) = jackknife(&[1.0, 2.0, 3.0, 4.0], mean);
        assert!((value - 2.5).abs() < 1e-15);
        assert!((error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
    }

    /// Three frames: the second is tilted by 0.3 and the third twisted by 0.4, relative to the
    /// first.
    #[test]
    fn tilt_and_twist_are_separated() {
        let state = |turns: [Vector3; 3]| {
            let mut state = State::default();
            for turn in turns {
                state.frames.push(Frame {
                    orientation: rotation::exp(turn),
                    inertia: Inertia::from_moments([1.0, 1.0, 1.0]).unwrap(),
                });
            }
            state
        };
        let rest = state([Vector3::zeros(); 3]);
        let (tilt, twist) = (Vector3::x() * 0.3, Vector3::z() * 0.4);
        let mut turns = RotationCorrelations::between(vec![0, 1, 2]);
        turns.add(&rest, &state([Vector3::zeros(), tilt, twist]), 1);
        assert!((turns.cosine[0] - 1.0).abs() < 1e-15 && turns.square_twist[0].abs() < 1e-15);
        // Separation 2: first and third only.
        assert!((turns.cosine[2] - 1.0).abs() < 1e-15);
        assert_eq!(turns.mean_twist[2].len(), 1);
        assert!((turns.mean_twist[2][0] - 0.4).abs() < 1e-15);
        assert!((turns.square_twist[2] - 0.16).abs() < 1e-15);
        // One sample: its variance is zero, although the pairs of separation 1 differ.
        for k in [1, 2] {
            assert!(RotationCorrelations::twist_variance(&[&turns], k).abs() < 1e-15);
        }
        // Separation 1: only the pair of the first two has tilt.
        let of_second = 2.0 * turns.cosine[1] - 0.3_f64.cos();
        assert!((of_second - 0.3_f64.cos()).abs() < 1e-15);
    }
}
