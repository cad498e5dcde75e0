//! Segments of a rod with a potential: `W(sigma, kappa) - U(kappa)`, with the mean curvature
//! `kappa` around a segment and the energy `U` of the joints (`joint.rs`).
//!
//! Half a segment at a free end has no joint and keeps its `U`, so that a rod under tension has
//! uniform strain.

use super::{Homogenised, PotentialJet, SixVector};
use crate::extended::{MeanCurvature, SegmentJet};
use crate::fast::Law;
use actin_mechanics::wide::Scalar;
use actin_mechanics::{Matrix3, Vector3};

pub(crate) const STRAIGHT: MeanCurvature = MeanCurvature::inside(Vector3::new(0.0, 0.0, 0.0));

impl Homogenised {
    /// Energy per length (pN) of a segment at strain `sigma`.
    pub(crate) fn segment_energy(&self, sigma: Vector3, curvature: MeanCurvature) -> f64 {
        let MeanCurvature { kappa, covered } = curvature;
        self.energy_density(&joined(sigma, kappa)) - covered * self.joint_energy(kappa)
    }

    /// Force (pN) and torque (pN nm): derivatives with respect to strain and curvature.
    pub(crate) fn segment_loads(
        &self,
        sigma: Vector3,
        curvature: MeanCurvature,
    ) -> (Vector3, Vector3) {
        let MeanCurvature { kappa, covered } = curvature;
        let [force, couple] = self.unrolled.segment(Scalar, sigma.into(), kappa.into());
        // Part not covered by joints.
        let own = self.joint_couple(kappa) * (1.0 - covered);
        (force.into(), Vector3::from(couple) + own)
    }

    pub(crate) fn segment_jet(&self, sigma: Vector3, curvature: MeanCurvature) -> SegmentJet {
        let MeanCurvature { kappa, covered } = curvature;
        let PotentialJet { loads, tangent, .. } = self.jet(&joined(sigma, kappa));
        let (joint_couple, joint_tangent) = self.joint_jet(kappa);
        let couple: Vector3 = loads.fixed_rows::<3>(0).into();
        let by_curvature: Matrix3 = tangent.fixed_view::<3, 3>(0, 0).into();
        SegmentJet {
            force: loads.fixed_rows::<3>(3).into(),
            couple: couple - covered * joint_couple,
            by_strain: tangent.fixed_view::<3, 3>(3, 3).into(),
            mixed: tangent.fixed_view::<3, 3>(3, 0).into(),
            by_curvature: by_curvature - covered * joint_tangent,
        }
    }
}

pub(super) fn joined(sigma: Vector3, kappa: Vector3) -> SixVector {
    SixVector::new(kappa.x, kappa.y, kappa.z, sigma.x, sigma.y, sigma.z)
}
