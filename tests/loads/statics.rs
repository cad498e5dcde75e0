//! Equilibria under loads of every kind against closed solutions of rods.

use super::common::{
    BEND, DENSITY, LENGTH, SHEAR, TWIST, cantilever, deflection_under_uniform_force, run, twisting,
};
use crate::theory::second_order_limit;
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use actin_sim::{Assembly, End};
use std::f64::consts::PI;

const TASK: &str = "task: Equilibrium(),";

fn solved(segments: usize, loads: &str) -> Assembly {
    run(&cantilever(segments, SHEAR, loads, TASK)).0
}

fn stiff_in_twist(segments: usize, loads: &str) -> Assembly {
    let rest = "path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)])], task: Equilibrium(),";
    run(&twisting(segments, (SHEAR, 2.0 * BEND), loads, rest)).0
}

fn tip(assembly: &Assembly) -> Vector3 {
    assembly.tip_nm(assembly.system.state(), End::End)
}

/// Rotation of the segment with its middle, or of the end, at an arc length (nm).
fn turn_at(assembly: &Assembly, s_nm: f64) -> UnitQuaternion {
    let found = assembly
        .frames
        .iter()
        .position(|f| (f.s_nm - s_nm).abs() < 1e-9);
    let frame = found.expect("a segment has its middle here");
    assembly.system.state().frames.orientation.get(frame)
}

fn wall_torque(assembly: &mut Assembly) -> Vector3 {
    let loads = assembly.system.loads().clone();
    assembly.clamps[0]
        .reaction(assembly.system.state(), &loads)
        .torque_pn_nm
}

/// An axial couple gives the twist `M s / C` at `s`, exactly on any mesh, up to one and a half
/// turns. Beyond its place the rod is untwisted.
#[test]
fn a_couple_twists() {
    // About 3 rad over 160 nm.
    let size = 250.0;
    let mut assembly = solved(
        16,
        &format!("Couple(end: End, couple_pn_nm: (0.0, 0.0, {size:?}))"),
    );
    for s_nm in [5.0, 75.0, 155.0] {
        let expected = rotation::exp(Vector3::z() * (size * s_nm / TWIST));
        let off = rotation::log(turn_at(&assembly, s_nm) * expected.inverse()).norm();
        // Residual of 1e-7 pN nm over C/L, 81 pN nm/rad.
        assert!(off < 1e-8, "{s_nm}: {off:e}");
    }
    let torque = wall_torque(&mut assembly);
    assert!((torque + Vector3::z() * size).norm() < 1e-6, "{torque}");
    // At 63.7 nm, between two middles.
    let at = 63.7;
    let assembly = solved(
        16,
        &format!("Couple(at_nm: {at:?}, couple_pn_nm: (0.0, 0.0, {size:?}))"),
    );
    for s_nm in [75.0, 155.0] {
        let off = rotation::log(turn_at(&assembly, s_nm)) - Vector3::z() * (size * at / TWIST);
        assert!(off.norm() < 1e-8, "{s_nm}: {off}");
    }
}

/// A couple per length `t` rotates the tip by `t L^2 / 2C`; on an interval from `a` to `b`, by `t
/// (b^2 - a^2) / 2C`.
#[test]
fn a_couple_per_length_twists() {
    let size = 1.5;
    for (from, to, slack) in [(0.0, LENGTH, 1e-8), (20.0, 90.0, 1e-8)] {
        let load = format!(
            "CouplePerLength(from_nm: {from:?}, to_nm: {to:?}, couple_pn_nm_per_nm: (0.0, 0.0, {size:?}))"
        );
        let assembly = solved(16, &load);
        // The last frame is at its middle; the half segment after it adds t h^2 / 8C.
        let beyond = if to < LENGTH {
            0.0
        } else {
            size * 5.0 * 5.0 / (2.0 * TWIST)
        };
        let exact = size * (to * to - from * from) / (2.0 * TWIST) - beyond;
        let turn = rotation::log(turn_at(&assembly, 155.0)).z;
        assert!(
            (turn - exact).abs() < slack + size * 12.5 / TWIST,
            "{turn} {exact}"
        );
    }
}

/// A transverse couple bends the rod into an arc, here up to 0.9 of half a circle, beyond which it
/// leaves the plane. The chord converges with order two, and the angle is exact on any mesh.
#[test]
fn a_couple_bends_into_an_arc() {
    for angle in [0.5 * PI, 0.9 * PI] {
        let size = angle * BEND / LENGTH;
        let radius = LENGTH / angle;
        let exact = 2.0 * radius * (0.5 * angle).sin();
        let chords = [10, 20, 40].map(|segments| {
            let load = format!("Couple(end: End, couple_pn_nm: (0.0, {size:?}, 0.0))");
            let assembly = stiff_in_twist(segments, &load);
            let middle = LENGTH - 0.5 * LENGTH / segments as f64;
            let turn = turn_at(&assembly, middle) * Vector3::z();
            let expected = angle * middle / LENGTH;
            assert!((turn.x - expected.sin()).abs() < 1e-8, "{turn}");
            tip(&assembly).norm()
        });
        let limit = second_order_limit(&format!("arc of {angle:.2} rad"), chords, exact, 0.05);
        assert!(limit.abs() < 1e-5, "{limit:e}");
    }
}

/// A couple about any other axis bends the rod into a helix about the uniform internal moment `m`:
/// the tangent rotates about `m` at `|m|/B` per length. The moment is the torque of the load:
///
/// ```text
/// m = M (e + Re) / (1 + e . Re)
/// ```
#[test]
fn a_couple_bends_into_a_helix() {
    let couple = Vector3::new(300.0, 0.0, 260.0);
    let axis = couple.normalize();
    let tips = [16, 32, 64].map(|segments| {
        let load = format!(
            "Couple(end: End, couple_pn_nm: ({:?}, 0.0, {:?}))",
            couple.x, couple.z
        );
        let mut assembly = stiff_in_twist(segments, &load);
        let borne = -wall_torque(&mut assembly);
        let swung = turn_at(&assembly, LENGTH) * axis;
        let expected = (axis + swung) * couple.norm() / (1.0 + axis.dot(&swung));
        assert!(
            (borne - expected).norm() < 1e-6 * couple.norm(),
            "{borne} {expected}"
        );
        assert!((borne.dot(&axis) - couple.norm()).abs() < 1e-6 * couple.norm());
        assert!(borne.cross(&axis).norm() > 0.1 * couple.norm(), "{borne}");
        // Integral of exp(m s / B) e3.
        let (rate, about) = (borne.norm() / BEND, borne.normalize());
        let along = about * about.z;
        let across = Vector3::z() - along;
        let angle = rate * LENGTH;
        let helix = along * LENGTH
            + across * (angle.sin() / rate)
            + about.cross(&across) * ((1.0 - angle.cos()) / rate);
        (tip(&assembly) - helix).norm()
    });
    let orders = [tips[0] / tips[1], tips[1] / tips[2]].map(f64::log2);
    assert!(
        orders.iter().all(|order| (order - 2.0).abs() < 0.05),
        "{orders:?}"
    );
    assert!(tips[2] < 0.02, "{tips:?}");
}

/// Force between two nodes, at small deflection: `F a^2 (3 L - a) / 6 B` at the tip.
#[test]
fn a_force_at_any_arc_length_bends() {
    let (force, at) = (1e-3, 190.0 / 3.0);
    let exact = force * at * at * (3.0 * LENGTH - at) / (6.0 * BEND) + force * at / SHEAR;
    let tips = [16, 32, 64].map(|segments| {
        let load = format!("Force(at_nm: {at:?}, force_pn: ({force:?}, 0.0, 0.0))");
        tip(&solved(segments, &load)).x
    });
    let limit = second_order_limit("force at a third of a segment", tips, exact, 0.05);
    assert!(limit.abs() < 1e-5, "{limit:e}");
}

/// Uniform force against beam theory, `w L^4 / 8 B` if small. Weight gives the same result to
/// round-off.
#[test]
fn a_uniform_force_bends() {
    for (alpha, slack, bound) in [(1e-3, 0.05, 1e-5), (4.0, 0.05, 1e-5), (20.0, 0.3, 1e-4)] {
        let [coarse, exact] = [1000, 2000].map(|n| deflection_under_uniform_force(alpha, n));
        // Fourth order, far below the tolerances.
        assert!((coarse / exact - 1.0).abs() < 1e-9);
        if alpha < 0.01 {
            assert!((exact / (alpha / 8.0) - 1.0).abs() < 1e-6, "{exact}");
        }
        let w = alpha * BEND / LENGTH.powi(3);
        let deflection = |segments, load: &str| tip(&solved(segments, load)).x / LENGTH;
        let load = format!("ForcePerLength(force_pn_per_nm: ({w:?}, 0.0, 0.0))");
        let values = [16, 32, 64].map(|segments| deflection(segments, &load));
        let limit = second_order_limit(&format!("uniform force, {alpha}"), values, exact, slack);
        assert!(limit.abs() < bound, "{alpha}: {limit:e}");
        let a = w / DENSITY;
        let weight = format!("Acceleration(acceleration_nm_per_ns2: ({a:?}, 0.0, 0.0))");
        let heavy = deflection(32, &weight);
        // Both solved to 1e-7 pN.
        assert!((heavy / values[1] - 1.0).abs() < 1e-6, "{heavy}");
    }
}

/// On an interval between nodes: `w (3 L^4 - 4 a^3 L + a^4) / 24 B` from `a` to the tip.
#[test]
fn a_force_per_length_acts_on_its_interval() {
    let (w, a) = (1e-5, 59.0);
    let moment = 3.0 * LENGTH.powi(4) - 4.0 * a * a * a * LENGTH + f64::powi(a, 4);
    let exact = w * moment / (24.0 * BEND);
    for (segments, bound) in [(16, 4e-3), (64, 3e-4)] {
        let load = format!("ForcePerLength(from_nm: {a:?}, force_pn_per_nm: ({w:?}, 0.0, 0.0))");
        let error = tip(&solved(segments, &load)).x / exact - 1.0;
        assert!(error.abs() < bound, "{segments}: {error:e}");
    }
}

#[test]
fn reactions_balance_every_load_in_every_model() {
    let loads = "Force(end: End, force_pn: (0.5, 0.0, 0.3)),
        Force(at_nm: 21.3, force_pn: (0.0, 0.4, 0.0)),
        Couple(end: End, couple_pn_nm: (0.0, 3.0, 5.0)),
        Couple(at_nm: 21.3, couple_pn_nm: (2.0, 0.0, 0.0)),
        ForcePerLength(from_nm: 5.0, to_nm: 33.0, force_pn_per_nm: (0.0, 0.01, 0.0)),
        CouplePerLength(from_nm: 5.0, to_nm: 33.0, couple_pn_nm_per_nm: (0.0, 0.0, 0.1)),
        Acceleration(acceleration_nm_per_ns2: (0.05, 0.0, 0.0)),";
    for sections in [
        "Rod(from_nm: 0.0, to_nm: 40.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 40.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 40.0)",
    ] {
        let text = format!(
            "Scene(filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)), clamps: [Clamp(end: Start)],
                loads: [{loads}], task: Equilibrium())"
        );
        let (mut assembly, _) = run(&text);
        let all = assembly.system.loads().clone();
        let reaction = assembly.clamps[0].reaction(assembly.system.state(), &all);
        let moving =
            (0..assembly.points.len()).filter(|i| assembly.system.state().points.is_free(*i));
        let mass: f64 = moving.map(|i| assembly.system.state().points.mass(i)).sum();
        let held: f64 = assembly.clamps[0]
            .points
            .iter()
            .map(|&i| assembly.system.state().points.mass(i))
            .sum();
        let expected = Vector3::new(0.5 + 0.05 * (mass + held), 0.4 + 0.28, 0.3);
        let off = (reaction.force_pn + expected).norm();
        // About thirty bodies of 1e-7 pN each.
        assert!(off < 1e-5, "{sections}: {}", reaction.force_pn);
        // The energy of the loads decreases by their work.
        let energies = assembly.system.energies();
        let terms = assembly.terms.iter().zip(&energies);
        let of_loads: Vec<f64> = terms
            .filter(|(t, _)| t.name == "load")
            .map(|(_, e)| *e)
            .collect();
        assert_eq!(of_loads.len(), 7);
        assert!(of_loads.iter().sum::<f64>() < 0.0, "{of_loads:?}");
    }
}

#[test]
fn turns_of_a_driven_wall_are_counted() {
    let load = "Couple(end: End, couple_pn_nm: (0.0, 0.0, 1.0))";
    let rest =
        "path: [Stage(set: [Turn(end: Start, turn_deg: (0.0, 0.0, 900.0))])], task: Equilibrium(),";
    let (assembly, _) = run(&cantilever(16, SHEAR, load, rest));
    let expected = -5.0 * PI - LENGTH / (2.0 * TWIST);
    let error = energy(&assembly) / expected - 1.0;
    assert!(error.abs() < 1e-9, "{error:e}");
}

fn coupled(end: End, (sections, law): (&str, &str), couple: [f64; 3]) -> Assembly {
    let [x, y, z] = couple;
    let held = match end {
        End::Start => "End",
        End::End => "Start",
    };
    let text = format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: RodModel(law: {law})),
            clamps: [Clamp(end: {held})],
            loads: [Couple(end: {end:?}, couple_pn_nm: ({x:?}, {y:?}, {z:?}))],
            task: Equilibrium(force_pn: 1e-10, torque_pn_nm: 1e-10),
        )"
    );
    run(&text).0
}

fn energy(assembly: &Assembly) -> f64 {
    assembly.system.potential_energy()
}

/// A couple `M` rotates its end by `M L / B` and stores `M^2 L / 2 B` on any mesh. The tolerance
/// covers residuals of 1e-10 for couples of 5 pN nm, and rounding.
#[test]
fn a_couple_acts_at_the_end_of_a_rod() {
    for end in [End::Start, End::End] {
        for (couple, rigidity) in [([0.0, 0.0, 5.0], TWIST), ([5.0, 0.0, 0.0], BEND)] {
            let exact = -25.0 * LENGTH / (2.0 * rigidity);
            for segments in [1, 2, 5, 16] {
                let rod = format!("Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: {segments})");
                let found = energy(&coupled(end, (&rod, "Constant"), couple));
                let error = found / exact - 1.0;
                assert!(
                    error.abs() < 1e-9,
                    "{end:?} {couple:?} {segments}: {error:e}"
                );
            }
        }
    }
}

/// The work of an end couple is independent of the mesh, except for the wall corrections of
/// `Homogenised`. The tolerance there is a tenth of the error without the end's half segment, `1 /
/// 4n` from `n` to `2n` segments.
#[test]
fn the_work_of_an_end_couple_is_independent_of_the_mesh() {
    for (law, bound) in [
        ("Homogenised", 0.025),
        ("HomogenisedAt298K", 0.025),
        ("PublishedExtension", 1e-8),
        ("CouplingEnergy", 1e-8),
        ("Fitted", 1e-8),
    ] {
        for couple in [[0.0, 0.0, 20.0], [0.0, 20.0, 0.0]] {
            let [a, b, c] = [4, 8, 16].map(|n| {
                let rod = format!("Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: {n})");
                energy(&coupled(End::End, (&rod, law), couple))
            });
            let [first, second] = [(a - b) / c, (b - c) / c].map(f64::abs);
            assert!(
                4.0 * first < bound && 8.0 * second < bound,
                "{law} {couple:?}"
            );
        }
    }
}

/// After monomers, the half segment at the end also twists by `M h / 2 C`.
#[test]
fn an_end_couple_after_monomers_twists_half_a_segment() {
    let size = 20.0;
    let sections =
        "Ellipsoids(from_nm: 0.0, to_nm: 40.0), Rod(from_nm: 40.0, to_nm: 160.0, segments: 4)";
    let assembly = coupled(End::End, (sections, "Constant"), [0.0, 0.0, size]);
    let half = LENGTH - assembly.frames[assembly.sections[1].frames.end - 1].s_nm;
    let last = turn_at(&assembly, LENGTH - half);
    let turn = rotation::log(last.inverse() * turn_at(&assembly, LENGTH)).z;
    let expected = size * half / TWIST;
    // Residual of 1e-10 pN nm, and rounding.
    assert!((turn / expected - 1.0).abs() < 1e-9, "{turn} {expected}");
}
