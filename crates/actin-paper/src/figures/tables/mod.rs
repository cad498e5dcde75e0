//! Tables 1 to 5: parameters and what was measured on the ellipsoid model, paper beside ours.

mod beside;
mod ensemble;
mod lengths;
mod listings;
mod loads;
mod parameters;
mod pictures;
mod rigidities;
mod statistics;
mod thermal;
mod twisted;

pub(super) use beside::monomers;
pub(super) use parameters::{table1, table2};
pub(super) use rigidities::table4;
pub(super) use twisted::{table3, table5};
