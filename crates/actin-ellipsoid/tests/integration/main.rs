//! Integration tests of the ellipsoid model.

mod common;
mod cubature;
mod floppy;
mod loads;
mod rest;
mod stiffness;
