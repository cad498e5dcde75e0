//! What scenes observe: numbers that are computed of each record as it is taken.
//!
//! [`Observers`] are those of a scene, one behind the other; each is a small type of its own behind the trait
//! [`Observe`], in the file of what it is about. A [`View`] is what they see, a [`Memory`] what they carry from
//! record to record. Which numbers a scene may ask for is in `scene/observable.rs`; files are the business of
//! `results`.
//!
//! To add one: a variant of [`Observable`] with its rules; a type here that names its columns and computes them;
//! a line in `build`.

mod buckling;
mod chain;
mod displacement;
mod energies;
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

use crate::scene::{Observable, Scene, SceneProblem};
use crate::{Assembly, Estimate};
use memory::Past;
use std::fmt::Debug;

/// Something that is observed.
trait Observe: Debug + Send + Sync {
    /// Names of its columns, each with its unit.
    fn columns(&self) -> Vec<String>;

    /// Appends the values of its columns, NaN where there is none yet. `past` is what it has stored before.
    fn observe(&self, view: &View<'_>, past: &mut Past, row: &mut Vec<f64>);

    /// A length that follows from the mean of its one column and the standard error of that; a mean that is
    /// not known is NaN.
    fn derived(&self, _mean: f64, _error: Option<f64>) -> Option<DerivedLength> {
        None
    }

    /// Refuses what shows only when the filament is built and the time step is known.
    fn check(&self, _assembly: &Assembly, _estimate: Option<&Estimate>) -> Checked {
        Ok(())
    }
}

/// A key below that of an observable, its value and the rule that it breaks.
type Checked = Result<(), (&'static str, f64, String)>;

/// All that a scene observes.
#[derive(Debug, Default)]
pub(crate) struct Observers {
    list: Vec<Box<dyn Observe>>,
    columns: Vec<String>,
}

impl Observers {
    /// Those of a scene whose terms are named `energies`.
    pub(crate) fn new(scene: &Scene, energies: &energies::Names) -> Self {
        let list: Vec<_> = scene
            .observe
            .iter()
            .map(|&one| build(one, scene, energies))
            .collect();
        let columns = list.iter().flat_map(|one| one.columns()).collect();
        Self { list, columns }
    }

    /// Names of all columns.
    pub(crate) fn columns(&self) -> &[String] {
        &self.columns
    }

    /// What is remembered where nothing was observed.
    pub(crate) fn memory(&self) -> Memory {
        Memory::of(self.list.len())
    }

    /// The values of all columns, NaN where there is none yet.
    pub(crate) fn row(&self, view: &View<'_>, memory: &mut Memory) -> Vec<f64> {
        let mut row = Vec::with_capacity(self.columns.len());
        for (one, past) in self.list.iter().zip(memory.pasts()) {
            one.observe(view, past, &mut row);
        }
        row
    }

    /// What follows from the mean of a column and its standard error.
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

    /// Refuses what an assembly or its time step does not have.
    ///
    /// # Errors
    /// A distance beyond the filament, a time between two records.
    pub(crate) fn check(
        &self,
        assembly: &Assembly,
        estimate: Option<&Estimate>,
    ) -> Result<(), SceneProblem> {
        for (i, one) in self.list.iter().enumerate() {
            let refused = |(name, value, rule): (&str, f64, String)| {
                SceneProblem::new(format!("observe[{i}].{name}"), format!("{value:?}"), rule)
            };
            one.check(assembly, estimate).map_err(refused)?;
        }
        Ok(())
    }
}

pub(crate) use energies::Names as EnergyNames;

fn build(one: Observable, scene: &Scene, energies: &EnergyNames) -> Box<dyn Observe> {
    match one {
        Observable::Tip { filament, end } => Box::new(tip::Tip { filament, end }),
        Observable::EndReaction { filament, end } => Box::new(reaction::Reaction { filament, end }),
        Observable::Linker { linker } => Box::new(linker::Linker { linker }),
        Observable::Curvature { filament, at_nm } => Box::new(local::Curvature { filament, at_nm }),
        Observable::Twist { filament, at_nm } => Box::new(local::Twist { filament, at_nm }),
        Observable::Strain { filament, at_nm } => Box::new(local::Strain { filament, at_nm }),
        Observable::EndToEnd { filament } => Box::new(tip::EndToEnd { filament }),
        Observable::Contour { filament } => Box::new(chain::Contour { filament }),
        Observable::Buckling { filament, points } => {
            Box::new(buckling::Buckling { filament, points })
        }
        Observable::Energies => Box::new(energies::Energies::new(energies.clone())),
        Observable::Network => Box::new(network::Network),
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
                tells_length: scene.bends_besides_heat(filament).is_none(),
            })
        }
    }
}

/// Columns of a vector in the lab frame: `tip[0]_x_nm` and so on, of `tip[0]` and `_nm`.
fn vector(name: &str, unit: &str) -> Vec<String> {
    ["x", "y", "z"]
        .map(|axis| format!("{name}_{axis}{unit}"))
        .into()
}

/// How an end is named: the last is the tip.
fn end_name(end: crate::End) -> &'static str {
    match end {
        crate::End::Start => "start",
        crate::End::End => "end",
    }
}

impl Assembly {
    /// Names of what the scene observes, the columns of `observables.csv`.
    pub fn observed_columns(&self) -> &[String] {
        self.observers.columns()
    }
}

#[cfg(test)]
mod tests;
