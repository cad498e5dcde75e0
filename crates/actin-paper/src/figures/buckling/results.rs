//! The outcomes of a figure, and samples of them.

use super::case::{Case, Start};
use super::group::Group;
use super::outcome::{Measured, Outcome};
use super::resolved::Resolved;

/// What came out of all cases.
#[derive(Clone, Debug)]
pub(super) struct Results {
    pub outcomes: Vec<Outcome>,
    /// Cases that ended without an equilibrium, in words.
    pub failures: Vec<String>,
}

/// An observable.
#[derive(Clone, Copy, Debug)]
pub(super) struct Observable {
    pub name: &'static str,
    pub unit: &'static str,
    pub of: fn(&Measured) -> f64,
}

/// What does not depend on the plane of buckling.
pub(super) const OBSERVABLES: [Observable; 4] = [
    Observable {
        name: "height",
        unit: "nm",
        of: |m| m.height_nm,
    },
    Observable {
        name: "couple",
        unit: "pN nm",
        of: |m| m.couple_pn_nm,
    },
    Observable {
        name: "force",
        unit: "pN",
        of: |m| m.force_pn,
    },
    Observable {
        name: "energy",
        unit: "pN nm",
        of: |m| m.energy_pn_nm,
    },
];

/// Mean and standard deviation over samplings of the bonds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub count: usize,
    pub mean: f64,
    /// Of a single filament; zero of one.
    pub sd: f64,
}

impl Results {
    /// Samplings of one filament from the default start.
    pub(super) fn samplings(
        &self,
        group: Group,
        resolved: Resolved,
        turn_deg: i32,
    ) -> impl Iterator<Item = &Outcome> {
        let wanted = Case::new(group, resolved, turn_deg, 0);
        self.outcomes.iter().filter(move |outcome| {
            let seed = outcome.case.seed;
            outcome.case == Case { seed, ..wanted }
        })
    }

    /// The outcome of one case.
    pub(super) fn of(&self, case: Case) -> Option<&Outcome> {
        self.outcomes.iter().find(|outcome| outcome.case == case)
    }

    /// Outcomes of one filament, seed 0, from the given starts.
    pub(super) fn started(&self, case: Case, starts: &[Start]) -> Vec<&Outcome> {
        let found = starts.iter().filter_map(|&start| self.of(case.from(start)));
        found.collect()
    }

    /// Mean and scatter of an observable; none where nothing was found.
    pub(super) fn sample(
        &self,
        group: Group,
        resolved: Resolved,
        turn_deg: i32,
        of: fn(&Measured) -> f64,
    ) -> Option<Sample> {
        let outcomes = self.samplings(group, resolved, turn_deg);
        let values: Vec<f64> = outcomes.map(|o| of(&o.measured)).collect();
        sample(&values)
    }
}

fn sample(values: &[f64]) -> Option<Sample> {
    let count = values.len();
    let mean = values.iter().sum::<f64>() / count as f64;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    let sd = (squares / count.saturating_sub(1).max(1) as f64).sqrt();
    (count > 0).then_some(Sample { count, mean, sd })
}

/// Smallest and largest of some values; none of none.
pub(super) fn range(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values.into_iter().fold(None, |range, value| {
        let (low, high) = range.unwrap_or((value, value));
        Some((value.min(low), value.max(high)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1, 2, 3: mean 2, sd 1. One value has no scatter, none no mean.
    #[test]
    fn samples_are_those_of_statistics() {
        let three = sample(&[1.0, 2.0, 3.0]).unwrap();
        assert_eq!((three.count, three.mean, three.sd), (3, 2.0, 1.0));
        // One value differs from its mean by nothing.
        assert!(sample(&[7.0]).unwrap().sd.abs() < f64::EPSILON);
        assert!(sample(&[]).is_none());
        assert_eq!(range([2.0, -1.0, 0.5]), Some((-1.0, 2.0)));
    }
}
