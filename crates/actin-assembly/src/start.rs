//! Initial state from another run.

use crate::scene::{Scene, SceneProblem, Setting, Start, Task};
use crate::{Assembly, BodyKind, FilamentSpan};
use actin_mechanics::{State, Vector3};

/// Tolerance for equal arc lengths and positions (nm): far above round-off, far below changes of a scene.
const SAME_PLACE_NM: f64 = 1e-6;

/// Tolerance for equal directions (rad), likewise.
const SAME_DIRECTION: f64 = 1e-6;

impl Assembly {
    /// Starts from `state` of `run`, whose bodies must be the same. Positions and orientations are copied, and
    /// velocities too if both tasks are `Dynamics`. Held bodies stay at their places in `state`, from which
    /// stages move them. Controls begin as in the scene.
    ///
    /// # Errors
    /// If bodies differ, or if the state depends on linkers or strains that are not taken over.
    pub fn start_from(&mut self, run: &Self, state: &State) -> Result<(), SceneProblem> {
        self.check_bodies(run)?;
        self.check_run(run)?;
        let is_motion = |scene: &Scene| matches!(scene.task, Task::Dynamics(_));
        let keeps_velocities = is_motion(&self.scene) && is_motion(&run.scene);
        self.drive.rebase(&self.clamps, state);
        let own = self.system.state_mut();
        own.points.position.clone_from(&state.points.position);
        own.frames.orientation.clone_from(&state.frames.orientation);
        if keeps_velocities {
            own.points.velocity.clone_from(&state.points.velocity);
            let momentum = &state.frames.angular_momentum;
            own.frames.angular_momentum.clone_from(momentum);
        }
        self.drive.place(own, 0.0);
        self.is_started = true;
        Ok(())
    }

    /// Returns an error if the initial state of the scene was not set.
    ///
    /// # Errors
    /// If the scene has `start` and [`start_from`](Self::start_from) was not called.
    pub fn check_start(&self) -> Result<(), SceneProblem> {
        if self.scene.start.is_none() || self.is_started {
            return Ok(());
        }
        Err(self.refused_start("initial states are read by run, check and sweep only (in Rust by `actin_rundir::build`)"))
    }

    /// Returns the problem of an unusable initial state.
    pub fn refused_start(&self, rule: impl Into<String>) -> SceneProblem {
        let directory = self
            .scene
            .start
            .as_ref()
            .map(|Start::Run { directory }| directory);
        let value = directory.map_or_else(String::new, |directory| format!("{directory:?}"));
        SceneProblem::new("start.directory", value, rule)
    }

    fn check_bodies(&self, run: &Self) -> Result<(), SceneProblem> {
        let [own, other] = [self, run].map(|one| (one.points.len(), one.frames.len()));
        if own != other {
            let [own, other] =
                [own, other].map(|(points, frames)| format!("{points} points and {frames} frames"));
            let rule =
                format!("is a run with {other}, but the scene has {own}: write the same sections");
            return Err(self.refused_start(rule));
        }
        let is_same = |(a, b): ((BodyKind, f64), (BodyKind, f64))| {
            a.0 == b.0 && (a.1 - b.1).abs() < SAME_PLACE_NM
        };
        if !self.places().zip(run.places()).all(is_same) {
            let rule = "is a run with other sections: write the same sections";
            return Err(self.refused_start(rule));
        }
        let edges = |scene: &Scene| scene.periodic.as_ref().map(|periodic| periodic.size_nm);
        if edges(&self.scene) != edges(&run.scene) {
            let rule = "is a run with another periodic box: write the same size_nm";
            return Err(self.refused_start(rule));
        }
        let moved = |(own, other): (&FilamentSpan, &FilamentSpan)| {
            (own.origin_nm - other.origin_nm).norm() > SAME_PLACE_NM
                || own.rotation.angle_to(&other.rotation) > SAME_DIRECTION
        };
        if let Some(k) = self.filaments.iter().zip(&run.filaments).position(moved) {
            let rule = format!(
                "is a run in which filament {k} has another position or direction: write the same at_nm and \
                 direction"
            );
            return Err(self.refused_start(rule));
        }
        let mut monomers = self.monomers_as_built().zip(run.monomers_as_built());
        if monomers.any(|(own, other)| (own - other).norm() > SAME_PLACE_NM) {
            let rule = "is a run whose monomers are built at other places: write the same radius_nm, azimuth_deg, \
                        turn_deg, shape and rest twist";
            return Err(self.refused_start(rule));
        }
        Ok(())
    }

    /// Places of the centres of the monomers as built (nm, lab frame).
    fn monomers_as_built(&self) -> impl Iterator<Item = Vector3> + '_ {
        let points = self.points.iter().enumerate();
        let monomers = points.filter(|(_, point)| point.kind == BodyKind::Monomer);
        monomers.map(|(i, _)| self.rest.points.position.get(i))
    }

    /// Kind and arc length (nm) of each point, then of each frame.
    fn places(&self) -> impl Iterator<Item = (BodyKind, f64)> + '_ {
        let points = self.points.iter().map(|point| (point.kind, point.s_nm));
        points.chain(self.frames.iter().map(|frame| (frame.kind, frame.s_nm)))
    }

    fn check_run(&self, run: &Self) -> Result<(), SceneProblem> {
        let settings = run.scene.path.iter().flat_map(|stage| &stage.set);
        let moves =
            |setting: &Setting| matches!(setting, Setting::Anchor { .. } | Setting::Shear { .. });
        let is_sheared = run
            .scene
            .periodic
            .as_ref()
            .is_some_and(|periodic| periodic.strain != 0.0);
        let rule = if run.has_events() {
            "is a run whose linkers bind or unbind: they cannot be taken over"
        } else if is_sheared || settings.into_iter().any(moves) {
            "is a run whose path moves anchors or shears the periodic box: these cannot be taken over"
        } else {
            return Ok(());
        };
        Err(self.refused_start(rule))
    }
}
