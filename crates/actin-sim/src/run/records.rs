//! Records in memory or read one by one from files.

use crate::{Assembly, EnergyExchange, Part, Term};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::io;
use thiserror::Error;

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

    /// Checks that record `i` has the numbers of bodies of `assembly`.
    ///
    /// # Errors
    /// The numbers of points or frames differ.
    pub fn ensure_fits(&self, i: usize, assembly: &Assembly) -> Result<(), RecordsError> {
        let state = &self.state;
        ensure_same(i, ("points", state.points.len()), assembly.points.len())?;
        ensure_same(i, ("frames", state.frames.len()), assembly.frames.len())
    }

    /// Returns the record without its state.
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

impl Row {
    /// Checks that row `i` has the columns of `assembly`.
    ///
    /// # Errors
    /// The numbers of energies or observed quantities differ.
    pub fn ensure_fits(&self, i: usize, assembly: &Assembly) -> Result<(), RecordsError> {
        let energies = ("energies", self.energies_pn_nm.len());
        ensure_same(i, energies, assembly.terms.len())?;
        let columns = assembly.observed().len();
        ensure_same(i, ("observables", self.observed.len()), columns)
    }
}

/// Sums of the energies of a record (pN nm).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyTotals {
    /// Sum of potential and kinetic energy.
    pub total: f64,
    /// Energy of all interactions.
    pub potential: f64,
    /// Energy of all interactions except loads.
    pub elastic: f64,
    /// Kinetic energy.
    pub kinetic: f64,
}

impl EnergyTotals {
    /// Sums the energies of `terms`.
    pub fn new(terms: &[Term], energies_pn_nm: &[f64], kinetic_pn_nm: f64) -> Self {
        let potential: f64 = energies_pn_nm.iter().sum();
        let of_load = |term: &Term| matches!(term.part, Part::Load(_));
        let elastic = terms.iter().zip(energies_pn_nm);
        let elastic = elastic.filter(|(term, _)| !of_load(term)).map(|(_, e)| e);
        Self {
            total: potential + kinetic_pn_nm,
            potential,
            elastic: elastic.sum(),
            kinetic: kinetic_pn_nm,
        }
    }
}

/// Error of records that do not belong to an assembly or cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecordsError {
    /// A record cannot be read back.
    #[error("a record cannot be read back: {0}")]
    Unreadable(io::Error),
    /// Empty records.
    #[error("the trajectory holds no record: a run directory requires at least one")]
    Empty,
    /// A record does not belong to the assembly.
    #[error("record {record} holds {found} {quantity} where the assembly has {expected}")]
    Mismatch {
        /// Index of the record.
        record: usize,
        /// Name of the counted quantity.
        quantity: &'static str,
        /// Number in the record.
        found: usize,
        /// Number in the assembly.
        expected: usize,
    },
}

fn ensure_same(
    record: usize,
    (quantity, found): (&'static str, usize),
    expected: usize,
) -> Result<(), RecordsError> {
    if found == expected {
        return Ok(());
    }
    Err(RecordsError::Mismatch {
        record,
        quantity,
        found,
        expected,
    })
}

/// Records of a run, which can be iterated repeatedly.
///
/// A [`Trajectory`] holds them in memory.
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
pub type RecordIter<'a> = Box<dyn Iterator<Item = io::Result<Cow<'a, Record>>> + 'a>;

/// Iterator over records without their states.
pub type RowIter<'a> = Box<dyn Iterator<Item = io::Result<Row>> + 'a>;

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
