//! Junctions, linkers and contacts.

mod junction;
mod linker;
mod repulsion;
