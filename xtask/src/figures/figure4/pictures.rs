//! The panels of Figure 4: side view, end view, energy against time.

use super::case::{Resolved, Result4, Variant};
use crate::figures::palette;
use crate::figures::plot::{Chart, Series, draw as draw_chart};
use crate::figures::report::{Picture, View};
use crate::figures::viewer::{self, Attitude, Shown};
use std::path::Path;

/// Draws all panels.
pub(super) fn draw(results: &[Result4], out: &Path) -> Result<Vec<Picture>, String> {
    let mut pictures = Vec::new();
    for (variant, weight, force) in [
        (Variant::Shared, "shared", "2 pN"),
        (Variant::Full, "full", "2 pN"),
        (Variant::HalfPiconewton, "shared", "0.5 pN"),
    ] {
        let mut chosen: Vec<&Result4> = results
            .iter()
            .filter(|r| r.case.variant == variant && is_drawn(r.case.resolved))
            .collect();
        chosen.sort_by(|a, b| a.case.rod_share().total_cmp(&b.case.rod_share()));
        pictures.extend(panels(&chosen, weight, force, out)?);
    }
    Ok(pictures)
}

/// Refined rods and further seeds are numbers, not lines.
fn is_drawn(resolved: Resolved) -> bool {
    matches!(
        resolved,
        Resolved::Mixed(_) | Resolved::Rod(super::case::ROD_SEGMENTS) | Resolved::Ellipsoids(0)
    )
}

/// The drawn states for the viewer.
pub(super) fn view_in_space(results: &[Result4], out: &Path) -> Result<View, String> {
    let mut drawn: Vec<&Result4> = results
        .iter()
        .filter(|r| is_drawn(r.case.resolved))
        .collect();
    drawn.sort_by(|a, b| a.case.rod_share().total_cmp(&b.case.rod_share()));
    let shown: Vec<Shown> = drawn
        .into_iter()
        .map(|r| Shown {
            group: r.case.variant.words().into(),
            name: r.case.name(),
            share: r.case.rod_share(),
            snapshot: r.snapshot.clone(),
        })
        .collect();
    let caption = "Where the damped motions came to rest, in space: monomers with their own \
        semi-axes and orientations, the rod with a stripe along its first axis. The force acts at \
        the tip.";
    viewer::write("fig4", Attitude::LYING, &shown, caption.into(), out)
}

const X_LABEL: &str = "x (nm); the force pulls towards -x";

fn panels(
    results: &[&Result4],
    weight: &str,
    force: &str,
    out: &Path,
) -> Result<Vec<Picture>, String> {
    let what = format!("{force}, junction weight {weight}");
    let side = Chart {
        title: &format!("Side view, {what}"),
        x_label: "z along the unloaded filament (nm)",
        y_label: X_LABEL,
        series: view(results, |p| (p[2], p[0])),
        equal_axes: true,
    };
    let end = Chart {
        title: &format!("End view, {what}"),
        x_label: "y (nm)",
        y_label: X_LABEL,
        series: view(results, |p| (p[1], p[0])),
        equal_axes: true,
    };
    let energy = Chart {
        title: &format!("Energy, {what}"),
        x_label: "time (ns)",
        y_label: "elastic and kinetic energy (pN nm)",
        series: energies(results),
        equal_axes: false,
    };
    let captions = captions(&what);
    let charts = [(side, "side"), (end, "end"), (energy, "energy")];
    let shown = charts.into_iter().zip(captions);
    let shown = shown.filter(|((_, panel), _)| *panel != "energy" || results[0].moved);
    shown
        .map(|((chart, panel), caption)| {
            let file = format!("fig4_{}_{weight}_{panel}.svg", force.replace(' ', "_"));
            draw_chart(&chart, &out.join(&file))?;
            Ok(Picture { file, caption })
        })
        .collect()
}

/// What is seen on side view, end view and energy.
fn captions(what: &str) -> [String; 3] {
    [
        format!(
            "Equilibria under {what}. Lines: nodes of the rod, and the centre line of the \
             monomers; dots: monomer centres. {}",
            palette::chosen().ends()
        ),
        "The same states seen along the unloaded filament.".into(),
        "Elastic and kinetic energy while the damped motion comes to rest.".into(),
    ]
}

/// Monomer centres as dots under the centre lines, projected by `project`.
fn view(results: &[&Result4], project: fn(&[f64; 3]) -> (f64, f64)) -> Vec<Series> {
    let dots = results.iter().map(|r| Series {
        label: None,
        colour: palette::resolution(r.case.rod_share()),
        points: r.monomers.iter().map(project).collect(),
        dots: true,
    });
    let lines = results.iter().map(|r| Series {
        label: Some(r.case.name()),
        colour: palette::resolution(r.case.rod_share()),
        points: r.centre_line.iter().map(project).collect(),
        dots: false,
    });
    dots.chain(lines).collect()
}

fn energies(results: &[&Result4]) -> Vec<Series> {
    results
        .iter()
        .map(|r| Series {
            label: Some(r.case.name()),
            colour: palette::resolution(r.case.rod_share()),
            points: r.energy.clone(),
            dots: false,
        })
        .collect()
}
