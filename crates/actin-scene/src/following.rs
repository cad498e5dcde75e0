//! What a scene says of sections that follow a motion: where monomers are resolved while it goes on.

use super::rules::{finite, positive, show};
use super::{Hold, Scene, SceneProblem, Task};
use serde::{Deserialize, Serialize};

/// A cell holds at least so many monomers: fewer do not tell its curvature.
const LEAST_MONOMERS: f64 = 8.0;

/// Sections that change while a motion goes on: cells of a rod, each of which is resolved into monomers where one of
/// the criteria asks for it, and becomes a rod again where none does.
///
/// Each criterion has two thresholds; between them a cell stays as it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Following {
    /// Length of the filament; positive. It is rounded to whole monomers.
    pub length_nm: f64,
    /// Where monomers are resolved; at least one criterion.
    pub monomers_where: Vec<Where>,
    /// Length of a cell, 8 rises or more; it is rounded to whole monomers.
    #[serde(default = "default_cell")]
    pub cell_nm: f64,
    /// Segments of a cell that is a rod, at least 1. Steps of `Brownian` at a temperature grow as the fourth power of their
    /// length: with one they are 1300 times longer than with six.
    #[serde(default = "default_segments")]
    pub segments: usize,
    /// Time for which a cell stays as it is after it was switched; positive.
    #[serde(default = "default_least")]
    pub least_ns: f64,
}

impl Following {
    /// A filament of this length (nm) with these criteria, cells and times by default.
    pub fn new(length_nm: f64, monomers_where: Vec<Where>) -> Self {
        Self {
            length_nm,
            monomers_where,
            cell_nm: default_cell(),
            segments: default_segments(),
            least_ns: default_least(),
        }
    }
}

/// A period of the helix: 13 monomers.
fn default_cell() -> f64 {
    36.0
}

/// Of 6 nm: lumped at their nodes, their mass resists turns of a cell 1.4 % more than that of monomers.
fn default_segments() -> usize {
    6
}

fn default_least() -> f64 {
    1.0
}

/// Where a cell is resolved into monomers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Where {
    /// By the mean curvature of the cell.
    Curvature {
        /// Above this it is resolved.
        above_per_nm: f64,
        /// Below this it becomes a rod; at least 0, less than `above_per_nm`.
        below_per_nm: f64,
    },
    /// By the size of its mean twist beyond that at rest.
    Twist {
        /// Above this it is resolved.
        above_per_nm: f64,
        /// Below this it becomes a rod; at least 0, less than `above_per_nm`.
        below_per_nm: f64,
    },
    /// By the size of its mean extension, the strain of the distance between its ends.
    Extension {
        /// Above this it is resolved.
        above: f64,
        /// Below this it becomes a rod; at least 0, less than `above`.
        below: f64,
    },
    /// By the size of the internal force, averaged over the cell.
    Force {
        /// Above this it is resolved.
        above_pn: f64,
        /// Below this it becomes a rod; at least 0, less than `above_pn`.
        below_pn: f64,
    },
    /// By the size of the internal couple, averaged over the cell: bending moment and torque.
    Couple {
        /// Above this it is resolved.
        above_pn_nm: f64,
        /// Below this it becomes a rod; at least 0, less than `above_pn_nm`.
        below_pn_nm: f64,
    },
    /// By the elastic energy per length of the cell (pN nm per nm).
    Energy {
        /// Above this it is resolved.
        above_pn: f64,
        /// Below this it becomes a rod; at least 0, less than `above_pn`.
        below_pn: f64,
    },
    /// By the elastic energy per length in units of the largest of all cells.
    LargestEnergy {
        /// Above this it is resolved; at most 1.
        above: f64,
        /// Below this it becomes a rod; at least 0, less than `above`.
        below: f64,
    },
    /// By the distance of a linker's site along the filament, which may step; of one that does not hold by none.
    Linker {
        /// Index of the linker.
        linker: usize,
        /// Closer than this to the cell it is resolved; at least 0.
        within_nm: f64,
        /// Further than this it becomes a rod; greater than `within_nm`.
        beyond_nm: f64,
    },
}

/// Checks how sections follow the motion of a scene.
pub(super) fn check_following(scene: &Scene, following: &Following) -> Result<(), SceneProblem> {
    let key = |name: &str| format!("filament.sections.{name}");
    positive(&key("length_nm"), following.length_nm)?;
    positive(&key("cell_nm"), following.cell_nm)?;
    positive(&key("least_ns"), following.least_ns)?;
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

fn check_where(scene: &Scene, key: &str, criterion: &Where) -> Result<(), SceneProblem> {
    if let Where::Linker { linker, .. } = *criterion
        && linker >= scene.linkers.len()
    {
        let rule = format!("the scene has {} linker(s)", scene.linkers.len());
        return Err(SceneProblem::new(format!("{key}.linker"), linker, rule));
    }
    if let Where::LargestEnergy { above, .. } = *criterion
        && above > 1.0
    {
        let rule = "must be at most 1: the largest energy is the unit";
        return Err(SceneProblem::new(format!("{key}.above"), show(above), rule));
    }
    let ([lower, upper], [low, high]) = criterion.thresholds();
    finite(&format!("{key}.{upper}"), high)?;
    if low >= 0.0 && low < high {
        return Ok(());
    }
    let rule = format!("must be at least 0 and less than {upper} = {}", show(high));
    Err(SceneProblem::new(format!("{key}.{lower}"), show(low), rule))
}

impl Where {
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

/// Refuses scenes whose sections cannot follow.
fn check_scene(scene: &Scene) -> Result<(), SceneProblem> {
    let refused = |key: &str, rule: &str| {
        let rule = format!("sections that follow a motion are not known with {rule}");
        Err(SceneProblem::new(key, "", rule))
    };
    if !scene.further.is_empty() {
        return refused("filaments", "several filaments");
    }
    let mut clamps = scene.clamps.iter();
    if clamps.any(|clamp| clamp.hold != Hold::Wall || clamp.hinge.is_some()) {
        return refused("clamps", "ends that are not held by Wall, as monomers are");
    }
    if scene.repulsion.is_some() {
        return refused("repulsion", "repulsion");
    }
    match &scene.task {
        Task::Dynamics(task) if task.leave_saddles > 0 => {
            refused("task.leave_saddles", "pushes off saddles")
        }
        Task::Dynamics(_) | Task::Brownian(_) => Ok(()),
        Task::Equilibrium(_) => refused("task", "Equilibrium: it is no motion"),
    }
}
