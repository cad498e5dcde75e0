//! Loads: how a scene writes them, what is asked of them, and the interactions that they are. A load of a
//! new kind is a variant here; other files ask these functions.

use super::path::UNSET;
use super::rules::show;
use super::{End, HeldEnds, Scene, SceneProblem, Slides};
use actin_mechanics::{ControlId, Interaction, PointLoad, State, Vector3};
use serde::{Deserialize, Serialize};

/// By which factor the force of a like load may differ.
const FORCE: f64 = 2.0;
/// How far its direction may be from that of the other, as a cosine.
const ALONG: f64 = 0.98;

/// A load on a filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Load {
    /// A constant force on a free end: on the last node of a rod, or half on each of the last two
    /// monomers. On an end that slides it acts on the inner held body.
    EndForce {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Which end. It must be free or slide.
        end: End,
        /// Force in the lab frame; finite. In `Equilibrium` forces along unconstrained directions must
        /// balance.
        force_pn: [f64; 3],
    },
}

impl Load {
    /// Refuses load `i` of a scene where it makes no sense.
    pub(super) fn check(
        &self,
        i: usize,
        (scene, held): (&Scene, &HeldEnds),
    ) -> Result<(), SceneProblem> {
        let Self::EndForce {
            filament,
            end,
            force_pn,
        } = self;
        let key = format!("loads[{i}]");
        scene.named_filament(&format!("{key}.filament"), *filament)?;
        if force_pn.iter().any(|f| !f.is_finite()) {
            return Err(SceneProblem::new(
                format!("{key}.force_pn"),
                show(force_pn),
                "must be finite",
            ));
        }
        let clamp = held.clamp_at(*filament, *end);
        if clamp.is_some_and(|c| scene.clamps[c].slides == Slides::Nowhere) {
            return Err(SceneProblem::new(
                format!("{key}.end"),
                show(end),
                "this end is clamped: a force on it moves nothing",
            ));
        }
        Ok(())
    }

    /// The filament that it acts on.
    pub(crate) fn filament(&self) -> usize {
        let Self::EndForce { filament, .. } = self;
        *filament
    }

    /// Its resultant force at factor 1 (pN, lab frame).
    pub(crate) fn force_pn(&self) -> Vector3 {
        let Self::EndForce { force_pn, .. } = self;
        (*force_pn).into()
    }

    /// That the size of load `i` breaks a rule.
    pub(crate) fn problem(&self, i: usize, rule: String) -> SceneProblem {
        let Self::EndForce { force_pn, .. } = self;
        SceneProblem::new(format!("loads[{i}].force_pn"), show(force_pn), rule)
    }

    /// Whether it presses its end towards the other, mostly along the `axis` of the filament, at a factor.
    pub(crate) fn presses(&self, factor: f64, axis: Vector3) -> bool {
        let Self::EndForce { end, .. } = self;
        let force = self.force_pn() * factor;
        let along = force.dot(&axis);
        let inward = if *end == End::Start { along } else { -along };
        inward > 0.5 * force.norm()
    }

    /// Whether it is like another one. Across a filament that stands on a wall all directions are one.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let (
            Self::EndForce {
                end, force_pn: f, ..
            },
            Self::EndForce {
                end: at,
                force_pn: g,
                ..
            },
        ) = (self, other);
        let norm = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let across = |v: &[f64; 3]| v[0].hypot(v[1]);
        let (sizes, cosine) = (
            norm(f) / norm(g),
            (across(f) * across(g) + f[2] * g[2]) / (norm(f) * norm(g)),
        );
        end == at && (1.0 / FORCE..=FORCE).contains(&sizes) && cosine >= ALONG
    }

    /// The interaction that it is, and the control of its factor; `tip` gives the points that end a
    /// filament.
    pub(crate) fn build<'a>(
        &self,
        state: &mut State,
        tip: impl FnOnce(usize, End) -> &'a [usize],
    ) -> (Box<dyn Interaction>, ControlId) {
        let Self::EndForce {
            filament,
            end,
            force_pn,
        } = self;
        let points = tip(*filament, *end);
        let share = 1.0 / points.len() as f64;
        let shares = points.iter().map(|&point| (point, share)).collect();
        let control = state.add_control(UNSET);
        let load = PointLoad::new(state, shares, (*force_pn).into(), control);
        (Box::new(load), control)
    }
}
