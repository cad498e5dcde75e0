//! The last segment of a rod is stretched: force and energy compared with Hooke's law.

use actin_cosserat::{
    EnergyGradient, Interaction, Loads, Rigidities, RodError, RodMaterial, State, StraightRod,
    Vector3,
};

fn main() -> Result<(), RodError> {
    let mut state = State::default();
    let rod = StraightRod::uniform(16, 10.0).push(&mut state)?;
    let tip = rod.points().end - 1;
    let law = EnergyGradient::new(rod, RodMaterial::new(Rigidities::table4())?);

    // 0.01 nm of 10 nm: a strain of 0.001, with S3 = 3.4e4 pN.
    state.points.position.add(tip, Vector3::z() * 0.01);
    let mut loads = Loads::zeros(&state);
    law.add_loads(&state, &mut loads);
    let (force, energy) = (-loads.force.get(tip).z, law.energy(&state));
    println!("force: {force:.6} pN; S3 strain = 34 pN");
    println!("energy: {energy:.6} pN nm; S3 strain^2 l / 2 = 0.17 pN nm");
    assert!((force - 34.0).abs() < 1e-8 && (energy - 0.17).abs() < 1e-8);
    Ok(())
}
