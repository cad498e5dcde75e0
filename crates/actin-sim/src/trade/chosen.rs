//! Sections that a wanted accuracy needs, chosen before a run.

use super::ladder::{self, Proposal};
use super::measure::{Measure, Measurer, Values};
use super::resolution::{Whole, every_monomer_of};
use super::run::{Limits, Ran, Unusable, run_once};
use super::study::{errors, with_records_of};
use super::worst;
use crate::notes::{Note, codes};
use crate::scene::{Adaptive, Scene, SceneProblem, Section, Task};
use crate::{Assembly, Plan};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Most evaluations of bonds that the reference of a motion takes, some seconds; of a longer one the beginning is
/// compared.
const MOST_WORK: f64 = 1e9;

/// Fewest records of a motion that are compared.
const FEWEST_RECORDS: usize = 10;

/// Evaluations of bonds that one of a segment takes as long as: about that of a rod under `Homogenised`.
const BONDS_PER_SEGMENT: f64 = 15.0;

/// What was chosen, and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chosen {
    /// What was wanted, as `actin trade` names it, with its largest relative error.
    pub wanted: Vec<(String, f64)>,
    /// The most monomers that were allowed; none without a limit.
    pub most_monomers: Option<usize>,
    /// Whether the wanted errors are met.
    pub is_met: bool,
    /// What was chosen.
    pub name: String,
    /// Monomers that are resolved.
    pub monomers: usize,
    /// The largest error of each of what was wanted, against every monomer; empty where every monomer is resolved.
    pub errors: Vec<f64>,
    /// Share of the records of a motion that were compared.
    pub share: f64,
    /// Resolutions that were run beside the reference.
    pub tried: usize,
    /// Time that the choice took (s).
    pub wall_s: f64,
}

impl Chosen {
    /// The choice in a sentence or two.
    pub(crate) fn note(&self) -> Note {
        let wanted = self.wanted.iter();
        let wanted: Vec<String> = wanted
            .map(|(what, error)| format!("{what} within {} %", 100.0 * error))
            .collect();
        let limit = self
            .most_monomers
            .map_or_else(String::new, |most| format!(" with at most {most} monomers"));
        let found = if self.errors.is_empty() {
            "; no reference was run, since one equilibrium of every monomer is the reference"
                .to_owned()
        } else {
            let errors = self.errors.iter().map(|e| format!("{:.2} %", 100.0 * e));
            let errors: Vec<String> = errors.collect();
            let part = if self.share < 1.0 {
                format!(" in the first {:.0} % of the motion", 100.0 * self.share)
            } else {
                String::new()
            };
            format!(
                "; its error against every monomer is {}{part}",
                errors.join(", ")
            )
        };
        let missed = if self.is_met {
            ""
        } else {
            ". What is wanted is not met within so many monomers: of those tried this one is nearest"
        };
        let message = format!(
            "sections chosen for {}{limit}: {}{found}{missed}",
            wanted.join(", "),
            self.name
        );
        if self.is_met {
            message.into()
        } else {
            Note::warning(codes::RESOLUTION, message)
        }
    }
}

/// The scene with sections written for those that are left to the program: what meets the wanted errors with the least
/// work, counted in evaluations, so that it is the same each time.
///
/// Of an equilibrium without a limit of monomers that is every monomer: to know the error of anything else takes that
/// run.
///
/// # Errors
/// Scenes that cannot be compared, a wanted quantity that a scene does not have, a reference without a result.
pub fn choose(scene: &Scene) -> Result<(Scene, Chosen), SceneProblem> {
    let began = Instant::now();
    let choice = Choice::of(scene)?;
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
    /// What is wanted of all, each with its error.
    wanted: Vec<(Measure, f64)>,
    most_monomers: Option<usize>,
    /// Filaments whose sections are to be chosen.
    adaptive: Vec<bool>,
}

impl<'a> Choice<'a> {
    fn of(scene: &'a Scene) -> Result<Self, SceneProblem> {
        if scene.thermal().is_some() {
            let rule = "sections are chosen for motion without heat only: what a resolution changes in heat shows in means \
                        over many seeds";
            return Err(SceneProblem::new("task", "", rule));
        }
        let all: Vec<Option<&Adaptive>> = scene
            .filaments()
            .map(|filament| filament.sections.adaptive())
            .collect();
        let adaptive: Vec<bool> = all.iter().map(Option::is_some).collect();
        let wants = all.iter().flatten().flat_map(|one| one.wants());
        let wanted = wants.map(|want| (want.quantity().into(), want.error()));
        let limits = all.iter().flatten().map(|one| one.monomers);
        Ok(Self {
            scene,
            wanted: wanted.collect(),
            most_monomers: limits.reduce(|a, b| Some(a? + b?)).flatten(),
            adaptive,
        })
    }

    fn chosen(&self, name: &str, monomers: usize) -> Chosen {
        let wanted = self.wanted.iter();
        Chosen {
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

    /// The scene with every monomer of the filaments that are chosen, and why others keep what they have.
    fn whole(&self) -> Result<(Whole, Assembly), SceneProblem> {
        let (every, kept) = every_monomer_of(self.scene, |filament| self.adaptive[filament]);
        let mut adaptive = self.adaptive.iter().zip(&kept);
        if let Some(reason) = adaptive.find_map(|(chosen, kept)| (*kept).filter(|_| *chosen)) {
            return Err(SceneProblem::new(
                "filament.sections",
                "Adaptive(..)",
                reason,
            ));
        }
        let assembly = Assembly::build(&every)?;
        let plan = Plan::new(&assembly)?;
        let mut whole = Whole::new(&assembly, kept);
        whole.scene = with_records_of(every, plan.scene());
        Ok((whole, assembly))
    }

    fn every_monomer(&self) -> Result<(Scene, Chosen), SceneProblem> {
        let (whole, assembly) = self.whole()?;
        let measures: Vec<Measure> = self
            .wanted
            .iter()
            .map(|(measure, _)| measure.clone())
            .collect();
        Measurer::new(&assembly, &measures)?;
        let monomers = assembly.counts().monomers;
        Ok((
            self.with_sections_of(&whole.scene),
            self.chosen("every monomer", monomers),
        ))
    }

    /// The scene itself with the sections of another.
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

    fn by_trial(&self) -> Result<(Scene, Chosen), SceneProblem> {
        let (whole, assembly) = self.whole()?;
        let measures: Vec<Measure> = self
            .wanted
            .iter()
            .map(|(measure, _)| measure.clone())
            .collect();
        let mut measurer = Measurer::new(&assembly, &measures)?;
        let records = records_of(&assembly)?;
        let reference = trial(&whole.scene, records.map(|(first, _)| first))?;
        let values = measurer.values(&reference.assembly, &reference.records);
        measurer.set_scales(&values);
        let mut tried = vec![self.judged(
            "every monomer",
            &whole.scene,
            &reference,
            vec![0.0; measurer.items.len()],
        )];
        for Proposal { name, scene } in ladder::sections(&whole) {
            // What finds no result is no choice.
            let Ok(ran) = trial(&scene, records.map(|(first, _)| first)) else {
                continue;
            };
            let found = measurer.values(&ran.assembly, &ran.records);
            tried.push(self.judged(
                &name,
                &scene,
                &ran,
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

    /// The errors of what is wanted, of each the largest.
    fn errors(&self, measurer: &Measurer, (values, found): (&Values, &Values)) -> Vec<f64> {
        let all = errors(measurer, values, found);
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

    fn judged(&self, name: &str, scene: &Scene, ran: &Ran, errors: Vec<f64>) -> Judged {
        let limits = self.wanted.iter().zip(&errors);
        let excess = limits
            .map(|((_, limit), error)| error / limit)
            .fold(0.0, f64::max);
        let counts = ran.counts;
        let each = counts.bonds as f64 + BONDS_PER_SEGMENT * counts.segments as f64;
        Judged {
            name: name.to_owned(),
            scene: scene.clone(),
            monomers: counts.monomers,
            errors,
            excess,
            is_good: excess <= 1.0,
            work: ran.evaluations as f64 * each,
        }
    }

    /// Of those with no more monomers than are allowed the one that meets what is wanted with the least work, or the
    /// nearest.
    fn best<'t>(&self, tried: &'t [Judged]) -> Result<&'t Judged, SceneProblem> {
        let most = self.most_monomers.unwrap_or(usize::MAX);
        let allowed = || tried.iter().filter(|one| one.monomers <= most);
        let good = allowed().filter(|one| one.is_good);
        let least = good.min_by(|a, b| a.work.total_cmp(&b.work));
        let nearest = || allowed().min_by(|a, b| a.excess.total_cmp(&b.excess));
        least.or_else(nearest).ok_or_else(|| {
            let rule = "no resolution with so few monomers has a result";
            SceneProblem::new("filament.sections.monomers", most, rule)
        })
    }
}

/// How many records of a motion are compared, and how many there are; none of an equilibrium.
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

struct Judged {
    name: String,
    scene: Scene,
    monomers: usize,
    errors: Vec<f64>,
    /// The largest error over what is wanted.
    excess: f64,
    is_good: bool,
    work: f64,
}

fn trial(scene: &Scene, records: Option<usize>) -> Result<Ran, SceneProblem> {
    let limits = Limits {
        budget: None,
        records,
        is_interrupted: &|| false,
    };
    run_once(scene, limits).map_err(|unusable| match unusable {
        Unusable::Refused(problem) => problem,
        Unusable::Interrupted | Unusable::Failed(_) => {
            let rule = format!("finds no result to judge them by: {unusable}");
            SceneProblem::new("filament.sections", "", rule)
        }
    })
}
