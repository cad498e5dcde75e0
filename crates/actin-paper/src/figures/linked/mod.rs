//! Figures 5 and 6: free filaments on linkers, in one plane and all round.
//!
//! Every equilibrium is Newton's, sought from several turns of the filament about its axis; of
//! those that are found the one of lowest energy counts. The energy against time is that of damped
//! dynamics from the built state, whose anchors stand away from the sites at once.

mod case;
pub(crate) mod centre_line;
mod pictures;
mod rows;
mod solve;
mod spread;

use super::Run;
use actin_draw::report::Artefact;
use case::{Case, Figure, MEAN, Resolved, STANDARD, VARIANTS, Variant};
use rayon::prelude::*;
use solve::Outcome;
use std::path::Path;
use std::time::Instant;

/// Samplings of the bonds.
const SEEDS: u64 = 8;
/// The same for `--quick`.
const QUICK_SEEDS: u64 = 2;

static FIGURE_5: Figure = Figure {
    id: "fig5",
    name: "Figure 5",
    title: "Free filament of 160 nm on three linkers in one plane",
    file: "figure-5/linkers.ron",
    length: 160,
    rods: &[30, 50, 70, 90, 110, 130],
    quick_rods: &[30, 90, 130],
};

static FIGURE_6: Figure = Figure {
    id: "fig6",
    name: "Figure 6",
    title: "Free filament of 210 nm on four linkers all round it",
    file: "figure-6/linkers.ron",
    length: 210,
    rods: &[30, 50, 70, 90, 110, 130, 150, 170],
    quick_rods: &[30, 90, 170],
};

/// Figure 5: linkers in one plane.
pub(super) fn figure5(run: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let outcomes = solve(&FIGURE_5, run, !run.quick)?;
    let mut rows = rows::of_figure(&FIGURE_5, &outcomes);
    rows.extend(rows::bending_claim(&FIGURE_5, &outcomes));
    rows.extend(rows::in_plane(&Case {
        figure: &FIGURE_5,
        resolved: Resolved::Rod,
        variant: STANDARD,
        seed: 0,
    })?);
    artefact(&FIGURE_5, &outcomes, rows, run.out, started)
}

/// Figure 6: linkers all round, compared with those in one plane.
pub(super) fn figure6(run: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let outcomes = solve(&FIGURE_6, run, !run.quick)?;
    let planar = solve(&FIGURE_5, run, false)?;
    let mut rows = rows::of_figure(&FIGURE_6, &outcomes);
    rows.extend(rows::larger_claims(
        (&FIGURE_6, &outcomes),
        (&FIGURE_5, &planar),
    ));
    artefact(&FIGURE_6, &outcomes, rows, run.out, started)
}

fn artefact(
    figure: &'static Figure,
    outcomes: &[Outcome],
    rows: Vec<actin_draw::report::Row>,
    out: &Path,
    started: Instant,
) -> Result<Artefact, String> {
    rows::write_tables(figure, outcomes, out)?;
    Ok(Artefact {
        id: figure.id,
        title: figure.title,
        settings: rows::settings(figure, outcomes),
        pictures: pictures::draw(figure, outcomes, out)?,
        views: vec![pictures::view_in_space(figure, outcomes, out)?],
        rows,
        wall_s: started.elapsed().as_secs_f64(),
    })
}

/// Solves all cases of a figure, side by side; follows the motions that are drawn if `moving`.
fn solve(figure: &'static Figure, run: Run<'_>, moving: bool) -> Result<Vec<Outcome>, String> {
    let cases = cases(figure, run.quick);
    run.progress.expect(cases.len());
    cases
        .par_iter()
        .map(|case| {
            let outcome = Outcome::of(case, moving && (is_drawn(case) || is_mean(case)));
            run.progress.done();
            outcome
        })
        .collect()
}

/// The paper's rod and the first sampling of the bonds are drawn; all else is numbers.
fn is_drawn(case: &Case) -> bool {
    case.variant == STANDARD && case.seed == 0
}

/// The mean filament, monomers alone, is drawn beside them.
fn is_mean(case: &Case) -> bool {
    case.variant == MEAN && case.resolved == Resolved::Ellipsoids
}

fn cases(figure: &'static Figure, quick: bool) -> Vec<Case> {
    let (rods, seeds) = if quick {
        (figure.quick_rods, QUICK_SEEDS)
    } else {
        (figure.rods, SEEDS)
    };
    let mut all = Vec::new();
    for variant in VARIANTS {
        let seeds = if variant.is_drawn_at_random() {
            seeds
        } else {
            1
        };
        for seed in 0..seeds {
            let kinds = resolutions(rods, variant, seed);
            all.extend(kinds.into_iter().map(|resolved| Case {
                figure,
                resolved,
                variant,
                seed,
            }));
        }
    }
    all
}

/// What is resolved in so many ways: a rod has no bonds to sample, monomers no law to vary, and
/// neither has a junction.
fn resolutions(rods: &[u32], variant: Variant, seed: u64) -> Vec<Resolved> {
    let mut all: Vec<Resolved> = rods.iter().map(|&rod| Resolved::Mixed(rod)).collect();
    let is_own = |pure| variant.of_pure(pure) == variant;
    if seed == 0 && is_own(Resolved::Rod) {
        all.push(Resolved::Rod);
    }
    if is_own(Resolved::Ellipsoids) {
        all.push(Resolved::Ellipsoids);
    }
    all
}
