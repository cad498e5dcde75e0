//! Detection of unstable twist.

use super::Assembly;
use super::range::{of_filament, percent};
use crate::rod::Rod;
use actin_mechanics::State;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Segment whose twist is unstable under its axial force and curvature.
///
/// The instability is local: the number of unstable modes and of domains of different twist depends
/// on the segments.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnstableTwist {
    /// Index of the filament.
    pub filament: usize,
    /// Index of the section in its filament.
    pub section: usize,
    /// Arc length at rest (nm) of the middle of the segment with the lowest tangent of twist.
    pub s_nm: f64,
    /// Mean twist around the segment (rad/nm).
    pub twist_per_nm: f64,
    /// Compression of the segment (pN); negative in tension.
    pub compression_pn: f64,
    /// Mean curvature of bending around the segment (rad/nm).
    #[serde(default)]
    pub curvature_per_nm: f64,
    /// Critical compression of the twist (pN). If positive, larger compression is unstable; if
    /// negative, larger tension is. `None` without such a bound, as if the curvature alone makes
    /// the twist unstable.
    pub bound_pn: Option<f64>,
    /// Share of the records in which the section has an unstable segment.
    pub share_of_records: f64,
}

impl fmt::Display for UnstableTwist {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let often = match self.share_of_records {
            1.0 => String::new(),
            share => format!(" in {} of the records", percent(share)),
        };
        let place = format!("at s = {:.1} nm{}", self.s_nm, of_filament(self.filament));
        // Avoids the sign of a zero.
        let twist = (1e4 * self.twist_per_nm).round() / 1e4 + 0.0;
        let exceeded = |what: &str, force: f64, bound: f64| {
            format!(": {what} {force:.2} pN {place} exceeds the critical value {bound:.2} pN")
        };
        let cause = match self.bound_pn {
            None => {
                let (curvature, tension) = (self.curvature_per_nm, -self.compression_pn);
                format!(" {place}: curvature {curvature:.4} rad/nm, tension {tension:.2} pN")
            }
            Some(bound) if bound < 0.0 => exceeded("tension", -self.compression_pn, -bound),
            Some(bound) => exceeded("compression", self.compression_pn, bound),
        };
        write!(
            f,
            "twist is UNSTABLE{often}{cause} (twist {twist:.4} rad/nm); the instability is local: results depend on \
             the number of segments",
        )
    }
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Weakest {
    tangent: f64,
    found: UnstableTwist,
}

impl Assembly {
    /// Returns the segments in `state` with unstable twist under the axial forces, at most one per
    /// section with the lowest tangent.
    ///
    /// # Source
    /// `docs/numerics.md`, "Extended rods in compression".
    pub fn unstable_twist(&self, state: &State) -> Vec<UnstableTwist> {
        let rods = self.rods.iter();
        let all = rods.filter_map(|rod| self.weakest_of(rod, state));
        all.map(|weakest| weakest.found).collect()
    }

    /// Merges [`unstable_twist`](Self::unstable_twist) over the records of a run, with the share of
    /// affected records.
    ///
    /// Empty in a heat bath: there the axial force of a segment fluctuates by `sqrt(kT S3 / h)`,
    /// which exceeds any bound and does not represent the mean.
    pub fn unstable_twist_over<'a>(
        &self,
        states: impl IntoIterator<Item = &'a State>,
    ) -> Vec<UnstableTwist> {
        let mut all = TwistRecords::new(self);
        states.into_iter().for_each(|state| all.add(self, state));
        all.end()
    }

    /// Segment of a rod with the lowest tangent of twist, if it is unstable.
    fn weakest_of(&self, rod: &Rod, state: &State) -> Option<Weakest> {
        let watch = rod.twist_watch.as_ref()?;
        let segments = 0..rod.layout.segments();
        let all = segments.map(|k| (k, watch.tangent(rod, k, state)));
        let (k, tangent) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        // The critical force of a potential costs as much as hundreds of tangents.
        if tangent > 0.0 {
            return None;
        }
        let (sigma, kappa) = watch.strains(rod, k, state);
        let stability = watch.law.twist_stability(&rod.material, sigma, kappa);
        let (filament, section) = self.place_of_section(rod.section);
        let middle = rod.layout.element_positions()[k];
        Some(Weakest {
            tangent: stability.tangent,
            found: UnstableTwist {
                filament,
                section,
                s_nm: self.sections[rod.section].from_nm + middle,
                twist_per_nm: kappa.z,
                curvature_per_nm: kappa.x.hypot(kappa.y),
                compression_pn: -stability.tension,
                bound_pn: (watch.law)
                    .critical_tension(&rod.material, sigma, kappa)
                    .map(|n| -n),
                share_of_records: 1.0,
            },
        })
    }
}

/// Record of rods with unstable twist, over the states of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TwistRecords {
    states: u32,
    /// Number of unstable states of each rod and the least stable segment; empty in a heat bath.
    worst: Vec<(u32, Option<Weakest>)>,
}

impl TwistRecords {
    /// Creates an empty record.
    pub fn new(assembly: &Assembly) -> Self {
        let rods = match assembly.scene.thermal() {
            None => assembly.rods.len(),
            Some(_) => 0,
        };
        Self {
            states: 0,
            worst: (0..rods).map(|_| (0, None)).collect(),
        }
    }

    /// Returns `true` if the records belong to the same rods.
    pub fn fits(&self, other: &Self) -> bool {
        self.worst.len() == other.worst.len()
    }

    /// Adds a state.
    pub fn add(&mut self, assembly: &Assembly, state: &State) {
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

    /// Returns the least stable segment of each rod with unstable twist.
    pub fn end(self) -> Vec<UnstableTwist> {
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
