//! Rotations as angles about x, y and z.

use actin_sim::mechanics::UnitQuaternion;

/// Angles (rad) of `R = Rx(a) Ry(b) Rz(c)`, `b` within a right angle.
///
/// The first row of R is `(cos b cos c, -cos b sin c, sin b)`, its last column
/// `(sin b, -sin a cos b, cos a cos b)`. Where `b` is a right angle only `a +- c` is known: `c` is zero then.
pub(super) fn of(turn: &UnitQuaternion) -> [f64; 3] {
    let r = turn.to_rotation_matrix();
    let b = r[(0, 2)].clamp(-1.0, 1.0).asin();
    // Below this the cosine of b is round-off.
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

    /// The three turns in their order make the rotation again, at b = 90 deg too.
    #[test]
    fn three_turns_make_the_rotation_again() {
        let mut noise = Xorshift::new(3);
        let random = (0..200).map(|_| UnitQuaternion::from_scaled_axis(6.0 * noise.vector()));
        let right = [-1.0, 1.0].map(|sign| about(Vector3::y(), sign * std::f64::consts::FRAC_PI_2));
        let poles = right.map(|turn| about(Vector3::x(), 0.4) * turn * about(Vector3::z(), -1.1));
        for turn in random.chain(poles) {
            let [a, b, c] = of(&turn);
            let again = about(Vector3::x(), a) * about(Vector3::y(), b) * about(Vector3::z(), c);
            // An arcsine near its end keeps half of the digits.
            assert!(again.angle_to(&turn) < 1e-7, "{turn:?}");
        }
    }
}
