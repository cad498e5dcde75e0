//! Plan of a run.

use super::brownian::{self, RelaxationTimes, relaxation_times};
use super::{Estimate, dynamics};
use crate::scene::{Scene, SceneProblem, Task};
use crate::{Assembly, memory};
use crate::{codes, observe};
use actin_assembly::Note;
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
        assembly.check_start()?;
        let estimate = estimate(assembly)?;
        let times = estimate.as_ref().map(Estimate::record_times);
        observe::check(assembly, times.as_ref())?;
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

    /// Returns the relaxation times in the fluid of the task, or `None` for tasks without a fluid.
    /// The cost is comparable to some hundred steps.
    ///
    /// # Errors
    /// If there are more than 5000 degrees of freedom, or drag or couplings without defined
    /// relaxation times.
    pub fn relaxation_times(&self) -> Option<Result<RelaxationTimes, SceneProblem>> {
        relaxation_times(self.assembly, &self.scene.task)
    }

    pub(crate) fn set_up_s(&self) -> f64 {
        self.set_up_s
    }

    /// Returns warnings about the time step and the records that differ from the request or have
    /// side effects. Warnings about the scene are in [`Assembly::notes`].
    pub fn notes(&self) -> Vec<Note> {
        let scene = &self.assembly.scene;
        let of_estimate = |estimate: &Estimate| {
            let averages = self.assembly.note_on_averages(estimate.time_step_ns);
            let averages = Note::warnings(codes::LINKER_AVERAGING, averages);
            let means = estimate.note_on_means(scene);
            let notes = estimate.notes(&scene.task).into_iter();
            notes.chain(means).chain(averages).collect::<Vec<_>>()
        };
        let estimate = self.estimate.iter();
        estimate
            .flat_map(of_estimate)
            .chain(observe::note(scene))
            .collect()
    }
}

/// Time step and number of steps of an assembly's motion; `None` for an equilibrium.
///
/// # Errors
/// As [`Plan::new`].
fn estimate(assembly: &Assembly) -> Result<Option<Estimate>, SceneProblem> {
    match &assembly.scene.task {
        Task::Dynamics(dynamics) => dynamics::estimate(assembly, dynamics).map(Some),
        Task::Brownian(brownian) => brownian::estimate(assembly, brownian).map(Some),
        Task::Equilibrium(settings) => {
            assembly.check_slip()?;
            let fewest = assembly.drive.stages() as f64 / settings.largest_step;
            let key = ("task.largest_step", format!("{:?}", settings.largest_step));
            memory::check_records(assembly, fewest, key, |bodies| {
                format!("{fewest:.2e} equilibria of {bodies} bodies and more need")
            })?;
            Ok(None)
        }
    }
}
