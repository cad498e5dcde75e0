//! Controls: numbers that are set from outside.

use std::ops::{Index, IndexMut};

/// A control of a state, as [`State::add_control`](crate::State::add_control) gave it: of that state and
/// its copies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ControlId(usize);

/// What is set from outside: factors of loads, displacements of anchors.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Controls {
    values: Vec<f64>,
}

impl Controls {
    /// Adds a control.
    pub(crate) fn add(&mut self, value: f64) -> ControlId {
        self.values.push(value);
        ControlId(self.values.len() - 1)
    }

    /// Number of controls.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Whether a control is one of these.
    pub fn has(&self, control: ControlId) -> bool {
        control.0 < self.len()
    }

    /// All controls, in the order in which they were added.
    pub fn ids(&self) -> impl Iterator<Item = ControlId> + use<> {
        (0..self.len()).map(ControlId)
    }

    /// Their values, in the order in which they were added.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Takes over the values of `other`, which has as many.
    pub fn copy_from(&mut self, other: &Self) {
        self.values.copy_from_slice(&other.values);
    }
}

impl Index<ControlId> for Controls {
    type Output = f64;

    fn index(&self, control: ControlId) -> &f64 {
        &self.values[control.0]
    }
}

impl IndexMut<ControlId> for Controls {
    fn index_mut(&mut self, control: ControlId) -> &mut f64 {
        &mut self.values[control.0]
    }
}
