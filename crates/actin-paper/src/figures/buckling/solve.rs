//! States of a case: equilibria along its path, damped motions, and what does not depend on the plane in
//! which the filament happens to buckle.

use super::case::Case;
use crate::figures::model::Model;
use crate::run::Solved;
use actin_mechanics::State;
use actin_sim::shape::Ribbon;
use actin_sim::{
    Assembly, DragRates, Dynamics, End, Equilibrium, ForceLaw, Integrator, Part, StableStates,
    StopTolerances, Task,
};
use actin_view::Pose;

/// Residual at which motions are stopped (pN, pN nm). The plane of buckling may still turn then: what is
/// compared does not depend on it.
pub(super) const STOP: f64 = 1e-3;

/// A state in numbers.
#[derive(Clone, Debug)]
pub(super) struct Outcome {
    pub case: Case,
    pub measured: Measured,
    /// Numbers of negative and of unresolved eigenvalues of the stiffness; `None` for a motion.
    pub doubtful: Option<[usize; 2]>,
    /// Newton steps of the whole path, and equilibria on it.
    pub search: Option<(u64, usize)>,
    /// Time of the path, or of a damped motion (ns).
    pub time_ns: f64,
    pub force_evaluations: u64,
    /// Stable states about it, where they were looked for.
    pub states: Option<Others>,
    /// Residual force (pN) and torque (pN nm).
    pub residual: [f64; 2],
    /// The state, without the pull that breaks the symmetry.
    pub pose: Pose,
}

/// Stable states that were found from random starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Others {
    /// Number of states, this one included.
    pub count: usize,
    /// From how many starts.
    pub starts: usize,
    /// Energy above the lowest state (pN nm).
    pub above_lowest_pn_nm: f64,
}

/// Observables of a state.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    /// Largest distance of the centre line from the axis (nm).
    pub height_nm: f64,
    /// Couple about the axis that turns the far end, positive along its turn (pN nm).
    pub couple_pn_nm: f64,
    /// Thrust that pushes the far end in (pN).
    pub force_pn: f64,
    /// Elastic energy without the energy of the pull (pN nm).
    pub energy_pn_nm: f64,
    /// Largest twist or curvature outside the data of a rod's law (rad/nm), if any.
    pub beyond_per_nm: Option<f64>,
    /// Turns by which the ends have been turned against each other: the change of the link.
    pub link_turns: f64,
    /// Twist in turns, and writhe of the smoothed centre line, the ends going on straight.
    pub twist_turns: f64,
    pub writhe: f64,
    /// The centre line (nm).
    pub centre_line: Vec<[f64; 3]>,
}

/// A damped motion along the path, and the equilibrium that Newton's method finds from its end.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    pub end: Outcome,
    pub nearest: Outcome,
}

impl Measured {
    /// Twist plus writhe minus link, which is zero by White's formula.
    pub(super) fn link_error(&self) -> f64 {
        (self.twist_turns + self.writhe - self.link_turns).abs()
    }
}

impl Outcome {
    /// Found by Newton's method, with a certificate.
    pub(super) fn is_solved(&self) -> bool {
        self.doubtful.is_some()
    }

    /// A minimum of the energy beyond doubt.
    pub(super) fn is_stable(&self) -> bool {
        self.doubtful == Some([0, 0])
    }
}

/// Finds the equilibrium of `case` along its path, or where loads without an energy come to rest.
pub(super) fn outcome(case: &Case) -> Result<Outcome, String> {
    let found = match case.model.balance {
        ForceLaw::EnergyGradient => case.scene().and_then(|scene| Solved::new(&scene)),
        ForceLaw::PaperBalance => rest(case),
    };
    found
        .map(|solved| measured(case, solved))
        .map_err(|e| in_words(case, &e))
}

/// Moves the filament along its path in time, then solves from where it came to rest.
pub(super) fn motion(case: &Case) -> Result<Motion, String> {
    moved(case).map_err(|e| in_words(case, &format!("dynamics: {e}")))
}

fn in_words(case: &Case, error: &str) -> String {
    format!("{}: {error}", case.name())
}

fn moved(case: &Case) -> Result<Motion, String> {
    let mut scene = case.scene()?;
    // About critical for the slowest mode of bending.
    scene.task = Task::Dynamics(damped(3000.0, [0.3, 0.3]));
    let moved = Solved::new(&scene)?;
    scene.path.clear();
    scene.task = Task::Equilibrium(Equilibrium::default());
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    *assembly.system.state_mut() = moved.state().clone();
    Ok(Motion {
        nearest: measured(case, Solved::run(assembly)?),
        end: measured(case, moved),
    })
}

/// Follows a case whose loads have no energy to rest, from the equilibrium of the law that has one; the ends
/// stay where the path has put them.
///
/// Such loads feed rotations: with 0.3 per ns in rotation as well, 10 of 32 filaments gain energy until they
/// break and 4 never come to rest. Bending hardly feels the drag on rotations, whose moments of inertia are
/// small.
fn rest(case: &Case) -> Result<Solved, String> {
    let with_energy = Model {
        balance: ForceLaw::EnergyGradient,
        ..case.model
    };
    let from = Case {
        model: with_energy,
        ..*case
    };
    let from = Solved::new(&from.scene()?)?;
    let mut scene = case.scene()?;
    scene.path.clear();
    scene.task = Task::Dynamics(damped(1000.0, [1.0, 30.0]));
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let mut start: State = from.state().clone();
    // A motion appends controls for its energy balance; the equilibrium has none of them.
    let booked = assembly.system.state().controls.values().len() - start.controls.values().len();
    for _ in 0..booked {
        start.add_control(0.0);
    }
    *assembly.system.state_mut() = start;
    Solved::run(assembly)
}

/// Damped motion of at most so many ns, with drag rates (1/ns) of translation and rotation.
fn damped(duration_ns: f64, [translational_per_ns, rotational_per_ns]: [f64; 2]) -> Dynamics {
    let drag = DragRates {
        translational_per_ns,
        rotational_per_ns,
    };
    Dynamics {
        duration_ns,
        integrator: Integrator::PositionVerlet,
        time_step_ns: None,
        step_safety: 0.9,
        allow_unstable_step: false,
        drag: drag.into(),
        thermal: None,
        stop: Some(StopTolerances {
            force_pn: STOP,
            torque_pn_nm: STOP,
            kinetic_pn_nm: 1e-6,
        }),
        leave_saddles: 0,
        record_every_ns: None,
    }
}

fn measured(case: &Case, mut solved: Solved) -> Outcome {
    let found = solved.report.equilibrium.as_ref();
    Outcome {
        case: *case,
        states: found.and_then(|f| f.states.as_ref()).map(Others::of),
        doubtful: solved.doubtful(),
        search: found.map(|f| (f.newton_iterations, f.points)),
        time_ns: solved.last().at.value(),
        force_evaluations: solved.report.force_evaluations,
        residual: solved.residual(),
        pose: solved.pose().without_linkers(),
        measured: Measured::of(case, &mut solved),
    }
}

impl Others {
    fn of(found: &StableStates) -> Self {
        let starts = found.states.iter().map(|state| state.starts);
        let lowest = found.states.first();
        Self {
            count: found.states.len(),
            starts: found.lost + starts.sum::<usize>(),
            above_lowest_pn_nm: lowest.map_or(0.0, |lowest| -lowest.above_result_pn_nm),
        }
    }
}

impl Measured {
    fn of(case: &Case, solved: &mut Solved) -> Self {
        let loads = solved.assembly.system.loads().clone();
        let (assembly, state) = (&solved.assembly, solved.state());
        let end = assembly.clamps.iter().find(|clamp| clamp.end == End::End);
        let reaction = end.map(|clamp| clamp.reaction(state, &loads));
        let (couple, force) =
            reaction.map_or((f64::NAN, f64::NAN), |r| (r.torque_pn_nm.z, r.force_pn.z));
        let ribbon = Ribbon::new(assembly, state);
        let beyond = assembly.beyond_range(state).into_iter();
        let beyond = beyond.filter(|b| !b.is_strain());
        let centre_line = solved.shape().line;
        let distances = centre_line.iter().map(|[x, y, _]| x.hypot(*y));
        Self {
            height_nm: distances.fold(0.0, f64::max),
            couple_pn_nm: couple * case.sign(),
            force_pn: -force,
            energy_pn_nm: solved.energy(|part| !matches!(part, Part::Load(_) | Part::Linker(_))),
            beyond_per_nm: beyond.map(|b| b.value.abs()).reduce(f64::max),
            link_turns: f64::from(2 * case.turn_deg) / 360.0,
            twist_turns: ribbon.twist(),
            // The writhe is `None` for curves a hundred times as long.
            writhe: ribbon.writhe().unwrap_or(f64::NAN),
            centre_line,
        }
    }
}
