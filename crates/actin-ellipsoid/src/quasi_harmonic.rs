//! Quasi-harmonic chain: a quadratic energy of the relative poses of neighbours replaces the bonds.
//!
//! Bonds are strongly nonlinear in thermal motion and require time steps of picoseconds. The
//! relative poses of neighbours are almost normally distributed. A quadratic energy with the same
//! mean and covariances has the same stiffness at this temperature. Its elements have positive
//! stiffness and can be sampled ([`RandomStress`]), so overdamped time steps may be ten thousand
//! times longer.
//!
//! Link `i` joins monomers `i` and `i + 1`:
//!
//! ```text
//! u_i = (Q_i^T (x_{i+1} - x_i) - p, log(O^T Q_i^T Q_{i+1}))     displacement, frame of the lower monomer
//! w_i = u_i - A_i u_{i-1}                                       strain
//! A_i = <u_i u_{i-1}^T> <u_{i-1} u_{i-1}^T>^-1
//! E   = sum w_i^T P_i w_i / 2,   P_i = kT <w_i w_i^T>^-1
//!
//! x, Q   centres (nm) and orientations
//! p, O   mean pose of the upper monomer in the frame of the lower one
//! ```
//!
//! This is the maximum entropy distribution with these moments. It is valid near the mean pose and
//! at its temperature only: bond lengths are not limited, and shear does not stiffen under tension.
//!
//! # Source
//! Karplus and Kushick, Macromolecules 14 (1981) 325; for chains (DNA) Gonzalez, Petkeviciute and
//! Maddocks, J. Chem. Phys. 138 (2013) 055102.

mod fluctuations;
mod stress;

pub use fluctuations::{Fluctuations, FluctuationsError};

use crate::{Monomers, SixMatrix, SixVector};
use actin_mechanics::Coordinates::{Frame, Point};
use actin_mechanics::{
    Interaction, InternalCouple, InternalForce, Loads, Matrix3, RandomStress, SecondOrder, State,
    Stiffness, UnitQuaternion, Vector3, rotation,
};
use std::ops::Range;

/// Quasi-harmonic chain of monomers: term `bonds`, one element per link.
///
/// ```
/// use actin_ellipsoid::{EllipsoidModel, EllipsoidParameters, Fluctuations, Interaction, Placement, State};
/// let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
/// let mut state = State::default();
/// let monomers = model.build(&mut state, &Placement::default(), 0, 10).unwrap();
/// let mut fluctuations = Fluctuations::new(&monomers, &state);
/// // Artificial noise in place of states from a thermal run.
/// for k in 0..100 {
///     let mut moved = state.clone();
///     for i in 0..10 {
///         let noise = |j: usize| (f64::from(k) * (6.1 * i as f64 + 1.7 * j as f64 + 1.0)).sin();
///         let frame = moved.frames.orientation.get(i);
///         let turn = actin_mechanics::rotation::exp([noise(0), noise(1), noise(2)].into());
///         moved.frames.orientation.set(i, frame * turn);
///         moved.points.position.add(i, [noise(3), noise(4), noise(5)].into());
///     }
///     fluctuations.add(&moved);
/// }
/// let chain = fluctuations.chain(4.11).unwrap();
/// assert_eq!((chain.elements(), chain.term()), (9, "bonds"));
/// ```
#[derive(Clone, Debug)]
pub struct QuasiHarmonic {
    monomers: Monomers,
    links: Vec<Link>,
    /// Links whose energy is included.
    elements: Range<usize>,
}

/// Link between a monomer and the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Mean pose of the upper monomer in the frame of the lower one.
    pub pose: Pose,
    /// Regression `A` on the displacement of the link below; zero for the first link.
    pub follows: SixMatrix,
    /// Stiffness `P` of the strain, position before rotation (pN/nm, pN, pN nm).
    pub stiffness: SixMatrix,
}

/// Pose of a body in the frame of another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Vector between the centres (nm, frame of the reference body).
    pub place: Vector3,
    /// Relative orientation, from the axes of the body to those of the reference body.
    pub turn: UnitQuaternion,
}

/// Derivatives of the displacement of a link with respect to its monomers, position before
/// rotation.
struct Slopes {
    lower: SixMatrix,
    upper: SixMatrix,
}

fn parts(v: &SixVector) -> [Vector3; 2] {
    [
        v.fixed_rows::<3>(0).into_owned(),
        v.fixed_rows::<3>(3).into_owned(),
    ]
}

impl Pose {
    fn from_link(monomers: &Monomers, k: usize, state: &State) -> Self {
        let [lower, upper] = [k, k + 1].map(|k| state.frames.orientation.get(monomers.frame(k)));
        let [from, to] = [k, k + 1].map(|k| state.points.position.get(monomers.point(k)));
        Self {
            place: lower.inverse_transform_vector(&(to - from)),
            turn: lower.inverse() * upper,
        }
    }

    fn displacements(&self, rest: &Self) -> SixVector {
        let turn = rotation::log(rest.turn.inverse() * self.turn);
        let place = self.place - rest.place;
        SixVector::new(place.x, place.y, place.z, turn.x, turn.y, turn.z)
    }

    fn displaced(&self, by: &SixVector) -> Self {
        let [place, turn] = parts(by);
        Self {
            place: self.place + place,
            turn: self.turn * rotation::exp(turn),
        }
    }
}

impl QuasiHarmonic {
    /// Chain of links, one fewer than monomers.
    ///
    /// # Panics
    /// If the number of links is wrong.
    pub fn new(monomers: Monomers, links: Vec<Link>) -> Self {
        assert_eq!(
            links.len() + 1,
            monomers.count,
            "one link fewer than monomers"
        );
        let elements = 0..links.len();
        Self {
            monomers,
            links,
            elements,
        }
    }

    /// Part of the chain that includes only the links above the given monomers of the run.
    #[must_use]
    pub fn of_lowers(&self, lowers: Range<usize>) -> Self {
        let end = lowers.end.min(self.links.len());
        Self {
            elements: lowers.start.min(end)..end,
            ..self.clone()
        }
    }

    /// Links of the whole chain.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// Links that determine the strains of this part.
    fn reach(&self) -> Range<usize> {
        self.elements.start.saturating_sub(1)..self.elements.end
    }

    fn displacements(&self, k: usize, state: &State) -> SixVector {
        Pose::from_link(&self.monomers, k, state).displacements(&self.links[k].pose)
    }

    fn strains<'a>(&'a self, state: &'a State) -> impl Iterator<Item = SixVector> + 'a {
        let mut below = match self.reach().start {
            start if start < self.elements.start => self.displacements(start, state),
            _ => SixVector::zeros(),
        };
        self.elements.clone().map(move |k| {
            let own = self.displacements(k, state);
            let strain = own - self.links[k].follows * below;
            below = own;
            strain
        })
    }

    fn stresses<'a>(&'a self, state: &'a State) -> impl Iterator<Item = SixVector> + 'a {
        let links = &self.links[self.elements.clone()];
        let strains = self.strains(state).zip(links);
        strains.map(|(strain, link)| link.stiffness * strain)
    }

    /// Forces and torques of the links for the energy `-sum s . w`.
    fn pulls(&self, stresses: impl Iterator<Item = SixVector>) -> impl Iterator<Item = Pull> {
        let reach = self.reach();
        let mut pulls = vec![SixVector::zeros(); reach.len()];
        for (k, stress) in self.elements.clone().zip(stresses) {
            pulls[k - reach.start] += stress;
            if k > reach.start {
                pulls[k - 1 - reach.start] -= self.links[k].follows.tr_mul(&stress);
            }
        }
        let links = reach.clone().zip(&self.links[reach]);
        links.zip(pulls).map(|((k, link), pull)| {
            let [force, couple] = parts(&pull);
            let monomers = &self.monomers;
            Pull {
                place: link.pose.place,
                force: InternalForce {
                    points: [monomers.point(k), monomers.point(k + 1)],
                    frame: monomers.frame(k),
                    force,
                },
                couple: InternalCouple {
                    frames: [monomers.frame(k), monomers.frame(k + 1)],
                    rest: link.pose.turn,
                    couple,
                },
            }
        })
    }

    fn slopes(&self, k: usize, state: &State) -> Slopes {
        let axes = state.frames.orientation.get(self.monomers.frame(k));
        let axes = axes.inverse().to_rotation_matrix().into_inner();
        let rest = &self.links[k].pose;
        let pose = Pose::from_link(&self.monomers, k, state);
        let [_, turn] = parts(&pose.displacements(rest));
        let inverse = rotation::right_jacobian_inverse(turn);
        let to_rest = rest.turn.inverse().to_rotation_matrix().into_inner();
        let of = |place: Matrix3, arm: Matrix3, turn: Matrix3| {
            let mut m = SixMatrix::zeros();
            m.fixed_view_mut::<3, 3>(0, 0).copy_from(&place);
            m.fixed_view_mut::<3, 3>(0, 3).copy_from(&arm);
            m.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
            m
        };
        Slopes {
            lower: of(-axes, pose.place.cross_matrix(), -inverse.tr_mul(&to_rest)),
            upper: of(axes, Matrix3::zeros(), inverse),
        }
    }

    /// Adds `g^T P g` for the strain of link `k`, where `g` is its derivative with respect to the
    /// monomers.
    fn push_own(&self, k: usize, below: Option<&Slopes>, own: &Slopes, stiffness: &mut Stiffness) {
        let Link {
            follows,
            stiffness: p,
            ..
        } = self.links[k];
        let slopes = match below {
            Some(below) => [
                (k - 1, -follows * below.lower),
                (k, own.lower - follows * below.upper),
                (k + 1, own.upper),
            ],
            None => [
                (k, own.lower),
                (k + 1, own.upper),
                (k + 1, SixMatrix::zeros()),
            ],
        };
        let slopes = &slopes[..if below.is_some() { 3 } else { 2 }];
        for (i, (a, by_a)) in slopes.iter().enumerate() {
            let stress = by_a.tr_mul(&p);
            for (b, by_b) in &slopes[i..] {
                self.push_block([*a, *b], &(stress * by_b), stiffness);
            }
        }
    }

    fn push_block(&self, [a, b]: [usize; 2], block: &SixMatrix, stiffness: &mut Stiffness) {
        let bodies = |k: usize| [Point(self.monomers.point(k)), Frame(self.monomers.frame(k))];
        for (i, of_a) in bodies(a).into_iter().enumerate() {
            for (j, of_b) in bodies(b).into_iter().enumerate() {
                let part: Matrix3 = block.fixed_view::<3, 3>(3 * i, 3 * j).into_owned();
                match (a == b, i.cmp(&j)) {
                    (true, std::cmp::Ordering::Greater) => {}
                    (true, std::cmp::Ordering::Equal) => {
                        stiffness.push(of_a, of_b, 0.5 * (part + part.transpose()));
                    }
                    _ => stiffness.push(of_a, of_b, part),
                }
            }
        }
    }
}

struct Pull {
    place: Vector3,
    force: InternalForce,
    couple: InternalCouple,
}

impl Pull {
    fn add_loads(&self, state: &State, loads: &mut Loads) {
        self.force.add_loads(state, loads);
        self.couple.add_loads(state, loads);
    }

    fn add_loads_without_spin(&self, state: &State, loads: &mut Loads) {
        self.force.add_loads_without_spin(self.place, state, loads);
        self.couple.add_loads_without_spin(state, loads);
    }

    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        self.force.add_stiffness(state, stiffness);
        self.couple.add_stiffness(state, stiffness);
    }
}

impl Interaction for QuasiHarmonic {
    fn term(&self) -> &'static str {
        "bonds"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        let pulls = self.pulls(self.stresses(state).map(|stress| -stress));
        pulls.for_each(|pull| pull.add_loads(state, loads));
    }

    fn elements(&self) -> usize {
        self.elements.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        let links = &self.links[self.elements.clone()];
        for ((energy, strain), link) in energies.iter_mut().zip(self.strains(state)).zip(links) {
            *energy = 0.5 * strain.dot(&(link.stiffness * strain));
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn random_stress(&self) -> Option<&dyn RandomStress> {
        Some(self)
    }
}

impl SecondOrder for QuasiHarmonic {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let start = self.reach().start;
        let mut below = (start < self.elements.start).then(|| self.slopes(start, state));
        for k in self.elements.clone() {
            let own = self.slopes(k, state);
            self.push_own(k, below.as_ref(), &own, stiffness);
            below = Some(own);
        }
        let pulls = self.pulls(self.stresses(state).map(|stress| -stress));
        pulls.for_each(|pull| pull.add_stiffness(state, stiffness));
    }
}

#[cfg(test)]
mod tests;
