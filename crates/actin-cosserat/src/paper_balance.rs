//! Force law as printed in the paper.

use crate::energy_gradient::write_bending_energies;
use crate::{
    BendingElement, End, RodError, RodLayout, RodMaterial, SegmentCurvature, ShearElement,
    TwistStretch,
};
use actin_mechanics::{Interaction, Loads, State, UnitQuaternion, Vector3};

/// Interaction `rod` with the balance equations as printed in the paper; not conservative.
///
/// ```text
/// segment:  force Q n / e on the first node, -Q n / e on the second
///           torque |lhat| Q^T t x n on the frame
/// bending:  torques (m + Dhat kappa x m / 2) / E^3 on the first frame
///           and (-m + Dhat kappa x m / 2) / E^3 on the second
/// e = |l|/|lhat|,  t = l/|l|,  n = S sigma,  m = B kappa,  E = D/Dhat
/// ```
///
/// `D` is the mean of the present lengths of the two segments, or half a length at a wall.
///
/// Differences from the printed equations: `kappa = log(Qi^T Qj)/Dhat` has the sign of the paper's
/// continuous curvature, because its discrete curvature would amplify bending. The inertia is
/// constant.
///
/// Forces balance exactly. The residual moment is `(xi - 1) |lhat| t x n` per segment with an
/// extension, and `theta^3 m / 12` per bending element unless `m` is parallel to the angle `theta`.
/// The energy equals the energy of [`EnergyGradient`](crate::EnergyGradient) at `l / xi`; the loads
/// differ from its gradient to first order in the strain.
///
/// # Source
/// arXiv 2203.01284, Section 2.2, after Gazzola et al. (2018).
#[derive(Clone, Debug)]
pub struct PaperBalance {
    layout: RodLayout,
    material: RodMaterial,
    extension: Option<(TwistStretch, SegmentCurvature)>,
}

impl PaperBalance {
    /// Creates the rod.
    ///
    /// # Errors
    /// If the material is a potential.
    pub fn new(layout: RodLayout, material: RodMaterial) -> Result<Self, RodError> {
        if material.potential().is_some() {
            return Err(RodError::Potential("PaperBalance"));
        }
        Ok(Self {
            layout,
            material,
            extension: None,
        })
    }

    /// Scales `e` and `E` by `1/xi` as printed, without a conjugate torque.
    #[must_use]
    pub fn with_extension(self, law: TwistStretch, curvature: SegmentCurvature) -> Self {
        Self {
            extension: Some((law, curvature)),
            ..self
        }
    }

    /// Vector of segment `k` (nm, lab frame) divided by its `xi`.
    #[inline]
    fn scaled_vector(&self, k: usize, state: &State) -> Vector3 {
        let i = self.layout.points().start + k;
        let l = state.points.position.get(i + 1) - state.points.position.get(i);
        match &self.extension {
            None => l,
            Some((law, curvature)) => {
                let twist = curvature.mean(k, state).z - self.material.rest_curvature().z;
                l / (1.0 + law.extension(twist))
            }
        }
    }

    #[inline]
    fn add_segment(&self, k: usize, state: &State, loads: &mut Loads) {
        let (i, frame) = (
            self.layout.points().start + k,
            self.layout.frames().start + k,
        );
        let rest_length = self.layout.segment_lengths()[k];
        let l = self.scaled_vector(k, state);
        let q = state.frames.orientation.get(frame);
        let inverse_extension = rest_length / l.norm();
        // Both printed loads are the loads of the energy divided by e.
        let shear = ShearElement::segment(rest_length).loads(&self.material, q, l);
        loads.force.add(i, shear.force * inverse_extension);
        loads.force.add(i + 1, -shear.force * inverse_extension);
        loads.torque.add(frame, shear.torque * inverse_extension);
    }

    /// Extension `E` of bending element `j`.
    #[inline]
    fn voronoi_extension(&self, j: usize, state: &State) -> f64 {
        let walls = usize::from(self.layout.wall(End::Start).is_some());
        let half_length = |segment| 0.5 * self.scaled_vector(segment, state).norm();
        // Element j joins the frames of these segments; at a wall one of them is missing.
        let before = j.checked_sub(walls);
        let after = Some(j + 1 - walls).filter(|&segment| segment < self.layout.segments());
        let present = before.map_or(0.0, half_length) + after.map_or(0.0, half_length);
        present / self.layout.voronoi_lengths()[j]
    }
}

/// Printed torques of a bending element at `E = 1`.
#[inline]
fn printed_couples(
    element: BendingElement,
    material: &RodMaterial,
    (qa, qb): (UnitQuaternion, UnitQuaternion),
) -> (Vector3, Vector3) {
    let kappa = element.curvature(qa, qb);
    let m = material.bending_couple(kappa);
    let half = 0.5 * element.rest_distance * kappa.cross(&m);
    (half + m, half - m)
}

impl Interaction for PaperBalance {
    fn term(&self) -> &'static str {
        "rod"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for k in 0..self.layout.segments() {
            self.add_segment(k, state, loads);
        }
        let distances = self.layout.voronoi_lengths().iter();
        let chain = self.layout.bending_chain();
        for (j, (&rest_distance, a)) in distances.zip(chain).enumerate() {
            let q = &state.frames.orientation;
            let element = BendingElement { rest_distance };
            let frames = (q.get(a), q.get(a + 1));
            let (first, second) = printed_couples(element, &self.material, frames);
            let factor = self.voronoi_extension(j, state).powi(-3);
            loads.torque.add(a, first * factor);
            loads.torque.add(a + 1, second * factor);
        }
    }

    fn elements(&self) -> usize {
        self.layout.elements()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        let (layout, material) = (&self.layout, &self.material);
        assert_eq!(energies.len(), layout.elements(), "one energy per element");
        let (shear, bending) = energies.split_at_mut(layout.segments());
        let lengths = layout.segment_lengths().iter();
        for (k, (energy, &length)) in shear.iter_mut().zip(lengths).enumerate() {
            let q = state.frames.orientation.get(layout.frames().start + k);
            let l = self.scaled_vector(k, state);
            *energy = ShearElement::segment(length).energy(material, q, l);
        }
        write_bending_energies(layout, material, state, bending);
    }

    fn is_conservative(&self) -> bool {
        false
    }
}
