//! The scene file: its types, how it is read, and what it refuses.
//!
//! Reading happens in two steps. RON gives the types below and refuses unknown or missing keys;
//! [`validate`] then checks what numbers may be. Both report line and column.

mod brackets;
mod brownian;
mod curve;
mod drag;
mod factor;
pub(crate) mod fitted;
mod flow;
mod following;
mod imperfection;
mod kinetics;
mod law;
mod linker;
mod load;
mod load_rules;
mod locate;
mod magnitude;
mod mistakes;
mod model;
mod observable;
mod outline;
pub(crate) mod path;
mod place;
mod problem;
mod read;
mod repulsion;
mod rules;
mod saddles;
#[cfg(feature = "schema")]
mod schema;
mod section;
mod section_rules;
mod sections;
mod seeds;
mod shape;
mod stage;
mod support;
mod syntax;
mod text;
mod thermal;
mod trace;
mod types;
mod validate;
mod value;
mod written;

pub use brownian::{Brownian, Fluid, Interfaces};
pub(crate) use curve::{Curve, swept};
pub use drag::{DragModel, DragRates};
pub use factor::Factor;
pub(crate) use factor::smooth;
pub use flow::Flow;
pub use following::{Following, Where};
pub use imperfection::Imperfection;
pub use kinetics::{Breaking, Catch, Forming, Kinetics, Stepping};
pub use law::{
    BendLaw, RodLaw, RodLaws, ShearLaw, StretchLaw, TwistLaw, TwistRise, TwistStretchLaw,
};
pub use linker::{Linker, LinkerSite};
pub(crate) use load::Resultant;
pub use load::{Acceleration, Couple, CouplePerLength, Force, ForcePerLength, Load};
pub use mistakes::{Readings, read_all};
pub use model::{
    Anchors, ForceLaw, JunctionModel, JunctionWeight, Material, Monomers, RodModel, RotaryInertia,
};
pub use observable::{Observable, Output, Point};
pub(crate) use place::HeldEnds;
pub use problem::{SceneError, SceneProblem};
pub use read::read_ron;
pub use repulsion::{Plane, Repulsion, Sphere, SphereSide};
#[cfg(feature = "schema")]
pub use schema::schema;
pub use section::{Altered, AlteredRod, Section};
pub use sections::{Adaptive, Quantity, Sections, Want};
pub use seeds::Drawn;
pub use shape::Shape;
pub(crate) use stage::unset_loads;
pub(crate) use support::is_across;
pub use text::{Override, SceneText};
pub use thermal::{BOLTZMANN_PN_NM_PER_K, Thermal};
pub use types::{
    Clamp, Dynamics, End, Equilibrium, Filament, Hinge, Hold, Integrator, Pace, Scene, Setting,
    Slides, Stage, StopTolerances, Task,
};
pub(crate) use validate::MOST_COUNTED;
pub use value::SceneValue;
