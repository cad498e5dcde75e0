//! Linkers in `summary.json`.

use crate::Assembly;
use actin_mechanics::{State, Vector3};
use serde::{Deserialize, Serialize};

/// Position, force and extension of a linker.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinkerSummary {
    /// Index of the filament with the site.
    #[serde(default)]
    pub filament: usize,
    /// Index of the filament with the second site; `None` for an anchor.
    #[serde(default)]
    pub to_filament: Option<usize>,
    /// Position of the site (nm, lab frame).
    pub site_nm: [f64; 3],
    /// Position of the anchor or of the second site (nm, lab frame).
    pub anchor_nm: [f64; 3],
    /// Force on the filament at the site (pN, lab frame); the opposite force acts at the other end.
    pub force_pn: [f64; 3],
    /// True if bound; an unbound linker has no force. `None` for permanent linkers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound: Option<bool>,
    /// Arc length of the site (nm); `None` for permanent linkers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_nm: Option<f64>,
    /// Length minus rest length (nm).
    pub extension_nm: f64,
}

impl LinkerSummary {
    pub(super) fn all(assembly: &Assembly, state: &State) -> Vec<Self> {
        let linkers = 0..assembly.linkers.len();
        let summary = |i| {
            let (linker, is_bound) = assembly.linker_in(i, state);
            let (filament, to_filament) = assembly.linked_filaments(i, state);
            let (bound, at_nm) = assembly.switched(i, state).unzip();
            let force = if is_bound {
                linker.force(state)
            } else {
                Vector3::zeros()
            };
            Self {
                filament,
                to_filament,
                site_nm: linker.site().position(state).into(),
                anchor_nm: linker.end_position(state).into(),
                force_pn: force.into(),
                bound,
                at_nm,
                extension_nm: linker.extension(state),
            }
        };
        linkers.map(summary).collect()
    }
}
