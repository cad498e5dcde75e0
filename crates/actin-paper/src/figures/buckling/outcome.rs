//! What comes out of a case: the equilibrium, its certificate, and what does not depend on the
//! plane in which the filament happens to buckle.

use super::case::Case;
use crate::run::run_to_end;
use actin_sim::shape::Ribbon;
use actin_sim::{Assembly, End, Part, StableStates};
use actin_view::Pose;

/// A point in the lab frame (nm).
pub(super) type Place = [f64; 3];

/// An equilibrium in numbers.
#[derive(Clone, Debug)]
pub(super) struct Outcome {
    pub case: Case,
    pub measured: Measured,
    pub evidence: Evidence,
    /// Stable states about it, where they were looked for.
    pub states: Option<Others>,
    /// Residual force (pN) and torque (pN nm).
    pub residual: (f64, f64),
    /// The state, without the pull that breaks the symmetry.
    pub pose: Pose,
}

/// Stable states that were found from random starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Others {
    /// How many there are, this one included.
    pub count: usize,
    /// From how many starts.
    pub starts: usize,
    /// Energy of this one less that of the lowest (pN nm).
    pub above_lowest_pn_nm: f64,
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

/// How a state was found.
#[derive(Clone, Copy, Debug)]
pub(super) enum Evidence {
    /// By Newton's method along the path, and certified.
    Certificate {
        /// Eigenvalues of the stiffness below zero, and those that cannot be told from it.
        negative: usize,
        unresolved: usize,
        /// Newton steps of the whole path, and equilibria on it.
        iterations: u64,
        points: usize,
    },
    /// By damped motion to rest: its loads have no energy.
    Motion {
        time_ns: f64,
        force_evaluations: u64,
    },
}

/// What is seen of a state.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    /// Largest distance of the centre line from the axis (nm).
    pub height_nm: f64,
    /// Couple about the axis that turns the far end, positive along its turn (pN nm).
    pub couple_pn_nm: f64,
    /// Thrust that pushes the far end in (pN).
    pub force_pn: f64,
    /// Elastic energy, without that of the pull (pN nm).
    pub energy_pn_nm: f64,
    /// Largest twist or curvature beyond the data behind a rod's law (rad/nm), if any.
    pub beyond_per_nm: Option<f64>,
    /// Turns by which the ends have been turned against each other: the change of the link.
    pub link_turns: f64,
    /// Twist in turns, and writhe of the smoothed centre line, the ends going on straight.
    pub twist_turns: f64,
    pub writhe: f64,
    /// The centre line.
    pub centre_line: Vec<Place>,
}

impl Measured {
    /// Twist and writhe minus link: what White's formula says is zero.
    pub(super) fn link_error(&self) -> f64 {
        self.twist_turns + self.writhe - self.link_turns
    }
}

impl Outcome {
    /// Found by Newton's method, with a certificate.
    pub(super) fn is_solved(&self) -> bool {
        matches!(self.evidence, Evidence::Certificate { .. })
    }

    /// A minimum of the energy beyond doubt.
    pub(super) fn is_stable(&self) -> bool {
        matches!(
            self.evidence,
            Evidence::Certificate {
                negative: 0,
                unresolved: 0,
                ..
            }
        )
    }
}

/// Runs an assembled equilibrium of `case`.
pub(super) fn outcome(case: &Case, assembly: &mut Assembly) -> Result<Outcome, String> {
    let fail = |error: &dyn std::fmt::Display| format!("{}: {error}", case.name());
    let (trajectory, report) = run_to_end(assembly).map_err(|e| fail(&e))?;
    let last = trajectory
        .records
        .last()
        .ok_or_else(|| fail(&"no record"))?;
    let found = report
        .equilibrium
        .ok_or_else(|| fail(&"no certificate of the equilibrium"))?;
    Ok(Outcome {
        case: *case,
        measured: measure(case, assembly),
        evidence: Evidence::Certificate {
            negative: found.certificate.negative,
            unresolved: found.certificate.unresolved,
            iterations: found.newton_iterations,
            points: found.points,
        },
        states: found.states.as_ref().map(Others::of),
        residual: (last.residual_force_pn, last.residual_torque_pn_nm),
        pose: Pose::of(assembly, &last.state).without_linkers(),
    })
}

/// Measures the state that the assembly is in.
pub(super) fn measure(case: &Case, assembly: &mut Assembly) -> Measured {
    let loads = assembly.system.loads().clone();
    let state = assembly.system.state();
    let end = assembly.clamps.iter().find(|clamp| clamp.end == End::End);
    let reaction = end.map(|clamp| clamp.reaction(state, &loads));
    let (couple, force) =
        reaction.map_or((f64::NAN, f64::NAN), |r| (r.torque_pn_nm.z, r.force_pn.z));
    let points = 0..assembly.points.len();
    let line = points.map(|i| assembly.centre_line_nm(state, i));
    let centre_line: Vec<Place> = line.map(Into::into).collect();
    let ribbon = Ribbon::new(assembly, state);
    let beyond = assembly.beyond_range(state).into_iter();
    let beyond = beyond.filter(|b| !b.is_strain());
    Measured {
        height_nm: height(&centre_line),
        couple_pn_nm: couple * case.sign(),
        force_pn: -force,
        energy_pn_nm: elastic(assembly),
        beyond_per_nm: beyond.map(|b| b.value.abs()).reduce(f64::max),
        link_turns: f64::from(2 * case.turn_deg) / 360.0,
        twist_turns: ribbon.twist(),
        // None is given of curves a hundred times as long.
        writhe: ribbon.writhe().unwrap_or(f64::NAN),
        centre_line,
    }
}

/// Largest distance from the axis, lab z (nm).
fn height(line: &[Place]) -> f64 {
    line.iter().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max)
}

/// Energy of all but linkers and loads (pN nm).
fn elastic(assembly: &Assembly) -> f64 {
    let energies = assembly.system.energies();
    let terms = assembly.terms.iter().zip(energies);
    terms
        .filter(|(term, _)| !matches!(term.part, Part::Load(_) | Part::Linker(_)))
        .map(|(_, energy)| energy)
        .sum()
}
