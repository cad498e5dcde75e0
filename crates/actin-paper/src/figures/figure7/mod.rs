//! Figure 7: a filament held at both ends and turned in its middle by a linker, as a rod, whose
//! halves store the same, and as monomers, whose over-twisted half stores more. Beside them stand the
//! mean filament and a rod with the energy of the supplement, which couples stretch and twist.
//! Neither has a junction.

mod case;
mod rows;

use super::Run;
use crate::palette;
use actin_draw::report::{Artefact, Picture, View};
use actin_draw::{Chart, Colour, Series};
use actin_sim::Hold;
use actin_view::{Attitude, Shown, states};
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
            "Scenes scenarios/figure-7/*.ron, {} equilibria; seeds of the bonds from 0 (the mean filament has \
             none), each pulled both ways; every force is below {:.1e} pN and \
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

/// Rods with both clamps, monomers with 64 and 32 drawn bonds and with weighted ones; with both ends
/// held along the axis, one or none.
fn cases(seeds: u64) -> Vec<Case> {
    let kinds = [
        Resolved::Rod(Hold::TwoNodesAndFrame),
        Resolved::Rod(Hold::Wall),
        Resolved::Coupled(Hold::TwoNodesAndFrame),
        Resolved::Coupled(Hold::Wall),
        Resolved::Ellipsoids(64),
        Resolved::Ellipsoids(32),
        Resolved::Mean,
    ];
    let mut all = Vec::new();
    for sliding in [Sliding::Neither, Sliding::FarEnd, Sliding::BothEnds] {
        for resolved in kinds {
            let first = Case {
                resolved,
                seed: 0,
                reversed: false,
                sliding,
            };
            let seeds = if first.is_sampled() { seeds } else { 1 };
            let directions: &[bool] = if first.is_rod() {
                &[false]
            } else {
                &[false, true]
            };
            for seed in 0..seeds {
                let pulled = |&reversed: &bool| Case {
                    seed,
                    reversed,
                    ..first
                };
                all.extend(directions.iter().map(pulled));
            }
        }
    }
    all
}

/// Energy per length: rods, the mean of the monomers with the default bonds, and the mean filament.
fn picture(results: &[Halves], out: &Path) -> Result<Picture, String> {
    let curve = |label: &str, colour, kind: &str| {
        let of_kind = results.iter().filter(|h| h.case.kind() == kind);
        let halves: Vec<&Halves> = of_kind.collect();
        Series {
            label: Some(label.into()),
            colour,
            points: mean_profile(&halves),
            dots: false,
        }
    };
    let [monomers, sliding, rod] = [0.0, 0.4, 1.0].map(palette::resolution);
    let mut series = vec![
        curve("rod", rod, "rod"),
        curve("rod, C3 energy", palette::line(4), "coupling-energy/rod"),
        curve("ellipsoids", monomers, "ellipsoid"),
        curve(
            "ellipsoids, both ends slide",
            sliding,
            "both-ends-slide/ellipsoid",
        ),
    ];
    series.push(room_above(&series));
    let mean = curve("mean filament", palette::DATA, "mean-filament/ellipsoid");
    series.extend(mean.dashed(false));
    let chart = Chart {
        title: "Energy along the filament; the over-twisted half is on the right",
        x_label: "arc length from the middle (nm)",
        y_label: "elastic energy per length (pN)",
        series,
        equal_axes: false,
    };
    chart.draw(&out.join("fig7_energy.svg"))?;
    Ok(Picture {
        file: "fig7_energy.svg".into(),
        caption: "Elastic energy per length; of ellipsoids the mean over all samplings and both \
                  directions of the pull. Dashed: weighted bonds, the mean filament. C3 energy: \
                  the coupling of stretch and twist of the paper's supplement."
            .into(),
    })
}

/// A white dot that makes room for the legend above all curves.
fn room_above(series: &[Series]) -> Series {
    let values = series.iter().flat_map(|s| s.points.iter().map(|p| p.1));
    Series {
        label: None,
        colour: Colour([255; 3]),
        points: vec![(0.0, 1.4 * values.fold(0.0, f64::max))],
        dots: true,
    }
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
                pose: h.pose.clone(),
            })
        })
        .collect();
    let caption = "The equilibria in space, with the linker that turns the middle.";
    states::write("fig7", Attitude::LYING, &shown, caption.into(), out)
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
