//! Rods whose strain knows of their curvature.
//!
//! The strain of a segment is its own, the curvature belongs to the nodes: what couples the two
//! takes the mean curvature of the bending elements around a segment, those of walls and
//! junctions included. `curvature.rs` finds these, `end_shear.rs` and `end_twist.rs` say how much of a
//! strain counts near ends, `law.rs` what couples, `segments.rs` makes loads and stiffness of it, and
//! `twist_stability.rs` says under which forces twist is stable.

mod curvature;
mod end_shear;
mod end_twist;
mod law;
mod segments;
mod twist_stability;

pub use curvature::{JoinedElement, SegmentCurvature};
pub use end_shear::{END_SHEAR_NM, EndShear};
pub use end_twist::END_TWIST_NM;
pub(crate) use end_twist::EndTwist;
pub use law::SegmentLaw;
pub(crate) use law::{MeanCurvature, SegmentJet};
pub(crate) use segments::{ExtendedSegments, SegmentAround};
pub use twist_stability::TwistStability;
