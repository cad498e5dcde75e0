//! Figure 4: the multi-resolution cantilever at seven resolutions.
//!
//! Every case is damped dynamics to a stated residual, which ends in an equilibrium; with less drag
//! its filament swings, which gives the first flexural mode and its decay. `--quick` solves for the
//! equilibria alone. Beside our model and its drawn bonds stand the mean filament, the model as the
//! paper prints it, and the rigidity of the paper before it.

mod case;
mod pictures;
mod ringdown;
mod rows;
mod tables;
mod variant;

use super::Run;
use actin_draw::report::Artefact;
use case::{Case, Result4};
use rayon::prelude::*;
use std::time::Instant;
use variant::Variant;

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
    tables::write(&results, out)?;
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

/// Pure cases have no junction; the printed balance has no equilibria, and is left out of `quick`.
fn cases(quick: bool) -> Vec<Case> {
    let lengths: &[u32] = if quick {
        &QUICK_ROD_LENGTHS
    } else {
        &ROD_LENGTHS
    };
    let mut all = Vec::new();
    let mut mixed = vec![
        Variant::SHARED,
        Variant::FULL,
        Variant::WEAK,
        Variant::MEAN,
        Variant::WEAK_MEAN,
        Variant::STIFF,
        Variant::STIFF_FULL,
        Variant::STIFF_MEAN,
    ];
    let mut rods = vec![Variant::SHARED, Variant::WEAK, Variant::STIFF];
    if !quick {
        mixed.push(Variant::AS_PRINTED);
        rods.push(Variant::AS_PRINTED);
    }
    for variant in mixed {
        all.extend(lengths.iter().map(|&rod| Case::mixed(variant, rod)));
    }
    all.extend(rods.into_iter().map(Case::rod));
    let ellipsoids = [
        Variant::SHARED,
        Variant::WEAK,
        Variant::MEAN,
        Variant::WEAK_MEAN,
        Variant::STIFF,
        Variant::STIFF_MEAN,
    ];
    all.extend(ellipsoids.map(|variant| Case::ellipsoids(variant, 0)));
    all.extend([32, 64, 128].map(Case::refined_rod));
    if !quick {
        all.extend((1..SEEDS).map(|seed| Case::ellipsoids(Variant::SHARED, seed)));
    }
    all
}
