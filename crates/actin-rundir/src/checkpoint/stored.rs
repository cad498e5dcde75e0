//! Encoding of records with or without states.

use super::Damage;
use super::wire::{decode_all, encode};
use actin_sim::mechanics::{Motion, State};
use actin_sim::{At, EnergyExchange, Record, Row};
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
    at: At,
    kinetic_pn_nm: f64,
    residual_force_pn: f64,
    residual_torque_pn_nm: f64,
    booked: EnergyExchange,
    energies_pn_nm: Cow<'a, [f64]>,
    observed: Cow<'a, [f64]>,
    motion: Option<Motion>,
}

impl<'a> Stored<'a> {
    pub(super) fn new(record: &'a Record, has_state: bool) -> Self {
        let Record {
            at,
            state,
            energies_pn_nm,
            kinetic_pn_nm,
            residual_force_pn,
            residual_torque_pn_nm,
            booked,
            observed,
        } = record;
        Self {
            at: *at,
            kinetic_pn_nm: *kinetic_pn_nm,
            residual_force_pn: *residual_force_pn,
            residual_torque_pn_nm: *residual_torque_pn_nm,
            booked: *booked,
            energies_pn_nm: energies_pn_nm.into(),
            observed: observed.into(),
            motion: has_state.then(|| state.motion()),
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
            && self.energies_pn_nm.len() == form.terms
            && self.observed.len() == form.columns
    }

    pub(super) fn into_row(self) -> Row {
        Row {
            at: self.at,
            energies_pn_nm: self.energies_pn_nm.into_owned(),
            kinetic_pn_nm: self.kinetic_pn_nm,
            residual_force_pn: self.residual_force_pn,
            residual_torque_pn_nm: self.residual_torque_pn_nm,
            booked: self.booked,
            observed: self.observed.into_owned(),
        }
    }

    pub(super) fn into_record(mut self, form: &Form) -> Option<Record> {
        let motion = self.motion.take()?;
        let row = self.into_row();
        Some(Record {
            at: row.at,
            state: form.like.in_motion(motion),
            energies_pn_nm: row.energies_pn_nm,
            kinetic_pn_nm: row.kinetic_pn_nm,
            residual_force_pn: row.residual_force_pn,
            residual_torque_pn_nm: row.residual_torque_pn_nm,
            booked: row.booked,
            observed: row.observed,
        })
    }

    pub(super) fn length(form: &Form) -> usize {
        let record = Self {
            at: At::Time(0.0),
            kinetic_pn_nm: 0.0,
            residual_force_pn: 0.0,
            residual_torque_pn_nm: 0.0,
            booked: EnergyExchange::default(),
            energies_pn_nm: vec![0.0; form.terms].into(),
            observed: vec![0.0; form.columns].into(),
            motion: form.has_states.then(|| form.like.motion()),
        };
        encode(&record, Vec::new()).len()
    }
}
