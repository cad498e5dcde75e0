//! Figures 5 and 6: free filaments on linkers in one plane and on all sides.
//!
//! Newton's method starts from several rotations of the filament about its axis, and the equilibrium of lowest energy
//! is used. Energies against time are from damped dynamics of the built state with displaced anchors.

mod pictures;
mod rows;
mod solve;

use super::draft::Draft;
use super::model::{Model, Resolution, Rods, monomers};
use crate::run::scenario;
use actin_sim::{JunctionWeight, Scene, Section};
use solve::Outcome;

const SEEDS: u64 = 8;
const QUICK_SEEDS: u64 = 2;

#[derive(Debug)]
struct Figure {
    id: &'static str,
    name: &'static str,
    file: &'static str,
    length_nm: f64,
    /// Lengths of the rod in the middle (nm), by default and with `--quick`.
    rods: &'static [u32],
    quick_rods: &'static [u32],
}

static FIGURE_5: Figure = Figure {
    id: "fig5",
    name: "Figure 5",
    file: "figure-5/linkers.ron",
    length_nm: 160.0,
    rods: &[30, 50, 70, 90, 110, 130],
    quick_rods: &[30, 90, 130],
};

static FIGURE_6: Figure = Figure {
    id: "fig6",
    name: "Figure 6",
    file: "figure-6/linkers.ron",
    length_nm: 210.0,
    rods: &[30, 50, 70, 90, 110, 130, 150, 170],
    quick_rods: &[30, 90, 170],
};

/// Rod of the figures of the paper: constant rigidities, segments of 10 nm.
const STANDARD: Model = Model {
    words: "constant rigidities, segments of 10 nm",
    ..Model::STANDARD
};
const FITTED: Model = Model {
    name: "/fitted",
    words: "law Fitted, segments of 10 nm",
    rods: Rods::Fitted,
    ..STANDARD
};
const FULL: Model = Model {
    name: "/full",
    words: "junction full",
    junction: JunctionWeight::Full,
    ..STANDARD
};
const MEAN: Model = Model {
    name: "/mean-filament",
    words: "mean filament",
    is_mean: true,
    ..STANDARD
};
/// All models, the standard one first. Refined rods have segments of 1.25 nm.
const MODELS: [Model; 7] = [
    STANDARD,
    Model {
        name: "/fine",
        words: "constant rigidities, segments of 1.25 nm",
        segment_nm: 1.25,
        ..STANDARD
    },
    FITTED,
    Model {
        name: "/fitted-fine",
        words: "law Fitted, segments of 1.25 nm",
        segment_nm: 1.25,
        ..FITTED
    },
    Model {
        name: "/fitted-without-shear-fine",
        words: "law Fitted but constant shear, segments of 1.25 nm",
        segment_nm: 1.25,
        rods: Rods::FittedWithoutShear,
        ..STANDARD
    },
    FULL,
    MEAN,
];

#[derive(Clone, Copy, Debug)]
struct Case {
    figure: &'static Figure,
    resolution: Resolution,
    model: Model,
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
    draft.settings = rows::settings(figure, outcomes);
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
    let outcomes = draft.solve(&cases(figure, draft.quick), |case| {
        let outcome = Outcome::new(case, moving && (case.is_drawn() || case.is_drawn_mean()));
        outcome.map_err(|e| format!("{} {}: {e}", figure.id, case.resolution.name()))
    });
    outcomes.into_iter().collect()
}

fn cases(figure: &'static Figure, quick: bool) -> Vec<Case> {
    let (rods, seeds) = if quick {
        (figure.quick_rods, QUICK_SEEDS)
    } else {
        (figure.rods, SEEDS)
    };
    let mut all = Vec::new();
    for model in MODELS {
        for seed in 0..model.seeds(seeds) {
            let mixed = rods.iter().map(|&rod| Resolution::Mixed(rod));
            let rod = (seed == 0).then_some(Resolution::Rod);
            let resolutions = mixed.chain(rod).chain([Resolution::Ellipsoids]);
            let own = resolutions.filter(|&r| model.solved_as(&MODELS, r) == model);
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
        self.model == STANDARD && self.seed == 0
    }

    /// True for the mean filament without rod, which is also in the pictures.
    fn is_drawn_mean(&self) -> bool {
        self.model == MEAN && self.resolution == Resolution::Ellipsoids
    }

    fn rod_nm(&self) -> f64 {
        self.resolution.rod_nm(self.figure.length_nm)
    }

    fn scene(&self) -> Result<Scene, String> {
        let mut scene = scenario(self.figure.file)?;
        scene.filament.sections = self.sections().into();
        self.model.apply(&mut scene, self.seed);
        Ok(scene)
    }

    fn sections(&self) -> Vec<Section> {
        let (length, rod) = (self.figure.length_nm, self.rod_nm());
        let (from, to) = (0.5 * (length - rod), 0.5 * (length + rod));
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small count"
        )]
        let segments = (rod / self.model.segment_nm).round() as usize;
        let rod = Section::rod(from, to, Some(segments));
        match self.resolution {
            Resolution::Mixed(_) => vec![monomers(0.0, from), rod, monomers(to, length)],
            Resolution::Rod => vec![rod],
            Resolution::Ellipsoids => vec![monomers(0.0, length)],
        }
    }
}
