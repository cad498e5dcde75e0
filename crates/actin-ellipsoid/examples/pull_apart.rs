//! Separates two monomers along their line of centres and compares with a spring.

use actin_ellipsoid::{EllipsoidModel, EllipsoidParameters, Interaction, Loads, Placement, State};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = EllipsoidModel::new(EllipsoidParameters::default())?;
    let mut state = State::default();
    let monomers = model.build(&mut state, &Placement::default(), 0, 2)?;
    let bonds = model.bonds(&monomers)?;

    // All bonds are parallel to the line of centres and extend equally.
    let apart = 0.01;
    let direction = (model.helix().centre(1) - model.helix().centre(0)).normalize();
    state
        .points
        .position
        .add(monomers.point(1), direction * apart);
    let mut loads = Loads::zeros(&state);
    bonds.add_loads(&state, &mut loads);

    let rigidity = model.parameters().lateral.rigidity;
    let (force, energy) = (loads.force.get(0).norm(), bonds.energy(&state));
    println!("force: {force:.3} pN; k d = {:.3} pN", rigidity * apart);
    println!(
        "energy: {energy:.4} pN nm; k d^2 / 2 = {:.4} pN nm",
        0.5 * rigidity * apart * apart
    );
    assert!((force / (rigidity * apart) - 1.0).abs() < 1e-3);
    Ok(())
}
