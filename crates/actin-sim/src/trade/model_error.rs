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
    let judge = Judge { measurer };
    let reference = judge.value(&whole.assembly, &whole.records);
    let size = judge.size(&reference);
    let here = judge.value(assembly, std::slice::from_ref(last));
    let error = ModelError {
        quantity,
        value: judge.size(&here),
        error: size - judge.size(&here),
        relative: judge.apart(&here, &reference),
    };
    let mut scatter = Scatter {
        bonds: 0,
        filaments: FILAMENTS,
        shift: 0.0,
        deviation: 0.0,
    };
    for seed in 1..=FILAMENTS {
        let scene = drawn(&every, seed);
        let ran = equilibrium(&scene)?;
        let value = judge.value(&ran.assembly, &ran.records);
        scatter.bonds = scene.filament.monomers.lateral_bonds;
        scatter.shift += (judge.size(&value) - size) / FILAMENTS as f64;
        let apart = judge.apart(&value, &reference) * size;
        scatter.deviation = scatter.deviation.hypot(apart / (FILAMENTS as f64).sqrt());
    }
    Ok((error, scatter))
}

/// The last of what a quantity is: of tips that at the end.
struct Judge {
    measurer: Measurer,
}

impl Judge {
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
