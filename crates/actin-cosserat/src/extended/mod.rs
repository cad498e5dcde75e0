//! Rods whose strain energy depends on their curvature.
//!
//! The coupling uses the mean curvature of the bending elements around a segment, including walls
//! and junctions (`curvature.rs`). `end_shear.rs` and `end_twist.rs` correct strains near ends,
//! `law.rs` has the energy, `segments.rs` loads and stiffness, `twist_stability.rs` the stability
//! under axial force.

mod curvature;
mod end_shear;
mod end_twist;
mod law;
mod segments;
mod twist_stability;

pub(crate) use curvature::AdjacentElement;
pub use curvature::{JoinedElement, SegmentCurvature};
pub use end_shear::EndShear;
pub(crate) use end_twist::EndTwist;
pub use law::SegmentLaw;
pub(crate) use law::{MeanCurvature, SegmentJet};
pub(crate) use segments::{ExtendedSegments, SegmentSurroundings};
pub use twist_stability::TwistStability;
