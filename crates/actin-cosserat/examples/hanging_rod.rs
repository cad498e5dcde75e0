//! A clamped filament bends under its own weight: tip deflection compared with beam theory.

use actin_cosserat::{
    End, EnergyGradient, Rigidities, RodClamp, RodMaterial, State, StraightRod, Vector3, Weight,
};
use actin_equilibrium::relax;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 160 nm of actin along x in 32 segments, clamped at the start.
    let filament = StraightRod::uniform(32, 5.0).along(Vector3::x())?;
    let mut state = State::default();
    let rod = filament.push_clamped(RodClamp::Wall, End::Start, &mut state)?;
    let rigidities = Rigidities::table4();
    let law = EnergyGradient::new(rod.clone(), RodMaterial::new(rigidities)?);

    // In a centrifuge, at two million times the acceleration of gravity (nm/ns^2).
    let acceleration = 0.02;
    let weight = Weight::new(&mut state, Vector3::z() * -acceleration)?;
    relax(&mut state, &[Box::new(law), Box::new(weight)])?;

    let tip = rod.tip(&state);
    let per_length = filament.cross_section.linear_density() * acceleration;
    let theory = per_length * rod.length().powi(4) / (8.0 * rigidities.bend.x);
    println!("tip: {:.4} nm down; w L^4 / 8 B = {theory:.4} nm", -tip.z);
    assert!((-tip.z / theory - 1.0).abs() < 0.01);
    Ok(())
}
