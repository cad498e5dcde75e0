//! Turns that segments cannot follow: past half a turn, two neighbours forget which way they came.

use super::Assembly;
use super::parts::Rod;
use crate::scene::{Problem, Setting};
use std::f64::consts::PI;

impl Assembly {
    /// Refuses a path that twists a rod held at both ends by half a turn or more in each joint of
    /// two segments.
    ///
    /// The curvature of a joint is the logarithm of its rotation, which knows angles up to pi
    /// alone: past it a driven joint slips back by a whole turn, and its couple changes sign.
    /// Looked at is uniform twist at the end of each stage; shocks may slip before.
    pub(crate) fn check_slip(&self) -> Result<(), Problem> {
        let ([Rod { layout, .. }], [first, second]) = (&self.rods[..], &self.clamps[..]) else {
            return Ok(());
        };
        if self.sections.len() > 1 {
            return Ok(());
        }
        let axis = self.scene.filament.axis();
        let joints = layout.voronoi_lengths();
        let length: f64 = joints.iter().sum();
        let longest = joints.iter().copied().fold(0.0, f64::max);
        for stage in 0..self.drive.stages() {
            let turn = |clamp| self.drive.turn(clamp, (stage + 1) as f64).dot(&axis);
            let whole = (turn(1) - turn(0)).abs();
            let each = whole * longest / length;
            if each >= PI {
                let (whole, each) = (whole.to_degrees(), each.to_degrees());
                let rule = format!(
                    "{:?} and {:?} are turned by {whole:.0} deg against each other, {each:.0} deg \
                     in a joint of two segments: from 180 deg on it slips; use more segments",
                    first.end, second.end
                );
                return Err(Problem::new(self.key_of_turn(stage), "", rule));
            }
        }
        Ok(())
    }

    /// The key of the last turn in a stage; of the stage if there is none.
    fn key_of_turn(&self, stage: usize) -> String {
        let settings = &self.scene.path[stage].set;
        let is_turn = |setting: &Setting| matches!(setting, Setting::Turn { .. });
        settings.iter().rposition(is_turn).map_or_else(
            || format!("path[{stage}]"),
            |k| format!("path[{stage}].set[{k}].turn_deg"),
        )
    }
}
