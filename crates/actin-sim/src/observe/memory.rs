//! State of observables between records, stored in checkpoints.

use crate::Assembly;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// State of all observables of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Memory(Vec<StoredPositions>);

/// Positions stored for one observable; empty for most.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct StoredPositions {
    pub(super) first: Option<[f64; 3]>,
    /// Times (ns) and positions (nm) at later records, in order.
    pub(super) recent: VecDeque<(f64, [f64; 3])>,
}

impl Memory {
    pub(crate) fn new(assembly: &Assembly) -> Self {
        Self(vec![
            StoredPositions::default();
            assembly.scene.observe.len()
        ])
    }

    pub(super) fn pasts(&mut self) -> impl Iterator<Item = &mut StoredPositions> {
        self.0.iter_mut()
    }

    pub(crate) fn fits(&self, other: &Self) -> bool {
        self.0.len() == other.0.len()
    }
}
