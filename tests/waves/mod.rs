//! Waves on assembled filaments: frequencies and speeds against theory, a tumbling rod, and
//! pulses that meet a junction.
//!
//! The tables of `docs/measured/waves.md` are what these tests print with `--nocapture`.

mod bending;
mod field;
mod frequencies;
mod pulses;
mod tumbling;
