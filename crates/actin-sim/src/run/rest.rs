//! Detection of motions at rest, and perturbations that leave saddles.

use super::Record;
use super::unknowns::newton;
use crate::scene::{Dynamics, Equilibrium, SceneProblem};
use crate::{Assembly, Part};
use actin_equilibrium::{Certificate, Nearest, Newton, Stability, StepSize};
use actin_mechanics::System;
use serde::{Deserialize, Serialize};

/// Largest kinetic energy plus potential energy above the nearest equilibrium of a motion at rest,
/// over its elastic energy. The deformation then deviates by less than 1e-3 from the equilibrium.
const REST: f64 = 1e-6;

/// Absolute tolerance (pN nm) above round-off in filaments without strain.
const LEAST: f64 = 1e-9;

/// Largest displacement and rotation of a perturbation: far above round-off, with negligible
/// strain.
const PUSH: StepSize = StepSize {
    displacement: 0.01,
    rotation: 1e-3,
    strain: 0.0,
};

/// Perturbation of a motion at a saddle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SaddlePush {
    /// Time (ns).
    pub time_ns: f64,
    /// Potential energy of the saddle (pN nm).
    pub energy_pn_nm: f64,
    /// Number of negative eigenvalues of the stiffness.
    pub negative_eigenvalues: usize,
    /// Lowest eigenvalue (pN/nm; rotations count as displacements at 1 nm).
    pub lowest_eigenvalue: f64,
    /// Largest displacement of a body (nm).
    pub displacement_nm: f64,
    /// Largest rotation of a body (rad).
    pub turn_rad: f64,
}

#[derive(Debug)]
pub(super) struct RestJudge<'a> {
    assembly: &'a Assembly,
    /// Created on first use.
    newton: Option<Newton>,
}

impl<'a> RestJudge<'a> {
    pub(super) fn new(assembly: &'a Assembly, dynamics: &Dynamics) -> Option<Self> {
        let newton = None;
        (dynamics.thermal.is_none()).then_some(Self { assembly, newton })
    }

    /// Returns the equilibrium in which a motion is at rest; `None` if it still moves or has no
    /// potential. If the stop rule is met, the motion is at rest.
    pub(super) fn equilibrium(
        &mut self,
        record: &Record,
        system: &System,
        stop_rule_met: bool,
    ) -> Option<Nearest> {
        let limit = REST * self.elastic(record) + LEAST;
        if !stop_rule_met && record.kinetic_pn_nm > limit {
            return None;
        }
        // Without a potential there is no equilibrium to find.
        let newton = self.newton()?;
        let nearest = newton.nearest(&record.state, system.interactions());
        let nearest = nearest.ok().flatten()?;
        let height = record.kinetic_pn_nm + nearest.energy_above.abs();
        (stop_rule_met || height <= limit).then_some(nearest)
    }

    /// Energy of all interactions except loads (pN nm).
    fn elastic(&self, record: &Record) -> f64 {
        let energies = self.assembly.terms.iter().zip(&record.energies_pn_nm);
        let elastic = energies.filter(|(term, _)| !matches!(term.part, Part::Load(_)));
        elastic.map(|(_, energy)| energy.abs()).sum()
    }

    fn newton(&mut self) -> Option<&mut Newton> {
        if self.newton.is_none() {
            self.newton = newton(self.assembly, &Equilibrium::default()).ok();
        }
        self.newton.as_mut()
    }

    /// Perturbs `system`, at rest on the saddle `nearest`, along the lowest mode. Returns `None`
    /// and leaves the system unchanged if the energy falls in neither direction.
    pub(super) fn push(
        &mut self,
        (record, nearest): (&Record, &Nearest),
        system: &mut System,
    ) -> Option<SaddlePush> {
        let mut state = system.state().clone();
        let interactions = system.interactions();
        let pushed = self
            .newton()?
            .push_off_saddle(&mut state, interactions, &PUSH);
        let push = pushed.ok().flatten()?;
        system.state_mut().copy_motion_from(&state);
        Some(SaddlePush {
            time_ns: record.at.value(),
            energy_pn_nm: energy_of(record, nearest),
            negative_eigenvalues: nearest.certificate.negative,
            lowest_eigenvalue: push.mode.eigenvalue,
            displacement_nm: push.extent.displacement,
            turn_rad: push.extent.rotation,
        })
    }
}

impl SaddlePush {
    /// Returns `true` if a motion is still at the saddle of this perturbation, with `nearest` at
    /// its energy.
    pub(super) fn led_off(&self, record: &Record, nearest: &Nearest) -> bool {
        let apart = (self.energy_pn_nm - energy_of(record, nearest)).abs();
        apart <= REST * self.energy_pn_nm.abs() + LEAST
    }
}

fn energy_of(record: &Record, nearest: &Nearest) -> f64 {
    record.potential_pn_nm() - nearest.energy_above
}

pub(super) fn is_saddle(certificate: &Certificate) -> bool {
    matches!(certificate.stability(), Stability::Saddle { .. })
}

pub(super) fn saddle(certificate: &Certificate, leave_saddles: usize, way: &str) -> SceneProblem {
    let rule = format!(
        "the run ends on a saddle, an unstable equilibrium: the stiffness has {} negative \
         eigenvalue(s); {way}",
        certificate.negative
    );
    SceneProblem::new("task.leave_saddles", leave_saddles, rule)
}
