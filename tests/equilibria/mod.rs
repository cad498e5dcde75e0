//! Equilibria by Newton's method, compared with differences of the loads, damped dynamics and
//! closed solutions of rods. `docs/measured/statics.md` quotes the numbers that these tests print
//! (`-- --nocapture`).

mod anchors;
mod bend;
mod buckling;
mod circle;
mod common;
mod compression;
mod contact;
mod elastica;
mod extremes;
mod helical;
mod homogenised;
mod joined;
mod linkers;
mod lost_twist;
mod reciprocity;
mod ring;
mod saddles;
mod several;
mod shape;
mod states;
mod unheld;
