//! Where the force along a rod makes its twist unstable.

use super::range::{of_filament, percent};
use super::{Assembly, Rod};
use actin_cosserat::{RodMaterial, SegmentCurvature, SegmentLaw, ShearElement};
use actin_mechanics::{State, Vector3};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A segment bears a force along it under which its twist is unstable.
///
/// The instability is local: how many modes of the twist grow, and how finely a rod divides into
/// parts of different twist, depends on its segments.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnstableTwist {
    /// Index of the filament.
    pub filament: usize,
    /// Index of the section in its filament.
    pub section: usize,
    /// Middle of the segment whose tangent of twist is lowest, as arc length at rest (nm).
    pub s_nm: f64,
    /// Mean twist around it (rad/nm).
    pub twist_per_nm: f64,
    /// Compression that it bears (pN); negative in tension.
    pub compression_pn: f64,
    /// Compression at which its twist becomes unstable (pN): positive where every larger
    /// compression is unstable, negative where every larger tension is.
    pub bound_pn: f64,
    /// Share of the records of the run in which the section has such a segment.
    pub share_of_records: f64,
}

impl fmt::Display for UnstableTwist {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let often = match self.share_of_records {
            1.0 => String::new(),
            share => format!(" in {} of the records", percent(share)),
        };
        let (what, sign) = if self.bound_pn < 0.0 {
            ("tension", -1.0)
        } else {
            ("compression", 1.0)
        };
        // To the digits shown, without the sign of a zero.
        let twist = (1e4 * self.twist_per_nm).round() / 1e4 + 0.0;
        write!(
            f,
            "twist is UNSTABLE{often}: {what} {:.2} pN at s = {:.1} nm{}, where the bound is {:.2} pN (twist {twist:.4} \
             rad/nm); a local instability: what follows depends on the number of segments",
            sign * self.compression_pn,
            self.s_nm,
            of_filament(self.filament),
            sign * self.bound_pn
        )
    }
}

/// What the twist of a rod's segments is watched with.
#[derive(Debug)]
pub(crate) struct TwistWatch {
    pub(crate) law: SegmentLaw,
    pub(crate) material: RodMaterial,
    pub(crate) curvature: SegmentCurvature,
}

/// The segment of a rod whose twist is least stable.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Weakest {
    tangent: f64,
    found: UnstableTwist,
}

impl Assembly {
    /// Where twist is unstable in `state` under the forces along the rods: at most once per
    /// section, where its tangent is lowest.
    ///
    /// # Source
    /// `docs/statics.md`, "Extended rods in compression".
    pub fn unstable_twist(&self, state: &State) -> Vec<UnstableTwist> {
        let rods = self.rods.iter();
        let all = rods.filter_map(|rod| self.weakest_of(rod, state));
        all.map(|weakest| weakest.found).collect()
    }

    /// The same over the records of a run: the worst for each section, with the share of the
    /// records that have it. Nothing in a heat bath, where the force along a segment fluctuates by
    /// `sqrt(kT S3 / h)`, more than any bound, and says nothing about the mean.
    pub fn unstable_twist_over<'a>(
        &self,
        states: impl IntoIterator<Item = &'a State>,
    ) -> Vec<UnstableTwist> {
        let mut all = TwistRecords::new(self);
        states.into_iter().for_each(|state| all.add(self, state));
        all.end()
    }

    /// The segment of a rod whose tangent of twist is lowest, if it is unstable there.
    fn weakest_of(&self, rod: &Rod, state: &State) -> Option<Weakest> {
        let watch = rod.twist_watch.as_ref()?;
        let segments = 0..rod.layout.segments();
        let all = segments.map(|k| (k, watch.tangent(rod, k, state)));
        let (k, tangent) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        // A potential's critical force is searched for, which takes as long as hundreds of tangents.
        if tangent > 0.0 {
            return None;
        }
        let (sigma, kappa) = watch.strains(rod, k, state);
        let stability = watch.law.twist_stability(&watch.material, sigma, kappa);
        let filament = self.filament_of_section(rod.section);
        let middle = rod.layout.element_positions()[k];
        Some(Weakest {
            tangent: stability.tangent,
            found: UnstableTwist {
                filament,
                section: rod.section - self.filaments[filament].sections.start,
                s_nm: self.sections[rod.section].from_nm + middle,
                twist_per_nm: kappa.z,
                compression_pn: -stability.tension,
                bound_pn: -(watch.law).critical_tension(&watch.material, sigma, kappa)?,
                share_of_records: 1.0,
            },
        })
    }
}

/// Looks at one state after another for where twist is unstable.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct TwistRecords {
    states: u32,
    /// For each rod in how many states its twist is unstable, and where most; nothing in a heat bath.
    worst: Vec<(u32, Option<Weakest>)>,
}

impl TwistRecords {
    pub(crate) fn new(assembly: &Assembly) -> Self {
        let rods = match assembly.scene.thermal() {
            None => assembly.rods.len(),
            Some(_) => 0,
        };
        Self {
            states: 0,
            worst: (0..rods).map(|_| (0, None)).collect(),
        }
    }

    /// Whether it looks at as many rods as `other`.
    pub(crate) fn fits(&self, other: &Self) -> bool {
        self.worst.len() == other.worst.len()
    }

    pub(crate) fn add(&mut self, assembly: &Assembly, state: &State) {
        self.states += 1;
        for (rod, (count, known)) in assembly.rods.iter().zip(&mut self.worst) {
            let Some(weakest) = assembly.weakest_of(rod, state) else {
                continue;
            };
            *count += 1;
            if (known.as_ref()).is_none_or(|known| weakest.tangent < known.tangent) {
                *known = Some(weakest);
            }
        }
    }

    /// What was found in all states.
    pub(crate) fn end(self) -> Vec<UnstableTwist> {
        let states = f64::from(self.states);
        let found = self.worst.into_iter().filter_map(|(count, weakest)| {
            weakest.map(|weakest| UnstableTwist {
                share_of_records: f64::from(count) / states,
                ..weakest.found
            })
        });
        found.collect()
    }
}

impl TwistWatch {
    /// Strain of segment `k` as its law sees it, and mean curvature around it (rad/nm).
    pub(super) fn strains(&self, rod: &Rod, k: usize, state: &State) -> (Vector3, Vector3) {
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
    fn tangent(&self, rod: &Rod, k: usize, state: &State) -> f64 {
        let (sigma, kappa) = self.strains(rod, k, state);
        self.law.twist_tangent(&self.material, sigma, kappa)
    }
}
