//! Equilibria from several starts, and damped motion of a case.

use super::Case;
use crate::centre_line::CentreLine;
use crate::run::{Shape, doubtful, energy, residual, rolled, solved};
use actin_sim::{Assembly, Equilibrium, Part, Scene, Solution, Task};

/// Tolerance of the energies of equal equilibria (pN nm). The effect of a residual of 1e-7 is much smaller.
pub(super) const SAME_PN_NM: f64 = 1e-3;

#[derive(Clone, Debug)]
pub(super) struct Balance {
    /// Energy of filament and linkers (pN nm).
    pub energy: f64,
    /// Energy of the linkers (pN nm).
    pub linkers: f64,
    /// Positive definite stiffness; `lowest` is its lowest eigenvalue (pN/nm).
    pub is_stable: bool,
    pub lowest: Option<f64>,
    pub iterations: u64,
    pub residual: [f64; 2],
    pub centre_line: CentreLine,
    pub shape: Shape,
    /// Anchors (nm).
    pub anchors: Vec<[f64; 3]>,
    /// Force of each linker (pN).
    pub forces: Vec<f64>,
    /// Rotation of the body with the second linker relative to the built state (deg).
    pub roll: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// Time (ns), and energy of filament and linkers (pN nm) with and without kinetic energy.
    pub energy: Vec<[f64; 3]>,
    pub has_converged: bool,
    pub time_ns: f64,
    pub force_evaluations: u64,
    /// Largest distance between the last centre line and the limit (nm).
    pub from_limit_nm: f64,
    /// Equilibrium of Newton's method from the end of the motion.
    pub limit: Balance,
}

#[derive(Clone, Debug)]
pub(super) struct Outcome {
    pub case: Case,
    /// Equilibrium of lowest energy.
    pub lowest: Balance,
    /// Energies from all initial guesses (pN nm).
    pub starts: Vec<f64>,
    pub motion: Option<Motion>,
}

impl Outcome {
    pub(super) fn new(case: &Case, moving: bool) -> Result<Self, String> {
        let scene = case.scene()?;
        let rolled = rolled(&statics(&scene));
        let rolled = rolled.map_err(|error| format!("Newton: {error}"))?;
        let mut found: Vec<Balance> = rolled.iter().map(describe).collect();
        let starts = found.iter().map(|b| b.energy).collect();
        let motion = moving.then(|| motion(&scene)).transpose()?;
        found.extend(motion.as_ref().map(|m| m.limit.clone()));
        // The first of equal equilibria is used, so that iterations are counted from the built filament.
        let lower = |best: Balance, other: Balance| {
            if other.energy < best.energy - SAME_PN_NM {
                other
            } else {
                best
            }
        };
        let lowest = found
            .into_iter()
            .reduce(lower)
            .expect("there are several starts");
        Ok(Self {
            case: *case,
            lowest,
            starts,
            motion,
        })
    }
}

fn statics(scene: &Scene) -> Scene {
    let task = Task::Equilibrium(Equilibrium {
        lowest_eigenvalue: true,
        ..Equilibrium::default()
    });
    Scene {
        task,
        ..scene.clone()
    }
}

fn describe(solved: &Solution) -> Balance {
    let (assembly, state) = (&solved.assembly, solved.state());
    let known = solved.outcome.equilibrium.as_ref();
    let middle = assembly.linkers[1].site().frame();
    let turned = state.frames.orientation.get(middle)
        * assembly.rest.frames.orientation.get(middle).inverse();
    let linkers = || assembly.linkers.iter();
    Balance {
        energy: solved.last().potential_pn_nm(),
        linkers: energy(&solved.assembly, solved.last(), |part| {
            matches!(part, Part::Linker(_))
        }),
        is_stable: doubtful(solved) == Some([0, 0]),
        lowest: known.and_then(|e| e.lowest_eigenvalue),
        iterations: known.map_or(0, |e| e.newton_iterations),
        residual: residual(solved),
        centre_line: CentreLine::new(assembly, state),
        shape: Shape::new(solved),
        anchors: linkers().map(|l| l.end_position(state).into()).collect(),
        forces: linkers().map(|l| l.force(state).norm()).collect(),
        roll: turned.angle().to_degrees(),
    }
}

fn motion(scene: &Scene) -> Result<Motion, String> {
    let moved = solved(scene).map_err(|error| format!("dynamics: {error}"))?;
    let mut assembly = Assembly::build(&statics(scene)).map_err(|e| e.to_string())?;
    *assembly.system.state_mut() = moved.state().clone();
    let limit = Solution::new(assembly).map_err(|error| format!("Newton: {error}"))?;
    let limit = describe(&limit);
    let end = CentreLine::new(&moved.assembly, moved.state());
    let energies = moved.records().iter().map(|record| {
        let potential = record.potential_pn_nm();
        let total = potential + record.kinetic_pn_nm;
        [record.at.value(), total, potential]
    });
    Ok(Motion {
        energy: energies.collect(),
        has_converged: moved.outcome.has_converged(),
        time_ns: moved.last().at.value(),
        force_evaluations: moved.outcome.force_evaluations,
        from_limit_nm: end.farthest_from(&limit.centre_line).0,
        limit,
    })
}
