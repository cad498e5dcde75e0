//! Number of equilibria from several starts, and effect of the order of twist and compression.

use super::case::{Case, Start, turn_name};
use super::solve::Outcome;
use super::{OBSERVABLES, Plan, Results};
use crate::figures::draft::Draft;
use crate::statistics::largest;

/// Tolerances of energy (pN nm), height (nm) and torque (pN nm) for equal equilibria. They exceed the effect of the
/// symmetry-breaking force, 1e-3 pN over 40 nm.
const SAME: (f64, f64, f64) = (0.1, 0.03, 0.3);

pub(super) fn rows(plan: &Plan, draft: &mut Draft<'_>, results: &Results) {
    for &turn in plan.turns {
        order_differences(plan, draft, results, turn);
        if !plan.started.contains(&turn) {
            continue;
        }
        for case in plan.shown_at(turn) {
            distinct_row(plan, draft, results, case);
            lowest_row(draft, results, case);
        }
    }
}

fn order_differences(plan: &Plan, draft: &mut Draft<'_>, results: &Results, turn: i32) {
    let pairs = plan.shown_at(turn).filter_map(|case| {
        let start = Start::COMPRESSION_FIRST;
        Some((results.of(case)?, results.of(Case { start, ..case })?))
    });
    let pairs: Vec<(&Outcome, &Outcome)> = pairs.collect();
    if pairs.is_empty() {
        return;
    }
    for (name, unit, of) in OBSERVABLES {
        let difference = |(twist, compression): &(&Outcome, &Outcome)| {
            of(&compression.measured) - of(&twist.measured)
        };
        let each: Vec<String> = pairs
            .iter()
            .map(|pair| format!("{} {:+.3}", pair.0.case.resolution.name(), difference(pair)))
            .collect();
        let note = format!(
            "largest of compression first minus twist first, seed 0: {}",
            each.join(", ")
        );
        let value = largest(pairs.iter().map(|pair| difference(pair).abs()));
        let quantity = format!("order_difference/{name}/{}", turn_name(turn));
        draft.row(quantity, unit, value, note);
    }
}

fn distinct_row(plan: &Plan, draft: &mut Draft<'_>, results: &Results, case: Case) {
    let outcomes = results.of_all_starts(plan, case);
    let distinct = distinct(&outcomes);
    let Some(first) = distinct.first() else {
        return;
    };
    let each: Vec<String> = distinct
        .iter()
        .map(|kind| {
            let m = &kind[0].measured;
            format!(
                "{} x {:.2} nm, {:.1} pN nm, energy {:.2}",
                kind.len(),
                m.height_nm,
                m.couple_pn_nm,
                m.energy_pn_nm
            )
        })
        .collect();
    let note = format!(
        "from {} starts (order, direction of the symmetry-breaking force, step), seed 0; by energy: {}; lowest from {}",
        outcomes.len(),
        each.join("; "),
        first[0].case.start.name()
    );
    let quantity = format!("distinct_equilibria/{}", case.path());
    draft.row(quantity, "", distinct.len() as f64, note);
}

fn lowest_row(draft: &mut Draft<'_>, results: &Results, case: Case) {
    let Some(others) = results.of(case).and_then(|o| o.states) else {
        return;
    };
    let note = format!(
        "energy of the state at the end of the path, seed 0, relative to the lowest of {} stable states from {} \
         random initial guesses",
        others.count, others.starts
    );
    let quantity = format!("above_lowest_state/{}", case.path());
    draft.row(quantity, "pN nm", others.above_lowest_pn_nm, note);
}

/// Groups equal equilibria by ascending energy.
fn distinct<'a>(outcomes: &[&'a Outcome]) -> Vec<Vec<&'a Outcome>> {
    let mut sorted = outcomes.to_vec();
    sorted.sort_by(|a, b| a.measured.energy_pn_nm.total_cmp(&b.measured.energy_pn_nm));
    let mut kinds: Vec<Vec<&Outcome>> = Vec::new();
    for outcome in sorted {
        match kinds.iter_mut().find(|kind| is_same(kind[0], outcome)) {
            Some(kind) => kind.push(outcome),
            None => kinds.push(vec![outcome]),
        }
    }
    kinds
}

pub(super) fn is_same(a: &Outcome, b: &Outcome) -> bool {
    let (a, b) = (&a.measured, &b.measured);
    (a.energy_pn_nm - b.energy_pn_nm).abs() < SAME.0
        && (a.height_nm - b.height_nm).abs() < SAME.1
        && (a.couple_pn_nm - b.couple_pn_nm).abs() < SAME.2
}
