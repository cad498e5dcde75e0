//! The link of a filament whose ends are held: what twist and writhe have to add up to.

use super::Ribbon;
use crate::assembly::StageTimes;
use crate::scene::is_across;
use crate::{Assembly, At, End};
use actin_mechanics::{State, Vector3, rotation};
use std::f64::consts::PI;

/// Link of filament 0 in turns: how far the end has been turned about the axis of the filament as
/// built against the start, as the path of the scene prescribes at that time or place.
///
/// `twist + writhe = link`, with both ends going on straight along that axis to be closed at
/// infinity, as long as the filament has not passed through itself or one of these straight lines
/// on its way, which changes the sum by two. None where an end is free, or tilted by the path: then
/// the ends are not parallel and the link is not defined.
///
/// # Source
/// J. H. White, Am. J. Math. 91 (1969) 693; F. B. Fuller, PNAS 75 (1978) 3557.
pub fn link(assembly: &Assembly, at: At) -> Option<f64> {
    link_of(assembly, 0, at)
}

/// The same of any filament.
///
/// # Panics
/// If there is no such filament.
pub fn link_of(assembly: &Assembly, filament: usize, at: At) -> Option<f64> {
    link_at(assembly, filament, path_parameter(assembly, at))
}

/// The same at a path parameter.
pub(crate) fn link_at(assembly: &Assembly, filament: usize, parameter: f64) -> Option<f64> {
    let axis = axis_of_ends(assembly, filament)?;
    let turn = |end| {
        let clamp = assembly.held.fixed_at(filament, end)?;
        let turn: Vector3 = assembly.drive.turn(clamp, parameter);
        (!is_across(turn, axis)).then(|| turn.dot(&axis))
    };
    Some((turn(End::End)? - turn(End::Start)?) / (2.0 * PI))
}

/// The axis along which a filament is built; none of one with a shape, whose ends have axes of their own.
fn axis_of_ends(assembly: &Assembly, filament: usize) -> Option<Vector3> {
    let span = &assembly.filaments[filament];
    span.shape.is_none().then(|| span.axis())
}

/// How far the end of a filament is turned against its start (turns), as the path prescribes:
/// the link where the ends are parallel; elsewhere the angle that is left when the end's axis
/// is carried back to that of the start by the smallest rotation, counted on from zero.
///
/// Of a hinged end the held frame behind its spring counts. None where an end is free, or tilted against
/// the other by a right angle or more.
pub(crate) fn turn_of_ends(assembly: &Assembly, filament: usize, at: At) -> Option<f64> {
    let parameter = path_parameter(assembly, at);
    let axis = axis_of_ends(assembly, filament)?;
    let turned = [End::Start, End::End].map(|end| {
        let clamp = assembly.held.turned_at(filament, end)?;
        Some(assembly.drive.turn(clamp, parameter))
    });
    let [Some(start), Some(end)] = turned else {
        return None;
    };
    // Carried on from turn to turn, of each end by itself; together to a whole number of turns.
    let about = angle_about(end, axis) - angle_about(start, axis);
    let between = rotation::exp(start).inverse() * rotation::exp(end);
    if (between * axis).dot(&axis) <= 0.0 {
        return None;
    }
    let within_a_turn = 2.0 * between.imag().dot(&axis).atan2(between.w);
    let whole = ((about - within_a_turn) / (2.0 * PI)).round();
    Some(whole + within_a_turn / (2.0 * PI))
}

/// Twist plus writhe may differ from a whole number of turns by this (turns) and still tell it.
pub(crate) const WHOLE: f64 = 0.05;

/// Whether both ends of a filament are held, but twist plus writhe in `state` tells nothing
/// about turns that are lost.
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
    let sum = Ribbon::of(assembly, filament, state).linking();
    let Some((sum, turn)) = sum.zip(turn_of_ends(assembly, filament, at)) else {
        return true;
    };
    let off = sum - turn;
    (off - off.round()).abs() > WHOLE
}

/// The angle (rad) about `axis` of the rotation by the vector `turn`, less the smallest rotation that
/// tilts the axis as it does, counted on as the vector grows from zero.
fn angle_about(turn: Vector3, axis: Vector3) -> f64 {
    let half = 0.5 * turn.norm();
    let along = turn.try_normalize(0.0).map_or(0.0, |unit| unit.dot(&axis));
    let (sin, cos) = half.sin_cos();
    // Both angles lie in the same quadrant: their difference is small.
    let (there, here) = ((along.abs() * sin).atan2(cos), sin.atan2(cos));
    2.0 * (half + there - here) * along.signum()
}

/// Where on the path of the scene a record stands.
pub(crate) fn path_parameter(assembly: &Assembly, at: At) -> f64 {
    match at {
        At::Path(parameter) => parameter,
        At::Time(time_ns) => StageTimes::of(assembly).parameter(time_ns).0,
    }
}
