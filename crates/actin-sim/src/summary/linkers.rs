//! Linkers in `summary.json`.

use super::components;
use crate::Assembly;
use actin_coupling::Linker;
use actin_mechanics::State;
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
        (0..assembly.linkers.len())
            .map(|i| {
                let (linker, _) = assembly.linker_in(i, state);
                let filaments = assembly.linked_filaments(i, state);
                let summary = Self::new(filaments, &linker, state);
                match assembly.switched(i, state) {
                    None => summary,
                    Some((bound, at_nm)) => Self {
                        bound: Some(bound),
                        at_nm: Some(at_nm),
                        force_pn: if bound { summary.force_pn } else { [0.0; 3] },
                        ..summary
                    },
                }
            })
            .collect()
    }

    fn new(
        (filament, to_filament): (usize, Option<usize>),
        linker: &Linker,
        state: &State,
    ) -> Self {
        Self {
            filament,
            to_filament,
            site_nm: linker.site().position(state).into(),
            anchor_nm: linker.end_position(state).into(),
            force_pn: linker.force(state).into(),
            bound: None,
            at_nm: None,
            extension_nm: linker.extension(state),
        }
    }

    pub(super) fn numbers(&self) -> Vec<(String, f64)> {
        let vectors = [
            ("site_nm", self.site_nm),
            ("anchor_nm", self.anchor_nm),
            ("force_pn", self.force_pn),
        ];
        let extension = ("extension_nm".to_owned(), self.extension_nm);
        components(vectors).chain([extension]).collect()
    }
}
