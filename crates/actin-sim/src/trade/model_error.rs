//! Error of one quantity of an equilibrium, measured against a run of the same scene with every monomer.

use super::measure::{Measure, Measurer};
use super::resolution::every_monomer;
use super::run::{Limits, RunResult, TrialFailure, run_once};
use super::study::{drawn, with_records_of};
use crate::scene::{Quantity, Scene, SceneProblem};
use crate::{Assembly, Record};
use serde::{Deserialize, Serialize};

const FILAMENTS: u64 = 3;

/// Error of a quantity of an equilibrium against every monomer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelError {
    /// Quantity with this error.
    pub quantity: Quantity,
    /// Value in the [unit](Quantity::unit) of the quantity; the size of a vector.
    pub value: f64,
    /// Correction in the same unit: the value with every monomer minus `value`.
    pub error: f64,
    /// Size of the difference divided by the size with every monomer. The difference of vectors includes their direction.
    pub relative: f64,
}

impl ModelError {
    pub(crate) fn note(&self, scatter: &Scatter) -> String {
        let size = self.corrected().abs().max(f64::MIN_POSITIVE);
        format!(
            "{} is {}, and {} in the all-monomer model (error {:.2} %); filaments with {} sampled bonds per interface differ \
             from the all-monomer model by {:+.2} % on average, with a root mean square difference of {:.2} %",
            self.quantity,
            self.quantity.show(self.value),
            self.quantity.show(self.corrected()),
            100.0 * self.relative,
            scatter.bonds,
            100.0 * scatter.shift / size,
            100.0 * scatter.deviation / size
        )
    }

    /// Returns the value with every monomer.
    fn corrected(&self) -> f64 {
        self.value + self.error
    }
}

/// Scatter of a quantity between filaments with sampled bonds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scatter {
    /// Sampled bonds per interface.
    pub bonds: usize,
    /// Number of filaments.
    pub filaments: u64,
    /// Mean over the filaments minus the value with quadrature bonds, in the unit of the quantity.
    pub shift: f64,
    /// Root mean square difference from the value with quadrature bonds, in the same unit. The difference of vectors
    /// includes their direction.
    pub deviation: f64,
}

/// Runs the scene of an equilibrium with every monomer, with quadrature bonds and with sampled bonds.
///
/// # Errors
/// A scene with sections that cannot be monomers; a run without a result.
pub(crate) fn model_error(
    assembly: &Assembly,
    last: &Record,
    quantity: Quantity,
) -> Result<(ModelError, Scatter), SceneProblem> {
    let (every, fixed) = every_monomer(&assembly.scene);
    if let Some(reason) = fixed.iter().find_map(|fixed| *fixed) {
        return Err(SceneProblem::new("filament.sections", "", reason));
    }
    let every = with_records_of(every, &assembly.scene);
    let full = equilibrium(&every)?;
    let measurer = Measurer::new(&full.assembly, &[Measure::from(quantity)])?;
    let reader = QuantityReader { measurer };
    let reference = reader.value(&full.assembly, &full.records);
    let size = reader.size(&reference);
    let here = reader.value(assembly, std::slice::from_ref(last));
    let error = ModelError {
        quantity,
        value: reader.size(&here),
        error: size - reader.size(&here),
        relative: reader.apart(&here, &reference),
    };
    let mut scatter = Scatter {
        bonds: 0,
        filaments: FILAMENTS,
        shift: 0.0,
        deviation: 0.0,
    };
    for seed in 1..=FILAMENTS {
        let scene = drawn(&every, seed);
        let result = equilibrium(&scene)?;
        let value = reader.value(&result.assembly, &result.records);
        scatter.bonds = scene.filament.monomers.lateral_bonds;
        scatter.shift += (reader.size(&value) - size) / FILAMENTS as f64;
        let apart = reader.apart(&value, &reference) * size;
        scatter.deviation = scatter.deviation.hypot(apart / (FILAMENTS as f64).sqrt());
    }
    Ok((error, scatter))
}

/// Reads one quantity, its last item in the last record. The last item of the tips is the end of the last filament.
struct QuantityReader {
    measurer: Measurer,
}

impl QuantityReader {
    fn value(&self, assembly: &Assembly, records: &[Record]) -> Vec<Vec<f64>> {
        let last = records.last().map(std::slice::from_ref);
        let values = last.map(|last| self.measurer.values(assembly, last));
        values
            .and_then(|all| all.last().cloned())
            .unwrap_or_default()
    }

    fn size(&self, value: &[Vec<f64>]) -> f64 {
        let item = self.measurer.items.last();
        let size = item.and_then(|item| Some(item.size(value.last()?)));
        size.unwrap_or(f64::NAN)
    }

    fn apart(&self, value: &[Vec<f64>], reference: &[Vec<f64>]) -> f64 {
        let item = self.measurer.items.last();
        let error = item.and_then(|item| item.error(reference, value));
        error.unwrap_or(f64::NAN)
    }
}

fn equilibrium(scene: &Scene) -> Result<RunResult, SceneProblem> {
    let limits = Limits {
        budget: None,
        records: None,
        is_interrupted: &|| false,
    };
    run_once(scene, limits).map_err(|failure| match failure {
        TrialFailure::Refused(problem) => problem,
        TrialFailure::Interrupted | TrialFailure::Failed(_) => {
            let rule =
                format!("have no known error: the equilibrium of every monomer fails: {failure}");
            SceneProblem::new("filament.sections", "", rule)
        }
    })
}
