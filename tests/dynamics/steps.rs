//! Time steps of filaments with junctions and of long segments.

use super::filaments::step;
use crate::common::build;
use actin_integrate::PEFRL;
use actin_sim::Plan;

fn limit(sections: &str, rotary_inertia: &str) -> f64 {
    let text = format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                rod: RodModel(law: Constant, rotary_inertia: {rotary_inertia}),
            ),
            clamps: [Clamp(end: Start)],
            task: Dynamics(duration_ns: 1.0),
        )"
    );
    step(&build(&text).system, &PEFRL, 1.0)
}

fn rod(from: f64, segment: f64) -> String {
    let segments = (160.0 - from) / segment;
    format!("Rod(from_nm: {from:?}, to_nm: 160.0, segments: {segments:.0})")
}

fn monomers(to: f64) -> String {
    format!("Ellipsoids(from_nm: 0.0, to_nm: {to:?}),")
}

/// A junction reduces the step of the rod or the monomers by less than a twentieth.
#[test]
fn a_junction_costs_no_step() {
    let all = limit(&monomers(160.0), "CrossSection");
    for segment in [5.0, 10.0, 20.0, 40.0] {
        let alone = limit(&rod(0.0, segment), "CrossSection");
        let mixed = limit(
            &[monomers(80.0), rod(80.0, segment)].concat(),
            "CrossSection",
        );
        println!(
            "segments of {segment} nm: {mixed:.3e} ns, {:.3} of the monomers' and {:.3} of the rod's",
            mixed / all,
            mixed / alone
        );
        assert!(mixed > 0.95 * all.min(alone), "{segment}");
    }
}

/// With the rotary inertia of rigid segments the step is proportional to their length above 10 nm,
/// where the fastest mode is a stretch between nodes.
#[test]
fn steps_grow_with_rigid_segments() {
    let limits = [10.0, 20.0, 40.0, 80.0].map(|h| limit(&rod(0.0, h), "RigidSegment"));
    let before = limit(&rod(0.0, 80.0), "CrossSection");
    println!("{limits:?} ns; of 80 nm otherwise {before:?}");
    for pair in limits.windows(2) {
        assert!((pair[1] / pair[0] - 2.0).abs() < 0.15, "{limits:?}");
    }
    assert!(limits[3] > 10.0 * before);
}

#[test]
fn the_law_of_a_section_shortens_the_step() {
    let share = |altered: &str| {
        let text = format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 80.0), Rod(from_nm: 80.0, to_nm: 160.0, {altered})],
                    rod: RodModel(law: Constant),
                ),
                clamps: [Clamp(end: Start)],
                task: Dynamics(duration_ns: 100.0),
            )"
        );
        let assembly = build(&text);
        let plan = Plan::new(&assembly).unwrap();
        let estimate = plan.estimate().unwrap();
        estimate.time_step_ns / estimate.stability_limit_ns
    };
    let (alike, altered) = (share(""), share("altered: (law: Homogenised)"));
    // Steps are rounded to whole steps between records.
    assert!((altered / alike - 0.5).abs() < 0.01, "{altered} {alike}");
}
