//! Sections of monomers with altered parameters.

use super::common::{assert_interactions_are_gradients, build, run};
use crate::common::refusal;
use actin_mechanics::{Interaction, Vector3, Xorshift, perturb, rotation};
use actin_sim::{Assembly, End, FrameInfo};

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

fn whole(change: &str) -> String {
    format!("Ellipsoids(from_nm: 0.0, to_nm: {SPECIMEN:?}, {change})")
}

fn middle(change: &str) -> String {
    format!(
        "Ellipsoids(from_nm: 0.0, to_nm: 60.0), Ellipsoids(from_nm: 60.0, to_nm: 150.0, {change}),
         Ellipsoids(from_nm: 150.0, to_nm: {LENGTH:?})"
    )
}

/// Rotation between the monomers at two arc lengths over their distance (rad/nm, lab frame),
/// averaged over half a turn of the helix on both sides.
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
    // Sums of about a thousand terms.
    assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    let elements: usize = three
        .system
        .interactions()
        .iter()
        .map(|t| t.elements())
        .sum();
    assert_eq!(elements, one.system.interactions()[0].elements());
}

#[test]
fn one_factor_is_one_of_every_rigidity() {
    let tip = |sections: &str, force: f64| {
        let load = format!("EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0))");
        let (assembly, _) = run(&text(sections, &load));
        assembly.tip_nm(assembly.system.state(), End::End)
    };
    let (full, soft) = (tip(&whole(""), 1.0), tip(&whole(&altered(0.2, 0.2)), 0.2));
    // Residuals of 1e-7 pN for about 10 nm per pN.
    assert!((full - soft).norm() < 1e-4, "{full} {soft}");
}

/// Filament between a wall and an end turned by an angle (deg). Axis 1: transverse, sliding freely;
/// axis 2: about the filament, sliding along it. Also returns the couple.
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

/// Ratio of the secant rigidities of a specimen without and with the change, for an end turned by
/// an angle (deg).
fn softer(change: &str, axis: usize, angle: f64) -> f64 {
    let couple = |change: &str| turned(&whole(change), axis, angle).1;
    couple("") / couple(change)
}

/// Rigidity factors for a section decorated by cofilin: bending is 5 and twist 10 times softer.
/// Softer lateral bonds reduce twist more than bending, especially large twist and under-twist: at
/// 0.01 rad/nm the mean of both senses is 10 at 5.
#[test]
fn bending_and_twist_soften_differently() {
    for (axis, angle) in [(1, 20.0), (2, 40.0)] {
        let one = softer(&altered(0.2, 0.2), axis, angle);
        assert!((one - 5.0).abs() < 1e-5, "{one:?}");
    }
    let cofilin = altered(0.03, 0.23);
    let bend = softer(&cofilin, 1, 20.0);
    let at = |per_nm: f64| (per_nm * SPECIMEN).to_degrees();
    let little = softer(&cofilin, 2, at(3e-3));
    let [over, under] = [1.0, -1.0].map(|sense| softer(&cofilin, 2, sense * at(0.01)));
    assert!((4.8..5.6).contains(&bend), "{bend}");
    assert!((5.0..6.0).contains(&little), "{little}");
    assert!(over > 1.3 * little && under > 1.5 * over, "{over} {under}");
    assert!((0.5 * (over + under) - 10.0).abs() < 1.0, "{over} {under}");
}

/// The soft middle deforms as a uniformly soft filament under the same couple, except for boundary
/// layers of a few monomers.
#[test]
fn a_softened_middle_deforms_as_a_uniform_filament() {
    let soft = altered(0.2, 0.2);
    for (axis, angle, name) in [(1, 30.0, "bent"), (2, 60.0, "twisted")] {
        let (both, couple) = turned(&middle(&soft), axis, angle);
        for (change, place, in_specimen) in [
            ("", [20.0, 40.0], [20.0, 40.0]),
            (soft.as_str(), [80.0, 130.0], [35.0, 85.0]),
        ] {
            let here = turn_between(&both, place)[axis];
            // Clamps restrain the twist of a short filament, so its end is turned until the inner
            // deformation is equal.
            let mut angle = (here * SPECIMEN).to_degrees();
            let mut alone = 0.0;
            for _ in 0..4 {
                let (specimen, couple) = turned(&whole(change), axis, angle);
                let within = turn_between(&specimen, in_specimen)[axis];
                (angle, alone) = (angle * here / within, couple);
            }
            assert!(
                (couple / alone - 1.0).abs() < 0.05,
                "{name} {place:?}: {couple} {alone}"
            );
        }
    }
}

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
    assert!(
        refused.contains("the filament has no equilibrium"),
        "{refused}"
    );
}

/// Turn per monomer (deg): bare, with cofilin.
const TURNS: [f64; 2] = [-360.0 * 12.0 / 26.0, -162.0];
const RISE: f64 = 71.2 / 26.0;

/// Rest twist of monomers with cofilin (rad/nm).
fn rest_twist() -> f64 {
    (TURNS[1] - TURNS[0]).to_radians() / RISE
}

const DECORATED: &str = "altered: (turn_deg: -162.0, lateral_rigidity_factor: 0.1)";

/// Boundaries half a rise after a monomer (nm).
const PLACES: [f64; 4] = [21.5 * RISE, 29.5 * RISE, 43.5 * RISE, 51.5 * RISE];

/// Filament with decorated monomers or rods in the middle.
fn decorated(inner: &str, outer: &str, filament: &str) -> Assembly {
    let (twist, [from, _, _, to]) = (rest_twist(), PLACES);
    let inner = inner.replace("RODS", &format!("altered: (rest_twist_per_nm: {twist:?})"));
    build(&format!(
        "Scene(
            filament: Filament(
                sections: [
                    {outer}(from_nm: 0.0, to_nm: {from:?}), {inner},
                    {outer}(from_nm: {to:?}, to_nm: 200.0),
                ],
                {filament}
            ),
            clamps: [Clamp(end: Start)],
            task: Equilibrium(),
        )"
    ))
}

fn monomers(change: &str) -> String {
    let [from, _, _, to] = PLACES;
    format!("Ellipsoids(from_nm: {from:?}, to_nm: {to:?}, {change})")
}

fn rods() -> String {
    monomers("RODS").replace("Ellipsoids", "Rod")
}

fn partly() -> String {
    let [a, b, c, d] = PLACES;
    format!(
        "Rod(from_nm: {a:?}, to_nm: {b:?}, RODS), Ellipsoids(from_nm: {b:?}, to_nm: {c:?}, {DECORATED}),
         Rod(from_nm: {c:?}, to_nm: {d:?}, RODS)"
    )
}

#[test]
fn filaments_of_altered_turn_are_built_at_rest() {
    let kinds = ["Independent", "Identical", "Cubature"];
    let anchors = kinds.map(|kind| format!("monomers: Monomers(anchors: {kind}),"));
    let places = [
        "",
        "direction: (1.0, -2.0, 2.0), roll_deg: 30.0,",
        "shape: AtRest,",
    ];
    let laws = ["Constant", "Fitted", "Homogenised"];
    for k in 0..3 {
        let filament = format!(
            "{} {} rod: RodModel(law: {}),",
            anchors[k], places[k], laws[k]
        );
        let inners = [monomers(DECORATED), rods(), partly()];
        for (inner, outer) in inners
            .iter()
            .flat_map(|i| ["Ellipsoids", "Rod"].map(|o| (i, o)))
        {
            let mut assembly = decorated(inner, outer, &filament);
            let loads = assembly.system.loads().clone();
            let residual = loads.residual(&assembly.rest);
            // Places of 200 nm, rounded to 3e-14 nm, times rigidities of 5e4 pN; torques over 10 nm.
            assert!(
                residual.force < 1e-8 && residual.torque < 1e-7,
                "{filament} {inner} {outer}: {residual:?}"
            );
        }
    }
}

/// The section adds the change of the turn for each of its monomers, half of it at both ends. The bare helix is the same
/// at the start.
#[test]
fn the_altered_turn_adds_up() {
    let [bare, own] = ["", DECORATED].map(|change| decorated(&monomers(change), "Rod", ""));
    let change = (TURNS[1] - TURNS[0]).to_radians();
    let section = &own.sections[1];
    let count = section.points.len() as f64;
    for (i, frame) in own.frames.iter().enumerate() {
        let q = |assembly: &Assembly| assembly.rest.frames.orientation.get(i);
        let found = q(&bare).inverse() * q(&own);
        let within = (frame.s_nm - section.from_nm) / RISE;
        let expected = rotation::exp(Vector3::z() * (change * within.clamp(0.0, count)));
        // Azimuths of 200 rad, rounded.
        assert!(found.angle_to(&expected) < 1e-12, "{}: {found}", frame.s_nm);
    }
    for (i, frame) in own
        .frames
        .iter()
        .enumerate()
        .take(section.frames.end)
        .skip(section.frames.start + 1)
    {
        let q = |i: usize| own.rest.frames.orientation.get(i);
        let step = q(i - 1).inverse() * q(i);
        let expected = rotation::exp(Vector3::z() * TURNS[1].to_radians());
        assert!(step.angle_to(&expected) < 1e-12, "{}", frame.s_nm);
    }
}

/// Monomers have the same places and orientations in a mixed filament and in a filament of monomers.
#[test]
fn the_turn_does_not_depend_on_the_resolution() {
    let whole = decorated(&monomers(DECORATED), "Ellipsoids", "");
    for (outer, shape) in [("Ellipsoids", ""), ("Rod", ""), ("Rod", "shape: AtRest,")] {
        let mixed = decorated(&partly(), outer, shape);
        let mut count = 0;
        for (i, frame) in mixed.frames.iter().enumerate() {
            let same = |other: &FrameInfo| {
                (other.s_nm - frame.s_nm).abs() < 1e-9 && other.kind == frame.kind
            };
            let Some(k) = whole.frames.iter().position(same) else {
                continue;
            };
            let q = |a: &Assembly, i: usize| a.rest.frames.orientation.get(i);
            assert!(
                q(&mixed, i).angle_to(&q(&whole, k)) < 1e-12,
                "{}",
                frame.s_nm
            );
            count += 1;
        }
        assert!(count >= 14, "{count}");
    }
}

#[test]
fn bonds_and_junctions_of_altered_turn_are_gradients() {
    for outer in ["Ellipsoids", "Rod"] {
        let assembly = decorated(&partly(), outer, "rod: RodModel(law: Fitted),");
        assert_interactions_are_gradients(&assembly);
    }
}

/// Bonds across the boundaries of a section have their own quadrature.
#[test]
fn bonds_across_boundaries_are_listed() {
    let assembly = decorated(&monomers(DECORATED), "Ellipsoids", "");
    let mut state = assembly.rest.clone();
    perturb(&mut state, &mut Xorshift::new(8), 0.02, 0.05);
    for (i, interaction) in assembly.system.interactions().iter().enumerate() {
        let bonds = assembly.bonds_of(i).unwrap();
        let (own, acting) = (bonds.energy(&state), interaction.energy(&state));
        // Sums of a few thousand terms.
        assert!((own / acting - 1.0).abs() < 1e-12, "{own} {acting}");
        assert!(bonds.energy(&assembly.rest) < 1e-20 * own, "{i}");
    }
}

#[test]
fn masses_are_multiplied() {
    let assembly = build(&text(&middle("altered: (mass_factor: 1.5)"), ""));
    let mass = |i: usize| assembly.system.state().points.mass(i);
    let ratio = mass(assembly.sections[1].points.start) / mass(assembly.sections[0].points.start);
    assert!((ratio - 1.5).abs() < 1e-14, "{ratio}");
}
