//! Records and where they are: in memory, or read back one by one from wherever a sink has put them.

use crate::Booked;
use actin_mechanics::State;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::io;

/// When a motion, or where a path of equilibria, was recorded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum At {
    /// Time (ns).
    Time(f64),
    /// Path parameter, which counts stages.
    Path(f64),
}

impl At {
    /// The number, of either kind.
    pub fn value(self) -> f64 {
        match self {
            Self::Time(value) | Self::Path(value) => value,
        }
    }

    /// Time (ns); none of an equilibrium.
    pub fn time_ns(self) -> Option<f64> {
        match self {
            Self::Time(time_ns) => Some(time_ns),
            Self::Path(_) => None,
        }
    }

    /// Path parameter; none of a motion in time.
    pub fn path(self) -> Option<f64> {
        match self {
            Self::Time(_) => None,
            Self::Path(parameter) => Some(parameter),
        }
    }
}

/// One recorded moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// When, or where on the path.
    pub at: At,
    /// Everything that moves.
    pub state: State,
    /// Energy of each term of the assembly, in order (pN nm).
    pub energies_pn_nm: Vec<f64>,
    /// Kinetic energy of the free bodies (pN nm).
    pub kinetic_pn_nm: f64,
    /// Largest force on a free point (pN).
    pub residual_force_pn: f64,
    /// Largest torque on a free frame (pN nm).
    pub residual_torque_pn_nm: f64,
    /// What has come from outside up to here.
    pub booked: Booked,
    /// What the scene observes, in the order of the columns of `observables.csv`; NaN where there is nothing
    /// yet.
    pub observed: Vec<f64>,
}

impl Record {
    /// Energy of all terms (pN nm).
    pub fn potential_pn_nm(&self) -> f64 {
        self.energies_pn_nm.iter().sum()
    }

    /// The record without its state.
    pub fn row(&self) -> Row {
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

/// A recorded moment without its state; fields are those of [`Record`].
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// When, or where on the path.
    pub at: At,
    /// Energy of each term of the assembly, in order (pN nm).
    pub energies_pn_nm: Vec<f64>,
    /// Kinetic energy of the free bodies (pN nm).
    pub kinetic_pn_nm: f64,
    /// Largest force on a free point (pN).
    pub residual_force_pn: f64,
    /// Largest torque on a free frame (pN nm).
    pub residual_torque_pn_nm: f64,
    /// What has come from outside up to here.
    pub booked: Booked,
    /// What the scene observes.
    pub observed: Vec<f64>,
}

/// The records of a run, which can be gone through in order any number of times.
///
/// Those of a [`Trajectory`] are in memory; those of a run directory
/// ([`Checkpoints`](crate::Checkpoints)) are read from its log, one at a time.
pub trait Records {
    /// How many there are.
    fn count(&self) -> usize;

    /// The records in order, as far as they are kept with their states: all, or the last alone where a scene's
    /// `output` needs no states. What cannot be read is an error, and the end.
    fn iter(&self) -> RecordIter<'_>;

    /// All records in order, without their states.
    fn rows(&self) -> RowIter<'_> {
        Box::new(self.iter().map(|record| record.map(|record| record.row())))
    }
}

/// Goes through records.
pub type RecordIter<'a> = Box<dyn Iterator<Item = io::Result<Cow<'a, Record>>> + 'a>;

/// Goes through records without their states.
pub type RowIter<'a> = Box<dyn Iterator<Item = io::Result<Row>> + 'a>;

/// Records in memory.
#[derive(Clone, Debug, Default)]
pub struct Trajectory {
    /// Records in time; the last is where the run ended.
    pub records: Vec<Record>,
}

impl Trajectory {
    /// Reads all of `records` into memory.
    ///
    /// # Errors
    /// A record that cannot be read.
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
