//! Tables 1 to 5: parameters and measurements of the ellipsoid model.

mod ensemble;
mod lengths;
mod parameters;
mod rigidities;
mod thermal;
mod twisted;

pub(super) use parameters::{table1, table2};
pub(super) use rigidities::table4;
pub(super) use twisted::{monomers, table3, table5};
