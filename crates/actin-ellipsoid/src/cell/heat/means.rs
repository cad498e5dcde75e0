//! Means over a chain.

use super::super::pairs::Derivatives;
use super::super::{STRAINS, SixMatrix, SixVector};
use nalgebra::{DMatrix, DVector};

/// Directions of the derivatives with respect to the strains, one per column.
#[derive(Debug)]
pub(super) struct StrainDirections {
    pub(super) along: DMatrix<f64>,
    /// Reference state.
    pub(super) origin: DVector<f64>,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Sums {
    count: f64,
    slope: SixVector,
    slope_twice: SixMatrix,
    plain: SixVector,
    strain: SixVector,
    strain_twice: SixMatrix,
    virial: f64,
    hessians: f64,
    hessian: SixMatrix,
    energy: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Means {
    pub(super) strain: SixVector,
    pub(super) covariance: SixMatrix,
    /// Derivatives of the free energy, with and without control variates.
    pub(super) slope: SixVector,
    pub(super) plain: SixVector,
    pub(super) curvature: SixMatrix,
    /// Energy of the cell and `x . dE/dx`.
    pub(super) energy: f64,
    pub(super) virial: f64,
}

impl Sums {
    pub(super) fn add(
        &mut self,
        place: &DVector<f64>,
        gradient: &DVector<f64>,
        moves: &StrainDirections,
        coordinates: usize,
    ) {
        let slope = moves.along.tr_mul(gradient);
        let slope: SixVector = slope.fixed_rows::<STRAINS>(0).into();
        let shift = place - &moves.origin;
        let strain: SixVector = shift.fixed_rows::<STRAINS>(coordinates).into();
        self.count += 1.0;
        self.slope += slope;
        self.slope_twice += slope * slope.transpose();
        self.plain += gradient.fixed_rows::<STRAINS>(coordinates);
        self.strain += strain;
        self.strain_twice += strain * strain.transpose();
        self.virial += shift.dot(gradient);
    }

    pub(super) fn add_derivatives(&mut self, of: &Derivatives, moves: &StrainDirections) {
        let along = moves.along.tr_mul(&(&of.hessian * &moves.along));
        self.hessian += along.fixed_view::<STRAINS, STRAINS>(0, 0);
        self.energy += of.energy;
        self.hessians += 1.0;
    }

    fn add_sums(&mut self, other: &Self, share: f64) {
        self.count += share * other.count;
        self.slope += other.slope * share;
        self.slope_twice += other.slope_twice * share;
        self.plain += other.plain * share;
        self.strain += other.strain * share;
        self.strain_twice += other.strain_twice * share;
        self.virial += share * other.virial;
        self.hessians += share * other.hessians;
        self.hessian += other.hessian * share;
        self.energy += share * other.energy;
    }

    fn means(&self, kt: f64) -> Means {
        let covariance = |first: &SixVector, second: &SixMatrix| {
            let mean = first / self.count;
            second / self.count - mean * mean.transpose()
        };
        let of_slope = covariance(&self.slope, &self.slope_twice);
        Means {
            strain: self.strain / self.count,
            covariance: covariance(&self.strain, &self.strain_twice),
            slope: self.slope / self.count,
            plain: self.plain / self.count,
            curvature: self.hessian / self.hessians - of_slope / kt,
            energy: self.energy / self.hessians,
            virial: self.virial / self.count,
        }
    }
}

pub(super) fn with_errors(blocks: &[Sums], kt: f64) -> (Means, Means) {
    let mut all = Sums::default();
    for block in blocks {
        all.add_sums(block, 1.0);
    }
    let without = blocks.iter().map(|block| {
        let mut rest = all.clone();
        rest.add_sums(block, -1.0);
        rest.means(kt)
    });
    let without: Vec<Means> = without.collect();
    let mean = all.means(kt);
    let count = blocks.len() as f64;
    let error = |pick: &dyn Fn(&Means) -> f64| {
        let centre = without.iter().map(pick).sum::<f64>() / count;
        let squares = without.iter().map(|one| (pick(one) - centre).powi(2));
        (squares.sum::<f64>() * (count - 1.0) / count).sqrt()
    };
    let errors = Means {
        strain: SixVector::from_fn(|i, _| error(&|m| m.strain[i])),
        covariance: SixMatrix::from_fn(|i, j| error(&|m| m.covariance[(i, j)])),
        slope: SixVector::from_fn(|i, _| error(&|m| m.slope[i])),
        plain: SixVector::from_fn(|i, _| error(&|m| m.plain[i])),
        curvature: SixMatrix::from_fn(|i, j| error(&|m| m.curvature[(i, j)])),
        energy: error(&|m| m.energy),
        virial: error(&|m| m.virial),
    };
    (mean, errors)
}
