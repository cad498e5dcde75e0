//! The twist of a frame along a polyline.

use actin_mechanics::{UnitQuaternion, Vector3};
use std::f64::consts::PI;

/// Twist (turns) of frames along directions: how often their first axis turns about the curve.
///
/// `frames[i]` belongs to the edge along the unit vector `tangents[i]`. Its first axis, brought
/// across the tangent by the shortest turn of its third axis to it, is compared with its neighbour's
/// after the shortest turn of the one tangent to the other; the angles about the tangent, each
/// within half a turn, add up. So shear does not count as twist, and with the writhe of the same
/// polyline `twist + writhe = link` holds exactly, not only in the limit of short edges.
///
/// ```
/// use actin_mechanics::{Vector3, rotation};
/// use actin_sim::shape::twist;
/// let frames: Vec<_> = (0..5).map(|k| rotation::exp(Vector3::z() * (0.5 * f64::from(k)))).collect();
/// let turns = twist(&frames, &[Vector3::z(); 5]);
/// assert!((turns - 2.0 / std::f64::consts::TAU).abs() < 1e-15);
/// ```
pub fn twist(frames: &[UnitQuaternion], tangents: &[Vector3]) -> f64 {
    angles(frames, tangents).iter().sum::<f64>() / (2.0 * PI)
}

/// The angle (rad, within half a turn) by which each frame is turned about the curve against the one
/// before: `n` frames have `n - 1` angles.
pub(super) fn angles(frames: &[UnitQuaternion], tangents: &[Vector3]) -> Vec<f64> {
    let across: Vec<Vector3> = frames
        .iter()
        .zip(tangents)
        .map(|(q, t)| transport(q * Vector3::z(), *t, q * Vector3::x()))
        .collect();
    let angles = (1..across.len()).map(|i| {
        let before = transport(tangents[i - 1], tangents[i], across[i - 1]);
        let sin = before.cross(&across[i]).dot(&tangents[i]);
        sin.atan2(before.dot(&across[i]))
    });
    angles.collect()
}

/// `v` after the shortest turn that brings the unit vector `from` to the unit vector `to`; as it
/// is where they are opposite, since no turn is the shortest then.
fn transport(from: Vector3, to: Vector3, v: Vector3) -> Vector3 {
    let axis = from.cross(&to);
    let denominator = 1.0 + from.dot(&to);
    if denominator <= f64::EPSILON {
        return v;
    }
    let once = axis.cross(&v);
    v + once + axis.cross(&once) / denominator
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::closed_writhe;
    use actin_mechanics::Xorshift;
    use actin_mechanics::rotation;

    /// Half a turn about z, then bent over by one about y, neither of which is twist of the other.
    #[test]
    fn bending_is_no_twist() {
        let frames: Vec<UnitQuaternion> = (0..40)
            .map(|k| rotation::exp(Vector3::new(0.6, -0.8, 0.0) * (0.07 * f64::from(k))))
            .collect();
        let tangents: Vec<Vector3> = frames.iter().map(|q| q * Vector3::z()).collect();
        assert!(twist(&frames, &tangents).abs() < 1e-14);
    }

    /// Several turns count as such; a frame that is sheared against its edge twists no less.
    #[test]
    fn shear_is_no_twist() {
        let mut noise = Xorshift::new(2);
        let turn = |k: i32| rotation::exp(Vector3::z() * (0.9 * f64::from(k)));
        let sheared: Vec<UnitQuaternion> = (0..60)
            .map(|k| {
                // A tilt of the frame about an axis across its own.
                let tilt = Vector3::new(noise.sample(), noise.sample(), 0.0) * 0.05;
                let ends = k == 0 || k == 59;
                turn(k) * rotation::exp(if ends { Vector3::zeros() } else { tilt })
            })
            .collect();
        let turns = twist(&sheared, &vec![Vector3::z(); 60]);
        // The tilts leave no trace: each frame is brought back by the shortest turn.
        assert!((turns - 59.0 * 0.9 / (2.0 * PI)).abs() < 1e-13, "{turns}");
    }

    /// White's theorem: around a closed polygon twist and writhe add up to a whole number, the same
    /// for every framing up to whole numbers.
    #[test]
    fn twist_and_writhe_of_a_closed_ribbon_are_a_whole_number() {
        let mut noise = Xorshift::new(4);
        for _ in 0..20 {
            let points: Vec<Vector3> = (0..9).map(|_| noise.vector()).collect();
            let edge = |i: usize| (points[(i + 1) % 9] - points[i % 9]).normalize();
            let tangents: Vec<Vector3> = (0..10).map(edge).collect();
            let mut frames: Vec<UnitQuaternion> = tangents
                .iter()
                .map(|t| {
                    let along = rotation::exp(noise.vector() * 3.0);
                    UnitQuaternion::rotation_between(&(along * Vector3::z()), t).unwrap() * along
                })
                .collect();
            frames[9] = frames[0];
            let link = twist(&frames, &tangents) + closed_writhe(&points);
            // Solid angles of ten dozen pairs, each to round-off.
            assert!((link - link.round()).abs() < 1e-12, "{link}");
        }
    }
}
