//! Choice of bonds.

use super::*;
use crate::{EllipsoidModel, Helix};
use InterfaceKind::{Lateral, Longitudinal};
use actin_mechanics::Vector3;

fn with_bonds(bonds: usize) -> EllipsoidParameters {
    EllipsoidParameters::with_sampled_bonds(bonds, 0)
}

fn without_shortest(bonds: usize, seed: u64) -> EllipsoidParameters {
    let mut parameters = EllipsoidParameters::with_sampled_bonds(bonds, seed);
    parameters.lateral.minimum_length = 0.0;
    parameters.longitudinal.minimum_length = 0.0;
    parameters
}

fn gap(kind: InterfaceKind) -> Gap {
    Gap::new(&without_shortest(1, 0), kind)
}

#[test]
fn bonds_bridge_the_gap_parallel_to_the_line_of_centres() {
    for kind in InterfaceKind::ALL {
        let gap = gap(kind);
        let interface = Interface::draw(&with_bonds(500), kind, 3).unwrap();
        let axis = interface.neighbour.offset.normalize();
        for bond in &interface.bonds {
            let upper = interface.neighbour.rotation * bond.upper + interface.neighbour.offset;
            let d = upper - bond.lower;
            assert!((d - bond.rest_length * axis).norm() < 1e-14);
            assert!(bond.rest_length > 0.0 && bond.rest_length <= gap.maximum);
            for end in [bond.lower, bond.upper] {
                assert!((gap.ellipsoid.normal(end).dot(&end) - 1.0).abs() < 1e-13);
            }
            assert!(gap.ellipsoid.normal(bond.lower).dot(&axis) > 0.0);
            let axis = interface.neighbour.rotation.tr_mul(&axis);
            assert!(gap.ellipsoid.normal(bond.upper).dot(&axis) < 0.0);
        }
    }
}

/// The published rule takes the shorter root in absolute value.
#[test]
fn published_rule_accepts_the_same_points() {
    for kind in InterfaceKind::ALL {
        let gap = gap(kind);
        let Neighbour { rotation, offset } = gap.neighbour;
        let direction = offset.normalize();
        let mut stream = Stream::new(9, 0, 0);
        let mut accepted = 0;
        for _ in 0..50_000 {
            let point = gap.ellipsoid.sample(&mut stream);
            let origin = rotation.tr_mul(&(point - offset));
            let level = gap.ellipsoid.normal(origin).dot(&origin);
            assert!(level > 1.0, "monomers do not overlap");
            let shortest = gap
                .ellipsoid
                .line_intersections(origin, rotation.tr_mul(&direction))
                .map(|roots| roots[0].abs().min(roots[1].abs()));
            let published = shortest.filter(|length| *length <= gap.maximum);
            let ours = gap.bond_from(point).map(|bond| bond.rest_length);
            assert_eq!(ours, published);
            accepted += u32::from(ours.is_some());
        }
        assert!(accepted > 1000, "{kind}: {accepted}");
    }
}

/// Radius of a disc with the area of the projected interface. Midpoint rule on a square grid.
fn radius(gap: &Gap) -> f64 {
    const SPACING: f64 = 0.02;
    let axis = gap.neighbour.offset.normalize();
    let first = axis.cross(&Vector3::x()).normalize();
    let second = axis.cross(&first);
    let place = |k: i32| (f64::from(k) + 0.5) * SPACING;
    let lines = (-150..150).flat_map(|i| (-150..150).map(move |j| (i, j)));
    let bonds = lines.filter(|&(i, j)| {
        let origin = place(i) * first + place(j) * second;
        let exit = gap.ellipsoid.line_intersections(origin, axis);
        exit.is_some_and(|[_, exit]| gap.bond_from(origin + exit * axis).is_some())
    });
    (bonds.count() as f64 * SPACING * SPACING / std::f64::consts::PI).sqrt()
}

/// The grid error is 0.005 nm.
#[test]
fn interfaces_have_a_radius_of_about_1_8_nm() {
    for (kind, expected) in [(Lateral, 1.86), (Longitudinal, 1.76)] {
        let radius = radius(&gap(kind));
        assert!((radius - expected).abs() < 0.01, "{kind}: {radius}");
    }
}

/// The surface of the oblate spheroid is 74.2 nm^2.
#[test]
fn sampled_bonds_fill_the_interface() {
    let (a, c): (f64, f64) = (2.7, 1.9);
    let e = (1.0 - (c / a).powi(2)).sqrt();
    let surface = std::f64::consts::TAU * (a * a + c * c / e * e.atanh());
    for kind in InterfaceKind::ALL {
        let interface = Interface::draw(&without_shortest(20_000, 0), kind, 0).unwrap();
        let axis = interface.neighbour.offset.normalize();
        let slopes = interface.bonds.iter().map(|bond| {
            let normal = gap(kind).ellipsoid.normal(bond.lower);
            normal.normalize().dot(&axis)
        });
        let area = surface * slopes.sum::<f64>() / interface.attempts as f64;
        let radius = radius(&gap(kind));
        let ratio = area / (std::f64::consts::PI * radius * radius);
        // Five times the statistical error of 0.7 %, plus 0.5 % for the grid.
        assert!((ratio - 1.0).abs() < 0.04, "{kind}: {ratio}");
    }
}

#[test]
fn a_maximum_length_below_the_gap_is_an_error() {
    let mut parameters = without_shortest(64, 0);
    parameters.longitudinal.maximum_length = 0.05;
    let model = EllipsoidModel::new(parameters).unwrap();
    assert!(model.interface(Lateral, 0).is_ok());
    let error = model.interface(Longitudinal, 0).unwrap_err();
    assert_eq!(
        error,
        InterfaceError::NoBonds {
            kind: Longitudinal,
            minimum_nm: 0.0,
            maximum_nm: 0.05,
            attempts: MAXIMUM_ATTEMPTS
        }
    );
    let message = error.to_string();
    assert!(message.starts_with("no longitudinal bond of 0.0 to 0.05 nm"));
}

#[test]
fn a_limit_with_too_few_bonds_is_an_error() {
    let gap = gap(Lateral);
    let mut stream = Stream::new(4, 0, 0);
    let points = (0..100_000).map(|_| gap.ellipsoid.sample(&mut stream));
    let mut lengths: Vec<f64> = points
        .filter_map(|point| gap.bond_from(point))
        .map(|bond| bond.rest_length)
        .collect();
    lengths.sort_by(f64::total_cmp);
    let mut parameters = without_shortest(1000, 0);
    parameters.lateral.maximum_length = lengths[20];
    let error = Interface::draw(&parameters, Lateral, 0).unwrap_err();
    let InterfaceError::FewBonds {
        found, attempts, ..
    } = error
    else {
        panic!("{error}");
    };
    assert!((1..1000).contains(&found), "{found}");
    assert!(attempts < 2_000_000 + MAXIMUM_ATTEMPTS);
}

#[test]
fn overlapping_monomers_are_bonded_outside_the_overlap() {
    let mut parameters = with_bonds(200);
    parameters.radius = 1.2;
    let gap = Gap {
        neighbour: Helix::new(&parameters).neighbour(Lateral),
        ..gap(Lateral)
    };
    let level = |point: Vector3| gap.ellipsoid.normal(point).dot(&point);
    let Neighbour { rotation, offset } = gap.neighbour;
    assert!(level(0.5 * offset) < 1.0, "the monomers overlap");
    for bond in Interface::draw(&parameters, Lateral, 0).unwrap().bonds {
        assert!(level(rotation.tr_mul(&(bond.lower - offset))) > 1.0);
        assert!(bond.rest_length > 0.0);
    }
}

/// Sines of the helix may differ in the last digit between machines.
#[test]
fn anchors_are_those_of_the_first_release() {
    let parameters = without_shortest(64, 7);
    for ((kind, index), (lower, upper, length)) in GOLDEN {
        let bond = Interface::draw(&parameters, kind, index).unwrap().bonds[0];
        assert!((bond.lower - Vector3::from(lower)).norm() < 1e-14);
        assert!((bond.upper - Vector3::from(upper)).norm() < 1e-14);
        assert!((bond.rest_length - length).abs() < 1e-14);
    }
}

type Golden = ((InterfaceKind, i64), ([f64; 3], [f64; 3], f64));

const GOLDEN: [Golden; 3] = [
    (
        (Lateral, 0),
        (
            [
                -1.341_998_919_960_953_4,
                -1.093_327_339_341_521,
                1.567_734_493_877_502_2,
            ],
            [
                -1.611_064_125_937_659_7,
                1.125_997_770_267_319,
                -0.883_597_756_454_829_6,
            ],
            0.472_070_749_851_875_3,
        ),
    ),
    (
        (Lateral, -1),
        (
            [
                -1.841_208_483_068_338_4,
                -0.426_911_267_036_793_33,
                0.511_775_730_092_914_7,
            ],
            [
                -1.293_084_029_157_880_5,
                0.360_356_908_790_367_1,
                -1.945_144_711_071_19,
            ],
            0.462_883_176_360_301_63,
        ),
    ),
    (
        (Longitudinal, 0),
        (
            [
                1.334_227_093_406_628,
                -0.724_243_258_771_988_1,
                1.780_626_140_731_764_7,
            ],
            [
                0.712_280_286_592_005_9,
                -1.799_094_128_058_294,
                -1.740_326_470_850_600_8,
            ],
            1.980_022_082_868_341_5,
        ),
    ),
];

#[test]
fn rejected_bonds_are_sampled_again() {
    let draw = |shortest, bonds| {
        let mut parameters = without_shortest(bonds, 5);
        parameters.longitudinal.minimum_length = shortest;
        Interface::draw(&parameters, Longitudinal, 3).unwrap().bonds
    };
    let lengths = |bonds: &[Bond]| bonds.iter().map(|b| b.rest_length).collect::<Vec<_>>();
    let all = lengths(&draw(0.0, 500));
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(lengths(&draw(0.999 * least, 500)), all);
    let long: Vec<f64> = all.iter().copied().filter(|l| *l >= 0.3).collect();
    assert!(long.len() < all.len() && long.len() > 400);
    assert_eq!(lengths(&draw(0.3, long.len())), long);
}

#[test]
fn draws_are_keyed_by_kind_and_index() {
    let mut parameters = with_bonds(1);
    let first = |parameters: &EllipsoidParameters, kind, index| {
        Interface::draw(parameters, kind, index).unwrap().bonds[0].lower
    };
    assert_ne!(
        first(&parameters, Lateral, 0),
        first(&parameters, Lateral, 1)
    );
    assert_ne!(
        first(&parameters, Lateral, -1),
        first(&parameters, Lateral, 1)
    );
    parameters.anchors = Anchors::Identical;
    assert_eq!(
        first(&parameters, Lateral, 0),
        first(&parameters, Lateral, -7)
    );
    assert_ne!(
        first(&parameters, Lateral, 0),
        first(&parameters, Longitudinal, 0)
    );
}
