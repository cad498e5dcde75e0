//! Bonds between monomers.

use actin_mechanics::Vector3;

/// One bond: anchors, rest length and weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bond {
    /// Anchor on the lower monomer (nm, its body frame).
    pub lower: Vector3,
    /// Anchor on the upper monomer (nm, its body frame).
    pub upper: Vector3,
    /// Rest length (nm): length in the built filament.
    pub rest_length: f64,
    /// Fraction of the rigidity of the interface. The weights of an interface add up to 1.
    pub weight: f64,
}
