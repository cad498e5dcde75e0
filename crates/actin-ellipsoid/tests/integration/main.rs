//! Monomers and their bonds.

mod common;
mod cubature;
mod floppy;
mod loads;
mod rest;
mod stiffness;
