//! Error of one quantity of an equilibrium, measured against a run of the same scene with every monomer.

use super::measure::{Measure, Measurer, view};
use super::resolution::{drawn, every_monomer, with_records_of};
use super::run::{Limits, RunResult, run_once};
use crate::run::{ModelError, ModelErrorResult, Scatter};
use crate::scene::{Quantity, Scene, SceneProblem};
use crate::{Assembly, Record};
use std::slice;

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
    let mut measurer = Measurer::new(&full.assembly, &[Measure::from(quantity)])?;
    // The last item of the tips is the end of the last filament.
    let item = measurer
        .items
        .pop()
        .expect("a measured quantity has an item");
    let value = |assembly: &Assembly, record: &Record| {
        measurer.value(&item, &view(assembly, record), record)
    };
    let reference = value(&full.assembly, full.last());
    let size = item.size(&reference);
    let apart = |value: &Vec<f64>| {
        let error = item.error(slice::from_ref(&reference), slice::from_ref(value));
        error.unwrap_or(f64::NAN)
    };
    let here = value(assembly, last);
    let error = ModelError {
        quantity,
        value: item.size(&here),
        error: size - item.size(&here),
        relative: apart(&here),
    };
    let scatter = scatter(&every, |result| {
        let value = value(&result.assembly, result.last());
        [item.size(&value) - size, apart(&value) * size]
    })?;
    Ok((error, scatter))
}

/// Runs filaments with sampled bonds. `compare` returns the difference in size from the value with
/// quadrature bonds, and the size of the difference.
fn scatter(
    every: &Scene,
    compare: impl Fn(&RunResult) -> [f64; 2],
) -> Result<Scatter, SceneProblem> {
    let mut scatter = Scatter {
        bonds: 0,
        filaments: FILAMENTS,
        shift: 0.0,
        deviation: 0.0,
    };
    for seed in 1..=FILAMENTS {
        let scene = drawn(every, seed);
        let [shift, apart] = compare(&equilibrium(&scene)?);
        scatter.bonds = scene.filament.monomers.lateral_bonds;
        scatter.shift += shift / FILAMENTS as f64;
        scatter.deviation = scatter.deviation.hypot(apart / (FILAMENTS as f64).sqrt());
    }
    Ok(scatter)
}

fn equilibrium(scene: &Scene) -> Result<RunResult, SceneProblem> {
    let rule = "have no known error: the equilibrium of every monomer fails";
    run_once(scene, Limits::NONE).map_err(|failure| failure.into_problem(rule))
}
