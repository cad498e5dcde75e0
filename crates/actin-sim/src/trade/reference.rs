//! Reference of a trade: every monomer, or the finest resolution within the budget.

use super::SETTLED;
use super::ladder::{self, Proposal};
use super::measure::Measurer;
use super::resolution::{FullResolution, every_monomer};
use super::run::{Limits, TrialFailure};
use super::sample::Sample;
use super::{Options, Reference, TradeCallbacks, TradeError, worst};
use crate::scene::{Scene, SceneProblem};

/// Smallest fraction of the records of a motion that the reference must reach within the budget.
const LEAST_SHARE: f64 = 0.1;

/// Scene of a trade with its compared quantities.
pub(super) struct Setup<'a> {
    pub options: &'a Options,
    pub watch: &'a TradeCallbacks<'a>,
    /// The scene with every monomer.
    pub full: FullResolution,
    pub measurer: Measurer,
}

pub(super) struct ReferenceRun {
    pub reference: Reference,
    pub sample: Sample,
    /// Time of all runs so far (s).
    pub spent_s: f64,
}

impl<'a> Setup<'a> {
    /// Resolves every monomer of the scene.
    ///
    /// # Errors
    /// Invalid scenes; quantities without a counterpart in the scene.
    pub(super) fn new(
        scene: &Scene,
        options: &'a Options,
        watch: &'a TradeCallbacks<'a>,
    ) -> Result<Self, SceneProblem> {
        let (every, fixed) = every_monomer(scene);
        if let [Some(reason), ..] = fixed.as_slice()
            && fixed.iter().all(Option::is_some)
        {
            let rule = format!("no other resolution to compare with: {reason}");
            return Err(SceneProblem::new("filament.sections", "", rule));
        }
        let (full, assembly) = FullResolution::new(every, fixed)?;
        let measurer = Measurer::new(&assembly, &options.measures)?;
        Ok(Self {
            options,
            watch,
            full,
            measurer,
        })
    }

    /// Runs every monomer at half of the default step.
    ///
    /// If the budget ends before a tenth of the records, coarser references are refined until two agree or the budget
    /// ends.
    ///
    /// # Errors
    /// A reference without a result; interruptions.
    pub(super) fn reference(&self) -> Result<ReferenceRun, TradeError> {
        let is_hot = self.full.scene.thermal().is_some();
        let (name, scene) = if self.full.estimate.is_some() && !is_hot {
            let half = ladder::at_half_step(&self.full);
            ("every monomer at half of the default step", half)
        } else {
            ("every monomer", self.full.scene.clone())
        };
        let sample = self.run(name, &scene)?;
        let share = match (sample.last_run.is_cut, self.full.estimate) {
            (false, _) => 1.0,
            (true, Some(all)) => sample.last_run.records.len() as f64 / all.records() as f64,
            (true, None) => 0.0,
        };
        if share < LEAST_SHARE {
            return self.refine(sample.wall_s);
        }
        let spent_s = sample.wall_s;
        let found = self.reference_run((name, scene), sample, None, spent_s);
        let is_settled = found.reference.is_settled || !is_hot;
        let reference = Reference {
            share,
            is_settled,
            ..found.reference
        };
        Ok(ReferenceRun { reference, ..found })
    }

    fn refine(&self, mut spent_s: f64) -> Result<ReferenceRun, TradeError> {
        let mut best: Option<ReferenceRun> = None;
        for Proposal { name, scene } in ladder::references(&self.full) {
            let sample = self.run(&name, &scene)?;
            spent_s += sample.wall_s;
            if sample.last_run.is_cut {
                break;
            }
            let found = self.reference_run((&name, scene), sample, best.as_ref(), spent_s);
            let is_settled = found.reference.is_settled;
            best = Some(found);
            if is_settled {
                break;
            }
        }
        best.map(|found| ReferenceRun { spent_s, ..found })
            .ok_or_else(|| {
                let budget_s = self.options.budget.as_secs_f64();
                TradeError::ReferenceFails {
                    name: "rods".to_owned(),
                    cause: format!("takes longer than the budget of {budget_s} s"),
                }
            })
    }

    fn reference_run(
        &self,
        (name, scene): (&str, Scene),
        sample: Sample,
        coarser: Option<&ReferenceRun>,
        spent_s: f64,
    ) -> ReferenceRun {
        let own_errors = match coarser {
            Some(coarser) => self.measurer.errors(&sample.values, &coarser.sample.values),
            None if scene.thermal().is_some() => {
                let items = self.measurer.items.iter().zip(&sample.values);
                let sizes = items.map(|(item, values)| item.mean_size(values));
                let errors = sample.standard_errors.iter().zip(sizes);
                errors.map(|(error, size)| Some(error / size)).collect()
            }
            None => vec![None; self.measurer.items.len()],
        };
        let reference = Reference {
            name: name.to_owned(),
            scene,
            counts: sample.counts(),
            wall_s: sample.wall_s,
            is_settled: worst(&own_errors) <= SETTLED * self.options.error,
            own_errors,
            share: 1.0,
        };
        ReferenceRun {
            reference,
            sample,
            spent_s,
        }
    }

    pub(super) fn limits(&self, records: Option<usize>) -> Limits<'_> {
        Limits {
            budget: Some(self.options.budget),
            records,
            is_interrupted: self.watch.is_interrupted,
        }
    }

    /// Reports and runs a scene.
    pub(super) fn sample(
        &self,
        what: &str,
        scene: &Scene,
        limits: Limits<'_>,
    ) -> Result<Sample, TrialFailure> {
        (self.watch.report)(what);
        Sample::new(scene, &self.measurer, limits)
    }

    fn run(&self, name: &str, scene: &Scene) -> Result<Sample, TradeError> {
        let sample = self.sample(name, scene, self.limits(None));
        sample.map_err(|failure| match failure {
            TrialFailure::Interrupted => TradeError::Interrupted,
            TrialFailure::Refused(problem) => TradeError::Refused(problem),
            TrialFailure::Failed(cause) => TradeError::ReferenceFails {
                name: name.to_owned(),
                cause,
            },
        })
    }
}
