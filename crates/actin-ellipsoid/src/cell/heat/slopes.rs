//! Energy and gradient of a cell, for trajectories.

use super::super::jets::turned;
use super::super::pairs::{CellPair, Motion};
use super::super::{Cell, PER_MONOMER, SixVector};
use actin_mechanics::{Matrix3, Vector3};
use nalgebra::DVector;

struct BodyTransform {
    centre: Vector3,
    turn: Matrix3,
    /// Left Jacobian: a change `dw` of the rotation vector rotates by `J dw`.
    jacobian: Matrix3,
}

impl BodyTransform {
    fn couple(&self, couple: Vector3) -> Vector3 {
        self.jacobian.tr_mul(&couple)
    }
}

/// Force on the lower centre and torques, in the lower frame.
struct PairLoads {
    energy: f64,
    force: Vector3,
    lower: Vector3,
    upper: Vector3,
}

impl CellPair {
    fn loads(&self, turn: &Matrix3, shift: &Vector3) -> PairLoads {
        let mut sum = PairLoads {
            energy: 0.0,
            force: Vector3::zeros(),
            lower: Vector3::zeros(),
            upper: Vector3::zeros(),
        };
        for bond in &self.bonds {
            let end = turn * bond.upper;
            let d = end + shift - bond.lower;
            let r = d.norm().max(f64::MIN_POSITIVE);
            let stretch = r - bond.length;
            let pull = bond.stiffness * stretch;
            let force = d * (pull / r);
            sum.energy += 0.5 * pull * stretch;
            sum.force += force;
            sum.lower += bond.lower.cross(&force);
            sum.upper += end.cross(&force);
        }
        sum
    }
}

impl Cell {
    /// Energy (pN nm) at `place` (coordinates, then strains). Writes the derivatives to `gradient`.
    pub(super) fn slopes(&self, place: &DVector<f64>, gradient: &mut DVector<f64>) -> f64 {
        let coordinates = self.coordinates();
        let strain: SixVector = place.fixed_rows::<6>(coordinates).into();
        let motions = [1.0, 2.0].map(|steps| Motion::new(&strain, steps * self.rise));
        let bends = [0, 1].map(|k| motions[k].shift_by_curvature());
        let shifts = [0, 1].map(|k| motions[k].shift());
        let placed: Vec<BodyTransform> = self.placed(place).collect();
        gradient.fill(0.0);
        let mut energy = 0.0;
        for pair in &self.pairs {
            let (lower, upper) = (&placed[pair.lower], &placed[pair.upper]);
            let motion = &motions[pair.steps - 1];
            let rotation = &motion.rotation.value;
            let reach = rotation * upper.centre;
            let from = lower.turn.transpose();
            let turn = from * (rotation * upper.turn);
            let shift = from * (reach + shifts[pair.steps - 1] - lower.centre);
            let loads = pair.loads(&turn, &shift);
            energy += loads.energy;
            let force = lower.turn * loads.force;
            let couple = lower.turn * loads.upper;
            let mut add = |row: usize, value: Vector3| {
                let mut rows = gradient.fixed_rows_mut::<3>(row);
                rows += value;
            };
            let (below, above) = (pair.lower * PER_MONOMER, pair.upper * PER_MONOMER);
            add(below, -force);
            add(below + 3, -lower.couple(lower.turn * loads.lower));
            add(above, rotation.tr_mul(&force));
            add(above + 3, upper.couple(rotation.tr_mul(&couple)));
            let axial = motion.jacobian.value;
            let of_turn = axial.tr_mul(&(couple + reach.cross(&force))) * motion.length;
            add(coordinates, of_turn + bends[pair.steps - 1].tr_mul(&force));
            add(coordinates + 3, axial.tr_mul(&force) * motion.length);
        }
        energy
    }

    fn placed<'a>(&'a self, place: &'a DVector<f64>) -> impl Iterator<Item = BodyTransform> + 'a {
        self.offsets.iter().enumerate().map(|(i, offset)| {
            let (turn, jacobian) = turned(place.fixed_rows::<3>(PER_MONOMER * i + 3).into());
            BodyTransform {
                centre: offset + place.fixed_rows::<3>(PER_MONOMER * i),
                turn,
                jacobian,
            }
        })
    }

    /// Rotation vectors with the indices of their first components.
    pub(super) fn turns(&self, place: &DVector<f64>) -> impl Iterator<Item = (usize, Vector3)> {
        let rows = (0..self.monomers()).map(|i| PER_MONOMER * i + 3);
        rows.map(|row| (row, place.fixed_rows::<3>(row).into()))
    }
}
