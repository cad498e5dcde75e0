//! Initial state from another run.

use crate::scene::{End, Scene, SceneProblem, Setting, Start, Task};
use crate::{Assembly, BodyKind, FilamentSpan};
use actin_mechanics::{State, Vector3};

/// Tolerance for equal arc lengths and positions (nm): far above round-off, far below changes of a scene.
const SAME_PLACE_NM: f64 = 1e-6;

/// Tolerance for equal directions (rad), likewise.
const SAME_DIRECTION: f64 = 1e-6;

impl Assembly {
    /// Starts from `state` of `run`, whose bodies must be the same, apart from cross-sections at the ends of rods, which
    /// follow the adjacent segment. Positions and orientations are copied, and velocities too if both tasks are `Dynamics`.
    /// Held bodies stay at their places in `state`, from which stages move them. Controls begin as in the scene.
    ///
    /// # Errors
    /// If bodies differ, or if the state depends on linkers or strains that are not taken over.
    pub fn start_from(&mut self, run: &Self, state: &State) -> Result<(), SceneProblem> {
        let frames = self.check_bodies(run)?;
        self.check_run(run)?;
        let state = &self.with_ends(&frames, state);
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

    /// Checks that the bodies are the same. Returns the frame of the run for each frame, `None` for cross-sections at ends that
    /// the run does not have.
    fn check_bodies(&self, run: &Self) -> Result<Vec<Option<usize>>, SceneProblem> {
        let [own, other] = [self, run].map(|one| (one.points.len(), one.frames.len()));
        let is_same = |(a, b): ((BodyKind, f64), (BodyKind, f64))| are_same(a, b);
        let points = own.0 == other.0 && self.points_at().zip(run.points_at()).all(is_same);
        let frames = self.frames_of(run).filter(|_| points);
        let Some(frames) = frames else {
            let [mine, others] =
                [own, other].map(|(points, frames)| format!("{points} points and {frames} frames"));
            let rule = if own == other {
                "is a run with other sections: write the same sections".to_owned()
            } else {
                format!("is a run with {others}, but the scene has {mine}: write the same sections")
            };
            return Err(self.refused_start(rule));
        };
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
        Ok(frames)
    }

    /// Frame of another assembly for each frame, if they differ in free cross-sections at ends at most.
    fn frames_of(&self, other: &Self) -> Option<Vec<Option<usize>>> {
        let hinges = |one: &Self| {
            let filaments = 0..one.filaments.len();
            let ends = filaments.flat_map(|k| [End::Start, End::End].map(|end| (k, end)));
            ends.map(|(k, end)| one.hinge_frames(k, end).is_some())
                .collect::<Vec<_>>()
        };
        if hinges(self) != hinges(other) {
            return None;
        }
        let mut found = Vec::with_capacity(self.frames.len());
        let mut others = (0..other.frames.len()).peekable();
        for i in 0..self.frames.len() {
            let is_same = |&j: &usize| are_same(self.frame_at(i), other.frame_at(j));
            while others
                .next_if(|j| !is_same(j) && other.is_free_end(*j))
                .is_some()
            {}
            let same = others.next_if(is_same);
            if same.is_none() && !self.is_free_end(i) {
                return None;
            }
            found.push(same);
        }
        others.all(|j| other.is_free_end(j)).then_some(found)
    }

    fn is_free_end(&self, frame: usize) -> bool {
        self.frames[frame].kind == BodyKind::Wall && self.rest.frames.is_free(frame)
    }

    /// State of a run on the bodies of this scene, with the frames of the run for each frame.
    fn with_ends(&self, frames: &[Option<usize>], state: &State) -> State {
        let mut own = self.rest.clone();
        own.points.position.clone_from(&state.points.position);
        own.points.velocity.clone_from(&state.points.velocity);
        for (i, from) in frames.iter().enumerate() {
            if let Some(j) = *from {
                let (of, to) = (&state.frames, &mut own.frames);
                to.orientation.set(i, of.orientation.get(j));
                to.angular_momentum.set(i, of.angular_momentum.get(j));
            }
        }
        for i in (0..frames.len()).filter(|&i| frames[i].is_none()) {
            let is_first = self.filaments[self.filament_of_frame(i)].frames.start == i;
            let segment = if is_first { i + 1 } else { i - 1 };
            let rest = &self.rest.frames.orientation;
            let relative = rest.get(segment).inverse() * rest.get(i);
            let turned = own.frames.orientation.get(segment) * relative;
            own.frames.orientation.set(i, turned);
        }
        own
    }

    /// Places of the centres of the monomers as built (nm, lab frame).
    fn monomers_as_built(&self) -> impl Iterator<Item = Vector3> + '_ {
        let points = self.points.iter().enumerate();
        let monomers = points.filter(|(_, point)| point.kind == BodyKind::Monomer);
        monomers.map(|(i, _)| self.rest.points.position.get(i))
    }

    /// Kind and arc length (nm) of each point.
    fn points_at(&self) -> impl Iterator<Item = (BodyKind, f64)> + '_ {
        self.points.iter().map(|point| (point.kind, point.s_nm))
    }

    /// Kind and arc length (nm) of a frame.
    fn frame_at(&self, i: usize) -> (BodyKind, f64) {
        (self.frames[i].kind, self.frames[i].s_nm)
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

fn are_same(a: (BodyKind, f64), b: (BodyKind, f64)) -> bool {
    a.0 == b.0 && (a.1 - b.1).abs() < SAME_PLACE_NM
}
