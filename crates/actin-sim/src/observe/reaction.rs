//! Reactions of clamps.

use super::{Observe, StoredPositions, View, end_name, vector};
use crate::End;

/// Force and torque of a clamp on the filament, with the torque about the clamped point.
#[derive(Debug)]
pub(super) struct Reaction {
    pub(super) filament: usize,
    pub(super) end: End,
}

impl Observe for Reaction {
    fn columns(&self) -> Vec<String> {
        let name = format!("reaction[{}]_{}", self.filament, end_name(self.end));
        let force = vector(&format!("{name}_force"), "_pn");
        let torque = vector(&format!("{name}_torque"), "_pn_nm");
        force.into_iter().chain(torque).collect()
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        let clamp = view.assembly.clamp_at(self.filament, self.end);
        let clamp = clamp.expect("the rules of scenes refuse reactions of free ends");
        let reaction = clamp.reaction(view.state, view.loads());
        row.extend(reaction.force_pn.iter().chain(reaction.torque_pn_nm.iter()));
    }
}
