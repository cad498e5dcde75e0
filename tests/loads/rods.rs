//! Neighbouring rods with different laws, rigidities and rest shapes.

use super::common::{assert_interactions_are_gradients, build, run};
use crate::theory::second_order_limit;
use actin_mechanics::{Vector3, rotation};
use actin_sim::{Assembly, BodyKind, End, Plan};

/// Rigidities of the default rod (pN nm^2, pN).
const BEND: f64 = 3.9e4;
const TWIST: f64 = 1.3e4;
const SHEAR: f64 = 1.6e4;
/// Factors of bending and twist under cofilin, and the stretch (nm).
const SOFTER: [f64; 2] = [0.2, 0.1];
const STRETCH: [f64; 2] = [50.0, 110.0];
const LENGTH: f64 = 160.0;

fn text(sections: &str, law: &str, loads: &str) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: RodModel(law: {law})),
            clamps: [Clamp(end: Start)],
            loads: [{loads}],
            task: Equilibrium(),
        )"
    )
}

const ONE: &str = "Rod(from_nm: 0.0, to_nm: 160.0, segments: 16)";
const TWO: &str = "Rod(from_nm: 0.0, to_nm: 70.0, segments: 7),
    Rod(from_nm: 70.0, to_nm: 160.0, segments: 9, altered: ())";

/// Cutting a rod into equal sections does not change its bending. Each half segment uses the
/// curvature on its side, with an effect much smaller than mesh refinement.
#[test]
fn cuts_change_nothing() {
    for law in ["Constant", "PublishedExtension", "Fitted", "Homogenised"] {
        let load = "EndForce(end: End, force_pn: (1.0, 0.0, 0.0))";
        let fine = ONE.replace("segments: 16", "segments: 32");
        let [one, two, fine] = [ONE, TWO, &fine].map(|sections| run(&text(sections, law, load)).0);
        let tip = |assembly: &Assembly| assembly.tip_nm(assembly.system.state(), End::End);
        let [miss, refined] = [&two, &fine].map(|other| (tip(&one) - tip(other)).norm());
        let bound = if law == "Constant" {
            1e-8
        } else {
            0.02 * refined
        };
        assert!(miss < bound, "{law}: {miss:e} {refined:e}");
        assert_eq!((one.points.len(), one.counts().junctions), (17, 0));
        assert_eq!((two.points.len(), two.counts().junctions), (17, 0));
        assert_eq!(two.frames.len(), one.frames.len() + 1);
        let mass = |assembly: &Assembly| -> f64 {
            let points = &assembly.system.state().points;
            (0..points.len()).map(|i| points.mass(i)).sum()
        };
        assert!((mass(&one) / mass(&two) - 1.0).abs() < 1e-13);
    }
}

/// The largest frequency rises by at most the root of 4/3.
#[test]
fn a_cut_keeps_the_time_step() {
    let frequency = |sections: &str| {
        let text =
            text(sections, "Constant", "").replace("Equilibrium()", "Dynamics(duration_ns: 1.0)");
        let assembly = build(&text);
        let plan = Plan::new(&assembly).unwrap();
        plan.estimate().unwrap().largest_frequency_rad_per_ns
    };
    let ratio = frequency(TWO) / frequency(ONE);
    assert!((0.999..1.16).contains(&ratio), "{ratio}");
}

fn cofilin(refined: usize) -> Assembly {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/cofilin.ron");
    let mut text = std::fs::read_to_string(path).unwrap();
    for segments in [6, 5] {
        let refined = format!("segments: {}", segments * refined);
        text = text.replace(&format!("segments: {segments}"), &refined);
    }
    run(&text).0
}

/// Stepped beam: deflection `F (int (L - s)^2/B ds + L/S)` with order two, twist `M int ds/C`
/// exactly.
#[test]
fn a_softened_stretch_is_a_stepped_beam() {
    let [from, to] = STRETCH;
    let cube = |a: f64, b: f64| ((LENGTH - a).powi(3) - (LENGTH - b).powi(3)) / 3.0;
    let bent = (cube(0.0, from) + cube(from, to) / SOFTER[0] + cube(to, LENGTH)) / BEND;
    let exact = 1e-3 * (bent + LENGTH / SHEAR);
    let mut tips = [0.0; 3];
    for (k, tip) in tips.iter_mut().enumerate() {
        let assembly = cofilin(1 << k);
        let state = assembly.system.state();
        *tip = assembly.tip_nm(state, End::End).x;
        let last = assembly.sections[2].frames.end - 1;
        let turn = rotation::log(state.frames.orientation.get(last)).z;
        let s = assembly.frames[last].s_nm;
        let twisted = 0.5 * (s - (to - from) + (to - from) / SOFTER[1]) / TWIST;
        assert!((turn / twisted - 1.0).abs() < 1e-6, "{turn} {twisted}");
    }
    let limit = second_order_limit("softened stretch", tips, exact, 0.02);
    // Slopes of 0.01: the nonlinearity is their square.
    assert!(limit.abs() < 1e-4, "{limit:e}");
}

const MANY: &str = "
    Rod(from_nm: 0.0, to_nm: 30.0, altered: (law: Constant, rest_curvature_per_nm: (0.01, -0.02))),
    Rod(from_nm: 30.0, to_nm: 60.0, altered: (bend_rigidity_factor: 0.2, twist_rigidity_factor: 0.1,
        stretch_rigidity_factor: 0.5, shear_rigidity_factor: 2.0)),
    Rod(from_nm: 60.0, to_nm: 90.0, altered: (law: Homogenised,
        rest_curvature_per_nm: (0.004, 0.002), rest_twist_per_nm: 0.01)),
    Ellipsoids(from_nm: 90.0, to_nm: 105.0),
    Rod(from_nm: 105.0, to_nm: 135.0, altered: (law: PublishedExtension, rest_twist_per_nm: -0.02)),
    Rod(from_nm: 135.0, to_nm: 165.0, altered: (rest_curvature_per_nm: (0.0, 0.01), rest_twist_per_nm: 0.02))";

#[test]
fn every_section_is_the_gradient_of_its_energy() {
    let assembly = build(&text(MANY, "Fitted", ""));
    let joints = assembly.frames.iter().filter(|f| f.kind == BodyKind::Joint);
    assert_eq!((joints.count(), assembly.counts().junctions), (3, 2));
    assert_interactions_are_gradients(&assembly);
}

#[test]
fn the_shape_at_rest_is_unloaded() {
    let sections = MANY.replace("law: PublishedExtension, ", "");
    let text = text(&sections, "Fitted", "").replace("rod:", "shape: AtRest, rod:");
    let mut assembly = build(&text);
    let loads = assembly.system.loads().clone();
    let residual = loads.residual(&assembly.rest);
    // Round-off: strains of 1e-15 times rigidities of 1e4, and couples over 10 nm.
    assert!(
        residual.force < 1e-8 && residual.torque < 1e-7,
        "{residual:?}"
    );
    assert_eq!(assembly.beyond_range(&assembly.rest), []);
    let tip = assembly.tip_nm(&assembly.rest, End::End);
    assert!(tip.xy().norm() > 10.0, "{tip}");
}

#[test]
fn sections_leave_the_data_of_their_own_laws() {
    let sections = "Rod(from_nm: 0.0, to_nm: 40.0),
        Rod(from_nm: 40.0, to_nm: 80.0, altered: (law: Fitted, rest_twist_per_nm: 0.03))";
    let assembly = build(&text(sections, "Constant", ""));
    let twisted = |rate: f64| {
        let mut state = assembly.rest.clone();
        for (f, frame) in assembly.frames.iter().enumerate() {
            let turn = rotation::exp(Vector3::z() * (rate * frame.s_nm));
            state.frames.orientation.set(f, turn);
        }
        let found = assembly.beyond_range(&state).into_iter();
        found.map(|b| (b.section, b.quantity)).collect::<Vec<_>>()
    };
    // The data end at 0.047 rad/nm.
    assert_eq!(twisted(0.06), []);
    assert_eq!(twisted(0.0), []);
    assert_eq!(twisted(-0.03), [(1, "twist".to_owned())]);
}
