//! Constraints of a cell.

use super::PER_MONOMER;
use actin_mechanics::Vector3;
use nalgebra::DMatrix;

/// Means held at zero.
///
/// A common rigid displacement of all monomers is equivalent to a strain of another axis. Six
/// conditions exclude it; each choice defines a different axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hold {
    /// Displacement `u` and rotation `w`.
    #[default]
    Means,
    /// Rotation, and displacement `u - w x o` of the body points that lie on the axis in the built
    /// filament.
    AxisPoints,
    /// Displacement, transverse rotation, and `(o x u)_3` as rotation about the axis.
    Places,
}

impl Hold {
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

/// Gram-Schmidt process, repeated once against rounding.
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
