//! Thirty monomers are pulled: how much longer they become, against the rod of the same rigidity.

use actin_ellipsoid::{EllipsoidModel, EllipsoidParameters, Placement, PointLoad, State, Vector3};
use actin_equilibrium::relax;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = EllipsoidModel::new(EllipsoidParameters::default())?;
    let mut state = State::default();
    let monomers = model.build(&mut state, &Placement::default(), 0, 30);
    let bonds = model.bonds(&monomers)?;
    for k in 0..2 {
        state.points.hold(monomers.point(k));
        state.frames.hold(monomers.frame(k));
    }

    // 100 pN along the axis, shared by the last two monomers.
    let force = 100.0;
    let ends = [monomers.point(28), monomers.point(29)];
    let load = PointLoad::shared(&mut state, &ends, Vector3::z() * force);
    let height = |state: &State| {
        0.5 * ends
            .map(|i| state.points.position.get(i).z)
            .iter()
            .sum::<f64>()
    };
    let before = height(&state);
    relax(&mut state, &[Box::new(bonds), Box::new(load)])?;

    // From the middle of the first two to that of the last two; S3 of arXiv 2203.01284, Table 4.
    let length = 28.0 * model.helix().rise();
    let theory = force * length / 3.4e4;
    let longer = height(&state) - before;
    println!("longer by {longer:.4} nm; F L / S3 = {theory:.4} nm");
    assert!((longer / theory - 1.0).abs() < 0.1);
    Ok(())
}
