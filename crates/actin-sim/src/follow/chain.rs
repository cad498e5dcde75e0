//! A motion as a chain of stretches, each with the resolution that its beginning asked for.

use super::cells::Cells;
use super::criterion::{Criterion, FilamentState, Wish, wish_of};
use super::transfer::{Switch, Transfer};
use crate::run::record;
use crate::scene::{Scene, SceneProblem};
use crate::{
    Assembly, BehindSwitch, MotionPosition, Outcome, Plan, Progress, Record, Recorded, RunError,
    RunPosition, Saved, Sink, Status, Trajectory,
};
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
/// // It bends, and monomers come.
/// let switch = run.switches().next().expect("it bends");
/// assert!(!switch.to_monomers.is_empty());
/// assert!(run.stretches[0].stretch.assembly.counts().monomers == 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Follower {
    /// Its time step and interval of records written out.
    scene: Scene,
    least_ns: f64,
    cells: Cells,
    criteria: Vec<Box<dyn Criterion>>,
}

/// A part of a motion in which no cell is switched.
#[derive(Debug)]
pub struct Stretch {
    /// The filament as it is resolved; its scene has its sections written.
    pub assembly: Assembly,
    /// How it begins.
    pub beginning: Beginning,
}

/// How a stretch begins: with its scene all that a [`Follower`] needs to make it again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beginning {
    /// Its place in the chain, from 0.
    pub index: usize,
    /// Which cells are monomers.
    pub is_monomers: Vec<bool>,
    /// From which step on each may be switched.
    pub free_from: Vec<u64>,
    /// The switch with which it begins; none of the first.
    pub switch: Option<Switch>,
    /// What all switches so far have added to the energy (pN nm).
    pub switches_pn_nm: f64,
}

/// A stretch with what it gave.
#[derive(Debug)]
pub struct Ran {
    /// The stretch.
    pub stretch: Stretch,
    /// Its records; the first of a stretch behind a switch is at the same time as the switch.
    pub trajectory: Trajectory,
    /// How it ended.
    pub outcome: Outcome,
}

/// All stretches of a motion, in order.
#[derive(Debug)]
pub struct Followed {
    /// The stretches.
    pub stretches: Vec<Ran>,
}

impl Followed {
    /// The switches between them, in order.
    pub fn switches(&self) -> impl Iterator<Item = &Switch> {
        let stretches = self.stretches.iter();
        stretches.filter_map(|ran| ran.stretch.beginning.switch.as_ref())
    }
}

/// How a stretch was left.
#[derive(Debug)]
pub enum Left {
    /// The motion has ended with it, or was interrupted.
    Over(Outcome),
    /// Cells are switched: the stretch that follows, and where it begins.
    Switched(Outcome, Box<Next>),
}

/// The stretch behind a switch.
#[derive(Debug)]
pub struct Next {
    /// The stretch.
    pub stretch: Stretch,
    /// Where it begins; its first record is the last that was taken.
    pub saved: Saved,
}

impl Follower {
    /// What runs a scene with sections `Following(..)`.
    ///
    /// # Errors
    /// Other sections, and what [`Assembly::build`] and [`Plan::new`] refuse.
    pub fn new(scene: &Scene) -> Result<Self, SceneProblem> {
        let Some(following) = scene.filament.sections.following() else {
            let rule = "sections are Following(..) where they follow a motion";
            return Err(SceneProblem::new("filament.sections", "", rule));
        };
        let cells = Cells::of(scene, following)?;
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

    /// The same with a further criterion.
    #[must_use]
    pub fn with_criterion(mut self, criterion: Box<dyn Criterion>) -> Self {
        self.criteria.push(criterion);
        self
    }

    /// The scene, its time step and interval of records written out.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Where cells begin and end (nm of arc length).
    pub fn cells_nm(&self) -> Vec<[f64; 2]> {
        self.cells.spans_nm().collect()
    }

    /// The first stretch, resolved as its state at the beginning asks for.
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

    /// A stretch that begins as built.
    fn stretch(&self, is_monomers: Vec<bool>) -> Result<Stretch, SceneProblem> {
        self.again(Beginning {
            index: 0,
            free_from: vec![0; is_monomers.len()],
            is_monomers,
            switch: None,
            switches_pn_nm: 0.0,
        })
    }

    /// The stretch of this scene that begins so.
    ///
    /// # Errors
    /// Another number of cells, and what [`Assembly::build`] refuses.
    pub fn again(&self, beginning: Beginning) -> Result<Stretch, SceneProblem> {
        let cells = self.cells.count();
        let known = [beginning.is_monomers.len(), beginning.free_from.len()];
        if known != [cells; 2] {
            let rule = format!(
                "has {cells} cells, a stretch of it {} and {}",
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

    /// Which cells are to be monomers, if others than now.
    fn wanted(&self, stretch: &Stretch, state: &State, step: u64) -> Option<Vec<bool>> {
        let filament = FilamentState::new((&stretch.assembly, state), self.cells.boundaries_nm());
        let cells = filament.cells(&stretch.beginning.is_monomers);
        let wishes =
            cells
                .zip(&stretch.beginning.free_from)
                .map(|(cell, &free_from)| match wish_of(&self.criteria, &cell) {
                    _ if step < free_from => cell.is_monomers,
                    Wish::Monomers => true,
                    Wish::Rod => false,
                    Wish::Stay => cell.is_monomers,
                });
        let wanted: Vec<bool> = wishes.collect();
        (wanted != stretch.beginning.is_monomers).then_some(wanted)
    }

    /// Runs a stretch, from where it was saved if it was, until the motion ends, is interrupted, or cells are switched.
    /// The sink has the records of the stretch; that of the next gets its first record and a checkpoint here.
    ///
    /// # Errors
    /// As [`Plan::run_into`], and new bodies that do not settle.
    pub fn advance(
        &self,
        (stretch, plan): (&Stretch, &Plan<'_>),
        saved: Option<Saved>,
        sink: &mut dyn Sink,
    ) -> Result<Left, RunError> {
        let mut watching = Watching {
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
            return Ok(Left::Over(outcome));
        };
        let next = self.next(stretch, wanted, &saved)?;
        let outcome = Outcome {
            status: Status::Completed,
            begun_with_pn_nm: None,
            ..outcome
        };
        Ok(Left::Switched(outcome, Box::new(next)))
    }

    /// The stretch behind a switch to `is_monomers`, where another was left.
    fn next(
        &self,
        left: &Stretch,
        is_monomers: Vec<bool>,
        saved: &Saved,
    ) -> Result<Next, SceneProblem> {
        let RunPosition::Motion(position) = &saved.position else {
            unreachable!("a motion is left where it stands in time");
        };
        let here = &position.checkpoint.here;
        let kinds = [&left.beginning.is_monomers, &is_monomers];
        let (to_monomers, to_rod) = (self.switched(kinds, true), self.switched(kinds, false));
        let spans_nm = [to_monomers.as_slice(), &to_rod].concat();
        let mut stretch = self.again(Beginning {
            index: left.beginning.index + 1,
            free_from: self.free_from(left, &is_monomers, here.step),
            is_monomers,
            ..left.beginning.clone()
        })?;
        let transfer = Transfer {
            from: &left.assembly,
            to: &stretch.assembly,
            spans_nm: &spans_nm,
            step: here.step,
            time_ns: here.motion.time,
        };
        let old = left.assembly.system.state().in_motion(here.motion.clone());
        let (state, switch) = transfer.state(&old, &self.scene.task)?;
        stretch.beginning.switches_pn_nm += switch.energy_pn_nm;
        stretch.beginning.switch = Some(Switch {
            to_monomers,
            to_rod,
            ..switch
        });
        let saved = begun(&stretch.assembly, state, (saved, position));
        Ok(Next { stretch, saved })
    }

    /// From which step on each cell may be switched behind a switch at `step`.
    fn free_from(&self, left: &Stretch, is_monomers: &[bool], step: u64) -> Vec<u64> {
        let motion = self.scene.task.motion();
        let length_ns = motion.and_then(|motion| motion.time_step_ns);
        let length_ns = length_ns.unwrap_or(self.least_ns);
        let rest = whole_steps(self.least_ns / length_ns);
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

    /// Cells (nm) that become monomers, or a rod; neighbours as one.
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

    /// Runs the whole motion into memory.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn run(&self) -> Result<Followed, RunError> {
        let mut stretches = Vec::new();
        let (mut stretch, mut saved) = (self.begin()?, None);
        loop {
            let mut trajectory = Trajectory::default();
            trajectory.records.extend(first_record(saved.as_ref()));
            let plan = Plan::new(&stretch.assembly)?;
            let left = self.advance((&stretch, &plan), saved.take(), &mut trajectory)?;
            let (outcome, next) = match left {
                Left::Over(outcome) => (outcome, None),
                Left::Switched(outcome, next) => (outcome, Some(*next)),
            };
            let ran = |stretch| Ran {
                stretch,
                trajectory,
                outcome,
            };
            let Some(next) = next else {
                stretches.push(ran(stretch));
                return Ok(Followed { stretches });
            };
            stretches.push(ran(stretch));
            (stretch, saved) = (next.stretch, Some(next.saved));
        }
    }
}

/// The record with which a stretch behind a switch begins.
fn first_record(saved: Option<&Saved>) -> Option<Record> {
    saved.and_then(|saved| saved.recorded.last.clone())
}

/// The scene with the time step that suits rods and monomers, and the interval of records.
fn resolved(scene: &Scene, cells: &Cells) -> Result<Scene, SceneProblem> {
    let mut finest: Option<(f64, Scene)> = None;
    let all_rod = vec![false; cells.count()];
    let mut mixed = all_rod.clone();
    // Ends, the middle, and where something pulls: other cells differ from these in the bonds that are drawn.
    for cell in [0, cells.count() / 2, cells.count() - 1] {
        mixed[cell] = true;
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

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a positive time over a step, at most the number of steps of a run"
)]
fn whole_steps(steps: f64) -> u64 {
    steps.ceil() as u64
}

/// Where a stretch begins that goes on from `state`.
fn begun(assembly: &Assembly, state: State, (saved, position): (&Saved, &MotionPosition)) -> Saved {
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
    Saved {
        position: RunPosition::Motion(Box::new(MotionPosition {
            checkpoint: Checkpoint {
                last_good: here.clone(),
                here,
                evaluations_before: before.evaluations_before,
            },
            pushes: Vec::new(),
            events: position.events.clone(),
            behind_switch: Some(BehindSwitch {
                step,
                energy_pn_nm: energy,
            }),
        })),
        recorded: saved.recorded.behind_switch(assembly, first),
        wall_s: saved.wall_s,
    }
}

/// A sink that looks at the cells of a motion and leaves it where they are to be switched.
struct Watching<'a> {
    sink: &'a mut dyn Sink,
    follower: &'a Follower,
    stretch: &'a Stretch,
    wanted: Option<Vec<bool>>,
    saved: Option<Saved>,
}

impl Sink for Watching<'_> {
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

    /// Where it is left there is no checkpoint: resumed from there, it would not be left.
    fn checkpoint(&mut self, position: &RunPosition, recorded: &Recorded, wall_s: f64) {
        if self.wanted.is_none() {
            self.sink.checkpoint(position, recorded, wall_s);
            return;
        }
        self.saved = Some(Saved {
            position: position.clone(),
            recorded: recorded.clone(),
            wall_s,
        });
    }
}
