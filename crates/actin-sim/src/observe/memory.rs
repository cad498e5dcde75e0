//! What observers carry from record to record; a checkpoint holds it.

use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// What all observers of a scene remember.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Memory(Vec<Past>);

/// Places that one observer remembers; most remember none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Past {
    /// Where it was at the first record (nm).
    pub(super) first: Option<[f64; 3]>,
    /// When (ns) and where (nm) it was at some records since, in order.
    pub(super) recent: VecDeque<(f64, [f64; 3])>,
}

impl Memory {
    /// That of so many observers that have seen nothing.
    pub(super) fn of(observers: usize) -> Self {
        Self(vec![Past::default(); observers])
    }

    pub(super) fn pasts(&mut self) -> impl Iterator<Item = &mut Past> {
        self.0.iter_mut()
    }

    /// Whether it is one of as many observers as `other` is.
    pub(crate) fn fits(&self, other: &Self) -> bool {
        self.0.len() == other.0.len()
    }
}
