//! Scenes of the repository, and runs into memory.

use crate::workspace_root;
use actin_sim::{
    Assembly, Clamp, End, Equilibrium, Filament, Hold, Outcome, Output, Plan, RunError, Scene,
    Slides, Task, Trajectory,
};

/// The scene in a file of the folder `scenarios`.
pub(crate) fn scenario(file: &str) -> Result<Scene, String> {
    let path = workspace_root().join("scenarios").join(file);
    let text =
        std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    Scene::from_ron(&text).map_err(|error| format!("{}:{error}", path.display()))
}

/// Free filament without loads, in equilibrium.
pub(crate) fn free(title: &str, filament: Filament) -> Scene {
    Scene {
        title: title.to_owned(),
        filament,
        further: Vec::new(),
        clamps: Vec::new(),
        loads: Vec::new(),
        linkers: Vec::new(),
        repulsion: None,
        path: Vec::new(),
        observe: Vec::new(),
        burn_in_ns: None,
        output: Output::default(),
        task: Task::Equilibrium(Equilibrium::default()),
    }
}

/// Runs an assembly as its scene asks; it is then in its last state.
pub(crate) fn run_to_end(assembly: &mut Assembly) -> Result<(Trajectory, Outcome), RunError> {
    let (trajectory, outcome) = Plan::new(assembly)?.run()?;
    if let Some(last) = trajectory.records.last() {
        *assembly.system.state_mut() = last.state.clone();
    }
    Ok((trajectory, outcome))
}

/// A wall at an end of filament 0, which slides so.
pub(crate) fn clamp(end: End, slides: Slides) -> Clamp {
    Clamp {
        filament: 0,
        end,
        hold: Hold::Wall,
        hinge: None,
        slides,
    }
}
