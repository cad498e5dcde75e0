//! Path of certified equilibria through all values of a protocol.

use super::MeasureError;
use actin_equilibrium::{Certificate, Path, PathEnd, PathFailure, PathOptions, Stability};
use actin_mechanics::State;
use actin_sim::{Assembly, Equilibrium as Settings, Scene, Task, path_options, solver};
use std::ops::ControlFlow;

/// Quality of the equilibrium at a measured point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// Largest force on a free body (pN).
    pub residual_force_pn: f64,
    /// Largest torque on a free body (pN nm).
    pub residual_torque_pn_nm: f64,
    /// Numbers of negative and unresolved eigenvalues of the stiffness matrix.
    pub certificate: Certificate,
    /// Number of displacements from saddles along the lowest mode since the previous point.
    pub saddles_left: usize,
    /// Number of jumps since the previous point.
    pub jumps: usize,
}

impl Evidence {
    /// Returns whether the equilibrium is stable, neutral within the resolution, or a saddle.
    pub(crate) fn stability(&self) -> Stability {
        self.certificate.stability()
    }

    /// Returns `true` if all eigenvalues are positive and resolved.
    pub fn is_stable(&self) -> bool {
        self.stability() == Stability::Stable
    }
}

pub(crate) struct PathPoint {
    pub(crate) state: State,
    pub(crate) evidence: Evidence,
}

/// Equilibria at the ends of the stages, and the reason for an early end.
pub(crate) struct EquilibriumPath {
    pub(crate) assembly: Assembly,
    pub(crate) stops: Vec<PathPoint>,
    pub(crate) ended: Option<Box<PathFailure>>,
}

/// Follows the path of `scene` from stage to stage.
pub(crate) fn follow(scene: &Scene) -> Result<EquilibriumPath, MeasureError> {
    scene.validate()?;
    let assembly = Assembly::build(scene)?;
    let Task::Equilibrium(settings) = &scene.task else {
        unreachable!("scenes of a specimen have the task Equilibrium");
    };
    let mut newton = solver(&assembly, settings)?;
    let path = path(settings)?;
    let mut state = assembly.system.state().clone();
    let mut stops = Vec::new();
    let mut ended = None;
    for stage in 0..assembly.drive.stages() {
        let (mut saddles_left, mut jumps) = (0, 0);
        let end = path.follow(
            &mut newton,
            &mut state,
            assembly.system.interactions(),
            &mut |state, t| assembly.drive.place(state, stage as f64 + t),
            &mut |point| {
                saddles_left += point.equilibrium.saddles_left;
                jumps += usize::from(point.jumped);
                ControlFlow::Continue(())
            },
        );
        match end {
            Ok(end) => stops.push(PathPoint {
                state: state.clone(),
                evidence: evidence(&end, saddles_left, jumps),
            }),
            Err(failure) => {
                ended = Some(failure);
                break;
            }
        }
    }
    Ok(EquilibriumPath {
        assembly,
        stops,
        ended,
    })
}

/// A path that tries each stage in one step, with smaller steps after a failure.
fn path(settings: &Settings) -> Result<Path, MeasureError> {
    let first_step = settings.largest_step;
    let options = path_options(settings);
    Ok(Path::new(PathOptions {
        first_step,
        ..options
    })?)
}

fn evidence(end: &PathEnd, saddles_left: usize, jumps: usize) -> Evidence {
    let equilibrium = &end.equilibrium;
    Evidence {
        residual_force_pn: equilibrium.residual.force,
        residual_torque_pn_nm: equilibrium.residual.torque,
        certificate: equilibrium
            .certificate
            .expect("the solver of a scene certifies its equilibria"),
        saddles_left,
        jumps,
    }
}
