//! Observed quantities of scenes, computed for each record.
//!
//! [`Observers`] holds the observers of a scene; each implements the trait [`Observe`]. A [`View`]
//! is their input, and [`Memory`] their state between records. The options of a scene are in
//! `scene/observable.rs`.
//!
//! A new quantity needs a variant of [`Observable`] with its rules, an observer with its columns,
//! and a line in `build`.

mod buckling;
mod chain;
mod displacement;
mod energies;
mod internal_load;
mod linker;
mod local;
mod means;
mod memory;
mod network;
mod reaction;
mod tangents;
mod tip;
mod view;

pub(crate) use means::Averages;
pub use means::{DerivedLength, MeanSummary, ObservableSummary};
pub(crate) use memory::Memory;
pub(crate) use view::View;

use crate::Assembly;
use crate::scene::{Observable, SceneProblem};
use memory::StoredPositions;
use std::fmt::Debug;

/// Observer of some columns.
trait Observe: Debug + Send + Sync {
    fn columns(&self) -> Vec<String>;

    /// Appends the values of the columns, NaN if not yet defined. `past` is the observer's state.
    fn observe(&self, view: &View<'_>, past: &mut StoredPositions, row: &mut Vec<f64>);

    /// Length derived from the mean of a single column and its standard error. An unknown mean is
    /// NaN.
    fn derived(&self, _mean: f64, _error: Option<f64>) -> Option<DerivedLength> {
        None
    }

    /// Refuses options that conflict with the built filament or the time step.
    fn check(&self, _assembly: &Assembly, _times: Option<&RecordTimes>) -> Checked {
        Ok(())
    }
}

/// Times of the records of a motion (ns).
#[derive(Clone, Copy, Debug)]
pub(crate) struct RecordTimes {
    pub(crate) every_ns: f64,
    pub(crate) duration_ns: f64,
}

/// Key below the observable, its value and the violated rule.
type Checked = Result<(), (&'static str, f64, String)>;

#[derive(Debug, Default)]
pub(crate) struct Observers {
    list: Vec<Box<dyn Observe>>,
    columns: Vec<String>,
}

impl Observers {
    pub(crate) fn new(assembly: &Assembly) -> Self {
        let scene = &assembly.scene;
        let list: Vec<_> = scene
            .observe
            .iter()
            .map(|&one| build(one, assembly))
            .collect();
        let columns = list.iter().flat_map(|one| one.columns()).collect();
        Self { list, columns }
    }

    pub(crate) fn columns(&self) -> &[String] {
        &self.columns
    }

    pub(crate) fn memory(&self) -> Memory {
        Memory::new(self.list.len())
    }

    /// Values of all columns, NaN if not yet defined.
    pub(crate) fn row(&self, view: &View<'_>, memory: &mut Memory) -> Vec<f64> {
        let mut row = Vec::with_capacity(self.columns.len());
        for (one, past) in self.list.iter().zip(memory.pasts()) {
            one.observe(view, past, &mut row);
        }
        row
    }

    pub(crate) fn derived(
        &self,
        column: &str,
        mean: f64,
        error: Option<f64>,
    ) -> Option<DerivedLength> {
        let mut all = self.list.iter();
        let of = all.find(|one| one.columns().iter().any(|name| name == column));
        of?.derived(mean, error)
    }

    /// Checks the observers against an assembly and its time step.
    ///
    /// # Errors
    /// If a distance exceeds the filament, or a lag is no multiple of the record interval.
    pub(crate) fn check(
        &self,
        assembly: &Assembly,
        times: Option<&RecordTimes>,
    ) -> Result<(), SceneProblem> {
        for (i, one) in self.list.iter().enumerate() {
            let refused = |(name, value, rule): (&str, f64, String)| {
                SceneProblem::new(format!("observe[{i}].{name}"), format!("{value:?}"), rule)
            };
            one.check(assembly, times).map_err(refused)?;
        }
        Ok(())
    }
}

fn build(one: Observable, assembly: &Assembly) -> Box<dyn Observe> {
    let scene = &assembly.scene;
    match one {
        Observable::Tip { filament, end } => Box::new(tip::Tip { filament, end }),
        Observable::EndReaction { filament, end } => Box::new(reaction::Reaction { filament, end }),
        Observable::Linker { linker } => Box::new(linker::Linker { linker }),
        Observable::Curvature { filament, at_nm } => Box::new(local::Curvature { filament, at_nm }),
        Observable::Twist { filament, at_nm } => Box::new(local::Twist { filament, at_nm }),
        Observable::Strain { filament, at_nm } => Box::new(local::Strain { filament, at_nm }),
        Observable::InternalLoad { filament, at_nm } => {
            Box::new(internal_load::InternalLoad { filament, at_nm })
        }
        Observable::EndToEnd { filament } => Box::new(tip::EndToEnd { filament }),
        Observable::Contour { filament } => Box::new(chain::Contour { filament }),
        Observable::Buckling { filament, points } => {
            Box::new(buckling::Buckling { filament, points })
        }
        Observable::Energies => Box::new(energies::Energies::new(assembly)),
        Observable::Network => Box::new(network::Network::new(scene)),
        Observable::SquaredDisplacement {
            filament,
            of,
            lag_ns,
        } => Box::new(displacement::SquaredDisplacement {
            filament,
            of,
            lag_ns,
        }),
        Observable::TangentCorrelation { filament, over_nm } => {
            Box::new(tangents::TangentCorrelation {
                filament,
                over_nm,
                tells_length: scene.nonthermal_bending_cause(filament).is_none(),
            })
        }
    }
}

/// Columns of a vector in the lab frame, such as `tip[0]_x_nm`.
fn vector(name: &str, unit: &str) -> Vec<String> {
    ["x", "y", "z"]
        .map(|axis| format!("{name}_{axis}{unit}"))
        .into()
}

fn end_name(end: crate::End) -> &'static str {
    match end {
        crate::End::Start => "start",
        crate::End::End => "end",
    }
}

/// Returns the names of the observed quantities of an assembly in the order of their values in a record, the columns of
/// `observables.csv`.
pub fn observed_columns(assembly: &Assembly) -> Vec<String> {
    Observers::new(assembly).columns
}

#[cfg(test)]
mod tests;
