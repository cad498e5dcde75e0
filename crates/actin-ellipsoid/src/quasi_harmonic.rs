//! Monomers at a temperature: a chain of neighbours whose places fluctuate as bonds let them, without the bonds.
//!
//! Bonds answer to their length alone. They are far from linear in thermal motion, and their fastest motion
//! takes picoseconds. The relative places of neighbours are nearly normal all the same: a quadratic energy with
//! their mean, their covariance and that with the link below has the same stiffness at this temperature, and elements
//! of positive stiffness that can be drawn at random (see [`RandomStress`]), so that overdamped steps may be ten
//! thousand times longer.
//!
//! The `link` `i` is what joins monomers `i` and `i + 1`. Its displacements `u_i` are the place of the upper centre and the turn
//! of the upper frame, both in the frame of the lower monomer, less those of its `pose`, the mean:
//!
//! `u = (Q_i^T (x_{i+1} - x_i) - p, log(O^T Q_i^T Q_{i+1}))`.
//!
//! Bonds reach from each monomer to the next but one, so that a link knows of the one below it. What it does beyond following
//! that one is its strain, and strains of different links are independent:
//!
//! `w_i = u_i - A_i u_{i-1}`, `A_i = <u_i u_{i-1}^T> <u_{i-1} u_{i-1}^T>^-1`, `E = sum w_i^T P_i w_i / 2`, `P_i = kT <w_i w_i^T>^-1`.
//!
//! This is the energy of most entropy with these moments of neighbouring links. It holds near the pose and at its temperature
//! only: there are no bonds that could be stretched too far, and shear does not stiffen under tension.
//!
//! # Source
//! Karplus and Kushick, Macromolecules 14 (1981) 325; for chains Gonzalez, Petkeviciute and Maddocks, J. Chem. Phys. 138
//! (2013) 055102, who have neighbours' moments of DNA.

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

/// A chain of monomers at a temperature: term `bonds`, one element per link.
///
/// ```
/// use actin_ellipsoid::{EllipsoidModel, EllipsoidParameters, Fluctuations, Interaction, Placement, State};
/// let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
/// let mut state = State::default();
/// let monomers = model.build(&mut state, &Placement::default(), 0, 10).unwrap();
/// let mut fluctuations = Fluctuations::about(&monomers, &state);
/// // Thermal motion of the bonds goes here; noise alone has no stiffness to speak of.
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
    /// The links whose strains count.
    elements: Range<usize>,
}

/// What joins a monomer to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Where the upper monomer stands in the mean, as the lower one sees it.
    pub pose: Pose,
    /// `A`: how displacements follow those of the link below; zero of the first link.
    pub follows: SixMatrix,
    /// `P`: the stiffness of its strain (places before turns: pN/nm, pN, pN nm).
    pub stiffness: SixMatrix,
}

/// A body as another one sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// From the centre of the one to that of the other (nm, frame of the one).
    pub place: Vector3,
    /// From the axes of the other to those of the one.
    pub turn: UnitQuaternion,
}

/// How displacements of a link change with its two monomers, places before turns.
struct Slopes {
    lower: SixMatrix,
    upper: SixMatrix,
}

/// Place and turn of six components.
fn parts(v: &SixVector) -> [Vector3; 2] {
    [
        v.fixed_rows::<3>(0).into_owned(),
        v.fixed_rows::<3>(3).into_owned(),
    ]
}

impl Pose {
    /// Of monomer `k + 1` of a run, as monomer `k` sees it.
    fn of_link(monomers: &Monomers, k: usize, state: &State) -> Self {
        let [lower, upper] = [k, k + 1].map(|k| state.frames.orientation.get(monomers.frame(k)));
        let [from, to] = [k, k + 1].map(|k| state.points.position.get(monomers.point(k)));
        Self {
            place: lower.inverse_transform_vector(&(to - from)),
            turn: lower.inverse() * upper,
        }
    }

    /// Displacements of this pose from that at rest.
    fn displacements(&self, rest: &Self) -> SixVector {
        let turn = rotation::log(rest.turn.inverse() * self.turn);
        let place = self.place - rest.place;
        SixVector::new(place.x, place.y, place.z, turn.x, turn.y, turn.z)
    }

    /// The pose at these displacements.
    fn displaced(&self, by: &SixVector) -> Self {
        let [place, turn] = parts(by);
        Self {
            place: self.place + place,
            turn: self.turn * rotation::exp(turn),
        }
    }
}

impl QuasiHarmonic {
    /// A chain of links, one fewer than `monomers`.
    ///
    /// # Panics
    /// If there are not as many.
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

    /// The same chain, of which only the links above these monomers of the run count: a stretch of it.
    #[must_use]
    pub fn of_lowers(&self, lowers: Range<usize>) -> Self {
        let end = lowers.end.min(self.links.len());
        Self {
            elements: lowers.start.min(end)..end,
            ..self.clone()
        }
    }

    /// The monomers.
    pub fn monomers(&self) -> &Monomers {
        &self.monomers
    }

    /// The links of the whole chain.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// The links that strains of this stretch depend on.
    fn reach(&self) -> Range<usize> {
        self.elements.start.saturating_sub(1)..self.elements.end
    }

    fn displacements(&self, k: usize, state: &State) -> SixVector {
        Pose::of_link(&self.monomers, k, state).displacements(&self.links[k].pose)
    }

    /// The strains of all elements.
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

    /// The stresses of strains, `P w`.
    fn stresses<'a>(&'a self, state: &'a State) -> impl Iterator<Item = SixVector> + 'a {
        let links = &self.links[self.elements.clone()];
        let strains = self.strains(state).zip(links);
        strains.map(|(strain, link)| link.stiffness * strain)
    }

    /// What pulls at the displacements of each link that is reached, of the energy `-sum s . w`.
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
        let pose = Pose::of_link(&self.monomers, k, state);
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
            // J_l(theta) = J_r(theta)^T.
            lower: of(-axes, pose.place.cross_matrix(), -inverse.tr_mul(&to_rest)),
            upper: of(axes, Matrix3::zeros(), inverse),
        }
    }

    /// Adds `g^T P g` of the strain of link `k`, `g` its slopes by the monomers that it joins and the one below.
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

    /// Adds the block of two monomers, or of one.
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

/// A force and a couple that pull at a link.
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
