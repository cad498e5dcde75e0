//! Conversion of rotations to Euler angles.

use actin_sim::mechanics::UnitQuaternion;

/// Returns Euler angles `[a, b, c]` (rad), with `b` in `[-pi/2, pi/2]`.
///
/// ```text
/// R = Rx(a) Ry(b) Rz(c)
/// first row of R    = (cos b cos c, -cos b sin c, sin b)
/// last column of R  = (sin b, -sin a cos b, cos a cos b)
/// ```
///
/// At `b = +-pi/2` only `a +- c` is determined, and `c` is zero.
pub(super) fn of(turn: &UnitQuaternion) -> [f64; 3] {
    let r = turn.to_rotation_matrix();
    let b = r[(0, 2)].clamp(-1.0, 1.0).asin();
    // Smaller values of cos(b) are round-off.
    if r[(0, 0)].hypot(r[(0, 1)]) < 1e-12 {
        return [r[(2, 1)].atan2(r[(1, 1)]), b, 0.0];
    }
    let a = (-r[(1, 2)]).atan2(r[(2, 2)]);
    let c = (-r[(0, 1)]).atan2(r[(0, 0)]);
    [a, b, c]
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_sim::mechanics::{Vector3, Xorshift};

    fn about(axis: Vector3, angle: f64) -> UnitQuaternion {
        UnitQuaternion::from_scaled_axis(axis * angle)
    }

    /// The angles reproduce the rotation, including b = 90 deg.
    #[test]
    fn three_turns_make_the_rotation_again() {
        let mut noise = Xorshift::new(3);
        let random = (0..200).map(|_| UnitQuaternion::from_scaled_axis(6.0 * noise.vector()));
        let right = [-1.0, 1.0].map(|sign| about(Vector3::y(), sign * std::f64::consts::FRAC_PI_2));
        let poles = right.map(|turn| about(Vector3::x(), 0.4) * turn * about(Vector3::z(), -1.1));
        for turn in random.chain(poles) {
            let [a, b, c] = of(&turn);
            let again = about(Vector3::x(), a) * about(Vector3::y(), b) * about(Vector3::z(), c);
            // The arcsine loses half of the digits near +-1.
            assert!(again.angle_to(&turn) < 1e-7, "{turn:?}");
        }
    }
}
