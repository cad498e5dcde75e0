//! Records in memory or read one by one from files.

use crate::loads::loads_of;
use crate::{Assembly, At, EnergyExchange, Part, Term};
use actin_mechanics::{Residual, State, System};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::io;
use std::ops::Deref;
use thiserror::Error;

/// Recorded state and its numbers, which are fields of the record through [`Deref`].
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Time, energies, residuals and observed quantities.
    pub row: Row,
    /// State of all bodies.
    pub state: State,
}

impl Deref for Record {
    type Target = Row;

    fn deref(&self) -> &Row {
        &self.row
    }
}

impl Record {
    /// Borrows the record with its state.
    pub fn as_stored(&self) -> StoredRecord<'_> {
        StoredRecord {
            row: Cow::Borrowed(&self.row),
            state: Some(Cow::Borrowed(&self.state)),
        }
    }

    /// Creates the record of an equilibrium at a path parameter, without observed quantities.
    pub(super) fn of_equilibrium(system: &System, parameter: f64, state: &State) -> Self {
        let mut record = Self::new(system, At::Path(parameter), state.clone());
        record.row.kinetic_pn_nm = 0.0;
        record
    }

    /// Evaluates energies and residuals of a state, without observed quantities.
    pub fn new(system: &System, at: At, state: State) -> Self {
        let residual = loads_of(system.interactions(), &state).residual(&state);
        let interactions = system.interactions().iter();
        let energies_pn_nm = interactions.map(|i| i.energy(&state)).collect();
        let row = Row::new(at, state.kinetic_energy(), residual, energies_pn_nm);
        Self { row, state }
    }
}

/// Numbers of a record: a row of the tables of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Time or path parameter.
    pub at: At,
    /// Kinetic energy of the free bodies (pN nm).
    pub kinetic_pn_nm: f64,
    /// Largest force on a free point (pN).
    pub residual_force_pn: f64,
    /// Largest torque on a free frame (pN nm).
    pub residual_torque_pn_nm: f64,
    /// Energy received from the surroundings so far.
    pub booked: EnergyExchange,
    /// Energy of each term of the assembly in order (pN nm).
    pub energies_pn_nm: Vec<f64>,
    /// Observed quantities in the order of the columns of `observables.csv`; NaN if not yet
    /// defined.
    pub observed: Vec<f64>,
}

impl Row {
    /// Creates a row without exchanged energy and observed quantities.
    pub(crate) fn new(
        at: At,
        kinetic_pn_nm: f64,
        residual: Residual,
        energies_pn_nm: Vec<f64>,
    ) -> Self {
        Self {
            at,
            kinetic_pn_nm,
            residual_force_pn: residual.force,
            residual_torque_pn_nm: residual.torque,
            booked: EnergyExchange::default(),
            energies_pn_nm,
            observed: Vec::new(),
        }
    }

    /// Sum of the energies of all terms (pN nm).
    pub fn potential_pn_nm(&self) -> f64 {
        self.energies_pn_nm.iter().sum()
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

/// Records of a run, which can be iterated repeatedly.
///
/// A [`Trajectory`] holds them in memory.
pub trait Records {
    /// Number of records.
    fn count(&self) -> usize;

    /// Iterates over all records. A read error ends the iteration.
    fn iter(&self) -> RecordIter<'_>;
}

/// Record of a run whose state may not be stored.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredRecord<'a> {
    /// Numbers of the record.
    pub row: Cow<'a, Row>,
    /// State; `None` for all records but the last if the scene's `output` needs no states.
    pub state: Option<Cow<'a, State>>,
}

impl StoredRecord<'_> {
    /// Checks that record `i` has the bodies and columns of `assembly`.
    ///
    /// # Errors
    /// The numbers of points, frames, energies or observed quantities differ.
    pub(crate) fn ensure_fits(
        &self,
        i: usize,
        (assembly, observed_columns): (&Assembly, usize),
    ) -> Result<(), RecordsError> {
        let bodies = self.state.iter().flat_map(|state| {
            [
                ("points", state.points.len(), assembly.points.len()),
                ("frames", state.frames.len(), assembly.frames.len()),
            ]
        });
        let (energies, observed) = (self.row.energies_pn_nm.len(), self.row.observed.len());
        let columns = [
            ("energies", energies, assembly.terms.len()),
            ("observables", observed, observed_columns),
        ];
        let mut counts = bodies.chain(columns);
        match counts.find(|(_, found, expected)| found != expected) {
            None => Ok(()),
            Some((quantity, found, expected)) => Err(RecordsError::Mismatch {
                record: i,
                quantity,
                found,
                expected,
            }),
        }
    }

    /// Returns the record with its state, if it is stored.
    pub fn into_record(self) -> Option<Record> {
        let state = self.state?.into_owned();
        let row = self.row.into_owned();
        Some(Record { row, state })
    }
}

/// Iterator over records.
pub type RecordIter<'a> = Box<dyn Iterator<Item = io::Result<StoredRecord<'a>>> + 'a>;

/// Records in memory.
#[derive(Clone, Debug, Default)]
pub struct Trajectory {
    /// Records in order; the last one is the end of the run.
    pub records: Vec<Record>,
}

impl Trajectory {
    /// Reads all records with states into memory.
    ///
    /// # Errors
    /// If a record cannot be read.
    pub fn read(records: &dyn Records) -> io::Result<Self> {
        let all = records.iter().map(|record| Ok(record?.into_record()));
        let records = all.filter_map(io::Result::transpose);
        Ok(Self {
            records: records.collect::<io::Result<_>>()?,
        })
    }
}

impl Records for Trajectory {
    fn count(&self) -> usize {
        self.records.len()
    }

    fn iter(&self) -> RecordIter<'_> {
        Box::new(self.records.iter().map(|record| Ok(record.as_stored())))
    }
}
