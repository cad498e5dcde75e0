//! Section boundaries and positions of monomers for random filaments (`docs/conventions.md`).

use crate::common::build;
use actin_mechanics::Xorshift;
use actin_mechanics::{State, Vector3};
use actin_sim::{Assembly, End, Part, Resolution};
use std::collections::BTreeMap;
use std::ops::Range;

const RISE: f64 = 71.2 / 26.0;

fn filament(ends: &[f64], monomers_first: bool, clamps: &str) -> Assembly {
    let mut from = 0.0;
    let mut section = |(i, &to): (usize, &f64)| {
        let is_monomers = i.is_multiple_of(2) == monomers_first;
        let kind = if is_monomers { "Ellipsoids" } else { "Rod" };
        let text = format!("{kind}(from_nm: {from:?}, to_nm: {to:?}), ");
        from = to;
        text
    };
    let sections: String = ends.iter().enumerate().map(&mut section).collect();
    build(&format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                monomers: Monomers(anchors: Independent, seed: 5, lateral_bonds: 3, longitudinal_bonds: 3),
                rod: RodModel(law: Constant),
            ),
            clamps: [{clamps}],
            task: Dynamics(duration_ns: 1.0),
        )"
    ))
}

const CLAMPS: [&str; 4] = [
    "",
    "Clamp(end: Start)",
    "Clamp(end: End)",
    "Clamp(end: Start), Clamp(end: End)",
];

fn ends(noise: &mut Xorshift, count: usize) -> Vec<f64> {
    (0..count)
        .scan(0.0, |s, _| {
            *s += 30.0 + 15.0 * noise.sample();
            Some(*s)
        })
        .collect()
}

#[test]
fn sections_meet_half_a_rise_beyond_a_monomer() {
    let mut noise = Xorshift::new(11);
    for case in 0..96 {
        let asked = ends(&mut noise, 1 + case % 4);
        let clamps = CLAMPS[case / 4 % 4];
        let assembly = filament(&asked, case / 16 % 2 == 0, clamps);
        let what = format!("{asked:?} with {clamps:?}");
        let sections = &assembly.sections;
        assert!(sections[0].from_nm == 0.0, "{what}");
        for (i, section) in sections.iter().enumerate() {
            let (at, to) = (section.to_nm, asked[i]);
            let is_last = i + 1 == sections.len();
            if is_last && !section.is_ellipsoids() {
                assert_eq!(at.to_bits(), to.to_bits(), "{what}");
            }
            assert!(
                (at - to).abs() <= 0.5 * RISE + 1e-9,
                "{what}: {at} for {to}"
            );
            if !is_last {
                assert_eq!(at.to_bits(), sections[i + 1].from_nm.to_bits(), "{what}");
            }
            check_bodies(&assembly, i, &what);
        }
        let length = sections[sections.len() - 1].to_nm;
        assert_eq!(assembly.length_nm().to_bits(), length.to_bits());
        let tip = assembly.tip_nm(&assembly.rest, End::End);
        assert!((tip.z - length).abs() < 1e-12 * length, "{what}: {tip}");
    }
}

fn check_bodies(assembly: &Assembly, i: usize, what: &str) {
    let section = &assembly.sections[i];
    let s: Vec<f64> = assembly.points[section.points.clone()]
        .iter()
        .map(|point| point.s_nm)
        .collect();
    let z = |k: usize| {
        assembly
            .rest
            .points
            .position
            .get(section.points.start + k)
            .z
    };
    for (k, s) in s.iter().enumerate() {
        // Round-off of a position of up to 180 nm.
        assert!((z(k) - s).abs() < 1e-12, "{what}: {} at {s}", z(k));
    }
    let step = match section.resolution {
        Resolution::Ellipsoids { .. } => RISE,
        Resolution::Rod { segment_nm } => segment_nm,
    };
    for pair in s.windows(2) {
        assert!((pair[1] - pair[0] - step).abs() < 1e-12, "{what}");
    }
    let [before, after] = [End::Start, End::End].map(|end| overhang(assembly, i, end));
    assert!((section.from_nm - s[0] - before).abs() < 1e-12, "{what}");
    assert!(
        (s[s.len() - 1] - section.to_nm - after).abs() < 1e-12,
        "{what}"
    );
}

fn overhang(assembly: &Assembly, i: usize, end: End) -> f64 {
    let outermost = match end {
        End::Start => 0,
        End::End => assembly.sections.len() - 1,
    };
    let clamped = assembly.clamps.iter().any(|clamp| clamp.end == end);
    if !assembly.sections[i].is_ellipsoids() {
        0.0
    } else if i != outermost {
        -0.5 * RISE
    } else if clamped {
        RISE
    } else {
        0.5 * RISE
    }
}

fn lattice(assembly: &Assembly, i: usize) -> Option<Range<i64>> {
    let section = &assembly.sections[i];
    match section.resolution {
        Resolution::Ellipsoids { first_index, .. } => {
            let count = i64::try_from(section.points.len()).unwrap();
            Some(first_index..first_index + count)
        }
        Resolution::Rod { .. } => None,
    }
}

fn monomers(assembly: &Assembly) -> BTreeMap<i64, [f64; 7]> {
    let rest = &assembly.rest;
    let mut all = BTreeMap::new();
    for (i, section) in assembly.sections.iter().enumerate() {
        let indices = lattice(assembly, i).into_iter().flatten();
        for (index, point) in indices.zip(section.points.clone()) {
            let x = rest.points.position.get(point);
            let q = rest
                .frames
                .orientation
                .get(assembly.points[point].frame.unwrap());
            let [i, j, k, w] = q.coords.into();
            all.insert(index, [x.x, x.y, x.z, w, i, j, k]);
        }
    }
    all
}

/// Energy of the bonds of section `i` after displacing the monomers `moved`, each by a motion keyed
/// by its lattice index.
fn bond_energy(assembly: &Assembly, i: usize, moved: &Range<i64>) -> f64 {
    let mut state: State = assembly.rest.clone();
    let section = &assembly.sections[i];
    let indices = lattice(assembly, i).unwrap();
    for (index, point) in indices.zip(section.points.clone()) {
        if moved.contains(&index) {
            let mut noise = Xorshift::new(index.unsigned_abs());
            state.points.position.add(point, noise.vector() * 0.3);
            let frame = assembly.points[point].frame.unwrap();
            let turn = actin_mechanics::rotation::exp(noise.vector() * 0.2);
            let q = state.frames.orientation.get(frame) * turn;
            state.frames.orientation.set(frame, q);
        }
    }
    let terms = assembly.terms.iter().zip(assembly.system.interactions());
    terms
        .filter(|(term, _)| term.part == Part::Section(i))
        .map(|(_, interaction)| interaction.energy(&state))
        .sum()
}

#[test]
fn resolving_more_does_not_move_a_monomer() {
    let mut noise = Xorshift::new(23);
    for case in 0..12 {
        let clamps = CLAMPS[case % 4];
        let [a, b, c]: [f64; 3] = ends(&mut noise, 3).try_into().unwrap();
        let d = c + 20.0;
        let least = filament(&[a, b, d], false, clamps);
        let longer = filament(&[a, c, d], false, clamps);
        let earlier = filament(&[b, d], true, clamps);
        let more = filament(&[0.4 * a, 0.8 * a, a, b, d], false, clamps);
        let standing = monomers(&least);
        let inner = *standing.keys().next().unwrap() + 3..*standing.keys().last().unwrap() - 2;
        let energy = bond_energy(&least, 1, &inner);
        assert!(energy > 1.0, "the bonds are strained: {energy}");
        for (other, section) in [(longer, 1), (earlier, 0), (more, 3)] {
            let others = monomers(&other);
            for (index, places) in &standing {
                assert_eq!(
                    others.get(index),
                    Some(places),
                    "monomer {index}, {clamps:?}"
                );
            }
            let same = bond_energy(&other, section, &inner);
            assert!((same / energy - 1.0).abs() < 1e-12, "{same} for {energy}");
        }
    }
}

#[test]
fn arc_length_begins_at_the_inner_held_monomer() {
    let assembly = filament(&[40.0, 80.0], true, "Clamp(end: Start)");
    assert_eq!(lattice(&assembly, 0).unwrap().start, -1);
    let clamp = &assembly.clamps[0];
    assert_eq!((&clamp.points, &clamp.frames), (&vec![0, 1], &vec![0, 1]));
    assert_eq!(clamp.about_nm, Vector3::zeros());
    assert!(assembly.points[1].s_nm == 0.0);
    let free = filament(&[40.0, 80.0], true, "");
    assert!((free.points[0].s_nm + 0.5 * RISE).abs() < 1e-15);
}
