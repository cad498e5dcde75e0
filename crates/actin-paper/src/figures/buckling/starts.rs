//! How many equilibria there are: the same filament from several starts, and what the order of
//! twist and compression changes.

use super::case::{Case, Order, Start};
use super::lists::Plan;
use super::outcome::Outcome;
use super::resolved::Resolved;
use super::results::{OBSERVABLES, Observable, Results};
use actin_draw::report::Row;

/// Equilibria are the same if their energies (pN nm), heights (nm) and couples (pN nm) are within
/// these of each other. The pull that breaks the symmetry does less: 1e-3 pN over 40 nm.
const SAME: (f64, f64, f64) = (0.1, 0.03, 0.3);

/// Rows on starts and orders.
pub(super) fn rows(plan: &Plan, results: &Results) -> Vec<Row> {
    let mut all = Vec::new();
    for &turn in &plan.turns {
        for observable in OBSERVABLES {
            all.extend(order_difference(plan, results, observable, turn));
        }
        if plan.started.contains(&turn) {
            let resolved = plan.resolved.iter();
            all.extend(
                resolved
                    .clone()
                    .filter_map(|&r| distinct_row(plan, results, r, turn)),
            );
            all.extend(resolved.filter_map(|&r| lowest_row(plan, results, r, turn)));
        }
    }
    all
}

/// Largest difference between both orders over the resolutions, seed 0.
fn order_difference(
    plan: &Plan,
    results: &Results,
    observable: Observable,
    turn: i32,
) -> Option<Row> {
    let compression_first = Start {
        order: Order::CompressionFirst,
        ..Start::DEFAULT
    };
    let difference = |&resolved: &Resolved| {
        let case = Case::new(plan.main(), resolved, turn, 0);
        let value = |case| Some((observable.of)(&results.of(case)?.measured));
        Some((
            resolved,
            value(case.from(compression_first))? - value(case)?,
        ))
    };
    let all: Vec<(Resolved, f64)> = plan.resolved.iter().filter_map(difference).collect();
    let largest = all.iter().map(|d| d.1.abs()).reduce(f64::max)?;
    let each: Vec<String> = all
        .iter()
        .map(|(resolved, d)| format!("{} {d:+.3}", resolved.name()))
        .collect();
    let note = format!(
        "largest of compression first minus twist first, seed 0: {}",
        each.join(", ")
    );
    let quantity = format!(
        "order_difference/{}/{}",
        observable.name,
        Case::turn_name(turn)
    );
    Some(Row::measured(
        plan.figure.id(),
        quantity,
        observable.unit,
        largest,
        note,
    ))
}

/// Number of distinct equilibria of one filament.
fn distinct_row(plan: &Plan, results: &Results, resolved: Resolved, turn: i32) -> Option<Row> {
    let case = Case::new(plan.main(), resolved, turn, 0);
    let outcomes = results.started(case, &plan.starts_at(turn));
    let distinct = distinct(&outcomes);
    let first = distinct.first()?;
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
        "from {} starts (order, plane of the pull, step), seed 0; by energy: {}; lowest from {}",
        outcomes.len(),
        each.join("; "),
        first[0].case.start.name()
    );
    let quantity = format!(
        "distinct_equilibria/{}/{}",
        Case::turn_name(turn),
        resolved.name()
    );
    let count = distinct.len() as f64;
    Some(Row::measured(plan.figure.id(), quantity, "", count, note))
}

/// How far above the lowest state found from random starts the one that the figure shows is.
fn lowest_row(plan: &Plan, results: &Results, resolved: Resolved, turn: i32) -> Option<Row> {
    let others = results
        .of(Case::new(plan.main(), resolved, turn, 0))?
        .states?;
    let note = format!(
        "energy of the state at the end of the path, seed 0, less that of the lowest of {} stable states from {} \
         random starts",
        others.count, others.starts
    );
    let (turn, resolved) = (Case::turn_name(turn), resolved.name());
    let quantity = format!("above_lowest_state/{turn}/{resolved}");
    let above = others.above_lowest_pn_nm;
    Some(Row::measured(
        plan.figure.id(),
        quantity,
        "pN nm",
        above,
        note,
    ))
}

/// Groups equal equilibria, lowest energy first.
pub(super) fn distinct<'a>(outcomes: &[&'a Outcome]) -> Vec<Vec<&'a Outcome>> {
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

/// Whether two outcomes are one equilibrium.
pub(super) fn is_same(a: &Outcome, b: &Outcome) -> bool {
    let (a, b) = (&a.measured, &b.measured);
    (a.energy_pn_nm - b.energy_pn_nm).abs() < SAME.0
        && (a.height_nm - b.height_nm).abs() < SAME.1
        && (a.couple_pn_nm - b.couple_pn_nm).abs() < SAME.2
}
