//! A rod with a circular rest shape is straightened, then relaxes to its rest shape.

use actin_cosserat::{
    End, Interaction, Rigidities, RodClamp, RodElements, RodMaterial, State, StraightRod, Vector3,
};
use actin_equilibrium::relax;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut state = State::default();
    let straight = StraightRod::uniform(160, 1.0);
    let rod = straight.push_clamped(RodClamp::Wall, End::Start, &mut state)?;
    let rigidities = Rigidities::table4();

    // Rest shape: curved about body axis d2 with a radius of 100 nm. A third component would be a
    // twist.
    let radius = 100.0;
    rod.bend(&mut state, |_s| Vector3::y() / radius)?;
    let law = RodElements::at_rest(&state, &rod, RodMaterial::new(rigidities)?)?;

    // Initial shape: straight.
    rod.bend(&mut state, |_s| Vector3::zeros())?;
    let energy = law.energy(&state);
    let theory = rigidities.bend.y * rod.length() / (2.0 * radius * radius);
    println!("energy: {energy:.1} pN nm; B L / 2 R^2 = {theory:.1} pN nm");

    relax(&mut state, &[Box::new(law)])?;
    let tip = rod.tip(&state);
    let (sin, cos) = (rod.length() / radius).sin_cos();
    let circle = Vector3::new(1.0 - cos, 0.0, sin) * radius;
    println!("tip: ({:.3}, {:.3}) nm", tip.x, tip.z);
    println!("circle: ({:.3}, {:.3}) nm", circle.x, circle.z);
    assert!((energy / theory - 1.0).abs() < 0.01 && (tip - circle).norm() < 0.01);
    Ok(())
}
