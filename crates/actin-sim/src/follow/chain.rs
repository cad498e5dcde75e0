//! Motion as a chain of stretches with constant resolution.

use super::criterion::{Criterion, FilamentState, ResolutionRequest, wish_of};
use super::transfer::{Switch, Transfer};
use crate::run::record;
use crate::scene::{Scene, SceneProblem};
use crate::{
    Assembly, MotionPosition, Outcome, Plan, Progress, Record, RecordSummary, ResolutionSwitch,
    RunError, RunPosition, SavedRun, Sink, Status, Trajectory,
};
use actin_assembly::Cells;
use actin_assembly::whole::to_steps;
use actin_integrate::{Checkpoint, Moment, Snapshot};
use actin_mechanics::{Split, State};
use serde::{Deserialize, Serialize};

/// Runs a scene whose sections follow its motion.
///
/// ```
/// use actin_sim::follow::Follower;
/// use actin_sim::Scene;
/// let text = "Scene(
///     filament: Filament(sections: Following(
///         length_nm: 110.0,
///         monomers_where: [Curvature(above_per_nm: 2e-3, below_per_nm: 1e-3)],
///         least_ns: 0.5,
///     )),
///     clamps: [Clamp(end: Start)],
///     loads: [EndForce(end: End, force_pn: (-5.0, 0.0, 0.0))],
///     task: Dynamics(duration_ns: 3.0, record_every_ns: 0.5),
/// )";
/// let run = Follower::new(&Scene::from_ron(text)?)?.run()?;
/// // The filament bends, and cells become monomers.
/// let switch = run.switches().next().expect("the filament bends");
/// assert!(!switch.to_monomers.is_empty());
/// assert!(run.stretches[0].stretch.assembly.counts().monomers == 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Follower {
    /// Scene with its time step and interval of records.
    scene: Scene,
    least_ns: f64,
    cells: Cells,
    criteria: Vec<Box<dyn Criterion>>,
}

/// Part of a motion between two switches of cells.
#[derive(Debug)]
pub struct Stretch {
    /// The filament in its resolution, with explicit sections in its scene.
    pub assembly: Assembly,
    /// Start of the stretch.
    pub beginning: StretchStart,
}

/// Start of a stretch. Together with the scene it allows a [`Follower`] to recreate the stretch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StretchStart {
    /// Index in the chain.
    pub index: usize,
    /// `true` for each cell of monomers.
    pub is_monomers: Vec<bool>,
    /// First step at which each cell may be switched.
    pub free_from: Vec<u64>,
    /// Switch at the start; `None` for the first stretch.
    pub switch: Option<Switch>,
    /// Energy change by all switches so far (pN nm).
    pub switches_pn_nm: f64,
}

/// Stretch with its results.
#[derive(Debug)]
pub struct CompletedStretch {
    /// The stretch.
    pub stretch: Stretch,
    /// Records; after a switch, the first one is at the time of the switch.
    pub trajectory: Trajectory,
    /// Outcome of the stretch.
    pub outcome: Outcome,
}

/// All stretches of a motion in order.
#[derive(Debug)]
pub struct AdaptiveMotion {
    /// Stretches in order.
    pub stretches: Vec<CompletedStretch>,
}

impl AdaptiveMotion {
    /// Iterates over the switches between stretches in order.
    pub fn switches(&self) -> impl Iterator<Item = &Switch> {
        let stretches = self.stretches.iter();
        stretches.filter_map(|ran| ran.stretch.beginning.switch.as_ref())
    }
}

/// End of a stretch.
#[derive(Debug)]
pub enum StretchEnd {
    /// The motion ended or was interrupted.
    Over(Outcome),
    /// Cells are switched; with the next stretch and its start.
    Switched(Outcome, Box<NextStretch>),
}

/// Stretch after a switch.
#[derive(Debug)]
pub struct NextStretch {
    /// The stretch.
    pub stretch: Stretch,
    /// Its initial state; its first record is the last one taken.
    pub saved: SavedRun,
}

impl Follower {
    /// Creates a follower of a scene with sections `Following(..)`.
    ///
    /// # Errors
    /// If the scene has other sections, or as [`Assembly::build`] and [`Plan::new`].
    pub fn new(scene: &Scene) -> Result<Self, SceneProblem> {
        let Some(following) = scene.filament.sections.following() else {
            let rule = "must be Following(..)";
            return Err(SceneProblem::new("filament.sections", "", rule));
        };
        let cells = Cells::new(scene, following)?;
        let criteria = following.monomers_where.iter();
        Ok(Self {
            scene: resolved(scene, &cells)?,
            least_ns: following.least_ns,
            criteria: criteria
                .map(|&one| -> Box<dyn Criterion> { Box::new(one) })
                .collect(),
            cells,
        })
    }

    /// Adds a criterion.
    #[must_use]
    pub fn with_criterion(mut self, criterion: Box<dyn Criterion>) -> Self {
        self.criteria.push(criterion);
        self
    }

    /// Returns the scene with its time step and interval of records.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the first stretch, resolved by the criteria in the initial state.
    ///
    /// # Errors
    /// As [`Assembly::build`].
    pub fn begin(&self) -> Result<Stretch, SceneProblem> {
        let none = vec![false; self.cells.count()];
        let mut first = self.stretch(none.clone())?;
        let wanted = self.wanted(&first, first.assembly.system.state(), 0);
        if let Some(is_monomers) = wanted {
            first = self.stretch(is_monomers)?;
        }
        Ok(first)
    }

    fn stretch(&self, is_monomers: Vec<bool>) -> Result<Stretch, SceneProblem> {
        self.again(StretchStart {
            index: 0,
            free_from: vec![0; is_monomers.len()],
            is_monomers,
            switch: None,
            switches_pn_nm: 0.0,
        })
    }

    /// Recreates the stretch with this start.
    ///
    /// # Errors
    /// If the number of cells differs, or as [`Assembly::build`].
    pub fn again(&self, beginning: StretchStart) -> Result<Stretch, SceneProblem> {
        let cells = self.cells.count();
        let known = [beginning.is_monomers.len(), beginning.free_from.len()];
        if known != [cells; 2] {
            let rule = format!(
                "has {cells} cells, but the stretch has {} and {}",
                known[0], known[1]
            );
            return Err(SceneProblem::new("filament.sections", "", rule));
        }
        let scene = self.cells.scene(&self.scene, &beginning.is_monomers);
        Ok(Stretch {
            assembly: Assembly::build(&scene)?,
            beginning,
        })
    }

    /// Returns the resolution of the cells wanted by the criteria, if it differs from the present
    /// one.
    fn wanted(&self, stretch: &Stretch, state: &State, step: u64) -> Option<Vec<bool>> {
        let filament = FilamentState::new((&stretch.assembly, state), self.cells.boundaries_nm());
        let cells = filament.cells(&stretch.beginning.is_monomers);
        let wishes =
            cells
                .zip(&stretch.beginning.free_from)
                .map(|(cell, &free_from)| match wish_of(&self.criteria, &cell) {
                    _ if step < free_from => cell.is_monomers,
                    ResolutionRequest::Monomers => true,
                    ResolutionRequest::Rod => false,
                    ResolutionRequest::Stay => cell.is_monomers,
                });
        let wanted: Vec<bool> = wishes.collect();
        (wanted != stretch.beginning.is_monomers).then_some(wanted)
    }

    /// Runs a stretch, new or from a saved position, until the motion ends, is interrupted, or
    /// cells are switched.
    ///
    /// `sink` has the records of the stretch. The sink of the next stretch receives its first
    /// record and a checkpoint.
    ///
    /// # Errors
    /// As [`Plan::run_into`], or if new bodies do not settle.
    pub fn advance(
        &self,
        (stretch, plan): (&Stretch, &Plan<'_>),
        saved: Option<SavedRun>,
        sink: &mut dyn Sink,
    ) -> Result<StretchEnd, RunError> {
        let mut watching = SwitchInterrupt {
            sink,
            follower: self,
            stretch,
            wanted: None,
            saved: None,
        };
        let outcome = match saved {
            None => plan.run_into(&mut watching),
            Some(saved) => plan.resume_into(saved, &mut watching),
        }?;
        let (Some(wanted), Some(saved)) = (watching.wanted, watching.saved) else {
            return Ok(StretchEnd::Over(outcome));
        };
        let next = self.next(stretch, wanted, &saved)?;
        let outcome = Outcome {
            status: Status::Completed,
            begun_with_pn_nm: None,
            ..outcome
        };
        Ok(StretchEnd::Switched(outcome, Box::new(next)))
    }

    fn next(
        &self,
        left: &Stretch,
        is_monomers: Vec<bool>,
        saved: &SavedRun,
    ) -> Result<NextStretch, SceneProblem> {
        let RunPosition::Motion(position) = &saved.position else {
            unreachable!("a motion stops at a position in time");
        };
        let here = &position.checkpoint.here;
        let kinds = [&left.beginning.is_monomers, &is_monomers];
        let (to_monomers, to_rod) = (self.switched(kinds, true), self.switched(kinds, false));
        let mut stretch = self.again(StretchStart {
            index: left.beginning.index + 1,
            free_from: self.free_from(left, &is_monomers, here.step),
            is_monomers,
            ..left.beginning.clone()
        })?;
        let transfer = Transfer {
            from: &left.assembly,
            to: &stretch.assembly,
            to_monomers,
            to_rod,
            step: here.step,
            time_ns: here.motion.time,
        };
        let old = left.assembly.system.state().in_motion(here.motion.clone());
        let (state, switch) = transfer.state(&old, &self.scene.task)?;
        stretch.beginning.switches_pn_nm += switch.energy_pn_nm;
        stretch.beginning.switch = Some(switch);
        let saved = begun(&stretch.assembly, state, (saved, position));
        Ok(NextStretch { stretch, saved })
    }

    /// First step at which each cell may be switched again after a switch at `step`.
    fn free_from(&self, left: &Stretch, is_monomers: &[bool], step: u64) -> Vec<u64> {
        let motion = self.scene.task.motion();
        let length_ns = motion.and_then(|motion| motion.time_step_ns);
        let length_ns = length_ns.unwrap_or(self.least_ns);
        let rest = to_steps((self.least_ns / length_ns).ceil());
        let before = &left.beginning;
        let cells = before.free_from.iter().zip(&before.is_monomers);
        cells
            .zip(is_monomers)
            .map(|((&free_from, before), now)| {
                if now == before {
                    free_from
                } else {
                    step + rest
                }
            })
            .collect()
    }

    /// Intervals (nm) of cells that become monomers, or a rod; neighbouring cells are merged.
    fn switched(&self, [before, now]: [&Vec<bool>; 2], resolved: bool) -> Vec<[f64; 2]> {
        let mut spans: Vec<[f64; 2]> = Vec::new();
        let kinds = before.iter().zip(now);
        for (span, (before, now)) in self.cells.spans_nm().zip(kinds) {
            if before == now || *now != resolved {
                continue;
            }
            match spans.last_mut() {
                Some(last) if last[1] >= span[0] => last[1] = span[1],
                _ => spans.push(span),
            }
        }
        spans
    }

    /// Runs the whole motion with records in memory.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn run(&self) -> Result<AdaptiveMotion, RunError> {
        let mut stretches = Vec::new();
        let (mut stretch, mut saved) = (self.begin()?, None::<SavedRun>);
        loop {
            let first = saved.iter().filter_map(|saved| saved.recorded.last.clone());
            let mut trajectory = Trajectory {
                records: first.collect(),
            };
            let plan = Plan::new(&stretch.assembly)?;
            let end = self.advance((&stretch, &plan), saved, &mut trajectory)?;
            let (outcome, next) = match end {
                StretchEnd::Over(outcome) => (outcome, None),
                StretchEnd::Switched(outcome, next) => (outcome, Some(*next)),
            };
            stretches.push(CompletedStretch {
                stretch,
                trajectory,
                outcome,
            });
            let Some(next) = next else {
                return Ok(AdaptiveMotion { stretches });
            };
            (stretch, saved) = (next.stretch, Some(next.saved));
        }
    }
}

/// Returns the scene with an interval of records and a time step for both rods and monomers.
fn resolved(scene: &Scene, cells: &Cells) -> Result<Scene, SceneProblem> {
    let mut finest: Option<(f64, Scene)> = None;
    let all_rod = vec![false; cells.count()];
    let mut mixed = all_rod.clone();
    // Ends, the middle, and cells with linkers; other cells differ only in their sampled
    // bonds.
    for cell in [0, cells.count() / 2, cells.count() - 1] {
        mixed[cell] = true;
    }
    // Junctions can require the shortest steps.
    if (2..=3).contains(&cells.count()) {
        mixed[1] = false;
    }
    for (cell, [from, to]) in cells.spans_nm().enumerate() {
        let mut linkers = scene.linkers.iter();
        mixed[cell] |= linkers.any(|linker| from <= linker.at_nm && linker.at_nm <= to);
    }
    for is_monomers in [all_rod, mixed] {
        let assembly = Assembly::build(&cells.scene(scene, &is_monomers))?;
        let plan = Plan::new(&assembly)?;
        let step = plan.estimate().map_or(f64::INFINITY, |e| e.time_step_ns);
        if finest.as_ref().is_none_or(|(least, _)| step < *least) {
            finest = Some((step, plan.scene().clone()));
        }
    }
    let (_, mut resolved) = finest.expect("two were compared");
    resolved.filament.sections = scene.filament.sections.clone();
    Ok(resolved)
}

fn begun(
    assembly: &Assembly,
    state: State,
    (saved, position): (&SavedRun, &MotionPosition),
) -> SavedRun {
    let before = &position.checkpoint;
    let mut system = assembly.system.in_state(state);
    let (step, time) = (before.here.step, before.here.motion.time);
    let first = record(&mut Moment::new(step, time, &mut system));
    let energy = first.potential_pn_nm() + first.kinetic_pn_nm;
    let here = Snapshot {
        step,
        motion: system.state().motion(),
        loads_are_current: system.loads_are_current(),
        force_evaluations: before.here.force_evaluations + system.force_evaluations(),
        largest_kinetic: before.here.largest_kinetic.max(first.kinetic_pn_nm),
    };
    SavedRun {
        position: RunPosition::Motion(Box::new(MotionPosition {
            checkpoint: Checkpoint {
                last_good: here.clone(),
                here,
                evaluations_before: before.evaluations_before,
            },
            pushes: Vec::new(),
            events: position.events.clone(),
            behind_switch: Some(ResolutionSwitch {
                step,
                energy_pn_nm: energy,
            }),
        })),
        recorded: saved.recorded.behind_switch(assembly, first),
        wall_s: saved.wall_s,
    }
}

/// Sink that leaves a motion when cells should be switched.
struct SwitchInterrupt<'a> {
    sink: &'a mut dyn Sink,
    follower: &'a Follower,
    stretch: &'a Stretch,
    wanted: Option<Vec<bool>>,
    saved: Option<SavedRun>,
}

impl Sink for SwitchInterrupt<'_> {
    fn record(&mut self, record: &Record) {
        self.sink.record(record);
    }

    fn progress(&mut self, progress: &Progress) {
        self.sink.progress(progress);
    }

    fn is_left(&mut self, step: u64, state: &State) -> bool {
        self.wanted = self.follower.wanted(self.stretch, state, step);
        self.wanted.is_some()
    }

    fn is_interrupted(&mut self) -> bool {
        self.sink.is_interrupted()
    }

    fn is_checkpoint_due(&mut self) -> bool {
        self.sink.is_checkpoint_due()
    }

    /// Skips the checkpoint at a switch, from which a resumed run would not switch.
    fn checkpoint(&mut self, position: &RunPosition, recorded: &RecordSummary, wall_s: f64) {
        if self.wanted.is_none() {
            self.sink.checkpoint(position, recorded, wall_s);
            return;
        }
        self.saved = Some(SavedRun {
            position: position.clone(),
            recorded: recorded.clone(),
            wall_s,
        });
    }
}
