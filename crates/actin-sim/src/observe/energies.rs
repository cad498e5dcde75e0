//! Energies in total and of each section and junction.

use super::{Observe, StoredPositions, View};
use crate::{Assembly, Part};

/// Potential and kinetic energy, and energies of sections and junctions.
///
/// Has the names of sections and junctions, and for each term the index of its name, if any.
#[derive(Debug)]
pub(super) struct Energies {
    names: Vec<String>,
    places: Vec<Option<usize>>,
}

impl Energies {
    pub(super) fn new(assembly: &Assembly) -> Self {
        let mut parts: Vec<Part> = Vec::new();
        let mut place = |part: Part| match part {
            Part::Load(_) | Part::Linker(_) | Part::Clamp(_) | Part::Contacts | Part::Wall(_) => {
                None
            }
            // Terms of one part are contiguous.
            Part::Section(_) | Part::Junction(_) => {
                let known = parts.iter().rposition(|known| *known == part);
                Some(known.unwrap_or_else(|| {
                    parts.push(part);
                    parts.len() - 1
                }))
            }
        };
        let places = assembly.terms.iter().map(|term| place(term.part)).collect();
        let names = parts.iter().map(|part| assembly.name_of(*part)).collect();
        Self { names, places }
    }
}

impl Observe for Energies {
    fn columns(&self) -> Vec<String> {
        let all = ["potential", "kinetic"].into_iter();
        all.chain(self.names.iter().map(String::as_str))
            .map(|name| format!("energy_{name}_pn_nm"))
            .collect()
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        row.extend([view.energies_pn_nm.iter().sum(), view.kinetic_pn_nm]);
        let first = row.len();
        row.resize(first + self.names.len(), 0.0);
        for (energy, place) in view.energies_pn_nm.iter().zip(&self.places) {
            if let Some(place) = place {
                row[first + place] += energy;
            }
        }
    }
}
