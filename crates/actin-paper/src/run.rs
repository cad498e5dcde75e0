//! Scenes of the repository, and runs in memory.

use crate::workspace_root;
use actin_sim::{Assembly, End, Part, Record, Scene, Section, Setting, Solution, Solve};
use actin_view::Pose;

/// Reads a scene of the folder `scenarios`.
pub(crate) fn scenario(file: &str) -> Result<Scene, String> {
    let path = workspace_root().join("scenarios").join(file);
    Scene::from_path(path).map_err(|error| error.to_string())
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
            sections.push(Section::ellipsoids(reached, from));
        }
        if to > from {
            sections.push(Section::rod(from, to, segments(to - from)));
        }
        reached = to;
    }
    sections
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

/// Displacement of an end of the first filament along the axis.
pub(crate) fn shift(end: End, along_nm: f64) -> Setting {
    Setting::shift(end, [0.0, 0.0, along_nm])
}

pub(crate) fn solved(scene: &Scene) -> Result<Solution, String> {
    scene.solve().map_err(|e| e.to_string())
}

/// Runs a scene from rotations of the built filament about its axis by quarters of a turn.
pub(crate) fn rolled(scene: &Scene) -> Result<Vec<Solution>, String> {
    let starts_deg = [0.0_f64, 90.0, 180.0, 270.0];
    let run = |degrees: f64| {
        let mut assembly = Assembly::build(scene).map_err(|e| e.to_string())?;
        assembly.roll(degrees.to_radians());
        Solution::new(assembly).map_err(|e| e.to_string())
    };
    starts_deg.into_iter().map(run).collect()
}

/// Residual force (pN) and torque (pN nm) of the last record.
pub(crate) fn residual(solution: &Solution) -> [f64; 2] {
    let last = solution.last();
    [last.residual_force_pn, last.residual_torque_pn_nm]
}

/// Numbers of negative and of unresolved eigenvalues of the stiffness; `None` for a motion.
pub(crate) fn doubtful(solution: &Solution) -> Option<[usize; 2]> {
    let certificate = &solution.outcome.equilibrium.as_ref()?.certificate;
    Some([certificate.negative, certificate.unresolved])
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

impl Shape {
    pub(crate) fn new(solution: &Solution) -> Self {
        let points = solution.assembly.points.iter().enumerate();
        let monomers = points.filter(|(_, info)| info.frame.is_some());
        let position = &solution.state().points.position;
        let line = solution.centre_line_nm(0).into_iter();
        Self {
            line: line.map(Into::into).collect(),
            monomers: monomers.map(|(i, _)| position.get(i).into()).collect(),
            pose: pose(solution),
        }
    }
}

pub(crate) fn pose(solution: &Solution) -> Pose {
    Pose::new(&solution.assembly, solution.state())
}

/// Potential energy of the selected parts of the system in a record (pN nm).
pub(crate) fn energy(assembly: &Assembly, record: &Record, is_counted: fn(&Part) -> bool) -> f64 {
    let terms = assembly.terms.iter().zip(&record.energies_pn_nm);
    terms
        .filter(|(term, _)| is_counted(&term.part))
        .map(|(_, energy)| energy)
        .sum()
}
