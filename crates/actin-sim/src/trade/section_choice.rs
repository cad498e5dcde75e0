//! Choice of sections before a run, for a wanted accuracy.

use super::ladder::{self, Proposal};
use super::measure::{Measure, Measurer, Values};
use super::resolution::{FullResolution, every_monomer_of, with_records_of};
use super::run::{Limits, RunResult, TrialFailure, run_once};
use super::worst;
use crate::scene::{Adaptive, Scene, SceneProblem, Section, Task};
use crate::{Assembly, Plan};
use actin_assembly::SectionChoice;
use std::time::Instant;

/// Limit of the bond evaluations of a reference motion, a few seconds of time. The comparison of a longer motion covers
/// its beginning only.
const MOST_WORK: f64 = 1e9;

const FEWEST_RECORDS: usize = 10;

/// Evaluation time of a rod segment under `Homogenised`, in evaluations of a bond.
const BONDS_PER_SEGMENT: f64 = 15.0;

/// Returns the scene with explicit sections in place of `Adaptive`.
///
/// The choice meets the wanted errors with the least work. Work is counted in evaluations, so the choice is reproducible.
/// For an equilibrium without a limit of monomers the choice is every monomer, since any measured error requires that run.
///
/// # Errors
/// Scenes without a reference, wanted quantities without a counterpart in the scene, a reference without a result.
pub(crate) fn choose(scene: &Scene) -> Result<(Scene, SectionChoice), SceneProblem> {
    let began = Instant::now();
    let choice = Choice::new(scene)?;
    let is_equilibrium = matches!(scene.task, Task::Equilibrium(_));
    let (written, mut chosen) = if is_equilibrium && choice.most_monomers.is_none() {
        choice.every_monomer()?
    } else {
        choice.by_trial()?
    };
    chosen.wall_s = began.elapsed().as_secs_f64();
    Ok((written, chosen))
}

struct Choice<'a> {
    scene: &'a Scene,
    /// Wanted quantities of all filaments, with their largest errors.
    wanted: Vec<(Measure, f64)>,
    most_monomers: Option<usize>,
    /// True for each filament with `Adaptive` sections.
    adaptive: Vec<bool>,
}

impl<'a> Choice<'a> {
    fn new(scene: &'a Scene) -> Result<Self, SceneProblem> {
        if scene.thermal().is_some() {
            let rule = "sections are chosen for motion without heat only: in heat, write sections and compare means over \
                        seeds with `actin trade`";
            return Err(SceneProblem::new("task", "", rule));
        }
        let all: Vec<Option<&Adaptive>> = scene
            .filaments()
            .map(|filament| filament.sections.adaptive())
            .collect();
        let adaptive: Vec<bool> = all.iter().map(Option::is_some).collect();
        let targets = all.iter().flatten().flat_map(|one| one.targets());
        let wanted = targets.map(|want| (want.quantity().into(), want.error()));
        let limits = all.iter().flatten().map(|one| one.monomers);
        Ok(Self {
            scene,
            wanted: wanted.collect(),
            most_monomers: limits.reduce(|a, b| Some(a? + b?)).flatten(),
            adaptive,
        })
    }

    fn chosen(&self, name: &str, monomers: usize) -> SectionChoice {
        let wanted = self.wanted.iter();
        SectionChoice {
            wanted: wanted
                .map(|(measure, error)| (measure.to_string(), *error))
                .collect(),
            most_monomers: self.most_monomers,
            is_met: true,
            name: name.to_owned(),
            monomers,
            errors: Vec::new(),
            share: 1.0,
            tried: 0,
            wall_s: 0.0,
        }
    }

    fn full_resolution(&self) -> Result<(FullResolution, Assembly), SceneProblem> {
        let (every, fixed) = every_monomer_of(self.scene, |filament| self.adaptive[filament]);
        let mut adaptive = self.adaptive.iter().zip(&fixed);
        if let Some(reason) = adaptive.find_map(|(chosen, fixed)| (*fixed).filter(|_| *chosen)) {
            return Err(SceneProblem::new(
                "filament.sections",
                "Adaptive(..)",
                reason,
            ));
        }
        let assembly = Assembly::build(&every)?;
        let plan = Plan::new(&assembly)?;
        let mut full = FullResolution::new(&assembly, fixed);
        full.scene = with_records_of(every, plan.scene());
        Ok((full, assembly))
    }

    fn measurer(&self, assembly: &Assembly) -> Result<Measurer, SceneProblem> {
        let wanted = self.wanted.iter();
        let measures: Vec<Measure> = wanted.map(|(measure, _)| measure.clone()).collect();
        Measurer::new(assembly, &measures)
    }

    fn every_monomer(&self) -> Result<(Scene, SectionChoice), SceneProblem> {
        let (full, assembly) = self.full_resolution()?;
        self.measurer(&assembly)?;
        let monomers = assembly.counts().monomers;
        Ok((
            self.with_sections_of(&full.scene),
            self.chosen("every monomer", monomers),
        ))
    }

    fn with_sections_of(&self, other: &Scene) -> Scene {
        let mut scene = self.scene.clone();
        let filaments = scene.filaments_mut().zip(other.filaments());
        for ((filament, other), is_chosen) in filaments.zip(&self.adaptive) {
            if *is_chosen {
                filament.sections = other
                    .sections
                    .iter()
                    .cloned()
                    .collect::<Vec<Section>>()
                    .into();
            }
        }
        scene
    }

    fn by_trial(&self) -> Result<(Scene, SectionChoice), SceneProblem> {
        let (full, assembly) = self.full_resolution()?;
        let mut measurer = self.measurer(&assembly)?;
        let records = records_of(&assembly)?;
        let reference = trial(&full.scene, records.map(|(first, _)| first))?;
        let values = measurer.values(&reference.assembly, &reference.records);
        measurer.set_scales(&values);
        let mut tried = vec![self.assess(
            "every monomer",
            &full.scene,
            &reference,
            vec![0.0; measurer.items.len()],
        )];
        for Proposal { name, scene } in ladder::sections(&full) {
            // Resolutions without a result are not candidates.
            let Ok(result) = trial(&scene, records.map(|(first, _)| first)) else {
                continue;
            };
            let found = measurer.values(&result.assembly, &result.records);
            tried.push(self.assess(
                &name,
                &scene,
                &result,
                self.errors(&measurer, (&values, &found)),
            ));
        }
        let best = self.best(&tried)?;
        let mut chosen = self.chosen(&best.name, best.monomers);
        chosen.errors.clone_from(&best.errors);
        chosen.is_met = best.is_good;
        chosen.share = records.map_or(1.0, |(first, all)| (first as f64 / all as f64).min(1.0));
        chosen.tried = tried.len() - 1;
        Ok((self.with_sections_of(&best.scene), chosen))
    }

    fn errors(&self, measurer: &Measurer, (values, found): (&Values, &Values)) -> Vec<f64> {
        let all = measurer.errors(values, found);
        let of_wanted = |measure: &Measure| {
            let items = measurer.items.iter().zip(&all);
            let of = items.filter(|(item, _)| item.measure == *measure);
            worst(&of.map(|(_, error)| *error).collect::<Vec<_>>())
        };
        self.wanted
            .iter()
            .map(|(measure, _)| of_wanted(measure))
            .collect()
    }

    fn assess(&self, name: &str, scene: &Scene, result: &RunResult, errors: Vec<f64>) -> Trial {
        let limits = self.wanted.iter().zip(&errors);
        let excess = limits
            .map(|((_, limit), error)| error / limit)
            .fold(0.0, f64::max);
        let counts = result.counts;
        let each = counts.bonds as f64 + BONDS_PER_SEGMENT * counts.segments as f64;
        Trial {
            name: name.to_owned(),
            scene: scene.clone(),
            monomers: counts.monomers,
            errors,
            excess,
            is_good: excess <= 1.0,
            work: result.evaluations as f64 * each,
        }
    }

    /// Returns the trial with the least work within the wanted errors, or the one with the smallest errors. Trials with too
    /// many monomers are excluded.
    fn best<'t>(&self, tried: &'t [Trial]) -> Result<&'t Trial, SceneProblem> {
        let most = self.most_monomers.unwrap_or(usize::MAX);
        let allowed = || tried.iter().filter(|one| one.monomers <= most);
        let good = allowed().filter(|one| one.is_good);
        let least = good.min_by(|a, b| a.work.total_cmp(&b.work));
        let nearest = || allowed().min_by(|a, b| a.excess.total_cmp(&b.excess));
        least.or_else(nearest).ok_or_else(|| {
            let rule = "too few: no resolution within this limit has a result; raise the limit";
            SceneProblem::new("filament.sections.monomers", most, rule)
        })
    }
}

/// Returns the number of compared records of a motion and the number of all its records; `None` for an equilibrium.
fn records_of(assembly: &Assembly) -> Result<Option<(usize, usize)>, SceneProblem> {
    let plan = Plan::new(assembly)?;
    let Some(estimate) = plan.estimate() else {
        return Ok(None);
    };
    let all =
        usize::try_from(estimate.steps / estimate.steps_between_records + 1).unwrap_or(usize::MAX);
    let work = estimate.force_evaluations as f64 * assembly.counts().bonds as f64;
    let share = MOST_WORK / work.max(MOST_WORK);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share of a number of records"
    )]
    let first = (share * all as f64).ceil() as usize;
    Ok(Some((first.max(FEWEST_RECORDS).min(all), all)))
}

struct Trial {
    name: String,
    scene: Scene,
    monomers: usize,
    errors: Vec<f64>,
    /// Largest ratio of an error to its limit.
    excess: f64,
    is_good: bool,
    work: f64,
}

fn trial(scene: &Scene, records: Option<usize>) -> Result<RunResult, SceneProblem> {
    let limits = Limits {
        budget: None,
        records,
        is_interrupted: &|| false,
    };
    run_once(scene, limits).map_err(|failure| match failure {
        TrialFailure::Refused(problem) => problem,
        TrialFailure::Interrupted | TrialFailure::Failed(_) => {
            let rule = format!("cannot be chosen: the run fails: {failure}");
            SceneProblem::new("filament.sections", "", rule)
        }
    })
}
