//! What ties the monomers of a cell to its axis.

use super::PER_MONOMER;
use actin_mechanics::Vector3;
use nalgebra::DMatrix;

/// Which means are held at zero, so that the axis is where the monomers are.
///
/// A displacement of all monomers by the same rigid motion `h` in the frames of their places is
/// no relaxation: it is the strain of the axis `g h`. Six conditions rule it out. Where they differ, they name
/// another axis of the same filament.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hold {
    /// Displacement `u` and turn `w`.
    #[default]
    Means,
    /// Displacement of the points of the bodies that stand on the axis in the built filament,
    /// `u - w x o` to first order, and turn.
    AxisPoints,
    /// Displacement, turn across the axis, and about it the turn of the places, `(o x u)_3`.
    Places,
}

impl Hold {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Means, Self::AxisPoints, Self::Places];

    /// The conditions as orthonormal rows, for monomers at these offsets from the axis.
    pub(super) fn rows(self, offsets: &[Vector3]) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(6, PER_MONOMER * offsets.len());
        for (i, offset) in offsets.iter().enumerate() {
            let mut block = rows.fixed_view_mut::<6, 6>(0, PER_MONOMER * i);
            block.fill_with_identity();
            match self {
                Self::Means => {}
                Self::AxisPoints => {
                    // -w x o = o x w
                    block
                        .fixed_view_mut::<3, 3>(0, 3)
                        .copy_from(&offset.cross_matrix());
                }
                Self::Places => {
                    let turn = offset.cross_matrix().row(2).into_owned();
                    block.fixed_view_mut::<1, 3>(5, 0).copy_from(&turn);
                    block[(5, 5)] = 0.0;
                }
            }
        }
        orthonormal(rows)
    }
}

/// The rows made orthogonal and of unit length one after another, twice against rounding.
fn orthonormal(mut rows: DMatrix<f64>) -> DMatrix<f64> {
    for _ in 0..2 {
        for k in 0..rows.nrows() {
            for j in 0..k {
                let (along, other) = (rows.row(k).dot(&rows.row(j)), rows.row(j).into_owned());
                let mut row = rows.row_mut(k);
                row -= other * along;
            }
            let length = rows.row(k).norm();
            rows.row_mut(k).unscale_mut(length);
        }
    }
    rows
}
