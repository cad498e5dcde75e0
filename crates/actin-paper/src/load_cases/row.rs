//! Comparison of one law with monomers in one quantity of one case.

use super::case::{Bound, Group};
use super::solve::CaseSolution;
use crate::measure::SampleStatistics;

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Row {
    pub group: Group,
    pub case: String,
    pub quantity: String,
    pub law: String,
    /// Mean filament, over azimuths.
    pub mean: Option<SampleStatistics>,
    /// Filaments with sampled bonds, over samplings and azimuths.
    pub drawn: Option<SampleStatistics>,
    /// Rods with segments of 10 nm, with segments of 2.5 nm, and with segments of 10 nm for sampled
    /// bonds.
    pub rod: Option<f64>,
    pub fine: Option<f64>,
    pub rod_of_drawn: Option<f64>,
    /// Errors of the rod against the mean filament, against filaments with sampled bonds, and of
    /// the fine rod against the mean filament. They are relative, distances of centre lines (nm),
    /// or spreads over resolutions.
    pub error_mean: Option<f64>,
    pub error_drawn: Option<f64>,
    pub error_fine: Option<f64>,
    /// Standard deviation of single filaments with sampled bonds, in the unit of the errors.
    pub scatter: Option<f64>,
    pub bound: Bound,
    pub note: String,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Monomers {
    pub mean: Vec<CaseSolution>,
    /// Filaments with sampled bonds.
    pub drawn: Vec<CaseSolution>,
    /// Filaments without an equilibrium.
    pub failures: Vec<String>,
}

/// Rods with segments of 10 nm, with segments of 2.5 nm, and with segments of 10 nm for sampled
/// bonds.
pub(super) type Rods = [Result<CaseSolution, String>; 3];

/// Difference of writhe (turns) that distinguishes two equilibria.
const OTHER_STATE: f64 = 0.1;

impl Row {
    pub(super) fn open(group: Group, case: &str, quantity: &str, law: &str) -> Self {
        Self {
            group,
            case: case.to_owned(),
            quantity: quantity.to_owned(),
            law: law.to_owned(),
            bound: group.bound(quantity),
            ..Self::default()
        }
    }

    /// Returns whether the rod is within the bound, against the mean filament and against sampled
    /// bonds; `None` without a bound or error. A rod without an equilibrium is not within it.
    pub(super) fn is_met(&self) -> [Option<bool>; 2] {
        let against = |error: Option<f64>| {
            let error = error.unwrap_or(f64::INFINITY);
            self.bound.is_met(error, self.scatter)
        };
        let has_drawn = !matches!(self.bound, Bound::Spread(_));
        [
            against(self.error_mean),
            has_drawn.then(|| against(self.error_drawn)).flatten(),
        ]
    }

    /// Ratios of the errors to the bound, against the mean filament and against sampled bonds.
    pub(super) fn shares_of_bound(&self) -> [Option<f64>; 2] {
        let bound = self.bound.size(self.scatter);
        let share = |error: Option<f64>| Some(error?.abs() / bound?);
        [self.error_mean, self.error_drawn].map(share)
    }
}

pub(super) fn rows(
    group: Group,
    case: &str,
    law: &str,
    monomers: &Monomers,
    rods: &Rods,
) -> Vec<Row> {
    let first = monomers.mean.first();
    let names = first.map_or(&[][..], |found| &found.values).iter();
    let row = |quantity: &str| Row {
        note: note(monomers, rods),
        ..Row::open(group, case, quantity, law)
    };
    let mut all: Vec<Row> = names
        .map(|(name, _)| value_row(row(name), monomers, rods))
        .collect();
    if first.is_some_and(|found| found.line.is_some()) {
        all.push(shape_row(row("shape"), monomers, rods));
    }
    all
}

fn value_row(row: Row, monomers: &Monomers, rods: &Rods) -> Row {
    let sampled = |found: &[CaseSolution]| {
        let values: Vec<f64> = found
            .iter()
            .filter_map(|f| f.value(&row.quantity))
            .collect();
        (!values.is_empty()).then(|| SampleStatistics::from_values(values))
    };
    let [rod, fine, rod_of_drawn] = rods
        .each_ref()
        .map(|rod| rod.as_ref().ok()?.value(&row.quantity));
    let (mean, drawn) = (sampled(&monomers.mean), sampled(&monomers.drawn));
    let error = |rod: Option<f64>, of: Option<SampleStatistics>| {
        rod.zip(of).map(|(rod, of)| (rod - of.mean) / of.mean.abs())
    };
    Row {
        error_mean: error(rod, mean),
        error_drawn: error(rod_of_drawn, drawn),
        error_fine: error(fine, mean),
        scatter: drawn
            .map(|d| d.deviation / d.mean.abs())
            .filter(|s| s.is_finite()),
        mean,
        drawn,
        rod,
        fine,
        rod_of_drawn,
        ..row
    }
}

/// Largest distances of centre lines (nm), averaged over filaments.
fn shape_row(row: Row, monomers: &Monomers, rods: &Rods) -> Row {
    let mean_of = |distances: Vec<f64>| {
        (!distances.is_empty()).then(|| distances.iter().sum::<f64>() / distances.len() as f64)
    };
    let between = |a: &CaseSolution, b: &CaseSolution| {
        let lines = a.line.as_ref().zip(b.line.as_ref());
        lines.map(|(a, b)| a.farthest_from(b).0)
    };
    let to = |rod: &Result<CaseSolution, String>, others: &[CaseSolution]| {
        let rod = rod.as_ref().ok()?;
        mean_of(
            others
                .iter()
                .filter_map(|other| between(rod, other))
                .collect(),
        )
    };
    let drawn = &monomers.drawn;
    let pairs = (0..drawn.len()).flat_map(|i| (0..i).map(move |k| (i, k)));
    let apart = pairs.filter_map(|(i, k)| between(&drawn[i], &drawn[k]));
    Row {
        error_mean: to(&rods[0], &monomers.mean),
        error_drawn: to(&rods[2], drawn),
        error_fine: to(&rods[1], &monomers.mean),
        scatter: mean_of(apart.collect()),
        ..row
    }
}

/// Remarks on states that differ, are doubtful, or are missing.
fn note(monomers: &Monomers, rods: &Rods) -> String {
    let mut all = Vec::new();
    let filaments = || monomers.mean.iter().chain(&monomers.drawn);
    let total = filaments().count();
    let mut count = |what: &str, is: &dyn Fn(&CaseSolution) -> bool| {
        let number = filaments().filter(|found| is(found)).count();
        if number > 0 {
            all.push(format!("{number} of {total} filaments of monomers {what}"));
        }
    };
    count("not certified as minima", &|f| f.doubtful > 0);
    count("with jumps", &|f| f.jumps > 0);
    count("with paths that ended", &|f| !f.unreached.is_empty());
    if !monomers.failures.is_empty() {
        let number = monomers.failures.len();
        all.push(format!(
            "{number} filaments of monomers without equilibrium"
        ));
    }
    match &rods[0] {
        Ok(rod) => {
            let is_other = |found: &&CaseSolution| {
                let both = found.writhe.zip(rod.writhe);
                both.is_some_and(|(a, b)| (a - b).abs() > OTHER_STATE)
            };
            let others = filaments().filter(is_other).count();
            if others > 0 {
                all.push(format!(
                    "{others} of {total} filaments of monomers in another state"
                ));
            }
            all.extend((rod.doubtful > 0).then(|| "rod not certified".to_owned()));
            all.extend(rod.unreached.iter().map(|why| format!("rod: {why}")));
        }
        Err(error) => all.push(format!("rod: {error}")),
    }
    all.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(tip: f64) -> CaseSolution {
        CaseSolution {
            values: vec![("tip".to_owned(), tip)],
            ..CaseSolution::default()
        }
    }

    /// A rod of 10.1 against a mean of 10 is 1 % off and within a bound of 2 %; against softer
    /// sampled filaments it is outside.
    #[test]
    fn errors_count_against_both() {
        let monomers = |drawn: [f64; 2]| Monomers {
            mean: vec![found(9.9), found(10.1)],
            drawn: drawn.map(found).into(),
            failures: Vec::new(),
        };
        let rods = || [Ok(found(10.1)), Ok(found(10.0)), Ok(found(10.1))];
        let row = |drawn| rows(Group::Cantilever, "c", "Law", &monomers(drawn), &rods()).remove(0);
        let near = row([9.9, 10.1]);
        assert!((near.error_mean.unwrap() - 0.01).abs() < 1e-12);
        assert!(near.error_fine.unwrap().abs() < 1e-12);
        assert_eq!(near.is_met(), [Some(true); 2]);
        let far = row([10.5, 10.7]);
        assert_eq!(far.is_met(), [Some(true), Some(false)]);
        assert!((far.shares_of_bound()[1].unwrap() - (0.5 / 10.6) / 0.02).abs() < 1e-9);
        let lost: Rods = [(); 3].map(|()| Err("no".into()));
        let rows = rows(Group::Cantilever, "c", "Law", &monomers([9.9, 10.1]), &lost);
        assert_eq!(rows[0].is_met(), [Some(false); 2]);
        assert_eq!(rows[0].note, "rod: no");
    }
}
