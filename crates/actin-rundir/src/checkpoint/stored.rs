//! Encoding of records with or without states.

use super::wire::{decode_all, encode};
use crate::Damage;
use actin_sim::mechanics::{Motion, State};
use actin_sim::{At, EnergyExchange, Row, StoredRecord};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Common layout of the records of a run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Form {
    /// State of the run, for its constant parts.
    pub(super) like: State,
    pub(super) terms: usize,
    pub(super) columns: usize,
    pub(super) has_states: bool,
}

/// Record in the log or at the end of a checkpoint.
///
/// All records of a log have the same encoded length, since list lengths are constant and no number
/// is encoded with variable length.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Stored<'a> {
    row: Cow<'a, Row>,
    motion: Option<Motion>,
}

impl<'a> Stored<'a> {
    pub(super) fn new(row: &'a Row, state: Option<&State>) -> Self {
        Self {
            row: Cow::Borrowed(row),
            motion: state.map(State::motion),
        }
    }

    pub(super) fn read(bytes: &[u8], form: &Form) -> Result<Stored<'static>, Damage> {
        let stored: Stored<'static> = decode_all(bytes)?;
        if !stored.fits(form) || stored.motion.is_some() != form.has_states {
            return Err(Damage::Contents("a record of another scene".into()));
        }
        Ok(stored)
    }

    pub(super) fn fits(&self, form: &Form) -> bool {
        self.motion.as_ref().is_none_or(|m| m.fits(&form.like))
            && self.row.energies_pn_nm.len() == form.terms
            && self.row.observed.len() == form.columns
    }

    pub(super) fn into_record(self, form: &Form) -> StoredRecord<'a> {
        let state = self.motion.map(|motion| form.like.in_motion(motion));
        StoredRecord {
            row: self.row,
            state: state.map(Cow::Owned),
        }
    }

    pub(super) fn length(form: &Form) -> usize {
        let row = Row {
            at: At::Time(0.0),
            kinetic_pn_nm: 0.0,
            residual_force_pn: 0.0,
            residual_torque_pn_nm: 0.0,
            booked: EnergyExchange::default(),
            energies_pn_nm: vec![0.0; form.terms],
            observed: vec![0.0; form.columns],
        };
        let record = Self {
            row: Cow::Owned(row),
            motion: form.has_states.then(|| form.like.motion()),
        };
        encode(&record, Vec::new()).len()
    }
}
