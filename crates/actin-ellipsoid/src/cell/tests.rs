//! Energy of a cell.

use super::{
    Cell,
    Control::{Load, Strain},
    Hold, SixVector,
};
use crate::{EllipsoidModel, EllipsoidParameters};
use actin_mechanics::testing::derivative;
use nalgebra::DVector;

fn weighted(monomers: usize, hold: Hold) -> Cell {
    cell(EllipsoidParameters::default(), monomers, hold)
}

fn cell(parameters: EllipsoidParameters, monomers: usize, hold: Hold) -> Cell {
    let model = EllipsoidModel::new(parameters).unwrap();
    Cell::new(&model, monomers, hold).unwrap()
}

fn strain() -> SixVector {
    SixVector::new(4e-3, -2e-3, 0.011, 6e-3, 3e-3, -4e-3)
}

/// Eight-point differences. Sampled bonds exclude symmetries that could hide a wrong index.
#[test]
fn derivatives_of_the_cell_are_exact() {
    let cell = cell(
        EllipsoidParameters::with_sampled_bonds(7, 3),
        13,
        Hold::Means,
    );
    let coordinates = DVector::from_fn(78, |k, _| 0.05 * (7.3 * k as f64 + 1.0).sin());
    let at = |place: usize, h: f64| {
        let (mut coordinates, mut strain) = (coordinates.clone(), strain());
        match place.checked_sub(78) {
            None => coordinates[place] += h,
            Some(place) => strain[place] += h,
        }
        cell.derivatives(&coordinates, &strain)
    };
    let all = at(0, 0.0);
    assert!((all.energy - cell.energy(&coordinates, &strain())).abs() < 1e-12 * all.energy);
    let (largest, stiffest) = (all.gradient.amax(), all.hessian.amax());
    for place in 0..84 {
        let h = if place < 78 { 2e-3 } else { 2e-4 };
        let slope = derivative(h, |h| at(place, h).energy);
        assert!(
            (all.gradient[place] - slope).abs() < 1e-10 * largest,
            "{place}"
        );
        let column = derivative(h, |h| at(place, h).gradient);
        assert!(
            (all.hessian.column(place) - column).amax() < 1e-10 * stiffest,
            "{place}"
        );
    }
}

/// Relative to the largest load and entry of the same kind.
#[test]
fn loads_and_tangent_are_derivatives_of_the_relaxed_energy() {
    let cell = weighted(13, Hold::Means);
    let middle = cell.relax(&strain(), None).unwrap();
    let at = |k: usize, h: f64| {
        let strain = strain() + SixVector::ith(k, h);
        cell.relax(&strain, Some(&middle.displacements)).unwrap()
    };
    for k in 0..6 {
        let h = 1e-4;
        let slope = derivative(h, |h| at(k, h).energy);
        let size = if k < 3 {
            middle.loads.rows(0, 3).amax()
        } else {
            middle.loads.rows(3, 3).amax()
        };
        assert!(
            (middle.loads[k] - slope).abs() < 1e-8 * size,
            "{k}: {} {slope}",
            middle.loads[k]
        );
        let column = derivative(h, |h| at(k, h).loads);
        for j in 0..6 {
            let size = (middle.tangent[(j, j)] * middle.tangent[(k, k)]).sqrt();
            let entry = middle.tangent[(j, k)];
            assert!(
                (entry - column[j]).abs() < 1e-8 * size,
                "{j} {k}: {entry} {}",
                column[j]
            );
        }
    }
}

#[test]
fn longer_cells_of_equal_bonds_are_the_same() {
    let short = weighted(13, Hold::Means).relax(&strain(), None).unwrap();
    let long = weighted(26, Hold::Means).relax(&strain(), None).unwrap();
    assert!((short.energy - long.energy).abs() < 1e-10 * short.energy);
    assert!((short.loads - long.loads).amax() < 1e-7 * short.loads.amax());
}

/// Stretched at fixed twist, bonds along the lines of centres (axial distance z, transverse chord
/// t, length l) resist as `sum k (t^2 x + z^2)^2 / l^2 / rise` if only the radius relaxes, by `x`:
/// 34708 pN.
#[test]
fn the_built_filament_is_at_rest() {
    let cell = weighted(13, Hold::Means);
    let rest = cell.relax(&SixVector::zeros(), None).unwrap();
    assert!(rest.energy.abs() < 1e-20 && rest.loads.amax() < 1e-9);
    let stiffness = rest.tangent[(5, 5)];
    assert!(
        stiffness < 34_708.5 && stiffness > 0.999 * 34_708.0,
        "{stiffness}"
    );
}

#[test]
fn given_loads_are_met() {
    let cell = weighted(13, Hold::Means);
    let free = [
        Load(0.0),
        Load(0.0),
        Strain(5e-3),
        Load(0.1),
        Load(0.0),
        Load(10.0),
    ];
    let found = cell.relax_under(&free, None).unwrap();
    let expected = SixVector::new(0.0, 0.0, found.loads[2], 0.1, 0.0, 10.0);
    assert!((found.loads - expected).amax() < 1e-8, "{}", found.loads);
    let again = cell
        .relax(&found.strain, Some(&found.displacements))
        .unwrap();
    assert!((again.loads - found.loads).amax() < 1e-8);
}

#[test]
fn cells_are_whole_periods() {
    let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
    for monomers in [0, 1, 12, 14] {
        let refused = Cell::new(&model, monomers, Hold::Means).unwrap_err();
        let start = format!("a cell of {monomers} monomers: must be");
        assert!(refused.to_string().starts_with(&start), "{refused}");
    }
}

/// Bending in a plane is 7 % stiffer than along a helix.
#[test]
fn pre_twist_is_equivalent_to_twist() {
    let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
    let turn = -std::f64::consts::TAU * 8.0 / 17.0;
    let twist = (turn - model.parameters().turn) / model.parameters().rise;
    let plane = Cell::with_turn(&model, 17, turn, Hold::Means).unwrap();
    let helix = weighted(13, Hold::Means);
    let under = |cell: &Cell, twist: f64, bend: f64| {
        let free = Load(0.0);
        let controls = [Strain(bend), Strain(0.0), Strain(twist), free, free, free];
        cell.relax_under(&controls, None).unwrap()
    };
    let [straight, twisted] = [under(&plane, 0.0, 0.0), under(&helix, twist, 0.0)];
    assert!((straight.energy / twisted.energy - 1.0).abs() < 1e-9);
    assert!((straight.loads[2] / twisted.loads[2] - 1.0).abs() < 1e-9);
    assert!((straight.strain[5] - twisted.strain[5]).abs() < 1e-9);
    let [bent, along] = [under(&plane, 0.0, 2e-3), under(&helix, twist, 2e-3)];
    let stiffer = bent.loads[0] / along.loads[0] - 1.0;
    assert!((0.06..0.08).contains(&stiffer), "{stiffer}");
}
