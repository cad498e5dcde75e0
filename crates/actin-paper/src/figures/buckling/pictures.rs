//! Pictures of Figures 8 and 10: projected centre lines, and heights and torques against the length of rod.

use super::case::{Case, turn_name};
use super::plane::in_own_plane;
use super::solve::Outcome;
use super::{LENGTH_NM, OBSERVABLES, Observable, Plan, Results};
use crate::figures::charts::{Filament, against_rod, project};
use crate::figures::draft::Draft;
use crate::figures::model::Resolution;
use crate::figures::texts::{ChartText, Values};
use crate::palette;
use crate::run::scenario;
use actin_sim::follow::Follower;
use actin_view::Pose;

pub(super) fn draw(plan: &Plan, draft: &mut Draft<'_>, results: &Results) -> Result<(), String> {
    for &turn in plan.turns {
        lines(plan, draft, results, turn)?;
    }
    for &observable in &OBSERVABLES[..2] {
        for &turn in plan.turns {
            against_resolution(plan, draft, results, observable, turn)?;
        }
    }
    view(plan, draft, results)
}

/// Stem of the names of the pictures of a turn.
fn stem(plan: &Plan, turn: i32) -> String {
    format!("{}_{}", plan.id, turn_name(turn).replace('/', "_"))
}

fn in_words(turn: i32) -> String {
    let direction = if turn > 0 {
        "over-twist"
    } else {
        "under-twist"
    };
    format!("{} deg of {direction}", turn.abs())
}

fn drawn<'a>(plan: &Plan, results: &'a Results, turn: i32) -> Vec<&'a Outcome> {
    let cases: Vec<Case> = plan.shown_at(turn).collect();
    let outcomes = cases.into_iter().rev();
    outcomes.filter_map(|case| results.of(case)).collect()
}

fn filaments(plan: &Plan, results: &Results, turn: i32) -> Vec<Filament> {
    let filament = |o: &Outcome, name: String, colour| Filament {
        name,
        colour,
        is_dashed: false,
        line: in_own_plane(&o.measured.centre_line),
        monomers: Vec::new(),
    };
    let drawn = drawn(plan, results, turn).into_iter().map(|o| {
        let colour = palette::resolution(o.case.rod_nm() / LENGTH_NM);
        filament(o, o.case.resolution.name(), colour)
    });
    let mean = plan.models.iter().find(|model| model.is_mean);
    let mean = mean.map(|model| plan.case(model, Resolution::Ellipsoids, turn, 0));
    let mean = mean.and_then(|case| results.of(case));
    let mean = mean.map(|o| filament(o, "mean, ellipsoids".into(), palette::DATA));
    drawn.chain(mean).collect()
}

/// End of the captions of charts with the mean filament.
const MEAN_FILAMENT: &str = " The mean filament has 12 quadrature bonds per interface, which represent all possible \
                             bonds. The balance as printed uses it.";

fn lines(plan: &Plan, draft: &mut Draft<'_>, results: &Results, turn: i32) -> Result<(), String> {
    let filaments = filaments(plan, results, turn);
    let turned = in_words(turn);
    let mean = if plan.quick {
        ""
    } else {
        "Black: the mean filament without rod. "
    };
    let values: Values<'_> = &[("turn", &turned), ("rods", &plan.rods), ("mean", &mean)];
    for view in ["plane", "side", "end"] {
        let texts = ChartText::new(&format!("buckling_{view}"), values)?;
        let file = format!("{}_{view}.svg", stem(plan, turn));
        project(draft, file, &texts, &filaments, &[])?;
    }
    Ok(())
}

/// Draws the means of an observable over samplings against the length of rod.
fn against_resolution(
    plan: &Plan,
    draft: &mut Draft<'_>,
    results: &Results,
    (name, _, of): Observable,
    turn: i32,
) -> Result<(), String> {
    let curves = plan.models.iter().map(|&model| {
        let is_compared = plan.turns_of(model).any(|t| t == turn);
        let resolutions = plan.resolutions.iter().filter(|_| is_compared);
        let means = resolutions.filter_map(|&r| {
            let case = plan.case(model, r, turn, 0);
            Some((case.rod_nm(), results.sample(case, of)?.mean))
        });
        model.curve(means.collect())
    });
    let turned = in_words(turn);
    let mean = if plan.quick { "" } else { MEAN_FILAMENT };
    let values: Values<'_> = &[
        ("turn", &turned),
        ("rods", &plan.rods),
        ("seeds", &plan.seeds),
        ("mean", &mean),
    ];
    let texts = ChartText::new(&format!("buckling_{name}"), values)?;
    let file = format!("{}_{name}.svg", stem(plan, turn));
    draft.plot(file, &texts, against_rod(curves))
}

fn view(plan: &Plan, draft: &mut Draft<'_>, results: &Results) -> Result<(), String> {
    let turns = plan.turns.iter();
    let shown = turns.flat_map(|&turn| {
        drawn(plan, results, turn).into_iter().map(move |o| {
            let share = o.case.rod_nm() / LENGTH_NM;
            (
                in_words(turn),
                o.case.resolution.name(),
                share,
                o.pose.clone(),
            )
        })
    });
    draft.view(plan.id, "buckling", shown)
}

/// Times of the states of the adaptive motion (ns): straight, bent, buckled, at rest.
const TIMES_NS: [f64; 5] = [0.0, 95.0, 125.0, 145.0, 400.0];
/// Tolerance of the time of a record (ns). Records are every 5 ns, rounded to time steps.
const NEAR_NS: f64 = 1.0;

/// Writes a buckling filament with adaptive resolution for the viewer.
pub(super) fn followed(draft: &mut Draft<'_>) -> Result<(), String> {
    let fail = |error: &dyn std::fmt::Display| format!("following.ron: {error}");
    let follower = Follower::new(&scenario("following.ron")?).map_err(|e| fail(&e))?;
    let run = follower.run().map_err(|e| fail(&e))?;
    let mut shown = Vec::new();
    for time_ns in TIMES_NS {
        // At a switch of the resolution, the later stretch is shown.
        let found = run.stretches.iter().rev().find_map(|ran| {
            let mut records = ran.trajectory.records.iter();
            let record = records.find(|record| (record.at.value() - time_ns).abs() < NEAR_NS)?;
            let cells = &ran.stretch.beginning.is_monomers;
            let monomers = cells.iter().filter(|is_monomers| **is_monomers).count();
            Some((
                "Compressed by a fifth in 300 ns".into(),
                format!("{time_ns} ns"),
                1.0 - monomers as f64 / cells.len() as f64,
                Pose::new(&ran.stretch.assembly, &record.state),
            ))
        });
        shown.push(found.ok_or_else(|| fail(&format!("no state at {time_ns} ns")))?);
    }
    draft.view("fig10_following", "following", shown)
}
