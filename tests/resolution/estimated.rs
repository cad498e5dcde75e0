//! Estimates beside the truth.

use super::{CANTILEVER, LONG_CANTILEVER, PULLED_ASIDE, TWIST, scene, solved};
use actin_sim::adapt::{estimate, scatter, value};
use actin_sim::{Quantity, RodLaw, Section};

/// A filament, and what is wanted of it.
struct Case {
    length: f64,
    rest: &'static str,
    quantity: Quantity,
}

/// Estimated over true error, and the true one over the value.
fn effectivity(case: &Case, law: &RodLaw, stretches: &[[f64; 2]]) -> (f64, f64) {
    let whole = format!("[Ellipsoids(from_nm: 0.0, to_nm: {:?})]", case.length);
    let mut scene = scene(&whole, case.rest);
    let fine = solved(&scene);
    let of_fine = estimate(&fine, fine.system.state(), case.quantity).unwrap();
    assert!(
        of_fine.error.abs() < f64::MIN_POSITIVE,
        "nothing is wrong with all monomers"
    );
    let mut sections = Vec::new();
    let mut at = 0.0;
    for &[from_nm, to_nm] in stretches {
        if from_nm > at {
            sections.push(Section::rod(at, from_nm, None));
        }
        let altered = None;
        sections.push(Section::Ellipsoids {
            from_nm,
            to_nm,
            altered,
        });
        at = to_nm;
    }
    sections.push(Section::rod(at, case.length, None));
    scene.filament.sections = sections.into();
    scene.filament.rod.law = law.clone();
    let rod = solved(&scene);
    let found = estimate(&rod, rod.system.state(), case.quantity).unwrap();
    let error = of_fine.value - found.value;
    (found.error / error, error / of_fine.value)
}

/// True errors (share of the value) that are judged.
const JUDGED: f64 = 0.01;

/// Bounds as the issue of this work set them, before anything was measured: 0.5 to 2. True errors are up to 10 %.
#[test]
fn estimates_are_within_a_factor_of_two() {
    let (rise, whole) = (71.2 / 26.0, [].as_slice());
    let tip = Case {
        length: 58.5 * rise,
        rest: CANTILEVER,
        quantity: Quantity::Tip,
    };
    let long = Case {
        length: 584.5 * rise,
        rest: LONG_CANTILEVER,
        quantity: Quantity::Tip,
    };
    let twist = Case {
        length: 27.0 * rise,
        rest: TWIST,
        quantity: Quantity::EndCouple,
    };
    let pulled = Case {
        length: 73.0 * rise,
        rest: PULLED_ASIDE,
        quantity: Quantity::EndForce,
    };
    let laws = [RodLaw::Homogenised, RodLaw::Fitted, RodLaw::Constant];
    let [homogenised, fitted, _] = &laws;
    let mut rows = Vec::new();
    for case in [&tip, &long] {
        rows.extend(laws.iter().map(|law| effectivity(case, law, whole)));
    }
    for case in [&twist, &pulled] {
        rows.extend([homogenised, fitted].map(|law| effectivity(case, law, whole)));
    }
    rows.push(effectivity(&tip, homogenised, &[[60.0, 100.0]]));
    rows.push(effectivity(&long, homogenised, &[[0.0, 40.0]]));
    let judged = rows.iter().filter(|row| row.1.abs() > JUDGED);
    assert_eq!(judged.clone().count(), 6, "{rows:?}");
    for (effectivity, _) in judged {
        assert!((0.5..2.0).contains(effectivity), "{rows:?}");
    }
}

/// True and estimated errors (share of the value) that are both too small to be told: set before, with what a wall is known to.
const BOTH_SMALL: f64 = 0.005;

/// Twisted between walls, which turn a rod of `Homogenised` as they do monomers: what walls do to monomers and what they do to
/// rods are each some per cent, and are told from each other to less.
#[test]
fn walls_of_a_twisted_rod_cancel_as_they_do_in_truth() {
    for quantity in [Quantity::EndCouple, Quantity::Energy] {
        let case = Case {
            length: 27.0 * 71.2 / 26.0,
            rest: TWIST,
            quantity,
        };
        let (effectivity, error) = effectivity(&case, &RodLaw::Homogenised, &[]);
        let estimated = effectivity * error;
        let is_small = error.abs().max(estimated.abs()) < BOTH_SMALL;
        let is_told = is_small || (0.5..2.0).contains(&effectivity);
        assert!(is_told, "{quantity:?}: {estimated} {error}");
    }
}

/// Coarse segments are told from walls: with them the estimate still has the right sign and size.
#[test]
fn coarse_segments_are_not_counted_twice() {
    let length = 58.5 * 71.2 / 26.0;
    let mut scene = scene(
        &format!("[Rod(from_nm: 0.0, to_nm: {length:?}, segments: 6)]"),
        CANTILEVER,
    );
    scene.filament.rod.law = RodLaw::Homogenised;
    let rod = solved(&scene);
    let found = estimate(&rod, rod.system.state(), Quantity::Tip).unwrap();
    // 0.2 % of what monomers give, 62.995 nm.
    assert!(
        (found.corrected() - 62.995).abs() < 0.2 + found.segments.abs(),
        "{found:?}"
    );
    assert!(found.walls.abs() < 0.2, "{found:?}");
}

/// Of a filament that may roll about its axis, the walls are taken at four azimuths. Over-twisted and pushed
/// together it is within 2 % as a rod, and its error is told by the same bounds.
#[test]
fn a_buckled_filament_is_judged() {
    let rest = "clamps: [Clamp(end: Start), Clamp(end: End)],
        linkers: [Linker(at_nm: 150.6153846153846, displaced_nm: (100.0, 0.0, 0.0), stiffness_pn_per_nm: 1e-5)],
        path: [
            Stage(set: [
                Turn(end: Start, turn_deg: (0.0, 0.0, -180.0)), Turn(end: End, turn_deg: (0.0, 0.0, 180.0)),
            ]),
            Stage(set: [
                Shift(end: Start, shift_nm: (0.0, 0.0, 7.5)), Shift(end: End, shift_nm: (0.0, 0.0, -7.5)),
            ]),
        ],
        task: Equilibrium(leave_saddles: 20, accept_jumps: true)";
    let length = 110.0 * 71.2 / 26.0;
    for quantity in [Quantity::EndCouple, Quantity::EndForce] {
        let case = Case {
            length,
            rest,
            quantity,
        };
        let (effectivity, error) = effectivity(&case, &RodLaw::Homogenised, &[]);
        let estimated = effectivity * error;
        let is_small = error.abs() < JUDGED && estimated.abs() < JUDGED;
        let is_told = is_small || (0.5..2.0).contains(&effectivity);
        assert!(is_told, "{quantity:?}: {estimated} {error}");
    }
}

/// Held at its start, and pulled aside near its end and halfway by soft linkers.
const PULLED_BY_LINKERS: &str = "clamps: [Clamp(end: Start)],
    linkers: [
        Linker(at_nm: 150.0, displaced_nm: (30.0, 0.0, 0.0), stiffness_pn_per_nm: 0.1),
        Linker(at_nm: 80.0, displaced_nm: (-10.0, 0.0, 0.0), stiffness_pn_per_nm: 0.1),
    ],
    task: Equilibrium()";
/// Held at both ends, and pulled aside in the middle.
const PULLED_IN_THE_MIDDLE: &str = "clamps: [Clamp(end: Start), Clamp(end: End)],
    linkers: [Linker(at_nm: 99.9, displaced_nm: (10.0, 0.0, 0.0), stiffness_pn_per_nm: 1.0)],
    task: Equilibrium()";

/// Curvatures, by the same bounds, away from walls, about which they are refused, and from inflections, where nothing is
/// left to be a share of.
#[test]
fn estimates_of_curvatures_are_within_a_factor_of_two() {
    let rise = 71.2 / 26.0;
    let laws = [RodLaw::Homogenised, RodLaw::Fitted, RodLaw::Constant];
    // Under `Constant` what a linker pulls aside is wrong to the second order.
    let places = [
        (58.5, CANTILEVER, 80.0, 3),
        (58.5, CANTILEVER, 120.0, 3),
        (584.5, LONG_CANTILEVER, 200.0, 3),
        (73.0, PULLED_IN_THE_MIDDLE, 99.9, 2),
    ];
    let mut rows = Vec::new();
    for (rises, rest, at_nm, count) in places {
        let case = Case {
            length: rises * rise,
            rest,
            quantity: Quantity::Curvature { at_nm },
        };
        for law in &laws[..count] {
            let (effectivity, error) = effectivity(&case, law, &[]);
            rows.push((at_nm, law, effectivity, error));
        }
    }
    let judged = rows.iter().filter(|row| row.3.abs() > JUDGED);
    assert_eq!(judged.clone().count(), 5, "{rows:?}");
    for (.., effectivity, _) in judged {
        assert!((0.5..2.0).contains(effectivity), "{rows:?}");
    }
}

/// Energies and forces of linkers, by the bounds of the other numbers, set before anything was measured: under dead loads
/// and under given displacements.
#[test]
fn estimates_of_energies_and_linkers_are_within_a_factor_of_two() {
    let rise = 71.2 / 26.0;
    let case = |rises: f64, rest, quantity| Case {
        length: rises * rise,
        rest,
        quantity,
    };
    let force = |linker: usize| Quantity::LinkerForce { linker };
    let cases = [
        case(58.5, CANTILEVER, Quantity::Energy),
        case(584.5, LONG_CANTILEVER, Quantity::Energy),
        case(27.0, TWIST, Quantity::Energy),
        case(73.0, PULLED_ASIDE, Quantity::Energy),
        case(58.5, PULLED_BY_LINKERS, force(0)),
        case(58.5, PULLED_BY_LINKERS, force(1)),
        case(73.0, PULLED_IN_THE_MIDDLE, force(0)),
    ];
    let mut rows = Vec::new();
    for case in &cases {
        for law in [RodLaw::Homogenised, RodLaw::Fitted] {
            let (effectivity, error) = effectivity(case, &law, &[]);
            rows.push((case.quantity, law, effectivity, error));
        }
    }
    let judged = rows.iter().filter(|row| row.3.abs() > JUDGED);
    assert_eq!(judged.clone().count(), 5, "{rows:?}");
    for (.., effectivity, _) in judged {
        assert!((0.5..2.0).contains(effectivity), "{rows:?}");
    }
}

/// Held at its start, with a linker beside the axis and a couple that act inside.
const TURNED_INSIDE: &str = "clamps: [Clamp(end: Start)],
    loads: [Couple(at_nm: 125.0, couple_pn_nm: (10.0, 0.0, 30.0))],
    linkers: [
        Linker(at_nm: 70.0, radius_nm: 3.0, azimuth_deg: 40.0, displaced_nm: (0.0, 8.0, 1.0), stiffness_pn_per_nm: 1.0),
    ],
    task: Equilibrium()";

/// The monomer that a linker holds gives way and turns by itself: of these errors of 0.4 % and more that is a fifth to all. The
/// bounds are those of the other numbers; the last scene was written before it was solved.
#[test]
fn sites_give_way_as_monomers_do() {
    let rise = 71.2 / 26.0;
    let scenes = [
        (PULLED_BY_LINKERS, 0),
        (PULLED_BY_LINKERS, 1),
        (TURNED_INSIDE, 0),
    ];
    for (rest, linker) in scenes {
        for law in [RodLaw::Homogenised, RodLaw::Fitted] {
            let case = Case {
                length: 58.5 * rise,
                rest,
                quantity: Quantity::LinkerForce { linker },
            };
            let (effectivity, error) = effectivity(&case, &law, &[]);
            assert!(
                (0.5..2.0).contains(&effectivity),
                "{linker} {law:?}: {effectivity} of {error}"
            );
        }
    }
}

/// Held at its start, with a force inside that pulls at the axis: what is behind bears nothing.
const PULLED_INSIDE: &str = "clamps: [Clamp(end: Start)],
    loads: [Force(at_nm: 80.0, force_pn: (3.0, 0.0, 0.0))],
    task: Equilibrium()";

/// The same with a couple about the axis.
const TWISTED_INSIDE: &str = "clamps: [Clamp(end: Start)],
    loads: [Couple(at_nm: 125.0, couple_pn_nm: (0.0, 0.0, 30.0))],
    task: Equilibrium()";

/// What acts inside does its work where monomers give way, and changes the load of a segment at its frame; what bears nothing is
/// no part of an error, however floppy. By the bounds of the other numbers; smaller errors are told to as much as is judged.
#[test]
fn what_acts_inside_is_told() {
    let scenes = [
        (PULLED_INSIDE, Quantity::Energy),
        (PULLED_INSIDE, Quantity::Tip),
        (PULLED_BY_LINKERS, Quantity::Energy),
        (TWISTED_INSIDE, Quantity::Energy),
    ];
    let mut rows = Vec::new();
    for (rest, quantity) in scenes {
        for law in [RodLaw::Homogenised, RodLaw::Fitted] {
            let case = Case {
                length: 58.5 * 71.2 / 26.0,
                rest,
                quantity,
            };
            let (effectivity, error) = effectivity(&case, &law, &[]);
            rows.push((quantity, law, effectivity, error));
        }
    }
    let judged = rows.iter().filter(|row| row.3.abs() > JUDGED);
    assert_eq!(judged.count(), 5, "{rows:?}");
    for (.., effectivity, error) in &rows {
        let is_told = if error.abs() > JUDGED {
            (0.5..2.0).contains(effectivity)
        } else {
            ((effectivity - 1.0) * error).abs() < JUDGED
        };
        assert!(is_told, "{rows:?}");
    }
}

/// The scatter of filaments with drawn bonds beside that of 24 which are solved. Bounds set before: deviations within a
/// factor of 1.6 (that of 24 is known to 15 %, the estimate to 17 %), shifts within a deviation; of patterns that all
/// interfaces share, of which 8 are known to 27 %, a factor of 2.
#[test]
fn scatter_is_that_of_drawn_filaments() {
    let rise = 71.2 / 26.0;
    let cases = [
        (58.5, CANTILEVER, Quantity::Tip),
        (58.5, CANTILEVER, Quantity::Energy),
        (27.0, TWIST, Quantity::EndCouple),
        (73.0, PULLED_ASIDE, Quantity::EndForce),
    ];
    for (rises, rest, quantity) in cases {
        let sections = format!("[Ellipsoids(from_nm: 0.0, to_nm: {:?})]", rises * rise);
        let mean = solved(&scene(&sections, rest));
        let usual = value(&mean, mean.system.state(), quantity);
        let rod = format!(
            "[Rod(from_nm: 0.0, to_nm: {:?})], rod: RodModel(law: Homogenised)",
            rises * rise
        );
        let rod = solved(&scene(&rod, rest));
        let (shift, deviation) = of_solved((&sections, rest), "Independent", quantity, usual);
        for assembly in [&mean, &rod] {
            let found = scatter(assembly, assembly.system.state(), quantity).unwrap();
            assert_eq!(found.bonds, [64, 64]);
            let ratio = found.deviation / deviation;
            assert!((1.0 / 1.6..1.6).contains(&ratio), "{quantity:?}: {ratio}");
            let off = (found.shift - shift).abs();
            assert!(off < deviation, "{quantity:?}: {off} {deviation}");
        }
    }
    let sections = format!("[Ellipsoids(from_nm: 0.0, to_nm: {:?})]", 58.5 * rise);
    let (_, deviation) = of_solved((&sections, CANTILEVER), "Identical", Quantity::Tip, 0.0);
    let shared = format!("{sections}, monomers: Monomers(anchors: Identical)");
    let shared = solved(&scene(&shared, CANTILEVER));
    let found = scatter(&shared, shared.system.state(), Quantity::Tip).unwrap();
    let ratio = found.deviation / deviation;
    assert!((0.5..2.0).contains(&ratio), "{ratio}: {deviation}");
}

/// Mean less the usual value, and deviation, of 24 filaments with drawn bonds.
fn of_solved(
    (sections, rest): (&str, &str),
    anchors: &str,
    quantity: Quantity,
    usual: f64,
) -> (f64, f64) {
    let drawn = (0..24).map(|seed| {
        let monomers = format!("{sections}, monomers: Monomers(seed: {seed}, anchors: {anchors})");
        let drawn = solved(&scene(&monomers, rest));
        value(&drawn, drawn.system.state(), quantity)
    });
    let drawn: Vec<f64> = drawn.collect();
    let n = drawn.len() as f64;
    let mean = drawn.iter().sum::<f64>() / n;
    let spread = drawn.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean - usual, spread.sqrt())
}
