//! Critical loads of columns from singular stiffness, and post-buckling.

use super::common::{
    BEND, LENGTH, SHEAR, build, cantilever, critical, frame, material, newton, point, solved, to,
};
use crate::theory::second_order_limit;
use actin_cosserat::{RodElements, RodJoint, RodSegment};
use actin_equilibrium::{BodyOrder, Group, Layout, Newton};
use actin_mechanics::{Interaction, PointLoad, State, UnitQuaternion, Vector3};
use actin_sim::End;
use std::f64::consts::PI;

const MESHES: [usize; 3] = [16, 32, 64];

/// `B / L^2` of [`cantilever`].
const UNIT: f64 = BEND / (LENGTH * LENGTH);

#[test]
fn clamped_free_column() {
    let values = MESHES.map(|segments| {
        let assembly = build(&cantilever(
            segments,
            [0.0, 0.0, -1.0],
            "task: Equilibrium()",
        ));
        let mut newton = newton(&assembly, 1e-8);
        let interactions = assembly.system.interactions();
        let straight = assembly.system.state();
        critical(
            &mut newton,
            straight,
            interactions,
            [2.0 * UNIT, 3.0 * UNIT],
        )
    });
    let exact = 0.25 * PI * PI * UNIT;
    let limit = second_order_limit("Euler, clamped and free", values, exact, 0.03);
    assert!(limit.abs() < 1e-5, "{limit:e}");
}

#[derive(Default)]
struct Parts {
    segments: Vec<RodSegment>,
    joints: Vec<RodJoint>,
}

impl Parts {
    fn rod(self) -> RodElements {
        RodElements::new(material([1e4; 3], [1.0; 3]), self.segments, self.joints).unwrap()
    }
}

/// Straight column of unit length and bending rigidity on `n` segments along z. Without a wall its
/// first frame is free.
fn column(n: usize, wall: bool) -> (State, Parts, BodyOrder) {
    let h = 1.0 / n as f64;
    let mut state = State::default();
    let mut parts = Parts::default();
    let mut order = BodyOrder::default();
    for k in 0..=n {
        point(&mut state, Vector3::z() * (h * k as f64));
        order.points.push(k as f64);
    }
    for k in 0..n {
        let own = frame(&mut state, UnitQuaternion::identity());
        order.frames.push(k as f64 + 0.5);
        parts.segments.push(RodSegment {
            points: [k, k + 1],
            frame: own,
            rest_length: h,
        });
        if k > 0 {
            parts.joints.push(RodJoint::straight([k - 1, k], h));
        }
    }
    state.points.hold(0);
    if wall {
        let held = frame(&mut state, UnitQuaternion::identity());
        order.frames.push(0.0);
        state.frames.hold(held);
        parts.joints.push(RodJoint::straight([held, 0], 0.5 * h));
    }
    state.add_control(0.0);
    (state, parts, order)
}

/// The axial rotation is a neutral mode.
#[test]
fn pinned_column() {
    let values = MESHES.map(|n| {
        let (state, parts, order) = column(n, false);
        let control = state.controls.ids().next().unwrap();
        let load = PointLoad::new(&state, vec![(n, 1.0)], -Vector3::z(), control).unwrap();
        let slider = Group::sliding(vec![n], vec![], Vector3::z());
        let layout = Layout::new(&state, Some(&order), vec![slider]).unwrap();
        let mut newton = Newton::new(layout, to(1e-9)).unwrap();
        let terms: Vec<Box<dyn Interaction>> = vec![Box::new(parts.rod()), Box::new(load)];
        critical(&mut newton, &state, &terms, [9.0, 11.0])
    });
    let limit = second_order_limit("Euler, pinned", values, PI * PI, 0.03);
    assert!(limit.abs() < 1e-5, "{limit:e}");
}

#[test]
fn clamped_column() {
    let values = MESHES.map(|n| {
        let (mut state, mut parts, mut order) = column(n, true);
        let held = frame(&mut state, UnitQuaternion::identity());
        order.frames.push(n as f64);
        state.frames.hold(held);
        let distance = 0.5 / n as f64;
        let joint = RodJoint::straight([n - 1, held], distance);
        parts.joints.push(joint);
        let control = state.controls.ids().next().unwrap();
        let load = PointLoad::new(&state, vec![(n, 1.0)], -Vector3::z(), control).unwrap();
        let slider = Group::sliding(vec![n], vec![held], Vector3::z());
        let layout = Layout::new(&state, Some(&order), vec![slider]).unwrap();
        let mut newton = Newton::new(layout, to(1e-9)).unwrap();
        let terms: Vec<Box<dyn Interaction>> = vec![Box::new(parts.rod()), Box::new(load)];
        critical(&mut newton, &state, &terms, [36.0, 42.0])
    });
    let limit = second_order_limit("Euler, clamped", values, 4.0 * PI * PI, 0.03);
    assert!(limit.abs() < 1e-5, "{limit:e}");
}

/// Column under its own weight: `q L^3 / B = 7.8373474389`, from the smallest zero of a Bessel
/// function of order -1/3. Source: Greenhill (1881).
#[test]
fn greenhills_column() {
    let values = MESHES.map(|n| {
        let (state, parts, order) = column(n, true);
        let weight = |k: usize| if k == n { 0.5 } else { 1.0 } / n as f64;
        let shares = (1..=n).map(|k| (k, weight(k))).collect();
        let control = state.controls.ids().next().unwrap();
        let load = PointLoad::new(&state, shares, -Vector3::z(), control).unwrap();
        let layout = Layout::new(&state, Some(&order), vec![]).unwrap();
        let mut newton = Newton::new(layout, to(1e-9)).unwrap();
        let terms: Vec<Box<dyn Interaction>> = vec![Box::new(parts.rod()), Box::new(load)];
        critical(&mut newton, &state, &terms, [7.0, 9.0])
    });
    let limit = second_order_limit("Greenhill", values, 7.837_347_438_9, 0.03);
    assert!(limit.abs() < 1e-5, "{limit:e}");
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
