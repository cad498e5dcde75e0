//! Controls: values that are set from outside, such as load factors.

use std::ops::{Index, IndexMut};

/// Identifier of a control, returned by [`State::add_control`](crate::State::add_control). It is
/// valid for that state and its copies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ControlId(usize);

/// Values set from outside: load factors and displacements of anchors.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Controls {
    values: Vec<f64>,
}

impl Controls {
    pub(crate) fn add(&mut self, value: f64) -> ControlId {
        self.values.push(value);
        ControlId(self.values.len() - 1)
    }

    /// Number of controls.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Returns `true` if there are no controls.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Returns `true` if `control` exists.
    pub fn has(&self, control: ControlId) -> bool {
        control.0 < self.len()
    }

    /// All controls, in the order in which they were added.
    pub fn ids(&self) -> impl Iterator<Item = ControlId> + use<> {
        (0..self.len()).map(ControlId)
    }

    /// Values of all controls, in the order in which they were added.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Copies the values of `other`, which must have equal length.
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
