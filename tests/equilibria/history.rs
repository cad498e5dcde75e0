//! The residual falls quadratically near the solution.

use super::common::{build, newton};

/// Newton's method on the exact second derivative: each residual is at most a constant times the
/// square of the one before. A missing or wrong term makes the fall linear.
///
/// The constant is the relative change of stiffness per pN: 0.2 to 0.4 of drawn bonds, which resist slip
/// a little at rest; weighted ones do not, and their stiffness changes faster.
#[test]
fn the_mixed_cantilever_converges_quadratically() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenarios/cantilever-equilibrium.ron"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let drawn = "filament: Filament(monomers: Monomers(anchors: Independent), ";
    let drawn = text.replacen("filament: Filament(", drawn, 1);
    for (text, constant) in [(drawn, 2.0), (text, 20.0)] {
        converges(&text, constant);
    }
}

fn converges(text: &str, constant: f64) {
    let assembly = build(text);
    let mut state = assembly.system.state().clone();
    let mut newton = newton(&assembly, 1e-9);
    let found = newton.solve(&mut state, assembly.system.interactions());
    let found = found.unwrap();
    let mut sizes: Vec<f64> = found
        .history
        .iter()
        .map(|step| step.residual.force.max(step.residual.torque))
        .collect();
    sizes.push(found.residual.force.max(found.residual.torque));
    println!("{sizes:?}, {:?}", found.certificate.unwrap().stability());
    // Rounding leaves about the floor; ten times that is still a square.
    let floor = 10.0 * found.floor.force.max(found.floor.torque);
    let pairs = sizes.windows(2).filter(|pair| pair[0] < 0.1 / constant);
    let mut seen = 0;
    for pair in pairs {
        let square = constant * pair[0] * pair[0];
        assert!(pair[1] < square.max(floor), "{pair:?}, floor {floor:.1e}");
        seen += 1;
    }
    assert!(seen > 0, "no step in the quadratic range");
}
