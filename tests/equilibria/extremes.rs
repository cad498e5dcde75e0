//! Extreme loads: each scene ends in a certified equilibrium or a failure report, in a bounded
//! number of steps. The table of `docs/measured/statics.md` is printed by `cargo test -p actin-sim
//! --test integration equilibria::extremes -- --nocapture`.

use super::common::{build, run_anyway};
use actin_equilibrium::{PathFailure, Stability};
use actin_mechanics::Vector3;
use actin_sim::{Assembly, Failure, Load, Outcome, Record, RunError, Trajectory};
use std::time::Instant;

/// Largest force and torque on a free body at an equilibrium (pN, pN nm).
const RESIDUAL: f64 = 1e-6;

struct Extreme {
    name: String,
    sections: &'static str,
    clamps: &'static str,
    loads: String,
    path: String,
    task: &'static str,
}

const ONE_WALL: &str = "Clamp(end: Start)";
const BOTH_WALLS: &str = "Clamp(end: Start), Clamp(end: End)";
const SLIDING: &str = "Clamp(end: Start), Clamp(end: End, slides: AlongAxis)";

impl Extreme {
    fn pulled(name: &str, sections: &'static str, [x, y, z]: [f64; 3]) -> Self {
        Self {
            name: name.to_owned(),
            sections,
            clamps: ONE_WALL,
            loads: format!("EndForce(end: End, force_pn: ({x:?}, {y:?}, {z:?}))"),
            path: String::new(),
            task: "",
        }
    }

    fn driven(name: &str, sections: &'static str, clamps: &'static str, set: &str) -> Self {
        Self {
            name: name.to_owned(),
            sections,
            clamps,
            loads: String::new(),
            path: format!("Stage(set: [{set}])"),
            task: "",
        }
    }

    fn across_jumps(self) -> Self {
        Self {
            task: "accept_jumps: true",
            ..self
        }
    }

    fn assembly(&self) -> Assembly {
        build(&format!(
            "Scene(
                filament: Filament(
                    sections: [{}],
                    rod: RodModel(law: Constant),
                    monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                ),
                clamps: [{}],
                loads: [{}],
                path: [{}],
                task: Equilibrium(force_pn: {RESIDUAL:?}, torque_pn_nm: {RESIDUAL:?}, {}),
            )",
            self.sections, self.clamps, self.loads, self.path, self.task
        ))
    }

    fn check(&self) -> bool {
        let mut assembly = self.assembly();
        let clock = Instant::now();
        let result = run_anyway(&mut assembly);
        let seconds = clock.elapsed().as_secs_f64();
        let (trajectory, report, failure) = self.take(result);
        let ended = match (&failure, &report.equilibrium) {
            (Some(failure), _) => failure.to_string(),
            (None, found) => format!("{:?}", found.as_ref().unwrap().certificate.stability()),
        };
        // A path that ended at a large jump continues and counts it. Other paths are smooth.
        let crosses = self.task.contains("accept_jumps");
        let jumps = crosses || SNAPS.contains(&self.name.as_str());
        assert_eq!(report.jumps > 0, jumps, "{}", self.name);
        let steps = failure.as_ref().map(|f| f.work.iterations);
        let found = report.equilibrium.as_ref();
        let steps = steps.max(found.map(|f| f.newton_iterations)).unwrap();
        println!("| {} | {ended} | {steps} | {seconds:.2} s |", self.name);
        assert!(steps < 10_000, "{}: {steps} iterations", self.name);
        let Some(found) = found else {
            let failure = failure.unwrap();
            assert!(failure.equilibrium.is_none() && trajectory.records.is_empty());
            return false;
        };
        let is_saddle = matches!(found.certificate.stability(), Stability::Saddle { .. });
        assert!(!is_saddle, "{}: {:?}", self.name, found.certificate);
        self.check_balance(&mut assembly, trajectory.records.last().unwrap());
        if let Some(failure) = &failure {
            self.check_report(failure);
        }
        failure.is_none()
    }

    fn take(
        &self,
        result: (Trajectory, Result<Outcome, RunError>),
    ) -> (Trajectory, Outcome, Option<Box<PathFailure>>) {
        let (trajectory, outcome) = result;
        let failed = match outcome {
            Ok(outcome) => return (trajectory, outcome, None),
            Err(RunError::Failed(failed)) => *failed,
            Err(other) => panic!("{}: {other}", self.name),
        };
        let failure = match failed.failure {
            Failure::PathEnded { failure, .. } => Some(failure),
            Failure::ModelLimitExceeded(worst) => {
                println!("{}: outside the model: {}", self.name, worst[0]);
                None
            }
            other => panic!("{}: {other}", self.name),
        };
        (trajectory, failed.outcome, failure)
    }

    fn check_balance(&self, assembly: &mut Assembly, last: &Record) {
        let residual = last.residual_force_pn.max(last.residual_torque_pn_nm);
        assert!(residual <= RESIDUAL, "{}: {residual:e}", self.name);
        let loads = assembly.system.loads().clone();
        let state = assembly.system.state();
        let applied = assembly.scene.loads.iter().map(|load| match *load {
            Load::EndForce { force_pn, .. } => Vector3::from(force_pn),
            _ => panic!("only ends are loaded"),
        });
        let reactions = assembly
            .clamps
            .iter()
            .map(|clamp| clamp.reaction(state, &loads).force_pn);
        let sum: Vector3 = applied.chain(reactions).sum();
        // Each free point may add its residual.
        let bound = RESIDUAL * state.points.len() as f64;
        assert!(sum.norm() <= bound, "{}: {sum}", self.name);
    }

    fn check_report(&self, failure: &PathFailure) {
        let name = &self.name;
        assert!(
            !self.path.is_empty(),
            "{name}: a load has an equilibrium: {failure}"
        );
        assert!(
            failure.parameter > 0.0 && failure.parameter < failure.attempted,
            "{name}"
        );
        assert!(failure.equilibrium.is_some(), "{name}");
    }
}

const MONOMERS_20: &str = "Ellipsoids(from_nm: 0.0, to_nm: 20.0)";
const MONOMERS_75: &str = "Ellipsoids(from_nm: 0.0, to_nm: 75.0)";
const MONOMERS_1600: &str = "Ellipsoids(from_nm: 0.0, to_nm: 1600.0)";
const ROD_20: &str = "Rod(from_nm: 0.0, to_nm: 20.0)";
const ROD_75: &str = "Rod(from_nm: 0.0, to_nm: 75.0)";
const ROD_16000: &str = "Rod(from_nm: 0.0, to_nm: 16000.0)";
const ONE_SEGMENT: &str = "Rod(from_nm: 0.0, to_nm: 10.0, segments: 1)";
const TWO_MONOMERS: &str = "Rod(from_nm: 0.0, to_nm: 40.0),
    Ellipsoids(from_nm: 40.0, to_nm: 45.5), Rod(from_nm: 45.5, to_nm: 85.5)";

#[rustfmt::skip]
const PULLED: [(&str, &str, [f64; 3]); 11] = [
    ("1 pN across 16 um of rod", ROD_16000, [1.0, 0.0, 0.0]),
    ("1 pN against 16 um of rod", ROD_16000, [0.0, 0.0, -1.0]),
    ("1 pN across 1.6 um of monomers", MONOMERS_1600, [1.0, 0.0, 0.0]),
    ("1000 pN across 20 nm of monomers", MONOMERS_20, [1e3, 0.0, 0.0]),
    ("1000 pN along 20 nm of monomers", MONOMERS_20, [0.0, 0.0, 1e3]),
    ("1000 pN against 20 nm of monomers", MONOMERS_20, [0.0, 0.0, -1e3]),
    ("1000 pN across 20 nm of rod", ROD_20, [1e3, 0.0, 0.0]),
    ("1000 pN against 20 nm of rod", ROD_20, [0.0, 0.0, -1e3]),
    ("10 pN across one segment of 10 nm", ONE_SEGMENT, [10.0, 0.0, 0.0]),
    ("2 pN across two monomers between rods", TWO_MONOMERS, [2.0, 0.0, 0.0]),
    ("1000 pN across two monomers between rods", TWO_MONOMERS, [1e3, 0.0, 0.0]),
];

const TURNED: [(&str, &str, f64); 6] = [
    ("75 nm of monomers by +720 deg", MONOMERS_75, 720.0),
    ("75 nm of monomers by -720 deg", MONOMERS_75, -720.0),
    ("75 nm of rod by 720 deg", ROD_75, 720.0),
    ("one segment by 170 deg", ONE_SEGMENT, 170.0),
    ("one segment by 350 deg", ONE_SEGMENT, 350.0),
    ("two monomers between rods by 360 deg", TWO_MONOMERS, 360.0),
];

/// Paths with small snaps that do not end them.
const SNAPS: [&str; 2] = [TURNED[0].0, TURNED[1].0];

const SHIFTED: [(&str, &str, f64); 4] = [
    ("75 nm of monomers pushed by 20 %", MONOMERS_75, -15.0),
    ("75 nm of monomers pushed to 20 %", MONOMERS_75, -60.0),
    ("75 nm of rod pushed by 20 %", ROD_75, -15.0),
    ("75 nm of rod pushed to 20 %", ROD_75, -60.0),
];

fn turned(name: &str, sections: &'static str, degrees: f64) -> Extreme {
    let set = format!("Turn(end: End, turn_deg: (0.0, 0.0, {degrees:?}))");
    Extreme::driven(name, sections, SLIDING, &set)
}

fn shifted(name: &str, sections: &'static str, shift: f64) -> Extreme {
    let set = format!("Shift(end: End, shift_nm: (0.0, 0.0, {shift:?}))");
    Extreme::driven(name, sections, BOTH_WALLS, &set)
}

#[test]
fn extremes_of_force_are_certified() {
    for (name, sections, force) in PULLED {
        assert!(Extreme::pulled(name, sections, force).check(), "{name}");
    }
}

/// Monomers snap before 720 deg: the path ends there, or continues with `accept_jumps`.
#[test]
fn extremes_of_turn_are_certified_or_reported() {
    for (name, sections, degrees) in TURNED {
        if !turned(name, sections, degrees).check() {
            let name = format!("{name}, across jumps");
            turned(&name, sections, degrees).across_jumps().check();
        }
    }
}

#[test]
fn extremes_of_shift_are_certified_or_reported() {
    for (name, sections, shift) in SHIFTED {
        if !shifted(name, sections, shift).check() {
            let name = format!("{name}, across jumps");
            shifted(&name, sections, shift).across_jumps().check();
        }
    }
}

#[test]
fn extremes_of_length() {
    let sections = "Ellipsoids(from_nm: 0.0, to_nm: 16000.0)";
    let name = "1 pN across 16 um of monomers";
    let extreme = Extreme {
        task: "iterations: 3000",
        ..Extreme::pulled(name, sections, [1.0, 0.0, 0.0])
    };
    assert!(extreme.check());
}
