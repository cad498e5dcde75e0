//! Energy of the pairs of a cell.

use super::jets::MatrixJet;
use super::{Cell, PER_MONOMER, STRAINS, SixVector};
use crate::Interface;
use actin_mechanics::{Matrix3, Vector3};
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

/// Variables of a pair: `u`, `w` of both monomers, then the strains.
const OF_PAIR: usize = 2 * PER_MONOMER + STRAINS;
type Row = SVector<f64, OF_PAIR>;
type Square = SMatrix<f64, OF_PAIR, OF_PAIR>;
/// Variables of a bond, three each: relative displacement of the ends, rotations of both monomers,
/// curvature.
const OF_BOND: usize = 12;
type Gradients = SMatrix<f64, 3, OF_BOND>;
type BondDisplacements = SMatrix<f64, OF_BOND, OF_PAIR>;

#[derive(Clone, Debug)]
pub(super) struct CellPair {
    pub(super) lower: usize,
    pub(super) upper: usize,
    pub(super) steps: usize,
    pub(super) bonds: Vec<CellBond>,
}

/// Anchors relative to the centres, in the orientation of the built filament.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellBond {
    pub(super) lower: Vector3,
    pub(super) upper: Vector3,
    pub(super) length: f64,
    /// Stiffness (pN/nm).
    pub(super) stiffness: f64,
}

struct Body {
    centre: Vector3,
    turn: MatrixJet,
}

pub(super) struct Motion {
    /// Arc length (nm).
    pub(super) length: f64,
    pub(super) rotation: MatrixJet,
    pub(super) jacobian: MatrixJet,
    /// `e3 + sigma`.
    direction: Vector3,
}

#[derive(Debug)]
pub(super) struct Derivatives {
    pub(super) energy: f64,
    pub(super) gradient: DVector<f64>,
    pub(super) hessian: DMatrix<f64>,
}

struct OfPair {
    energy: f64,
    gradient: Row,
    hessian: Square,
}

impl CellPair {
    pub(super) fn new(
        [lower, upper]: [usize; 2],
        interface: &Interface,
        axes: [Matrix3; 2],
        rigidity: f64,
    ) -> Self {
        let bonds = interface.bonds.iter().map(|bond| CellBond {
            lower: axes[0] * bond.lower,
            upper: axes[1] * bond.upper,
            length: bond.rest_length,
            stiffness: rigidity * bond.weight,
        });
        Self {
            lower,
            upper,
            steps: interface.kind.steps(),
            bonds: bonds.collect(),
        }
    }

    fn energy(&self, lower: &Body, upper: &Body, motion: &Motion) -> f64 {
        let shift = motion.shift();
        let energy = |bond: &CellBond| {
            let end = motion.rotation.value * upper.end(bond.upper) + shift;
            let stretch = (end - lower.end(bond.lower)).norm() - bond.length;
            0.5 * bond.stiffness * stretch * stretch
        };
        self.bonds.iter().map(energy).sum()
    }

    /// Energy of the pair with its derivatives.
    ///
    /// ```text
    /// E   = k/2 (r - L)^2
    /// E'  = G^T f,   f = k (1 - L/r) d
    /// E'' = k (1 - L/r) G^T G + (k L / r^3) (G^T d) (G^T d)^T + f . d''
    ///
    /// d, r, G   bond vector (nm), its length, its first derivatives
    /// ```
    ///
    /// Sums over bonds are accumulated in the variables of a bond and then transformed.
    fn derivatives(&self, lower: &Body, upper: &Body, motion: &Motion) -> OfPair {
        let mut gradient = SVector::<f64, OF_BOND>::zeros();
        let mut hessian = SMatrix::<f64, OF_BOND, OF_BOND>::zeros();
        let mut energy = 0.0;
        let mut curved = BondMoments::default();
        let mut slopes = Gradients::identity();
        let shift = motion.shift();
        let bend = motion.shift_by_curvature();
        for bond in &self.bonds {
            let end = upper.end(bond.upper);
            let d = motion.rotation.value * end + shift - lower.end(bond.lower);
            let r = d.norm().max(f64::MIN_POSITIVE);
            for a in 0..3 {
                let of_lower = lower.turn.first[a] * bond.lower;
                slopes.set_column(3 + a, &-of_lower);
                let of_upper = motion.rotation.value * (upper.turn.first[a] * bond.upper);
                slopes.set_column(6 + a, &of_upper);
                let of_bend = motion.rotation.first[a] * end * motion.length + bend.column(a);
                slopes.set_column(9 + a, &of_bend);
            }
            let relative = bond.stiffness * (1.0 - bond.length / r);
            let along = slopes.tr_mul(&d);
            energy += 0.5 * bond.stiffness * (r - bond.length).powi(2);
            gradient += along * relative;
            hessian += slopes.tr_mul(&slopes) * relative;
            let turning = bond.stiffness * bond.length / (r * r * r);
            hessian.ger(turning, &along, &along, 1.0);
            curved.add(relative * d, bond, end);
        }
        let displaced = motion.displaced();
        let mut hessian = displaced.tr_mul(&(hessian * displaced));
        curved.add_to(&mut hessian, lower, upper, motion);
        OfPair {
            energy,
            gradient: displaced.tr_mul(&gradient),
            hessian,
        }
    }
}

impl Body {
    /// Position of a point at `arm` from the centre in the built filament.
    fn end(&self, arm: Vector3) -> Vector3 {
        self.centre + self.turn.value * arm
    }
}

impl Motion {
    pub(super) fn new(strain: &SixVector, length: f64) -> Self {
        let turn = strain.fixed_rows::<3>(0) * length;
        Self {
            length,
            rotation: MatrixJet::rotation(turn),
            jacobian: MatrixJet::left_jacobian(turn),
            direction: Vector3::z() + strain.fixed_rows::<3>(3),
        }
    }

    pub(super) fn shift(&self) -> Vector3 {
        self.jacobian.value * self.direction * self.length
    }

    pub(super) fn shift_by_curvature(&self) -> Matrix3 {
        let square = self.length * self.length;
        let column = |a: usize| self.jacobian.first[a] * self.direction * square;
        Matrix3::from_columns(&[0, 1, 2].map(column))
    }

    /// Derivatives of the variables of a bond with respect to those of the pair.
    fn displaced(&self) -> BondDisplacements {
        let mut displaced = BondDisplacements::zeros();
        let mut set = |row: usize, column: usize, block: Matrix3| {
            displaced
                .fixed_view_mut::<3, 3>(row, column)
                .copy_from(&block);
        };
        set(0, 0, -Matrix3::identity());
        set(0, 6, self.rotation.value);
        set(0, 15, self.jacobian.value * self.length);
        for (row, column) in [(3, 3), (6, 9), (9, 12)] {
            set(row, column, Matrix3::identity());
        }
        displaced
    }
}

#[derive(Default)]
struct BondMoments {
    /// `f`.
    force: Vector3,
    /// `f a^T`, `f b^T` and `f y^T` with the anchors `a`, `b` as built and the current upper end
    /// `y`.
    lower: Matrix3,
    upper: Matrix3,
    end: Matrix3,
}

impl BondMoments {
    fn add(&mut self, force: Vector3, bond: &CellBond, end: Vector3) {
        self.force += force;
        self.lower += force * bond.lower.transpose();
        self.upper += force * bond.upper.transpose();
        self.end += force * end.transpose();
    }

    fn add_to(&self, hessian: &mut Square, lower: &Body, upper: &Body, motion: &Motion) {
        let length = motion.length;
        let turned = motion.rotation.value.tr_mul(&self.upper);
        let along = self.force * motion.direction.transpose();
        for a in 0..3 {
            let back = motion.rotation.first[a].transpose() * length;
            let (place, arms) = (back * self.force, back * self.upper);
            let shear = motion.jacobian.first[a].tr_mul(&self.force) * (length * length);
            for b in 0..3 {
                add_both(hessian, 12 + a, 6 + b, place[b]);
                add_both(hessian, 12 + a, 9 + b, upper.turn.first[b].dot(&arms));
                add_both(hessian, 12 + a, 15 + b, shear[b]);
                hessian[(3 + a, 3 + b)] -= lower.turn.second[a][b].dot(&self.lower);
                hessian[(9 + a, 9 + b)] += upper.turn.second[a][b].dot(&turned);
                let bend = motion.rotation.second[a][b].dot(&self.end)
                    + motion.jacobian.second[a][b].dot(&along) * length;
                hessian[(12 + a, 12 + b)] += bend * length * length;
            }
        }
    }
}

fn add_both(matrix: &mut Square, i: usize, j: usize, value: f64) {
    matrix[(i, j)] += value;
    matrix[(j, i)] += value;
}

impl Cell {
    fn geometry(&self, coordinates: &DVector<f64>, strain: &SixVector) -> (Vec<Body>, [Motion; 2]) {
        let body = |(i, offset): (usize, &Vector3)| Body {
            centre: offset + coordinates.fixed_rows::<3>(PER_MONOMER * i),
            turn: MatrixJet::rotation(coordinates.fixed_rows::<3>(PER_MONOMER * i + 3).into()),
        };
        let motions = [1.0, 2.0].map(|steps| Motion::new(strain, steps * self.rise));
        (self.offsets.iter().enumerate().map(body).collect(), motions)
    }

    pub(super) fn energy(&self, coordinates: &DVector<f64>, strain: &SixVector) -> f64 {
        let (bodies, motions) = self.geometry(coordinates, strain);
        let energy = |pair: &CellPair| {
            let motion = &motions[pair.steps - 1];
            pair.energy(&bodies[pair.lower], &bodies[pair.upper], motion)
        };
        self.pairs.iter().map(energy).sum()
    }

    pub(super) fn derivatives(
        &self,
        coordinates: &DVector<f64>,
        strain: &SixVector,
    ) -> Derivatives {
        let (bodies, motions) = self.geometry(coordinates, strain);
        let size = self.coordinates() + STRAINS;
        let mut all = Derivatives {
            energy: 0.0,
            gradient: DVector::zeros(size),
            hessian: DMatrix::zeros(size, size),
        };
        for pair in &self.pairs {
            let motion = &motions[pair.steps - 1];
            let of_pair = pair.derivatives(&bodies[pair.lower], &bodies[pair.upper], motion);
            all.energy += of_pair.energy;
            let places = [
                pair.lower * PER_MONOMER,
                pair.upper * PER_MONOMER,
                size - STRAINS,
            ];
            for (i, row) in places.into_iter().enumerate() {
                let mut gradient = all.gradient.fixed_rows_mut::<6>(row);
                gradient += of_pair.gradient.fixed_rows::<6>(6 * i);
                for (j, column) in places.into_iter().enumerate() {
                    let mut block = all.hessian.fixed_view_mut::<6, 6>(row, column);
                    block += of_pair.hessian.fixed_view::<6, 6>(6 * i, 6 * j);
                }
            }
        }
        all
    }
}
