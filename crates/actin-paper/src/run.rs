//! Scenes of the repository, and runs in memory.

use crate::workspace_root;
use actin_mechanics::State;
use actin_sim::{
    Assembly, Clamp, DragModel, DragRates, End, Equilibrium, Filament, FreeTranslation, Load,
    Outcome, Part, Plan, Record, RunError, Scene, Section, Setting, Stage, Task, TimeCourse,
    Trajectory,
};
use actin_view::Pose;

/// Reads a scene of the folder `scenarios`.
pub(crate) fn scenario(file: &str) -> Result<Scene, String> {
    let path = workspace_root().join("scenarios").join(file);
    let text =
        std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    Scene::from_ron(&text).map_err(|error| format!("{}:{error}", path.display()))
}

/// Scene of the equilibrium of a free filament without loads.
pub(crate) fn free(title: &str, filament: Filament) -> Scene {
    Scene {
        title: title.to_owned(),
        ..Scene::new(filament, Task::Equilibrium(Equilibrium::default()))
    }
}

/// Runs the task of an assembly and leaves the system in the last state.
pub(crate) fn run_to_end(assembly: &mut Assembly) -> Result<(Trajectory, Outcome), RunError> {
    let (trajectory, outcome) = Plan::new(assembly)?.run()?;
    if let Some(last) = trajectory.records.last() {
        *assembly.system.state_mut() = last.state.clone();
    }
    Ok((trajectory, outcome))
}

pub(crate) fn clamp(end: End, slides: FreeTranslation) -> Clamp {
    Clamp {
        slides,
        ..Clamp::new(end)
    }
}

/// Sections of a filament with rods at ascending arc lengths (nm), and monomers elsewhere. `segments` gives the number of
/// segments of a rod of this length.
pub(crate) fn sections(
    length_nm: f64,
    rods: impl IntoIterator<Item = [f64; 2]>,
    segments: impl Fn(f64) -> Option<usize>,
) -> Vec<Section> {
    let mut sections = Vec::new();
    let mut reached = 0.0;
    let rods = rods.into_iter().filter(|[from, to]| to > from);
    for [from, to] in rods.chain([[length_nm; 2]]) {
        let to = to.min(length_nm);
        if from > reached {
            sections.push(monomers(reached, from));
        }
        if to > from {
            sections.push(Section::rod(from, to, segments(to - from)));
        }
        reached = to;
    }
    sections
}

pub(crate) fn monomers(from_nm: f64, to_nm: f64) -> Section {
    Section::Ellipsoids {
        from_nm,
        to_nm,
        altered: None,
    }
}

/// Number of segments of about `segment_nm` in a rod, at least one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a few hundred at most, and at least one"
)]
pub(crate) fn segments(rod_nm: f64, segment_nm: f64) -> usize {
    (rod_nm / segment_nm).round().max(1.0) as usize
}

/// Force (pN) on the far end of the first filament.
pub(crate) fn end_force(force_pn: impl Into<[f64; 3]>) -> Load {
    Load::EndForce {
        filament: 0,
        end: End::End,
        force_pn: force_pn.into(),
    }
}

/// Drag rates of velocities and of angular momenta (1/ns).
pub(crate) fn drag([translational_per_ns, rotational_per_ns]: [f64; 2]) -> DragModel {
    DragModel::Rates(DragRates {
        translational_per_ns,
        rotational_per_ns,
    })
}

/// Stage of a path of equilibria.
pub(crate) fn stage(set: impl Into<Vec<Setting>>) -> Stage {
    Stage {
        set: set.into(),
        duration_ns: None,
        pace: TimeCourse::Smooth,
    }
}

/// Rotation vector (deg) of an end of the first filament.
pub(crate) fn turn(end: End, turn_deg: impl Into<[f64; 3]>) -> Setting {
    Setting::Turn {
        filament: 0,
        end,
        turn_deg: turn_deg.into(),
    }
}

/// Displacement (nm) of an end of the first filament along the axis.
pub(crate) fn shift(end: End, along_nm: f64) -> Setting {
    Setting::Shift {
        filament: 0,
        end,
        shift_nm: [0.0, 0.0, along_nm],
    }
}

/// Completed run of a scene, with the system in the last state.
#[derive(Debug)]
pub(crate) struct SolvedScene {
    pub assembly: Assembly,
    /// At least one.
    pub records: Vec<Record>,
    pub report: Outcome,
}

impl SolvedScene {
    pub(crate) fn new(scene: &Scene) -> Result<Self, String> {
        Self::run(actin_sim::build(scene).map_err(|e| e.to_string())?)
    }

    /// Runs an assembly from its current state.
    pub(crate) fn run(mut assembly: Assembly) -> Result<Self, String> {
        let (trajectory, report) = run_to_end(&mut assembly).map_err(|e| e.to_string())?;
        if trajectory.records.is_empty() {
            return Err("no record".into());
        }
        Ok(Self {
            assembly,
            records: trajectory.records,
            report,
        })
    }

    /// Runs a scene from rotations of the built filament about its axis by quarters of a turn.
    pub(crate) fn rolled(scene: &Scene) -> Result<Vec<Self>, String> {
        let starts_deg = [0.0_f64, 90.0, 180.0, 270.0];
        let run = |degrees: f64| {
            let mut assembly = Assembly::build(scene).map_err(|e| e.to_string())?;
            assembly.roll(degrees.to_radians());
            Self::run(assembly)
        };
        starts_deg.into_iter().map(run).collect()
    }

    pub(crate) fn last(&self) -> &Record {
        &self.records[self.records.len() - 1]
    }

    pub(crate) fn state(&self) -> &State {
        self.assembly.system.state()
    }

    pub(crate) fn residual(&self) -> [f64; 2] {
        let last = self.last();
        [last.residual_force_pn, last.residual_torque_pn_nm]
    }

    /// Numbers of negative and of unresolved eigenvalues of the stiffness; `None` for a motion.
    pub(crate) fn doubtful(&self) -> Option<[usize; 2]> {
        let certificate = &self.report.equilibrium.as_ref()?.certificate;
        Some([certificate.negative, certificate.unresolved])
    }

    /// Potential energy of the selected parts of the system (pN nm).
    pub(crate) fn energy(&self, is_counted: fn(&Part) -> bool) -> f64 {
        energy(&self.assembly, self.last(), is_counted)
    }

    pub(crate) fn shape(&self) -> Shape {
        let points = self.assembly.points.iter().enumerate();
        let line = points
            .clone()
            .map(|(i, _)| self.assembly.centre_line_nm(self.state(), i).into());
        let monomers = points.filter(|(_, info)| info.frame.is_some());
        let centres = monomers.map(|(i, _)| self.state().points.position.get(i).into());
        Shape {
            line: line.collect(),
            monomers: centres.collect(),
            pose: self.pose(),
        }
    }

    pub(crate) fn pose(&self) -> Pose {
        Pose::new(&self.assembly, self.state())
    }
}

/// Centre line and bodies of a state.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    /// Centre line (nm).
    pub line: Vec<[f64; 3]>,
    /// Centres of monomers (nm).
    pub monomers: Vec<[f64; 3]>,
    pub pose: Pose,
}

/// Potential energy of the selected parts of the system in a record (pN nm).
pub(crate) fn energy(assembly: &Assembly, record: &Record, is_counted: fn(&Part) -> bool) -> f64 {
    let terms = assembly.terms.iter().zip(&record.energies_pn_nm);
    terms
        .filter(|(term, _)| is_counted(&term.part))
        .map(|(_, energy)| energy)
        .sum()
}
