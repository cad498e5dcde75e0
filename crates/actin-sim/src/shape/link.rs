//! Link of a filament with held ends: the sum of twist and writhe.

use super::Ribbon;
use super::ribbon::built_frame;
use crate::assembly::StageTimes;
use crate::scene::is_across;
use crate::{Assembly, At, End};
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};
use std::f64::consts::PI;

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
    link_of(assembly, 0, at)
}

/// Link of a filament; see [`link`].
///
/// # Panics
/// If the index is out of range.
pub(crate) fn link_of(assembly: &Assembly, filament: usize, at: At) -> Option<f64> {
    link_at(assembly, filament, path_parameter(assembly, at))
}

pub(crate) fn link_at(assembly: &Assembly, filament: usize, parameter: f64) -> Option<f64> {
    let axis = axis_of_ends(assembly, filament)?;
    let turn = |end| {
        let clamp = assembly.held.fixed_at(filament, end)?;
        let turn: Vector3 = assembly.drive.turn(clamp, parameter);
        (!is_across(turn, axis)).then(|| turn.dot(&axis))
    };
    Some((turn(End::End)? - turn(End::Start)?) / (2.0 * PI))
}

/// Axis along which a filament is built; `None` for a curved filament, whose ends have different
/// axes.
fn axis_of_ends(assembly: &Assembly, filament: usize) -> Option<Vector3> {
    let span = &assembly.filaments[filament];
    span.shape.is_none().then(|| span.axis())
}

/// Held end whose outermost frame the path turns; for a hinged end, the held frame of the spring.
struct TurnedEnd {
    /// Frame as built, third axis along the filament (lab frame).
    built: UnitQuaternion,
    /// Prescribed rotation vector (rad, lab frame).
    turn: Vector3,
}

impl TurnedEnd {
    fn at_end(assembly: &Assembly, filament: usize, end: End, parameter: f64) -> Option<Self> {
        let clamp = assembly.held.turned_at(filament, end)?;
        Some(Self {
            built: built_frame(assembly, filament, end)?,
            turn: assembly.drive.turn(clamp, parameter),
        })
    }

    fn axis(&self) -> Vector3 {
        self.built * Vector3::z()
    }

    fn is_tilted(&self) -> bool {
        is_across(self.turn, self.axis())
    }

    fn turned(&self) -> UnitQuaternion {
        rotation::exp(self.turn) * self.built
    }
}

/// Prescribed rotation (turns) of the end of a filament relative to its start.
///
/// If both ends keep their directions, it is the difference of their rotations about their axes.
/// Otherwise it is the angle that remains after the smallest rotation from the end's axis to the
/// start's axis, minus this angle as built, continued from zero. For a hinged end the held frame of
/// the spring counts. `None` if an end is free, or if an end was tilted and the ends enclose a
/// right or larger angle, now or as built.
pub(crate) fn turn_of_ends(assembly: &Assembly, filament: usize, at: At) -> Option<f64> {
    let parameter = path_parameter(assembly, at);
    let held = |end| TurnedEnd::at_end(assembly, filament, end, parameter);
    let (start, end) = (held(End::Start)?, held(End::End)?);
    // Continued over whole turns for each end separately.
    let about = angle_about(end.turn, end.axis()) - angle_about(start.turn, start.axis());
    if !start.is_tilted() && !end.is_tilted() {
        return Some(about / (2.0 * PI));
    }
    let before = angle_between(start.built, end.built)?;
    let change = angle_between(start.turned(), end.turned())? - before;
    let whole = ((about - change) / (2.0 * PI)).round();
    Some(whole + change / (2.0 * PI))
}

/// Angle (rad, within a turn) of `end` relative to `start` about their third axes after the
/// smallest rotation between these; `None` at right or larger angles.
fn angle_between(start: UnitQuaternion, end: UnitQuaternion) -> Option<f64> {
    let between = start.inverse() * end;
    let is_ahead = (between * Vector3::z()).z > 0.0;
    is_ahead.then(|| 2.0 * between.k.atan2(between.w))
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
    let Some(((now, built), turn)) = change.zip(turn_of_ends(assembly, filament, at)) else {
        return true;
    };
    let off = now - built - turn;
    (off - off.round()).abs() > WHOLE
}

/// Angle (rad) about `axis` of the rotation vector `turn`, without the smallest rotation that tilts
/// the axis equally. It is continuous as the vector grows from zero.
fn angle_about(turn: Vector3, axis: Vector3) -> f64 {
    let half = 0.5 * turn.norm();
    let along = turn.try_normalize(0.0).map_or(0.0, |unit| unit.dot(&axis));
    let (sin, cos) = half.sin_cos();
    // Both angles lie in the same quadrant, so their difference is small.
    let (there, here) = ((along.abs() * sin).atan2(cos), sin.atan2(cos));
    2.0 * (half + there - here) * along.signum()
}

pub(crate) fn path_parameter(assembly: &Assembly, at: At) -> f64 {
    match at {
        At::Path(parameter) => parameter,
        At::Time(time_ns) => StageTimes::from_assembly(assembly).parameter(time_ns).0,
    }
}
