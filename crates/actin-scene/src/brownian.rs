//! Overdamped motion in a fluid, as a scene writes it, and its rules.

use super::rules::{non_negative, positive, show};
use super::{
    DragModel, Dynamics, Filament, Flow, Integrator, Scene, SceneProblem, Task, Thermal, rules,
};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Least ratio of length to diameter for which the friction of a cylinder is known.
const LEAST_RATIO: f64 = 3.0;

/// Nanoseconds in a millisecond.
const NS_PER_MS: f64 = 1e6;

/// Overdamped motion in a fluid, thermal or athermal, by steps that are implicit in the stiffness. Inertia plays no part:
/// velocities are recorded as zero. Rods need `EnergyGradient`; loads that turn with the filament are refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Brownian {
    /// Simulated time; positive, at least what the path takes.
    pub duration_ms: f64,
    /// Temperature of the fluid; at least 0. At 0 filaments relax without noise.
    pub temperature_k: f64,
    /// Seed of the noise.
    #[serde(default)]
    pub seed: u64,
    /// The fluid, and what it does to a filament.
    #[serde(default)]
    pub drag: Fluid,
    /// How the fluid moves. Drag pulls filaments along with it.
    #[serde(default)]
    pub flow: Flow,
    /// What holds monomers together.
    #[serde(default)]
    pub interfaces: Interfaces,
    /// Longest time step; positive. By default of rods at a temperature the time in which the drag of a segment bends it, 180 ns on
    /// 40 nm: what is faster is drawn anew in each step, means are right to 1 %. It is shorter where stages, loads, rates,
    /// shear or records need it; monomers with interfaces `QuasiHarmonic` take steps as segments of a fifth of their filament's
    /// length, at most 40 nm. Of other monomers at a temperature, and with `repulsion`, it is 50 times the fastest relaxation, at which
    /// all strains have their thermal energy to 1 % on segments of 20 nm or more. Without heat it is a twentieth of the time between
    /// records, and at most a hundredth of that in which a stage or a load changes: displacements are right to 0.1 %. Steps are
    /// shortened so that whole ones make up the duration and the interval of records; without heat those that cannot be
    /// solved are halved.
    #[serde(default)]
    pub time_step_ns: Option<f64>,
    /// Time between recorded states; positive. By default about a hundredth of the duration.
    #[serde(default)]
    pub record_every_ns: Option<f64>,
}

/// A fluid and the drag in it, which follows from its viscosity. Rates of `Dynamics` are numerical damping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Fluid {
    /// A viscous fluid at rest, felt locally, along, across and about each piece of filament: a cylinder of the filament's
    /// length shares its drag out evenly (Tirado, Lopez Martinez and Garcia de la Torre 1984).
    Water {
        /// Viscosity; positive. By default that of water at 25 degrees C.
        #[serde(default = "water")]
        viscosity_mpa_s: f64,
        /// Radius of the cylinder; positive, at most a sixth of the length of each filament.
        #[serde(default = "radius")]
        radius_nm: f64,
        /// Whether part of the drag across acts at the ends, so that straight filaments turn end over end as fast as they
        /// should.
        #[serde(default = "yes")]
        at_ends: bool,
    },
}

/// What holds the monomers of an overdamped motion together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Interfaces {
    /// Bonds. Their fastest relaxation takes a tenth of a picosecond, so that a microsecond takes ten million steps.
    #[default]
    Bonds,
    /// A quadratic energy with the means and the covariances that neighbours have in thermal motion with their bonds, which is
    /// simulated first. It needs a temperature, and takes steps ten thousand times longer. Stiffness is that at
    /// this temperature without loads: it does not change with tension, twist or bending.
    QuasiHarmonic {
        /// How long the motion of the bonds is simulated; positive, at most 20,000. By default 400 ns: seconds before anything
        /// else, or about a minute for each micrometre of monomers with drawn bonds. The same for every seed of the task, so
        /// that it is no part of their scatter.
        #[serde(default = "sampled_ns")]
        sampled_ns: f64,
    },
}

impl Interfaces {
    /// Quasi-harmonic ones instead of bonds, where there is a temperature (K).
    pub fn allow_long_steps(&mut self, temperature_k: f64) {
        if *self == Self::Bonds && temperature_k > 0.0 {
            *self = Self::QuasiHarmonic {
                sampled_ns: sampled_ns(),
            };
        }
    }
}

/// Longest motion (ns) that interfaces are sampled from: an hour for each micrometre of monomers with drawn bonds.
const MOST_SAMPLED_NS: f64 = 2e4;

fn sampled_ns() -> f64 {
    400.0
}

fn water() -> f64 {
    0.89
}

/// That of a circle of 38.5 nm^2, the cross-section of rods.
fn radius() -> f64 {
    3.5
}

fn yes() -> bool {
    true
}

impl Default for Fluid {
    fn default() -> Self {
        Self::Water {
            viscosity_mpa_s: water(),
            radius_nm: radius(),
            at_ends: yes(),
        }
    }
}

impl Brownian {
    /// What it has in common with motion that has inertia: times, records and temperature.
    pub fn as_motion(&self) -> Dynamics {
        Dynamics {
            duration_ns: self.duration_ms * NS_PER_MS,
            integrator: Integrator::default(),
            time_step_ns: self.time_step_ns,
            step_safety: super::types::STEP_SAFETY,
            allow_unstable_step: false,
            drag: DragModel::default(),
            thermal: self.thermal(),
            stop: None,
            leave_saddles: 0,
            record_every_ns: self.record_every_ns,
        }
    }

    /// Its noise; none at temperature 0.
    pub fn thermal(&self) -> Option<Thermal> {
        (self.temperature_k > 0.0).then_some(Thermal {
            temperature_k: self.temperature_k,
            seed: self.seed,
        })
    }
}

impl Task {
    /// The motion in time that it asks for, with inertia or, as far as they have it in common, without; none of an
    /// equilibrium.
    pub fn motion(&self) -> Option<Cow<'_, Dynamics>> {
        match self {
            Self::Dynamics(dynamics) => Some(Cow::Borrowed(dynamics)),
            Self::Brownian(brownian) => Some(Cow::Owned(brownian.as_motion())),
            Self::Equilibrium(_) => None,
        }
    }
}

/// Checks the numbers of the task.
pub(super) fn check(brownian: &Brownian) -> Result<(), SceneProblem> {
    positive("task.duration_ms", brownian.duration_ms)?;
    non_negative("task.temperature_k", brownian.temperature_k)?;
    for (key, value) in [
        ("task.time_step_ns", brownian.time_step_ns),
        ("task.record_every_ns", brownian.record_every_ns),
    ] {
        value.map_or(Ok(()), |value| positive(key, value))?;
    }
    if let Interfaces::QuasiHarmonic { sampled_ns } = brownian.interfaces {
        positive("task.interfaces.sampled_ns", sampled_ns)?;
        if sampled_ns > MOST_SAMPLED_NS {
            let rule =
                format!("must be at most {MOST_SAMPLED_NS:?}: 400 ns know each stiffness to 2 %");
            return Err(SceneProblem::new(
                "task.interfaces.sampled_ns",
                sampled_ns,
                rule,
            ));
        }
        if brownian.temperature_k == 0.0 {
            let rule = "interfaces have the stiffness of their thermal motion: write a temperature, or Bonds";
            return Err(SceneProblem::new("task.interfaces", "QuasiHarmonic", rule));
        }
    }
    brownian.drag.check()?;
    brownian.flow.check()
}

impl Fluid {
    /// Checks its numbers.
    pub(super) fn check(&self) -> Result<(), SceneProblem> {
        let Self::Water {
            viscosity_mpa_s,
            radius_nm,
            ..
        } = *self;
        positive("task.drag.viscosity_mpa_s", viscosity_mpa_s)?;
        positive("task.drag.radius_nm", radius_nm)
    }

    /// Refuses filaments that are not slender.
    pub(super) fn check_filaments(&self, scene: &Scene) -> Result<(), SceneProblem> {
        let Self::Water { radius_nm, .. } = *self;
        let diameter = 2.0 * radius_nm;
        let mut lengths = scene.filaments().map(Filament::length_nm);
        let short = lengths.find(|length| *length < LEAST_RATIO * diameter);
        short.map_or(Ok(()), |length| {
            let rule = format!(
                "a length of {length} nm is less than {LEAST_RATIO} diameters of {diameter} nm"
            );
            Err(SceneProblem::new(
                "task.drag.radius_nm",
                show(radius_nm),
                rule,
            ))
        })
    }
}

/// Checks what the task asks of the rest of the scene: potentials, and filaments that are slender.
pub(super) fn check_whole(scene: &Scene, brownian: &Brownian) -> Result<(), SceneProblem> {
    for (i, one) in scene.filaments().enumerate() {
        rules::check_potential(one).map_err(|p| p.with_filament(&scene.filament_key(i)))?;
    }
    brownian.drag.check_filaments(scene)?;
    let follows = scene.loads.iter().position(super::Load::follows);
    follows.map_or(Ok(()), |i| {
        let rule = "a load that turns with the filament has no stiffness in which Brownian could be implicit: \
                    Dynamics takes it";
        Err(SceneProblem::new(format!("loads[{i}].follows"), true, rule))
    })
}
