//! Energy of quadrature bonds.

use actin_ellipsoid::{
    Anchors, Bond, EllipsoidModel, EllipsoidParameters, Interface, InterfaceKind, Neighbour,
};
use actin_mechanics::Xorshift;
use actin_mechanics::{Vector3, rotation};

fn interface(kind: InterfaceKind, anchors: Anchors, bonds: usize) -> Interface {
    let mut parameters = EllipsoidParameters {
        anchors,
        ..EllipsoidParameters::default()
    };
    for interface in [&mut parameters.lateral, &mut parameters.longitudinal] {
        interface.bonds = bonds;
        interface.minimum_length = 0.2;
    }
    let model = EllipsoidModel::new(parameters).expect("the parameters are valid");
    model.interface(kind, 0).expect("the interface has bonds")
}

/// Vectors of the bonds (nm, body frame of the lower monomer), rotated about the middle of the line of centres.
fn vectors(
    interface: &Interface,
    shift: Vector3,
    turn: Vector3,
) -> impl Iterator<Item = (&Bond, Vector3)> {
    let Neighbour {
        rotation: rest,
        offset,
    } = interface.neighbour;
    let turn = rotation::exp(turn);
    interface.bonds.iter().map(move |bond| {
        let arm = rest * bond.upper + 0.5 * offset;
        (bond, 0.5 * offset + turn * arm + shift - bond.lower)
    })
}

/// Energy per rigidity (nm^2).
fn energy(interface: &Interface, shift: Vector3, turn: Vector3) -> f64 {
    let of_bond = |(bond, vector): (&Bond, Vector3)| {
        let stretch = vector.norm() - bond.rest_length;
        0.5 * bond.weight * stretch * stretch
    };
    vectors(interface, shift, turn).map(of_bond).sum()
}

/// The energy of 200 000 sampled bonds is accurate to about 0.2 %.
#[test]
fn twelve_quadrature_bonds_have_the_energy_of_many_sampled_bonds() {
    for kind in InterfaceKind::ALL {
        let many = interface(kind, Anchors::Identical, 200_000);
        let weighted = interface(kind, Anchors::Cubature, 12);
        let drawn = interface(kind, Anchors::Identical, 64);
        let mut noise = Xorshift::new(4);
        let mut squares = [0.0; 2];
        for i in 0..30 {
            let reach = [0.03, 0.1, 0.3][i % 3];
            let (shift, turn) = (noise.vector() * reach, noise.vector() * 0.05);
            let expected = energy(&many, shift, turn);
            let error = |interface| energy(interface, shift, turn) / expected - 1.0;
            let errors = [error(&weighted), error(&drawn)];
            assert!(
                errors[0].abs() < 0.01,
                "{kind}, {shift:?}, {turn:?}: {errors:?}"
            );
            for (square, error) in squares.iter_mut().zip(errors) {
                *square += error * error / 30.0;
            }
        }
        let [weighted, drawn] = squares.map(f64::sqrt);
        assert!(weighted < 0.1 * drawn, "{kind}: {weighted} {drawn}");
    }
}

/// Energies in closed form from averages over the bonds: `(p + s^2 / 2L)^2 / 2`, 31 averages, and
/// with all terms of degree four, 46 averages. A bond is sheared by `s` and extended by `p`.
fn energies_from_averages(interface: &Interface, shift: Vector3, turn: Vector3) -> [f64; 2] {
    let rest = vectors(interface, Vector3::zeros(), Vector3::zeros());
    let of_bond = |((_, rest), (bond, vector)): ((&Bond, Vector3), (&Bond, Vector3))| {
        let (length, axis) = (bond.rest_length, rest.normalize());
        let along = vector.dot(&axis);
        let (p, shear) = (
            along - length,
            (vector - axis * along).norm_squared() / length,
        );
        let stretch = p + 0.5 * shear;
        let higher = -0.5 * p * shear / length - 0.125 * shear * shear / length;
        let energy = 0.5 * bond.weight * stretch * stretch;
        [energy, energy + bond.weight * p * higher]
    };
    let add = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a + c, b + d];
    rest.zip(vectors(interface, shift, turn))
        .map(of_bond)
        .fold([0.0; 2], add)
}

/// An interaction of one term per interface, without bonds, is less accurate where heat moves the
/// monomers.
#[test]
fn twelve_bonds_are_more_accurate_than_averages() {
    for kind in InterfaceKind::ALL {
        let bonds = interface(kind, Anchors::Cubature, 12);
        for reach in [0.03, 0.1, 0.3] {
            let mut noise = Xorshift::new(4);
            let mut squares = [0.0; 2];
            for _ in 0..100 {
                let (shift, turn) = (noise.vector() * reach, noise.vector() * reach / 6.0);
                let expected = energy(&bonds, shift, turn);
                let found = energies_from_averages(&bonds, shift, turn);
                for (square, found) in squares.iter_mut().zip(found) {
                    *square += (found / expected - 1.0).powi(2) / 100.0;
                }
            }
            let errors = squares.map(f64::sqrt);
            println!("{kind}, {reach} nm, {:.3} rad: {errors:.3?}", reach / 6.0);
            assert!(reach < 0.3 || errors.into_iter().all(|error| error > 0.05));
        }
    }
}
