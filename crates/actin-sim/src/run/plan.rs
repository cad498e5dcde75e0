//! What a run will do, known before it starts.

use super::dynamics::{Estimate, estimate};
use crate::Assembly;
use crate::notes::Note;
use crate::scene::{Scene, SceneProblem};
use std::time::Instant;

/// An assembly with everything that is decided before it runs: the time step, the number of steps and
/// records, and the scene with all of these written out.
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
    /// The plan of an assembly.
    ///
    /// # Errors
    /// A time step above the stability limit that the scene does not explicitly allow, a turn that its
    /// segments cannot follow, more steps than can be counted, and more records, of either task, than
    /// memory holds.
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

    /// What is to run.
    pub fn assembly(&self) -> &'a Assembly {
        self.assembly
    }

    /// The scene with every default, the time step and the interval of records written out.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Time step and numbers of steps; none of an equilibrium.
    pub fn estimate(&self) -> Option<&Estimate> {
        self.estimate.as_ref()
    }

    /// Time that it took to build the assembly and to plan its run (s).
    pub(crate) fn set_up_s(&self) -> f64 {
        self.set_up_s
    }

    /// What there is to know of its time step and its records, where that is not what the scene asks for or does more
    /// than it shows; a sentence or two each. What there is to know of the scene is in
    /// [`Assembly::notes`].
    pub fn notes(&self) -> Vec<Note> {
        let scene = &self.assembly.scene;
        let estimate = self.estimate.iter();
        estimate
            .flat_map(|e| [e.notes(&scene.task), Vec::from_iter(e.note_on_means(scene))].concat())
            .collect()
    }
}
