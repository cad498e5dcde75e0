//! Spread of results over resolutions, for rods joined to the mean filament.

use super::case::{Case, Group, Loading};
use super::filament::{FilamentModel, RISE_NM};
use super::row::Row;
use super::solve::{CaseSolution, solve};
use crate::statistics::sample;
use actin_sim::RodLaw;
use rayon::prelude::*;
use std::fmt::Write as _;

/// Lengths of rod (nm): at the tip of a cantilever (Figure 4), and at both ends of a buckled
/// filament (Figures 8 and 10).
const AT_TIP_NM: [f64; 7] = [20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0];
const AT_ENDS_NM: [f64; 7] = [40.0, 73.0, 107.0, 140.0, 173.0, 207.0, 240.0];

/// A case, its compared quantities, the rod sections for a length of rod, and the lengths (nm).
struct Set {
    case: Case,
    quantities: &'static [&'static str],
    stretches: fn(f64, f64) -> Vec<[f64; 2]>,
    lengths_nm: [f64; 7],
}

/// All rows of a law. A quick run has every third length, without the under-twisted filament.
pub(super) fn rows(name: &str, law: &RodLaw, quick: bool) -> Vec<Row> {
    let tip = "Figure 4, rod at the tip".to_owned();
    let mut sets = vec![Set {
        case: Case::forces(Group::Mixed, tip, 58.5, (None, 0.0, &[2.0])),
        quantities: &["tip at 2 pN (nm)"],
        stretches: |rod, whole| vec![[whole - rod, whole]],
        lengths_nm: AT_TIP_NM,
    }];
    let turns: &[f64] = if quick { &[180.0] } else { &[180.0, -180.0] };
    sets.extend(turns.iter().map(|&turn_deg| {
        let name = format!("Figures 8 and 10, {turn_deg:+} deg, rods at the ends");
        Set {
            case: Case::new(Group::Mixed, name, 110.0, Loading::Buckled { turn_deg }),
            quantities: &["height (nm)", "couple (pN nm)"],
            stretches: |rod, whole| vec![[0.0, 0.5 * rod], [whole - 0.5 * rod, whole]],
            lengths_nm: AT_ENDS_NM,
        }
    }));
    let rows = sets.iter().flat_map(|set| set.rows(name, law, quick));
    rows.collect()
}

impl Set {
    fn rows(&self, law_name: &str, law: &RodLaw, quick: bool) -> Vec<Row> {
        let whole = self.case.rises * RISE_NM;
        let step = if quick { 3 } else { 1 };
        let lengths: Vec<f64> = self.lengths_nm.into_iter().step_by(step).collect();
        let solved = lengths.par_iter().map(|&nm| {
            let stretches = (self.stretches)(nm, whole);
            let mixed = FilamentModel::mean(0.0).with_rods(law, stretches);
            (nm, solve(&self.case, &mixed))
        });
        let solved: Vec<(f64, Result<CaseSolution, String>)> = solved.collect();
        let row = |&quantity: &&str| self.row(law_name, quantity, &solved);
        self.quantities.iter().map(row).collect()
    }

    fn row(
        &self,
        law: &str,
        quantity: &str,
        solved: &[(f64, Result<CaseSolution, String>)],
    ) -> Row {
        let (mut values, mut note) = (Vec::new(), format!("{quantity} by nm of rod:"));
        let mut failures = String::new();
        for (nm, found) in solved {
            match found {
                Ok(found) => {
                    let value = found.value(quantity).unwrap_or(f64::NAN);
                    values.push(value);
                    _ = write!(note, " {nm}: {value:.4}");
                }
                Err(error) => _ = write!(failures, "; {error}"),
            }
        }
        let is_whole = values.len() == solved.len();
        let s = sample(values);
        Row {
            rod: (s.count > 0).then_some(s.mean),
            error_mean: is_whole.then_some(s.spread().abs()),
            note: note + &failures,
            ..Row::open(Group::Mixed, &self.case.name, quantity, law)
        }
    }
}
