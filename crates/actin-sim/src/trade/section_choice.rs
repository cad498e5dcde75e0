//! Choice of sections before a run, for a wanted accuracy.

use super::ladder::{self, Proposal};
use super::measure::{Measure, Measurer};
use super::resolution::{FullResolution, every_monomer_of};
use super::run::{Limits, RunResult, run_once};
use super::worst;
use crate::scene::{Adaptive, Scene, SceneProblem, Task};
use crate::{Assembly, Estimate};
use actin_assembly::SectionChoice;
use actin_assembly::whole::to_count;
use std::time::Instant;

/// Limit of the bond evaluations of a reference motion, a few seconds of time. The comparison of a longer motion covers
/// its beginning only.
const MOST_WORK: f64 = 1e9;

const FEWEST_RECORDS: usize = 10;

/// Evaluation time of a rod segment under `Homogenised`, in evaluations of a bond.
const BONDS_PER_SEGMENT: f64 = 15.0;

/// Builds a scene; chooses automatic sections first.
///
/// # Errors
/// As [`Assembly::build`]; if no sections can be chosen.
pub fn build(scene: &Scene) -> Result<Assembly, SceneProblem> {
    let mut filaments = scene.filaments();
    if filaments.all(|filament| filament.sections.adaptive().is_none()) {
        return Assembly::build(scene);
    }
    scene.validate()?;
    let (scene, chosen) = choose(scene)?;
    let mut built = Assembly::build(&scene)?;
    built.build_s += chosen.wall_s;
    built.chosen = Some(chosen);
    Ok(built)
}

/// Returns the scene with explicit sections in place of `Adaptive`.
///
/// The choice meets the wanted errors with the least work. Work is counted in evaluations, so the choice is reproducible.
/// For an equilibrium without a limit of monomers the choice is every monomer, since any measured error requires that run.
///
/// # Errors
/// Scenes without a reference, wanted quantities without a counterpart in the scene, a reference without a result.
fn choose(scene: &Scene) -> Result<(Scene, SectionChoice), SceneProblem> {
    let began = Instant::now();
    let choice = Choice::new(scene)?;
    let (full, assembly) = choice.full_resolution()?;
    let measures: Vec<Measure> = choice.wanted.iter().map(|(one, _)| one.clone()).collect();
    let measurer = Measurer::new(&assembly, &measures)?;
    let is_equilibrium = matches!(scene.task, Task::Equilibrium(_));
    let (resolved, mut chosen) = if is_equilibrium && choice.most_monomers.is_none() {
        let chosen = choice.chosen("every monomer", assembly.counts().monomers);
        (full.scene, chosen)
    } else {
        choice.by_trial(&full, &assembly, measurer)?
    };
    chosen.wall_s = began.elapsed().as_secs_f64();
    Ok((choice.with_sections_of(&resolved), chosen))
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
        FullResolution::new(every, fixed)
    }

    fn with_sections_of(&self, other: &Scene) -> Scene {
        let mut scene = self.scene.clone();
        let filaments = scene.filaments_mut().zip(other.filaments());
        for ((filament, other), is_chosen) in filaments.zip(&self.adaptive) {
            if *is_chosen {
                filament.sections = other.sections.clone();
            }
        }
        scene
    }

    /// Returns the scene of the best resolution.
    fn by_trial(
        &self,
        full: &FullResolution,
        assembly: &Assembly,
        mut measurer: Measurer,
    ) -> Result<(Scene, SectionChoice), SceneProblem> {
        let bonds = assembly.counts().bonds;
        let records = full.estimate.map(|all| compared_records(&all, bonds));
        let limits = Limits {
            records,
            ..Limits::NONE
        };
        let reference = run_once(&full.scene, limits)
            .map_err(|failure| failure.into_problem("cannot be chosen: the run fails"))?;
        let values = measurer.values(&reference.assembly, &reference.records);
        measurer.set_scales(&values);
        let exact = vec![0.0; self.wanted.len()];
        let mut tried = vec![self.assess("every monomer", &full.scene, &reference, exact)];
        for Proposal { name, scene } in ladder::sections(full) {
            // Resolutions without a result are not candidates.
            let Ok(result) = run_once(&scene, limits) else {
                continue;
            };
            let found = measurer.values(&result.assembly, &result.records);
            let errors = self.errors(&measurer, &measurer.errors(&values, &found));
            tried.push(self.assess(&name, &scene, &result, errors));
        }
        let best = self.best(&tried)?;
        let share = full.estimate.zip(records);
        let share = share.map(|(all, first)| (first as f64 / all.records() as f64).min(1.0));
        let chosen = SectionChoice {
            errors: best.errors.clone(),
            is_met: best.excess <= 1.0,
            share: share.unwrap_or(1.0),
            tried: tried.len() - 1,
            ..self.chosen(&best.name, best.monomers)
        };
        Ok((best.scene.clone(), chosen))
    }

    /// Returns the largest error of each wanted quantity, from the `errors` of all items.
    fn errors(&self, measurer: &Measurer, errors: &[Option<f64>]) -> Vec<f64> {
        let of_wanted = |(measure, _): &(Measure, f64)| {
            let items = measurer.items.iter().zip(errors);
            let of = items.filter(|(item, _)| item.measure == *measure);
            worst(&of.map(|(_, error)| *error).collect::<Vec<_>>())
        };
        self.wanted.iter().map(of_wanted).collect()
    }

    fn assess(&self, name: &str, scene: &Scene, result: &RunResult, errors: Vec<f64>) -> Trial {
        let limits = self.wanted.iter().zip(&errors);
        let ratios = limits.map(|((_, limit), error)| error / limit);
        let excess = ratios.fold(0.0, f64::max);
        let counts = result.assembly.counts();
        let each = counts.bonds as f64 + BONDS_PER_SEGMENT * counts.segments as f64;
        Trial {
            name: name.to_owned(),
            scene: scene.clone(),
            monomers: counts.monomers,
            errors,
            excess,
            work: result.evaluations as f64 * each,
        }
    }

    /// Returns the trial with the least work within the wanted errors, or the one with the smallest errors. Trials with too
    /// many monomers are excluded.
    fn best<'t>(&self, tried: &'t [Trial]) -> Result<&'t Trial, SceneProblem> {
        let most = self.most_monomers.unwrap_or(usize::MAX);
        let allowed = || tried.iter().filter(|one| one.monomers <= most);
        let good = allowed().filter(|one| one.excess <= 1.0);
        let least = good.min_by(|a, b| a.work.total_cmp(&b.work));
        let nearest = || allowed().min_by(|a, b| a.excess.total_cmp(&b.excess));
        least.or_else(nearest).ok_or_else(|| {
            let rule = "too few: no resolution within this limit has a result; raise the limit";
            SceneProblem::new("filament.sections.monomers", most, rule)
        })
    }
}

/// Returns the number of records of a motion that are compared.
fn compared_records(motion: &Estimate, bonds: usize) -> usize {
    let all = usize::try_from(motion.records()).unwrap_or(usize::MAX);
    let work = motion.force_evaluations as f64 * bonds as f64;
    let share = MOST_WORK / work.max(MOST_WORK);
    let first = to_count((share * all as f64).ceil());
    first.max(FEWEST_RECORDS).min(all)
}

struct Trial {
    name: String,
    scene: Scene,
    monomers: usize,
    errors: Vec<f64>,
    /// Largest ratio of an error to its limit.
    excess: f64,
    work: f64,
}
