//! Helix of monomers.

use crate::{EllipsoidParameters, InterfaceKind};
use actin_mechanics::{Matrix3, UnitQuaternion, Vector3};

/// Helix of monomers: axis along lab +z, lattice index 0 at height 0 and azimuth `azimuth`.
///
/// Monomer `m`, possibly negative, has azimuth `phi = azimuth + m turn` and height `m rise`. The
/// azimuth is accurate to `4e-16 |m turn|`.
///
/// ```
/// use actin_ellipsoid::{EllipsoidParameters, Helix};
/// let helix = Helix::new(&EllipsoidParameters::default());
/// // Two steps advance one strand by 27.692 degrees, right-handed.
/// let centre = helix.centre(2);
/// assert!((centre.y.atan2(centre.x).to_degrees() - 27.692).abs() < 1e-3);
/// assert!((centre.z - 5.477).abs() < 1e-3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helix {
    radius: f64,
    rise: f64,
    turn: f64,
    azimuth: f64,
}

/// Pose of the upper monomer of an interface in the frame of the lower one, at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// Rotation from the body frame of the upper monomer to that of the lower one.
    pub rotation: Matrix3,
    /// Vector from the lower to the upper centre (nm, body frame of the lower monomer).
    pub offset: Vector3,
}

impl Helix {
    /// Helix with the given parameters, without validation.
    pub fn new(parameters: &EllipsoidParameters) -> Self {
        Self {
            radius: parameters.radius,
            rise: parameters.rise,
            turn: parameters.turn,
            azimuth: parameters.azimuth,
        }
    }

    /// Rise per monomer (nm).
    pub fn rise(&self) -> f64 {
        self.rise
    }

    /// Azimuth of a monomer (rad), not reduced modulo 2 pi.
    pub(crate) fn azimuth(&self, index: i64) -> f64 {
        index as f64 * self.turn + self.azimuth
    }

    /// Arc length of a monomer (nm); 0 for index 0.
    pub(crate) fn arc_length(&self, index: i64) -> f64 {
        index as f64 * self.rise
    }

    /// Centre of a monomer (nm, lab frame).
    pub fn centre(&self, index: i64) -> Vector3 {
        let (sin, cos) = self.azimuth(index).sin_cos();
        Vector3::new(self.radius * cos, self.radius * sin, self.arc_length(index))
    }

    /// Orientation of a monomer, body to lab. Body axes are radial, tangential, axial.
    pub fn orientation(&self, index: i64) -> UnitQuaternion {
        about_axis(self.azimuth(index))
    }

    /// Change of azimuth from the lower monomer of an interface to the middle (rad).
    pub(crate) fn half_turn(&self, kind: InterfaceKind) -> f64 {
        0.5 * kind.steps() as f64 * self.turn
    }

    /// Pose of the upper monomer of an interface in the frame of the lower one, the same for all
    /// indices.
    pub(crate) fn neighbour(&self, kind: InterfaceKind) -> Neighbour {
        let steps = kind.steps() as f64;
        let (sin, cos) = (steps * self.turn).sin_cos();
        Neighbour {
            rotation: Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0),
            offset: Vector3::new(
                self.radius * (cos - 1.0),
                self.radius * sin,
                steps * self.rise,
            ),
        }
    }
}

fn about_axis(angle: f64) -> UnitQuaternion {
    actin_mechanics::rotation::exp(Vector3::new(0.0, 0.0, angle))
}

#[cfg(test)]
mod tests {
    use super::*;
    use InterfaceKind::{Lateral, Longitudinal};

    fn helix() -> Helix {
        Helix::new(&EllipsoidParameters {
            azimuth: 0.4,
            ..EllipsoidParameters::default()
        })
    }

    #[test]
    fn one_period_returns_to_the_same_azimuth() {
        let shift = helix().centre(26) - helix().centre(0);
        assert!((shift - Vector3::new(0.0, 0.0, 71.2)).norm() < 1e-13);
    }

    #[test]
    fn body_axes_are_radial_tangential_axial() {
        for index in [-27, -1, 0, 1, 2, 500] {
            let q = helix().orientation(index);
            let centre = helix().centre(index);
            let radial = Vector3::new(centre.x, centre.y, 0.0) / helix().radius;
            // The rounding error of 1450 rad is 2e-13.
            assert!((q * Vector3::x() - radial).norm() < 1e-12);
            assert!((q * Vector3::z() - Vector3::z()).norm() < 1e-15);
            assert!((q * Vector3::y() - Vector3::z().cross(&radial)).norm() < 1e-12);
        }
    }

    #[test]
    fn neighbour_agrees_with_the_placed_monomers() {
        for (kind, steps) in [(Lateral, 1), (Longitudinal, 2)] {
            for index in [-5, 0, 13] {
                let upper = index + steps;
                let lower_axes = helix().orientation(index).inverse();
                let offset = lower_axes * (helix().centre(upper) - helix().centre(index));
                let rotation = (lower_axes * helix().orientation(upper)).to_rotation_matrix();
                let neighbour = helix().neighbour(kind);
                assert!((neighbour.offset - offset).norm() < 1e-13);
                assert!((neighbour.rotation - rotation.into_inner()).norm() < 1e-13);
            }
        }
    }
}
