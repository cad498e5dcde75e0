//! Laws of the rod against filaments of monomers and against their own formulas, by the measuring
//! protocols and through whole scenes.
//!
//! `docs/measured/fitted-law.md` quotes the numbers that these tests print (`-- --nocapture`).

mod fitted;
mod twisted;
