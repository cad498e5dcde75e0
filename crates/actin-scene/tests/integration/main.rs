//! Reading of scenes, as a user of the crate does it.

mod mistakes;
mod values;
