//! Filaments in `summary.json`: tips, reactions, shapes.

use crate::loads::loads_of;
use crate::shape::{self, Ribbon};
use crate::{Assembly, Counts, End, Reaction, Record};
use actin_mechanics::{Loads, State, Vector3};
use serde::{Deserialize, Serialize};

/// Final results of one filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilamentSummary {
    /// Numbers of bodies and elements.
    pub counts: Counts,
    /// Position of the tip (nm, lab frame).
    pub tip_nm: [f64; 3],
    /// Displacement of the tip from the initial state (nm, lab frame).
    pub tip_displacement_nm: [f64; 3],
    /// Reactions at the clamped ends.
    pub end_reactions: EndReactions,
    /// Elastic energy of sections and junctions, without linkers (pN nm).
    pub elastic_pn_nm: f64,
    /// Shape.
    pub shape: ShapeSummary,
    /// Seed of the bond anchors.
    pub seed: u64,
}

impl FilamentSummary {
    pub(super) fn all(assembly: &Assembly, last: &Record) -> Vec<Self> {
        // Computed for the state of the record, which may differ from the current state of the
        // system.
        let loads = loads_of(assembly.system.interactions(), &last.state);
        let here = (last, assembly.path_parameter(last.at));
        let filaments = 0..assembly.filaments.len();
        filaments
            .map(|filament| Self::new(assembly, filament, here, &loads))
            .collect()
    }

    /// Creates the summary of a filament from the loads of the last record, at `parameter` of the
    /// path.
    fn new(
        assembly: &Assembly,
        filament: usize,
        (last, parameter): (&Record, f64),
        loads: &Loads,
    ) -> Self {
        let tip = reported_tip(assembly, filament);
        let tip_nm = assembly.tip_of(filament, &last.state, tip);
        let tip_at_rest_nm = assembly.tip_of(filament, &assembly.rest, tip);
        let terms = assembly.filaments[filament].terms.clone();
        Self {
            counts: assembly.counts_of(filament),
            tip_nm: tip_nm.into(),
            tip_displacement_nm: (tip_nm - tip_at_rest_nm).into(),
            end_reactions: EndReactions::new(assembly, filament, &last.state, loads),
            elastic_pn_nm: last.energies_pn_nm[terms].iter().sum(),
            shape: ShapeSummary::new(assembly, filament, (&last.state, parameter)),
            seed: assembly.monomers_of(filament).seed,
        }
    }
}

/// End whose tip is reported: the last one, unless it is clamped and the first one is free.
pub(crate) fn reported_tip(assembly: &Assembly, filament: usize) -> End {
    let is_clamped = |end| assembly.clamp_at(filament, end).is_some();
    if is_clamped(End::End) && !is_clamped(End::Start) {
        End::Start
    } else {
        End::End
    }
}

/// Shape of a filament, extended straight beyond both ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShapeSummary {
    /// Twist from end to end (turns); over-twist is positive.
    pub twist_turns: f64,
    /// Writhe of the centre line; `None` if its points times the points of all filaments exceed
    /// 1e8.
    pub writhe: Option<f64>,
    /// Rotation of the end relative to the start (turns), equal to twist plus writhe. `None` unless
    /// both ends are clamped and parallel.
    pub link_turns: Option<f64>,
    /// Largest distance of the centre line from the initial axis (nm).
    pub largest_distance_nm: f64,
}

impl ShapeSummary {
    pub(super) fn new(
        assembly: &Assembly,
        filament: usize,
        (state, parameter): (&State, f64),
    ) -> Self {
        let ribbon = Ribbon::from_state(assembly, filament, state);
        Self {
            twist_turns: ribbon.twist(),
            writhe: shape::writhe_of(assembly, filament, &ribbon),
            link_turns: assembly.link_at(filament, parameter),
            largest_distance_nm: ribbon.largest_distance_nm(),
        }
    }
}

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
