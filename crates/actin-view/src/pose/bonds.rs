//! Bonds between monomers for display, stored once for all states of a file.
//!
//! The anchors of a bond are constant in the body frames of the monomers. They are sampled by lattice index, so that
//! states with the same monomers have the same bonds.

use actin_sim::{Assembly, Resolution};
use serde::Serialize;
use std::collections::BTreeMap;

/// Largest number of displayed bonds of an interface. Samples are independent, so that the first bonds are
/// representative.
const MOST_DRAWN: usize = 8;
/// Anchors are stored in units of 0.01 nm.
const PER_NM: f64 = 1e2;

/// Bonds of one interface: anchors on the lower and on the upper monomer, three components each (0.01 nm, body
/// frames).
type Interface = Vec<i16>;

/// Bonds from each monomer, by lattice index, to the next (lateral) and to the second next (longitudinal).
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Bonds(BTreeMap<i64, [Interface; 2]>);

impl Bonds {
    /// Returns the lattice index of the first monomer of a section, the number of bonds of an interface, and the
    /// displayed bonds; `None` for a rod.
    pub(crate) fn from_section(assembly: &Assembly, section: usize) -> Option<(i64, usize, Self)> {
        let Resolution::Ellipsoids { first_index, .. } = assembly.sections[section].resolution
        else {
            return None;
        };
        let bonds = assembly.bonds_of(section)?;
        let mut all = Self::default();
        for pair in bonds.pairs() {
            let index = bonds.monomers().index(pair.lower);
            let interface = &mut all.0.entry(index).or_default()[pair.upper - pair.lower - 1];
            for bond in bonds.bonds_of(pair).take(MOST_DRAWN) {
                let ends = bond.lower.iter().chain(bond.upper.iter());
                interface.extend(ends.map(|x| rounded(*x)));
            }
        }
        let most = bonds.pairs().iter().map(|pair| pair.bonds).max();
        Some((first_index, most.unwrap_or(0), all))
    }

    /// Returns whether all interfaces in both are equal. Monomers at the end of a section have no bonds beyond it,
    /// which is compatible with any bonds.
    fn agrees(&self, other: &Self) -> bool {
        other.0.iter().all(|(index, theirs)| {
            self.0.get(index).is_none_or(|ours| {
                let mut both = ours.iter().zip(theirs);
                both.all(|(a, b)| a.is_empty() || b.is_empty() || a == b)
            })
        })
    }

    fn merge(&mut self, other: Self) {
        for (index, theirs) in other.0 {
            let ours = self.0.entry(index).or_default();
            for (a, b) in ours.iter_mut().zip(theirs) {
                if a.is_empty() {
                    *a = b;
                }
            }
        }
    }

    #[cfg(test)]
    pub(crate) fn at_monomer(&self, index: i64) -> Option<&[Interface; 2]> {
        self.0.get(&index)
    }
}

/// Merges bonds into the first compatible set, or adds a set. Returns the index of the set.
pub(crate) fn keep(all: &mut Vec<Bonds>, bonds: Bonds) -> usize {
    if let Some(place) = all.iter().position(|known| known.agrees(&bonds)) {
        all[place].merge(bonds);
        return place;
    }
    all.push(bonds);
    all.len() - 1
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "anchors are a few nm from the centres; the cast saturates beyond 327 nm"
)]
fn rounded(x_nm: f64) -> i16 {
    (x_nm * PER_NM).round() as i16
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bonds(entries: &[(i64, [&[i16]; 2])]) -> Bonds {
        let entries = entries.iter();
        Bonds(
            entries
                .map(|(index, both)| (*index, both.map(<[i16]>::to_vec)))
                .collect(),
        )
    }

    #[test]
    fn bonds_that_agree_are_kept_once() {
        let mut all = Vec::new();
        let short = bonds(&[(3, [&[1, 2], &[]])]);
        let long = bonds(&[(2, [&[7], &[8]]), (3, [&[1, 2], &[3]])]);
        let other = bonds(&[(3, [&[9, 9], &[3]])]);
        assert_eq!(keep(&mut all, short), 0);
        assert_eq!(keep(&mut all, long.clone()), 0);
        assert_eq!(keep(&mut all, other.clone()), 1);
        assert_eq!(keep(&mut all, bonds(&[(9, [&[5], &[5]])])), 0);
        assert_eq!(all[0].at_monomer(3), long.at_monomer(3));
        assert_eq!(all[1], other);
    }
}
