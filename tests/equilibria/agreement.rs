//! Newton's method and damped dynamics end in the same state.

use super::common::{MIXED, apart, build, run, solved};

fn scene(task: &str) -> String {
    format!(
        "Scene(
            filament: {MIXED},
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (-2.0, 0.5, 0.0))],
            task: {task},
        )"
    )
}

/// Asserts that damped dynamics comes to rest at the equilibrium of Newton's method, for the scene
/// that `scene` makes of a task. The stop rule displaces the softest mode by less than the
/// tolerance.
pub(crate) fn assert_dynamics_ends_with_newton(scene: impl Fn(&str) -> String) {
    let (newton, _) = solved(&scene("Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-9)"));
    let mut moving = build(&scene(
        "Dynamics(
            duration_ns: 2000.0,
            integrator: PositionVerlet,
            step_safety: 0.9,
            drag: (translational_per_ns: 2.0, rotational_per_ns: 2.0),
            stop: (force_pn: 1e-8, torque_pn_nm: 1e-8, kinetic_pn_nm: 1e-12),
            record_every_ns: 1.0,
        )",
    ));
    let (_, report) = run(&mut moving).unwrap();
    assert!(
        report.has_converged(),
        "not converged after {} steps",
        report.steps
    );
    let apart = apart(newton.system.state(), moving.system.state());
    println!(
        "dynamics, {} evaluations: {apart:.1e} nm from Newton",
        report.force_evaluations
    );
    assert!(apart < 1e-6, "{apart:e} nm apart");
}

#[test]
fn dynamics_comes_to_rest_where_newton_ends() {
    assert_dynamics_ends_with_newton(scene);
}
