//! Refusal of twists that segments cannot represent.

use super::Assembly;
use crate::At;
use crate::scene::{End, SceneProblem, Setting};
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

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
