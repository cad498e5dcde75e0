//! Tables 3, 4 and 5 of one variant: the numbers that the figures' verdicts compare, and their gates.

use super::variant::Variant;
use crate::measure::{
    Evidence, MeasureError, bend_by_couples, shear_by_force, stretch_by_force, twist,
};
use crate::published::{Entry, Table, entries};
use rayon::prelude::*;
use std::time::Instant;

/// Rises between the inner held monomers of twisted and stretched filaments: 73.94 nm.
const RISES: f64 = 27.0;
/// The same of bent and sheared ones: 150.62 nm.
const BENT_RISES: f64 = 55.0;
/// Force at which S3 is compared (pN).
const PULL_PN: f64 = 100.0;
/// Curvatures of bending (rad/nm); B1 is compared at the last.
const CURVATURES: [f64; 2] = [1e-3, 1e-2];
/// Azimuths of bending and shear (deg): what is even in the azimuth has the mean of all over these.
const AZIMUTHS_DEG: [f64; 2] = [0.0, 90.0];
/// Transverse force on a guided end (pN).
const SHEAR_PN: f64 = 0.1;
/// Samplings that are bent and sheared at most, as for Table 4.
const BENT_SAMPLINGS: usize = 8;
/// Angles (deg) over which root mean squares are taken.
const COMPARED_DEG: std::ops::RangeInclusive<f64> = 40.0..=200.0;

/// S3 (pN) and B1 (pN nm^2) of Table 4.
const PAPER: [f64; 2] = [3.4e4, 3.9e4];

/// Bounds of the four differences, those of the verdicts on Tables 3, 5 and 4.
pub(super) const GATES: [f64; 4] = [0.12, 0.0012, 0.05, 0.04];

/// What the tables say of one variant: means over samplings.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    /// Secant twisting rigidity (pN nm^2) at the entries of Table 3, and its standard deviation.
    pub b3: Vec<(Entry, f64, f64)>,
    /// Change of length at the entries of Table 5.
    pub change: Vec<(Entry, f64)>,
    /// Stretching rigidity at 100 pN (pN).
    pub s3: f64,
    /// Bending rigidities at the curvatures (pN nm^2).
    pub b1: [f64; 2],
    /// Secant shearing rigidity at 0.1 pN, bending included (pN).
    pub shear: f64,
    /// States that are not stable beyond doubt, and values that were not reached.
    pub doubtful: usize,
    /// Time on one core for one sampling (s).
    pub seconds: f64,
}

/// What one sampling says; the seconds that each protocol took.
struct Sampling {
    b3: Vec<f64>,
    change: Vec<f64>,
    s3: f64,
    bent: Option<Bent>,
    doubtful: usize,
    seconds: f64,
}

struct Bent {
    b1: [f64; 2],
    shear: f64,
}

impl Measured {
    /// Measures so many samplings of a variant, in parallel; `done` is told of each.
    pub(super) fn of(
        variant: &Variant,
        samplings: u64,
        done: &(impl Fn() + Sync),
    ) -> Result<Self, String> {
        let (rigidities, changes) = (entries(Table::Rigidity)?, entries(Table::LengthChange)?);
        let all: Vec<Sampling> = variant
            .seeds(samplings)
            .into_par_iter()
            .map(|seed| {
                let measured = Sampling::of(variant, seed, &rigidities);
                done();
                measured.map_err(|e| format!("{}, seed {seed}: {e}", variant.bonds()))
            })
            .collect::<Result<_, _>>()?;
        let bent: Vec<&Bent> = all.iter().filter_map(|s| s.bent.as_ref()).collect();
        let over_bent = |of: &dyn Fn(&Bent) -> f64| mean(bent.iter().map(|b| of(b)));
        Ok(Self {
            b3: rigidities
                .iter()
                .enumerate()
                .map(|(i, entry)| {
                    let (mean, sd) = spread(all.iter().map(|s| s.b3[i]));
                    (*entry, mean, sd)
                })
                .collect(),
            change: changes
                .iter()
                .enumerate()
                .map(|(i, entry)| (*entry, mean(all.iter().map(|s| s.change[i]))))
                .collect(),
            s3: mean(all.iter().map(|s| s.s3)),
            b1: [0, 1].map(|i| over_bent(&|b| b.b1[i])),
            shear: over_bent(&|b| b.shear),
            doubtful: all.iter().map(|s| s.doubtful).sum(),
            seconds: mean(all.iter().filter(|s| s.bent.is_some()).map(|s| s.seconds)),
        })
    }

    /// The four differences to the paper: rms of B3 (relative) and of dL/L, S3 and B1 (relative).
    pub(super) fn differences(&self) -> [f64; 4] {
        let is_compared = |entry: &Entry| COMPARED_DEG.contains(&entry.phi_deg);
        let b3 = self.b3.iter().filter(|(entry, ..)| is_compared(entry));
        [
            rms(b3.map(|(entry, ours, _)| ours / entry.value - 1.0)),
            self.change_to(*COMPARED_DEG.end()),
            self.s3 / PAPER[0] - 1.0,
            self.b1[1] / PAPER[1] - 1.0,
        ]
    }

    /// Root mean square of the difference of dL/L up to an angle (deg).
    pub(super) fn change_to(&self, largest_deg: f64) -> f64 {
        let compared = *COMPARED_DEG.start()..=largest_deg;
        let change = self.change.iter();
        let change = change.filter(|(entry, _)| compared.contains(&entry.phi_deg));
        rms(change.map(|(entry, ours)| ours - entry.value))
    }

    /// The mean at an angle (deg) of Table 3, positive in over-twist.
    pub(super) fn b3_at(&self, phi_deg: f64) -> f64 {
        let is_there = |entry: &&(Entry, f64, f64)| {
            let signed = entry.0.phi_deg * entry.0.curvature.signum();
            (signed - phi_deg).abs() < 1e-9
        };
        let found = self.b3.iter().find(is_there);
        found.map_or(f64::NAN, |(_, ours, _)| *ours)
    }
}

impl Sampling {
    fn of(variant: &Variant, seed: u64, entries: &[Entry]) -> Result<Self, MeasureError> {
        let clock = Instant::now();
        let specimen = variant.specimen(RISES, seed);
        let length = RISES * variant.monomers.rise_nm;
        let turns: Vec<f64> = entries
            .iter()
            .map(|entry| (entry.curvature * length).to_degrees())
            .collect();
        let twisted = twist(&specimen, &turns)?;
        let pulled = stretch_by_force(&specimen, &[PULL_PN])?;
        let at = |turn: &f64| {
            let near = |p: &&crate::measure::TwistPoint| (p.turn_deg - turn).abs() < 1e-6;
            let found = twisted.points.iter().find(near);
            found.map_or([f64::NAN; 2], |p| {
                [p.rigidity_pn_nm2, p.relative_length_change]
            })
        };
        let twists: Vec<[f64; 2]> = turns.iter().map(at).collect();
        let bent = (seed < BENT_SAMPLINGS as u64).then(|| Bent::of(variant, seed));
        let unstable = |evidence: &Evidence| !evidence.is_stable();
        Ok(Self {
            b3: twists.iter().map(|t| t[0]).collect(),
            change: twists.iter().map(|t| t[1]).collect(),
            s3: pulled.points.first().map_or(f64::NAN, |p| p.rigidity_pn),
            bent: bent.transpose()?,
            doubtful: twisted.unreached.len()
                + twisted
                    .points
                    .iter()
                    .filter(|p| unstable(&p.evidence))
                    .count(),
            seconds: clock.elapsed().as_secs_f64(),
        })
    }
}

impl Bent {
    fn of(variant: &Variant, seed: u64) -> Result<Self, MeasureError> {
        let specimen = variant.specimen(BENT_RISES, seed);
        let mut curves = Vec::new();
        let mut shears = Vec::new();
        for azimuth in AZIMUTHS_DEG {
            curves.push(bend_by_couples(&specimen, &CURVATURES, azimuth)?);
            shears.push(shear_by_force(&specimen, &[SHEAR_PN], azimuth)?);
        }
        let at = |i: usize| {
            let points = curves.iter().map(|curve| curve.points.get(i));
            mean(points.map(|p| p.map_or(f64::NAN, |p| p.rigidity_pn_nm2)))
        };
        let sheared = shears.iter().flat_map(|curve| &curve.points);
        Ok(Self {
            b1: [at(0), at(1)],
            shear: mean(sheared.map(|p| p.apparent_rigidity_pn)),
        })
    }
}

/// Root mean square; not a number of nothing.
fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    mean(values.into_iter().map(|x| x * x)).sqrt()
}

/// Arithmetic mean; not a number of nothing.
pub(super) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    spread(values).0
}

/// Mean, and standard deviation of a single value; 0 of one.
pub(super) fn spread(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let values: Vec<f64> = values.into_iter().collect();
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, (squares / (n - 1.0).max(1.0)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Differences by hand: one entry is compared, another is too small an angle.
    #[test]
    fn differences_are_those_to_the_paper() {
        let entry = |phi_deg: f64, value: f64| Entry {
            phi_deg,
            curvature: -phi_deg * 2.3e-4,
            value,
            rounding: 0.0,
        };
        let measured = Measured {
            b3: vec![
                (entry(10.0, 500.0), 5000.0, 0.0),
                (entry(40.0, 3500.0), 3150.0, 0.0),
            ],
            change: vec![(entry(40.0, 0.0003), 0.0013)],
            s3: 3.23e4,
            b1: [3.0e4, 4.095e4],
            shear: 0.0,
            doubtful: 0,
            seconds: 0.0,
        };
        let expected = [0.1, 0.001, -0.05, 0.05];
        for (ours, expected) in measured.differences().into_iter().zip(expected) {
            assert!((ours - expected).abs() < 1e-12, "{ours} {expected}");
        }
        assert_eq!(measured.b3_at(-40.0).to_bits(), 3150.0_f64.to_bits());
        assert!(measured.b3_at(40.0).is_nan());
    }
}
