//! Error of one quantity of an equilibrium, measured against a run of the same scene with every monomer.

use super::measure::{Measure, Measurer};
use super::resolution::{drawn, every_monomer, with_records_of};
use super::run::{Limits, RunResult, TrialFailure, run_once};
use crate::run::{ModelError, ModelErrorResult, Scatter};
use crate::scene::{Quantity, Scene, SceneProblem};
use crate::{Assembly, Record};

const FILAMENTS: u64 = 3;

/// Runs the scene of an equilibrium with every monomer, with quadrature bonds and with sampled bonds.
///
/// # Errors
/// A scene with sections that cannot be monomers; a run without a result.
pub(crate) fn model_error(
    assembly: &Assembly,
    last: &Record,
    quantity: Quantity,
) -> ModelErrorResult {
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
