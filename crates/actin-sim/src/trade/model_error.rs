//! The error of one number of an equilibrium against the same scene with every monomer, which is run.

use super::measure::{Measure, Measurer};
use super::resolution::every_monomer;
use super::run::{Limits, Ran, Unusable, run_once};
use super::study::{drawn, with_records_of};
use crate::scene::{Quantity, Scene, SceneProblem};
use crate::{Assembly, Record};
use serde::{Deserialize, Serialize};

/// Filaments with drawn bonds that are run.
const FILAMENTS: u64 = 3;

/// How far a number of an equilibrium is from that of every monomer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelError {
    /// Of what.
    pub quantity: Quantity,
    /// Its value, in its [unit](Quantity::unit); of a vector its size.
    pub value: f64,
    /// What is to be added to it for that of every monomer.
    pub error: f64,
    /// Size of the difference over the size with every monomer, of a vector with its direction.
    pub relative: f64,
}

impl ModelError {
    /// The error in a sentence.
    pub(crate) fn note(&self, scatter: &Scatter) -> String {
        let size = self.corrected().abs().max(f64::MIN_POSITIVE);
        format!(
            "{} is {}, {} with every monomer (off by {:.2} %); filaments with {} drawn bonds an interface are {:+.2} % from \
             that, and scatter by {:.2} %",
            self.quantity,
            self.quantity.show(self.value),
            self.quantity.show(self.corrected()),
            100.0 * self.relative,
            scatter.bonds,
            100.0 * scatter.shift / size,
            100.0 * scatter.deviation / size
        )
    }

    /// The value of every monomer.
    pub fn corrected(&self) -> f64 {
        self.value + self.error
    }
}

/// How a number differs between filaments whose bonds are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scatter {
    /// Bonds of an interface.
    pub bonds: usize,
    /// Filaments that were run.
    pub filaments: u64,
    /// Mean over them less the value of every monomer with weighted bonds, in the number's unit.
    pub shift: f64,
    /// Root mean square of their differences from it, in the same unit; of a vector with its direction.
    pub deviation: f64,
}

/// Runs the scene of an equilibrium with every monomer, and with drawn bonds.
///
/// # Errors
/// A scene with sections that cannot be monomers, and a reference without a result.
pub(crate) fn model_error(
    assembly: &Assembly,
    last: &Record,
    quantity: Quantity,
) -> Result<(ModelError, Scatter), SceneProblem> {
    let (every, kept) = every_monomer(&assembly.scene);
    if let Some(reason) = kept.iter().find_map(|kept| *kept) {
        return Err(SceneProblem::new("filament.sections", "", reason));
    }
    let every = with_records_of(every, &assembly.scene);
    let whole = equilibrium(&every)?;
    let measurer = Measurer::new(&whole.assembly, &[Measure::from(quantity)])?;
    let of = |assembly: &Assembly, record: &Record| {
        let values = measurer.values(assembly, std::slice::from_ref(record));
        values.last().cloned().unwrap_or_default()
    };
    let of_ran = |ran: &Ran| {
        ran.records
            .last()
            .map_or_else(Vec::new, |last| of(&ran.assembly, last))
    };
    let item = measurer.items.last();
    let size = |values: &[Vec<f64>]| match (item, values.last()) {
        (Some(item), Some(value)) => item.size(value),
        _ => f64::NAN,
    };
    let apart = |values: &[Vec<f64>], reference: &[Vec<f64>]| {
        item.and_then(|item| item.error(reference, values))
            .unwrap_or(f64::NAN)
    };
    let (here, reference) = (of(assembly, last), of_ran(&whole));
    let value = size(&here);
    let mut sum = [0.0, 0.0];
    let (mut bonds, count) = (0, FILAMENTS as f64);
    for seed in 1..=FILAMENTS {
        let scene = drawn(&every, seed);
        bonds = scene.filament.monomers.lateral_bonds;
        let values = of_ran(&equilibrium(&scene)?);
        sum[0] += (size(&values) - size(&reference)) / count;
        sum[1] += (apart(&values, &reference) * size(&reference)).powi(2) / count;
    }
    let error = ModelError {
        quantity,
        value,
        error: size(&reference) - value,
        relative: apart(&here, &reference),
    };
    let scatter = Scatter {
        bonds,
        filaments: FILAMENTS,
        shift: sum[0],
        deviation: sum[1].sqrt(),
    };
    Ok((error, scatter))
}

fn equilibrium(scene: &Scene) -> Result<Ran, SceneProblem> {
    let limits = Limits {
        budget: None,
        records: None,
        is_interrupted: &|| false,
    };
    run_once(scene, limits).map_err(|unusable| match unusable {
        Unusable::Refused(problem) => problem,
        Unusable::Interrupted | Unusable::Failed(_) => {
            let rule = format!("every monomer finds no equilibrium to judge it by: {unusable}");
            SceneProblem::new("filament.sections", "", rule)
        }
    })
}
