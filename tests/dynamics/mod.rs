//! Motion of assembled filaments. With `--nocapture` these tests print the tables of
//! `docs/measured/motion.md`.

mod brownian;
mod contact;
mod damped;
mod energy;
mod energy_balance;
mod equipartition;
mod filaments;
mod joined;
mod kinetics;
mod laws;
mod linkers_in_heat;
mod modes;
mod observed;
mod order;
mod paper_balance;
mod quasi_harmonic;
mod range;
mod record;
mod rest;
mod short_bonds;
mod steps;
mod thermal;
mod water;
