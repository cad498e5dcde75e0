//! The residual falls quadratically near the solution.

use crate::common::{build, newton};

/// Newton's method on the exact second derivative: each residual is at most a constant times the
/// square of the one before. A missing or wrong term makes the fall linear.
#[test]
fn the_mixed_cantilever_converges_quadratically() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenarios/cantilever-equilibrium.ron"
    );
    let text = std::fs::read_to_string(path).unwrap();
    // Drawn bonds resist slip a little at rest; weighted ones do not, and their stiffness changes faster.
    let drawn = "filament: Filament(monomers: Monomers(anchors: Independent), ";
    let assembly = build(&text.replacen("filament: Filament(", drawn, 1));
    let mut state = assembly.system.state().clone();
    let mut newton = newton(&assembly, 1e-9);
    let found = newton.solve(&mut state, assembly.system.interactions());
    let found = found.unwrap();
    let mut residuals: Vec<(f64, f64)> = found
        .history
        .iter()
        .map(|step| (step.residual.force, step.residual.torque))
        .collect();
    residuals.push((found.residual.force, found.residual.torque));
    for (k, (force, torque)) in residuals.iter().enumerate() {
        println!("{k:3}  {force:.2e} pN  {torque:.2e} pN nm");
    }
    println!(
        "{:?}, {:?}",
        found.certificate.unwrap().stability(),
        found.work
    );
    let sizes: Vec<f64> = residuals.iter().map(|&(f, t)| f.max(t)).collect();
    // Rounding leaves about the floor; ten times that is still a square.
    let floor = 10.0 * found.floor.force.max(found.floor.torque);
    let pairs: Vec<_> = sizes
        .windows(2)
        .filter(|pair| pair[0] < 0.1 && pair[1] > floor)
        .collect();
    assert!(!pairs.is_empty(), "no step in the quadratic range");
    // A linear fall by the same factor each time would not pass the next one; in the quadratic
    // range one step lowers the residual by 1e3 at least, be it to where rounding stops it.
    let falls_far = |pair: &[f64]| pair[0] < 0.1 && pair[1] < 1e-3 * pair[0];
    assert!(sizes.windows(2).any(falls_far), "{pairs:?}");
    for pair in pairs {
        // The constant is the relative change of stiffness per pN: measured 0.2 to 0.4 per pN.
        assert!(pair[1] < 2.0 * pair[0] * pair[0], "{pair:?}");
    }
}
