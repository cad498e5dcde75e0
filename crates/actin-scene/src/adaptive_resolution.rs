//! Adaptive resolution during a motion: cells resolved into monomers where needed.

use super::rules::{check_index, show};
use super::{Hold, Scene, SceneProblem, Task};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Smallest number of monomers in a cell, below which its curvature is not well defined.
const LEAST_MONOMERS: f64 = 8.0;

/// Adaptive resolution during a motion. A cell of the rod is resolved into monomers if at least one criterion
/// requires it, and becomes a rod again if none does. Between the two thresholds of a criterion a cell keeps
/// its model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "Following")]
pub struct AdaptiveResolution {
    /// Length of the filament; positive. It is rounded to a whole number of monomers.
    pub length_nm: f64,
    /// Criteria for monomers; at least one.
    pub monomers_where: Vec<RefinementCriterion>,
    /// Length of a cell; at least 8 rises. It is rounded to a whole number of monomers.
    #[serde(default = "default_cell")]
    pub cell_nm: f64,
    /// Segments of a rod cell; at least 1. At a temperature the step of `Brownian` grows as the fourth power of
    /// the segment length.
    #[serde(default = "default_segments")]
    pub segments: usize,
    /// Shortest time between two changes of the model of a cell; positive.
    #[serde(default = "default_least")]
    pub least_ns: f64,
}

/// Period of the helix: 13 monomers.
fn default_cell() -> f64 {
    36.0
}

/// With segments of 6 nm, lumping the mass increases the rotational inertia of a cell by 1.4 %.
fn default_segments() -> usize {
    6
}

fn default_least() -> f64 {
    1.0
}

/// Criterion for resolving a cell into monomers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "Where")]
pub enum RefinementCriterion {
    /// Mean curvature of the cell.
    Curvature {
        /// A cell above this value is resolved.
        above_per_nm: f64,
        /// A cell below this value becomes a rod; at least 0, less than `above_per_nm`.
        below_per_nm: f64,
    },
    /// Magnitude of the mean twist relative to the rest twist.
    Twist {
        /// A cell above this value is resolved.
        above_per_nm: f64,
        /// A cell below this value becomes a rod; at least 0, less than `above_per_nm`.
        below_per_nm: f64,
    },
    /// Magnitude of the mean extension: the strain of the distance between the ends of the cell.
    Extension {
        /// A cell above this value is resolved.
        above: f64,
        /// A cell below this value becomes a rod; at least 0, less than `above`.
        below: f64,
    },
    /// Magnitude of the internal force, averaged over the cell.
    Force {
        /// A cell above this value is resolved.
        above_pn: f64,
        /// A cell below this value becomes a rod; at least 0, less than `above_pn`.
        below_pn: f64,
    },
    /// Magnitude of the internal moment (bending and twisting), averaged over the cell.
    Couple {
        /// A cell above this value is resolved.
        above_pn_nm: f64,
        /// A cell below this value becomes a rod; at least 0, less than `above_pn_nm`.
        below_pn_nm: f64,
    },
    /// Elastic energy per length of the cell (pN nm per nm).
    Energy {
        /// A cell above this value is resolved.
        above_pn: f64,
        /// A cell below this value becomes a rod; at least 0, less than `above_pn`.
        below_pn: f64,
    },
    /// Elastic energy per length relative to the largest of all cells.
    LargestEnergy {
        /// A cell above this value is resolved; at most 1.
        above: f64,
        /// A cell below this value becomes a rod; at least 0, less than `above`.
        below: f64,
    },
    /// Distance from the site of a linker along the filament. The site can step; an unbound linker has no effect.
    Linker {
        /// Index of the linker.
        linker: usize,
        /// A cell closer than this is resolved; at least 0.
        within_nm: f64,
        /// A cell further away than this becomes a rod; greater than `within_nm`.
        beyond_nm: f64,
    },
}

pub(super) fn check_following(
    scene: &Scene,
    following: &AdaptiveResolution,
) -> Result<(), SceneProblem> {
    let key = |name: &str| format!("filament.sections.{name}");
    let refused =
        |name: &str, value: String, rule: String| Err(SceneProblem::new(key(name), value, rule));
    let shortest = LEAST_MONOMERS * scene.filament.monomers.rise_nm;
    if following.cell_nm < shortest {
        let rule = format!("must be {shortest:.2} nm, {LEAST_MONOMERS} rises, or more");
        return refused("cell_nm", show(following.cell_nm), rule);
    }
    if following.segments == 0 {
        return refused(
            "segments",
            "0".into(),
            "a rod has at least one segment".into(),
        );
    }
    if following.monomers_where.is_empty() {
        return refused(
            "monomers_where",
            "[]".into(),
            "must be at least one criterion".into(),
        );
    }
    for (i, criterion) in following.monomers_where.iter().enumerate() {
        check_where(scene, &key(&format!("monomers_where[{i}]")), criterion)?;
    }
    check_scene(scene)
}

fn check_where(
    scene: &Scene,
    key: &str,
    criterion: &RefinementCriterion,
) -> Result<(), SceneProblem> {
    if let RefinementCriterion::Linker { linker, .. } = *criterion {
        let count = scene.linkers.len();
        check_index(&format!("{key}.linker"), "linker", linker, count)?;
    }
    if let RefinementCriterion::LargestEnergy { above, .. } = *criterion
        && above > 1.0
    {
        let rule = "must be at most 1: energies are relative to the largest";
        return Err(SceneProblem::new(format!("{key}.above"), show(above), rule));
    }
    let ([lower, upper], [low, high]) = criterion.thresholds();
    if low >= 0.0 && low < high {
        return Ok(());
    }
    let rule = format!("must be at least 0 and less than {upper} = {}", show(high));
    Err(SceneProblem::new(format!("{key}.{lower}"), show(low), rule))
}

impl RefinementCriterion {
    /// Returns the keys of the lower and the upper threshold, and their values.
    pub fn thresholds(&self) -> ([&'static str; 2], [f64; 2]) {
        match *self {
            Self::Curvature {
                above_per_nm,
                below_per_nm,
            }
            | Self::Twist {
                above_per_nm,
                below_per_nm,
            } => (
                ["below_per_nm", "above_per_nm"],
                [below_per_nm, above_per_nm],
            ),
            Self::Extension { above, below } | Self::LargestEnergy { above, below } => {
                (["below", "above"], [below, above])
            }
            Self::Force { above_pn, below_pn } | Self::Energy { above_pn, below_pn } => {
                (["below_pn", "above_pn"], [below_pn, above_pn])
            }
            Self::Couple {
                above_pn_nm,
                below_pn_nm,
            } => (["below_pn_nm", "above_pn_nm"], [below_pn_nm, above_pn_nm]),
            Self::Linker {
                within_nm,
                beyond_nm,
                ..
            } => (["within_nm", "beyond_nm"], [within_nm, beyond_nm]),
        }
    }
}

/// Checks that the scene supports `Following` sections.
fn check_scene(scene: &Scene) -> Result<(), SceneProblem> {
    let refused = |key: &str, rule: &str| {
        let rule = format!("sections that follow a motion do not support {rule}");
        Err(SceneProblem::new(key, "", rule))
    };
    if !scene.other_filaments.is_empty() {
        return refused("filaments", "several filaments");
    }
    let mut clamps = scene.clamps.iter();
    if clamps.any(|clamp| clamp.hold != Hold::Wall || clamp.hinge.is_some()) {
        return refused("clamps", "these clamps: write hold: Wall without a hinge");
    }
    if scene.repulsion.is_some() {
        return refused("repulsion", "repulsion");
    }
    match &scene.task {
        Task::Dynamics(task) if task.leave_saddles > 0 => {
            refused("task.leave_saddles", "leave_saddles: omit this key")
        }
        Task::Dynamics(_) | Task::Brownian(_) => Ok(()),
        Task::Equilibrium(_) => refused("task", "Equilibrium: write Dynamics or Brownian"),
    }
}
