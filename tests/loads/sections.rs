//! Stretches of monomers that differ from the rest of their filament.

use super::common::{build, run};
use crate::common::refusal;
use actin_mechanics::{Vector3, Xorshift, perturb, rotation};
use actin_sim::{Assembly, End};

/// Length of filaments with a middle, and of those that are the same all along (nm).
const LENGTH: f64 = 210.0;
const SPECIMEN: f64 = 120.0;

fn text(sections: &str, loads: &str) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],
            loads: [{loads}],
            task: Equilibrium(),
        )"
    )
}

fn altered(lateral: f64, longitudinal: f64) -> String {
    format!(
        "altered: (lateral_rigidity_factor: {lateral:?}, longitudinal_rigidity_factor: {longitudinal:?})"
    )
}

/// All of a specimen, with or without a change.
fn whole(change: &str) -> String {
    format!("Ellipsoids(from_nm: 0.0, to_nm: {SPECIMEN:?}, {change})")
}

/// A changed stretch from 60 to 150 nm.
fn middle(change: &str) -> String {
    format!(
        "Ellipsoids(from_nm: 0.0, to_nm: 60.0), Ellipsoids(from_nm: 60.0, to_nm: 150.0, {change}),
         Ellipsoids(from_nm: 150.0, to_nm: {LENGTH:?})"
    )
}

/// How far the monomers about one arc length are turned against those about another, over their distance
/// (rad/nm, lab frame). Monomers wobble by as much as the filament bends in a few of them: taken are means
/// over half a turn of the helix to either side.
fn turn_between(assembly: &Assembly, places: [f64; 2]) -> Vector3 {
    let [from, to] = places.map(|s_nm| {
        let frames = assembly.frames.iter().enumerate();
        let near = frames.filter(|(_, f)| (f.s_nm - s_nm).abs() < 18.0);
        let (mut turn, mut place, mut count) = (Vector3::zeros(), 0.0, 0.0);
        for (i, frame) in near {
            let q = |state: &actin_mechanics::State| state.frames.orientation.get(i);
            turn += rotation::log(q(assembly.system.state()) * q(&assembly.rest).inverse());
            place += frame.s_nm;
            count += 1.0;
        }
        (turn / count, place / count)
    });
    (to.0 - from.0) / (to.1 - from.1)
}

/// Bonds are the same wherever a filament is cut into sections that do not differ.
#[test]
fn cuts_change_nothing() {
    let one = build(&text(
        &format!("Ellipsoids(from_nm: 0.0, to_nm: {LENGTH:?})"),
        "",
    ));
    let three = build(&text(&middle("altered: ()"), ""));
    assert_eq!(one.counts(), three.counts());
    let mut state = one.rest.clone();
    perturb(&mut state, &mut Xorshift::new(3), 0.1, 0.05);
    let energy = |assembly: &Assembly| {
        let terms = assembly.system.interactions();
        terms.iter().map(|term| term.energy(&state)).sum::<f64>()
    };
    let (a, b) = (energy(&one), energy(&three));
    // Sums of some thousand terms.
    assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    let elements: usize = three
        .system
        .interactions()
        .iter()
        .map(|t| t.elements())
        .sum();
    assert_eq!(elements, one.system.interactions()[0].elements());
}

/// All rigidities and the load changed by one factor: the same shape, by whichever way a scene says so.
#[test]
fn one_factor_is_one_of_every_rigidity() {
    let tip = |sections: &str, force: f64| {
        let load = format!("EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0))");
        let (assembly, _) = run(&text(sections, &load));
        assembly.tip_nm(assembly.system.state(), End::End)
    };
    let (full, soft) = (tip(&whole(""), 1.0), tip(&whole(&altered(0.2, 0.2)), 0.2));
    println!("one factor: {:.1e} nm", (full - soft).norm());
    // Residuals of 1e-7 pN on what 1 pN moves by some 10 nm.
    assert!((full - soft).norm() < 1e-4, "{full} {soft}");
}

/// A filament between a wall and an end that is turned by an angle (deg), aside (axis 1) where it moves freely,
/// or about its own axis (2) along which it slides; with the couple that takes (pN nm).
fn turned(sections: &str, axis: usize, angle: f64) -> (Assembly, f64) {
    let mut turn = [0.0; 3];
    turn[axis] = angle;
    let ([x, y, z], slides) = (turn, ["", "Freely", "AlongAxis"][axis]);
    let text = format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start), Clamp(end: End, slides: {slides})],
            path: [Stage(set: [Turn(end: End, turn_deg: ({x:?}, {y:?}, {z:?}))])],
            task: Equilibrium(),
        )"
    );
    let (mut assembly, _) = run(&text);
    let loads = assembly.system.loads().clone();
    let state = assembly.system.state();
    let couple = assembly.clamps[1].reaction(state, &loads).torque_pn_nm[axis];
    (assembly, couple)
}

/// How much softer a specimen is, by secant rigidities, if its end is turned by an angle (deg) about an axis.
fn softer(change: &str, axis: usize, angle: f64) -> f64 {
    let couple = |change: &str| turned(&whole(change), axis, angle).1;
    couple("") / couple(change)
}

/// What factors of rigidity can do for a stretch decorated by cofilin, where bending is 5 times and twist 10
/// times softer: one factor divides both by the same. Softer lateral bonds take more from twist than from
/// bending, the more the larger the twist is, and more from under-twist: at 0.01 rad/nm the mean of both
/// senses is 10 at 5.
#[test]
fn bending_and_twist_soften_differently() {
    for (axis, angle) in [(1, 20.0), (2, 40.0)] {
        let one = softer(&altered(0.2, 0.2), axis, angle);
        // The same shape under a fifth of the loads.
        assert!((one - 5.0).abs() < 1e-5, "{one:?}");
    }
    let cofilin = altered(0.03, 0.23);
    let bend = softer(&cofilin, 1, 20.0);
    let at = |per_nm: f64| (per_nm * SPECIMEN).to_degrees();
    let little = softer(&cofilin, 2, at(3e-3));
    let [over, under] = [1.0, -1.0].map(|sense| softer(&cofilin, 2, sense * at(0.01)));
    println!(
        "bending {bend:.2}, twist {little:.2} at 3e-3, {over:.2} and {under:.2} at 0.01 rad/nm"
    );
    assert!((4.8..5.6).contains(&bend), "{bend}");
    assert!((5.0..6.0).contains(&little), "{little}");
    assert!(over > 1.3 * little && under > 1.5 * over, "{over} {under}");
    assert!((0.5 * (over + under) - 10.0).abs() < 1.0, "{over} {under}");
}

/// A filament whose middle is softer bends and twists there as one that is soft all along does under the same
/// couple, and elsewhere as one that is not: neighbours see each other over a few monomers only.
#[test]
fn a_softened_middle_bends_and_twists_by_itself() {
    let soft = altered(0.2, 0.2);
    for (axis, angle, name) in [(1, 30.0, "bent"), (2, 60.0, "twisted")] {
        let (both, couple) = turned(&middle(&soft), axis, angle);
        for (change, place, in_specimen) in [
            ("", [20.0, 40.0], [20.0, 40.0]),
            (soft.as_str(), [80.0, 130.0], [35.0, 85.0]),
        ] {
            let here = turn_between(&both, place)[axis];
            // The clamps of a short filament hinder twist: its end is turned until it is bent or twisted
            // as much within.
            let mut angle = (here * SPECIMEN).to_degrees();
            let mut alone = 0.0;
            for _ in 0..4 {
                let (specimen, couple) = turned(&whole(change), axis, angle);
                let within = turn_between(&specimen, in_specimen)[axis];
                (angle, alone) = (angle * here / within, couple);
            }
            println!(
                "{name} at {place:?}: {here:.4e} rad/nm, couple {couple:.3}, alone {alone:.3}"
            );
            assert!(
                (couple / alone - 1.0).abs() < 0.05,
                "{name} {place:?}: {couple} {alone}"
            );
        }
    }
}

/// Mass factors of a scene change the masses of their section only.
#[test]
fn masses_are_multiplied() {
    let assembly = build(&text(&middle("altered: (mass_factor: 1.5)"), ""));
    let mass = |i: usize| assembly.system.state().points.mass(i);
    let ratio = mass(assembly.sections[1].points.start) / mass(assembly.sections[0].points.start);
    assert!((ratio - 1.5).abs() < 1e-14, "{ratio}");
}

/// Heavier monomers weigh more: what balances their weight has an equilibrium, what balances that of the others
/// has not.
#[test]
fn weight_counts_the_mass_of_sections() {
    let density = 0.0697 / (71.2 / 26.0);
    let read = |lengths: f64| {
        let force = -1e-3 * density * lengths;
        let text = format!(
            "Scene(
                filament: Filament(sections: [
                    Ellipsoids(from_nm: 0.0, to_nm: 60.0),
                    Ellipsoids(from_nm: 60.0, to_nm: 120.0, altered: (mass_factor: 2.0)),
                ]),
                loads: [
                    Acceleration(acceleration_nm_per_ns2: (1e-3, 0.0, 0.0)),
                    EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0)),
                ],
                task: Equilibrium(),
            )"
        );
        refusal(&text)
    };
    assert_eq!(read(180.0), "");
    let refused = read(120.0);
    assert!(refused.contains("it has no equilibrium"), "{refused}");
}
