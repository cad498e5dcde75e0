//! Ways to bond the monomers that are compared.

use crate::measure::Specimen;
use actin_sim::{Anchors, Monomers};

/// Bonds, and the geometry that they bridge.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Variant {
    /// The monomers, with seed 0.
    pub monomers: Monomers,
}

/// What figures, heat and motion compare: drawn bonds, the limit of many, and weighted ones.
pub(super) fn compared() -> Vec<Variant> {
    vec![
        Variant::drawn(64, 0.0),
        Variant::drawn(64, 0.2),
        Variant::drawn(1024, 0.2),
        Variant::weighted(8, 0.2),
        Variant::weighted(12, 0.2),
        Variant::weighted(16, 0.2),
        Variant::weighted(24, 0.2),
    ]
}

impl Variant {
    /// So many bonds drawn for each interface, none shorter than this (nm).
    pub(super) fn drawn(bonds: usize, shortest: f64) -> Self {
        let monomers = Monomers {
            min_bond_nm: shortest,
            ..Monomers::drawn(bonds, 0)
        };
        Self { monomers }
    }

    /// The same with one pattern for all interfaces of a kind.
    pub(super) fn patterned(bonds: usize, shortest: f64) -> Self {
        let mut variant = Self::drawn(bonds, shortest);
        variant.monomers.anchors = Anchors::Identical;
        variant
    }

    /// So many weighted bonds.
    pub(super) fn weighted(points: usize, shortest: f64) -> Self {
        let monomers = Monomers {
            min_bond_nm: shortest,
            ..Monomers::weighted(points)
        };
        Self { monomers }
    }

    /// With another rise (nm).
    pub(super) fn rising(mut self, rise_nm: f64) -> Self {
        self.monomers.rise_nm = rise_nm;
        self
    }

    /// With another distance of the centres from the axis (nm).
    pub(super) fn at_radius(mut self, radius_nm: f64) -> Self {
        self.monomers.radius_nm = radius_nm;
        self
    }

    /// How bonds are chosen, in words.
    pub(super) fn bonds(&self) -> String {
        let number = self.monomers.lateral_bonds;
        match self.monomers.anchors {
            Anchors::Independent => format!("{number} drawn"),
            Anchors::Identical => format!("{number} drawn, one pattern"),
            Anchors::Cubature => format!("{number} weighted"),
        }
    }

    /// Whether it has samplings.
    pub(super) fn is_drawn(&self) -> bool {
        self.monomers.anchors != Anchors::Cubature
    }

    /// Seeds of its samplings, at most so many: one if nothing is drawn.
    pub(super) fn seeds(&self, most: u64) -> Vec<u64> {
        (0..if self.is_drawn() { most } else { 1 }).collect()
    }

    /// The monomers of one sampling.
    pub(super) fn sampling(&self, seed: u64) -> Monomers {
        Monomers {
            seed,
            ..self.monomers.clone()
        }
    }

    /// A filament of so many rises between the inner held monomers.
    pub(super) fn specimen(&self, rises: f64, seed: u64) -> Specimen {
        let monomers = self.sampling(seed);
        Specimen::ellipsoids(rises * monomers.rise_nm, monomers)
    }
}

#[cfg(test)]
mod tests {
    use super::Variant;

    /// Each way changes what it names, and weighted bonds have one sampling.
    #[test]
    fn variants_change_what_they_name() {
        let drawn = Variant::drawn(28, 0.15).rising(2.76).at_radius(1.85);
        let m = &drawn.monomers;
        assert_eq!((m.lateral_bonds, m.longitudinal_bonds), (28, 28));
        let numbers = [m.min_bond_nm, m.rise_nm, m.radius_nm];
        assert_eq!(
            numbers.map(f64::to_bits),
            [0.15, 2.76, 1.85].map(f64::to_bits)
        );
        assert_eq!(drawn.bonds(), "28 drawn");
        assert_eq!(drawn.seeds(3), [0, 1, 2]);
        let weighted = Variant::weighted(16, 0.2);
        assert_eq!(weighted.bonds(), "16 weighted");
        assert_eq!(weighted.seeds(3), [0]);
    }
}
