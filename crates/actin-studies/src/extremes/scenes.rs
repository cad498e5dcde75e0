//! Scenes as text, their runs, and the balance of their equilibria.

use super::row::Outcome;
use actin_mechanics::{System, Vector3};
use actin_sim::{
    Assembly, End, Failure, Load, Plan, RunError, Scene, SceneError, Status, Trajectory,
};

#[derive(Clone, Debug, Default)]
pub(super) struct Parts {
    pub(super) sections: String,
    pub(super) models: String,
    pub(super) rest: String,
    pub(super) task: String,
}

const BONDS: usize = 16;

impl Parts {
    pub(super) fn new(
        sections: impl Into<String>,
        rest: impl Into<String>,
        task: impl Into<String>,
    ) -> Self {
        Self {
            sections: sections.into(),
            models: String::new(),
            rest: rest.into(),
            task: task.into(),
        }
    }

    pub(super) fn free(sections: &str) -> Self {
        Self::new(sections, "", "Dynamics(duration_ns: 1.0)")
    }

    /// Creates a clamped filament with a tip force (pN), solved to a relative tolerance of 1e-6.
    pub(super) fn pulled(sections: &str, [x, y, z]: [f64; 3]) -> Self {
        let force = Vector3::new(x, y, z).norm();
        let (tolerance, torque) = (1e-6 * force, 1e-5 * force);
        let rest = format!(
            "clamps: [Clamp(end: Start)],
                 loads: [EndForce(end: End, force_pn: ({x:?}, {y:?}, {z:?}))],"
        );
        let task = format!("Equilibrium(force_pn: {tolerance:?}, torque_pn_nm: {torque:?})");
        Self::new(sections, rest, task)
    }

    pub(super) fn text(&self) -> String {
        let Self {
            sections,
            models,
            rest,
            task,
        } = self;
        // Rods of constant rigidities, for comparison with theory.
        let rod = if models.contains("rod:") {
            ""
        } else {
            "rod: RodModel(law: Constant),"
        };
        format!(
            "Scene(
                filament: Filament(
                    sections: [{sections}],
                    monomers: Monomers(anchors: Independent, lateral_bonds: {BONDS}, longitudinal_bonds: {BONDS}),
                    {models} {rod}
                ),
                {rest}
                task: {task},
            )"
        )
    }

    pub(super) fn build(&self) -> Result<Assembly, Outcome> {
        Ok(build(&self.text())?)
    }

    pub(super) fn run(&self) -> Result<CompletedRun, Outcome> {
        run(&self.text())
    }
}

pub(super) fn free(sections: &str) -> Result<System, Outcome> {
    Ok(Parts::free(sections).build()?.system)
}

#[derive(Debug)]
pub(super) struct CompletedRun {
    pub(super) assembly: Assembly,
    pub(super) report: actin_sim::Outcome,
    pub(super) trajectory: Trajectory,
}

pub(super) fn build(text: &str) -> Result<Assembly, SceneError> {
    let scene = Scene::from_ron(text)?;
    actin_sim::build(&scene).map_err(|problem| SceneError::locate(&problem, text))
}

pub(super) fn run(text: &str) -> Result<CompletedRun, Outcome> {
    let ran = run_to_saddle(text)?;
    if ran.report.status == Status::Failed {
        return Err(Outcome::Fails("the run ends on a saddle".to_owned()));
    }
    Ok(ran)
}

pub(super) fn run_to_saddle(text: &str) -> Result<CompletedRun, Outcome> {
    let mut assembly = build(text)?;
    let mut trajectory = Trajectory::default();
    let refused = |problem| SceneError::locate(&problem, text);
    let plan = Plan::new(&assembly).map_err(refused)?;
    let report = match plan.run_into(&mut trajectory) {
        Ok(report) => report,
        Err(RunError::Failed(failed)) if matches!(failed.failure, Failure::Saddle(_)) => {
            failed.outcome
        }
        Err(RunError::Refused(problem)) => return Err(refused(problem).into()),
        Err(error) => return Err(Outcome::Fails(error.to_string())),
    };
    let last = trajectory.records.last().expect("a run has records");
    *assembly.system.state_mut() = last.state.clone();
    Ok(CompletedRun {
        assembly,
        report,
        trajectory,
    })
}

impl From<SceneError> for Outcome {
    fn from(error: SceneError) -> Self {
        Self::Refused(error.to_string())
    }
}

impl CompletedRun {
    /// Returns the reaction force (pN) and torque (pN nm) of a clamp.
    pub(super) fn reaction(&mut self, clamp: usize) -> (Vector3, Vector3) {
        let loads = self.assembly.system.loads().clone();
        let state = self.assembly.system.state();
        let reaction = self.assembly.clamps[clamp].reaction(state, &loads);
        (reaction.force_pn, reaction.torque_pn_nm)
    }

    /// Returns the sum of the clamp's reaction and the tip force, and of their moments, relative to the load.
    pub(super) fn imbalance(&mut self) -> f64 {
        let (force_pn, torque_pn_nm) = self.reaction(0);
        let state = self.assembly.system.state();
        let arm = self.assembly.tip_nm(state, End::End) - self.assembly.clamps[0].point_nm(state);
        let loads = self.assembly.scene.loads.iter().map(|load| match load {
            Load::EndForce { force_pn, .. } => (*force_pn).into(),
            _ => Vector3::zeros(),
        });
        let applied: Vector3 = loads.sum();
        let moment = arm.cross(&applied);
        let force = (force_pn + applied).norm() / applied.norm();
        // Relative to the lever arm, since the moment of an axial force is zero.
        let whole = arm.norm() * applied.norm();
        force.max((torque_pn_nm + moment).norm() / whole)
    }

    pub(super) fn tip_displacement(&self) -> Vector3 {
        let (assembly, state) = (&self.assembly, self.assembly.system.state());
        assembly.tip_nm(state, End::End) - assembly.tip_nm(&assembly.rest, End::End)
    }
}
