//! Equilibria by Newton's method, from the state as built or along the path of the scene.

use super::outcome::{EquilibriumReport, MeasureModelError};
use super::record_stream::RecordStream;
use super::rest::{is_saddle, saddle};
use super::sink::{Clock, PathPosition, SavedRun, Sink, SolveReport};
use super::start::near_equilibrium;
use super::states::{StableStates, search};
use super::unknowns::newton;
use super::{Failure, Outcome, Progress, Record, RecordSummary, RunPosition, Status};
use crate::Assembly;
use crate::At;
use crate::scene::{Equilibrium as Settings, Load, Resultant, SceneProblem};
use actin_assembly::problem_at;
use actin_equilibrium::{
    Convergence, Equilibrium, Iteration, Jumps, Newton, NewtonFailure, Path, PathError,
    PathFailure, PathObserver, PathOptions, PathPoint, Saddles, SolverWork,
};
use actin_mechanics::{State, System};
use std::ops::ControlFlow;

/// Largest resolved ratio of residual to load.
const RESOLVED: f64 = 0.01;

pub(super) fn run(
    assembly: &Assembly,
    (settings, model_error): (&Settings, MeasureModelError),
    saved: Option<SavedRun>,
    clock: Clock,
    sink: &mut dyn Sink,
) -> Result<(Outcome, Option<Failure>), SceneProblem> {
    let mut newton = newton(assembly, settings)?;
    let mut state = assembly.system.state().clone();
    let mut follower = Follower::new(assembly, settings, saved, clock, sink);
    let failure = follower.follow_to_the_end(&mut newton, &mut state)?;
    let of_path = newton.work();
    let states = match failure {
        None => follower.search_states(&mut newton, &state)?,
        Some(_) => None,
    };
    let status = match failure {
        Some(_) => Status::Failed,
        // An interruption after the last equilibrium has no effect.
        None if follower.is_interrupted => Status::Interrupted,
        None => Status::Converged,
    };
    let position = follower.position;
    let wanted = settings.lowest_eigenvalue && status != Status::Interrupted;
    let last = position.last.as_ref().filter(|_| wanted);
    let lowest_eigenvalue = lowest_eigenvalue(&mut newton, &assembly.system, &state, last);
    let wanted = settings.error_of.filter(|_| status == Status::Converged);
    let error = wanted.map(|quantity| {
        let last = Record::of_equilibrium(&assembly.system, 0.0, &state);
        model_error(assembly, &last, quantity)
    });
    let outcome = Outcome {
        force_evaluations: newton.work().evaluations,
        saddles_left: position.saddles_left,
        jumps: position.jumps,
        equilibrium: report(position, of_path).map(|report| EquilibriumReport {
            lowest_eigenvalue,
            states,
            error,
            ..report
        }),
        ..Outcome::new(status, follower.clock.wall_s())
    };
    let statistics = follower.records.recorded.carried;
    Ok((outcome.with_statistics(assembly, statistics), failure))
}

fn lowest_eigenvalue(
    newton: &mut Newton,
    system: &System,
    state: &State,
    last: Option<&SolveReport>,
) -> Option<f64> {
    let certificate = last?.certificate?;
    let lowest = newton.lowest_eigenvalue(state, system.interactions(), &certificate);
    lowest.ok().flatten()
}

/// Report of the last equilibrium, without the quantities that a scene can request.
fn report(position: PathPosition, of_path: SolverWork) -> Option<EquilibriumReport> {
    let last = position.last?;
    Some(EquilibriumReport {
        certificate: last.certificate?,
        lowest_eigenvalue: None,
        newton_iterations: of_path.iterations,
        points: position.points,
        floor: last.floor,
        history: last.history,
        states: None,
        error: None,
    })
}

fn place(assembly: &Assembly, stages_done: usize) -> String {
    match assembly.drive.stages() {
        0 => String::new(),
        stages => format!("in stage {} of {stages}, ", stages_done + 1),
    }
}

/// Returns a hint if the loads of a scene explain the loss of stability.
fn hint(assembly: &Assembly, cause: &PathError) -> &'static str {
    let is_on_free_end = |load: &Load| match load {
        Load::Couple(couple) => couple.end.is_some_and(|end| {
            let clamp = assembly.clamp_at(couple.filament, end);
            !couple.follows && clamp.is_none()
        }),
        _ => false,
    };
    let is_unstable = matches!(cause, PathError::Unstable { .. });
    if is_unstable && assembly.scene.loads.iter().any(is_on_free_end) {
        "; a couple about a fixed axis on a free end loses its stability at half a turn of the end, or before \
         where the filament twists easily: to turn the end further, clamp it with `slides: Freely` and `Turn` it"
    } else {
        ""
    }
}

/// Returns the options of a path of equilibria from the settings of a task.
pub fn path_options(settings: &Settings) -> PathOptions {
    PathOptions {
        first_step: settings.largest_step.min(0.1).max(settings.smallest_step),
        smallest_step: settings.smallest_step,
        largest_step: settings.largest_step,
        saddles: match settings.leave_saddles {
            0 => Saddles::Keep,
            attempts => Saddles::Leave(attempts),
        },
        jumps: if settings.accept_jumps {
            Jumps::Accept
        } else {
            Jumps::Stop
        },
        ..PathOptions::default()
    }
}

struct Follower<'a> {
    assembly: &'a Assembly,
    settings: &'a Settings,
    records: RecordStream<'a>,
    clock: Clock,
    /// Position for resuming the run.
    position: PathPosition,
    /// The sink interrupted the run before its end.
    is_interrupted: bool,
}

impl<'a> Follower<'a> {
    fn new(
        assembly: &'a Assembly,
        settings: &'a Settings,
        saved: Option<SavedRun>,
        clock: Clock,
        sink: &'a mut dyn Sink,
    ) -> Self {
        let start = PathPosition {
            stage: 0,
            waypoint: None,
            motion: assembly.system.state().motion(),
            points: 0,
            saddles_left: 0,
            jumps: 0,
            last: None,
            work: SolverWork::default(),
        };
        let (position, recorded) = match saved {
            None => (start, None),
            Some(SavedRun {
                position: RunPosition::Path(position),
                recorded,
                ..
            }) => (*position, Some(recorded)),
            Some(_) => panic!("the checkpoint of a motion cannot resume a path of equilibria"),
        };
        Self {
            assembly,
            settings,
            records: RecordStream::new(assembly, recorded, sink),
            clock,
            position,
            is_interrupted: false,
        }
    }

    /// Follows the remaining path, checks the last equilibrium and keeps a checkpoint in every
    /// case.
    fn follow_to_the_end(
        &mut self,
        newton: &mut Newton,
        state: &mut State,
    ) -> Result<Option<Failure>, SceneProblem> {
        let ended = self.follow(newton, state)?;
        if let Some(lost) = self.records.lost.take() {
            self.is_interrupted = false;
            state.set_motion(&self.position.motion);
            self.checkpoint();
            let stage = place(self.assembly, self.position.stage);
            let place = format!("{stage}at path parameter {:.4}, ", lost.at().value());
            return Ok(Some(Failure::from_turn_loss(lost, place)));
        }
        let failure = match ended {
            Some(_) if self.is_interrupted => None,
            Some(failure) => {
                let place = place(self.assembly, self.position.stage);
                let hint = hint(self.assembly, &failure.cause);
                Some(Failure::PathEnded {
                    place,
                    failure,
                    hint,
                })
            }
            None => {
                self.is_interrupted = false;
                self.refine_certificate(newton, state);
                self.final_failure()
            }
        };
        self.checkpoint();
        Ok(failure)
    }

    fn search_states(
        &mut self,
        newton: &mut Newton,
        state: &State,
    ) -> Result<Option<StableStates>, SceneProblem> {
        let starts = self.settings.states;
        let last = self.records.last().map(|last| last.at);
        let Some(at) = last.filter(|_| starts > 0 && !self.is_interrupted) else {
            return Ok(None);
        };
        let tools = (newton, &mut self.records);
        let states = search(self.assembly, tools, (state, at), starts)
            .map_err(|error| SceneProblem::new("task.states", starts, error.to_string()))?;
        self.is_interrupted = states.is_none();
        Ok(states)
    }

    /// Repeats the certificate of an apparent saddle at the smallest residual, because a residual
    /// within the tolerance can change the sign of a neutral mode.
    fn refine_certificate(&mut self, newton: &mut Newton, state: &State) {
        let certificate = self
            .position
            .last
            .as_mut()
            .map(|last| &mut last.certificate);
        let Some(Some(certificate)) = certificate else {
            return;
        };
        if is_saddle(certificate) {
            let nearest = newton.nearest(state, self.assembly.system.interactions());
            if let Ok(Some(nearest)) = nearest {
                *certificate = nearest.certificate;
            }
        }
    }

    fn final_failure(&self) -> Option<Failure> {
        let last = self.records.last();
        let lost = last.and_then(|last| lost_load(self.assembly, last));
        lost.map(Failure::LoadBelowResidual).or_else(|| {
            let certificate = self.position.last.as_ref()?.certificate?;
            let attempts = self.settings.leave_saddles;
            let way = match attempts {
                0 => "leave_saddles: 0 keeps saddles; 1 or more leaves them along the lowest mode",
                _ => "more attempts may lead off it",
            };
            is_saddle(&certificate).then(|| Failure::Saddle(saddle(&certificate, attempts, way)))
        })
    }

    /// Follows all remaining stages, or solves once without a path. Returns the failure that ends
    /// it early.
    fn follow(
        &mut self,
        newton: &mut Newton,
        state: &mut State,
    ) -> Result<Option<Box<PathFailure>>, SceneProblem> {
        state.set_motion(&self.position.motion);
        newton.set_work(self.position.work);
        let result = if self.assembly.drive.is_still() {
            self.solve(newton, state)
        } else {
            let path = Path::new(path_options(self.settings)).map_err(problem_at("task"))?;
            let mut stages = self.position.stage..self.assembly.drive.stages();
            stages.try_for_each(|stage| {
                if self.records.lost.is_some() {
                    return Ok(());
                }
                self.stage(&path, newton, state, stage)
            })
        };
        Ok(result.err())
    }

    /// Solves from a state near the equilibrium, if known. Otherwise, or on failure, solves from
    /// the state as built.
    fn minimize(
        &mut self,
        newton: &mut Newton,
        state: &mut State,
    ) -> Result<Equilibrium, Box<NewtonFailure>> {
        let interactions = self.assembly.system.interactions();
        let attempts = self.settings.leave_saddles;
        if let Some(mut near) = near_equilibrium(self.assembly) {
            newton.carry_along(true);
            let solved = newton.minimize_observed(&mut near, interactions, attempts, &mut |_| {
                self.check_interruption()
            });
            newton.carry_along(false);
            if solved.is_ok() || self.is_interrupted {
                *state = near;
                return solved;
            }
        }
        newton.minimize_observed(state, interactions, attempts, &mut |_| {
            self.check_interruption()
        })
    }

    fn solve(&mut self, newton: &mut Newton, state: &mut State) -> Result<(), Box<PathFailure>> {
        if self.position.points > 0 {
            return Ok(());
        }
        match self.minimize(newton, state) {
            Ok(equilibrium) => {
                if self.record(0.0, state, &equilibrium).is_continue() {
                    self.position.motion = state.motion();
                    self.position.work = newton.work();
                }
                Ok(())
            }
            Err(failure) => {
                if !self.is_interrupted {
                    // Keep the best state.
                    let best = Record::of_equilibrium(&self.assembly.system, 0.0, state);
                    self.records.take_unchecked(best);
                }
                Err(Box::new(PathFailure {
                    parameter: 0.0,
                    attempted: 0.0,
                    equilibrium: None,
                    work: failure.work,
                    cause: PathError::NoEquilibrium(failure),
                    points: 0,
                }))
            }
        }
    }

    fn stage(
        &mut self,
        path: &Path,
        newton: &mut Newton,
        state: &mut State,
        stage: usize,
    ) -> Result<(), Box<PathFailure>> {
        let assembly = self.assembly;
        let mut set = |state: &mut State, t: f64| assembly.drive.place(state, stage as f64 + t);
        let interactions = assembly.system.interactions();
        let waypoint = self.position.waypoint.clone();
        path.follow_from(
            waypoint.as_ref(),
            newton,
            state,
            interactions,
            &mut set,
            self,
        )
        .map(drop)
    }

    fn record(&mut self, u: f64, state: &State, equilibrium: &Equilibrium) -> ControlFlow<()> {
        if !self
            .records
            .take(Record::of_equilibrium(&self.assembly.system, u, state))
        {
            return ControlFlow::Break(());
        }
        self.position.points += 1;
        self.position.saddles_left += equilibrium.saddles_left;
        self.position.last = Some(SolveReport {
            certificate: equilibrium.certificate,
            floor: (equilibrium.ending == Convergence::FloorReached).then_some(equilibrium.floor),
            history: equilibrium
                .history
                .iter()
                .map(|step| step.residual)
                .collect(),
        });
        ControlFlow::Continue(())
    }

    /// Saves the position for resuming: at `point`, or at the start of the next stage.
    fn save_position(&mut self, point: &PathPoint<'_>) {
        let is_end = point.parameter >= 1.0;
        let position = &mut self.position;
        position.stage += usize::from(is_end);
        position.waypoint = (!is_end).then(|| point.waypoint.clone());
        position.motion = point.state.motion();
        position.work = point.work;
    }

    fn checkpoint(&mut self) {
        let position = RunPosition::Path(Box::new(self.position.clone()));
        let wall_s = self.clock.wall_s();
        if self.position.points > 0 {
            self.records.checkpoint(&position, wall_s);
        } else {
            // Best state of a failed attempt; the next attempt starts without it.
            let none = RecordSummary::new(self.assembly);
            self.records.sink.checkpoint(&position, &none, wall_s);
        }
    }

    fn check_interruption(&mut self) -> ControlFlow<()> {
        self.is_interrupted = self.records.sink.is_interrupted();
        if self.is_interrupted {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

impl PathObserver for Follower<'_> {
    fn arrive(&mut self, point: &PathPoint<'_>) -> ControlFlow<()> {
        let stage = self.position.stage;
        let u = stage as f64 + point.parameter;
        // The start of a later stage equals the end of the previous one.
        if stage == 0 || point.parameter > 0.0 {
            self.record(u, point.state, point.equilibrium)?;
        }
        self.position.jumps += usize::from(point.jumped);
        self.save_position(point);
        self.records.sink.progress(&Progress {
            at: At::Path(u),
            end: self.assembly.drive.stages() as f64,
            steps: self.position.points as u64,
            residual_force_pn: point.equilibrium.residual.force,
        });
        if self.records.sink.is_checkpoint_due() {
            self.checkpoint();
        }
        self.check_interruption()
    }

    fn iterate(&mut self, _step: &Iteration) -> ControlFlow<()> {
        self.check_interruption()
    }
}

/// Returns an error for the first load that is not large compared with the residual.
fn lost_load(assembly: &Assembly, last: &Record) -> Option<SceneProblem> {
    let loads = assembly.scene.loads.iter().enumerate();
    loads.into_iter().find_map(|(i, load)| {
        let factor = last.state.controls[assembly.load_controls()[i]];
        let (size, residual, unit) = match load.resultant(&assembly.scene) {
            Resultant::Force(force) => (force.norm(), last.residual_force_pn, "pN"),
            Resultant::Couple(couple) => (couple.norm(), last.residual_torque_pn_nm, "pN nm"),
        };
        let size = size * factor.abs();
        let is_lost = size > 0.0 && residual > RESOLVED * size;
        is_lost.then(|| {
            let rule = format!(
                "is below 100 times the residual of {residual:.1e} {unit}, so the equilibrium does not \
                 resolve its effect; use a larger load"
            );
            load.problem(i, rule)
        })
    })
}
