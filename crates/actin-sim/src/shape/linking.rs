//! Twist plus writhe of a filament with held ends, and its most twisted joint.
//!
//! The sum is constant while the filament moves between held ends. It changes by a whole turn where
//! a joint passes half a turn, because the twist of a joint is known within half a turn only. It
//! changes by two where the filament passes through itself or through the straight extension of an
//! end.

use super::Ribbon;
use super::ribbon::{PARALLEL, is_parallel};
use super::twist::angles;
use super::writhe::triangle;
use crate::{Assembly, At, End};
use actin_mechanics::{State, Vector3};
use std::f64::consts::PI;

/// Distance (nm) below which parallel lines coincide: far above round-off, far below displacements
/// of scenes.
const ONE_LINE_NM: f64 = 1e-6;

/// Link of filament 0 (turns): rotation of the end relative to the start about the axis as built,
/// prescribed by the path of the scene at a time or place.
///
/// With both ends extended straight along that axis to infinity, `twist + writhe = link`. The sum
/// changes by two turns if the filament passes through itself or one of the extensions. `None` if
/// an end is free or tilted by the path, because the link is then not defined.
///
/// # Source
/// J. H. White, Am. J. Math. 91 (1969) 693; F. B. Fuller, PNAS 75 (1978) 3557.
pub fn link(assembly: &Assembly, at: At) -> Option<f64> {
    assembly.link_at(0, assembly.path_parameter(at))
}

/// Tolerance (turns) within which twist plus writhe is a whole number.
pub(crate) const WHOLE: f64 = 0.05;

/// Returns `true` if both ends of a filament are held, but twist plus writhe in `state` cannot
/// reveal lost turns.
pub(crate) fn link_is_unknown(
    assembly: &Assembly,
    filament: usize,
    (state, at): (&State, At),
) -> bool {
    if [End::Start, End::End]
        .iter()
        .any(|end| assembly.held.turned_at(filament, *end).is_none())
    {
        return false;
    }
    let sum = |state| Ribbon::from_state(assembly, filament, state).linking();
    let change = sum(state).zip(sum(&assembly.rest));
    let Some(((now, built), turn)) = change.zip(assembly.turn_of_ends(filament, at)) else {
        return true;
    };
    let off = now - built - turn;
    (off - off.round()).abs() > WHOLE
}

impl Ribbon {
    /// Twist plus writhe (turns): the link up to a number that depends on the history and on the
    /// filament as built.
    ///
    /// If the ends are not parallel, the area between the tangents is closed by the shortest arc
    /// from the last to the first. The link is then the rotation of the end carried back along that
    /// arc.
    ///
    /// The cost is one pass if every edge points forward along the start, and the double sum of the
    /// writhe otherwise. `None` in these cases:
    ///
    /// - an end is free;
    /// - the ends are neither parallel nor as built, and an edge points backward;
    /// - the straight extensions of the ends overlap or cross, because one end has passed the
    ///   other;
    /// - the writhe is not computed.
    pub(crate) fn linking(&self) -> Option<f64> {
        let (frames, tangents) = self.held_edges()?;
        let twist = angles(&frames, &tangents).iter().sum::<f64>() / (2.0 * PI);
        let beyond = [tangents[0], tangents[tangents.len() - 1]];
        let backward = || {
            let is_known = is_parallel(beyond[0], beyond[1]) || self.points_as_built(beyond);
            let is_closed = is_known && !self.extensions_meet(beyond);
            is_closed.then(|| self.writhe_between(beyond)).flatten()
        };
        let writhe = forward_writhe(&tangents).or_else(backward)?;
        Some(twist + writhe)
    }

    /// Returns `true` if every edge points forward along the first, the extension of the start. The
    /// filament then passes around neither end.
    pub(crate) fn is_forward(&self) -> bool {
        let (_, tangents) = self.edges();
        tangents.iter().all(|t| t.dot(&tangents[0]) > 0.0)
    }

    /// Returns `true` if the straight extensions of both ends, along these unit vectors, overlap or
    /// cross.
    fn extensions_meet(&self, [first, last]: [Vector3; 2]) -> bool {
        let points = &self.points_nm;
        let whole = points[points.len() - 1] - points[0];
        if is_parallel(first, last) {
            let along = whole.dot(&first);
            // Touching ends count too, for example of a circle, where round-off would decide.
            return along <= ONE_LINE_NM && (whole - along * first).norm() <= ONE_LINE_NM;
        }
        let normal = first.cross(&last);
        let square = normal.norm_squared();
        // Ends in opposite directions extend side by side.
        if square <= PARALLEL {
            return false;
        }
        // Closest points of the lines: backward along the first, forward along the second.
        let back = -whole.cross(&last).dot(&normal) / square;
        let on = whole.cross(&first).dot(&normal) / square;
        let apart = whole.dot(&normal).abs() / square.sqrt();
        back >= 0.0 && on >= 0.0 && apart <= ONE_LINE_NM
    }

    /// Arc length (nm) and angle (rad) of the joint with the largest twist.
    pub(crate) fn most_twisted(&self) -> (f64, f64) {
        let (frames, tangents) = self.edges();
        let joints = self.s_nm.iter().copied().zip(angles(&frames, &tangents));
        let largest = joints.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        largest.unwrap_or_default()
    }
}

/// Writhe of a curve with these unit tangents if all point forward along the first; `None`
/// otherwise. The area is closed by the shortest arc from the last to the first.
///
/// Such a curve can be deformed to a straight line without self-passage. Its writhe is therefore
/// the area that its tangents enclose on the sphere, over `2 pi`, computed as a sum of triangles
/// with the first tangent as common corner.
///
/// # Source
/// F. B. Fuller, PNAS 75 (1978) 3557, second theorem.
fn forward_writhe(tangents: &[Vector3]) -> Option<f64> {
    let axis = tangents[0];
    if !tangents.iter().all(|t| t.dot(&axis) > 0.0) {
        return None;
    }
    let areas = tangents.windows(2).map(|t| -triangle(axis, t[0], t[1]));
    Some(areas.sum::<f64>() / (2.0 * PI))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::link;
    use crate::shape::tests::{CLAMPS, SECTIONS, build};
    use crate::{Assembly, At, Scene};
    use actin_mechanics::State;
    use actin_mechanics::rotation;
    use actin_mechanics::{Xorshift, perturb};

    fn shaken(assembly: &Assembly, noise: &mut Xorshift, size: f64) -> State {
        let mut state = assembly.rest.clone();
        perturb(&mut state, noise, size, 0.2 * size);
        for clamp in &assembly.clamps {
            for &i in &clamp.points {
                let place = assembly.rest.points.position.get(i);
                state.points.position.set(i, place);
            }
            for &i in &clamp.frames {
                let q = assembly.rest.frames.orientation.get(i);
                state.frames.orientation.set(i, q);
            }
        }
        state
    }

    /// Both methods agree, and the sum is a whole number, or zero without a slip.
    #[test]
    fn twist_and_writhe_add_up_to_a_whole_number() {
        let mut noise = Xorshift::new(11);
        for sections in SECTIONS {
            let assembly = build(sections, CLAMPS[2]);
            // With all edges forward, and with some backward.
            for (size, points_forward) in [(0.3, true), (30.0, false)] {
                let state = shaken(&assembly, &mut noise, size);
                let ribbon = Ribbon::new(&assembly, &state);
                let (_, tangents) = ribbon.edges();
                let forward = forward_writhe(&tangents);
                assert_eq!(forward.is_some(), points_forward, "{sections}");
                if let Some(forward) = forward {
                    // Round-off of some hundred solid angles.
                    let whole = ribbon.writhe().unwrap();
                    assert!((forward - whole).abs() < 1e-12, "{forward} {whole}");
                    assert!(ribbon.linking().unwrap().abs() < 1e-12);
                }
                let sum = ribbon.linking().unwrap();
                assert!((sum - sum.round()).abs() < 1e-11, "{sum}");
            }
        }
    }

    /// Both methods agree also for ends that are not parallel.
    #[test]
    fn both_ways_agree_between_ends_that_are_not_parallel() {
        let mut noise = Xorshift::new(23);
        for _ in 0..20 {
            let first = noise.vector().normalize();
            let mut tangents = vec![first];
            while tangents.len() < 12 {
                let next = (first + 2.0 * noise.vector()).normalize();
                if next.dot(&first) > 0.0 {
                    tangents.push(next);
                }
            }
            let mut points = vec![Vector3::zeros()];
            for edge in &tangents[1..11] {
                points.push(points[points.len() - 1] + edge);
            }
            let whole = super::super::extended_writhe(&points, [first, tangents[11]]);
            let forward = forward_writhe(&tangents).unwrap();
            // Round-off of some hundred solid angles.
            assert!((forward - whole).abs() < 1e-12, "{forward} {whole}");
        }
    }

    #[test]
    fn a_joint_past_half_a_turn_loses_one() {
        let assembly = build(SECTIONS[0], CLAMPS[2]);
        let turned = |degrees: f64| {
            let mut state = assembly.rest.clone();
            // Every free segment from 25 nm up to the held wall.
            for (i, info) in assembly.frames.iter().enumerate() {
                if info.s_nm > 30.0 {
                    let q = rotation::exp(Vector3::z() * degrees.to_radians());
                    state.frames.orientation.set(i, q);
                }
            }
            Ribbon::new(&assembly, &state)
        };
        let sums = [170.0, 190.0].map(|degrees| turned(degrees).linking().unwrap());
        // The wall at the end was turned too.
        assert!((sums[0] - 170.0 / 360.0).abs() < 1e-13 && (sums[1] + 170.0 / 360.0).abs() < 1e-13);
        let (s_nm, angle) = turned(170.0).most_twisted();
        assert!((s_nm - 30.0).abs() < 1e-12 && (angle - 170.0_f64.to_radians()).abs() < 1e-12);
        assert_eq!(link(&assembly, At::Path(0.0)), Some(0.0));
    }

    /// For tilts below a right angle, twist plus writhe equals the rotation of the ends, continued
    /// from zero.
    #[test]
    fn twist_and_writhe_follow_tilted_ends() {
        for (turn, segments) in [
            ([0.0, 1.0, 300.0], 60),
            ([0.0, 1.0, 3000.0], 120),
            ([5.0, -30.0, 60.0], 60),
            ([40.0, 10.0, -400.0], 60),
        ] {
            let text = format!(
                "Scene(
                    filament: Filament(sections: [
                        Rod(from_nm: 0.0, to_nm: 120.0, segments: {segments})]),
                    clamps: [Clamp(end: Start), Clamp(end: End)],
                    path: [Stage(set: [Turn(end: End, turn_deg: ({:?}, {:?}, {:?}))])],
                    task: Equilibrium(),
                )",
                turn[0], turn[1], turn[2]
            );
            let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
            // Uniform bending and twist: each frame has its share of the rotation.
            for share in [0.3, 1.0] {
                let mut state = assembly.rest.clone();
                let whole = Vector3::from(turn).map(f64::to_radians) * share;
                let mut place = Vector3::zeros();
                for i in 0..segments {
                    let frame = assembly.sections[0].frames.start + i;
                    let s_nm = assembly.frames[frame].s_nm;
                    let q = rotation::exp(whole * (s_nm / 120.0));
                    let length = 120.0 / segments as f64;
                    state.points.position.set(i, place);
                    state.frames.orientation.set(frame, q);
                    place += q * Vector3::z() * length;
                    state.points.position.set(i + 1, place);
                }
                assembly.drive.place(&mut state, share);
                let expected = assembly.turn_of_ends(0, At::Path(share)).unwrap();
                let found = Ribbon::new(&assembly, &state).linking().unwrap();
                assert!(
                    (found - expected).abs() < 1e-9,
                    "{turn:?} {share}: {found} {expected}"
                );
            }
        }
    }
}
