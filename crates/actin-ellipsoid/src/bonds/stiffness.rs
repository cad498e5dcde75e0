//! Second derivatives of the energy of bonds: blocks of pairs from sums over their bonds.
//!
//! The loop over bonds is in `sums.rs`.

use super::sums::{PairSums, Relatives, SumBonds, Sums};
use super::{Body, Bonds};
use crate::table::{BondTable, GROUP, Relative};
use actin_mechanics::Coordinates::{Frame, Point};
use actin_mechanics::{Matrix3, SecondOrder, State, Stiffness, Vector3};

/// The second derivatives by place and turn of the lower body alone, and the loads on it, all in
/// its frame.
///
/// A bond's energy is `k/2 (d^2 - 2 L r + L^2)`, `r = |d|`. With `q` the slope of `r` and `P` the
/// second derivative of `d^2 / 2`, that of `r` is `(P - q q^T) / r`, and so that of the energy is
/// `k [(1 - L/r) P + L/r q q^T]`. By place and turn of the lower body, with `a` and `y` the ends,
/// `q` is minus `(u, a x u)`, `u = d / r`, and `P` has the blocks `1`, `-[a]x` and
/// `(a . y) 1 - (a y^T + y a^T) / 2`, where the turn has been taken to second order.
#[derive(Debug)]
struct LowerBlocks {
    /// By place, twice.
    place: Matrix3,
    /// By place (rows) and turn (columns).
    mixed: Matrix3,
    /// By turn, twice.
    turn: Matrix3,
    force: Vector3,
    torque: Vector3,
}

/// The blocks with the upper body's turn, in the lower body's frame, about whose axes that turn
/// is taken here. The upper body's place enters like the lower one's with the opposite sign.
///
/// A turn of the upper body is one of the pair about the upper centre, less that of the lower
/// body, which goes with a displacement `X phi` of it, `X = [D]x` and `D` the vector between the
/// centres. A turn of the pair does no more than turn the loads: in the frame where they began
/// the slopes change by `[F]x phi` for the place and by `[T]x phi / 2` for the turn, as always in
/// the chart `Q exp(phi)`. So all follows from the lower body's blocks and loads `F`, `T`.
#[derive(Debug)]
struct UpperBlocks {
    /// By the lower place and the upper turn.
    mixed: Matrix3,
    /// By the lower and the upper turn.
    turns: Matrix3,
    /// By the upper turn, twice.
    turn: Matrix3,
}

impl LowerBlocks {
    fn new(sums: &PairSums, stiffness: f64) -> Self {
        let line = |i, j| Matrix3::from_fn(|m, n| symmetric(&sums.lines, i + m, j + n));
        let ends = &sums.ends;
        let weight = ends[0][0];
        let lower = Vector3::new(ends[1][0], ends[2][0], ends[3][0]);
        let upper = Vector3::new(ends[0][1], ends[0][2], ends[0][3]);
        // sum (1 - L/r) a y^T
        let product = Matrix3::from_fn(|m, n| ends[m + 1][n + 1]);
        let turn = Matrix3::from_diagonal_element(product.trace()) - symmetric_part(&product);
        Self {
            place: stiffness * (Matrix3::from_diagonal_element(weight) + line(0, 0)),
            mixed: stiffness * (line(0, 3) - lower.cross_matrix()),
            turn: stiffness * (turn + line(3, 3)),
            force: stiffness * (upper - lower),
            torque: stiffness * axial(&product),
        }
    }

    fn upper(&self, offset: Vector3) -> UpperBlocks {
        let x = offset.cross_matrix();
        let mixed = self.force.cross_matrix() - self.mixed - self.place * x;
        let turns = 0.5 * self.torque.cross_matrix() - self.turn - self.mixed.tr_mul(&x);
        UpperBlocks {
            mixed,
            turns,
            turn: symmetric_part(&(x * mixed - turns)),
        }
    }
}

/// Entry of a symmetric matrix of which the upper triangle is there.
fn symmetric<const N: usize>(upper: &[[f64; N]; N], i: usize, j: usize) -> f64 {
    upper[i.min(j)][i.max(j)]
}

/// `(M + M^T) / 2`.
fn symmetric_part(m: &Matrix3) -> Matrix3 {
    0.5 * (m + m.transpose())
}

/// `sum a x y` from `sum a y^T`.
fn axial(m: &Matrix3) -> Vector3 {
    Vector3::new(m.m23 - m.m32, m.m31 - m.m13, m.m12 - m.m21)
}

impl Bonds {
    /// Adds the blocks of one pair: upper triangle of its four coordinates, row by row.
    fn push_pair(
        &self,
        [k, l]: [usize; 2],
        (lower, relative): &(Body, Relative),
        blocks: &LowerBlocks,
        stiffness: &mut Stiffness,
    ) {
        let (pi, fi) = (Point(self.monomers.point(k)), Frame(self.monomers.frame(k)));
        let (pj, fj) = (Point(self.monomers.point(l)), Frame(self.monomers.frame(l)));
        let (axes, rotation) = (lower.axes, relative.rotation);
        let upper = blocks.upper(relative.offset);
        let place = symmetric_part(&(axes * blocks.place * axes.transpose()));
        let mixed = axes * blocks.mixed;
        let upper_mixed = axes * upper.mixed * rotation;
        let turn = symmetric_part(&(rotation.tr_mul(&upper.turn) * rotation));
        stiffness.push(pi, pi, place);
        stiffness.push(pi, fi, mixed);
        stiffness.push(pi, pj, -place);
        stiffness.push(pi, fj, upper_mixed);
        stiffness.push(fi, fi, blocks.turn);
        stiffness.push(fi, pj, -mixed.transpose());
        stiffness.push(fi, fj, upper.turns * rotation);
        stiffness.push(pj, pj, place);
        stiffness.push(pj, fj, -upper_mixed);
        stiffness.push(fj, fj, turn);
    }

    /// Adds the blocks of up to [`GROUP`] neighbouring pairs, `first` the first lower monomer.
    fn push_group(
        &self,
        table: &BondTable,
        first: usize,
        state: &State,
        stiffness: &mut Stiffness,
    ) {
        let pairs = first..table.pairs.min(first + GROUP);
        let geometry = |k| {
            let lower = self.body(state, k);
            (lower, self.body(state, k + table.step).relative_to(&lower))
        };
        let mut relatives = Relatives::default();
        for (lane, k) in pairs.clone().enumerate() {
            relatives.set(lane, &geometry(k).1);
        }
        let mut sums = Sums::default();
        self.arch.dispatch(SumBonds {
            relatives: &relatives,
            group: table.group(first),
            sums: &mut sums,
        });
        for (lane, k) in pairs.enumerate() {
            let blocks = LowerBlocks::new(&sums.of(lane), table.stiffness);
            self.push_pair([k, k + table.step], &geometry(k), &blocks, stiffness);
        }
    }
}

/// Ten blocks of each pair: longitudinal pairs after lateral ones, each by lower monomer.
///
/// Near a bond of no length its stiffness across diverges as `-k L / |d|`; at no length only
/// `k 1` is counted, the part that has no direction.
impl SecondOrder for Bonds {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for table in &self.tables {
            for first in (0..table.pairs).step_by(GROUP) {
                self.push_group(table, first, state, stiffness);
            }
        }
    }
}
