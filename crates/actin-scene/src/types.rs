//! Main types of a scene: filaments, clamps, paths and tasks.

use super::model::{JunctionModel, Monomers, RodModel};
use super::{
    Bead, Brownian, DragModel, End, Imperfection, Linker, Load, Observable, Output, PeriodicBox,
    Quantity, Repulsion, Sections, Shape, Start, Thermal, scene_file::SceneFile,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A scene: filaments, clamps, loads, linkers and a task.
///
/// The text has a single filament as `filament` or a list as `filaments`. Clamps, loads, linkers and settings
/// refer to a filament by its index, 0 by default. Only linkers and `repulsion` act between filaments.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SceneFile", into = "SceneFile")]
pub struct Scene {
    /// Title.
    pub title: String,
    /// Filament 0.
    pub filament: Filament,
    /// Filaments 1, 2 and so on.
    pub other_filaments: Vec<Filament>,
    /// Clamped ends. All other ends are free.
    pub clamps: Vec<Clamp>,
    /// Forces and couples.
    pub loads: Vec<Load>,
    /// Springs from sites to fixed points or to other sites.
    pub linkers: Vec<Linker>,
    /// Beads on filaments.
    pub beads: Vec<Bead>,
    /// Repulsion of filaments from each other and from walls.
    pub repulsion: Option<Repulsion>,
    /// Periodic box and its shear.
    pub periodic: Option<PeriodicBox>,
    /// Stages that change load factors and move clamped ends and anchors.
    pub path: Vec<Stage>,
    /// Quantities computed for every record.
    pub observe: Vec<Observable>,
    /// Initial time (ns) that means exclude; by default a fifth of the duration.
    pub burn_in_ns: Option<f64>,
    /// Optional output files.
    pub output: Output,
    /// Initial state; by default filaments as built, at rest.
    pub start: Option<Start>,
    /// Computation to run.
    pub task: Task,
}

impl Scene {
    /// Creates a scene of a free filament without loads.
    ///
    /// ```
    /// use actin_scene::{Clamp, End, Equilibrium, Filament, Load, Scene, Section};
    /// let filament = Filament::new(vec![
    ///     Section::ellipsoids(0.0, 40.0),
    ///     Section::rod(40.0, 160.0, None),
    /// ]);
    /// let scene = Scene::new(filament, Equilibrium::default())
    ///     .clamp(Clamp::new(End::Start))
    ///     .load(Load::end_force(End::End, [0.1, 0.0, 0.0]));
    /// scene.validate()?;
    /// # Ok::<(), actin_scene::SceneProblem>(())
    /// ```
    pub fn new(filament: Filament, task: impl Into<Task>) -> Self {
        Self {
            title: String::new(),
            filament,
            other_filaments: Vec::new(),
            clamps: Vec::new(),
            loads: Vec::new(),
            linkers: Vec::new(),
            beads: Vec::new(),
            repulsion: None,
            periodic: None,
            path: Vec::new(),
            observe: Vec::new(),
            burn_in_ns: None,
            output: Output::default(),
            start: None,
            task: task.into(),
        }
    }
}

/// Stage of a path: controls that change together from their current to their target values.
///
/// Shifts and turns start at zero. A load that any stage sets starts at factor 0. A path that sets loads must
/// set all loads without a `factor`. Along other paths loads act in full from the start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Stage {
    /// Target values at the end of the stage. The last setting of a control counts.
    pub set: Vec<Setting>,
    /// Duration of the stage; required and positive in `Dynamics` and `Brownian`, ignored in `Equilibrium`. The
    /// sum over all stages is at most the duration of the task.
    #[serde(default)]
    pub duration_ns: Option<f64>,
    /// Time course of the controls. `Equilibrium` ignores it.
    #[serde(default)]
    pub pace: TimeCourse,
}

/// Time course of the controls of a stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "Pace")]
pub enum TimeCourse {
    /// Smooth ramp, with zero velocity and acceleration at both ends.
    #[default]
    Smooth,
    /// Constant velocity. The velocity of clamped ends jumps at the start and end of the stage.
    Steady,
}

/// Value of a control at the end of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Setting {
    /// Factor of a load.
    LoadFactor {
        /// Index of the load in `loads`, from 0.
        load: usize,
        /// Factor at the end of the stage; finite.
        factor: f64,
    },
    /// Displacement of a clamped end from its position as built.
    Shift {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// End of the filament; it must be clamped.
        end: End,
        /// Displacement in the lab frame; finite, without a component along directions in which the clamp
        /// slides.
        shift_nm: [f64; 3],
    },
    /// Rotation of a clamped end about the clamped point, relative to its orientation as built.
    Turn {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// End of the filament; it must be clamped.
        end: End,
        /// Rotation vector in the lab frame; finite, of any length. Lab z is the axis of a filament without a
        /// `direction`. With a `shape` the axis of an end is the tangent of the curve there, and rotations
        /// about other axes tilt the end. In `Dynamics` and `Brownian` an end that slides `AlongAxis` may turn
        /// only about its axis, and an end that slides `Freely` may not turn.
        turn_deg: [f64; 3],
    },
    /// Factor of the strain of the periodic box.
    Shear {
        /// Factor at the end of the stage; finite.
        factor: f64,
    },
    /// Displacement of the anchor of a linker from its position as built.
    Anchor {
        /// Index of the linker in `linkers`, from 0; it must have an anchor.
        linker: usize,
        /// Displacement in the lab frame; finite.
        shift_nm: [f64; 3],
    },
}

/// A filament: sections, parameters of their models, and position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Filament {
    /// Sections in order of arc length, at least one. The first starts at 0, and each other at the end of the
    /// previous one. Adjacent sections differ in kind or in `altered`. Write `Adaptive(..)` for an automatic
    /// choice, or `Following(..)` for sections that follow a motion.
    pub sections: Sections,
    /// Parameters of the monomers. Sections can change them with `altered`.
    #[serde(default)]
    pub monomers: Monomers,
    /// Parameters of the rods. Sections can change them with `altered`.
    #[serde(default)]
    pub rod: RodModel,
    /// Parameters of the junctions between monomers and rods.
    #[serde(default)]
    pub junction: JunctionModel,
    /// Position of arc length 0 (lab frame); finite.
    #[serde(default)]
    pub at_nm: [f64; 3],
    /// Direction of the filament (lab frame); any length except zero.
    #[serde(default = "along_z")]
    pub direction: [f64; 3],
    /// Rotation about the axis, right-handed; finite. With 0, the shortest rotation from lab z to `direction`
    /// rotates lab +x to azimuth 0.
    #[serde(default)]
    pub roll_deg: f64,
    /// Curve along which the filament is built; by default straight. A filament with another rest shape starts
    /// under stress.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Shape>,
    /// Small initial displacement from the axis.
    #[serde(default)]
    pub imperfection: Option<Imperfection>,
}

pub(super) fn along_z() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

/// Clamped end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Clamp {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// End of the filament. Each end has at most one clamp.
    pub end: End,
    /// Constrained degrees of freedom. Ends with monomers support only `Wall`.
    #[serde(default)]
    pub hold: Hold,
    /// Rotational spring of a pinned end. Requires `hold: Pin`.
    #[serde(default)]
    pub hinge: Option<Hinge>,
    /// Directions in which the end can move as a rigid body.
    #[serde(default)]
    pub slides: FreeTranslation,
}

/// Rotational spring between the cross-section at a pinned end and a frame that the path may turn. Its energy
/// is `(k_b (theta_1^2 + theta_2^2) + k_t theta_3^2) / 2`. Here `theta` is the rotation vector between them,
/// with the third component along the filament. A run fails if the angle reaches half a turn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Hinge {
    /// Stiffness `k_b` of rotation about transverse axes; positive.
    pub bend_pn_nm_per_rad: f64,
    /// Stiffness `k_t` of rotation about the filament axis; positive.
    pub twist_pn_nm_per_rad: f64,
}

/// Directions in which a clamped end can move as a rigid body. Its orientation is fixed unless it is pinned. A
/// force on a sliding end is a constant end load.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "Slides")]
pub enum FreeTranslation {
    /// Fixed position.
    #[default]
    Nowhere,
    /// Along the axis as built; with a `shape` along the tangent of the curve at this end.
    AlongAxis,
    /// All directions: only the orientation is fixed.
    Freely,
}

/// Constrained degrees of freedom of a clamped end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Hold {
    /// Rod: the last node, and a wall frame joined to the last segment by half a segment of bending. Monomers:
    /// the last two.
    #[default]
    Wall,
    /// Rod only: the last node and the last segment's frame.
    NodeAndFrame,
    /// Rod only: the last two nodes and the last segment's frame.
    TwoNodesAndFrame,
    /// Rod only: the last node. The end rotates freely, or against the spring of a `hinge`. It may slide
    /// `AlongAxis` but not `Freely`. To pin monomers, write a linker of rest length 0 from a site on the axis
    /// to an anchor.
    Pin,
}

/// Computation to run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Task {
    /// Motion with inertia.
    Dynamics(Dynamics),
    /// Overdamped motion in a fluid.
    Brownian(Brownian),
    /// Equilibrium by Newton's method. Rods require `EnergyGradient`.
    Equilibrium(Equilibrium),
}

/// Equilibrium, or equilibria along the path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Equilibrium {
    /// Tolerance of the residual force on a free body; positive, below half of every load.
    pub force_pn: f64,
    /// Tolerance of the residual torque on a free body; positive.
    pub torque_pn_nm: f64,
    /// Largest number of Newton iterations for an equilibrium; at least 1.
    pub iterations: usize,
    /// Largest step along a stage, as a fraction of the stage; positive, at most 1.
    pub largest_step: f64,
    /// Smallest step, below which the path ends; positive, at most `largest_step`.
    pub smallest_step: f64,
    /// Largest number of times an equilibrium leaves a saddle along its lowest mode. Slow solves from symmetric
    /// states are displaced in the same way, without a limit. With 0 nothing is displaced and the path follows
    /// saddles. A run whose last equilibrium is a saddle fails, and its results are written.
    pub leave_saddles: usize,
    /// True if the path continues after a large jump to another equilibrium; otherwise it ends there. Small
    /// jumps are only counted.
    pub accept_jumps: bool,
    /// True if the lowest eigenvalue of the final stiffness is computed, without neutral modes.
    pub lowest_eigenvalue: bool,
    /// Number of random starts of a search for further stable states; at most 10,000. Starts are distributed
    /// around the final equilibrium and the states found. `summary.json` lists the states by energy, and
    /// `other_states.npz` contains them. States that lost a turn in the search are excluded.
    pub states: usize,
    /// Quantity whose error relative to a filament of monomers is estimated: `model_error` in `summary.json`,
    /// and its scatter with sampled bonds (`drawn_bonds`). Requires a single straight filament.
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

/// Motion with inertia, with optional drag.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Dynamics {
    /// Simulated time; positive, at least the duration of the path. The run ends earlier if `stop` is met.
    pub duration_ns: f64,
    /// Integrator. Must be omitted in a fluid.
    #[serde(default)]
    pub integrator: Integrator,
    /// Largest time step; positive, at most the stability limit. By default the limit times `step_safety`.
    /// Steps are shortened to fit a whole number into the duration and into the interval between records.
    #[serde(default)]
    pub time_step_ns: Option<f64>,
    /// Ratio of the default time step to the estimated stability limit; greater than 0, below 1.
    #[serde(default = "default_step_safety")]
    pub step_safety: f64,
    /// True if a time step above the estimated stability limit is accepted.
    #[serde(default)]
    pub allow_unstable_step: bool,
    /// Numerical damping as `(translational_per_ns: 1.0, rotational_per_ns: 1.0)`, or a fluid as
    /// `Water(viscosity_mpa_s: 0.89)`; by default no drag. Steps in a fluid follow Gronbech-Jensen and Farago
    /// (2013), which permits any drag.
    #[serde(default)]
    pub drag: DragModel,
    /// Thermal noise. Requires a fluid, or positive damping rates. Must be omitted with `stop`.
    #[serde(default)]
    pub thermal: Option<Thermal>,
    /// Tolerances of rest, at which the motion stops early.
    #[serde(default)]
    pub stop: Option<StopTolerances>,
    /// Largest number of times a motion at rest on a saddle is displaced along its lowest mode. The largest
    /// displacement is 0.01 nm or 1e-3 rad. With 0 a run that ends on a saddle fails, and its results are
    /// written. Not available with `thermal` or `PaperBalance`.
    #[serde(default)]
    pub leave_saddles: usize,
    /// Time between recorded states; positive. By default about a hundredth of the duration.
    #[serde(default)]
    pub record_every_ns: Option<f64>,
}

pub(super) const STEP_SAFETY: f64 = 0.5;

fn default_step_safety() -> f64 {
    STEP_SAFETY
}

impl Dynamics {
    /// Creates a motion of this duration (ns) without drag and noise, with default steps and records.
    pub fn new(duration_ns: f64) -> Self {
        Self {
            duration_ns,
            integrator: Integrator::default(),
            time_step_ns: None,
            step_safety: STEP_SAFETY,
            allow_unstable_step: false,
            drag: DragModel::default(),
            thermal: None,
            stop: None,
            leave_saddles: 0,
            record_every_ns: None,
        }
    }

    /// Returns whether the task has drag.
    pub fn has_drag(&self) -> bool {
        let rates = self.drag.rates();
        let rates = [rates.translational_per_ns, rates.rotational_per_ns];
        self.drag.fluid().is_some() || rates.iter().any(|rate| *rate > 0.0)
    }
}

/// Integrator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Integrator {
    /// Position Verlet: order 2, one force evaluation per step.
    PositionVerlet,
    /// Position-extended Forest-Ruth-like: order 4, four force evaluations per step.
    #[default]
    Pefrl,
    /// Velocity-extended Forest-Ruth-like: order 4, four force evaluations per step.
    Vefrl,
    /// Forest and Ruth: order 4, three force evaluations per step.
    ForestRuth,
    /// Suzuki's five-fold composition of position Verlet: order 4, five force evaluations per step.
    Suzuki,
}

/// Tolerances of rest. The motion stops when all three are met.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "StopRule")]
pub struct StopTolerances {
    /// Largest force on a free body; positive, below half of every load.
    pub force_pn: f64,
    /// Largest torque on a free body; positive.
    pub torque_pn_nm: f64,
    /// Kinetic energy of the free bodies; positive.
    pub kinetic_pn_nm: f64,
}
