//! Rods whose strain knows of their curvature.
//!
//! The strain of a segment is its own, the curvature belongs to the nodes: what couples the two
//! takes the mean curvature of the bending elements around a segment, those of walls and
//! junctions included. `curvature.rs` finds these, `law.rs` says what couples, and `segments.rs`
//! makes loads and stiffness of it.

mod curvature;
mod law;
mod segments;

pub use curvature::{JoinedElement, SegmentCurvature};
pub use law::SegmentLaw;
pub(crate) use segments::ExtendedSegments;
