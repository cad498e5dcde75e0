//! 45-degree bend of Bathe and Bolourchi: a curved cantilever under a force out of its plane.

use crate::common::ran;
use crate::theory::second_order_limit;
use actin_mechanics::{Matrix3, Vector3};
use actin_sim::{At, End};
use std::f64::consts::FRAC_PI_4;

const RADIUS: f64 = 100.0;
/// Stretch and shear rigidity: Young's modulus 1e7 on a unit square, Poisson's ratio 0, shear
/// factor 5/6.
const STRETCH: f64 = 1e7;
const SHEAR: f64 = STRETCH * 5.0 / 12.0;
/// Bending and twisting rigidity: 1e7 times the second moment 1/12 of the square.
const BEND: f64 = 1e7 / 12.0;
const FORCES: [f64; 3] = [300.0, 450.0, 600.0];
/// Tip under the last force: along the tangent at the clamp, towards the centre, out of the plane.
/// Source: Bathe and Bolourchi, Int. J. Numer. Meth. Eng. 14 (1979) 961, converged on fine meshes.
const TIP: [f64; 3] = [47.150_096, 15.684_689, 53.475_478];

/// Rod as an initial value problem: centre line, frame and moment (lab) along the arc.
#[derive(Clone, Copy)]
struct Section {
    place: Vector3,
    frame: Matrix3,
    couple: Vector3,
}

impl Section {
    /// `r' = Q (e3 + S^-1 Q^T n)`, `Q' = Q [k0 + B^-1 Q^T m]x`, `m' = -r' x n`.
    fn derivative(&self, force: Vector3) -> Self {
        let load = self.frame.tr_mul(&force);
        let strain = load.component_div(&Vector3::new(SHEAR, SHEAR, STRETCH));
        let tangent = self.frame * (Vector3::z() + strain);
        let curvature = Vector3::y() / RADIUS + self.frame.tr_mul(&self.couple) / BEND;
        Self {
            place: tangent,
            frame: self.frame * curvature.cross_matrix(),
            couple: -tangent.cross(&force),
        }
    }

    fn plus(&self, other: &Self, h: f64) -> Self {
        Self {
            place: self.place + other.place * h,
            frame: self.frame + other.frame * h,
            couple: self.couple + other.couple * h,
        }
    }

    fn at_tip(couple: Vector3, force: Vector3, steps: usize) -> Self {
        let mut at = Self {
            place: Vector3::zeros(),
            frame: Matrix3::identity(),
            couple,
        };
        let h = RADIUS * FRAC_PI_4 / steps as f64;
        for _ in 0..steps {
            let a = at.derivative(force);
            let b = at.plus(&a, 0.5 * h).derivative(force);
            let c = at.plus(&b, 0.5 * h).derivative(force);
            let d = at.plus(&c, h).derivative(force);
            let sum = a.plus(&b, 2.0).plus(&c, 2.0).plus(&d, 1.0);
            at = at.plus(&sum, h / 6.0);
        }
        at
    }
}

/// Tip by shooting for the moment at the clamp that vanishes at the tip.
fn shot(force: f64, steps: usize) -> [f64; 3] {
    let mut couple = Vector3::zeros();
    for part in 1..=8 {
        let load = Vector3::y() * (force * f64::from(part) / 8.0);
        let miss = |couple| Section::at_tip(couple, load, steps).couple;
        let difference = 1e-3 * force;
        for _ in 0..8 {
            let column = |axis: Vector3| {
                let [ahead, behind] = [difference, -difference].map(|d| miss(couple + axis * d));
                (ahead - behind) / (2.0 * difference)
            };
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
            let slope = Matrix3::from_columns(&axes.map(column));
            let step = slope.try_inverse().expect("the path has no bifurcation") * miss(couple);
            couple -= step;
        }
        // Relative to moments of 600 times 70.
        assert!(miss(couple).norm() < 1e-8, "{}", miss(couple));
    }
    let tip = Section::at_tip(couple, Vector3::y() * force, steps).place;
    [tip.z, tip.x, tip.y]
}

/// Published tips under these forces on eight elements: along the tangent, towards the centre, out
/// of the plane. Source: Simo and Vu-Quoc, Comput. Methods Appl. Mech. Eng. 58 (1986) 79, Table 6.
const PUBLISHED: [[f64; 3]; 3] = [
    [58.84, 22.33, 40.08],
    [52.32, 18.62, 48.39],
    [47.23, 15.79, 53.37],
];

const TASK: &str = "task: Equilibrium(force_pn: 1e-6, torque_pn_nm: 1e-6),";

/// Scene of the bend on `n` segments.
fn scene(n: usize) -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/bend-45.ron");
    let text = std::fs::read_to_string(path).unwrap();
    let text = text.replace("segments: 32", &format!("segments: {n}"));
    text.replace("task: Equilibrium(),", TASK)
}

fn tips(n: usize) -> Vec<[f64; 3]> {
    let text = scene(n);
    let (assembly, trajectory, _) = ran(&text);
    let ends = [1.0, 2.0, 3.0].map(|end| {
        let record = trajectory.records.iter().rfind(|r| r.at == At::Path(end));
        let tip = assembly.tip_nm(&record.expect("stages end in a record").state, End::End);
        [tip.z, tip.x, tip.y]
    });
    ends.to_vec()
}

/// Curvature at rest, bending in both planes and twist are coupled. The published tip for 600
/// verifies the shooting, which is the reference for other loads.
#[test]
fn the_bend_converges_to_its_tip_with_order_two() {
    let meshes = [64, 128, 256].map(tips);
    for (i, force) in FORCES.into_iter().enumerate() {
        let [coarse, exact] = [200, 400].map(|steps| shot(force, steps));
        println!("{force}: {exact:?}");
        for (k, axis) in ["tangent", "radial", "normal"].into_iter().enumerate() {
            let values = [0, 1, 2].map(|mesh: usize| meshes[mesh][i][k]);
            let what = format!("bend, {force}, {axis}");
            let limit = second_order_limit(&what, values, exact[k], 0.005);
            assert!(limit.abs() < 5e-7, "{what}: {limit:e}");
            // Fourth order: the difference is 15 times the remaining error.
            assert!((coarse[k] - exact[k]).abs() < 1e-8, "{coarse:?}, {exact:?}");
            if i == 2 {
                assert!((exact[k] - TIP[k]).abs() < 1e-6, "{exact:?}");
            }
            // The published eight elements have errors up to half a per cent of the radius.
            let off = (exact[k] - PUBLISHED[i][k]).abs();
            assert!(off < 0.5, "{what}: {} {}", exact[k], PUBLISHED[i][k]);
        }
    }
}

/// From the shape at rest under the full load, convergence takes 22 to 51 steps, depending on
/// round-off.
#[test]
fn the_full_load_is_solved_at_once() {
    let text = scene(64);
    let (at_rest, _) = text.split_once("path:").unwrap();
    let (assembly, _, outcome) = ran(&format!("{at_rest} {TASK})"));
    assert!(outcome.equilibrium.unwrap().newton_iterations < 100);
    let tip = assembly.tip_nm(assembly.system.state(), End::End);
    for (found, by_path) in [tip.z, tip.x, tip.y].into_iter().zip(tips(64)[2]) {
        // Residuals of 1e-6 with compliances below 1.
        assert!((found - by_path).abs() < 1e-5, "{found} {by_path}");
    }
}
