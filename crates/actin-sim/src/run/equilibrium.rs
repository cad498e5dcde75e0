//! Equilibria: Newton from the built state, or along the path of the scene.

use super::keep::{Arrival, Clock, Keeper, Kept, PathStanding, Standing};
use super::points::check_points;
use super::rest::{is_saddle, saddle};
use super::slip::{LinkWatch, Slip, links};
use super::unknowns::newton;
use super::{Progress, Record, RunError, RunReport, Trajectory};
use crate::Assembly;
use crate::scene::{Equilibrium as Settings, Load, Problem};
use actin_equilibrium::{
    Certificate, Companion, Ending, Equilibrium, Iteration, Jumps, Newton, Path, PathFailure,
    PathOptions, PathPoint, Saddles, Work,
};
use actin_mechanics::{Loads, State, System, Vector3};
use std::ops::ControlFlow;

/// Forces left over that are a larger share of a load hide it.
const RESOLVED: f64 = 0.01;

/// What is known of an equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumReport {
    /// Counts of negative and unresolved eigenvalues of the stiffness.
    pub certificate: Certificate,
    /// Lowest eigenvalue of the stiffness (pN/nm; turns count as displacements over 1 nm), if the
    /// scene asks for it.
    pub lowest_eigenvalue: Option<f64>,
    /// Newton steps of the whole path.
    pub newton_iterations: u64,
    /// Equilibria on the path.
    pub points: usize,
    /// Force (pN) and torque (pN nm) that rounding leaves, if the last equilibrium ended there and not
    /// within its tolerance.
    pub floor: Option<(f64, f64)>,
    /// Residual force (pN) and torque (pN nm) before each Newton step of the last equilibrium.
    pub history: Vec<(f64, f64)>,
}

/// Solves for the equilibrium, or follows the path; the system ends in the last equilibrium.
pub(super) fn run(
    assembly: &mut Assembly,
    settings: &Settings,
    kept: Option<Kept>,
    keeper: &mut dyn Keeper,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Trajectory, RunReport), RunError> {
    assembly.check_slip()?;
    let clock = Clock::new(kept.as_ref());
    check_points(assembly, settings)?;
    let mut newton = newton(assembly, settings)?;
    let mut state = assembly.system.state().clone();
    let mut follower = Follower::new(assembly, settings, kept, (keeper, watch), clock);
    let trouble = follower.trouble(&mut newton, &mut state)?;
    // What was left at its very end is done.
    let interrupted = matches!(trouble, Some(Trouble::Left));
    let (trajectory, standing) = (follower.trajectory, follower.standing);
    *assembly.system.state_mut() = state;
    let wanted = settings.lowest_eigenvalue && standing.last.is_some() && !interrupted;
    let lowest = wanted.then(|| lowest_eigenvalue(&mut newton, &assembly.system));
    let work = newton.work();
    let report = RunReport {
        converged: trouble.is_none(),
        failed: trouble.is_some() && !interrupted,
        interrupted,
        steps: 0,
        force_evaluations: work.evaluations,
        time_step_ns: None,
        largest_frequency_rad_per_ns: None,
        at_rest: None,
        saddles_left: standing.saddles_left,
        jumps: standing.jumps,
        pushes: Vec::new(),
        equilibrium: report(standing, lowest.flatten(), work),
        beyond_use: Vec::new(),
        wall_s: clock.wall_s(),
    };
    conclude(trouble, trajectory, report)
}

/// The results of a path or an equilibrium, by what went wrong.
fn conclude(
    trouble: Option<Trouble>,
    trajectory: Trajectory,
    report: RunReport,
) -> Result<(Trajectory, RunReport), RunError> {
    match trouble {
        None | Some(Trouble::Left) => Ok((trajectory, report)),
        Some(Trouble::Ended(place, failure)) => Err(RunError::Ended {
            place,
            failure,
            trajectory: Box::new(trajectory),
            report: Box::new(report),
        }),
        Some(Trouble::Lost(problem)) => Err(RunError::Lost {
            problem,
            trajectory: Box::new(trajectory),
            report: Box::new(report),
        }),
        Some(Trouble::Saddle(problem)) => Err(RunError::saddle(*problem, trajectory, report)),
        Some(Trouble::Slipped(place, slip)) => {
            Err(RunError::slipped((place, *slip), trajectory, report))
        }
    }
}

/// Why there is no equilibrium at the end, or none to rely on.
enum Trouble {
    /// The keeper wanted the run to be left.
    Left,
    /// The path ended early: where, in words, and why.
    Ended(String, Box<PathFailure>),
    /// A load is lost in what is left over.
    Lost(Box<Problem>),
    /// The last equilibrium is a saddle.
    Saddle(Box<Problem>),
    /// Twist was lost: where, in words, and how much.
    Slipped(String, Box<Slip>),
}

/// The first load that is lost in an equilibrium: the forces that are left, be it by rounding of
/// places or by a loose tolerance, are no longer small beside it.
fn lost_load(assembly: &Assembly, last: &Record) -> Option<Problem> {
    let loads = assembly.scene.loads.iter().enumerate();
    loads.into_iter().find_map(|(i, load)| {
        let Load::EndForce { force_pn, .. } = load;
        // Controls of loads stand first, one for each.
        let size = Vector3::from(*force_pn).norm() * last.state.controls[i].abs();
        let is_lost = size > 0.0 && last.residual_force_pn > RESOLVED * size;
        is_lost.then(|| {
            let rule = format!(
                "is lost among forces of {:.1e} pN that are left: places are known to round-off, \
                 and forces no better; a larger load tells more",
                last.residual_force_pn
            );
            Problem::new(
                format!("loads[{i}].force_pn"),
                format!("{force_pn:?}"),
                rule,
            )
        })
    })
}

/// Where a path stands after `points` equilibria, in words; nothing where there is no path.
fn place(assembly: &Assembly, stages_done: usize) -> String {
    match assembly.drive.stages() {
        0 => String::new(),
        stages => format!("in stage {} of {stages}, ", stages_done + 1),
    }
}

fn path(settings: &Settings) -> Result<Path, Problem> {
    let options = PathOptions {
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
    };
    Path::new(options).map_err(|error| Problem::new("task", "", error.to_string()))
}

/// One run while it is under way.
struct Follower<'a> {
    assembly: &'a Assembly,
    settings: &'a Settings,
    watch: &'a mut dyn FnMut(Progress) -> ControlFlow<()>,
    keeper: &'a mut dyn Keeper,
    clock: Clock,
    trajectory: Trajectory,
    /// Where the run could be taken up again.
    standing: PathStanding,
    links: LinkWatch,
    slip: Option<Slip>,
    /// Whether the keeper wanted the run to be left.
    is_left: bool,
}

type Guards<'a> = (
    &'a mut dyn Keeper,
    &'a mut dyn FnMut(Progress) -> ControlFlow<()>,
);

impl<'a> Follower<'a> {
    fn new(
        assembly: &'a Assembly,
        settings: &'a Settings,
        kept: Option<Kept>,
        (keeper, watch): Guards<'a>,
        clock: Clock,
    ) -> Self {
        let start = PathStanding {
            stage: 0,
            waypoint: None,
            state: assembly.system.state().clone(),
            points: 0,
            saddles_left: 0,
            jumps: 0,
            last: None,
            work: Work::default(),
        };
        let (standing, trajectory) = match kept {
            None => (start, Trajectory::default()),
            Some(Kept {
                standing: Standing::Path(standing),
                trajectory,
                ..
            }) => (*standing, trajectory),
            Some(_) => panic!("a motion in time is no path of equilibria"),
        };
        let mut links = links(assembly);
        links.follow(assembly, &trajectory.records);
        Self {
            assembly,
            settings,
            watch,
            keeper,
            clock,
            trajectory,
            standing,
            links,
            slip: None,
            is_left: false,
        }
    }

    /// Follows all that is left, and says what is wrong with where it ended. However it did, the run is
    /// kept as it is.
    fn trouble(
        &mut self,
        newton: &mut Newton,
        state: &mut State,
    ) -> Result<Option<Trouble>, Problem> {
        let ended = self.follow(newton, state)?;
        if let Some(slip) = self.slip.take() {
            state.copy_motion_from(&self.standing.state);
            self.keep();
            let stage = place(self.assembly, self.standing.stage);
            let place = format!("{stage}at path parameter {:.4}, ", slip.time_ns);
            return Ok(Some(Trouble::Slipped(place, Box::new(slip))));
        }
        let trouble = match ended {
            Some(_) if self.is_left => Some(Trouble::Left),
            Some(failure) => {
                let place = place(self.assembly, self.standing.stage);
                Some(Trouble::Ended(place, failure))
            }
            None => {
                self.look_closer(newton, state);
                self.flaw()
            }
        };
        self.keep();
        Ok(trouble)
    }

    /// Certifies the last equilibrium again if it seems to be a saddle, with the residual as small as it
    /// gets: what the tolerance leaves of it may pass for the sign of a neutral mode.
    fn look_closer(&mut self, newton: &mut Newton, state: &State) {
        let certificate = self
            .standing
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

    /// What is wrong with the last equilibrium.
    fn flaw(&self) -> Option<Trouble> {
        let last = self.trajectory.records.last();
        let lost = last.and_then(|last| lost_load(self.assembly, last));
        let lost = lost.map(|problem| Trouble::Lost(Box::new(problem)));
        lost.or_else(|| {
            let certificate = self.standing.last.as_ref()?.certificate?;
            let attempts = self.settings.leave_saddles;
            let way = match attempts {
                0 => "with 0 saddles are kept; with 1 or more they are left along the lowest mode",
                _ => "more attempts may lead off it",
            };
            let problem = || Box::new(saddle(&certificate, attempts, way));
            is_saddle(&certificate).then(|| Trouble::Saddle(problem()))
        })
    }

    /// Follows all stages that are left, or solves once where there is none. Returns why it ended
    /// early.
    fn follow(
        &mut self,
        newton: &mut Newton,
        state: &mut State,
    ) -> Result<Option<Box<PathFailure>>, Problem> {
        state.copy_motion_from(&self.standing.state);
        newton.count_on(self.standing.work);
        let result = if self.assembly.drive.is_still() {
            self.solve(newton, state)
        } else {
            let path = path(self.settings)?;
            let mut stages = self.standing.stage..self.assembly.drive.stages();
            stages.try_for_each(|stage| match self.slip {
                None => self.stage(&path, newton, state, stage),
                Some(_) => Ok(()),
            })
        };
        Ok(result.err())
    }

    fn solve(&mut self, newton: &mut Newton, state: &mut State) -> Result<(), Box<PathFailure>> {
        if self.standing.points > 0 {
            return Ok(());
        }
        // An earlier attempt that failed has left the best state that it reached.
        self.trajectory.records.clear();
        let interactions = self.assembly.system.interactions();
        let attempts = self.settings.leave_saddles;
        let solved = newton.minimize_observed(state, interactions, attempts, &mut |_| self.go_on());
        match solved {
            Ok(equilibrium) => {
                if self.record(0.0, state, &equilibrium).is_continue() {
                    self.standing.state.copy_motion_from(state);
                    self.standing.work = newton.work();
                }
                Ok(())
            }
            Err(failure) => {
                if !self.is_left {
                    // The best state that was reached is worth keeping.
                    let best = record(&self.assembly.system, 0.0, state);
                    self.trajectory.records.push(best);
                }
                Err(Box::new(PathFailure {
                    parameter: 0.0,
                    attempted: 0.0,
                    equilibrium: None,
                    work: failure.work,
                    trouble: actin_equilibrium::PathTrouble::NoEquilibrium(failure),
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
        let waypoint = self.standing.waypoint.clone();
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

    /// Records an equilibrium; breaks, with nothing recorded, where twist was lost on the way to it.
    fn record(&mut self, u: f64, state: &State, equilibrium: &Equilibrium) -> ControlFlow<()> {
        let before = self.trajectory.records.last().map(|record| &record.state);
        self.slip = self.links.slip(self.assembly, (state, u), before);
        if self.slip.is_some() {
            return ControlFlow::Break(());
        }
        self.trajectory
            .records
            .push(record(&self.assembly.system, u, state));
        self.standing.points += 1;
        self.standing.saddles_left += equilibrium.saddles_left;
        self.standing.last = Some(Arrival {
            certificate: equilibrium.certificate,
            floor: (equilibrium.ending == Ending::FloorReached)
                .then_some((equilibrium.floor.force, equilibrium.floor.torque)),
            history: equilibrium
                .history
                .iter()
                .map(|step| (step.residual.force, step.residual.torque))
                .collect(),
        });
        ControlFlow::Continue(())
    }

    /// Notes where the path can be taken up again: at `point`, or at the beginning of the next
    /// stage.
    fn note(&mut self, point: &PathPoint<'_>) {
        let is_end = point.parameter >= 1.0;
        let standing = &mut self.standing;
        standing.stage += usize::from(is_end);
        standing.waypoint = (!is_end).then(|| point.waypoint.clone());
        standing.state.copy_motion_from(point.state);
        standing.work = point.work;
    }

    fn keep(&mut self) {
        let standing = Standing::Path(Box::new(self.standing.clone()));
        let records = &self.trajectory.records;
        self.keeper.keep(&standing, records, self.clock.wall_s());
    }

    fn go_on(&mut self) -> ControlFlow<()> {
        self.is_left = self.keeper.is_interrupted();
        if self.is_left {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

impl Companion for Follower<'_> {
    fn arrive(&mut self, point: &PathPoint<'_>) -> ControlFlow<()> {
        let stage = self.standing.stage;
        let u = stage as f64 + point.parameter;
        // The start of a later stage is the end of the one before.
        if stage == 0 || point.parameter > 0.0 {
            self.record(u, point.state, point.equilibrium)?;
        }
        self.standing.jumps += usize::from(point.jumped);
        self.note(point);
        let flow = (self.watch)(Progress {
            time_ns: u,
            end_ns: self.assembly.drive.stages() as f64,
            steps: self.standing.points as u64,
            residual_force_pn: point.equilibrium.residual.force,
        });
        if self.keeper.is_due() {
            self.keep();
        }
        if flow.is_break() { flow } else { self.go_on() }
    }

    fn iterate(&mut self, _step: &Iteration) -> ControlFlow<()> {
        self.go_on()
    }
}

fn record(system: &System, u: f64, state: &State) -> Record {
    let mut loads = Loads::zeros(state);
    for interaction in system.interactions() {
        interaction.add_loads(state, &mut loads);
    }
    let (force, torque) = loads.residual(state);
    Record {
        time_ns: u,
        energies_pn_nm: system
            .interactions()
            .iter()
            .map(|i| i.energy(state))
            .collect(),
        kinetic_pn_nm: 0.0,
        residual_force_pn: force,
        residual_torque_pn_nm: torque,
        state: state.clone(),
    }
}

fn lowest_eigenvalue(newton: &mut Newton, system: &System) -> Option<f64> {
    let mode = newton.lowest_mode(system.state(), system.interactions());
    mode.ok().flatten().map(|mode| mode.eigenvalue)
}

fn report(
    standing: PathStanding,
    lowest_eigenvalue: Option<f64>,
    work: Work,
) -> Option<EquilibriumReport> {
    let last = standing.last?;
    last.certificate.map(|certificate| EquilibriumReport {
        certificate,
        lowest_eigenvalue,
        newton_iterations: work.iterations,
        points: standing.points,
        floor: last.floor,
        history: last.history,
    })
}
