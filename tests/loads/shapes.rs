//! Filaments built along a curve: bodies, ends, sites and loads.

use super::common::{build, run};
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use actin_sim::{Assembly, End};
use std::f64::consts::FRAC_PI_2;

const RADIUS: f64 = 60.0;
const LENGTH: f64 = RADIUS * FRAC_PI_2;
const ROD: &str = "Rod(from_nm: 0.0, to_nm: L, segments: 20)";
const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: L)";
const MIXED: &str =
    "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0, segments: 10),
    Ellipsoids(from_nm: 60.0, to_nm: L)";

fn text(sections: &str, shape: &str, rest: &str) -> String {
    let sections = sections.replace('L', &format!("{LENGTH:?}"));
    format!(
        "Scene(
            filament: Filament(
                sections: [{sections}], shape: {shape},
                at_nm: (3.0, -2.0, 5.0), direction: (1.0, 2.0, 2.0), roll_deg: 20.0,
                rod: RodModel(law: Constant),
            ),
            {rest}
        )"
    )
}

const ARC: &str = "Arc(radius_nm: 60.0, azimuth_deg: 90.0)";

fn on_arc(assembly: &Assembly, s: f64) -> (Vector3, UnitQuaternion) {
    let span = &assembly.filaments[0];
    let (sin, cos) = (s / RADIUS).sin_cos();
    let place = Vector3::new(0.0, RADIUS * (1.0 - cos), RADIUS * sin);
    let frame = rotation::exp(-Vector3::x() * (s / RADIUS));
    (
        span.origin_nm + span.rotation * place,
        span.rotation * frame,
    )
}

#[test]
fn every_model_follows_the_arc() {
    let rest = "clamps: [Clamp(end: Start), Clamp(end: End)],
        linkers: [Linker(at_nm: 45.0, radius_nm: 1.8, azimuth_deg: 30.0,
            displaced_nm: (1.0, 2.0, 3.0), stiffness_pn_per_nm: 5.0)],
        task: Equilibrium(),";
    // Segments l are tangents of a polygon that is wider by (l/R)^2/24 of the radius.
    let wider = 1.01 * 2.0_f64.sqrt() * (LENGTH / 20.0).powi(2) / (24.0 * RADIUS);
    for (sections, miss) in [(ROD, wider), (MONOMERS, 1e-12), (MIXED, wider)] {
        let assembly = build(&text(sections, ARC, rest));
        for (i, point) in assembly.points.iter().enumerate() {
            let (place, _) = on_arc(&assembly, point.s_nm);
            let found = assembly.centre_line_nm(&assembly.rest, i);
            // A monomer's frame is at its arc length: its centre projects to the axis.
            assert!(
                (found - place).norm() < miss,
                "{sections} {point:?}: {found} {place}"
            );
        }
        for clamp in &assembly.clamps {
            let s = if clamp.end == End::Start {
                0.0
            } else {
                assembly.length_nm()
            };
            let (place, _) = on_arc(&assembly, s);
            assert!((clamp.about_nm - place).norm() < miss);
            assert!((clamp.point_nm(&assembly.rest) - clamp.about_nm).norm() < 1e-12);
        }
        let (place, frame) = on_arc(&assembly, 45.0);
        let (sin, cos) = 30.0_f64.to_radians().sin_cos();
        let site = place + frame * Vector3::new(1.8 * cos, 1.8 * sin, 0.0);
        let found = assembly.linkers[0].site().position(&assembly.rest);
        let tilt = if sections == MONOMERS {
            1e-12
        } else {
            1.8 * 2.4 / RADIUS
        };
        assert!(
            (found - site).norm() < miss + tilt,
            "{sections}: {found} {site}"
        );
    }
}

#[test]
fn bent_filaments_start_under_stress() {
    let rest = "clamps: [Clamp(end: Start), Clamp(end: End)], task: Equilibrium(),";
    let assembly = build(&text(ROD, ARC, rest));
    let energy: f64 = assembly
        .system
        .interactions()
        .iter()
        .map(|term| term.energy(&assembly.rest))
        .sum();
    let expected = 0.5 * 3.9e4 * LENGTH / (RADIUS * RADIUS);
    assert!(
        (energy / expected - 1.0).abs() < 1e-10,
        "{energy} {expected}"
    );
    let monomers = build(&text(MONOMERS, ARC, rest));
    let bent: f64 = (monomers.system.interactions().iter())
        .map(|term| term.energy(&monomers.rest))
        .sum();
    // Monomers in uniform bending are stiffer than rods, whose rigidity includes relaxation.
    assert!(bent > energy, "{bent}");
}

#[test]
fn released_filaments_become_straight() {
    let rest = "clamps: [Clamp(end: Start)],
        loads: [EndForce(end: End, force_pn: (0.0, 0.0, 0.0))], task: Equilibrium(),";
    let (assembly, _) = run(&text(ROD, ARC, rest));
    let span = &assembly.filaments[0];
    let tip = assembly.tip_nm(assembly.system.state(), End::End);
    let straight = span.origin_nm + span.axis() * LENGTH;
    // Residuals of 1e-7 pN on a cantilever with 6 nm per pN.
    assert!((tip - straight).norm() < 1e-5, "{tip} {straight}");
}

#[test]
fn ends_slide_along_their_tangents() {
    let rest =
        "clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)], task: Equilibrium(),";
    let assembly = build(&text(ROD, ARC, rest));
    let slider = &assembly.rest.sliders[0];
    let (_, frame) = on_arc(&assembly, LENGTH);
    assert!((slider.directions[0] - frame * Vector3::z()).norm() < 1e-12);
}

#[test]
fn imperfections_add_to_the_shape() {
    let shape = format!("{ARC}, imperfection: (amplitude_nm: 0.2, seed: 3)");
    let rest = "clamps: [Clamp(end: Start), Clamp(end: End)], task: Equilibrium(),";
    for sections in [ROD, MONOMERS] {
        let assembly = build(&text(sections, &shape, rest));
        let moved: Vec<f64> = (0..assembly.points.len())
            .map(|i| {
                let at = |state| assembly.centre_line_nm(state, i);
                (at(assembly.system.state()) - at(&assembly.rest)).norm()
            })
            .collect();
        let largest = moved.iter().copied().fold(0.0, f64::max);
        assert!((largest / 0.2 - 1.0).abs() < 0.02, "{largest}");
        assert!(moved[0] < 1e-12 && moved[moved.len() - 1] < 1e-12);
    }
}
