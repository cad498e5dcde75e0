//! Scenes run in memory.

use crate::loads::loads_of;
use crate::scene::{End, Scene};
use crate::summary::reported_tip;
use crate::trade::build;
use crate::{Assembly, BodyKind, Outcome, Plan, Reaction, Record, RunError, Summary, Trajectory};
use actin_mechanics::{State, UnitQuaternion, Vector3};

/// Scenes that can be run in memory.
///
/// ```
/// use actin_sim::{Clamp, End, Equilibrium, Filament, Load, Scene, Section, Solve};
/// let filament = Filament::new(vec![
///     Section::ellipsoids(0.0, 40.0),
///     Section::rod(40.0, 160.0, None),
/// ]);
/// let solution = Scene::new(filament, Equilibrium::default())
///     .clamp(Clamp::new(End::Start))
///     .load(Load::end_force(End::End, [0.1, 0.0, 0.0]))
///     .solve()?;
/// assert!(solution.tip_displacement_nm().x > 4.0);
/// let wall = solution.end_reaction(End::Start).expect("a clamped end");
/// assert!((wall.force_pn.x + 0.1).abs() < 1e-6);
/// # Ok::<(), actin_sim::SimError>(())
/// ```
pub trait Solve {
    /// Runs the task of the scene and keeps all records in memory. Automatic sections are chosen first.
    ///
    /// # Errors
    /// As [`Scene::validate`], [`build`], [`Plan::new`] and [`Plan::run`]. Scenes with `Following(..)` sections require
    /// a [`Follower`](crate::follow::Follower), and scenes that start from a run `actin_rundir::build`.
    fn solve(&self) -> Result<Solution, RunError>;
}

impl Solve for Scene {
    fn solve(&self) -> Result<Solution, RunError> {
        Solution::new(build(self)?)
    }
}

/// Run of a scene with its records in memory.
#[derive(Debug)]
pub struct Solution {
    /// Bodies and interactions, with the system in its last state.
    pub assembly: Assembly,
    /// Records in order, at least one.
    pub trajectory: Trajectory,
    /// Status, cost and warnings.
    pub outcome: Outcome,
}

impl Solution {
    /// Runs the task of an assembly from its current state.
    ///
    /// # Errors
    /// As [`Plan::new`] and [`Plan::run`].
    pub fn new(mut assembly: Assembly) -> Result<Self, RunError> {
        let (trajectory, outcome) = Plan::new(&assembly)?.run()?;
        *assembly.system.state_mut() = last(&trajectory).state.clone();
        Ok(Self {
            assembly,
            trajectory,
            outcome,
        })
    }

    /// Returns the records in order.
    pub fn records(&self) -> &[Record] {
        &self.trajectory.records
    }

    /// Returns the last record.
    pub fn last(&self) -> &Record {
        last(&self.trajectory)
    }

    /// Returns the last state.
    pub fn state(&self) -> &State {
        self.assembly.system.state()
    }

    /// Returns the position of the tip of filament 0 in the last state (nm, lab frame): of its end, or of its start if
    /// only the end is clamped.
    pub fn tip_nm(&self) -> Vector3 {
        self.assembly.tip_nm(self.state(), self.tip())
    }

    /// Returns the displacement of that tip from the filament as built, without imperfections (nm, lab frame).
    pub fn tip_displacement_nm(&self) -> Vector3 {
        self.tip_nm() - self.assembly.tip_nm(&self.assembly.rest, self.tip())
    }

    fn tip(&self) -> End {
        reported_tip(&self.assembly, 0)
    }

    /// Returns the force (pN) and torque (pN nm) of the clamp at an end of filament 0 on the filament in the last
    /// state; `None` for a free end.
    pub fn end_reaction(&self, end: End) -> Option<Reaction> {
        let clamp = self.assembly.clamp_at(0, end)?;
        let loads = loads_of(self.assembly.system.interactions(), self.state());
        Some(clamp.reaction(self.state(), &loads))
    }

    /// Returns the points of the centre line of a filament in the last state (nm, lab frame), in their order along it.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn centre_line_nm(&self, filament: usize) -> Vec<Vector3> {
        let points = self.assembly.filaments[filament].points.clone();
        points
            .map(|i| self.assembly.centre_line_nm(self.state(), i))
            .collect()
    }

    /// Returns arc lengths at rest (nm) and orientations (body to lab) of the monomers and segments of a filament in the
    /// last state, in their order along it.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn frames(&self, filament: usize) -> Vec<(f64, UnitQuaternion)> {
        let frames = &self.assembly.frames;
        let bodies = self.assembly.filaments[filament].frames.clone();
        let bodies =
            bodies.filter(|&i| matches!(frames[i].kind, BodyKind::Monomer | BodyKind::Segment));
        let orientation = &self.state().frames.orientation;
        bodies
            .map(|i| (frames[i].s_nm, orientation.get(i)))
            .collect()
    }

    /// Returns the summary of the run, as in `summary.json`, with all notes and warnings.
    ///
    /// # Panics
    /// If records were removed.
    pub fn summary(&self) -> Summary {
        Summary::from_run(&self.assembly, &self.trajectory, &self.outcome)
            .expect("the records belong to the assembly")
    }
}

fn last(trajectory: &Trajectory) -> &Record {
    let last = trajectory.records.last();
    last.expect("a run has a record of its last state")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Clamp, Equilibrium, Filament, Load, Section};

    fn scene(force_pn: f64) -> Scene {
        let sections = vec![
            Section::ellipsoids(0.0, 20.0),
            Section::rod(20.0, 60.0, None),
        ];
        Scene::new(Filament::new(sections), Equilibrium::default())
            .clamp(Clamp::new(End::Start))
            .load(Load::end_force(End::End, [force_pn, 0.0, 0.0]))
    }

    #[test]
    fn quantities_are_those_of_the_summary() {
        let solution = scene(0.5).solve().unwrap();
        let summary = solution.summary();
        let tip = Vector3::from(summary.tip_displacement_nm);
        assert_eq!(solution.tip_displacement_nm(), tip);
        let reaction = solution.end_reaction(End::Start).unwrap();
        assert_eq!(Some(reaction.into()), summary.end_reactions.start);
        assert!(solution.end_reaction(End::End).is_none());
        let frames = solution.frames(0);
        assert_eq!(
            frames.len(),
            summary.counts.monomers + summary.counts.segments
        );
        assert!(frames.is_sorted_by(|(a, _), (b, _)| a < b));
        let line = solution.centre_line_nm(0);
        assert_eq!(line.last(), Some(&solution.tip_nm()));
    }

    /// Scenes written in Rust have passed no reader.
    #[test]
    fn invalid_scenes_are_refused() {
        let refused = |scene: &Scene| scene.solve().unwrap_err().to_string();
        let message = refused(&scene(f64::NAN));
        assert_eq!(
            message,
            "loads[0].force_pn = [NaN, 0.0, 0.0]: must be finite"
        );
        let mut twice = scene(0.5);
        twice.clamps.push(Clamp::new(End::Start));
        let message = refused(&twice);
        assert!(message.contains("clamps"), "{message}");
    }
}
