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
use super::model::{Model, Resolution, models};
use super::texts::Values;
use crate::statistics::{SampleStatistics, distinct, sample};
use case::{Case, Start};
use solve::{BuckledState, Motion, Outcome};

const LENGTH_NM: f64 = 300.0;
/// Lengths of rod (nm) in the paper and with `--quick`. Each end has half of the rod.
const RODS: [u32; 7] = [240, 207, 173, 140, 107, 73, 40];
const QUICK_RODS: [u32; 3] = [240, 140, 40];

/// Names of the models with `--quick`: the model of the picture, and rods of constant rigidities.
const QUICK_MODELS: [&str; 2] = ["", "standard/"];

fn models_of(figure: &str, quick: bool) -> Vec<&'static Model> {
    let mut all = models(figure, quick);
    all.retain(|model| !quick || QUICK_MODELS.contains(&model.name.as_str()));
    all
}

/// All resolutions, from the rod to the filament of monomers.
fn resolutions(quick: bool) -> Vec<Resolution> {
    let rods: &[u32] = if quick { &QUICK_RODS } else { &RODS };
    let mixed = rods.iter().map(|&rod| Resolution::Mixed(rod));
    let all = [Resolution::Rod].into_iter().chain(mixed);
    all.chain([Resolution::Ellipsoids]).collect()
}

/// Largest turn (deg) with the balance as printed. Larger turns have many states.
const FEW_STATES_DEG: i32 = 270;

pub(super) fn figure8(draft: &mut Draft<'_>) -> Result<(), String> {
    reproduce(&Plan::figure8(draft.quick), draft)
}

/// Figure 10: rods with the published twist extensions.
pub(super) fn figure10(draft: &mut Draft<'_>) -> Result<(), String> {
    reproduce(&Plan::figure10(draft.quick), draft)?;
    if draft.quick {
        return Ok(());
    }
    pictures::followed(draft)
}

fn reproduce(plan: &Plan, draft: &mut Draft<'_>) -> Result<(), String> {
    let mut results = Results::default();
    let mut failures = Vec::new();
    let mut keep = |failure| failures.push(failure);
    let motions = draft.attempt(&plan.moved(), solve::motion).into_iter();
    results.motions = motions.filter_map(|r| r.map_err(&mut keep).ok()).collect();
    let outcomes = draft.attempt(&plan.cases(), solve::outcome).into_iter();
    results.outcomes = outcomes.filter_map(|r| r.map_err(&mut keep).ok()).collect();
    results.failures = failures;
    let values: Values<'_> = &[
        ("file", &file(plan.id)),
        ("count", &results.outcomes.len()),
        ("seeds", &plan.seeds),
        (
            "mean",
            &if plan.quick {
                ""
            } else {
                ", and the mean filament, which has no seed"
            },
        ),
    ];
    draft.describe("buckling", values)?;
    rows::rows(plan, draft, &results);
    starts::rows(plan, draft, &results);
    rows::motions(plan, draft, &results);
    rows::tables(draft, &results)?;
    pictures::draw(plan, draft, &results)
}

/// Scene file of a figure in `scenarios`.
fn file(figure: &str) -> String {
    format!("{}/rod-140.ron", figure.replace("fig", "figure-"))
}

/// Cases of one run.
#[derive(Clone, Debug)]
struct Plan {
    id: &'static str,
    /// Name of the rod law in captions.
    rods: &'static str,
    models: Vec<&'static Model>,
    resolutions: Vec<Resolution>,
    /// Turns of the ends (deg).
    turns: &'static [i32],
    /// Samplings of the bonds.
    seeds: u64,
    /// Starts of the shown model, and turns (deg) with all starts.
    starts: Vec<Start>,
    started: &'static [i32],
    quick: bool,
}

impl Plan {
    fn figure8(quick: bool) -> Self {
        Self {
            id: "fig8",
            rods: "rods of constant rigidities",
            models: models_of("fig8", quick),
            resolutions: resolutions(quick),
            turns: &[180, -180],
            seeds: if quick { 1 } else { 8 },
            starts: if quick { Start::orders() } else { Start::all() },
            started: &[180, -180],
            quick,
        }
    }

    fn figure10(quick: bool) -> Self {
        let (turns, started): (&[i32], &[i32]) = if quick {
            (&[180, -180, 360], &[360])
        } else {
            (&[180, -180, 270, -270, 360, -360], &[360, -360])
        };
        Self {
            id: "fig10",
            rods: "rods with the published B3(kappa) and xi(kappa)",
            models: models_of("fig10", quick),
            turns,
            seeds: if quick { 1 } else { 4 },
            started,
            ..Self::figure8(quick)
        }
    }

    /// Model shown in the figure.
    fn shown(&self) -> &'static Model {
        self.models[0]
    }

    fn case(
        &self,
        model: &'static Model,
        resolution: Resolution,
        turn_deg: i32,
        seed: u64,
    ) -> Case {
        let is_drawn = !model.is_mean && resolution != Resolution::Rod;
        Case {
            model: model.solved_at(resolution),
            resolution,
            turn_deg,
            seed: if is_drawn { seed } else { 0 },
            start: Start::DEFAULT,
            is_started: self.started.contains(&turn_deg),
        }
    }

    /// Cases of the shown model at a turn, for the first sampling.
    fn shown_at(&self, turn_deg: i32) -> impl Iterator<Item = Case> {
        let resolutions = self.resolutions.iter();
        resolutions.map(move |&r| self.case(self.shown(), r, turn_deg, 0))
    }

    fn turns_of(&self, model: &Model) -> impl Iterator<Item = i32> {
        let most = if model.has_potential() {
            i32::MAX
        } else {
            FEW_STATES_DEG
        };
        let turns = self.turns.iter().copied();
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
        for &turn in self.turns {
            for case in self.shown_at(turn) {
                let starts = self.starts_at(turn).into_iter();
                all.extend(starts.map(|start| Case { start, ..case }));
            }
        }
        distinct(all)
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

    /// Outcomes of a case from all starts at its turn.
    fn of_all_starts(&self, plan: &Plan, case: Case) -> Vec<&Outcome> {
        let starts = plan.starts_at(case.turn_deg).into_iter();
        let outcomes = starts.filter_map(|start| self.of(Case { start, ..case }));
        outcomes.collect()
    }

    /// Outcomes of all samplings of a case.
    fn samplings(&self, case: Case) -> impl Iterator<Item = &Outcome> {
        self.outcomes.iter().filter(move |outcome| {
            let seed = outcome.case.seed;
            outcome.case == Case { seed, ..case }
        })
    }

    /// Statistics of an observable over samplings; `None` without outcomes.
    fn sample(&self, case: Case, of: fn(&BuckledState) -> f64) -> Option<SampleStatistics> {
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
        let [eight, ten] = [Plan::figure8(false), Plan::figure10(false)];
        for plan in [&eight, &ten] {
            assert!(plan.seeds >= 3 && plan.starts.len() >= 6);
            assert_eq!(plan.resolutions.len(), 9);
        }
        let count = |plan: &Plan, model: &str| {
            let cases = plan.cases().into_iter();
            cases.filter(|case| case.model.name == model).count()
        };
        assert_eq!(count(&eight, "mean-filament/"), 2 * 8);
        assert_eq!(count(&eight, "full/"), 2 * 7 * 8);
        assert_eq!(count(&ten, "paper-balance/"), 4 * 8);
        assert_eq!(count(&Plan::figure10(true), "paper-balance/"), 0);
    }
}
