//! Waves on assembled filaments: frequencies and speeds, a tumbling rod, and pulses at a junction.
//! With `--nocapture` these tests print the tables of `docs/measured/waves.md`.

mod bending;
mod field;
mod frequencies;
mod pulses;
mod tumbling;
