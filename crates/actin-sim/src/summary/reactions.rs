//! Reactions at clamped ends in `summary.json`.

use crate::{Assembly, End, Reaction};
use actin_mechanics::{Loads, State, Vector3};
use serde::{Deserialize, Serialize};

/// Reactions at the clamped ends; free ends have no key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EndReactions {
    /// Reaction at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<EndReaction>,
    /// Reaction at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<EndReaction>,
}

/// Reaction force and torque of a clamp on the filament.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EndReaction {
    /// Force on the filament (pN, lab frame).
    pub force_pn: [f64; 3],
    /// Torque on the filament about the clamped point (pN nm, lab frame).
    pub torque_pn_nm: [f64; 3],
}

impl EndReactions {
    pub(super) fn new(assembly: &Assembly, filament: usize, state: &State, loads: &Loads) -> Self {
        let at = |end| {
            let clamp = assembly.clamp_at(filament, end)?;
            Some(clamp.reaction(state, loads).into())
        };
        Self {
            start: at(End::Start),
            end: at(End::End),
        }
    }

    pub(super) fn vectors(&self) -> Vec<(&'static str, [f64; 3])> {
        let mut vectors = Vec::new();
        if let Some(start) = self.start {
            vectors.push(("end_reactions.start.force_pn", start.force_pn));
            vectors.push(("end_reactions.start.torque_pn_nm", start.torque_pn_nm));
        }
        if let Some(end) = self.end {
            vectors.push(("end_reactions.end.force_pn", end.force_pn));
            vectors.push(("end_reactions.end.torque_pn_nm", end.torque_pn_nm));
        }
        vectors
    }
}

impl From<Reaction> for EndReaction {
    fn from(reaction: Reaction) -> Self {
        let array = |v: Vector3| [v.x, v.y, v.z];
        Self {
            force_pn: array(reaction.force_pn),
            torque_pn_nm: array(reaction.torque_pn_nm),
        }
    }
}
