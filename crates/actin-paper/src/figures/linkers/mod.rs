//! Figures 5 and 6: free filaments on linkers in one plane and on all sides.
//!
//! Newton's method starts from several rotations of the filament about its axis, and the equilibrium of lowest energy
//! is used. Energies against time are from damped dynamics of the built state with displaced anchors.

mod pictures;
mod rows;
mod solve;

use super::draft::Draft;
use super::model::{Model, Resolution, models};
use crate::run::{scenario, sections, segments};
use actin_sim::Scene;
use solve::Outcome;

const SEEDS: u64 = 8;
const QUICK_SEEDS: u64 = 2;

#[derive(Debug)]
struct Figure {
    id: &'static str,
    file: &'static str,
    length_nm: f64,
    /// Lengths of the rod in the middle (nm), by default and with `--quick`.
    rods: &'static [u32],
    quick_rods: &'static [u32],
}

static FIGURE_5: Figure = Figure {
    id: "fig5",
    file: "figure-5/linkers.ron",
    length_nm: 160.0,
    rods: &[30, 50, 70, 90, 110, 130],
    quick_rods: &[30, 90, 130],
};

static FIGURE_6: Figure = Figure {
    id: "fig6",
    file: "figure-6/linkers.ron",
    length_nm: 210.0,
    rods: &[30, 50, 70, 90, 110, 130, 150, 170],
    quick_rods: &[30, 90, 170],
};

#[derive(Clone, Copy, Debug)]
struct Case {
    figure: &'static Figure,
    resolution: Resolution,
    model: &'static Model,
    seed: u64,
}

pub(super) fn figure5(draft: &mut Draft<'_>) -> Result<(), String> {
    let outcomes = solve_all(&FIGURE_5, draft, !draft.quick)?;
    draw(&FIGURE_5, draft, &outcomes)
}

/// Figure 6: linkers on all sides, compared with linkers in one plane.
pub(super) fn figure6(draft: &mut Draft<'_>) -> Result<(), String> {
    let outcomes = solve_all(&FIGURE_6, draft, !draft.quick)?;
    let planar = solve_all(&FIGURE_5, draft, false)?;
    draw(&FIGURE_6, draft, &outcomes)?;
    rows::larger_claims(draft, [&outcomes, &planar]);
    Ok(())
}

fn draw(
    figure: &'static Figure,
    draft: &mut Draft<'_>,
    outcomes: &[Outcome],
) -> Result<(), String> {
    rows::settings(figure, draft, outcomes)?;
    rows::rows(draft, outcomes);
    rows::tables(draft, outcomes)?;
    pictures::draw(figure, draft, outcomes)
}

/// Solves all cases of a figure, with the motions in the pictures if `moving`.
fn solve_all(
    figure: &'static Figure,
    draft: &Draft<'_>,
    moving: bool,
) -> Result<Vec<Outcome>, String> {
    draft.solve(&cases(figure, draft.quick), |case| {
        let outcome = Outcome::new(case, moving && (case.is_drawn() || case.is_drawn_mean()));
        outcome.map_err(|e| format!("{} {}: {e}", figure.id, case.resolution.name()))
    })
}

fn cases(figure: &'static Figure, quick: bool) -> Vec<Case> {
    let (rods, seeds) = if quick {
        (figure.quick_rods, QUICK_SEEDS)
    } else {
        (figure.rods, SEEDS)
    };
    let mut all = Vec::new();
    for model in models("linkers", false) {
        for seed in 0..model.seeds(seeds) {
            let mixed = rods.iter().map(|&rod| Resolution::Mixed(rod));
            let rod = (seed == 0).then_some(Resolution::Rod);
            let resolutions = mixed.chain(rod).chain([Resolution::Ellipsoids]);
            let own = resolutions.filter(|&r| model.solved_at(r) == model);
            all.extend(own.map(|resolution| Case {
                figure,
                resolution,
                model,
                seed,
            }));
        }
    }
    all
}

impl Case {
    /// True for cases in the pictures: the rod of the paper and the first sampling of the bonds.
    fn is_drawn(&self) -> bool {
        self.model.is_shown() && self.seed == 0
    }

    /// True for the mean filament without rod, which is also in the pictures.
    fn is_drawn_mean(&self) -> bool {
        self.model.is_mean && self.resolution == Resolution::Ellipsoids
    }

    fn rod_nm(&self) -> f64 {
        self.resolution.rod_nm(self.figure.length_nm)
    }

    fn scene(&self) -> Result<Scene, String> {
        let mut scene = scenario(self.figure.file)?;
        let (length, rod) = (self.figure.length_nm, self.rod_nm());
        let rods = [[0.5 * (length - rod), 0.5 * (length + rod)]];
        let segments = |rod_nm| Some(segments(rod_nm, self.model.segment_nm));
        scene.filament.sections = sections(length, rods, segments).into();
        self.model.apply(&mut scene, self.seed);
        Ok(scene)
    }
}
