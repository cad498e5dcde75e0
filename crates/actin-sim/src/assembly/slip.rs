//! Turns that segments cannot follow: past half a turn, two neighbours forget which way they came.

use super::{Assembly, Clamped};
use crate::scene::{End, Problem, Setting};
use std::f64::consts::PI;

impl Assembly {
    /// Refuses a path that twists a rod held at both ends by half a turn or more in each joint of
    /// two segments.
    ///
    /// The curvature of a joint is the logarithm of its rotation, which knows angles up to pi
    /// alone: past it a driven joint slips back by a whole turn, and its couple changes sign.
    /// Looked at is uniform twist at the end of each stage; shocks may slip before.
    pub(crate) fn check_slip(&self) -> Result<(), Problem> {
        (0..self.filaments.len()).try_for_each(|filament| self.check_slip_of(filament))
    }

    fn check_slip_of(&self, filament: usize) -> Result<(), Problem> {
        let span = &self.filaments[filament];
        let rod = self.rods.iter().find(|r| r.section == span.sections.start);
        let held = |end| {
            let is_there = |c: &Clamped| (c.filament, c.end) == (filament, end);
            self.clamps.iter().position(is_there)
        };
        let (Some(rod), Some(start), Some(end)) = (rod, held(End::Start), held(End::End)) else {
            return Ok(());
        };
        if span.sections.len() > 1 {
            return Ok(());
        }
        let joints = rod.layout.voronoi_lengths();
        let length: f64 = joints.iter().sum();
        let longest = joints.iter().copied().fold(0.0, f64::max);
        for stage in 0..self.drive.stages() {
            let at_its_end = (stage + 1) as f64;
            let turn = |clamp| self.drive.turn(clamp, at_its_end).dot(&span.axis());
            let whole = (turn(end) - turn(start)).abs();
            let each = whole * longest / length;
            if each >= PI {
                let (whole, each) = (whole.to_degrees(), each.to_degrees());
                let rule = format!(
                    "the ends of filament {filament} are turned by {whole:.0} deg against each \
                     other, {each:.0} deg in a joint of two segments: from 180 deg on it slips; \
                     use more segments"
                );
                return Err(Problem::new(self.key_of_turn(filament, stage), "", rule));
            }
        }
        Ok(())
    }

    /// The key of the last turn of a filament in a stage; of the stage if there is none.
    fn key_of_turn(&self, filament: usize, stage: usize) -> String {
        let settings = &self.scene.path[stage].set;
        let is_turn = |setting: &Setting| matches!(setting, Setting::Turn { filament: f, .. } if *f == filament);
        settings.iter().rposition(is_turn).map_or_else(
            || format!("path[{stage}]"),
            |k| format!("path[{stage}].set[{k}].turn_deg"),
        )
    }
}
