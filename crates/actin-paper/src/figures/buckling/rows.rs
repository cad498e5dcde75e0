//! Numbers of Figures 8 and 10 as rows of the report: values, spreads and trends.

use super::balance;
use super::case::Case;
use super::expected;
use super::group::{Figure, Group};
use super::lists::Plan;
use super::outcome::{Evidence, Outcome};
use super::resolved::Resolved;
use super::results::{OBSERVABLES, Observable, Results, range};
use crate::figures::bounds::{A_DIFFERENCE, CROSS_CHECK, ROUND_OFF, SHAPE_NM};
use actin_draw::report::{Origin, Row, printed};

/// The extended rod, and what the paper prints or offers for the same.
const EXTENDED: [&str; 3] = ["", "coupling-energy/", "paper-balance/"];

/// All values, then the spreads, group by group.
pub(super) fn rows(plan: &Plan, results: &Results) -> Vec<Row> {
    let mut all = Vec::new();
    for (name, group) in plan.groups() {
        for turn in plan.turns_of(group) {
            for observable in OBSERVABLES {
                for &resolved in &plan.resolved {
                    all.extend(value(results, (name, group), observable, resolved, turn));
                }
                all.extend(spread(plan, results, (name, group), observable, turn));
            }
        }
    }
    all.extend(writhes(plan, results));
    all.extend(link_error(plan.figure, results));
    all.push(uncertified(plan.figure, results));
    all.extend(balance::row(plan.figure.id(), &results.outcomes));
    all
}

/// Writhe of every filament of the first group, the sampling with seed 0.
fn writhes(plan: &Plan, results: &Results) -> Vec<Row> {
    let turns = plan.turns.iter();
    let pairs = turns.flat_map(|&turn| plan.resolved.iter().map(move |&r| (turn, r)));
    let row = |(turn, resolved): (i32, Resolved)| {
        let m = &results
            .of(Case::new(plan.main(), resolved, turn, 0))?
            .measured;
        let note = format!(
            "of the smoothed centre line, seed 0; twist {:.4}, link {:.4} turns",
            m.twist_turns, m.link_turns
        );
        let quantity = format!("writhe/{}/{}", Case::turn_name(turn), resolved.name());
        Some(Row::measured(
            plan.figure.id(),
            quantity,
            "",
            m.writhe,
            note,
        ))
    };
    pairs.filter_map(row).collect()
}

/// Largest deviation of twist plus writhe from link over all equilibria.
fn link_error(figure: Figure, results: &Results) -> Option<Row> {
    let worst = results.outcomes.iter().max_by(|a, b| {
        let error = |o: &Outcome| o.measured.link_error().abs();
        error(a).total_cmp(&error(b))
    })?;
    let note = format!(
        "largest of twist plus writhe minus link over {} equilibria, at {}",
        results.outcomes.len(),
        worst.case.name()
    );
    let value = worst.measured.link_error().abs();
    let row = Row::measured(figure.id(), "link_error", "turns", value, note);
    Some(row.against(0.0, ROUND_OFF).of(Origin::Theory))
}

/// One observable of one filament: the mean over samplings.
fn value(
    results: &Results,
    (name, group): (&str, Group),
    observable: Observable,
    resolved: Resolved,
    turn: i32,
) -> Option<Row> {
    let sample = results.sample(group, resolved, turn, observable.of)?;
    let scatter = match sample.count {
        1 => "one filament".into(),
        count => format!("{count} samplings, sd {:.3}", sample.sd),
    };
    let found: Vec<&Outcome> = results.samplings(group, resolved, turn).collect();
    let note = format!("{scatter}; {}", found_by(&found));
    let expected =
        expected::of(group.figure, observable.name, resolved, turn).filter(|_| name.is_empty());
    let quantity = format!(
        "{name}{}/{}/{}",
        observable.name,
        Case::turn_name(turn),
        resolved.name()
    );
    let row = |note| {
        Row::measured(
            group.figure.id(),
            quantity,
            observable.unit,
            sample.mean,
            note,
        )
    };
    let Some(theirs) = expected else {
        return Some(row(note));
    };
    // With monomers the earlier calculation had other bonds, and a variant is judged nowhere.
    if resolved == Resolved::Rod && name.is_empty() {
        let row = row(format!("{CROSS_CHECK}; {note}")).against_printed(theirs, 0.0);
        return Some(row.of(Origin::CrossCheck));
    }
    let words = "beside an earlier calculation with 32 bonds of any length; not judged";
    let (value, _) = printed(theirs);
    Some(row(format!("{words}; {note}")).beside(value, Origin::CrossCheck))
}

/// How states were found and what is known of them, in words.
fn found_by(outcomes: &[&Outcome]) -> String {
    if let [
        Outcome {
            evidence: Evidence::Motion { time_ns, .. },
            residual: (force, torque),
            ..
        },
    ] = outcomes
    {
        return format!(
            "damped motion of {time_ns:.0} ns from the equilibrium of the law with an energy, \
             residual {force:.1e} pN and {torque:.1e} pN nm"
        );
    }
    let unstable = outcomes.iter().filter(|o| !o.is_stable()).count();
    format!("{unstable} not certified stable")
}

/// Largest minus smallest of the means over all resolutions; of couples, forces and energies
/// relative to their mean.
fn spread(
    plan: &Plan,
    results: &Results,
    (name, group): (&str, Group),
    observable: Observable,
    turn: i32,
) -> Option<Row> {
    let mean = |resolved: &Resolved| {
        let sample = results.sample(group, *resolved, turn, observable.of)?;
        Some((*resolved, sample.mean))
    };
    let means: Vec<(Resolved, f64)> = plan.resolved.iter().filter_map(mean).collect();
    let (low, high) = range(means.iter().map(|m| m.1))?;
    let is_mixed = |m: &&(Resolved, f64)| matches!(m.0, Resolved::Mixed(_));
    let (mixed_low, mixed_high) = range(means.iter().filter(is_mixed).map(|m| m.1))?;
    let average = means.iter().map(|m| m.1).sum::<f64>() / means.len() as f64;
    let is_height = observable.name == "height";
    let (unit, scale) = if is_height {
        ("nm", 1.0)
    } else {
        ("", 1.0 / average)
    };
    let note = format!(
        "{} over {} resolutions, pure cases included: {low:.2} to {high:.2} {}; over mixed ones {:.4}; {}",
        if is_height {
            "max - min"
        } else {
            "(max - min)/mean"
        },
        means.len(),
        observable.unit,
        (mixed_high - mixed_low) * scale,
        trend(&means)
    );
    let quantity = format!("{name}{}_spread/{}", observable.name, Case::turn_name(turn));
    let row = Row::measured(
        group.figure.id(),
        quantity,
        unit,
        (high - low) * scale,
        note,
    );
    Some(judged(row, plan.figure, (name, observable.name), turn))
}

/// The spread judged where extended rods should agree: the paper says that they improve, not by how much.
fn judged(row: Row, figure: Figure, (group, observable): (&str, &str), turn: i32) -> Row {
    match (figure, group, observable, turn) {
        (Figure::Ten, group, "height", 180 | 270) if EXTENDED.contains(&group) => {
            row.against(0.0, SHAPE_NM).of(Origin::Bound)
        }
        (Figure::Ten, group, "couple", -180) if EXTENDED.contains(&group) => {
            row.against(0.0, A_DIFFERENCE).of(Origin::Bound)
        }
        _ => row,
    }
}

/// How the means go from all rod to all monomers, in words.
fn trend(means: &[(Resolved, f64)]) -> String {
    let steps = || means.windows(2).map(|pair| pair[1].1 - pair[0].1);
    let total: f64 = steps().sum();
    let against = steps().filter(|step| step * total < 0.0).count();
    let direction = if total < 0.0 { "falls" } else { "rises" };
    let steps = steps().count();
    let values: Vec<String> = means.iter().map(|m| format!("{:.2}", m.1)).collect();
    format!(
        "from rod to ellipsoids it {direction} by {:.2}, {against} of {steps} steps go the other way ({})",
        total.abs(),
        values.join(", ")
    )
}

/// Equilibria without a certificate of stability, and paths that ended early.
fn uncertified(figure: Figure, results: &Results) -> Row {
    let solved = results.outcomes.iter().filter(|o| o.is_solved());
    let unstable = solved.clone().filter(|o| !o.is_stable());
    let names: Vec<String> = unstable.map(|o| o.case.name()).collect();
    let worst = |pick: fn(&(f64, f64)) -> f64| {
        let residuals = solved.clone().map(|o| pick(&o.residual));
        residuals.fold(0.0, f64::max)
    };
    let note = format!(
        "of {} equilibria, largest residual {:.1e} pN and {:.1e} pN nm; {}; paths that ended \
         early: {} {}",
        solved.clone().count(),
        worst(|r| r.0),
        worst(|r| r.1),
        names.join(", "),
        results.failures.len(),
        results.failures.join("; ")
    );
    let count = (names.len() + results.failures.len()) as f64;
    Row::measured(figure.id(), "not_certified_stable", "", count, note)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fall with one step up is told as such.
    #[test]
    fn trends_say_what_goes_the_other_way() {
        let means = [3.0, 2.0, 2.5, 1.0].map(|value| (Resolved::Rod, value));
        let words = trend(&means);
        assert!(
            words.starts_with("from rod to ellipsoids it falls by 2.00, 1 of 3"),
            "{words}"
        );
    }
}
