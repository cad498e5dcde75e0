//! Second derivatives of the bond energy.

use super::sums::{PairSums, Relatives, SumBonds, Sums};
use super::{Body, Bonds};
use crate::table::{BondTable, GROUP, Relative};
use actin_mechanics::Coordinates::{Frame, Point};
use actin_mechanics::{Matrix3, SecondOrder, State, Stiffness, Vector3};

/// Loads on the lower body and second derivatives of the energy, in its frame.
///
/// ```text
/// E = k/2 (d^2 - 2 L r + L^2),   E'' = k [(1 - L/r) P + (L/r) q q^T]
/// q = -(u, a x u),   u = d / r
/// P blocks: 1,  -[a]x,  (a . y) 1 - (a y^T + y a^T) / 2
///
/// a, y, r   anchors (nm), length (nm)
/// q, P      gradient of r, second derivative of d^2 / 2
/// ```
#[derive(Debug)]
struct LowerBlocks {
    /// Position, position.
    place: Matrix3,
    /// Position (rows), rotation (columns).
    mixed: Matrix3,
    /// Rotation, rotation.
    turn: Matrix3,
    force: Vector3,
    torque: Vector3,
}

/// Blocks that involve the rotation of the upper body, in the frame of the lower body.
///
/// Rotating the upper body equals rotating the pair about the upper centre minus rotating the lower
/// body, which also moves it by `X phi`, `X = [D]x`, `D` the vector between the centres. Rotating
/// the pair only rotates the loads: in the original frame the gradient changes by `[F]x phi` for
/// the position and by `[T]x phi / 2` for the rotation in the chart `Q exp(phi)`.
#[derive(Debug)]
struct UpperBlocks {
    mixed: Matrix3,
    turns: Matrix3,
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

fn symmetric<const N: usize>(upper: &[[f64; N]; N], i: usize, j: usize) -> f64 {
    upper[i.min(j)][i.max(j)]
}

fn symmetric_part(m: &Matrix3) -> Matrix3 {
    0.5 * (m + m.transpose())
}

fn axial(m: &Matrix3) -> Vector3 {
    Vector3::new(m.m23 - m.m32, m.m31 - m.m13, m.m12 - m.m21)
}

impl Bonds {
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

/// Ten blocks per pair: lateral pairs first, then longitudinal ones, ordered by lower monomer.
impl SecondOrder for Bonds {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for table in &self.tables {
            for first in (0..table.pairs).step_by(GROUP) {
                self.push_group(table, first, state, stiffness);
            }
        }
    }
}
