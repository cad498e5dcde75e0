//! Pictures of Figures 8 and 10: centre lines in the plane of buckling and from its side, and
//! heights and couples against the length of rod.

use super::case::{Case, Figure, Group, Resolved};
use super::lists::Plan;
use super::outcome::{Outcome, Place};
use super::plane::in_own_plane;
use super::results::{OBSERVABLES, Observable, Results};
use super::rows::artefact;
use crate::figures::palette;
use crate::figures::plot::{Chart, Series, draw as draw_chart};
use crate::figures::report::{Picture, View};
use crate::figures::viewer::{self, Attitude, Shown};
use std::path::Path;

/// Draws all pictures.
pub(super) fn draw(plan: &Plan, results: &Results, out: &Path) -> Result<Vec<Picture>, String> {
    let mut pictures = Vec::new();
    for &turn in &plan.turns {
        pictures.extend(lines(plan, results, turn, out)?);
    }
    for observable in &OBSERVABLES[..2] {
        for &turn in &plan.turns {
            pictures.push(against_rod(plan, results, (*observable, turn), out)?);
        }
    }
    Ok(pictures)
}

/// Both views of the centre lines at one turn.
fn lines(plan: &Plan, results: &Results, turn: i32, out: &Path) -> Result<Vec<Picture>, String> {
    let id = artefact(plan.figure);
    let what = format!("{} deg of {}", turn.abs(), direction(turn > 0));
    let law = rods(plan.figure);
    let front = Chart {
        title: &format!("In each filament's own plane of buckling, {what} at each end"),
        x_label: "along the axis, from the middle (nm)",
        y_label: "in the plane (nm)",
        series: view(plan, results, turn, |p| (p[0], p[1])),
        equal_axes: false,
    };
    let side = Chart {
        title: &format!("From the side of that plane, {what} at each end"),
        x_label: "along the axis, from the middle (nm)",
        y_label: "out of the plane (nm)",
        series: view(plan, results, turn, |p| (p[0], p[2])),
        equal_axes: false,
    };
    let name = Case::turn_name(turn).replace('/', "_");
    let captions = [
        format!(
            "Centre lines, seed 0, {law}; every filament is turned about the axis until its own \
             plane of buckling lies in the page. {} The scales of the two axes differ.",
            palette::chosen().ends()
        ),
        "The same lines from the side: what leaves the plane.".into(),
    ];
    let charts = [(front, "plane"), (side, "side")].into_iter();
    charts
        .zip(captions)
        .map(|((chart, panel), caption)| {
            let file = format!("{id}_{name}_{panel}.svg");
            draw_chart(&chart, &out.join(&file))?;
            Ok(Picture { file, caption })
        })
        .collect()
}

fn direction(over: bool) -> &'static str {
    if over { "over-twist" } else { "under-twist" }
}

fn rods(figure: Figure) -> &'static str {
    match figure {
        Figure::Eight => "rods of constant rigidities",
        Figure::Ten => "rods with the published B3(kappa) and xi(kappa)",
    }
}

/// What is drawn at a turn, from monomers to rod.
fn drawn<'a>(plan: &Plan, results: &'a Results, turn: i32) -> Vec<&'a Outcome> {
    let cases = plan.resolved.iter().rev();
    let outcomes = cases.filter_map(|&r| results.of(Case::new(plan.main(), r, turn, 0)));
    outcomes.collect()
}

/// The drawn states for the viewer.
pub(super) fn view_in_space(plan: &Plan, results: &Results, out: &Path) -> Result<View, String> {
    let turns = plan.turns.iter();
    let shown: Vec<Shown> = turns
        .flat_map(|&turn| {
            drawn(plan, results, turn)
                .into_iter()
                .map(move |o| (turn, o))
        })
        .map(|(turn, o)| Shown {
            group: format!("{} deg of {}", turn.abs(), direction(turn > 0)),
            name: o.case.resolved.name(),
            share: o.case.resolved.rod_share(),
            snapshot: o.snapshot.clone(),
        })
        .collect();
    let caption = "The equilibria of seed 0 in space, each in the plane in which it buckled; the \
        stripe along rods is their first axis and shows the twist. The weak pull that breaks the \
        symmetry is left out.";
    let id = artefact(plan.figure);
    viewer::write(id, Attitude::LYING, &shown, caption.into(), out)
}

fn view(
    plan: &Plan,
    results: &Results,
    turn: i32,
    project: fn(&Place) -> (f64, f64),
) -> Vec<Series> {
    drawn(plan, results, turn)
        .into_iter()
        .map(|outcome| Series {
            label: Some(outcome.case.resolved.name()),
            colour: palette::resolution(outcome.case.resolved.rod_share()),
            points: in_own_plane(&outcome.measured.centre_line)
                .iter()
                .map(project)
                .collect(),
            dots: false,
        })
        .collect()
}

/// An observable against the length of rod at one turn, all groups.
fn against_rod(
    plan: &Plan,
    results: &Results,
    (observable, turn): (Observable, i32),
    out: &Path,
) -> Result<Picture, String> {
    let Observable { name, unit, .. } = observable;
    let what = match name {
        "height" => "Largest distance from the axis",
        _ => "End couple",
    };
    let chart = Chart {
        title: &format!(
            "{what}, {} deg of {} at each end",
            turn.abs(),
            direction(turn > 0)
        ),
        x_label: "length of rod (nm); 0 is all monomers, 300 all rod",
        y_label: &format!("{name} ({unit})"),
        series: curves(plan, results, observable, turn),
        equal_axes: false,
    };
    let turn = Case::turn_name(turn).replace('/', "_");
    let file = format!("{}_{turn}_{name}.svg", artefact(plan.figure));
    draw_chart(&chart, &out.join(&file))?;
    let caption = format!(
        "{what} against the length of rod: means over {} samplings of the bonds. Monomers have 64 \
         bonds per interface unless 32 are named.",
        plan.seeds
    );
    Ok(Picture { file, caption })
}

/// One curve for each group, with its points.
fn curves(plan: &Plan, results: &Results, observable: Observable, turn: i32) -> Vec<Series> {
    let groups = plan.groups();
    let mut series = Vec::new();
    for (i, &(name, group)) in groups.iter().enumerate() {
        // Groups are not resolutions, but as many; the first has the colour of all rod.
        let share = 1.0 - i as f64 / (groups.len() - 1) as f64;
        let points = means(plan, results, (group, turn), observable);
        let curve = |label, points, dots| Series {
            label,
            colour: palette::resolution(share),
            points,
            dots,
        };
        series.push(curve(Some(describe(name, group)), points.clone(), false));
        series.push(curve(None, points, true));
    }
    series
}

fn describe(name: &str, group: Group) -> String {
    let law = if group.extended {
        "extended"
    } else {
        "constant"
    };
    let bonds = if name.starts_with("bonds") {
        ", 32 bonds"
    } else {
        ""
    };
    format!("{law}, {:?}{bonds}", group.hold)
}

fn means(
    plan: &Plan,
    results: &Results,
    (group, turn): (Group, i32),
    observable: Observable,
) -> Vec<(f64, f64)> {
    let mean = |&resolved: &Resolved| {
        let sample = results.sample(group, resolved, turn, observable.of)?;
        Some((resolved.rod_nm(), sample.mean))
    };
    plan.resolved.iter().filter_map(mean).collect()
}
