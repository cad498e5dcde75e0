//! Equilibria: Newton from the built state, or along the path of the scene.

use super::{Progress, Record, RunError, RunReport, Trajectory};
use crate::Assembly;
use crate::scene::{Equilibrium as Settings, Load, Problem};
use actin_equilibrium::{
    BodyOrder, Certificate, Equilibrium, Jumps, Layout, Newton, NewtonOptions, Path, PathFailure,
    PathOptions, Residual, Saddles, Work,
};
use actin_mechanics::{Loads, State, System, Vector3};
use std::ops::ControlFlow;
use std::time::Instant;

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
    /// Residual force (pN) and torque (pN nm) before each Newton step of the last equilibrium.
    pub history: Vec<(f64, f64)>,
}

/// Solves for the equilibrium, or follows the path; the system ends in the last equilibrium.
pub(super) fn run(
    assembly: &mut Assembly,
    settings: &Settings,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Trajectory, RunReport), RunError> {
    let started = Instant::now();
    let mut newton = newton(assembly, settings)?;
    let mut state = assembly.system.state().clone();
    let mut follower = Follower {
        assembly,
        settings,
        watch,
        trajectory: Trajectory::default(),
        last: None,
        points: 0,
        stages_done: 0,
    };
    let failure = follower.follow(&mut newton, &mut state)?;
    let follower_stage = follower.stages_done;
    let (trajectory, last, points) = (follower.trajectory, follower.last, follower.points);
    *assembly.system.state_mut() = state;
    let wanted = settings.lowest_eigenvalue && last.is_some();
    let lowest = wanted.then(|| lowest_eigenvalue(&mut newton, &assembly.system));
    let work = newton.work();
    let report = RunReport {
        converged: failure.is_none(),
        failed: failure.is_some(),
        steps: 0,
        force_evaluations: work.evaluations,
        time_step_ns: None,
        largest_frequency_rad_per_ns: None,
        equilibrium: last.and_then(|last| report(&last, lowest.flatten(), work, points)),
        wall_s: started.elapsed().as_secs_f64(),
    };
    match failure {
        None => Ok(check_resolved(assembly, &trajectory).map(|()| (trajectory, report))?),
        Some(failure) => Err(RunError::Ended {
            place: place(assembly, follower_stage),
            failure,
            trajectory: Box::new(trajectory),
            report: Box::new(report),
        }),
    }
}

/// Refuses an equilibrium in which a load is lost: the forces that are left, be it by rounding of
/// places or by a loose tolerance, are no longer small beside it.
fn check_resolved(assembly: &Assembly, trajectory: &Trajectory) -> Result<(), Problem> {
    let Some(last) = trajectory.records.last() else {
        return Ok(());
    };
    for (i, load) in assembly.scene.loads.iter().enumerate() {
        let Load::EndForce { force_pn, .. } = load;
        // Controls of loads stand first, one for each.
        let size = Vector3::from(*force_pn).norm() * last.state.controls[i].abs();
        if size > 0.0 && last.residual_force_pn > RESOLVED * size {
            let rule = format!(
                "is lost among forces of {:.1e} pN that are left: places are known to round-off, \
                 and forces no better; a larger load tells more",
                last.residual_force_pn
            );
            let key = format!("loads[{i}].force_pn");
            return Err(Problem::new(key, format!("{force_pn:?}"), rule));
        }
    }
    Ok(())
}

/// Where a path stands after `points` equilibria, in words; nothing where there is no path.
fn place(assembly: &Assembly, stages_done: usize) -> String {
    match assembly.drive.stages() {
        0 => String::new(),
        stages => format!("in stage {} of {stages}, ", stages_done + 1),
    }
}

/// What may move, in the order of arc length, and how far it is to be solved.
pub(crate) fn newton(assembly: &Assembly, settings: &Settings) -> Result<Newton, Problem> {
    let order = BodyOrder {
        points: assembly.points.iter().map(|p| p.s_nm).collect(),
        frames: assembly.frames.iter().map(|f| f.s_nm).collect(),
    };
    let refused =
        |key: &str, error: &dyn std::error::Error| Problem::new(key, "", error.to_string());
    let layout = Layout::new(assembly.system.state(), Some(&order), Vec::new())
        .map_err(|error| refused("filament", &error))?;
    let options = NewtonOptions {
        tolerance: Residual {
            force: settings.force_pn,
            torque: settings.torque_pn_nm,
        },
        iterations: settings.iterations,
        ..NewtonOptions::default()
    };
    Newton::new(layout, options).map_err(|error| refused("task", &error))
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
    trajectory: Trajectory,
    last: Option<Equilibrium>,
    points: usize,
    stages_done: usize,
}

impl Follower<'_> {
    /// Follows all stages, or solves once where there is none. Returns why it ended early.
    fn follow(
        &mut self,
        newton: &mut Newton,
        state: &mut State,
    ) -> Result<Option<Box<PathFailure>>, Problem> {
        if self.assembly.drive.is_still() {
            return Ok(self.solve(newton, state).err());
        }
        let path = path(self.settings)?;
        for stage in 0..self.assembly.drive.stages() {
            if let Err(failure) = self.stage(&path, newton, state, stage) {
                return Ok(Some(failure));
            }
            self.stages_done += 1;
        }
        Ok(None)
    }

    fn solve(&mut self, newton: &mut Newton, state: &mut State) -> Result<(), Box<PathFailure>> {
        let interactions = self.assembly.system.interactions();
        let attempts = self.settings.leave_saddles;
        match newton.minimize(state, interactions, attempts) {
            Ok(equilibrium) => {
                self.arrive(0.0, state, equilibrium);
                Ok(())
            }
            Err(failure) => {
                // The best state that was reached is worth keeping.
                let best = record(&self.assembly.system, 0.0, state);
                self.trajectory.records.push(best);
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
        let mut arrivals = Vec::new();
        let end = path.follow(
            newton,
            state,
            assembly.system.interactions(),
            &mut set,
            &mut |point| {
                let u = stage as f64 + point.parameter;
                // The start of a later stage is the end of the one before.
                if stage == 0 || point.parameter > 0.0 {
                    arrivals.push((u, point.state.clone(), point.equilibrium.clone()));
                }
                (self.watch)(Progress {
                    time_ns: u,
                    end_ns: assembly.drive.stages() as f64,
                    steps: arrivals.len() as u64,
                    residual_force_pn: point.equilibrium.residual.force,
                })
            },
        );
        for (u, state, equilibrium) in arrivals {
            self.arrive(u, &state, equilibrium);
        }
        end.map(drop)
    }

    fn arrive(&mut self, u: f64, state: &State, equilibrium: Equilibrium) {
        self.trajectory
            .records
            .push(record(&self.assembly.system, u, state));
        self.last = Some(equilibrium);
        self.points += 1;
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
    last: &Equilibrium,
    lowest_eigenvalue: Option<f64>,
    work: Work,
    points: usize,
) -> Option<EquilibriumReport> {
    last.certificate.map(|certificate| EquilibriumReport {
        certificate,
        lowest_eigenvalue,
        newton_iterations: work.iterations,
        points,
        history: last
            .history
            .iter()
            .map(|step| (step.residual.force, step.residual.torque))
            .collect(),
    })
}
