//! Figure 4: the multi-resolution cantilever at seven resolutions.
//!
//! Every case is damped dynamics to a stated residual. The same trajectory gives the equilibrium
//! (its end), and the first flexural mode with its decay (its approach). `--quick` solves for the
//! equilibria alone.

mod case;
mod pictures;
mod ringdown;
mod rows;

use super::Run;
use super::report::Artefact;
use case::{Case, Result4, Variant};
use rayon::prelude::*;
use std::time::Instant;

/// Lengths of the rod part (nm), as in the paper.
const ROD_LENGTHS: [u32; 7] = [20, 40, 60, 80, 100, 120, 140];
/// The same for `--quick`.
const QUICK_ROD_LENGTHS: [u32; 3] = [20, 80, 140];
/// Bond samplings of the fully resolved filament.
const SEEDS: u64 = 8;

/// Runs all cases, draws them and compares them.
pub(super) fn reproduce(run: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let Run {
        out,
        quick,
        progress,
    } = run;
    let cases = cases(quick);
    progress.expect(cases.len());
    let results: Vec<Result4> = cases
        .par_iter()
        .map(|case| {
            let result = case.run(!quick);
            progress.done();
            result
        })
        .collect::<Result<_, _>>()?;
    let pictures = pictures::draw(&results, out)?;
    rows::write_tables(&results, out)?;
    Ok(Artefact {
        id: "fig4",
        title: "Cantilever of 160 nm under a tip force, resolved in seven ways",
        settings: case::settings(&results),
        rows: rows::rows(&results),
        pictures,
        views: vec![pictures::view_in_space(&results, out)?],
        wall_s: started.elapsed().as_secs_f64(),
    })
}

fn cases(quick: bool) -> Vec<Case> {
    let lengths: &[u32] = if quick {
        &QUICK_ROD_LENGTHS
    } else {
        &ROD_LENGTHS
    };
    let mut all = Vec::new();
    for variant in [Variant::Shared, Variant::Full, Variant::HalfPiconewton] {
        all.extend(lengths.iter().map(|&rod| Case::mixed(variant, rod)));
    }
    for variant in [Variant::Shared, Variant::HalfPiconewton] {
        all.push(Case::rod(variant));
        all.push(Case::ellipsoids(variant, 0));
    }
    all.push(Case::rod(Variant::PrecedingPaper));
    all.extend([32, 64, 128].map(Case::refined_rod));
    if !quick {
        all.extend((1..SEEDS).map(|seed| Case::ellipsoids(Variant::Shared, seed)));
    }
    all
}
