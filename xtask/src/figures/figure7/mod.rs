//! Figure 7: a filament held at both ends and turned in its middle by a linker, as a rod, whose
//! halves store the same, and as monomers, whose over-twisted half stores more.

mod case;
mod rows;

use super::Run;
use super::palette;
use super::plot::{Chart, Series, draw as draw_chart};
use super::report::{Artefact, Picture, View};
use super::viewer::{self, Attitude, Shown};
use actin_sim::Hold;
use case::{Case, Halves, Resolved, Sliding};
use rayon::prelude::*;
use std::path::Path;
use std::time::Instant;

/// Samplings of the bonds, each pulled in both directions.
const SEEDS: u64 = 16;
const QUICK_SEEDS: u64 = 4;

/// Runs all cases, draws them and compares them.
pub(super) fn reproduce(run: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let Run {
        out,
        quick,
        progress,
    } = run;
    let cases = cases(if quick { QUICK_SEEDS } else { SEEDS });
    progress.expect(cases.len());
    let results: Vec<Halves> = cases
        .par_iter()
        .map(|case| {
            let halves = case.run();
            progress.done();
            halves
        })
        .collect::<Result<_, _>>()?;
    rows::write_tables(&results, out)?;
    let worst = |pick: fn(&Halves) -> f64| results.iter().map(pick).fold(0.0, f64::max);
    Ok(Artefact {
        id: "fig7",
        title: "Turned in the middle: the energy of both halves",
        settings: format!(
            "Scenes scenarios/figure-7/*.ron, {} equilibria; seeds of the bonds from 0, each pulled both \
             ways; every force is below {:.1e} pN and \
             every torque below {:.1e} pN nm.",
            results.len(),
            worst(|h| h.residual.0),
            worst(|h| h.residual.1)
        ),
        rows: rows::rows(&results),
        pictures: vec![picture(&results, out)?],
        views: vec![view(&results, out)?],
        wall_s: started.elapsed().as_secs_f64(),
    })
}

/// Rods with both clamps, monomers with 64 and 32 bonds; with both ends held along the axis, one or
/// none.
fn cases(seeds: u64) -> Vec<Case> {
    let rods = [Hold::TwoNodesAndFrame, Hold::Wall].map(Resolved::Rod);
    let monomers = [64, 32].map(Resolved::Ellipsoids);
    let mut all = Vec::new();
    for sliding in [Sliding::Neither, Sliding::FarEnd, Sliding::BothEnds] {
        for resolved in rods.into_iter().chain(monomers) {
            let is_rod = matches!(resolved, Resolved::Rod(_));
            let seeds = if is_rod { 1 } else { seeds };
            let directions: &[bool] = if is_rod { &[false] } else { &[false, true] };
            for seed in 0..seeds {
                all.extend(directions.iter().map(|&reversed| Case {
                    resolved,
                    seed,
                    reversed,
                    sliding,
                }));
            }
        }
    }
    all
}

/// Energy per length: the rod, and the mean of the monomers with the default bonds.
fn picture(results: &[Halves], out: &Path) -> Result<Picture, String> {
    let of_kind =
        |kind: &str| -> Vec<&Halves> { results.iter().filter(|h| h.case.kind() == kind).collect() };
    let curve = |label: &str, share: f64, halves: &[&Halves]| Series {
        label: Some(label.into()),
        colour: palette::resolution(share),
        points: mean_profile(halves),
        dots: false,
    };
    let chart = Chart {
        title: "Energy along the filament; the over-twisted half is on the right",
        x_label: "arc length from the middle (nm)",
        y_label: "elastic energy per length (pN)",
        series: vec![
            curve("rod", 1.0, &of_kind("rod")),
            curve("ellipsoids", 0.0, &of_kind("ellipsoid")),
            curve(
                "ellipsoids, both ends slide",
                0.4,
                &of_kind("both-ends-slide/ellipsoid"),
            ),
        ],
        equal_axes: false,
    };
    draw_chart(&chart, &out.join("fig7_energy.svg"))?;
    Ok(Picture {
        file: "fig7_energy.svg".into(),
        caption: "Elastic energy per length; of ellipsoids the mean over all samplings and both \
                  directions of the pull."
            .into(),
    })
}

/// The pure cases with both ends held, the first sampling, for the viewer.
fn view(results: &[Halves], out: &Path) -> Result<View, String> {
    let first = results
        .iter()
        .filter(|h| h.case.seed == 0 && !h.case.reversed);
    let shown: Vec<Shown> = first
        .filter_map(|h| {
            let kind = h.case.kind();
            let share = match kind.as_str() {
                "rod" => 1.0,
                "ellipsoid" => 0.0,
                _ => return None,
            };
            Some(Shown {
                group: "both ends held".into(),
                name: kind,
                share,
                snapshot: h.snapshot.clone(),
            })
        })
        .collect();
    let caption = "The equilibria in space, with the linker that turns the middle.";
    viewer::write("fig7", Attitude::LYING, &shown, caption.into(), out)
}

/// Mean over profiles that are known at the same places, within the mirror image.
fn mean_profile(halves: &[&Halves]) -> Vec<(f64, f64)> {
    let Some(first) = halves.first() else {
        return Vec::new();
    };
    let n = halves.len() as f64;
    (0..first.profile.len())
        .map(|i| {
            let sum: f64 = halves.iter().map(|h| h.profile[i].1).sum();
            (first.profile[i].0, sum / n)
        })
        .collect()
}
