//! Quadrature bonds.

use super::*;
use crate::{Anchors, EllipsoidModel, InterfaceError};
use InterfaceKind::{Lateral, Longitudinal};

fn parameters(points: usize, shortest: f64) -> EllipsoidParameters {
    let mut parameters = EllipsoidParameters {
        anchors: Anchors::Cubature,
        ..EllipsoidParameters::default()
    };
    for interface in [&mut parameters.lateral, &mut parameters.longitudinal] {
        interface.bonds = points;
        interface.minimum_length = shortest;
    }
    parameters
}

#[test]
fn twelve_points_meet_the_moments() {
    let change = |set: fn(&mut EllipsoidParameters)| {
        let mut changed = parameters(12, 0.2);
        set(&mut changed);
        changed
    };
    let all = [
        parameters(12, 0.0),
        parameters(12, 0.2),
        parameters(12, 0.3),
        change(|p| p.rise = 2.76),
        change(|p| p.radius = 1.75),
        change(|p| p.radius = 1.85),
        change(|p| p.semi_axes = [2.7, 2.7, 1.9]),
    ];
    for (i, parameters) in all.iter().enumerate() {
        for kind in InterfaceKind::ALL {
            let found = Cubature::find(parameters, kind).unwrap();
            let certificate = found.certificate;
            assert_eq!(found.points.len(), 12);
            assert!(
                certificate.is_within_bounds(),
                "{i} {kind}: {certificate:?}"
            );
            assert!(certificate.residual <= MET, "{i} {kind}: {certificate:?}");
            let sum: f64 = found.points.iter().map(|p| p.weight).sum();
            assert!((sum - 1.0).abs() < MET);
            let floor = parameters.interface(kind).minimum_length;
            assert!(certificate.lengths[0] >= floor - 1e-12);
        }
    }
}

#[test]
fn more_points_reduce_the_residual() {
    let residual = |points| {
        let found = Cubature::find(&parameters(points, 0.2), Longitudinal).unwrap();
        found.certificate.residual
    };
    let (few, some, many) = (residual(6), residual(8), residual(16));
    assert!(
        few > 2.0 * some && some > 100.0 * many,
        "{few} {some} {many}"
    );
}

/// Sums may differ in the last digit between machines.
#[test]
fn the_table_is_reproduced() {
    for kind in InterfaceKind::ALL {
        let parameters = EllipsoidParameters::default();
        let table = table::built_in(&parameters, kind)
            .expect("the default parameters have built-in points");
        let finder = Finder::new(&parameters, kind).unwrap();
        let certificate = finder.certificate(&table.points);
        assert!(certificate.is_within_bounds() && certificate.residual <= MET);
        let residuals = [certificate.residual, table.certificate.residual];
        assert!(
            (residuals[0] / residuals[1] - 1.0).abs() < 1e-3,
            "{residuals:?}"
        );
        let found = Cubature::find_from(&finder, finder.drawn_starts(kind, 12), 12).unwrap();
        for (a, b) in found.points.iter().zip(&table.points) {
            let differences = [
                a.place[0] - b.place[0],
                a.place[1] - b.place[1],
                a.height - b.height,
                a.length - b.length,
                a.weight - b.weight,
            ];
            assert!(
                differences.iter().all(|d| d.abs() < 1e-6),
                "{kind}: {a:?} {b:?}"
            );
        }
    }
}

#[test]
fn points_are_cached() {
    let standard = parameters(12, 0.2);
    let first = Cubature::for_interface(&standard, Lateral).unwrap();
    assert!(Arc::ptr_eq(
        &first,
        &Cubature::for_interface(&standard, Lateral).unwrap()
    ));
    let mut other = standard.clone();
    other.seed = 9;
    other.azimuth = 1.0;
    assert!(Arc::ptr_eq(
        &first,
        &Cubature::for_interface(&other, Lateral).unwrap()
    ));
    other.lateral.bonds = 13;
    assert!(!Arc::ptr_eq(
        &first,
        &Cubature::for_interface(&other, Lateral).unwrap()
    ));
}

/// The ends of a sampled bond lie on the surfaces; ends of a point are equally far from them.
#[test]
fn bonds_lie_along_the_line_of_centres() {
    let model = EllipsoidModel::new(parameters(12, 0.2)).unwrap();
    for kind in InterfaceKind::ALL {
        let interface = model.interface(kind, -3).unwrap();
        assert_eq!(interface, model.interface(kind, 8).unwrap());
        let Neighbour { rotation, offset } = interface.neighbour;
        let axis = offset.normalize();
        for bond in &interface.bonds {
            let upper = rotation * bond.upper + offset;
            assert!((upper - bond.lower - bond.rest_length * axis).norm() < 1e-14);
            let [lower_surface, upper_surface] = surfaces(&model, kind, bond);
            let above = (bond.lower - lower_surface).dot(&axis);
            let below = (upper_surface - upper).dot(&axis);
            assert!((above - below).abs() < 1e-11, "{kind}: {above} {below}");
        }
    }
}

/// Exit from the lower monomer and entry into the upper one along a bond.
fn surfaces(model: &EllipsoidModel, kind: InterfaceKind, bond: &crate::Bond) -> [Vector3; 2] {
    let Neighbour { rotation, offset } = model.helix().neighbour(kind);
    let axis = offset.normalize();
    let ellipsoid = crate::Ellipsoid::new(model.parameters().semi_axes);
    let [_, exit] = ellipsoid.line_intersections(bond.lower, axis).unwrap();
    let origin = rotation.tr_mul(&(bond.lower - offset));
    let towards = rotation.tr_mul(&axis);
    let [entry, _] = ellipsoid.line_intersections(origin, towards).unwrap();
    [exit, entry].map(|along| bond.lower + along * axis)
}

#[test]
fn overlapping_monomers_need_a_minimum_length() {
    let mut overlapping = parameters(12, 0.0);
    overlapping.radius = 1.2;
    let refused = |p: &EllipsoidParameters| {
        let model = EllipsoidModel::new(p.clone()).unwrap();
        model.interface(Lateral, 0).err()
    };
    let reason = CubatureError::Touching;
    let kind = Lateral;
    assert_eq!(
        refused(&overlapping),
        Some(InterfaceError::NoCubature { kind, reason })
    );
    overlapping.lateral.minimum_length = 0.2;
    assert_eq!(refused(&overlapping), None);
}

#[test]
fn a_range_of_lengths_without_points_is_refused() {
    let mut narrow = parameters(12, 0.2);
    narrow.longitudinal.minimum_length = narrow.longitudinal.maximum_length - 1e-4;
    let error = Cubature::for_interface(&narrow, Longitudinal).unwrap_err();
    assert!(
        matches!(error, CubatureError::OutOfBounds { .. }),
        "{error}"
    );
}

#[test]
fn an_interface_without_bonds_is_refused() {
    let mut short = parameters(12, 0.0);
    short.longitudinal.maximum_length = 0.05;
    let error = Cubature::for_interface(&short, Longitudinal).unwrap_err();
    assert!(matches!(error, CubatureError::NoBonds { .. }), "{error}");
}
