//! Plan of a run.

use super::dynamics::{Estimate, estimate};
use crate::Assembly;
use crate::notes::Note;
use crate::scene::{Scene, SceneProblem};
use std::time::Instant;

/// Assembly with everything decided before its run: time step, numbers of steps and records, and
/// the complete scene.
///
/// ```
/// use actin_sim::{Assembly, Plan, Scene};
/// # let text = "Scene(
/// #     filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)]),
/// #     clamps: [Clamp(end: Start)],
/// #     task: Equilibrium(),
/// # )";
/// let scene = Scene::from_ron(text)?;
/// let assembly = Assembly::build(&scene)?;
/// let plan = Plan::new(&assembly)?;
/// let (trajectory, outcome) = plan.run()?;
/// # assert_eq!(trajectory.records.len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Plan<'a> {
    assembly: &'a Assembly,
    estimate: Option<Estimate>,
    scene: Scene,
    set_up_s: f64,
}

impl<'a> Plan<'a> {
    /// Plans the run of an assembly.
    ///
    /// # Errors
    /// If the time step exceeds the stability limit without permission of the scene, a turn exceeds
    /// the range of the segments, the number of steps exceeds 2^53, or the records exceed the
    /// memory.
    pub fn new(assembly: &'a Assembly) -> Result<Self, SceneProblem> {
        let began = Instant::now();
        let estimate = estimate(assembly)?;
        assembly.observers.check(assembly, estimate.as_ref())?;
        let mut scene = assembly.scene.clone();
        if let Some(estimate) = &estimate {
            estimate.resolve(&mut scene);
        }
        if !scene.observe.is_empty() {
            scene.burn_in_ns = scene.burn_in();
        }
        Ok(Self {
            assembly,
            estimate,
            scene,
            set_up_s: assembly.build_s + began.elapsed().as_secs_f64(),
        })
    }

    /// Returns the assembly.
    pub fn assembly(&self) -> &'a Assembly {
        self.assembly
    }

    /// Returns the scene with all defaults, the time step and the interval of records.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the time step and the numbers of steps; `None` for an equilibrium.
    pub fn estimate(&self) -> Option<&Estimate> {
        self.estimate.as_ref()
    }

    pub(crate) fn set_up_s(&self) -> f64 {
        self.set_up_s
    }

    /// Returns warnings about the time step and the records that differ from the request or have
    /// side effects. Warnings about the scene are in [`Assembly::notes`].
    pub fn notes(&self) -> Vec<Note> {
        let scene = &self.assembly.scene;
        let estimate = self.estimate.iter();
        estimate
            .flat_map(|e| [e.notes(&scene.task), Vec::from_iter(e.note_on_means(scene))].concat())
            .collect()
    }
}
