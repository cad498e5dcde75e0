//! Rows and tables of Figures 8 and 10.

use super::case::turn_name;
use super::solve::{Motion, Outcome, STOP};
use super::starts::is_same;
use super::{OBSERVABLES, Observable, Plan, Results};
use crate::figures::draft::{Column, Draft, number, text};
use crate::figures::expected::Holds;
use crate::figures::model::{Model, Resolution};
use crate::statistics::{largest, sample};

const EXTENDED: [&str; 3] = ["", "coupling-energy/", "paper-balance/"];
/// Largest turn (deg) with verdicts. Larger turns have many equilibria.
const JUDGED_DEG: i32 = 270;

pub(super) fn rows(plan: &Plan, draft: &mut Draft<'_>, results: &Results) {
    for &model in &plan.models {
        for turn in plan.turns_of(model) {
            for observable in OBSERVABLES {
                values(plan, draft, results, (model, turn), observable);
            }
        }
    }
    improvements(plan, draft);
    for &turn in plan.turns {
        for found in plan.shown_at(turn).filter_map(|case| results.of(case)) {
            let m = &found.measured;
            let note = format!(
                "of the smoothed centre line, seed 0; twist {:.4}, link {:.4} turns",
                m.twist_turns, m.link_turns
            );
            let quantity = format!("writhe/{}", found.case.path());
            draft.row(quantity, "", m.writhe, note);
        }
    }
    checks(draft, results);
}

/// Rows of the means over samplings of an observable, and of their spread over resolutions. The spread is absolute for
/// heights and relative to the mean otherwise.
fn values(
    plan: &Plan,
    draft: &mut Draft<'_>,
    results: &Results,
    (model, turn): (&'static Model, i32),
    (name, unit, of): Observable,
) {
    let mut means: Vec<(Resolution, f64)> = Vec::new();
    for &resolution in &plan.resolutions {
        let case = plan.case(model, resolution, turn, 0);
        let Some(s) = results.sample(case, of) else {
            continue;
        };
        let scatter = match s.count {
            1 => "one filament".into(),
            count => format!("{count} samplings, sd {:.3}", s.sd()),
        };
        let found: Vec<&Outcome> = results.samplings(case).collect();
        let quantity = format!("{}{name}/{}", model.name, case.path());
        let note = format!("{scatter}; {}", found_by(&found));
        draft.row(quantity, unit, s.mean, note);
        means.push((resolution, s.mean));
    }
    if means.is_empty() {
        return;
    }
    let all = sample(means.iter().map(|m| m.1));
    let mixed = means.iter().filter(|m| m.0.is_mixed());
    let mixed = sample(mixed.map(|m| m.1));
    let (what, unit, scale) = match name {
        "height" => ("max - min", unit, 1.0),
        _ => ("(max - min)/mean", "", 1.0 / all.mean),
    };
    let listed: Vec<String> = means.iter().map(|m| format!("{:.2}", m.1)).collect();
    let note = format!(
        "{what} over {} resolutions, pure cases included; over mixed ones {:.4}; from rod to ellipsoids {}",
        all.count,
        mixed.range() * scale,
        listed.join(", ")
    );
    let quantity = format!("{}{name}_spread/{}", model.name, turn_name(turn));
    draft.row(quantity, unit, all.range() * scale, note);
}

fn found_by(outcomes: &[&Outcome]) -> String {
    if let [only] = outcomes
        && !only.is_solved()
    {
        let [force, torque] = only.residual;
        return format!(
            "damped motion of {:.0} ns from the equilibrium of the rod with an energy, residual {force:.1e} pN and \
             {torque:.1e} pN nm",
            only.time_ns
        );
    }
    let unstable = outcomes.iter().filter(|o| !o.is_stable()).count();
    format!("{unstable} not certified stable")
}

/// Claims that the extensions reduce the spread over resolutions.
fn improvements(plan: &Plan, draft: &mut Draft<'_>) {
    for &turn_deg in plan.turns {
        let turn = turn_name(turn_deg);
        for model in EXTENDED {
            for name in ["height", "couple"] {
                let extended = draft.value(&format!("{model}{name}_spread/{turn}"));
                let constant = draft.value(&format!("standard/{name}_spread/{turn}"));
                let (Some(extended), Some(constant)) = (extended, constant) else {
                    continue;
                };
                let statement = format!(
                    "the extended rod improves the agreement between resolutions; ratio of the spread of the {name} \
                     to the spread with constant rigidities, {extended:.3} over {constant:.3}"
                );
                let is_judged = turn_deg.abs() <= JUDGED_DEG;
                let bound = is_judged.then_some((Holds::AtMost, 1.0));
                let quantity = format!("{name}_improves/{model}{turn}");
                draft.claim(&quantity, extended / constant, bound, statement);
            }
        }
    }
}

fn checks(draft: &mut Draft<'_>, results: &Results) {
    let outcomes = &results.outcomes;
    let note = format!(
        "largest error of twist plus writhe minus link over {} states",
        outcomes.len()
    );
    let error = largest(outcomes.iter().map(|o| o.measured.link_error()));
    draft.row("link_error", "turns", error, note);
    let solved = || outcomes.iter().filter(|o| o.is_solved());
    let unstable = solved().filter(|o| !o.is_stable());
    let names: Vec<String> = unstable.map(|o| o.case.name()).collect();
    let worst = |k: usize| largest(solved().map(|o| o.residual[k]));
    let note = format!(
        "of {} equilibria, largest residual {:.1e} pN and {:.1e} pN nm; {}; paths that ended early: {} {}",
        solved().count(),
        worst(0),
        worst(1),
        names.join(", "),
        results.failures.len(),
        results.failures.join("; ")
    );
    let count = names.len() + results.failures.len();
    draft.row("not_certified_stable", "", count as f64, note);
    let moved = outcomes.iter().filter(|o| !o.is_solved());
    let residuals: Vec<f64> = moved.map(|o| o.residual[0].max(o.residual[1])).collect();
    if !residuals.is_empty() {
        let open = residuals.iter().filter(|r| **r > STOP).count();
        let note = format!(
            "largest residual force (pN) or torque (pN nm) at the end of {} damped motions with the balance as \
             printed; {open} exceed {STOP}",
            residuals.len()
        );
        draft.row("paper-balance/residual", "", largest(residuals), note);
    }
}

/// Rows of the difference between the end of a motion and its equilibrium, and of the number of starts that reach it.
pub(super) fn motions(plan: &Plan, draft: &mut Draft<'_>, results: &Results) {
    for Motion { end, nearest } in &results.motions {
        let path = end.case.path();
        let note = format!(
            "end of damped motion, residual {:.1e} pN and {:.1e} pN nm, minus the equilibrium of Newton's \
             method from there; certified stable: {}",
            end.residual[0],
            end.residual[1],
            nearest.is_stable()
        );
        for (name, unit, of) in OBSERVABLES {
            let value = of(&end.measured) - of(&nearest.measured);
            let quantity = format!("dynamics_difference/{name}/{path}");
            draft.row(quantity, unit, value, &*note);
        }
        let found = results.of_all_starts(plan, end.case);
        let same = found.iter().filter(|o| is_same(o, nearest)).count();
        let note = format!(
            "of {} starts of Newton's method that reach the equilibrium of the damped motion",
            found.len()
        );
        let quantity = format!("dynamics_same_as_statics/{path}");
        draft.row(quantity, "", same as f64, note);
    }
}

const COLUMNS: [Column<Outcome>; 23] = [
    ("variant", |o| o.case.model.label("shown")),
    ("turn_deg", |o| o.case.turn_deg.to_string()),
    ("case", |o| o.case.resolution.name()),
    ("rod_nm", |o| number(o.case.rod_nm())),
    ("seed", |o| o.case.seed.to_string()),
    ("start", |o| o.case.start.name()),
    ("height_nm", |o| number(o.measured.height_nm)),
    ("couple_pn_nm", |o| number(o.measured.couple_pn_nm)),
    ("force_pn", |o| number(o.measured.force_pn)),
    ("energy_pn_nm", |o| number(o.measured.energy_pn_nm)),
    ("link_turns", |o| number(o.measured.link_turns)),
    ("twist_turns", |o| number(o.measured.twist_turns)),
    ("writhe", |o| number(o.measured.writhe)),
    ("beyond_data_per_nm", |o| {
        text(o.measured.beyond_per_nm.map(number))
    }),
    ("stable", |o| o.is_stable().to_string()),
    ("negative_eigenvalues", |o| text(o.doubtful.map(|n| n[0]))),
    ("unresolved_eigenvalues", |o| text(o.doubtful.map(|n| n[1]))),
    ("residual_pn", |o| number(o.residual[0])),
    ("residual_pn_nm", |o| number(o.residual[1])),
    ("newton_iterations", |o| text(o.search.map(|s| s.0))),
    ("equilibria_on_path", |o| text(o.search.map(|s| s.1))),
    ("time_ns", |o| number(o.time_ns)),
    ("force_evaluations", |o| o.force_evaluations.to_string()),
];

pub(super) fn tables(draft: &Draft<'_>, results: &Results) -> Result<(), String> {
    let id = draft.id;
    draft.table(&format!("{id}.csv"), &results.outcomes, &COLUMNS)?;
    let drawn = results.outcomes.iter().filter(|o| o.case.seed == 0);
    let lines = drawn.map(|o| {
        let case = &o.case;
        let names = [
            case.model.label("shown"),
            case.turn_deg.to_string(),
            case.resolution.name(),
            case.start.name(),
        ];
        (names.into(), o.measured.centre_line.clone())
    });
    let header = [
        "variant", "turn_deg", "case", "start", "x_nm", "y_nm", "z_nm",
    ];
    draft.curves(&format!("{id}_centre_lines.csv"), &header, lines)
}
