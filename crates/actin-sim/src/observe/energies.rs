//! Energies in total and of each section and junction.

use super::View;
use crate::{Assembly, Part};

/// Sections and junctions in order, and for each term the index of its section or junction, if any.
fn parts(assembly: &Assembly) -> (Vec<Part>, Vec<Option<usize>>) {
    let mut parts: Vec<Part> = Vec::new();
    let mut place = |part: Part| match part {
        Part::Load(_) | Part::Linker(_) | Part::Clamp(_) | Part::Contacts | Part::Wall(_) => None,
        // Terms of one part are contiguous.
        Part::Section(_) | Part::Junction(_) => {
            if parts.last() != Some(&part) {
                parts.push(part);
            }
            Some(parts.len() - 1)
        }
    };
    let places = assembly.terms.iter().map(|term| place(term.part)).collect();
    (parts, places)
}

pub(super) fn columns(assembly: &Assembly) -> Vec<String> {
    let (parts, _) = parts(assembly);
    let names = parts.iter().map(|part| assembly.name_of(*part));
    let all = ["potential", "kinetic"].map(str::to_owned).into_iter();
    all.chain(names)
        .map(|name| format!("energy_{name}_pn_nm"))
        .collect()
}

/// Potential and kinetic energy, and energies of sections and junctions.
pub(super) fn values(view: &View<'_>) -> Vec<f64> {
    let (parts, places) = parts(view.assembly);
    let mut sums = vec![0.0; parts.len()];
    for (energy, place) in view.energies_pn_nm.iter().zip(places) {
        if let Some(place) = place {
            sums[place] += energy;
        }
    }
    let potential = view.energies_pn_nm.iter().sum();
    [vec![potential, view.kinetic_pn_nm], sums].concat()
}
