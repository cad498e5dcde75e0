//! Records in memory or read one by one from files.

use crate::EnergyExchange;
use actin_mechanics::State;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::io;

/// Time or path parameter of a record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum At {
    /// Time (ns).
    Time(f64),
    /// Path parameter, which counts stages.
    Path(f64),
}

impl At {
    /// Value of either kind.
    pub fn value(self) -> f64 {
        match self {
            Self::Time(value) | Self::Path(value) => value,
        }
    }

    /// Time (ns); `None` for an equilibrium.
    pub fn time_ns(self) -> Option<f64> {
        match self {
            Self::Time(time_ns) => Some(time_ns),
            Self::Path(_) => None,
        }
    }

    /// Path parameter; `None` for a motion in time.
    pub(crate) fn path(self) -> Option<f64> {
        match self {
            Self::Time(_) => None,
            Self::Path(parameter) => Some(parameter),
        }
    }
}

/// Recorded state with energies, residuals and observed quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Time or path parameter.
    pub at: At,
    /// State of all bodies.
    pub state: State,
    /// Energy of each term of the assembly in order (pN nm).
    pub energies_pn_nm: Vec<f64>,
    /// Kinetic energy of the free bodies (pN nm).
    pub kinetic_pn_nm: f64,
    /// Largest force on a free point (pN).
    pub residual_force_pn: f64,
    /// Largest torque on a free frame (pN nm).
    pub residual_torque_pn_nm: f64,
    /// Energy received from the surroundings so far.
    pub booked: EnergyExchange,
    /// Observed quantities in the order of the columns of `observables.csv`; NaN if not yet
    /// defined.
    pub observed: Vec<f64>,
}

impl Record {
    /// Sum of the energies of all terms (pN nm).
    pub fn potential_pn_nm(&self) -> f64 {
        self.energies_pn_nm.iter().sum()
    }

    /// Returns the record without its state.
    pub(crate) fn row(&self) -> Row {
        Row {
            at: self.at,
            energies_pn_nm: self.energies_pn_nm.clone(),
            kinetic_pn_nm: self.kinetic_pn_nm,
            residual_force_pn: self.residual_force_pn,
            residual_torque_pn_nm: self.residual_torque_pn_nm,
            booked: self.booked,
            observed: self.observed.clone(),
        }
    }
}

/// Record without its state; see [`Record`].
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Time or path parameter.
    pub at: At,
    /// Energy of each term of the assembly in order (pN nm).
    pub energies_pn_nm: Vec<f64>,
    /// Kinetic energy of the free bodies (pN nm).
    pub kinetic_pn_nm: f64,
    /// Largest force on a free point (pN).
    pub residual_force_pn: f64,
    /// Largest torque on a free frame (pN nm).
    pub residual_torque_pn_nm: f64,
    /// Energy received from the surroundings so far.
    pub booked: EnergyExchange,
    /// Observed quantities.
    pub observed: Vec<f64>,
}

/// Records of a run, which can be iterated repeatedly.
///
/// A [`Trajectory`] holds them in memory; [`Checkpoints`](crate::Checkpoints) read them one by one
/// from a run directory.
pub trait Records {
    /// Number of records.
    fn count(&self) -> usize;

    /// Iterates over records with states: all, or only the last if the scene's `output` needs no
    /// states. A read error ends the iteration.
    fn iter(&self) -> RecordIter<'_>;

    /// Iterates over all records without their states.
    fn rows(&self) -> RowIter<'_> {
        Box::new(self.iter().map(|record| record.map(|record| record.row())))
    }
}

/// Iterator over records.
pub(crate) type RecordIter<'a> = Box<dyn Iterator<Item = io::Result<Cow<'a, Record>>> + 'a>;

/// Iterator over records without their states.
pub(crate) type RowIter<'a> = Box<dyn Iterator<Item = io::Result<Row>> + 'a>;

/// Records in memory.
#[derive(Clone, Debug, Default)]
pub struct Trajectory {
    /// Records in order; the last one is the end of the run.
    pub records: Vec<Record>,
}

impl Trajectory {
    /// Reads all of `records` into memory.
    ///
    /// # Errors
    /// If a record cannot be read.
    pub fn read(records: &dyn Records) -> io::Result<Self> {
        let all = records.iter().map(|record| record.map(Cow::into_owned));
        let records = all.collect::<io::Result<_>>()?;
        Ok(Self { records })
    }
}

impl Records for Trajectory {
    fn count(&self) -> usize {
        self.records.len()
    }

    fn iter(&self) -> RecordIter<'_> {
        Box::new(self.records.iter().map(|record| Ok(Cow::Borrowed(record))))
    }
}
