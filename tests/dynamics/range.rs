//! Fluctuations in a heat bath beyond the data of the rod laws.

use crate::common::build;
use actin_cosserat::BendingElement;
use actin_sim::{Assembly, LawExtrapolation};

/// Segment length of the first filament (nm). Twist fluctuates by 0.02 rad/nm and curvature by
/// 0.01; the data end at 0.0472 and 0.015.
const SEGMENT: f64 = 2.0;
const RANGES: [(&str, f64); 2] = [("twist", 0.0472), ("curvature", 0.015)];

/// Two rods under the law `Fitted`; the long segments of the second stay within the data.
const SCENE: &str = "Scene(
    filaments: [
        Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 20)], rod: RodModel(law: Fitted)),
        Filament(sections: [Rod(from_nm: 0.0, to_nm: 90.0, segments: 2)], rod: RodModel(law: Fitted),
            at_nm: (20.0, 0.0, 0.0)),
    ],
    task: Dynamics(
        duration_ns: 3.0,
        drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
        thermal: (temperature_k: 298.0, seed: 7),
    ),
)";

#[test]
fn fluctuations_beyond_the_data_are_summed_up() {
    let assembly = build(SCENE);
    let (trajectory, _) = actin_sim::Plan::new(&assembly).unwrap().run().unwrap();
    let records = &trajectory.records;
    let states = || records.iter().map(|record| &record.state);
    let found = assembly.beyond_range_over(states());
    assert_eq!(found.len(), RANGES.len());
    for (beyond, (quantity, range)) in found.iter().zip(RANGES) {
        assert_eq!((beyond.quantity.as_str(), beyond.filament), (quantity, 0));
        let expected = counted(&assembly, states(), quantity, range);
        let often = beyond.fluctuations.expect("a bath");
        let found = [
            often.share_of_records,
            often.share_of_elements,
            beyond.value.abs(),
        ];
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} and {expected}");
        }
        let [records, elements, _] = expected;
        assert!(elements > 1e-4 && elements < 0.2 && records > elements);
    }
    // Axial forces fluctuate by 250 pN, far beyond the critical 3.2 pN, and are not reported.
    assert_eq!(assembly.unstable_twist_over(states()), []);
    let unstable = states().filter(|state| !assembly.unstable_twist(state).is_empty());
    assert!(unstable.count() > records.len() / 2);
}

fn counted<'a>(
    assembly: &Assembly,
    states: impl Iterator<Item = &'a actin_mechanics::State>,
    quantity: &str,
    range: f64,
) -> [f64; 3] {
    let (mut records, mut records_beyond, mut elements, mut beyond) = (0.0, 0.0, 0.0, 0.0);
    let mut largest: f64 = 0.0;
    for state in states {
        let before = beyond;
        for filament in &assembly.filaments {
            let frames: Vec<usize> = filament.frames.clone().collect();
            for pair in frames.windows(2) {
                let rest_distance = assembly.frames[pair[1]].s_nm - assembly.frames[pair[0]].s_nm;
                let [a, b] = [pair[0], pair[1]].map(|i| state.frames.orientation.get(i));
                let kappa = BendingElement { rest_distance }.curvature(a, b);
                let value = if quantity == "twist" {
                    kappa.z.abs()
                } else {
                    kappa.xy().norm()
                };
                elements += 1.0;
                beyond += f64::from(value > range);
                largest = largest.max(value);
            }
        }
        records += 1.0;
        records_beyond += f64::from(beyond > before);
    }
    [records_beyond / records, beyond / elements, largest]
}

#[test]
fn without_heat_each_section_is_listed() {
    let text = SCENE.replace("thermal: (temperature_k: 298.0, seed: 7),", "");
    let assembly = build(&text);
    let mut bent = [assembly.rest.clone(), assembly.rest.clone()];
    for (state, angle) in bent.iter_mut().zip([0.12, 0.15]) {
        for (frame, arm) in [(1, 1.0), (assembly.frames.len() - 1, 20.0)] {
            let q = state.frames.orientation.get(frame);
            let turn = actin_mechanics::rotation::exp(actin_mechanics::Vector3::z() * angle * arm);
            state.frames.orientation.set(frame, q * turn);
        }
    }
    let found = assembly.beyond_range_over(&bent);
    let places: Vec<(usize, f64)> = found.iter().map(|b| (b.filament, b.value)).collect();
    let [first, second]: [(usize, f64); 2] = places.try_into().expect("one for each section");
    assert_eq!((first.0, second.0), (0, 1));
    assert!((first.1.abs() - 0.15 / SEGMENT).abs() < 1e-12);
    assert!((second.1 - 20.0 * 0.15 / 45.0).abs() < 1e-12);
    let fluctuations: Vec<_> = found
        .iter()
        .filter_map(|b: &LawExtrapolation| b.fluctuations)
        .collect();
    assert!(fluctuations.is_empty());
}
