//! Pictures of Figures 8 and 10: centre lines in the plane of buckling and from its side, and
//! heights and couples against the length of rod.

use super::case::Case;
use super::group::{Figure, Group};
use super::lists::Plan;
use super::outcome::{Outcome, Place};
use super::plane::in_own_plane;
use super::resolved::Resolved;
use super::results::{OBSERVABLES, Observable, Results};
use crate::palette;
use actin_draw::report::{Picture, View};
use actin_draw::{Chart, Series};
use actin_view::{Attitude, Shown, states};
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

/// A view of centre lines.
struct Projection {
    panel: &'static str,
    from: &'static str,
    x_label: &'static str,
    y_label: &'static str,
    project: fn(&Place) -> (f64, f64),
    equal_axes: bool,
}

/// Along the axis, in the plane of buckling and out of it are the coordinates 0, 1 and 2.
const PROJECTIONS: [Projection; 3] = [
    Projection {
        panel: "plane",
        from: "In each filament's own plane of buckling",
        x_label: "along the axis, from the middle (nm)",
        y_label: "in the plane (nm)",
        project: |p| (p[0], p[1]),
        equal_axes: false,
    },
    Projection {
        panel: "side",
        from: "From the side of that plane",
        x_label: "along the axis, from the middle (nm)",
        y_label: "out of the plane (nm)",
        project: |p| (p[0], p[2]),
        equal_axes: false,
    },
    Projection {
        panel: "end",
        from: "Along the axis, from the end",
        x_label: "out of the plane (nm)",
        y_label: "in the plane (nm)",
        project: |p| (p[2], p[1]),
        equal_axes: true,
    },
];

/// The views of the centre lines at one turn.
fn lines(plan: &Plan, results: &Results, turn: i32, out: &Path) -> Result<Vec<Picture>, String> {
    let what = format!("{} deg of {}", turn.abs(), direction(turn > 0));
    let name = Case::turn_name(turn).replace('/', "_");
    let views = PROJECTIONS.iter().map(|projection| {
        let chart = Chart {
            title: &format!("{}, {what} at each end", projection.from),
            x_label: projection.x_label,
            y_label: projection.y_label,
            series: view(plan, results, turn, projection.project),
            equal_axes: projection.equal_axes,
        };
        let file = format!("{}_{name}_{}.svg", plan.figure.id(), projection.panel);
        chart.draw(&out.join(&file))?;
        Ok(Picture {
            file,
            caption: caption(plan.figure, projection.panel),
        })
    });
    views.collect()
}

fn caption(figure: Figure, panel: &str) -> String {
    match panel {
        "plane" => format!(
            "Centre lines, drawn bonds (seed 0), {}; every filament is turned about the axis until its \
             own plane of buckling lies in the page. {} Black: the mean filament, all \
             monomers. The scales of the two axes differ.",
            rods(figure),
            palette::chosen().ends()
        ),
        "side" => "The same lines from the side: what leaves the plane.".into(),
        _ => "The same lines seen along the axis of the ends, at equal scales.".into(),
    }
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
            pose: o.pose.clone(),
        })
        .collect();
    let caption = "The equilibria of seed 0 in space, each in the plane in which it buckled; the \
        stripe along rods is their first axis and shows the twist. The weak pull that breaks the \
        symmetry is left out.";
    let id = plan.figure.id();
    states::write(id, Attitude::LYING, &shown, caption.into(), out)
}

fn view(
    plan: &Plan,
    results: &Results,
    turn: i32,
    project: fn(&Place) -> (f64, f64),
) -> Vec<Series> {
    let line = |outcome: &Outcome, label, colour| Series {
        label: Some(label),
        colour,
        points: in_own_plane(&outcome.measured.centre_line)
            .iter()
            .map(project)
            .collect(),
        dots: false,
    };
    let drawn = drawn(plan, results, turn).into_iter().map(|outcome| {
        let resolved = outcome.case.resolved;
        let colour = palette::resolution(resolved.rod_share());
        line(outcome, resolved.name(), colour)
    });
    let group = Group {
        mean: true,
        ..plan.main()
    };
    let mean = results.of(Case::new(group, Resolved::Ellipsoids, turn, 0));
    let mean = mean.map(|outcome| line(outcome, "mean, ellipsoids".into(), group.colour()));
    drawn.chain(mean).collect()
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
    let file = format!("{}_{turn}_{name}.svg", plan.figure.id());
    chart.draw(&out.join(&file))?;
    let caption = format!(
        "{what} against the length of rod, {}. Drawn bonds, 64 per interface, are means over {} samplings; \
         the mean filament has 12 weighted bonds per interface that stand for all{}.",
        rods(plan.figure),
        plan.seeds,
        match plan.figure {
            Figure::Eight => "",
            Figure::Ten => ", and the balance as printed is solved for it",
        }
    );
    Ok(Picture { file, caption })
}

/// One curve for each group, with its points.
fn curves(plan: &Plan, results: &Results, observable: Observable, turn: i32) -> Vec<Series> {
    let mut series = Vec::new();
    let groups = plan.groups().into_iter().map(|(_, group)| group);
    for group in groups.filter(|&group| plan.turns_of(group).any(|t| t == turn)) {
        let points = means(plan, results, (group, turn), observable);
        let curve = |label, points, dots| Series {
            label,
            colour: group.colour(),
            points,
            dots,
        };
        series.push(curve(Some(group.words().into()), points.clone(), false));
        series.push(curve(None, points, true));
    }
    series
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
