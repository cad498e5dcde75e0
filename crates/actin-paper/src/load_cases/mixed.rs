//! Rods joined to the mean filament, at every resolution: how far results lie apart.

use super::bound::Group;
use super::case::{Case, Kind};
use super::filament::{Made, RISE_NM, Rod};
use super::row::Row;
use super::solve::{BUCKLED, Found, solve};
use crate::measure::Sampled;
use actin_sim::RodLaw;
use rayon::prelude::*;

/// Lengths of rod at the tip of a cantilever (nm), as in Figure 4.
const AT_TIP_NM: [f64; 7] = [20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0];
/// Lengths of rod at both ends of a buckled filament together (nm), as in Figures 8 and 10.
const AT_ENDS_NM: [f64; 7] = [40.0, 73.0, 107.0, 140.0, 173.0, 207.0, 240.0];

/// Where the rods are, and what is compared.
struct Set {
    case: Case,
    quantities: &'static [&'static str],
    stretches: fn(f64) -> Vec<[f64; 2]>,
    lengths_nm: Vec<f64>,
}

/// Every third length if `quick`, and not the under-twisted filament.
fn sets(quick: bool) -> Vec<Set> {
    let chosen = |lengths: [f64; 7]| -> Vec<f64> {
        let step = if quick { 3 } else { 1 };
        lengths.into_iter().step_by(step).collect()
    };
    let turns: &[f64] = if quick { &[180.0] } else { &[180.0, -180.0] };
    let mut all = vec![at_tip(chosen(AT_TIP_NM))];
    all.extend(turns.iter().map(|&turn| at_ends(turn, chosen(AT_ENDS_NM))));
    all
}

fn at_tip(lengths_nm: Vec<f64>) -> Set {
    Set {
        case: Case {
            group: Group::Mixed,
            name: "Figure 4, rod at the tip".to_owned(),
            kind: Kind::Cantilever {
                rises: 58,
                tension_pn: 0.0,
                forces_pn: vec![2.0],
            },
        },
        quantities: &["tip at 2 pN (nm)"],
        stretches: |nm| {
            let tip = 58.5 * RISE_NM;
            vec![[tip - nm, tip]]
        },
        lengths_nm,
    }
}

fn at_ends(turn_deg: f64, lengths_nm: Vec<f64>) -> Set {
    Set {
        case: Case {
            group: Group::Mixed,
            name: format!("Figures 8 and 10, {turn_deg:+} deg, rods at the ends"),
            kind: Kind::Buckled { turn_deg },
        },
        quantities: &["height (nm)", "couple (pN nm)"],
        stretches: |nm| {
            let length = f64::from(BUCKLED) * RISE_NM;
            vec![[0.0, 0.5 * nm], [length - 0.5 * nm, length]]
        },
        lengths_nm,
    }
}

/// All rows of a law.
pub(super) fn rows(name: &str, law: &RodLaw, quick: bool) -> Vec<Row> {
    let sets = sets(quick);
    sets.iter().flat_map(|set| set.rows(name, law)).collect()
}

impl Set {
    fn rows(&self, name: &str, law: &RodLaw) -> Vec<Row> {
        let made = |&nm: &f64| Made::Mixed {
            rod: Rod::coarse(law),
            stretches: (self.stretches)(nm),
            azimuth_deg: 0.0,
        };
        let solved = self
            .lengths_nm
            .par_iter()
            .map(|nm| solve(&self.case, &made(nm)));
        let solved: Vec<Result<Found, String>> = solved.collect();
        let quantities = self.quantities.iter();
        quantities
            .map(|quantity| self.row(name, quantity, &solved))
            .collect()
    }

    fn row(&self, law: &str, quantity: &str, solved: &[Result<Found, String>]) -> Row {
        let each = self.lengths_nm.iter().zip(solved);
        let found = |(nm, solved): (&f64, &Result<Found, String>)| {
            Some((*nm, solved.as_ref().ok()?.value(quantity)?))
        };
        let values: Vec<(f64, f64)> = each.filter_map(found).collect();
        let is_whole = values.len() == solved.len();
        let sampled = Sampled::of(values.iter().map(|v| v.1));
        let spread = spread(&values.iter().map(|v| v.1).collect::<Vec<_>>());
        let list: Vec<String> = values
            .iter()
            .map(|(nm, value)| format!("{nm}: {value:.4}"))
            .collect();
        let failures: Vec<&str> = solved
            .iter()
            .filter_map(|s| Some(s.as_ref().err()?.as_str()))
            .collect();
        let note = [vec![format!("{quantity} by nm of rod:")], list]
            .concat()
            .join(" ");
        Row {
            group: Group::Mixed,
            case: self.case.name.clone(),
            quantity: quantity.to_owned(),
            law: law.to_owned(),
            mean: None,
            drawn: None,
            rod: (!values.is_empty()).then_some(sampled.mean),
            fine: None,
            rod_of_drawn: None,
            error_mean: spread.filter(|_| is_whole),
            error_drawn: None,
            error_fine: None,
            scatter: None,
            bound: Group::Mixed.bound(quantity),
            note: if failures.is_empty() {
                note
            } else {
                format!("{note}; {}", failures.join("; "))
            },
        }
    }
}

/// Largest minus smallest value over the size of their mean; none of none.
pub(super) fn spread(values: &[f64]) -> Option<f64> {
    let largest = values.iter().copied().reduce(f64::max)?;
    let smallest = values.iter().copied().reduce(f64::min)?;
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    Some((largest - smallest) / mean.abs())
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn spreads_are_relative_to_the_mean() {
        assert_eq!(spread(&[-9.0, -11.0, -10.0]), Some(0.2));
        assert_eq!(spread(&[]), None);
    }
}
