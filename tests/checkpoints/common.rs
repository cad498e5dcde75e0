//! Small scenes of every kind, and a sink that interrupts a run.

use actin_rundir::{CheckpointError, Checkpoints, RunDirectory};
use actin_sim::{
    Assembly, Outcome, Plan, Record, RecordSummary, RunPosition, Scene, Sink, Trajectory,
};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Choice {
    pub(crate) filament: usize,
    pub(crate) held: usize,
    pub(crate) integrator: usize,
    pub(crate) drag: f64,
    pub(crate) stops: bool,
    /// Seed of thermal noise, which requires drag and excludes a stop rule.
    pub(crate) noise: Option<u64>,
    pub(crate) record_every_ns: f64,
    pub(crate) duration_ns: f64,
}

const FILAMENTS: [&str; 5] = [
    "filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)])",
    "filament: Filament(
         sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0), Rod(from_nm: 12.0, to_nm: 42.0)],
         monomers: Monomers(anchors: Independent, lateral_bonds: 6, longitudinal_bonds: 6))",
    "filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)], rod: RodModel(law: Fitted))",
    "filaments: [
         Filament(
             sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0), Rod(from_nm: 12.0, to_nm: 42.0)],
             monomers: Monomers(anchors: Independent, lateral_bonds: 6, longitudinal_bonds: 6)),
         Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)], at_nm: (12.0, 0.0, 0.0),
                  roll_deg: 40.0)]",
    "filament: Filament(
         sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0), Rod(from_nm: 12.0, to_nm: 42.0)],
         monomers: Monomers(anchors: Independent, lateral_bonds: 6, longitudinal_bonds: 6),
         rod: RodModel(law: Homogenised))",
];

const PAIR: usize = 3;

const SECOND: [&str; 2] = [
    "Clamp(filament: 1, end: Start)",
    "Linker(at_nm: 30.0, radius_nm: 1.8,
            to: Site(filament: 1, at_nm: 25.0, radius_nm: 1.8, azimuth_deg: 140.0),
            stiffness_pn_per_nm: 50.0, rest_length_nm: 8.4)",
];

/// Index in [`HELD`] for motions only.
pub(crate) const IN_TIME: usize = 4;

const HELD: [[&str; 3]; 5] = [
    [
        "Clamp(end: Start),",
        "",
        "loads: [EndForce(end: End, force_pn: (-12.0, 3.0, 0.0))]",
    ],
    [
        "Clamp(end: Start),",
        "",
        "loads: [EndForce(end: End, force_pn: (-20.0, 0.0, 3.0))],
     path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)], duration_ns: 0.1),
            Stage(set: [LoadFactor(load: 0, factor: 0.5)], duration_ns: 0.15)]",
    ],
    [
        "Clamp(end: Start), Clamp(end: End, slides: AlongAxis),",
        "",
        "path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 40.0))], duration_ns: 0.2),
            Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 30.0))], duration_ns: 0.05)]",
    ],
    [
        "Clamp(end: Start),",
        "Linker(at_nm: 35.0, radius_nm: 1.8, displaced_nm: (3.0, 0.0, 0.0),
                stiffness_pn_per_nm: 10.0),",
        "path: [Stage(set: [Anchor(linker: 0, shift_nm: (0.0, 2.0, 1.0))], duration_ns: 0.1)]",
    ],
    [
        "Clamp(end: Start),",
        "",
        "loads: [
            Force(end: End, force_pn: (-12.0, 3.0, 0.0), follows: true, factor: Sine(period_ns: 0.07)),
            Couple(at_nm: 23.0, couple_pn_nm: (0.0, 9.0, 20.0), factor: Ramp(duration_ns: 0.1)),
            ForcePerLength(from_nm: 5.0, force_pn_per_nm: (0.0, 0.1, 0.0),
                factor: Table(time_ns: [0.0, 0.05, 0.15], factor: [0.0, 1.0, 0.3])),
         ],
         path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)], duration_ns: 0.1)]",
    ],
];

const INTEGRATORS: [&str; 5] = ["PositionVerlet", "Pefrl", "Vefrl", "ForestRuth", "Suzuki"];

impl Choice {
    fn scene(&self, task: &str) -> Scene {
        let filament = FILAMENTS[self.filament];
        let [clamps, linkers, rest] = HELD[self.held];
        let [clamp, linker] = if self.filament == PAIR {
            SECOND
        } else {
            [""; 2]
        };
        let text = format!(
            "Scene({filament}, clamps: [{clamps} {clamp}], linkers: [{linkers} {linker}], {rest},
                observe: [Tip(), EndReaction(end: Start), Curvature(at_nm: 20.0), Contour(), Energies,
                    TangentCorrelation(over_nm: 12.0), SquaredDisplacement(of: Centre)],
                task: {task})"
        );
        Scene::from_ron(&text).unwrap()
    }

    pub(crate) fn motion(&self) -> Scene {
        // A sine load prevents rest.
        let stop = if self.stops && self.held != IN_TIME {
            "stop: (force_pn: 5.0, torque_pn_nm: 5.0, kinetic_pn_nm: 1.0),"
        } else {
            ""
        };
        let thermal = self.noise.map_or(String::new(), |seed| {
            format!("thermal: (temperature_k: 298.0, seed: {seed}),")
        });
        self.scene(&format!(
            "Dynamics(duration_ns: {:?}, integrator: {}, record_every_ns: {:?}, {stop} {thermal}
             drag: (translational_per_ns: {:?}, rotational_per_ns: {:?}))",
            self.duration_ns,
            INTEGRATORS[self.integrator],
            self.record_every_ns,
            self.drag,
            0.5 * self.drag
        ))
    }

    pub(crate) fn brownian(&self) -> Scene {
        let (temperature, seed) = self.noise.map_or((0.0, 0), |seed| (298.0, seed));
        self.scene(&format!(
            "Brownian(duration_ms: 3e-7, temperature_k: {temperature:?}, seed: {seed},
                time_step_ns: 0.01, record_every_ns: 0.05)"
        ))
    }

    pub(crate) fn in_water(&self) -> Scene {
        let thermal = self.noise.map_or(String::new(), |seed| {
            format!(", thermal: (temperature_k: 298.0, seed: {seed})")
        });
        self.scene(&format!(
            "Dynamics(duration_ns: 0.3, drag: Water(), record_every_ns: 0.05{thermal})"
        ))
    }

    pub(crate) fn statics(&self) -> Scene {
        self.scene("Equilibrium(largest_step: 0.1, lowest_eigenvalue: true)")
    }
}

pub(crate) fn build(scene: &Scene) -> Assembly {
    Assembly::build(scene).unwrap()
}

pub(crate) fn checkpoints(directory: &RunDirectory, plan: &Plan<'_>) -> Checkpoints {
    let never = Arc::new(AtomicBool::new(false));
    let hour = Duration::from_hours(1);
    Checkpoints::new(directory, plan, hour, never, report)
}

fn report(error: &CheckpointError) {
    println!("{error}");
}

/// Sink that interrupts a run at the query number `left`.
pub(crate) struct Leaving<'a> {
    pub(crate) checkpoints: &'a mut Checkpoints,
    pub(crate) left: u64,
}

impl Sink for Leaving<'_> {
    fn record(&mut self, record: &Record) {
        self.checkpoints.record(record);
    }

    fn is_interrupted(&mut self) -> bool {
        self.left = self.left.saturating_sub(1);
        self.left == 0
    }

    fn is_checkpoint_due(&mut self) -> bool {
        // Alternates, so that the log grows in steps.
        self.left.is_multiple_of(2)
    }

    fn checkpoint(&mut self, position: &RunPosition, recorded: &RecordSummary, wall_s: f64) {
        self.checkpoints.checkpoint(position, recorded, wall_s);
    }
}

pub(crate) fn advance(
    scene: &Scene,
    directory: &RunDirectory,
    resumes: bool,
    left: u64,
) -> (Assembly, Trajectory, Outcome) {
    let assembly = build(scene);
    let plan = Plan::new(&assembly).unwrap();
    let mut checkpoints = checkpoints(directory, &plan);
    let saved = resumes.then(|| checkpoints.resume(&plan).unwrap());
    let mut sink = Leaving {
        checkpoints: &mut checkpoints,
        left,
    };
    let outcome = match saved {
        None => plan.run_into(&mut sink),
        Some(saved) => plan.resume_into(saved, &mut sink),
    };
    let outcome = outcome.unwrap();
    let trajectory = Trajectory::read(&checkpoints).unwrap();
    (assembly, trajectory, outcome)
}

/// Files of a run and of its pictures by name; the summary without its run time.
pub(crate) fn files(run: &Path) -> BTreeMap<String, Vec<u8>> {
    let folders = [run.to_owned(), run.join("vtk")];
    let there = folders.iter().filter(|folder| folder.exists());
    let entries = there.flat_map(|folder| fs::read_dir(folder).unwrap());
    let paths = entries.map(|entry| entry.unwrap().path());
    let named = paths.filter(|path| path.is_file()).map(|path| {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let mut bytes = fs::read(&path).unwrap();
        if name == "summary.json" {
            let text = String::from_utf8(bytes).unwrap();
            let lines = text.lines().filter(|line| !line.contains("\"wall_s\""));
            bytes = lines.collect::<String>().into_bytes();
        }
        (name, bytes)
    });
    named.collect()
}
