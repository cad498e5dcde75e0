//! The reference of a trade: every monomer, or what the budget allows.

use super::ladder::{self, Proposal};
use super::measure::Measurer;
use super::resolution::{Whole, every_monomer};
use super::run::{Limits, Unusable};
use super::sample::Sample;
use super::study::{SETTLED, errors, with_records_of};
use super::{Options, Reference, TradeError, Watch, worst};
use crate::scene::{Scene, SceneProblem};
use crate::{Assembly, Plan};

/// Share of the records of a motion that the reference has to come to within the budget.
const LEAST_SHARE: f64 = 0.1;

/// A scene that is to be compared, and by what.
pub(super) struct Setup<'a> {
    pub options: &'a Options,
    pub watch: &'a Watch<'a>,
    /// The scene with every monomer.
    pub whole: Whole,
    pub measurer: Measurer,
    /// The usual time step (ns) of a motion.
    pub default_ns: Option<f64>,
    /// Records of a motion.
    total: Option<usize>,
}

/// A reference with its run.
pub(super) struct Found {
    pub reference: Reference,
    pub sample: Sample,
    /// Time of all runs up to it (s).
    pub spent_s: f64,
}

impl<'a> Setup<'a> {
    /// # Errors
    /// Scenes and quantities that cannot be compared.
    pub(super) fn new(
        scene: &Scene,
        options: &'a Options,
        watch: &'a Watch<'a>,
    ) -> Result<Self, SceneProblem> {
        let (every, kept) = every_monomer(scene);
        let assembly = Assembly::build(&every)?;
        let plan = Plan::new(&assembly)?;
        let estimate = plan.estimate();
        let mut whole = Whole::new(&assembly, kept);
        whole.scene = with_records_of(every, plan.scene());
        let measurer = Measurer::new(&assembly, &options.measures)?;
        Ok(Self {
            options,
            watch,
            whole,
            measurer,
            default_ns: estimate.map(|estimate| estimate.time_step_ns),
            total: records_of(estimate),
        })
    }

    /// Every monomer at half of the usual step, if the budget allows a share of it; otherwise the finest of the
    /// coarser ones, refined until two agree.
    ///
    /// # Errors
    /// A reference without a result, and interruptions.
    pub(super) fn reference(&self) -> Result<Found, TradeError> {
        let is_hot = self.whole.scene.thermal().is_some();
        let (name, scene) = if self.default_ns.is_some() && !is_hot {
            let half = ladder::at_half_step(&self.whole.scene, self.default_ns);
            ("every monomer at half of the default step", half)
        } else {
            ("every monomer", self.whole.scene.clone())
        };
        let sample = self.run(name, &scene)?;
        let share = match (sample.is_cut, self.total) {
            (false, _) => 1.0,
            (true, Some(total)) => sample.ran.records.len() as f64 / total as f64,
            (true, None) => 0.0,
        };
        if share < LEAST_SHARE {
            return self.refine(sample.wall_s);
        }
        let spent_s = sample.wall_s;
        let found = self.found((name, scene), sample, None, spent_s);
        let is_settled = found.reference.is_settled || !is_hot;
        let reference = Reference {
            share,
            is_settled,
            ..found.reference
        };
        Ok(Found { reference, ..found })
    }

    fn refine(&self, mut spent_s: f64) -> Result<Found, TradeError> {
        let mut best: Option<Found> = None;
        for Proposal { name, scene } in ladder::references(&self.whole) {
            let sample = self.run(&name, &scene)?;
            spent_s += sample.wall_s;
            if sample.is_cut {
                break;
            }
            let found = self.found((&name, scene), sample, best.as_ref(), spent_s);
            let is_settled = found.reference.is_settled;
            best = Some(found);
            if is_settled {
                break;
            }
        }
        best.map(|found| Found { spent_s, ..found }).ok_or_else(|| {
            let budget_s = self.options.budget.as_secs_f64();
            TradeError::ReferenceFails {
                name: "rods".to_owned(),
                cause: format!("takes longer than the budget of {budget_s} s"),
            }
        })
    }

    /// A run as the reference, compared with a coarser one.
    fn found(
        &self,
        (name, scene): (&str, Scene),
        sample: Sample,
        coarser: Option<&Found>,
        spent_s: f64,
    ) -> Found {
        let own_errors = match coarser {
            Some(coarser) => errors(&self.measurer, &sample.values, &coarser.sample.values),
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
            counts: sample.counts,
            wall_s: sample.wall_s,
            is_settled: worst(&own_errors) <= SETTLED * self.options.error,
            own_errors,
            share: 1.0,
        };
        Found {
            reference,
            sample,
            spent_s,
        }
    }

    fn run(&self, name: &str, scene: &Scene) -> Result<Sample, TradeError> {
        (self.watch.says)(name);
        let limits = Limits {
            budget: Some(self.options.budget),
            records: None,
            is_interrupted: self.watch.is_interrupted,
        };
        Sample::of(scene, &self.measurer, limits).map_err(|unusable| match unusable {
            Unusable::Interrupted => TradeError::Interrupted,
            Unusable::Refused(problem) => TradeError::Refused(problem),
            Unusable::Failed(cause) => TradeError::ReferenceFails {
                name: name.to_owned(),
                cause,
            },
        })
    }
}

/// Number of records of a motion.
fn records_of(estimate: Option<&crate::Estimate>) -> Option<usize> {
    let estimate = estimate?;
    usize::try_from(estimate.steps / estimate.steps_between_records + 1).ok()
}
