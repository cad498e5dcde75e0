//! Observed quantities of scenes, computed for each record.
//!
//! Each quantity has a function for its columns and one for its values in a [`View`]. [`Memory`] is
//! their state between records. The options of a scene are in `scene/observable.rs`.
//!
//! A new quantity needs a variant of [`Observable`] with its rules, and its columns and values here.

mod buckling;
mod chain;
mod displacement;
mod ends;
mod energies;
mod internal_load;
mod linker;
mod local;
mod means;
mod memory;
mod network;
mod tangents;
mod view;

pub(crate) use means::Averages;
pub use means::{DerivedLength, MeanSummary, ObservableSummary};
pub(crate) use memory::Memory;
pub(crate) use view::View;

use crate::Assembly;
use crate::scene::{Observable, Scene, SceneProblem};
use actin_assembly::Note;
use memory::StoredPositions;

/// Times of the records of a motion (ns).
#[derive(Clone, Copy, Debug)]
pub(crate) struct RecordTimes {
    pub(crate) every_ns: f64,
    pub(crate) duration_ns: f64,
}

/// Key below the observable, its value and the violated rule.
type Checked = Result<(), (&'static str, f64, String)>;

/// Returns the names of the observed quantities of an assembly in the order of their values in a record, the columns of
/// `observables.csv`.
pub fn observed_columns(assembly: &Assembly) -> Vec<String> {
    let all = assembly.scene.observe.iter();
    all.flat_map(|&one| columns(one, assembly)).collect()
}

fn columns(one: Observable, assembly: &Assembly) -> Vec<String> {
    match one {
        Observable::Tip { filament, end } => ends::tip_columns(filament, end),
        Observable::EndToEnd { filament } => ends::end_to_end_columns(filament),
        Observable::EndReaction { filament, end } => ends::reaction_columns(filament, end),
        Observable::Linker { linker } => linker::columns(linker),
        Observable::Curvature { filament, at_nm } => local::curvature_columns(filament, at_nm),
        Observable::Twist { filament, at_nm } => local::twist_columns(filament, at_nm),
        Observable::Strain { filament, at_nm } => local::strain_columns(filament, at_nm),
        Observable::InternalLoad { filament, at_nm } => internal_load::columns(filament, at_nm),
        Observable::Contour { filament } => chain::columns(filament),
        Observable::Buckling { filament, points } => buckling::columns(filament, points),
        Observable::Energies => energies::columns(assembly),
        Observable::Network => network::columns(&assembly.scene),
        Observable::SquaredDisplacement {
            filament,
            of,
            lag_ns,
        } => displacement::columns(filament, of, lag_ns),
        Observable::TangentCorrelation { filament, over_nm } => {
            tangents::columns(filament, over_nm)
        }
    }
}

/// Values of all columns, NaN if not yet defined.
pub(crate) fn observed_values(view: &View<'_>, memory: &mut Memory) -> Vec<f64> {
    let all = view.assembly.scene.observe.iter().zip(memory.pasts());
    all.flat_map(|(&one, past)| values(one, view, past))
        .collect()
}

/// Numbers of an observable that does not depend on earlier records.
pub(crate) fn current_values(one: Observable, view: &View<'_>) -> Vec<f64> {
    values(one, view, &mut StoredPositions::default())
}

fn values(one: Observable, view: &View<'_>, past: &mut StoredPositions) -> Vec<f64> {
    match one {
        Observable::Tip { filament, end } => ends::tip(view, filament, end),
        Observable::EndToEnd { filament } => ends::end_to_end(view, filament),
        Observable::EndReaction { filament, end } => ends::reaction(view, filament, end),
        Observable::Linker { linker } => linker::values(view, linker),
        Observable::Curvature { filament, at_nm } => local::curvature(view.ribbon(filament), at_nm),
        Observable::Twist { filament, at_nm } => vec![local::twist(view.ribbon(filament), at_nm)],
        Observable::Strain { filament, at_nm } => local::strain(view.ribbon(filament), at_nm),
        Observable::InternalLoad { filament, at_nm } => {
            internal_load::values(view, filament, at_nm)
        }
        Observable::Contour { filament } => chain::values(view, filament),
        Observable::Buckling { filament, points } => buckling::values(view, filament, points),
        Observable::Energies => energies::values(view),
        Observable::Network => network::values(view),
        Observable::SquaredDisplacement {
            filament,
            of,
            lag_ns,
        } => vec![displacement::value(view, (filament, of), lag_ns, past)],
        Observable::TangentCorrelation { filament, over_nm } => {
            vec![tangents::correlation(view.ribbon(filament), over_nm)]
        }
    }
}

/// Persistence length from the mean of a column of tangent correlations; `None` for other columns
/// and where the correlation does not determine it.
fn derived_length(
    assembly: &Assembly,
    column: &str,
    (mean, error): (f64, Option<f64>),
) -> Option<DerivedLength> {
    let scene = &assembly.scene;
    scene.observe.iter().find_map(|&one| match one {
        Observable::TangentCorrelation { filament, over_nm }
            if tangents::columns(filament, over_nm)[0] == column =>
        {
            let is_thermal = scene.persistence_length_obstacle(filament).is_none();
            is_thermal.then(|| tangents::persistence_length(over_nm, mean, error))
        }
        _ => None,
    })
}

/// Checks the observables of a scene against its assembly and the times of its records.
///
/// # Errors
/// If a distance exceeds the filament, or a lag is no multiple of the record interval.
pub(crate) fn check(assembly: &Assembly, times: Option<&RecordTimes>) -> Result<(), SceneProblem> {
    for (i, one) in assembly.scene.observe.iter().enumerate() {
        let checked = match *one {
            Observable::SquaredDisplacement { lag_ns, .. } => displacement::check(lag_ns, times),
            Observable::TangentCorrelation { filament, over_nm } => {
                tangents::check(assembly, filament, over_nm)
            }
            Observable::Network => network::check(&assembly.scene, times),
            _ => Ok(()),
        };
        checked.map_err(|(name, value, rule)| {
            SceneProblem::new(format!("observe[{i}].{name}"), format!("{value:?}"), rule)
        })?;
    }
    Ok(())
}

/// Note on means of observables that the scene does not determine.
pub(crate) fn note(scene: &Scene) -> Option<Note> {
    let is_observed = scene.observe.contains(&Observable::Network);
    is_observed.then(|| network::note_on_moduli(scene))?
}

/// Columns of a vector in the lab frame, such as `tip[0]_x_nm`.
fn vector(name: &str, unit: &str) -> Vec<String> {
    ["x", "y", "z"]
        .map(|axis| format!("{name}_{axis}{unit}"))
        .into()
}

#[cfg(test)]
mod tests;
