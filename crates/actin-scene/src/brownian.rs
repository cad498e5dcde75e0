//! Overdamped motion in a fluid: the task `Brownian` and its validation.

use super::rules::show;
use super::{Dynamics, Filament, Flow, Scene, SceneProblem, Task, Thermal, rules};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

const LEAST_RATIO: f64 = 3.0;

const NS_PER_MS: f64 = 1e6;

/// Overdamped motion in a fluid, with steps that are implicit in the stiffness. Inertia is neglected: recorded
/// velocities are zero. Rods require `EnergyGradient`. Loads that rotate with the filament are refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Brownian {
    /// Simulated time; positive, at least the duration of the path.
    pub duration_ms: f64,
    /// Temperature of the fluid; at least 0. At 0 the motion has no noise.
    pub temperature_k: f64,
    /// Seed of the noise.
    #[serde(default)]
    pub seed: u64,
    /// Fluid and its drag on the filaments.
    #[serde(default)]
    pub drag: Fluid,
    /// Flow of the fluid, which carries filaments along.
    #[serde(default)]
    pub flow: Flow,
    /// Model of the interfaces between monomers.
    #[serde(default)]
    pub interfaces: Interfaces,
    /// Largest time step; positive. Steps are shortened to fit a whole number into the duration and into the
    /// interval between records.
    ///
    /// Default for rods at a temperature: the bending relaxation time of a segment, 180 ns for 40 nm. Means are
    /// accurate to 1 % for segments below 1/50 of the persistence length. Contacts need shorter steps (`contact-steps`). Longer
    /// segments, stages, loads, rates, shear or records can require shorter steps. Default for monomers with `QuasiHarmonic` interfaces: the step of segments of a fifth of the filament's length, at most 40
    /// nm. Default for other monomers at a temperature and with `repulsion`: 50 times the fastest relaxation
    /// time. Strains then have their thermal energy to 1 % on segments of 20 nm or more. Default at temperature
    /// 0: a twentieth of the time between records, at most a hundredth of the time in which a stage or load
    /// changes. Displacements are accurate to 0.1 %, and steps that cannot be solved are halved.
    #[serde(default)]
    pub time_step_ns: Option<f64>,
    /// Time between recorded states; positive. By default about a hundredth of the duration.
    #[serde(default)]
    pub record_every_ns: Option<f64>,
}

/// Fluid with physical drag.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Fluid {
    /// A viscous fluid.
    Water(Water),
}

/// A viscous fluid. Its drag is anisotropic and local: the drag of a cylinder of the filament's length,
/// distributed uniformly (Tirado, Lopez Martinez and Garcia de la Torre 1984).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Water {
    /// Viscosity; positive. The default is the viscosity of water at 25 degrees C.
    pub viscosity_mpa_s: f64,
    /// Radius of the cylinder; positive, at most a sixth of the length of each filament.
    pub radius_nm: f64,
    /// True if part of the transverse drag acts at the ends, so that straight filaments have the rotational
    /// drag of the cylinder.
    pub at_ends: bool,
}

/// Model of the interfaces between monomers in overdamped motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Interfaces {
    /// Bonds. Their fastest relaxation time is 0.1 ps: a microsecond takes ten million steps.
    #[default]
    Bonds,
    /// Quadratic energy with the means and covariances of the thermal motion of neighbours with bonds, which is
    /// simulated first. Requires a temperature. Time steps are ten thousand times longer than with `Bonds`. The
    /// stiffness does not change with tension, twist or bending.
    QuasiHarmonic {
        /// Duration of the simulation of the bonds; positive, at most 20,000. The default of 400 ns takes
        /// seconds, or about a minute for each micrometre of monomers with sampled bonds. It does not depend on
        /// the seed of the task.
        #[serde(default = "sampled_ns")]
        sampled_ns: f64,
    },
}

impl Interfaces {
    /// Replaces bonds by quasi-harmonic interfaces at temperatures (K) above 0.
    pub fn allow_long_steps(&mut self, temperature_k: f64) {
        if *self == Self::Bonds && temperature_k > 0.0 {
            *self = Self::QuasiHarmonic {
                sampled_ns: sampled_ns(),
            };
        }
    }
}

const MOST_SAMPLED_NS: f64 = 2e4;

fn sampled_ns() -> f64 {
    400.0
}

impl Default for Water {
    fn default() -> Self {
        Self {
            viscosity_mpa_s: 0.89,
            // A circle of 38.5 nm^2, the cross-section of rods.
            radius_nm: 3.5,
            at_ends: true,
        }
    }
}

impl Default for Fluid {
    fn default() -> Self {
        Self::Water(Water::default())
    }
}

impl Brownian {
    /// Converts the times, records and temperature to a `Dynamics` task.
    pub fn to_dynamics(&self) -> Dynamics {
        Dynamics {
            time_step_ns: self.time_step_ns,
            thermal: self.thermal(),
            record_every_ns: self.record_every_ns,
            ..Dynamics::new(self.duration_ms * NS_PER_MS)
        }
    }

    /// Returns the temperature and seed of the noise, or `None` at temperature 0.
    pub fn thermal(&self) -> Option<Thermal> {
        (self.temperature_k > 0.0).then_some(Thermal {
            temperature_k: self.temperature_k,
            seed: self.seed,
        })
    }
}

impl Task {
    /// Returns the task as `Dynamics`, for `Brownian` only the common settings; `None` for `Equilibrium`.
    pub fn motion(&self) -> Option<Cow<'_, Dynamics>> {
        match self {
            Self::Dynamics(dynamics) => Some(Cow::Borrowed(dynamics)),
            Self::Brownian(brownian) => Some(Cow::Owned(brownian.to_dynamics())),
            Self::Equilibrium(_) => None,
        }
    }
}

pub(super) fn check(brownian: &Brownian) -> Result<(), SceneProblem> {
    if let Interfaces::QuasiHarmonic { sampled_ns } = brownian.interfaces {
        if sampled_ns > MOST_SAMPLED_NS {
            let rule = format!(
                "must be at most {MOST_SAMPLED_NS:?}: 400 ns determine each stiffness to 2 %"
            );
            let key = "task.interfaces.sampled_ns";
            return Err(SceneProblem::new(key, sampled_ns, rule));
        }
        if brownian.temperature_k == 0.0 {
            let rule = "QuasiHarmonic interfaces require a temperature above 0: write a temperature, or Bonds";
            return Err(SceneProblem::new("task.interfaces", "QuasiHarmonic", rule));
        }
    }
    brownian.flow.check()
}

impl Fluid {
    pub(super) fn check_filaments(&self, scene: &Scene) -> Result<(), SceneProblem> {
        let Self::Water(Water { radius_nm, .. }) = *self;
        let diameter = 2.0 * radius_nm;
        let mut lengths = scene.filaments().map(Filament::length_nm);
        let short = lengths.find(|length| *length < LEAST_RATIO * diameter);
        short.map_or(Ok(()), |length| {
            let rule = format!(
                "a length of {length} nm is less than {LEAST_RATIO} diameters of {diameter} nm"
            );
            let key = "task.drag.radius_nm";
            Err(SceneProblem::new(key, show(radius_nm), rule))
        })
    }
}

/// Checks that filaments are slender and have a potential, and that loads do not follow the filament.
pub(super) fn check_whole(scene: &Scene, brownian: &Brownian) -> Result<(), SceneProblem> {
    for (i, one) in scene.filaments().enumerate() {
        rules::check_potential(one).map_err(|p| p.with_filament(&scene.filament_key(i)))?;
    }
    brownian.drag.check_filaments(scene)?;
    let follows = scene.loads.iter().position(super::Load::follows);
    follows.map_or(Ok(()), |i| {
        let rule =
            "loads that rotate with the filament are not supported in Brownian: write Dynamics";
        Err(SceneProblem::new(format!("loads[{i}].follows"), true, rule))
    })
}
