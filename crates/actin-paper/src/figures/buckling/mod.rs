//! Figures 8 and 10: filaments with opposite rotations of the ends under compression.
//!
//! Every state is an equilibrium at the end of a path of turns and shifts, with a certificate of stability. One
//! resolution is also computed by dynamics. A force of 1e-3 pN at half the length breaks the symmetry. Only observables
//! that are independent of its direction are compared.

mod case;
mod pictures;
mod plane;
mod rows;
mod solve;
mod starts;

use super::draft::Draft;
use super::model::{Model, Resolution, Rods};
use crate::statistics::{Sample, sample};
use actin_sim::{ForceLaw, Hold, JunctionWeight};
use case::{Case, Start};
use solve::{BuckledState, Motion, Outcome};

const LENGTH_NM: f64 = 300.0;
/// Lengths of rod (nm) in the paper and with `--quick`. Each end has half of the rod.
const RODS: [u32; 7] = [240, 207, 173, 140, 107, 73, 40];
const QUICK_RODS: [u32; 3] = [240, 140, 40];
/// Largest turn (deg) with the balance as printed. Larger turns have many states.
const FEW_STATES_DEG: i32 = 270;

#[derive(Debug)]
struct Figure {
    id: &'static str,
    /// Scene file in `scenarios`.
    file: &'static str,
    /// Name of the rod law in captions.
    rods: &'static str,
    /// Models; the figure shows the first one.
    models: &'static [Model],
    /// Turns of the ends (deg).
    turns: &'static [i32],
    /// Samplings of the bonds, by default and with `--quick`.
    seeds: [u64; 2],
    /// Starts of the shown model, and turns (deg) with all starts, by default and with `--quick`.
    starts: [fn() -> Vec<Start>; 2],
    started: [&'static [i32]; 2],
}

const SHOWN_8: Model = Model {
    hold: Hold::TwoNodesAndFrame,
    ..Model::STANDARD
};
const SHOWN_10: Model = Model {
    rods: Rods::Extended,
    hold: Hold::NodeAndFrame,
    ..Model::STANDARD
};
const MEAN_8: Model = mean(SHOWN_8);
const MEAN_10: Model = mean(SHOWN_10);

const fn mean(model: Model) -> Model {
    Model {
        name: "mean-filament/",
        words: "mean filament",
        is_mean: true,
        ..model
    }
}

const fn wall(model: Model) -> Model {
    Model {
        name: "wall/",
        words: "clamp Wall",
        hold: Hold::Wall,
        ..model
    }
}

const FULL: Model = Model {
    name: "full/",
    words: "junction as printed",
    junction: JunctionWeight::Full,
    ..SHOWN_8
};
const CONSTANT: Model = Model {
    name: "standard/",
    words: "constant rigidities",
    rods: Rods::Constant,
    ..SHOWN_10
};
const COUPLING: Model = Model {
    name: "coupling-energy/",
    words: "C3 energy",
    rods: Rods::CouplingEnergy,
    ..SHOWN_10
};
/// Extended rod with the balance of forces and torques as printed, which has no energy.
const AS_PRINTED: Model = Model {
    name: "paper-balance/",
    words: "balance as printed",
    balance: ForceLaw::PaperBalance,
    ..MEAN_10
};

static FIGURE_8: Figure = Figure {
    id: "fig8",
    file: "figure-8/rod-140.ron",
    rods: "rods of constant rigidities",
    models: &[SHOWN_8, MEAN_8, wall(SHOWN_8), FULL],
    turns: &[180, -180],
    seeds: [8, 2],
    starts: [Start::all, Start::orders],
    started: [&[180, -180], &[180, -180]],
};

static FIGURE_10: Figure = Figure {
    id: "fig10",
    file: "figure-10/rod-140.ron",
    rods: "rods with the published B3(kappa) and xi(kappa)",
    models: &[
        SHOWN_10,
        MEAN_10,
        wall(SHOWN_10),
        CONSTANT,
        COUPLING,
        AS_PRINTED,
    ],
    turns: &[180, -180, 270, -270, 360, -360],
    seeds: [4, 1],
    starts: [Start::all, Start::all],
    started: [&[360, -360], &[360]],
};

pub(super) fn figure8(draft: &mut Draft<'_>) -> Result<(), String> {
    reproduce(&Plan::new(&FIGURE_8, draft.quick), draft)
}

/// Figure 10: rods with the published twist extensions.
pub(super) fn figure10(draft: &mut Draft<'_>) -> Result<(), String> {
    let plan = Plan::new(&FIGURE_10, draft.quick);
    reproduce(&plan, draft)?;
    if draft.quick {
        return Ok(());
    }
    pictures::followed(draft)
}

fn reproduce(plan: &Plan, draft: &mut Draft<'_>) -> Result<(), String> {
    let mut results = Results::default();
    let mut failures = Vec::new();
    let mut keep = |failure| failures.push(failure);
    let motions = draft.solve(&plan.moved(), solve::motion).into_iter();
    results.motions = motions.filter_map(|r| r.map_err(&mut keep).ok()).collect();
    let outcomes = draft.solve(&plan.cases(), solve::outcome).into_iter();
    results.outcomes = outcomes.filter_map(|r| r.map_err(&mut keep).ok()).collect();
    results.failures = failures;
    draft.settings = format!(
        "Scene scenarios/{} and variants: {} equilibria at the end of paths, {} samplings of the \
         bonds, seeds from 0, and the mean filament, which has no seed; twist first unless named. Rods are 300 nm \
         long; filaments of monomers 290 nm between the inner clamped monomers, 300 nm with the clamp Wall. A force of \
         1e-3 pN at half the length, towards a point at a distance of 100 nm, breaks the symmetry.",
        plan.figure.file,
        results.outcomes.len(),
        plan.seeds,
    );
    rows::rows(plan, draft, &results);
    starts::rows(plan, draft, &results);
    rows::motions(plan, draft, &results);
    rows::tables(draft, &results)?;
    pictures::draw(plan, draft, &results)
}

/// Resolutions, samplings and starts of one run.
#[derive(Clone, Debug)]
struct Plan {
    figure: &'static Figure,
    models: Vec<Model>,
    resolutions: Vec<Resolution>,
    seeds: u64,
    /// Starts of the shown model, and turns with all starts.
    starts: Vec<Start>,
    started: &'static [i32],
    quick: bool,
}

impl Plan {
    fn new(figure: &'static Figure, quick: bool) -> Self {
        let rods: &[u32] = if quick { &QUICK_RODS } else { &RODS };
        let mixed = rods.iter().map(|&rod| Resolution::Mixed(rod));
        let all = [Resolution::Rod].into_iter().chain(mixed);
        let k = usize::from(quick);
        let models = figure.models.iter().copied();
        Self {
            figure,
            models: models.filter(|m| !quick || *m != AS_PRINTED).collect(),
            resolutions: all.chain([Resolution::Ellipsoids]).collect(),
            seeds: figure.seeds[k],
            starts: (figure.starts[k])(),
            started: figure.started[k],
            quick,
        }
    }

    /// Model shown in the figure.
    fn shown(&self) -> Model {
        self.figure.models[0]
    }

    fn case(&self, model: Model, resolution: Resolution, turn_deg: i32, seed: u64) -> Case {
        let is_drawn = !model.is_mean && resolution != Resolution::Rod;
        Case {
            figure: self.figure,
            model: model.solved_as(self.figure.models, resolution),
            resolution,
            turn_deg,
            seed: if is_drawn { seed } else { 0 },
            start: Start::DEFAULT,
            is_started: self.started.contains(&turn_deg),
        }
    }

    fn turns_of(&self, model: Model) -> impl Iterator<Item = i32> {
        let most = if model == AS_PRINTED {
            FEW_STATES_DEG
        } else {
            i32::MAX
        };
        let turns = self.figure.turns.iter().copied();
        turns.filter(move |turn| turn.abs() <= most)
    }

    /// Starts at a turn, at least both orders.
    fn starts_at(&self, turn: i32) -> Vec<Start> {
        if self.started.contains(&turn) {
            self.starts.clone()
        } else {
            Start::orders()
        }
    }

    /// Cases computed by dynamics: one mixed resolution in both directions; empty with `--quick`.
    fn moved(&self) -> Vec<Case> {
        let turns: &[i32] = if self.quick { &[] } else { &[180, -180] };
        let case = |&turn| self.case(self.shown(), Resolution::Mixed(140), turn, 0);
        turns.iter().map(case).collect()
    }

    fn cases(&self) -> Vec<Case> {
        let mut all = Vec::new();
        for &model in &self.models {
            for turn in self.turns_of(model) {
                for &resolution in &self.resolutions {
                    let seeds = 0..model.seeds(self.seeds);
                    all.extend(seeds.map(|seed| self.case(model, resolution, turn, seed)));
                }
            }
        }
        for &turn in self.figure.turns {
            for &resolution in &self.resolutions {
                let case = self.case(self.shown(), resolution, turn, 0);
                let starts = self.starts_at(turn).into_iter();
                all.extend(starts.map(|start| Case { start, ..case }));
            }
        }
        let mut unique: Vec<Case> = Vec::with_capacity(all.len());
        for case in all {
            if !unique.contains(&case) {
                unique.push(case);
            }
        }
        unique
    }
}

#[derive(Debug, Default)]
struct Results {
    outcomes: Vec<Outcome>,
    motions: Vec<Motion>,
    failures: Vec<String>,
}

impl Results {
    fn of(&self, case: Case) -> Option<&Outcome> {
        self.outcomes.iter().find(|outcome| outcome.case == case)
    }

    /// Outcomes of all samplings of a case.
    fn samplings(&self, case: Case) -> impl Iterator<Item = &Outcome> {
        self.outcomes.iter().filter(move |outcome| {
            let seed = outcome.case.seed;
            outcome.case == Case { seed, ..case }
        })
    }

    /// Statistics of an observable over samplings; `None` without outcomes.
    fn sample(&self, case: Case, of: fn(&BuckledState) -> f64) -> Option<Sample> {
        let sample = sample(self.samplings(case).map(|o| of(&o.measured)));
        (sample.count > 0).then_some(sample)
    }
}

/// Name, unit and value of an observable that is independent of the plane of buckling.
type Observable = (&'static str, &'static str, fn(&BuckledState) -> f64);

const OBSERVABLES: [Observable; 4] = [
    ("height", "nm", |m| m.height_nm),
    ("couple", "pN nm", |m| m.couple_pn_nm),
    ("force", "pN", |m| m.force_pn),
    ("energy", "pN nm", |m| m.energy_pn_nm),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean filament affects all resolutions except the rod, the junction only the seven mixed ones.
    #[test]
    fn models_add_only_affected_filaments() {
        let [eight, ten] = [&FIGURE_8, &FIGURE_10].map(|figure| Plan::new(figure, false));
        for plan in [&eight, &ten] {
            assert!(plan.seeds >= 3 && plan.starts.len() >= 6);
            assert_eq!(plan.resolutions.len(), 9);
        }
        let count = |plan: &Plan, model: Model| {
            plan.cases()
                .iter()
                .filter(|case| case.model == model)
                .count()
        };
        assert_eq!(count(&eight, MEAN_8), 2 * 8);
        assert_eq!(count(&eight, FULL), 2 * 7 * 8);
        assert_eq!(count(&ten, AS_PRINTED), 4 * 8);
        assert_eq!(count(&Plan::new(&FIGURE_10, true), AS_PRINTED), 0);
    }
}
