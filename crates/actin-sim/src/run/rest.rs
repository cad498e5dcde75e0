//! Whether a motion has come to rest, in what, and the push off a saddle.

use super::Record;
use super::unknowns::newton;
use crate::scene::{Dynamics, Equilibrium, SceneProblem};
use crate::{Assembly, Part};
use actin_equilibrium::{Certificate, Nearest, Newton, Stability, StepSize};
use actin_mechanics::System;
use serde::{Deserialize, Serialize};

/// A motion is at rest if its kinetic energy and the height of its potential energy over the
/// equilibrium next to it together are at most this share of its elastic energy: it is then within
/// a thousandth of its deformation of that equilibrium.
const REST: f64 = 1e-6;

/// Added to that (pN nm): round-off in filaments without strain.
const LEAST: f64 = 1e-9;

/// How far a push moves or turns a body at most: enough to be far above round-off, too little to
/// strain anything.
const PUSH: StepSize = StepSize {
    displacement: 0.01,
    rotation: 1e-3,
    strain: 0.0,
};

/// A push of a motion off a saddle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SaddlePush {
    /// When (ns).
    pub time_ns: f64,
    /// Potential energy of the saddle (pN nm).
    pub energy_pn_nm: f64,
    /// Number of negative eigenvalues of the stiffness there.
    pub negative_eigenvalues: usize,
    /// The lowest of them (pN/nm; turns count as displacements over 1 nm).
    pub lowest_eigenvalue: f64,
    /// Largest displacement of a body along the lowest mode (nm).
    pub displacement_nm: f64,
    /// Largest turn of a body (rad).
    pub turn_rad: f64,
}

/// Judges whether a motion is at rest.
#[derive(Debug)]
pub(super) struct RestJudge<'a> {
    assembly: &'a Assembly,
    /// Made when it is first needed: most motions still move.
    newton: Option<Newton>,
}

impl<'a> RestJudge<'a> {
    /// A judge of the motions of an assembly; none in a heat bath, where nothing comes to rest.
    pub(super) fn new(assembly: &'a Assembly, dynamics: &Dynamics) -> Option<Self> {
        let newton = None;
        (dynamics.thermal.is_none()).then_some(Self { assembly, newton })
    }

    /// The equilibrium in which a motion is at rest; None if it still moves or has no potential.
    ///
    /// A stop rule that is met settles whether it moves.
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
        // Without a potential there is nothing to be found.
        let newton = self.newton()?;
        let nearest = newton.nearest(&record.state, system.interactions());
        let nearest = nearest.ok().flatten()?;
        let height = record.kinetic_pn_nm + nearest.energy_above.abs();
        (stop_rule_met || height <= limit).then_some(nearest)
    }

    /// Energy of all interactions but loads (pN nm).
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

    /// Pushes `system`, which is at rest on the saddle `nearest`, along the lowest mode; None, with the
    /// system as it was, if there is no direction in which the energy falls.
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
    /// Whether a motion is still at the saddle off which this push led it: `nearest` has its energy.
    pub(super) fn led_off(&self, record: &Record, nearest: &Nearest) -> bool {
        let apart = (self.energy_pn_nm - energy_of(record, nearest)).abs();
        apart <= REST * self.energy_pn_nm.abs() + LEAST
    }
}

/// Potential energy (pN nm) of the equilibrium next to a record.
fn energy_of(record: &Record, nearest: &Nearest) -> f64 {
    record.potential_pn_nm() - nearest.energy_above
}

/// Whether a certificate is that of a saddle.
pub(super) fn is_saddle(certificate: &Certificate) -> bool {
    matches!(certificate.stability(), Stability::Saddle { .. })
}

/// That a run ends on a saddle, at the key that leads off it; `way` says how.
pub(super) fn saddle(certificate: &Certificate, leave_saddles: usize, way: &str) -> SceneProblem {
    let rule = format!(
        "the run ends on a saddle, where the slightest push leads away: the stiffness has {} negative \
         eigenvalue(s); {way}",
        certificate.negative
    );
    SceneProblem::new("task.leave_saddles", leave_saddles, rule)
}
