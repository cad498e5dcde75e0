//! Pictures of Figures 8 and 10: centre lines in the plane of buckling and from its side, and
//! heights and couples against the length of rod.

use super::case::{Case, Figure, Group, Resolved};
use super::lists::Plan;
use super::outcome::Place;
use super::plane::in_own_plane;
use super::results::{OBSERVABLES, Observable, Results};
use super::rows::artefact;
use crate::figures::plot::{Chart, Series, draw as draw_chart, resolution_colour};
use crate::figures::report::Picture;
use std::path::Path;

/// Draws all pictures.
pub(super) fn draw(plan: &Plan, results: &Results, out: &Path) -> Result<Vec<Picture>, String> {
    let mut pictures = Vec::new();
    for &turn in &plan.turns {
        pictures.extend(lines(plan, results, turn, out)?);
    }
    for observable in &OBSERVABLES[..2] {
        for over in [true, false] {
            pictures.push(against_rod(plan, results, (*observable, over), out)?);
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
             plane of buckling lies in the page. Red is all monomers, blue all rod. The scales of the \
             two axes differ."
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

fn view(
    plan: &Plan,
    results: &Results,
    turn: i32,
    project: fn(&Place) -> (f64, f64),
) -> Vec<Series> {
    let cases = plan.resolved.iter().rev();
    let outcomes = cases.filter_map(|&r| results.of(Case::new(plan.main(), r, turn, 0)));
    outcomes
        .map(|outcome| Series {
            label: Some(outcome.case.resolved.name()),
            colour: resolution_colour(outcome.case.resolved.rod_share()),
            points: in_own_plane(&outcome.measured.centre_line)
                .iter()
                .map(project)
                .collect(),
            dots: false,
        })
        .collect()
}

/// An observable against the length of rod, all groups and turns of one direction.
fn against_rod(
    plan: &Plan,
    results: &Results,
    (observable, over): (Observable, bool),
    out: &Path,
) -> Result<Picture, String> {
    let Observable { name, unit, .. } = observable;
    let series = curves(plan, results, observable, over);
    let what = if name == "height" {
        "Largest distance from the axis"
    } else {
        "End couple"
    };
    let chart = Chart {
        title: &format!("{what}, {}", direction(over)),
        x_label: "length of rod (nm); 0 is all monomers, 300 all rod",
        y_label: &format!("{name} ({unit})"),
        series,
        equal_axes: false,
    };
    let sign = if over { "over" } else { "under" };
    let file = format!("{}_{name}_{sign}.svg", artefact(plan.figure));
    draw_chart(&chart, &out.join(&file))?;
    let caption = format!(
        "{what} against the length of rod: means over {} samplings of the bonds.",
        plan.seeds
    );
    Ok(Picture { file, caption })
}

/// One curve for each group that is drawn and each turn, with its points.
fn curves(plan: &Plan, results: &Results, observable: Observable, over: bool) -> Vec<Series> {
    let drawn = |name: &str| plan.figure == Figure::Eight || matches!(name, "" | "standard/");
    let groups: Vec<_> = plan.groups().into_iter().filter(|g| drawn(g.0)).collect();
    let turns: Vec<i32> = plan
        .turns
        .iter()
        .copied()
        .filter(|t| (*t > 0) == over)
        .collect();
    let mut series = Vec::new();
    for (i, &(name, group)) in groups.iter().enumerate() {
        for (k, &turn) in turns.iter().enumerate() {
            // From blue for the first group to red for the last; the first turn is the purest.
            let share = 1.0 - i as f64 / (groups.len() - 1) as f64;
            let share = share + (0.5 - share) * 0.3 * k as f64;
            let points = means(plan, results, (group, turn), observable);
            let label = format!("{} deg, {}", turn.abs(), describe(name, group));
            let curve = |label, points, dots| Series {
                label,
                colour: resolution_colour(share),
                points,
                dots,
            };
            series.push(curve(Some(label), points.clone(), false));
            series.push(curve(None, points, true));
        }
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
