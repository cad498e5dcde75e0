//! Hooke's law of a linker between a rod and a movable anchor.

use actin_coupling::{
    Anchor, Linker, LinkerEnd, LinkerError, RodPlace, Site, State, StraightRod, Vector3,
};

fn main() -> Result<(), LinkerError> {
    let mut state = State::default();
    let rod = StraightRod::uniform(2, 10.0).push(&mut state)?;

    // On the axis, at a quarter of the second segment.
    let place = RodPlace {
        segment: 1,
        fraction: 0.25,
        ..RodPlace::default()
    };
    let site = Site::on_rod(&rod, place)?;
    let anchor = Anchor::movable(&mut state, Vector3::new(1.0, 0.0, 12.5));
    let (stiffness, rest_length) = (2.0, 1.0);
    let linker = Linker::new(site, LinkerEnd::Anchor(anchor), stiffness, rest_length)?;

    println!("force at rest: {} pN", linker.force(&state).norm());
    let [x, ..] = anchor.controls.expect("the anchor is movable");
    state.controls[x] = 2.0;
    let force = linker.force(&state);
    println!("force at 2 nm along x: {} pN; k d = 4 pN", force.x);
    assert_eq!(force, Vector3::x() * 4.0);
    Ok(())
}
