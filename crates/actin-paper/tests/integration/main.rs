//! Rod laws compared with filaments of monomers and with their formulas, through measuring
//! protocols and whole scenes.
//!
//! `docs/measured/fitted-law.md` quotes the numbers that these tests print (`-- --nocapture`).

mod fitted;
mod twisted;
