//! Tables 1 to 5: parameters and what was measured on the ellipsoid model, paper beside ours.

mod ensemble;
mod paper;
mod pictures;
mod statistics;
mod twisted;

pub(super) use twisted::{table3, table5};
