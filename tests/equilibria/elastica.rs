//! Cantilever under a transverse tip force against the exact elastica.

use super::common::{BEND, LENGTH, SHEAR, cantilever, solved};
use crate::theory::second_order_limit;
use actin_sim::End;

/// `alpha = F L^2 / B` and the deflection over the length of the inextensible rod. Source: elliptic
/// integrals (Bisshopp and Drucker, Q. Appl. Math. 3 (1945) 272).
const ELASTICA: [(f64, f64); 5] = [
    (0.2, 0.066_364_482_1),
    (1.0, 0.301_720_773_8),
    (2.0, 0.493_457_480_4),
    (5.0, 0.713_791_523_6),
    (10.0, 0.810_609_024_9),
];

/// Deflection over length, without the contribution `F / S` of shear and stretch.
fn deflection(alpha: f64, segments: usize) -> f64 {
    let force = alpha * BEND / (LENGTH * LENGTH);
    let (assembly, report) = solved(&cantilever(
        segments,
        [force, 0.0, 0.0],
        "task: Equilibrium()",
    ));
    let found = report.equilibrium.unwrap();
    // Each step moves the tip along its arc.
    assert!(found.newton_iterations <= 12, "{}", found.newton_iterations);
    let tip = assembly.tip_nm(assembly.system.state(), End::End);
    tip.x / LENGTH - force / SHEAR
}

#[test]
fn the_deflection_converges_to_the_elastica_with_order_two() {
    for (alpha, exact) in ELASTICA {
        let values = [32, 64, 128].map(|segments| deflection(alpha, segments));
        let limit = second_order_limit(&format!("elastica {alpha}"), values, exact, 0.03);
        // Fourth-order error on 64 segments.
        assert!(limit.abs() < 1e-6, "alpha {alpha}: {limit:e}");
    }
}
