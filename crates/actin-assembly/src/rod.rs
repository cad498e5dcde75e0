//! Rods of an assembly with their laws.

use actin_cosserat::{
    BendLaw, JoinedElement, RodLayout, RodMaterial, SegmentCurvature, SegmentLaw, ShearElement,
    TwistStretch,
};
use actin_mechanics::{State, Vector3};

/// Largest ratio of a segment to the persistence length at which overdamped steps of the relaxation time of a segment
/// are accurate to 1 %.
///
/// # Source
/// Table of `actin_brownian::Brownian`.
pub const COARSE_IN_HEAT: f64 = 0.02;

/// Rod with its laws and their ranges.
#[derive(Debug)]
pub(crate) struct Rod {
    /// Index of its section.
    pub section: usize,
    pub layout: RodLayout,
    pub material: RodMaterial,
    /// Ranges of the data of the laws.
    pub ranges: Ranges,
    /// Elements that join the start and the end to the frames of junctions.
    pub joined: [Vec<JoinedElement>; 2],
    /// Monitor of twist stability, where an axial force can destabilise the twist.
    pub twist_watch: Option<TwistWatch>,
}

impl Rod {
    pub(crate) fn longest_segment(&self) -> f64 {
        let lengths = self.layout.segment_lengths().iter();
        lengths.copied().fold(0.0, f64::max)
    }

    /// Ratio of the longest segment to the persistence length at the thermal energy `kt` (pN nm).
    pub(crate) fn over_persistence_length(&self, kt: f64) -> f64 {
        let bend = self.material.bending_tangent(Vector3::zeros());
        kt * self.longest_segment() / bend[(0, 0)].min(bend[(1, 1)])
    }
}

/// Law of a monitored rod and its end conditions.
#[derive(Debug)]
pub(crate) struct TwistWatch {
    pub(crate) law: SegmentLaw,
    pub(crate) curvature: SegmentCurvature,
}

impl TwistWatch {
    /// Strain of segment `k` in its law, and mean curvature around it (rad/nm).
    pub(crate) fn strains(&self, rod: &Rod, k: usize, state: &State) -> (Vector3, Vector3) {
        let layout = &rod.layout;
        let (i, frame) = (layout.points().start + k, layout.frames().start + k);
        let x = &state.points.position;
        let element = ShearElement::segment(layout.segment_lengths()[k]);
        let sigma = element.strain(state.frames.orientation.get(frame), x.get(i + 1) - x.get(i));
        let across = self.curvature.shear_factor(k);
        let sigma = sigma.component_mul(&Vector3::new(across, across, 1.0));
        (sigma, self.curvature.mean(k, state))
    }

    /// Tangent of the twist of segment `k` (pN nm^2).
    pub(crate) fn tangent(&self, rod: &Rod, k: usize, state: &State) -> f64 {
        let (sigma, kappa) = self.strains(rod, k, state);
        self.law.twist_tangent(&rod.material, sigma, kappa)
    }
}

/// Ranges of the data of the laws of a rod; `None` without a bound.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ranges {
    pub(crate) twist: Option<f64>,
    pub(crate) curvature: Option<f64>,
    pub(crate) shear: Option<f64>,
    /// Lower (compression) and upper (tension) bound.
    pub(crate) stretch: Option<[f64; 2]>,
}

impl Ranges {
    pub(crate) fn new(material: &RodMaterial, length: Option<&TwistStretch>) -> Self {
        let finite = |bound: f64| Some(bound).filter(|bound| bound.is_finite());
        if let Some(law) = material.potential() {
            let range = law.range();
            return Self {
                twist: finite(range.twist),
                curvature: finite(range.curvature),
                shear: finite(range.shear),
                stretch: Some(range.stretch).filter(|bounds| bounds.iter().all(|b| b.is_finite())),
            };
        }
        let laws = material.laws();
        let twist = laws.and_then(|laws| laws.twist().range());
        let both = twist.into_iter().chain(length.map(TwistStretch::range));
        Self {
            twist: both.reduce(f64::min).and_then(finite),
            curvature: laws.and_then(|laws| BendLaw::range(laws.bend())),
            ..Self::default()
        }
    }
}
