//! Pulls thirty monomers along their axis and compares the elongation with rod theory.

use actin_ellipsoid::{EllipsoidModel, EllipsoidParameters, Placement, PointLoad, State, Vector3};
use actin_equilibrium::relax;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = EllipsoidModel::new(EllipsoidParameters::default())?;
    let mut state = State::default();
    let monomers = model.build(&mut state, &Placement::default(), 0, 30)?;
    let bonds = model.bonds(&monomers)?;
    for k in 0..2 {
        state.points.hold(monomers.point(k));
        state.frames.hold(monomers.frame(k));
    }

    // 100 pN along z, shared by the last two monomers, which are free to rotate.
    let force = 100.0;
    let ends = [monomers.point(28), monomers.point(29)];
    let load = PointLoad::shared(&mut state, &ends, Vector3::z() * force)?;
    let mean_height = |state: &State| {
        0.5 * ends
            .map(|i| state.points.position.get(i).z)
            .iter()
            .sum::<f64>()
    };
    let before = mean_height(&state);
    relax(&mut state, &[Box::new(bonds), Box::new(load)])?;
    let longer = mean_height(&state) - before;

    // Stretching rigidity S3 (pN), twisting rigidity B3 (pN nm^2), coupling C3 (pN nm). A filament
    // that is free to rotate unwinds under tension: its stiffness is S3 - C3^2 / B3.
    let (s3, b3, c3) = (3.4e4, 1.3e4, 9.63e3);
    let theory = force * 28.0 * model.helix().rise() / (s3 - c3 * c3 / b3);
    println!("longer by {longer:.4} nm; F L / (S3 - C3^2 / B3) = {theory:.4} nm");
    assert!((longer / theory - 1.0).abs() < 0.02);
    Ok(())
}
