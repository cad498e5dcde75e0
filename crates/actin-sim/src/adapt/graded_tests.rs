//! Contributions of stretches against the change of all, and lengths that are graded by them.
//!
//! The theorem: a scheme of second order whose elements touch at nodes has an error that is a sum over segments, to first
//! order in it. What halving each stretch alone changes adds up to what halving all changes, and is large where couple and
//! weight bend within a segment: at clamps under tension, at linkers. The bug to fear, a length that is not continued across a
//! joint of sections, makes stretches beside each other disagree with one rod.

use super::halving::{Share, of_all, of_stretches};
use super::{ErrorEstimate, RodStretch, equilibrium, estimate, finer, grade, value};
use crate::scene::{Quantity, RodLaw, Scene, Section};

/// Pushed aside at its free end.
const CANTILEVER: &str = "clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Equilibrium()";
/// Held at both ends, one of which is moved aside and away: the couple decays from the clamps.
const SHEARED: &str = "clamps: [Clamp(end: Start), Clamp(end: End)],
    path: [Stage(set: [Shift(end: End, shift_nm: (10.0, 0.0, 4.0))])],
    task: Equilibrium()";
/// Held at both ends and pulled aside between them.
const LINKED: &str = "clamps: [Clamp(end: Start), Clamp(end: End)],
    linkers: [Linker(at_nm: 73.0, displaced_nm: (10.0, 0.0, 0.0), stiffness_pn_per_nm: 1.0)],
    task: Equilibrium()";
/// The same turned and stretched, so that all strains count.
const TWISTED: &str = "clamps: [Clamp(end: Start), Clamp(end: End)],
    linkers: [Linker(at_nm: 73.0, radius_nm: 2.0, displaced_nm: (10.0, 2.0, 0.0), stiffness_pn_per_nm: 1.0)],
    path: [Stage(set: [Turn(end: End, turn_deg: (5.0, 0.0, 40.0)), Shift(end: End, shift_nm: (0.0, 4.0, -0.5))])],
    task: Equilibrium()";

/// Held at both ends, one of which is bent and twisted.
const TURNED: &str = "clamps: [Clamp(end: Start), Clamp(end: End)],
    path: [Stage(set: [Turn(end: End, turn_deg: (20.0, 0.0, 45.0))])],
    task: Equilibrium()";

/// Of the sum of their sizes, what contributions may miss the whole by: they are linear in errors of some per cent.
const ADDED: f64 = 0.1;

/// A rod of 160 nm, in sections that end at these places (nm), of so many segments each.
fn scene(rest: &str, sections: &[(f64, usize)]) -> Scene {
    let text = "Scene(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 160.0)], rod: RodModel(law: Constant)), ";
    let mut scene =
        Scene::from_ron(&format!("{text}{rest})")).unwrap_or_else(|error| panic!("{error}"));
    let mut from_nm = 0.0;
    let section = |&(to_nm, segments): &(f64, usize)| {
        let section = Section::rod(from_nm, to_nm, Some(segments));
        from_nm = to_nm;
        section
    };
    let sections: Vec<Section> = sections.iter().map(section).collect();
    scene.filament.sections = sections.into();
    scene
}

/// The number in the equilibrium of a scene, and what its segments do to it.
fn of_segments(scene: &Scene, quantity: Quantity) -> ErrorEstimate {
    let (assembly, state) = equilibrium(scene).unwrap();
    let value = value(&assembly, &state, quantity);
    let segments = of_all((&assembly, &state), quantity, value).unwrap();
    ErrorEstimate::of_segments(quantity, value, segments)
}

fn size(shares: &[Share]) -> f64 {
    shares.iter().map(|share| share.error.abs()).sum()
}

/// Share of the sizes that comes from within a distance (nm) of a place.
fn share_near(shares: &[Share], place: f64, distance: f64) -> f64 {
    let near = |share: &&Share| {
        let stretch = &share.stretch;
        stretch.from_nm < place + distance && stretch.to_nm > place - distance
    };
    let inside = shares.iter().filter(near).map(|share| share.error.abs());
    inside.sum::<f64>() / size(shares)
}

#[test]
fn contributions_add_up_and_lie_where_they_arise() {
    let linker = Quantity::LinkerForce { linker: 0 };
    for (rest, quantity, places) in [
        (CANTILEVER, Quantity::Tip, &[][..]),
        (CANTILEVER, Quantity::Energy, &[]),
        (SHEARED, Quantity::EndForce, &[0.0, 160.0]),
        (SHEARED, Quantity::Energy, &[0.0, 160.0]),
        (LINKED, linker, &[73.0]),
        (LINKED, Quantity::Curvature { at_nm: 110.0 }, &[]),
    ] {
        let scene = scene(rest, &[(160.0, 16)]);
        let found = of_segments(&scene, quantity);
        let shares = of_stretches(&scene, &found, ADDED);
        let shares = shares.unwrap_or_else(|| panic!("{quantity:?}: do not add up to {found:?}"));
        assert_eq!(shares.len(), 16);
        // Stretches within one segment of so many places would have this share of even contributions.
        let even = 2.0 * places.len() as f64 / 16.0;
        let near: f64 = places.iter().map(|&at| share_near(&shares, at, 10.0)).sum();
        assert!(
            places.is_empty() || near > even,
            "{quantity:?}: {near} of {shares:?}"
        );
    }
}

/// The tip of a cantilever owes as much to every stretch: the error of the trapezoidal rule for `(L - s)^2`.
#[test]
fn a_cantilever_is_not_graded() {
    let scene = scene(CANTILEVER, &[(160.0, 16)]);
    let found = of_segments(&scene, Quantity::Tip);
    let shares = of_stretches(&scene, &found, ADDED).unwrap();
    assert_eq!(grade::graded(&shares, [2.5, 20.0]), None, "{shares:?}");
}

/// Sections of one length are one rod. Bent in a plane a joint turns half of what a node does, and all is the same to
/// Newton's residual. Where strains are coupled, by a turned element or by the law, its two halves have strains of their own:
/// an error of the scheme in the elements about it, so that a joint is worth less than a segment. Laws and walls are judged as those of
/// one rod.
#[test]
fn adjoining_rods_of_one_length_are_one_rod() {
    let linker = Quantity::LinkerForce { linker: 0 };
    for law in [RodLaw::Constant, RodLaw::Fitted, RodLaw::Homogenised] {
        for (rest, quantity) in [
            (CANTILEVER, Quantity::Tip),
            (LINKED, linker),
            (TWISTED, linker),
            (TWISTED, Quantity::EndCouple),
        ] {
            let of = |sections: &[(f64, usize)]| {
                let mut scene = scene(rest, sections);
                scene.filament.rod.law = law.clone();
                let (assembly, state) = equilibrium(&scene).unwrap();
                estimate(&assembly, &state, quantity).unwrap()
            };
            let one = of(&[(160.0, 16)]);
            let two = of(&[(30.0, 3), (100.0, 7), (160.0, 6)]);
            let is_simple = law == RodLaw::Constant && rest == CANTILEVER;
            let joints = if is_simple { 0.0 } else { 2.0 };
            let of_joints = joints / 16.0 * one.segments.abs();
            let size = one.value.abs();
            let is_near = |a: f64, b: f64, more: f64| (a - b).abs() < of_joints + more * size;
            assert!(
                is_near(one.value, two.value, 1e-6),
                "{law:?}: {one:?} {two:?}"
            );
            for (a, b) in [
                (one.law, two.law),
                (one.walls, two.walls),
                (one.segments, two.segments),
                (one.junctions, two.junctions),
            ] {
                // Cells are relaxed to about as much.
                assert!(is_near(a, b, 1e-4), "{law:?}: {one:?} {two:?}");
            }
        }
    }
}

/// What a wall does to the shear beside it is the same in a section of 5 nm, less than it reaches. A section that kept it to
/// itself changed this couple by some thousandths.
#[test]
fn a_wall_reaches_beyond_a_section() {
    let of = |sections: &[(f64, usize)]| {
        let mut scene = scene(TURNED, sections);
        scene.filament.rod.law = RodLaw::Homogenised;
        of_segments(&scene, Quantity::EndCouple)
    };
    let (one, two) = (of(&[(160.0, 32)]), of(&[(155.0, 31), (160.0, 1)]));
    // A joint is worth less than a segment.
    let allowed = one.segments.abs() / 32.0;
    assert!((one.value - two.value).abs() < allowed, "{one:?} {two:?}");
}

/// Where lengths jump the scheme stays of second order: halving all leaves a quarter.
#[test]
fn graded_rods_are_of_second_order() {
    for law in [RodLaw::Constant, RodLaw::Homogenised] {
        for (rest, quantity) in [(CANTILEVER, Quantity::Tip), (SHEARED, Quantity::Energy)] {
            let of = |n: usize| {
                let mut scene = scene(rest, &[(40.0, 4 * n), (120.0, 2 * n), (160.0, 4 * n)]);
                scene.filament.rod.law = law.clone();
                let (assembly, state) = equilibrium(&scene).unwrap();
                value(&assembly, &state, quantity)
            };
            let [a, b, c] = [2, 4, 8].map(of);
            let left = (c - b) / (b - a);
            // The next order is the square of the length over that in which couples decay.
            assert!((left - 0.25).abs() < 0.03, "{law:?}, {quantity:?}: {left}");
        }
    }
}

/// The couple of a turned end owes nearly all to the segments about that end: graded twice from 20 nm, a rod has at most half of the
/// segments that it takes of one length to leave as much, by the estimate and by the difference to a rod of
/// 1.25 nm segments.
#[test]
fn a_turned_end_is_graded() {
    let even = |segments: usize| {
        let mut scene = scene(TURNED, &[(160.0, segments)]);
        scene.filament.rod.law = RodLaw::Homogenised;
        scene
    };
    let of = |scene: &Scene| of_segments(scene, Quantity::EndCouple);
    let (evenly, finest) = (of(&even(32)), of(&even(128)));
    let truth = finest.value + finest.segments;
    let once = finer(&even(8), Quantity::EndCouple).unwrap();
    for scene in [finer(&once, Quantity::EndCouple).unwrap(), once] {
        let found = of(&scene);
        let sections = scene.filament.sections.iter();
        let rods: Vec<RodStretch> = sections.filter_map(RodStretch::of).collect();
        let count: usize = rods.iter().map(|rod| rod.segments).sum();
        // Of one length it takes so many: errors go as the square of their number.
        let as_good = |left: f64, of_even: f64| 32.0 * (of_even / left).abs().sqrt();
        let estimated = as_good(found.segments, evenly.segments);
        let true_ones = as_good(truth - found.value, truth - evenly.value);
        let most = 0.5 * estimated.min(true_ones);
        assert!(
            count as f64 <= most,
            "{rods:?}, {estimated}, {true_ones}: {found:?}"
        );
        for pair in rods.windows(2) {
            let factor = pair[0].segment_nm() / pair[1].segment_nm();
            // Four, and the round-off of a length.
            assert!((0.249..4.001).contains(&factor), "{rods:?}");
        }
    }
}

/// A choice whose segments are graded is a scene that can be read again, and says so.
#[test]
fn graded_lengths_are_chosen_and_told() {
    let text = format!(
        "Scene(filament: Filament(sections: Adaptive(length_nm: 160.0, want: EndCouple(error: 0.03), monomers: 13)), {TURNED})"
    );
    let scene = Scene::from_ron(&text).unwrap();
    let assembly = crate::Assembly::build(&scene).unwrap();
    let chosen = assembly.chosen.as_ref().unwrap();
    assert!(
        chosen.tried.iter().any(|one| !one.graded.is_empty()),
        "{chosen:?}"
    );
    let written = assembly.scene.to_ron();
    assert_eq!(Scene::from_ron(&written).unwrap(), assembly.scene);
    let sections = &assembly.scene.filament.sections;
    if !chosen.graded.is_empty() {
        let rods: Vec<RodStretch> = sections.iter().filter_map(RodStretch::of).collect();
        assert_eq!(rods, chosen.graded);
        let note = &assembly.notes()[0].message;
        assert!(note.contains(" nm from "), "{note}");
    }
}
