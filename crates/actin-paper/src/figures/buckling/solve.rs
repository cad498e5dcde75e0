//! Equilibria, damped motions and observables of a case.

use super::case::Case;
use crate::run::{doubtful, energy, pose, residual, solved};
use actin_mechanics::State;
use actin_sim::shape::Ribbon;
use actin_sim::{
    Assembly, DragModel, Dynamics, End, Equilibrium, ForceLaw, Integrator, Part, Solution,
    StableStates, StopTolerances, Task,
};
use actin_view::Pose;

/// Residual at which motions stop (pN, pN nm). The plane of buckling may still rotate, but observables do not depend on
/// it.
pub(super) const STOP: f64 = 1e-3;

#[derive(Clone, Debug)]
pub(super) struct Outcome {
    pub case: Case,
    pub measured: BuckledState,
    /// Numbers of negative and of unresolved eigenvalues of the stiffness; `None` for a motion.
    pub doubtful: Option<[usize; 2]>,
    /// Newton steps and equilibria along the path.
    pub search: Option<(u64, usize)>,
    /// Time of the path, or of a damped motion (ns).
    pub time_ns: f64,
    pub force_evaluations: u64,
    /// Other stable states, if they were searched.
    pub states: Option<OtherStates>,
    /// Residual force (pN) and torque (pN nm).
    pub residual: [f64; 2],
    /// Pose without the symmetry-breaking force.
    pub pose: Pose,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct OtherStates {
    /// Number of states, including the outcome.
    pub count: usize,
    /// Number of random initial guesses.
    pub starts: usize,
    /// Energy relative to the lowest state (pN nm).
    pub above_lowest_pn_nm: f64,
}

#[derive(Clone, Debug)]
pub(super) struct BuckledState {
    /// Largest distance of the centre line from the axis (nm).
    pub height_nm: f64,
    /// Torque about the axis on the far end, positive along its turn (pN nm).
    pub couple_pn_nm: f64,
    /// Compressive force on the far end (pN).
    pub force_pn: f64,
    /// Elastic energy without the symmetry-breaking force (pN nm).
    pub energy_pn_nm: f64,
    /// Largest twist or curvature outside the range of the rod law (rad/nm), if any.
    pub beyond_per_nm: Option<f64>,
    /// Change of link: relative rotation of the ends (turns).
    pub link_turns: f64,
    /// Twist (turns), and writhe of the smoothed centre line with straight extensions of both ends.
    pub twist_turns: f64,
    pub writhe: f64,
    /// Centre line (nm).
    pub centre_line: Vec<[f64; 3]>,
}

/// End of a damped motion along the path, and the equilibrium of Newton's method from there.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    pub end: Outcome,
    pub nearest: Outcome,
}

impl BuckledState {
    /// Absolute value of twist plus writhe minus link, zero by White's formula.
    pub(super) fn link_error(&self) -> f64 {
        (self.twist_turns + self.writhe - self.link_turns).abs()
    }
}

impl Outcome {
    pub(super) fn is_solved(&self) -> bool {
        self.doubtful.is_some()
    }

    pub(super) fn is_stable(&self) -> bool {
        self.doubtful == Some([0, 0])
    }
}

pub(super) fn outcome(case: &Case) -> Result<Outcome, String> {
    let found = if case.model.has_potential() {
        case.scene().and_then(|scene| solved(&scene))
    } else {
        rest(case)
    };
    found
        .map(|solved| measured(case, solved))
        .map_err(|e| in_words(case, &e))
}

pub(super) fn motion(case: &Case) -> Result<Motion, String> {
    moved(case).map_err(|e| in_words(case, &format!("dynamics: {e}")))
}

fn in_words(case: &Case, error: &str) -> String {
    format!("{}: {error}", case.name())
}

fn moved(case: &Case) -> Result<Motion, String> {
    let mut scene = case.scene()?;
    // Approximately critical damping of the slowest bending mode.
    scene.task = Task::Dynamics(damped(3000.0, [0.3, 0.3]));
    let moved = solved(&scene)?;
    scene.path.clear();
    scene.task = Task::Equilibrium(Equilibrium::default());
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    *assembly.system.state_mut() = moved.state().clone();
    Ok(Motion {
        nearest: measured(case, Solution::new(assembly).map_err(|e| e.to_string())?),
        end: measured(case, moved),
    })
}

/// Damped motion of a case with non-conservative loads, from the equilibrium of the conservative rod with fixed ends.
///
/// Such loads feed energy into rotations. With a rotational drag rate of 0.3 per ns, 10 of 32 filaments diverge and 4
/// do not come to rest. Rotational drag has little effect on bending, because moments of inertia are small.
fn rest(case: &Case) -> Result<Solution, String> {
    let mut scene = case.scene()?;
    scene.filament.rod.force_law = ForceLaw::EnergyGradient;
    let from = solved(&scene)?;
    let mut scene = case.scene()?;
    scene.path.clear();
    scene.task = Task::Dynamics(damped(1000.0, [1.0, 30.0]));
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let mut start: State = from.state().clone();
    // Dynamics appends controls for the energy balance, which are absent in the equilibrium.
    let booked = assembly.system.state().controls.values().len() - start.controls.values().len();
    for _ in 0..booked {
        start.add_control(0.0);
    }
    *assembly.system.state_mut() = start;
    Solution::new(assembly).map_err(|e| e.to_string())
}

/// Damped dynamics of at most `duration_ns`, with translational and rotational drag rates (1/ns).
fn damped(duration_ns: f64, rates_per_ns: [f64; 2]) -> Dynamics {
    Dynamics {
        integrator: Integrator::PositionVerlet,
        step_safety: 0.9,
        drag: DragModel::rates_per_ns(rates_per_ns),
        thermal: None,
        stop: Some(StopTolerances {
            force_pn: STOP,
            torque_pn_nm: STOP,
            kinetic_pn_nm: 1e-6,
        }),
        ..Dynamics::new(duration_ns)
    }
}

fn measured(case: &Case, mut solved: Solution) -> Outcome {
    let found = solved.outcome.equilibrium.as_ref();
    Outcome {
        case: *case,
        states: found.and_then(|f| f.states.as_ref()).map(OtherStates::new),
        doubtful: doubtful(&solved),
        search: found.map(|f| (f.newton_iterations, f.points)),
        time_ns: solved.last().at.value(),
        force_evaluations: solved.outcome.force_evaluations,
        residual: residual(&solved),
        pose: pose(&solved).without_linkers(),
        measured: BuckledState::new(case, &mut solved),
    }
}

impl OtherStates {
    fn new(found: &StableStates) -> Self {
        let starts = found.states.iter().map(|state| state.starts);
        let lowest = found.states.first();
        Self {
            count: found.states.len(),
            starts: found.lost + starts.sum::<usize>(),
            above_lowest_pn_nm: lowest.map_or(0.0, |lowest| -lowest.above_result_pn_nm),
        }
    }
}

impl BuckledState {
    fn new(case: &Case, solved: &mut Solution) -> Self {
        let loads = solved.assembly.system.loads().clone();
        let (assembly, state) = (&solved.assembly, solved.state());
        let end = assembly.clamps.iter().find(|clamp| clamp.end == End::End);
        let reaction = end.map(|clamp| clamp.reaction(state, &loads));
        let (couple, force) =
            reaction.map_or((f64::NAN, f64::NAN), |r| (r.torque_pn_nm.z, r.force_pn.z));
        let ribbon = Ribbon::new(assembly, state);
        let beyond = assembly.beyond_range(state).into_iter();
        let beyond = beyond.filter(|b| !b.is_strain());
        let centre_line: Vec<[f64; 3]> = solved
            .centre_line_nm(0)
            .into_iter()
            .map(Into::into)
            .collect();
        let distances = centre_line.iter().map(|[x, y, _]| x.hypot(*y));
        Self {
            height_nm: distances.fold(0.0, f64::max),
            couple_pn_nm: couple * case.sign(),
            force_pn: -force,
            energy_pn_nm: energy(&solved.assembly, solved.last(), |part| {
                !matches!(part, Part::Load(_) | Part::Linker(_))
            }),
            beyond_per_nm: beyond.map(|b| b.value.abs()).reduce(f64::max),
            link_turns: f64::from(2 * case.turn_deg) / 360.0,
            twist_turns: ribbon.twist(),
            // `None` occurs only for curves with a hundred times as many vertices.
            writhe: ribbon.writhe().unwrap_or(f64::NAN),
            centre_line,
        }
    }
}
