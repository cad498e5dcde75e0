//! A record as bytes, with its state or without.

use super::Damage;
use super::wire::{decode_all, encode};
use crate::Booked;
use crate::run::{At, Record, Row};
use actin_mechanics::{Motion, State};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// What all records of a run have in common.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Form {
    /// A state of the run, for what time does not change.
    pub(super) like: State,
    /// Energies of a record.
    pub(super) terms: usize,
    /// Numbers that are observed.
    pub(super) columns: usize,
    /// Whether records are kept with their states.
    pub(super) has_states: bool,
}

/// A record in the log, or the last in a checkpoint. Those of one log are of one length: their lists are, and
/// numbers of a varying length there are none.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Stored<'a> {
    at: At,
    kinetic_pn_nm: f64,
    residual_force_pn: f64,
    residual_torque_pn_nm: f64,
    booked: Booked,
    energies_pn_nm: Cow<'a, [f64]>,
    observed: Cow<'a, [f64]>,
    motion: Option<Motion>,
}

impl<'a> Stored<'a> {
    /// A record, with its state or without.
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

    /// What a log of records of this form holds.
    pub(super) fn read(bytes: &[u8], form: &Form) -> Result<Stored<'static>, Damage> {
        let stored: Stored<'static> = decode_all(bytes)?;
        if !stored.fits(form) || stored.motion.is_some() != form.has_states {
            return Err(Damage::Contents("a record of another scene".into()));
        }
        Ok(stored)
    }

    /// Whether its lists are as long as those of a run's records.
    pub(super) fn fits(&self, form: &Form) -> bool {
        self.motion.as_ref().is_none_or(|m| m.fits(&form.like))
            && self.energies_pn_nm.len() == form.terms
            && self.observed.len() == form.columns
    }

    /// The same without its state.
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

    /// The record, if it has its state.
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

    /// Bytes of a record of such a run.
    pub(super) fn length(form: &Form) -> usize {
        let record = Self {
            at: At::Time(0.0),
            kinetic_pn_nm: 0.0,
            residual_force_pn: 0.0,
            residual_torque_pn_nm: 0.0,
            booked: Booked::default(),
            energies_pn_nm: vec![0.0; form.terms].into(),
            observed: vec![0.0; form.columns].into(),
            motion: form.has_states.then(|| form.like.motion()),
        };
        encode(&record, Vec::new()).len()
    }
}
