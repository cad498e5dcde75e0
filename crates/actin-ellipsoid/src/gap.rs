//! The space between two neighbours at rest, which bonds bridge: which lines do so, and how long
//! they are.

use crate::{Bond, Ellipsoid, EllipsoidParameters, Helix, InterfaceKind, Neighbour};
use actin_mechanics::Vector3;

/// The space between two neighbours, and how long a bond may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// The body of either monomer.
    pub(crate) ellipsoid: Ellipsoid,
    /// The upper monomer as the lower one sees it.
    pub(crate) neighbour: Neighbour,
    /// Shortest bond that is accepted (nm).
    pub(crate) minimum: f64,
    /// Longest bond that is accepted (nm).
    pub(crate) maximum: f64,
}

impl Gap {
    /// That of an interface at rest.
    pub(crate) fn new(parameters: &EllipsoidParameters, kind: InterfaceKind) -> Self {
        let interface = kind.parameters(parameters);
        Self {
            ellipsoid: Ellipsoid::new(parameters.semi_axes),
            neighbour: Helix::new(parameters).neighbour(kind),
            minimum: interface.minimum_length,
            maximum: interface.maximum_length,
        }
    }

    /// Direction of all bonds: the line of centres, from the lower to the upper monomer.
    pub(crate) fn direction(&self) -> Vector3 {
        self.neighbour.offset.normalize()
    }

    /// The bond that starts at `point` of the lower monomer's surface and runs parallel to the
    /// line of centres, if there is one that bridges the gap and is neither too short nor too long.
    ///
    /// It runs *towards* the upper monomer, leaves the lower one where it starts (the outward
    /// normal faces the upper monomer) and ends where it *enters* the upper one (the smaller
    /// root, positive). Then the smaller root is also the shorter one, and no bond lies inside a
    /// monomer. What this refuses beyond the published rule: points on the far side, whose bond
    /// would run through the lower monomer, points inside the upper monomer, where monomers
    /// overlap, and bonds below the shortest one. Its weight is that of an only bond. With the default parameters there are none of the
    /// first two within the maximum length.
    pub(crate) fn bond_from(&self, point: Vector3) -> Option<Bond> {
        let Neighbour { rotation, offset } = self.neighbour;
        let direction = self.direction();
        if self.ellipsoid.normal(point).dot(&direction) <= 0.0 {
            return None;
        }
        let origin = rotation.tr_mul(&(point - offset));
        let towards = rotation.tr_mul(&direction);
        let [length, _] = self.ellipsoid.line_intersections(origin, towards)?;
        (length > 0.0 && length >= self.minimum && length <= self.maximum).then(|| Bond {
            lower: point,
            upper: origin + length * towards,
            rest_length: length,
            weight: 1.0,
        })
    }

    /// Distance from `point` of the lower monomer's surface along the line of centres to where the
    /// upper one is entered (nm), negative where the monomers overlap; none if the line misses.
    pub(crate) fn length_from(&self, point: Vector3) -> Option<f64> {
        let Neighbour { rotation, offset } = self.neighbour;
        let origin = rotation.tr_mul(&(point - offset));
        let towards = rotation.tr_mul(&self.direction());
        let [entry, _] = self.ellipsoid.line_intersections(origin, towards)?;
        Some(entry)
    }
}
