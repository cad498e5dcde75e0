//! Scene as written: a single `filament` or a list of `filaments`.

use super::problem::Problems;
use super::serialize::to_value;
use super::validate::check_filament;
use super::{
    Arrangement, Bead, Clamp, Crosslinkers, Filament, Linker, LinkersBetween, Load, Observable,
    Output, PeriodicBox, Repulsion, Scene, SceneProblem, Stage, Start, Task, numbers,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A scene: filaments, clamps, loads, linkers and a task.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "Scene")]
pub(super) struct SceneFile {
    /// Title of the scene.
    #[serde(default)]
    title: String,
    /// The filament of a scene with a single one. A scene has `filament`, `filaments` or `arrangements`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    filament: Option<Filament>,
    /// Filaments, at least one, with indices from 0. Only linkers and `repulsion` act between them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    filaments: Option<Vec<Filament>>,
    /// Arrangements of many filaments: copies, random networks, bundles.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) arrangements: Vec<Arrangement>,
    /// Clamped ends. All other ends are free.
    #[serde(default)]
    clamps: Vec<Clamp>,
    /// Forces and couples.
    #[serde(default)]
    loads: Vec<Load>,
    /// Springs from sites on filaments to fixed points or to other sites.
    #[serde(default)]
    pub(super) linkers: Vec<Linker>,
    /// Random linkers between neighbouring filaments.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) linker_sets: Vec<LinkersBetween>,
    /// Crosslinkers and motors that bind to filaments and unbind from them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) crosslinkers: Vec<Crosslinkers>,
    /// Beads on filaments, for optical traps.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    beads: Vec<Bead>,
    /// Repulsion of filaments from each other and from walls; by default none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    repulsion: Option<Repulsion>,
    /// Periodic box and its shear; by default space is not periodic.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    periodic: Option<PeriodicBox>,
    /// Stages that change load factors and move clamped ends and anchors. Shifts, turns and the factors of
    /// loads that a stage sets start at zero. All other loads act in full.
    #[serde(default)]
    path: Vec<Stage>,
    /// Quantities computed for every record and written to `observables.csv`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    observe: Vec<Observable>,
    /// Initial time that means of `observe` exclude; at least 0, below `duration_ns`. Only with `thermal`. By
    /// default a fifth of `duration_ns`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    burn_in_ns: Option<f64>,
    /// Optional output files.
    #[serde(default, skip_serializing_if = "is_default")]
    output: Output,
    /// Initial state; by default filaments as built, at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start: Option<Start>,
    /// Computation to run.
    task: Task,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl TryFrom<SceneFile> for Scene {
    type Error = SceneProblem;

    fn try_from(written: SceneFile) -> Result<Self, SceneProblem> {
        let first = written.problems_of_generated(1).into_iter().next();
        first.map_or_else(|| written.generate(), Err)
    }
}

impl SceneFile {
    /// Collects the filaments of all keys, then the linkers. Their numbers must be valid.
    pub(super) fn generate(self) -> Result<Scene, SceneProblem> {
        let mut written = self;
        let mut filaments = written.take_filaments()?;
        let surroundings = (written.repulsion.as_ref(), written.periodic.as_ref());
        for (k, arrangement) in written.arrangements.iter().enumerate() {
            let arranged = arrangement.filaments(k, &filaments, surroundings)?;
            filaments.extend(arranged);
        }
        let mut linkers = written.linkers;
        for (k, set) in written.linker_sets.iter().enumerate() {
            linkers.extend(set.linkers(k, &filaments, written.periodic.as_ref())?);
        }
        for (k, pool) in written.crosslinkers.iter().enumerate() {
            linkers.extend(pool.linkers(k, &filaments)?);
        }
        for filament in &mut filaments {
            filament.monomers.resolve();
        }
        let mut filaments = filaments.into_iter();
        let none = || SceneProblem::new("filaments", "[]", "a scene has at least one filament");
        Ok(Scene {
            title: written.title,
            filament: filaments.next().ok_or_else(none)?,
            other_filaments: filaments.collect(),
            clamps: written.clamps,
            loads: written.loads,
            linkers,
            beads: written.beads,
            repulsion: written.repulsion,
            periodic: written.periodic,
            path: written.path,
            observe: written.observe,
            burn_in_ns: written.burn_in_ns,
            output: written.output,
            start: written.start,
            task: written.task,
        })
    }

    /// Returns violated rules that generated filaments and linkers depend on: all numbers, and the filaments and the
    /// space of arrangements. None for a scene in which nothing is generated.
    pub(super) fn problems_of_generated(&self, most: usize) -> Vec<SceneProblem> {
        let has_linkers = !(self.linker_sets.is_empty() && self.crosslinkers.is_empty());
        let mut problems = Problems::new(most);
        if has_linkers || !self.arrangements.is_empty() {
            numbers::check(&to_value(self, false), &mut problems);
        }
        for (k, arrangement) in self.arrangements.iter().enumerate() {
            if let Some(repulsion) = &self.repulsion {
                repulsion.check(&mut problems);
            }
            if let Some(periodic) = &self.periodic {
                let contact = self.repulsion.as_ref().map_or(0.0, Repulsion::contact_nm);
                problems.note(periodic.check_size(contact));
            }
            let mut filament = arrangement.filament().clone();
            filament.monomers.resolve();
            let key = format!("arrangements[{k}].filament");
            check_filament(&filament, &key, &mut problems);
        }
        problems.found
    }

    /// Number of filaments of the keys `filament` and `filaments`.
    pub(super) fn count_written_filaments(&self) -> usize {
        self.filaments.as_ref().map_or(0, Vec::len) + usize::from(self.filament.is_some())
    }

    /// Returns the filaments of the keys `filament` or `filaments`. Scenes with arrangements may omit both.
    fn take_filaments(&mut self) -> Result<Vec<Filament>, SceneProblem> {
        match (self.filament.take(), self.filaments.take()) {
            (Some(filament), None) => Ok(vec![filament]),
            (None, Some(filaments)) => Ok(filaments),
            (None, None) if !self.arrangements.is_empty() => Ok(Vec::new()),
            (None, None) => {
                let rule = "is missing: write filament, filaments or arrangements";
                Err(SceneProblem::new("filament", "", rule))
            }
            (Some(_), Some(_)) => {
                let rule = "the scene already has the key `filament`: write one of the two keys";
                Err(SceneProblem::new("filaments", "", rule))
            }
        }
    }
}

impl From<Scene> for SceneFile {
    fn from(scene: Scene) -> Self {
        let (filament, filaments) = if scene.other_filaments.is_empty() {
            (Some(scene.filament), None)
        } else {
            let all = std::iter::once(scene.filament).chain(scene.other_filaments);
            (None, Some(all.collect()))
        };
        let mut linkers = scene.linkers;
        let crosslinkers = Crosslinkers::from_linkers(&mut linkers);
        Self {
            title: scene.title,
            filament,
            filaments,
            arrangements: Vec::new(),
            clamps: scene.clamps,
            loads: scene.loads,
            linkers,
            linker_sets: Vec::new(),
            crosslinkers,
            beads: scene.beads,
            repulsion: scene.repulsion,
            periodic: scene.periodic,
            path: scene.path,
            observe: scene.observe,
            burn_in_ns: scene.burn_in_ns,
            output: scene.output,
            start: scene.start,
            task: scene.task,
        }
    }
}
