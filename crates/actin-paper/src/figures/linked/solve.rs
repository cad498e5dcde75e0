//! Equilibria of a case from several starts, and its damped motion.

use super::case::Case;
use super::centre_line::CentreLine;
use crate::run::run_to_end;
use actin_sim::{Assembly, Equilibrium, Failure, Plan, Record, RunError, Scene, Task, Trajectory};
use actin_view::Pose;

/// Turns of the built filament about its axis from which equilibria are sought (deg).
const STARTS_DEG: [f64; 4] = [0.0, 90.0, 180.0, 270.0];
/// Equilibria whose energies differ by more (pN nm) are two: a residual of 1e-7 changes the energy
/// by far less.
pub(super) const SAME_PN_NM: f64 = 1e-3;

/// An equilibrium.
#[derive(Clone, Debug)]
pub(super) struct Balance {
    /// Energy of filament and linkers (pN nm).
    pub energy: f64,
    /// The linkers' part of it (pN nm).
    pub linkers: f64,
    /// Whether the stiffness is positive definite, and its lowest eigenvalue (pN/nm).
    pub stable: bool,
    pub lowest: Option<f64>,
    pub iterations: u64,
    /// Residual force (pN) and torque (pN nm).
    pub residual: (f64, f64),
    pub centre_line: CentreLine,
    /// Monomer centres and anchors (nm).
    pub monomers: Vec<[f64; 3]>,
    pub anchors: Vec<[f64; 3]>,
    /// Pull of each linker (pN).
    pub forces: Vec<f64>,
    /// Turn of the body that holds the second linker, from how it was built (deg).
    pub roll: f64,
    pub pose: Pose,
}

/// A damped motion that has come to rest.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// Time (ns), energy of filament and linkers with the kinetic one, and without (pN nm).
    pub energy: Vec<[f64; 3]>,
    pub converged: bool,
    pub time_ns: f64,
    pub force_evaluations: u64,
    /// Largest distance of its last centre line from that of its limit (nm).
    pub from_limit_nm: f64,
    /// The equilibrium that Newton's method reaches from where it ended.
    pub limit: Balance,
}

/// What came out of a case.
#[derive(Clone, Debug)]
pub(super) struct Outcome {
    pub case: Case,
    /// The equilibrium of lowest energy that was found.
    pub lowest: Balance,
    /// Energies of all that were found (pN nm), by the turn of the start.
    pub starts: Vec<f64>,
    pub motion: Option<Motion>,
}

impl Outcome {
    /// Solves the case; follows its motion too if `moving`.
    pub(super) fn of(case: &Case, moving: bool) -> Result<Self, String> {
        let scene = case.scene()?;
        let mut found = Vec::new();
        for turn in STARTS_DEG {
            found.push(balance(&scene, &Start::Turned(turn)).map_err(|e| place(case, &e))?);
        }
        let starts = found.iter().map(|b| b.energy).collect();
        let motion = moving
            .then(|| motion(&scene))
            .transpose()
            .map_err(|e| place(case, &e))?;
        found.extend(motion.as_ref().map(|m| m.limit.clone()));
        // Of equals the first, whose count of iterations is that from a built filament.
        let lower = |best: Balance, other: Balance| {
            if other.energy < best.energy - SAME_PN_NM {
                other
            } else {
                best
            }
        };
        let lowest = found.into_iter().reduce(lower).expect("there are starts");
        Ok(Self {
            case: *case,
            lowest,
            starts,
            motion,
        })
    }
}

fn place(case: &Case, error: &str) -> String {
    format!("{} {}: {error}", case.figure.id, case.name())
}

/// Where an equilibrium is sought from.
enum Start<'a> {
    /// The built filament, turned about its axis (deg).
    Turned(f64),
    /// Where a motion ended.
    State(&'a Record),
}

/// The equilibrium near a start.
fn balance(scene: &Scene, start: &Start<'_>) -> Result<Balance, String> {
    balance_with(scene, start, &Equilibrium::default())
}

fn balance_with(
    scene: &Scene,
    start: &Start<'_>,
    settings: &Equilibrium,
) -> Result<Balance, String> {
    let mut scene = scene.clone();
    scene.task = Task::Equilibrium(Equilibrium {
        lowest_eigenvalue: true,
        ..settings.clone()
    });
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    match start {
        Start::Turned(degrees) => assembly.roll(degrees.to_radians()),
        Start::State(record) => *assembly.system.state_mut() = record.state.clone(),
    }
    let mut trajectory = Trajectory::default();
    let plan = Plan::new(&assembly).map_err(|e| e.to_string())?;
    let ended = match plan.run_into(&mut trajectory) {
        Err(RunError::Failed(failed))
            if settings.leave_saddles == 0 && matches!(failed.failure, Failure::Saddle(_)) =>
        {
            failed.outcome
        }
        ended => ended.map_err(|error| format!("Newton: {error}"))?,
    };
    let last = trajectory.records.last().ok_or("no record")?;
    Ok(describe(&assembly, last, &ended))
}

fn describe(assembly: &Assembly, last: &Record, report: &actin_sim::Outcome) -> Balance {
    let energies = assembly.terms.iter().zip(&last.energies_pn_nm);
    let of_linkers = energies.filter(|(term, _)| term.name == "linker");
    let known = report.equilibrium.as_ref();
    let middle = assembly.linkers[1].site().frame();
    let turned = last.state.frames.orientation.get(middle)
        * assembly.rest.frames.orientation.get(middle).inverse();
    let monomers = (0..assembly.points.len()).filter(|&i| assembly.points[i].frame.is_some());
    Balance {
        energy: last.potential_pn_nm(),
        linkers: of_linkers.map(|(_, energy)| energy).sum(),
        stable: known.is_some_and(|e| e.certificate.negative + e.certificate.unresolved == 0),
        lowest: known.and_then(|e| e.lowest_eigenvalue),
        iterations: known.map_or(0, |e| e.newton_iterations),
        residual: (last.residual_force_pn, last.residual_torque_pn_nm),
        centre_line: CentreLine::of(assembly, &last.state),
        monomers: monomers
            .map(|i| last.state.points.position.get(i).into())
            .collect(),
        anchors: assembly
            .linkers
            .iter()
            .map(|l| l.end_position(&last.state).into())
            .collect(),
        forces: assembly
            .linkers
            .iter()
            .map(|l| l.force(&last.state).norm())
            .collect(),
        roll: turned.angle().to_degrees(),
        pose: Pose::of(assembly, &last.state),
    }
}

/// The damped motion of the scene from the built state, and the equilibrium it tends to.
fn motion(scene: &Scene) -> Result<Motion, String> {
    let mut assembly = Assembly::build(scene).map_err(|e| e.to_string())?;
    let (trajectory, report) =
        run_to_end(&mut assembly).map_err(|error| format!("dynamics: {error}"))?;
    let last = trajectory.records.last().ok_or("no record")?;
    let limit = balance(scene, &Start::State(last))?;
    let end = CentreLine::of(&assembly, &last.state);
    let energies = |record: &Record| {
        let potential = record.potential_pn_nm();
        [
            record.at.value(),
            potential + record.kinetic_pn_nm,
            potential,
        ]
    };
    Ok(Motion {
        energy: trajectory.records.iter().map(energies).collect(),
        converged: report.has_converged(),
        time_ns: last.at.value(),
        force_evaluations: report.force_evaluations,
        from_limit_nm: end.farthest_from(&limit.centre_line).0,
        limit,
    })
}

/// The state in which a pure rod with its sites exactly in the plane of its anchors comes to rest
/// if no saddle is left, and the steps to the stable one from there.
pub(super) fn in_plane(case: &Case) -> Result<(Balance, u64), String> {
    let mut scene = case.scene()?;
    for linker in &mut scene.linkers {
        linker.azimuth_deg = linker.azimuth_deg.round();
    }
    let keep = Equilibrium {
        leave_saddles: 0,
        ..Equilibrium::default()
    };
    let saddle = balance_with(&scene, &Start::Turned(0.0), &keep)?;
    let left = balance(&scene, &Start::Turned(0.0))?;
    Ok((saddle, left.iterations))
}
