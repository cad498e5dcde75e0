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
    arrangements: Vec<Arrangement>,
    /// Clamped ends. All other ends are free.
    #[serde(default)]
    clamps: Vec<Clamp>,
    /// Forces and couples.
    #[serde(default)]
    loads: Vec<Load>,
    /// Springs from sites on filaments to fixed points or to other sites.
    #[serde(default)]
    linkers: Vec<Linker>,
    /// Random linkers between neighbouring filaments.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    linker_sets: Vec<LinkersBetween>,
    /// Crosslinkers and motors that bind to filaments and unbind from them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    crosslinkers: Vec<Crosslinkers>,
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

    /// Collects the filaments of all keys, then the linkers.
    fn try_from(mut written: SceneFile) -> Result<Self, SceneProblem> {
        let is_generated = !(written.arrangements.is_empty()
            && written.linker_sets.is_empty()
            && written.crosslinkers.is_empty());
        if is_generated {
            let mut problems = Problems::new(1);
            numbers::check(&to_value(&written, false), &mut problems);
            problems.into_result()?;
        }
        let mut filaments = listed(
            written.filament.take(),
            written.filaments.take(),
            !written.arrangements.is_empty(),
        )?;
        arrange(&written, &mut filaments)?;
        let linkers = linkers(
            written.linkers,
            (&written.linker_sets, &written.crosslinkers),
            (&filaments, written.periodic.as_ref()),
        )?;
        let mut resolved = filaments.into_iter().map(|mut filament| {
            filament.monomers.resolve();
            filament
        });
        let none = || SceneProblem::new("filaments", "[]", "a scene has at least one filament");
        Ok(Self {
            title: written.title,
            filament: resolved.next().ok_or_else(none)?,
            other_filaments: resolved.collect(),
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
}

/// Appends the arranged filaments.
fn arrange(written: &SceneFile, filaments: &mut Vec<Filament>) -> Result<(), SceneProblem> {
    let (repulsion, periodic) = (written.repulsion.as_ref(), written.periodic.as_ref());
    let contact = repulsion.map_or(0.0, Repulsion::contact_nm);
    for (k, arrangement) in written.arrangements.iter().enumerate() {
        let mut one = arrangement.filament().clone();
        one.monomers.resolve();
        let mut problems = Problems::new(1);
        if let Some(repulsion) = repulsion {
            repulsion.check(&mut problems);
        }
        problems.note(periodic.map_or(Ok(()), |periodic| periodic.check_size(contact)));
        let key = format!("arrangements[{k}].filament");
        check_filament(&one, &key, &mut problems);
        problems.into_result()?;
        let arranged = arrangement.filaments(k, filaments, (repulsion, periodic))?;
        filaments.extend(arranged);
    }
    Ok(())
}

/// Returns the listed linkers, followed by the linkers of sets and pools.
fn linkers(
    mut linkers: Vec<Linker>,
    (sets, pools): (&[LinkersBetween], &[Crosslinkers]),
    (filaments, periodic): (&[Filament], Option<&PeriodicBox>),
) -> Result<Vec<Linker>, SceneProblem> {
    for (k, set) in sets.iter().enumerate() {
        linkers.extend(set.linkers(k, filaments, periodic)?);
    }
    for (k, pool) in pools.iter().enumerate() {
        linkers.extend(pool.linkers(k, filaments)?);
    }
    Ok(linkers)
}

/// Returns the filaments of the keys `filament` or `filaments`. Scenes with arrangements may omit both.
fn listed(
    alone: Option<Filament>,
    several: Option<Vec<Filament>>,
    is_arranged: bool,
) -> Result<Vec<Filament>, SceneProblem> {
    match (alone, several) {
        (Some(filament), None) => Ok(vec![filament]),
        (None, Some(filaments)) => Ok(filaments),
        (None, None) if is_arranged => Ok(Vec::new()),
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
