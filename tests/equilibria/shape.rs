//! Twist, writhe and link of simulated filaments.

use super::common::{build, ran};
use actin_sim::At;
use actin_sim::shape::{Ribbon, link};

/// 300 nm with ends turned against each other by twice `turn` (deg) and moved in by 7.5 nm each.
/// The straight state is a saddle.
fn buckled(sections: &str, turn: f64) -> String {
    format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                monomers: Monomers(anchors: Independent, lateral_bonds: 32, longitudinal_bonds: 32),
                rod: RodModel(law: Constant),
            ),
            clamps: [Clamp(end: Start), Clamp(end: End)],
            path: [
                Stage(set: [
                    Turn(end: Start, turn_deg: (0.0, 0.0, {:?})),
                    Turn(end: End, turn_deg: (0.0, 0.0, {turn:?})),
                ]),
                Stage(set: [
                    Shift(end: Start, shift_nm: (0.0, 0.0, 7.5)),
                    Shift(end: End, shift_nm: (0.0, 0.0, -7.5)),
                ]),
            ],
            task: Equilibrium(accept_jumps: true),
        )",
        -turn
    )
}

fn measured(what: &str, text: &str) -> [f64; 3] {
    let (assembly, trajectory, _) = ran(text);
    let mut worst: f64 = 0.0;
    for record in &trajectory.records {
        let ribbon = Ribbon::new(&assembly, &record.state);
        let link = link(&assembly, record.at).unwrap();
        worst = worst.max((ribbon.twist() + ribbon.writhe().unwrap() - link).abs());
    }
    let ribbon = Ribbon::new(&assembly, assembly.system.state());
    let (twist, writhe) = (ribbon.twist(), ribbon.writhe().unwrap());
    let height = ribbon.largest_distance_nm();
    // White's formula is exact for polygons, to the round-off of some thousand solid angles.
    assert!(worst < 1e-9, "{what}: {worst:e}");
    [twist, writhe, height]
}

fn rod(segments: usize) -> String {
    format!("Rod(from_nm: 0.0, to_nm: 300.0, segments: {segments})")
}

#[test]
fn twist_and_writhe_of_a_buckled_rod_make_its_link() {
    for turn in [270.0, -270.0] {
        let of = |n: usize| measured(&format!("rod of {n} segments"), &buckled(&rod(n), turn));
        let [coarse, middle, fine] = [15, 30, 60].map(of);
        assert!(fine[1] * turn > 0.0 && fine[1].abs() > 0.02);
        for k in 0..3 {
            let order = ((coarse[k] - middle[k]) / (middle[k] - fine[k])).log2();
            assert!((order - 2.0).abs() < 0.3, "order {order}");
        }
    }
}

#[test]
fn twist_and_writhe_of_monomers_make_their_link() {
    let mixed = "Rod(from_nm: 0.0, to_nm: 70.0), Ellipsoids(from_nm: 70.0, to_nm: 230.0),
        Rod(from_nm: 230.0, to_nm: 300.0)";
    let [_, writhe, _] = measured("mixed", &buckled(mixed, 180.0));
    assert!(writhe > 0.01);
    let [_, writhe, _] = measured("mixed", &buckled(mixed, -180.0));
    assert!(writhe < -0.01);
}

#[test]
fn the_link_follows_the_path_in_time() {
    let (assembly, trajectory, _) = ran(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0, segments: 4)], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start), Clamp(end: End)],
            path: [Stage(
                set: [Turn(end: End, turn_deg: (0.0, 0.0, 90.0))],
                duration_ns: 2.0,
            )],
            task: Dynamics(duration_ns: 3.0, record_every_ns: 0.5),
        )",
    );
    for record in &trajectory.records {
        let ribbon = Ribbon::new(&assembly, &record.state);
        let expected = link(&assembly, record.at).unwrap();
        let sum = ribbon.twist() + ribbon.writhe().unwrap();
        assert!((sum - expected).abs() < 1e-12, "{sum} {expected}");
    }
    let last = trajectory.records.last().unwrap();
    assert!((link(&assembly, last.at).unwrap() - 0.25).abs() < 1e-15);
    assert!((link(&assembly, At::Time(1.0)).unwrap() - 0.125).abs() < 1e-15);
}

#[test]
fn a_free_or_tilted_end_has_no_link() {
    let scene = |clamps: &str, turn: &str| {
        let path = format!("Stage(set: [Turn(end: Start, turn_deg: {turn})])");
        format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)], rod: RodModel(law: Constant)),
                clamps: [{clamps}],
                path: [{path}],
                task: Equilibrium(),
            )"
        )
    };
    let both = "Clamp(end: Start), Clamp(end: End)";
    assert_eq!(
        link(
            &build(&scene("Clamp(end: Start)", "(0.0, 0.0, 90.0)")),
            At::Path(1.0)
        ),
        None
    );
    assert_eq!(
        link(&build(&scene(both, "(10.0, 0.0, 90.0)")), At::Path(1.0)),
        None
    );
    let turned = link(&build(&scene(both, "(0.0, 0.0, 90.0)")), At::Path(1.0)).unwrap();
    assert!((turned + 0.25).abs() < 1e-15);
}
