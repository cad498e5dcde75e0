//! Twist of frames along a polyline.

use actin_mechanics::{UnitQuaternion, Vector3};
use std::f64::consts::PI;

/// Twist (turns) of frames about the tangents of a polyline.
///
/// `frames[i]` belongs to the edge with the unit tangent `tangents[i]`. The smallest rotation of
/// the third axis to the tangent makes the first axis transverse. Transverse axes of neighbours are
/// compared after parallel transport between their tangents, and the angles, each within half a
/// turn, are summed. Shear therefore does not count as twist, and `twist + writhe = link` holds
/// exactly for the polyline.
pub(crate) fn twist(frames: &[UnitQuaternion], tangents: &[Vector3]) -> f64 {
    angles(frames, tangents).iter().sum::<f64>() / (2.0 * PI)
}

/// Rotation angle (rad, within half a turn) of each frame about the curve relative to the previous
/// one: `n` frames have `n - 1` angles.
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

/// Parallel transport of `v` by the smallest rotation from `from` to `to`; `v` itself for opposite
/// directions.
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
    use actin_mechanics::Xorshift;
    use actin_mechanics::rotation;

    #[test]
    fn bending_is_no_twist() {
        let frames: Vec<UnitQuaternion> = (0..40)
            .map(|k| rotation::exp(Vector3::new(0.6, -0.8, 0.0) * (0.07 * f64::from(k))))
            .collect();
        let tangents: Vec<Vector3> = frames.iter().map(|q| q * Vector3::z()).collect();
        assert!(twist(&frames, &tangents).abs() < 1e-14);
    }

    /// Several turns, with frames sheared against their edges.
    #[test]
    fn shear_is_no_twist() {
        let mut noise = Xorshift::new(2);
        let turn = |k: i32| rotation::exp(Vector3::z() * (0.9 * f64::from(k)));
        let sheared: Vec<UnitQuaternion> = (0..60)
            .map(|k| {
                // A tilt of the frame about a transverse axis.
                let tilt = Vector3::new(noise.sample(), noise.sample(), 0.0) * 0.05;
                let ends = k == 0 || k == 59;
                turn(k) * rotation::exp(if ends { Vector3::zeros() } else { tilt })
            })
            .collect();
        let turns = twist(&sheared, &vec![Vector3::z(); 60]);
        // The smallest rotation removes each tilt exactly.
        assert!((turns - 59.0 * 0.9 / (2.0 * PI)).abs() < 1e-13, "{turns}");
    }
}
