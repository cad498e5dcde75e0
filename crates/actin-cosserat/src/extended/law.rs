//! Coupling of a segment's strain to the curvature around it.

use crate::law::Jet;
use crate::material::Kind;
use crate::{BendLaw, RodMaterial, Stiffening, StrainLaws, TwistStretch};
use actin_mechanics::{Matrix3, Vector3};

/// Energy per rest length of a segment as a function of its strain and the mean curvature around
/// it.
///
/// ```text
/// W(sigma, xi(kappa_3) - 1) + U(kappa, gamma) - U(kappa, 0)      (laws)
/// W(sigma, kappa) - U(kappa)                                     (potential)
/// ```
///
/// `W` is the energy of shear and of stretch beyond the natural extension `xi - 1`. `U` is the
/// bending energy with stiffening by shear `gamma`; `U(kappa, 0)` belongs to the nodes. For a
/// potential, `U` is `Homogenised::joint_energy`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SegmentLaw {
    twist_stretch: Option<TwistStretch>,
    stiffening: Option<Stiffening>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct MeanCurvature {
    pub(crate) kappa: Vector3,
    /// Share of the segment's length covered by bending elements.
    pub(crate) covered: f64,
}

impl MeanCurvature {
    /// Mean for a segment with neighbours on both sides.
    pub(crate) const fn inside(kappa: Vector3) -> Self {
        Self {
            kappa,
            covered: 1.0,
        }
    }

    #[inline]
    fn beyond_rest_of(self, material: &RodMaterial) -> Self {
        Self {
            kappa: self.kappa - material.rest_curvature(),
            ..self
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct SegmentJet {
    /// Derivative with respect to strain (pN).
    pub(crate) force: Vector3,
    /// Derivative with respect to curvature (pN nm).
    pub(crate) couple: Vector3,
    pub(crate) by_strain: Matrix3,
    /// Rows belong to the strain.
    pub(crate) mixed: Matrix3,
    pub(crate) by_curvature: Matrix3,
}

impl SegmentJet {
    /// Transforms to a strain whose components times `factors` are the argument of the law.
    pub(super) fn of_scaled(self, factors: Vector3) -> Self {
        Self {
            force: self.force.component_mul(&factors),
            by_strain: self
                .by_strain
                .component_mul(&(factors * factors.transpose())),
            mixed: self
                .mixed
                .component_mul(&Matrix3::from_columns(&[factors; 3])),
            ..self
        }
    }
}

impl SegmentLaw {
    /// Returns the coupling of a material with a law of twist and stretch, or `None` without
    /// coupling. A potential ignores `twist_stretch`.
    pub fn from_material(
        material: &RodMaterial,
        twist_stretch: Option<TwistStretch>,
    ) -> Option<Self> {
        let Some(laws) = material.laws() else {
            return Some(Self::default());
        };
        let stiffening = match laws.bend() {
            BendLaw::Stiffening(law) if law.shear.is_finite() => Some(*law),
            _ => None,
        };
        (twist_stretch.is_some() || stiffening.is_some()).then_some(Self {
            twist_stretch,
            stiffening,
        })
    }

    /// Law of twist and stretch.
    pub(crate) fn twist_stretch(&self) -> Option<&TwistStretch> {
        self.twist_stretch.as_ref()
    }

    pub(crate) fn stiffening(&self) -> Option<&Stiffening> {
        self.stiffening.as_ref()
    }

    /// Second derivatives with respect to curvature of the energy of stiffening by shear (pN nm^2).
    pub(super) fn shear_by_curvature(&self, sigma: Vector3, kappa: Vector3) -> Matrix3 {
        let added = (self.stiffening.as_ref()).map(|law| Stiffened::new(law, sigma, kappa));
        added.map_or_else(Matrix3::zeros, |stiffened| stiffened.by_curvature())
    }

    /// Natural extension `xi - 1` at twist `k3`, with two derivatives.
    #[inline]
    pub(super) fn extension(&self, k3: f64) -> [f64; 3] {
        self.twist_stretch.map_or([0.0; 3], |law| law.jet(k3))
    }

    /// Force (pN) and torque (pN nm) at strain `sigma` and mean curvature.
    #[inline]
    pub(crate) fn loads(
        &self,
        material: &RodMaterial,
        sigma: Vector3,
        curvature: MeanCurvature,
    ) -> (Vector3, Vector3) {
        let curvature = curvature.beyond_rest_of(material);
        match material.kind() {
            Kind::Laws(laws) => self.loads_of(laws, sigma, curvature.kappa),
            Kind::Potential(law) => law.segment_loads(sigma, curvature),
        }
    }

    #[inline]
    fn loads_of(
        &self,
        material: &StrainLaws,
        sigma: Vector3,
        kappa: Vector3,
    ) -> (Vector3, Vector3) {
        let [extension, slope, _] = self.extension(kappa.z);
        let mut force = material.shear_force_beyond(sigma, extension);
        let (strain, ..) = material.length_strain(sigma);
        let pull = material.stretch().force(strain - extension);
        let mut couple = Vector3::new(0.0, 0.0, -pull * slope);
        if let Some(law) = &self.stiffening {
            let stiffened = Stiffened::new(law, sigma, kappa);
            force += stiffened.force();
            couple += stiffened.couple();
        }
        (force, couple)
    }

    pub(crate) fn energy(
        &self,
        material: &RodMaterial,
        sigma: Vector3,
        curvature: MeanCurvature,
    ) -> f64 {
        let curvature = curvature.beyond_rest_of(material);
        let material = match material.kind() {
            Kind::Laws(laws) => laws,
            Kind::Potential(law) => return law.segment_energy(sigma, curvature),
        };
        let kappa = curvature.kappa;
        let [extension, ..] = self.extension(kappa.z);
        let own = material.shear_energy_beyond(sigma, extension);
        let added = (self.stiffening.as_ref()).map(|law| Stiffened::new(law, sigma, kappa));
        own + added.map_or(0.0, |stiffened| stiffened.added.value)
    }

    pub(crate) fn jet(
        &self,
        material: &RodMaterial,
        sigma: Vector3,
        curvature: MeanCurvature,
    ) -> SegmentJet {
        let curvature = curvature.beyond_rest_of(material);
        match material.kind() {
            Kind::Laws(laws) => self.jet_of(laws, sigma, curvature.kappa),
            Kind::Potential(law) => law.segment_jet(sigma, curvature),
        }
    }

    fn jet_of(&self, material: &StrainLaws, sigma: Vector3, kappa: Vector3) -> SegmentJet {
        let [extension, slope, second] = self.extension(kappa.z);
        let (strain, along, _) = material.length_strain(sigma);
        let stretch = material.stretch();
        let (pull, rigidity) = (
            stretch.force(strain - extension),
            stretch.tangent(strain - extension),
        );
        let (force, couple) = self.loads_of(material, sigma, kappa);
        let turn = Vector3::z() * slope;
        let mut jet = SegmentJet {
            force,
            couple,
            by_strain: material.shear_tangent_beyond(sigma, extension),
            mixed: -rigidity * along * turn.transpose(),
            by_curvature: rigidity * turn * turn.transpose(),
        };
        jet.by_curvature[(2, 2)] -= pull * second;
        if let Some(law) = &self.stiffening {
            Stiffened::new(law, sigma, kappa).add_to(&mut jet);
        }
        jet
    }
}

/// Energy of stiffening by shear: `f(p, t + g) - f(p, t)`.
///
/// `p = k1^2 + k2^2`, `t = k3^2/twist^2` and `g = gamma^2/shear^2`.
struct Stiffened {
    /// Derivatives at `t + g`.
    with: Jet,
    /// Derivatives at `t + g` minus derivatives at `t`.
    added: Jet,
    /// Gradients of `p` and `t` with respect to curvature, and of `g` with respect to strain.
    of_p: Vector3,
    of_t: Vector3,
    of_g: Vector3,
    twist: f64,
    shear: f64,
}

impl Stiffened {
    #[inline]
    fn new(law: &Stiffening, sigma: Vector3, kappa: Vector3) -> Self {
        let (twist, shear) = (law.twist.powi(-2), law.shear.powi(-2));
        let p = kappa.x * kappa.x + kappa.y * kappa.y;
        let t = kappa.z * kappa.z * twist;
        let g = (sigma.x * sigma.x + sigma.y * sigma.y) * shear;
        let with = law.jet(p, t + g);
        Self {
            with,
            added: with - law.jet(p, t),
            of_p: 2.0 * Vector3::new(kappa.x, kappa.y, 0.0),
            of_t: 2.0 * twist * Vector3::new(0.0, 0.0, kappa.z),
            of_g: 2.0 * shear * Vector3::new(sigma.x, sigma.y, 0.0),
            twist,
            shear,
        }
    }

    fn force(&self) -> Vector3 {
        self.with.s * self.of_g
    }

    fn couple(&self) -> Vector3 {
        self.added.p * self.of_p + self.added.s * self.of_t
    }

    fn add_to(&self, jet: &mut SegmentJet) {
        let Self {
            with,
            of_p,
            of_t,
            of_g,
            ..
        } = self;
        let across = Vector3::new(1.0, 1.0, 0.0);
        jet.by_strain += with.ss * of_g * of_g.transpose()
            + 2.0 * with.s * self.shear * Matrix3::from_diagonal(&across);
        jet.mixed += of_g * (with.ps * of_p + with.ss * of_t).transpose();
        jet.by_curvature += self.by_curvature();
    }

    fn by_curvature(&self) -> Matrix3 {
        let Self {
            added, of_p, of_t, ..
        } = self;
        let crossed = added.ps * of_p * of_t.transpose();
        let curved = Vector3::new(added.p, added.p, added.s * self.twist);
        added.pp * of_p * of_p.transpose()
            + added.ss * of_t * of_t.transpose()
            + crossed
            + crossed.transpose()
            + 2.0 * Matrix3::from_diagonal(&curved)
    }
}
