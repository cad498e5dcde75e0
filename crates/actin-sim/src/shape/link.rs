//! The link of a filament whose ends are held: what twist and writhe have to add up to.

use super::Ribbon;
use super::ribbon::built_frame;
use crate::assembly::StageTimes;
use crate::scene::is_across;
use crate::{Assembly, At, End};
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};
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

/// A held end, of which the path turns the outermost frame; of a hinged end that behind its spring.
struct TurnedEnd {
    /// The frame as built, third axis along the filament (lab frame).
    built: UnitQuaternion,
    /// How the path turns it (rad, rotation vector in the lab frame).
    turn: Vector3,
}

impl TurnedEnd {
    fn of(assembly: &Assembly, filament: usize, end: End, parameter: f64) -> Option<Self> {
        let clamp = assembly.held.turned_at(filament, end)?;
        Some(Self {
            built: built_frame(assembly, filament, end)?,
            turn: assembly.drive.turn(clamp, parameter),
        })
    }

    /// The filament's direction there as built.
    fn axis(&self) -> Vector3 {
        self.built * Vector3::z()
    }

    /// Whether it points elsewhere than as built, or did so on the way.
    fn is_tilted(&self) -> bool {
        is_across(self.turn, self.axis())
    }

    fn turned(&self) -> UnitQuaternion {
        rotation::exp(self.turn) * self.built
    }
}

/// How far the end of a filament has been turned against its start since it was built (turns), as the path
/// prescribes. Where both ends point as built, it is the difference of their turns about their own axes.
/// Elsewhere it is the angle that is left when the end's axis is carried back to that of the start by the
/// smallest rotation, less that as built, counted on from zero.
///
/// Of a hinged end the held frame behind its spring counts. None where an end is free, or where an end was
/// tilted and they point at right angles or further from each other, now or as built.
pub(crate) fn turn_of_ends(assembly: &Assembly, filament: usize, at: At) -> Option<f64> {
    let parameter = path_parameter(assembly, at);
    let held = |end| TurnedEnd::of(assembly, filament, end, parameter);
    let (start, end) = (held(End::Start)?, held(End::End)?);
    // Carried on from turn to turn, of each end by itself; together to a whole number of turns.
    let about = angle_about(end.turn, end.axis()) - angle_about(start.turn, start.axis());
    if !start.is_tilted() && !end.is_tilted() {
        return Some(about / (2.0 * PI));
    }
    let before = angle_between(start.built, end.built)?;
    let change = angle_between(start.turned(), end.turned())? - before;
    let whole = ((about - change) / (2.0 * PI)).round();
    Some(whole + change / (2.0 * PI))
}

/// Angle (rad, within a turn) of `end` against `start` about their third axes, the one carried to the other by
/// the smallest rotation; none where they are at a right angle or further apart.
fn angle_between(start: UnitQuaternion, end: UnitQuaternion) -> Option<f64> {
    let between = start.inverse() * end;
    let is_ahead = (between * Vector3::z()).z > 0.0;
    is_ahead.then(|| 2.0 * between.k.atan2(between.w))
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
    let sum = |state| Ribbon::of(assembly, filament, state).linking();
    let change = sum(state).zip(sum(&assembly.rest));
    let Some(((now, built), turn)) = change.zip(turn_of_ends(assembly, filament, at)) else {
        return true;
    };
    let off = now - built - turn;
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
