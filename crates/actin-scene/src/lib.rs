//! Scenes of actin filaments: types of the format, strict reading, validation and defaults.
//!
//! A [`Scene`] lists filaments, clamps, loads, linkers and a task. [`Scene::from_path`] and
//! [`Scene::from_ron`] refuse unknown keys, missing keys and invalid values, each with line and column; [`Scene::to_ron`] writes every default.
//! Units: nm, pN, ns, rad (degrees for keys that end in `_deg`); mass in ag = 1e-21 kg = pN ns^2/nm.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod adaptive_resolution;
mod arrangement;
mod bead;
mod brackets;
mod brownian;
mod builders;
mod crosslinkers;
mod curve;
mod deserialize;
mod drag;
mod factor;
mod fitted;
mod flow;
mod generated;
mod imperfection;
mod kinetics;
mod law;
mod linker;
mod linkers_between;
mod load;
mod load_rules;
mod model;
mod numbers;
mod observable;
mod parse;
pub mod path;
mod periodic;
mod place;
mod position;
mod problem;
mod read;
mod repulsion;
mod rest;
mod rules;
mod scene_file;
mod schema;
mod section;
mod section_rules;
mod sections;
mod seeds;
mod serialize;
mod shape;
mod spline;
mod stage;
mod start;
mod suggestion;
mod support;
mod text;
mod thermal;
mod trace;
mod tree;
mod types;
mod validate;

pub use actin_cosserat::{
    CubicShear, End, PolynomialStretch, RootedStretch, RotaryInertia, SidedTwist, Stiffening,
    StretchLaw, TanhTwist, TwistRise, TwistStretch as TwistStretchLaw,
};
pub use actin_coupling::JunctionWeight;
pub use actin_coupling::repulsion::Side;
pub use actin_ellipsoid::Anchors;
pub use adaptive_resolution::{AdaptiveResolution, RefinementCriterion};
pub(crate) use arrangement::Arrangement;
pub use bead::Bead;
pub use brownian::{Brownian, Fluid, Interfaces, Water};
pub(crate) use crosslinkers::Crosslinkers;
pub use curve::{Curve, left_jacobian_product};
pub use drag::{DragModel, DragRates};
pub use factor::Factor;
pub use factor::smooth;
pub use fitted::laws as fitted_laws;
pub use flow::Flow;
pub use imperfection::Imperfection;
pub use kinetics::{Breaking, Catch, Forming, Kinetics, Roaming, Stepping};
pub use law::{BendLaw, RodLaw, RodLaws, ShearLaw, TwistLaw};
pub use linker::{Linker, LinkerSite};
pub(crate) use linkers_between::LinkersBetween;
pub use load::Resultant;
pub use load::{Acceleration, Couple, CouplePerLength, Force, ForcePerLength, Load};
pub use model::{ForceLaw, JunctionModel, Material, Monomers, RodModel};
pub use observable::{Observable, Output, Point};
pub use periodic::PeriodicBox;
pub use place::{ClampedEnds, unit_vector};
pub use problem::{ParseReport, SceneError, SceneProblem};
pub use read::{read_all, read_ron, to_ron};
pub use repulsion::{Cuboid, Cylinder, Plane, Repulsion, Sphere, WallName};
pub use schema::schema;
pub use section::{MonomerChanges, RodChanges, Section};
pub use sections::{Adaptive, Quantity, Sections, Target};
pub use seeds::RandomPart;
pub use shape::Shape;
pub use spline::{Spline, SplineEnds};
pub use stage::unset_loads;
pub use start::Start;
pub use support::{is_across, lowest_joined};
pub use text::{Override, SceneText};
pub use thermal::{BOLTZMANN_PN_NM_PER_K, Thermal};
pub use tree::{Kind as SceneKind, SceneValue};
pub use types::{
    Clamp, Dynamics, Equilibrium, Filament, FreeTranslation, Hinge, Hold, Integrator, Scene,
    Setting, Stage, StopTolerances, Task, TimeCourse,
};
pub use validate::MAX_EXACT_INTEGER;
