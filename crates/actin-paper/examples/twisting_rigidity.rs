//! How stiff a filament of monomers is in twist, and how much shorter it gets, beside rods.
//!
//! `cargo run -p actin-paper --example twisting_rigidity`

use actin_paper::measure::{MeasureError, Specimen, twist};
use actin_sim::{Monomers, RodLaw, RodModel};

fn main() -> Result<(), MeasureError> {
    let turns = [-180.0, -120.0, -60.0, 60.0, 120.0, 180.0];
    let monomers = Monomers::default();
    let length_nm = 27.0 * monomers.rise_nm;
    let filament = twist(&Specimen::ellipsoids(length_nm, monomers), &turns)?;
    let rod = |law| {
        let model = RodModel::with_law(law);
        twist(&Specimen::rod(filament.length_nm, None, model), &turns)
    };
    let (constant, fitted) = (rod(RodLaw::Constant)?, rod(RodLaw::Fitted)?);
    println!(" turn   B3 (pN nm^2)                  dL/L");
    println!("(deg)   monomers  Constant    Fitted  monomers    Fitted");
    for ((a, b), c) in (filament.points.iter().zip(&constant.points)).zip(&fitted.points) {
        println!(
            "{:5.0} {:10.0} {:9.0} {:9.0} {:9.4} {:9.4}",
            a.turn_deg,
            a.rigidity_pn_nm2,
            b.rigidity_pn_nm2,
            c.rigidity_pn_nm2,
            a.relative_length_change,
            c.relative_length_change,
        );
    }
    Ok(())
}
