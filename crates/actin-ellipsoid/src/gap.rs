//! Gap between two neighbours.

use crate::{Bond, Ellipsoid, EllipsoidParameters, Helix, InterfaceKind, Neighbour};
use actin_mechanics::Vector3;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    pub(crate) ellipsoid: Ellipsoid,
    pub(crate) neighbour: Neighbour,
    pub(crate) minimum: f64,
    pub(crate) maximum: f64,
}

impl Gap {
    pub(crate) fn new(parameters: &EllipsoidParameters, kind: InterfaceKind) -> Self {
        let interface = parameters.interface(kind);
        Self {
            ellipsoid: Ellipsoid::new(parameters.semi_axes),
            neighbour: Helix::new(parameters).neighbour(kind),
            minimum: interface.minimum_length,
            maximum: interface.maximum_length,
        }
    }

    /// Direction of all bonds: from the lower centre to the upper one.
    pub(crate) fn direction(&self) -> Vector3 {
        self.neighbour.offset.normalize()
    }

    /// Bond with weight 1 that starts at `point` of the lower surface and is parallel to the line
    /// of centres. Returns `None` if the line misses or the length is not admissible.
    ///
    /// The bond leaves the lower monomer (the outward normal faces the upper one) and ends at its
    /// entry into the upper monomer, the smaller root. In addition to the published rule, this
    /// excludes points on the far side, points inside the upper monomer, and bonds below the
    /// minimum length. The default parameters have no points of the first two kinds within the
    /// maximum length.
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

    /// Distance from `point` of the lower surface along the line of centres to the upper surface
    /// (nm). Negative if the monomers overlap; `None` if the line misses.
    pub(crate) fn length_from(&self, point: Vector3) -> Option<f64> {
        let Neighbour { rotation, offset } = self.neighbour;
        let origin = rotation.tr_mul(&(point - offset));
        let towards = rotation.tr_mul(&self.direction());
        let [entry, _] = self.ellipsoid.line_intersections(origin, towards)?;
        Some(entry)
    }
}
