//! Critical loads of columns from singular stiffness, and post-buckling.

use super::common::{BEND, LENGTH, SHEAR, build, cantilever, critical, newton, solved};
use crate::theory::{bisect, second_order_limit};
use actin_sim::{End, Scene, Solve};
use std::f64::consts::PI;

const MESHES: [usize; 3] = [16, 32, 64];

/// `B / L^2` of [`cantilever`].
const UNIT: f64 = BEND / (LENGTH * LENGTH);

const THRUST: &str = "EndForce(end: End, force_pn: (0.0, 0.0, -1.0))";
const CLAMPED: &str = "Clamp(end: Start)";
const PINNED: &str = "Clamp(end: Start, hold: Pin)";

/// Factor of a load at which a straight column between `clamps` becomes unstable.
fn buckling_factor(segments: usize, clamps: &str, load: &str, bounds: [f64; 2]) -> f64 {
    let text = cantilever(segments, [0.0, 0.0, -1.0], "task: Equilibrium()");
    let text = text.replace(CLAMPED, clamps).replace(THRUST, load);
    let assembly = build(&text);
    let interactions = assembly.system.interactions();
    let straight = assembly.system.state();
    critical(&mut newton(&assembly, 1e-8), straight, interactions, bounds)
}

/// `x` of the critical load `x^2 B / L^2` of a column on a hinge of `k = share B / L`, pinned at the
/// other end: `x / tan(x) = 1 + x^2 / share`.
fn hinged(share: f64) -> f64 {
    let is_beyond = |x: f64| x / x.tan() < 1.0 + x * x / share;
    bisect(is_beyond, [PI + 1e-9, 4.493_409_457_909_064 - 1e-9], 1e-14)
}

/// Euler's columns, with the axial rotation as a neutral mode between pins, and the column under its
/// own weight: `q L^3 / B = 7.8373474389`, from the smallest zero of a Bessel function of order -1/3.
/// Source: Greenhill (1881).
#[test]
fn columns_buckle_at_their_critical_loads() {
    let spring = format!(
        "Clamp(end: Start, hold: Pin, hinge: (bend_pn_nm_per_rad: {:?}, twist_pn_nm_per_rad: 50.0))",
        2.0 * BEND / LENGTH
    );
    let pin = "Clamp(end: End, hold: Pin, slides: AlongAxis)";
    let wall = "Clamp(end: End, slides: AlongAxis)";
    let weight = "ForcePerLength(force_pn_per_nm: (0.0, 0.0, -1.0))";
    let between = |start: &str, end: &str| format!("{start}, {end}");
    #[rustfmt::skip]
    let cases = [
        ("clamped and free", CLAMPED.to_owned(), THRUST, 0.25 * PI * PI * UNIT),
        ("pinned", between(PINNED, pin), THRUST, PI * PI * UNIT),
        ("clamped", between(CLAMPED, wall), THRUST, 4.0 * PI * PI * UNIT),
        ("on a hinge", between(&spring, pin), THRUST, hinged(2.0).powi(2) * UNIT),
        ("under its weight", CLAMPED.to_owned(), weight, 7.837_347_438_9 * UNIT / LENGTH),
    ];
    for (what, clamps, load, exact) in cases {
        let bounds = [0.8 * exact, 1.2 * exact];
        let values = MESHES.map(|segments| buckling_factor(segments, &clamps, load, bounds));
        let limit = second_order_limit(what, values, exact, 0.03);
        assert!(limit.abs() < 1e-5, "{what}: {limit:e}");
    }
}

/// Complete elliptic integrals of the first and second kind by the arithmetic-geometric mean.
fn elliptic(k: f64) -> (f64, f64) {
    let (mut a, mut b, mut c) = (1.0, (1.0 - k * k).sqrt(), k);
    let (mut sum, mut weight) = (0.5 * c * c, 1.0);
    while c.abs() > 1e-16 {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        sum += weight * c * c;
        weight *= 2.0;
    }
    let first = 0.5 * PI / a;
    (first, first * (1.0 - sum))
}

/// Beyond its critical load the straight column is a saddle. The solver finds the elastica with tip
/// angle `a`: with `k = sin(a/2)` the load is `K^2 B/L^2`, and the tip lies at `2 k L / K` aside
/// and `(2 E / K - 1) L` above the clamp.
#[test]
fn post_buckling_of_the_clamped_free_column() {
    for degrees in [30.0_f64, 60.0, 120.0] {
        let modulus = (0.5 * degrees.to_radians()).sin();
        let (first, second) = elliptic(modulus);
        let load = first * first * UNIT;
        let tips = MESHES.map(|segments| {
            let scene = cantilever(segments, [0.0, 0.0, -load], "task: Equilibrium()");
            let (assembly, report) = solved(&scene);
            assert_eq!(report.equilibrium.unwrap().certificate.negative, 0);
            assembly.tip_nm(assembly.system.state(), End::End)
        });
        let side = tips.map(|tip| tip.xy().norm() / LENGTH);
        let height = tips.map(|tip| tip.z / LENGTH + load / SHEAR);
        for (name, values, exact) in [
            ("side", side, 2.0 * modulus / first),
            ("height", height, 2.0 * second / first - 1.0),
        ] {
            let what = format!("buckled by {degrees} deg, {name}");
            let limit = second_order_limit(&what, values, exact, 0.02);
            assert!(limit.abs() < 1e-5, "{what}: {limit:e}");
        }
    }
}

/// A rod between walls with a small transverse force is compressed to 1.25 nm, far beyond its
/// critical 1.6e-4 nm. The path ends on the branch on the side of the force.
#[test]
fn a_pushed_rod_stays_on_the_side_of_its_force() {
    for force in [0.005_f64, -0.005] {
        let (assembly, report) = solved(&format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 1000.0, segments: 50)],
                    rod: RodModel(law: Constant, material: Rigidities(
                        shear_pn: (1e6, 1e6, 1e7), bend_pn_nm2: (8e4, 4e4, 8e4),
                    )),
                ),
                clamps: [Clamp(end: Start), Clamp(end: End)],
                loads: [Force(at_nm: 500.0, force_pn: ({force:?}, 0.0, 0.0))],
                path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -1.25))])],
                task: Equilibrium(),
            )"
        ));
        let middle = assembly.system.state().points.position.get(25);
        println!("{force} pN: middle at {middle:?}, {} jumps", report.jumps);
        // First mode of a thin rod: 2 sqrt(1000 * 1.25) / pi.
        let theory = 22.51 * force.signum();
        assert!((middle.x - theory).abs() < 0.05, "{middle}");
        assert_eq!(report.jumps, 0);
    }
}

/// A path with an abrupt start and a small snap is followed in few iterations; halving each step that crosses the snap
/// took 707 instead of 428.
#[test]
fn a_twisted_filament_buckles_in_few_iterations() {
    let scene = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenarios/figure-8/rod-140.ron"
    );
    let ran = Scene::from_path(scene).unwrap().solve().unwrap();
    let found = ran.outcome.equilibrium.unwrap();
    assert_eq!(ran.outcome.jumps, 1);
    assert!(found.newton_iterations < 500, "{}", found.newton_iterations);
}
