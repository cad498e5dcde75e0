//! Rotations of the ends of a filament that the path of a scene prescribes.

use crate::ramp::StageTimes;
use crate::scene::{End, SceneProblem, Setting, is_across};
use crate::{Assembly, At};
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

impl Assembly {
    /// Returns the path parameter of a time or place.
    pub fn path_parameter(&self, at: At) -> f64 {
        match at {
            At::Path(parameter) => parameter,
            At::Time(time_ns) => StageTimes::from_assembly(self).parameter(time_ns).0,
        }
    }

    /// Returns the prescribed rotation (turns) of the end of a straight filament relative to its start about its axis, at
    /// a path parameter. `None` if an end is free or tilted by the path.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn link_at(&self, filament: usize, parameter: f64) -> Option<f64> {
        let axis = axis_of_ends(self, filament)?;
        let turn = |end| {
            let clamp = self.held.fixed_at(filament, end)?;
            let turn: Vector3 = self.drive.turn(clamp, parameter);
            (!is_across(turn, axis)).then(|| turn.dot(&axis))
        };
        Some((turn(End::End)? - turn(End::Start)?) / (2.0 * PI))
    }

    /// Returns the prescribed rotation (turns) of the end of a filament relative to its start.
    ///
    /// If both ends keep their directions, it is the difference of their rotations about their axes.
    /// Otherwise it is the angle that remains after the smallest rotation from the end's axis to the
    /// start's axis, minus this angle as built, continued from zero. For a hinged end the held frame of
    /// the spring counts. `None` if an end is free, or if an end was tilted and the ends enclose a
    /// right or larger angle, now or as built.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn turn_of_ends(&self, filament: usize, at: At) -> Option<f64> {
        let parameter = self.path_parameter(at);
        let held = |end| TurnedEnd::at_end(self, filament, end, parameter);
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

    /// Returns the axes as built of the outermost held frame of an end, or of the held frame of its hinge; `None`
    /// if the end rotates freely.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn built_frame(&self, filament: usize, end: End) -> Option<UnitQuaternion> {
        let clamp = self.held.turned_at(filament, end)?;
        let frame = self.clamps[clamp].outermost_frame(end)?;
        let span = &self.filaments[filament];
        Some(span.frame_at(self.frames[frame].s_nm))
    }
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
            built: assembly.built_frame(filament, end)?,
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

/// Angle (rad, within a turn) of `end` relative to `start` about their third axes after the
/// smallest rotation between these; `None` at right or larger angles.
fn angle_between(start: UnitQuaternion, end: UnitQuaternion) -> Option<f64> {
    let between = start.inverse() * end;
    let is_ahead = (between * Vector3::z()).z > 0.0;
    is_ahead.then(|| 2.0 * between.k.atan2(between.w))
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

impl Assembly {
    /// Refuses a path that twists a rod held at both ends by half a turn or more per joint.
    ///
    /// The curvature of a joint is the logarithm of its rotation, with angles up to pi. Beyond pi a
    /// driven joint slips by a whole turn and its torque changes sign. The check assumes uniform
    /// twist at the end of each stage; shocks can slip earlier.
    ///
    /// # Errors
    /// Names the setting that twists too far.
    pub fn check_slip(&self) -> Result<(), SceneProblem> {
        (0..self.filaments.len()).try_for_each(|filament| self.check_slip_of(filament))
    }

    fn check_slip_of(&self, filament: usize) -> Result<(), SceneProblem> {
        let span = &self.filaments[filament];
        let section = span.sections.start;
        let [start, end] = [End::Start, End::End].map(|end| self.held.fixed_at(filament, end));
        let (Some(rod), Some(start), Some(end)) = (self.rod_of(section), start, end) else {
            return Ok(());
        };
        if span.sections.len() > 1 {
            return Ok(());
        }
        let joints = rod.layout.voronoi_lengths();
        let length: f64 = joints.iter().sum();
        let longest = joints.iter().copied().fold(0.0, f64::max);
        let turned = [start, end].map(|clamp| self.drive.turned_after(clamp));
        let stages: BTreeSet<usize> = turned.into_iter().flatten().collect();
        for stages in stages {
            let whole = self.turned_against(filament, [start, end], stages as f64);
            let each = whole * longest / length;
            if each >= PI {
                let (whole, each) = (whole.to_degrees(), each.to_degrees());
                let rule = format!(
                    "the ends of filament {filament} are turned by {whole:.0} deg against each \
                     other, which is {each:.0} deg between neighbouring segments: at 180 deg a turn is \
                     lost; use more segments"
                );
                return Err(SceneProblem::new(
                    self.key_of_turn(filament, stages - 1),
                    "",
                    rule,
                ));
            }
        }
        Ok(())
    }

    /// Rotation (rad) of the end relative to the start at a path parameter. If unknown, it is
    /// estimated from the prescribed turns of both ends about the filament.
    fn turned_against(&self, filament: usize, clamps: [usize; 2], parameter: f64) -> f64 {
        if let Some(turns) = self.turn_of_ends(filament, At::Path(parameter)) {
            return TAU * turns.abs();
        }
        let turns = clamps.map(|clamp| {
            let turn = self.drive.turn(clamp, parameter);
            turn.dot(&self.clamps[clamp].axis)
        });
        (turns[1] - turns[0]).abs()
    }

    fn key_of_turn(&self, filament: usize, stage: usize) -> String {
        let settings = &self.scene.path[stage].set;
        let is_turn = |setting: &Setting| matches!(setting, Setting::Turn { filament: f, .. } if *f == filament);
        settings.iter().rposition(is_turn).map_or_else(
            || format!("path[{stage}]"),
            |k| format!("path[{stage}].set[{k}].turn_deg"),
        )
    }
}
