//! What a scene says: filaments, clamps, loads and task. Where filaments are is in `place.rs`.

use super::model::{JunctionModel, Monomers, RodModel};
use super::{
    Brownian, DragModel, Imperfection, Linker, Load, Observable, Output, Quantity, Repulsion,
    Sections, Shape, Thermal, written::Written,
};
use serde::{Deserialize, Serialize};

/// A scene: filaments, what holds, loads and links them, and what is asked of them.
///
/// Its text has one filament under `filament`, or any number as a list under `filaments`. Clamps,
/// loads, linkers and settings name a filament by its index, 0 where they name none. Nothing but
/// linkers joins filaments; without `repulsion` they pass through each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Scene {
    /// What the scene shows, in words.
    pub title: String,
    /// Filament 0, which every scene has.
    pub filament: Filament,
    /// Filaments 1, 2 and so on.
    pub further: Vec<Filament>,
    /// What holds ends of filaments. Ends that are not named are free.
    pub clamps: Vec<Clamp>,
    /// What loads them.
    pub loads: Vec<Load>,
    /// Springs from sites to points outside of all filaments, or to other sites.
    pub linkers: Vec<Linker>,
    /// What keeps filaments out of each other and out of walls.
    pub repulsion: Option<Repulsion>,
    /// How controls are moved, stage by stage: loads, shifts and turns of held ends, anchors.
    pub path: Vec<Stage>,
    /// What is computed of every record.
    pub observe: Vec<Observable>,
    /// Time that means of what is observed leave out (ns); by default a fifth of the duration.
    pub burn_in_ns: Option<f64>,
    /// Which files are written.
    pub output: Output,
    /// What is asked.
    pub task: Task,
}

/// One stage of a path: controls that move together from where they are to where they are set.
///
/// Shifts and turns begin at zero. A load that some stage sets begins at factor 0. A path that sets loads sets all
/// that have no `factor` in time; along a path that sets none, they act in full from the start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Stage {
    /// What is set. Of several settings of one control the last counts.
    pub set: Vec<Setting>,
    /// Time that the stage takes in `Dynamics` and `Brownian`: required there, positive, all stages together at most
    /// the duration of the task. `Equilibrium` ignores it.
    #[serde(default)]
    pub duration_ns: Option<f64>,
    /// How controls move during that time. `Equilibrium` ignores it.
    #[serde(default)]
    pub pace: Pace,
}

/// How the controls of a stage move in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Pace {
    /// By a ramp whose velocity and acceleration are zero at both ends.
    #[default]
    Smooth,
    /// At constant velocity, which held ends have at once and lose at once.
    Steady,
}

/// The value of a control at the end of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Setting {
    /// The factor of a load, by its index in `loads`.
    LoadFactor {
        /// Index of the load in `loads`, from 0.
        load: usize,
        /// Its factor at the end of the stage; finite.
        factor: f64,
    },
    /// Displacement of a clamped end from where it was built.
    Shift {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Which end. It must be clamped.
        end: End,
        /// Displacement in the lab frame; finite, without a component along a direction in which the clamp
        /// slides.
        shift_nm: [f64; 3],
    },
    /// Turn of a clamped end from how it was built, about the clamped point.
    Turn {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Which end. It must be clamped.
        end: End,
        /// Rotation vector in the lab frame; finite, of any length. Lab z is the axis of a filament without a
        /// `direction`. With a `shape` each end has an axis of its own, the tangent of the curve there as built: a
        /// turn about anything else tilts the end too. In `Dynamics` and `Brownian` an end that slides `AlongAxis`
        /// may only turn about its axis, and one that slides `Freely` not at all.
        turn_deg: [f64; 3],
    },
    /// Displacement of a linker's anchor from where the linker puts it, by the linker's index in
    /// `linkers`. A linker between two sites has no anchor.
    Anchor {
        /// Index of the linker in `linkers`, from 0; it must have an anchor.
        linker: usize,
        /// Displacement in the lab frame; finite.
        shift_nm: [f64; 3],
    },
}

/// A filament: sections in order of arc length, the models that resolve them, and its place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Filament {
    /// Sections in order of arc length, at least one. The first starts at 0, each other where the one
    /// before it ends; neighbours are of different kinds, or `altered` differently. Or `Adaptive(..)`: the program
    /// chooses them.
    pub sections: Sections,
    /// Parameters of the monomers; sections may be `altered`.
    #[serde(default)]
    pub monomers: Monomers,
    /// Parameters of the rod; sections may be `altered`.
    #[serde(default)]
    pub rod: RodModel,
    /// Parameters of the junctions between monomers and rod.
    #[serde(default)]
    pub junction: JunctionModel,
    /// Where arc length begins (lab frame); finite.
    #[serde(default)]
    pub at_nm: [f64; 3],
    /// Direction along which the filament is built (lab frame); of any length but zero.
    #[serde(default = "along_z")]
    pub direction: [f64; 3],
    /// Turn about its axis, right-handed; finite. At 0, azimuth 0 is where the shortest turn from lab z
    /// to the direction takes lab +x.
    #[serde(default)]
    pub roll_deg: f64,
    /// The curve along which it is built; without one it is straight. What is bent and not so at rest
    /// begins under stress.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Shape>,
    /// A small displacement from the axis with which a run begins.
    #[serde(default)]
    pub imperfection: Option<Imperfection>,
}

pub(super) fn along_z() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

/// One of the two ends of a filament.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum End {
    /// Where arc length begins.
    Start,
    /// Where arc length is largest.
    End,
}

/// A clamped end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Clamp {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Which end. Each end is clamped once at most.
    pub end: End,
    /// What is held there. Monomers take `Wall` only.
    #[serde(default)]
    pub hold: Hold,
    /// A spring against turns of a pinned end; only with `hold: Pin`.
    #[serde(default)]
    pub hinge: Option<Hinge>,
    /// Along which directions the end is free to slide as one rigid body.
    #[serde(default)]
    pub slides: Slides,
}

/// A spring between the cross-section at a pinned end and a frame that a path may turn: energy
/// `(k_b (theta_1^2 + theta_2^2) + k_t theta_3^2) / 2` of the rotation vector `theta` from one to the other, its third
/// component along the filament. It is known
/// below half a turn: a run in which a hinge is turned further fails.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Hinge {
    /// Stiffness against bending aside; positive.
    pub bend_pn_nm_per_rad: f64,
    /// Stiffness against turns about the filament; positive.
    pub twist_pn_nm_per_rad: f64,
}

/// Directions along which a clamped end slides as one rigid body; it turns by itself only where it is
/// pinned. A force on an end that slides holds it at constant force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Slides {
    /// Not at all.
    #[default]
    Nowhere,
    /// Along the axis of the filament as built, lab z unless it has a direction of its own; with a `shape` along the
    /// tangent of the curve at this end as built.
    AlongAxis,
    /// Along all three axes: the end is held in orientation only.
    Freely,
}

/// What a clamp holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Hold {
    /// Rod: the last node, and a wall frame joined to the last segment by half a segment of
    /// bending. Monomers: the last two.
    #[default]
    Wall,
    /// Rod only: the last node and the last segment's frame.
    NodeAndFrame,
    /// Rod only: the last two nodes and the last segment's frame.
    TwoNodesAndFrame,
    /// Rod only: the last node, about which the end turns freely, or against the spring of a `hinge`. It
    /// slides nowhere or along the axis. (A linker of no length from a site on the axis to an anchor
    /// pins monomers.)
    Pin,
}

/// What is computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Task {
    /// Motion in time.
    Dynamics(Dynamics),
    /// Overdamped motion in a fluid.
    Brownian(Brownian),
    /// A state at rest by Newton's method, along the path if there is one. Rods need `EnergyGradient`.
    Equilibrium(Equilibrium),
}

/// An equilibrium, or equilibria along the path of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Equilibrium {
    /// Largest force left on a free body; positive, and below half of every load.
    pub force_pn: f64,
    /// Largest torque left on a free body; positive.
    pub torque_pn_nm: f64,
    /// Most Newton iterations for one equilibrium; at least 1.
    pub iterations: usize,
    /// Largest step along a stage of the path, as a share of the stage; positive, at most 1.
    pub largest_step: f64,
    /// Smallest step, below which the path ends with what it has; positive, at most `largest_step`.
    pub smallest_step: f64,
    /// How often, for one equilibrium, a saddle is left along its lowest mode. With 0 the path follows
    /// saddles. A run whose last equilibrium is a saddle fails; its results are written.
    pub leave_saddles: usize,
    /// Whether the path continues beyond a large sudden jump to another equilibrium; otherwise it ends there.
    /// Small ones are counted only.
    pub accept_jumps: bool,
    /// Whether the lowest eigenvalue of the stiffness that is not neutral is computed at the end.
    pub lowest_eigenvalue: bool,
    /// From how many starts other stable states are looked for, drawn at random about the equilibrium at the
    /// end and about those that are found; at most 10000. `summary.json` lists them by energy,
    /// `other_states.npz` holds them. States that lost a turn on the way do not count.
    pub states: usize,
    /// A number of the result whose error is estimated, against every monomer resolved: `model_error` in
    /// `summary.json`, and by how much filaments with drawn bonds scatter in it (`drawn_bonds`). Of a single straight filament.
    pub error_of: Option<Quantity>,
}

impl Default for Equilibrium {
    fn default() -> Self {
        Self {
            force_pn: 1e-7,
            torque_pn_nm: 1e-7,
            iterations: 2000,
            largest_step: 0.25,
            smallest_step: 1e-4,
            leave_saddles: 3,
            accept_jumps: false,
            lowest_eigenvalue: false,
            states: 0,
            error_of: None,
        }
    }
}

/// Motion in time, with drag if asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Dynamics {
    /// Simulated time, less if the stop rule is met before; positive, at least what the path takes.
    pub duration_ns: f64,
    /// Integrator.
    #[serde(default)]
    pub integrator: Integrator,
    /// Longest time step; positive, at most the stability limit. By default the limit times
    /// `step_safety`. Steps are shortened so that whole ones make up the duration and the interval of
    /// records.
    #[serde(default)]
    pub time_step_ns: Option<f64>,
    /// Default time step over the estimated stability limit; greater than 0, below 1.
    #[serde(default = "default_step_safety")]
    pub step_safety: f64,
    /// Whether a time step above the estimated stability limit is accepted.
    #[serde(default)]
    pub allow_unstable_step: bool,
    /// Numerical damping as `(translational_per_ns: 1.0, rotational_per_ns: 1.0)`, or a fluid as
    /// `Water(viscosity_mpa_s: 0.89)`; neither by default. In a fluid `integrator` is left out: steps are those of
    /// Gronbech-Jensen and Farago (2013), for which no drag is too strong.
    #[serde(default)]
    pub drag: DragModel,
    /// Thermal noise. Both rates of damping must be positive, or there is a fluid; `stop` must be left out.
    #[serde(default)]
    pub thermal: Option<Thermal>,
    /// When to stop before the duration is over.
    #[serde(default)]
    pub stop: Option<StopTolerances>,
    /// How often a motion that has come to rest on a saddle is pushed off it along its lowest mode,
    /// by 0.01 nm or 1e-3 rad, whichever a body reaches first. With 0 a run that ends on a saddle fails;
    /// its results are written. Not with `thermal`, nor with `PaperBalance`.
    #[serde(default)]
    pub leave_saddles: usize,
    /// Time between recorded states; positive. By default about a hundredth of the duration.
    #[serde(default)]
    pub record_every_ns: Option<f64>,
}

/// Default time step over the stability limit.
pub(super) const STEP_SAFETY: f64 = 0.5;

fn default_step_safety() -> f64 {
    STEP_SAFETY
}

impl Dynamics {
    /// Whether drag acts.
    pub fn has_drag(&self) -> bool {
        let rates = self.drag.rates();
        let rates = [rates.translational_per_ns, rates.rotational_per_ns];
        self.drag.fluid().is_some() || rates.iter().any(|rate| *rate > 0.0)
    }
}

/// Integrators by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Integrator {
    /// Position Verlet: order 2, one force evaluation a step.
    PositionVerlet,
    /// Position-extended Forest-Ruth-like: order 4, four evaluations.
    #[default]
    Pefrl,
    /// Velocity-extended Forest-Ruth-like: order 4, four evaluations.
    Vefrl,
    /// Forest and Ruth: order 4, three evaluations.
    ForestRuth,
    /// Suzuki's five-fold composition of position Verlet: order 4, five evaluations.
    Suzuki,
}

/// When a motion stops before its duration is over: once all three are below their tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[serde(rename = "StopRule")]
pub struct StopTolerances {
    /// Largest force on a free point; positive, and below half of every load.
    pub force_pn: f64,
    /// Largest torque on a free frame; positive.
    pub torque_pn_nm: f64,
    /// Kinetic energy of the free bodies; positive.
    pub kinetic_pn_nm: f64,
}
