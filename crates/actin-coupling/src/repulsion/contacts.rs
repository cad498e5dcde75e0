use super::capsule::{Capsule, Follows, MARGIN, RepulsionError, Row, positive, push_blocks};
use super::images::NeighbourPair;
use super::kernel::{Kernel, Tangent};
use super::neighbours::{Neighbours, Reach};
use super::pair::Pair;
use super::passing::{self, Limit};
use crate::PeriodicCell;
use actin_mechanics::{
    Approach, Coordinates, Interaction, Loads, Matrix3, RandomStress, SecondOrder, State,
    StepStress, Stiffness, segments,
};
use std::f64::consts::PI;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Skin of the neighbour list, in radii.
const SKIN: f64 = 1.0;
/// Ratio of axis distance to radius below which two axes count as crossing: half the distance at
/// which the force is largest.
const IMPASSABLE: f64 = Kernel::YIELD;
/// Fraction of the initial distance that pairs within this limit keep.
const IMPASSABLE_KEPT: f64 = 0.99;
/// Fraction of the contact distance, or of a smaller initial distance, up to which filaments
/// approach in one iteration. Their repulsion is then moderate.
const MEETING: f64 = 0.85;
/// Effective number of neighbours that press on a filament. A filament in a bundle has six
/// neighbours, of which half act along one direction.
const PRESSING: f64 = 3.0;

/// Parameters of contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactParameters {
    /// Radius of all filaments (nm).
    pub radius: f64,
    /// Largest stiffness of two perpendicular filaments (pN/nm).
    pub stiffness: f64,
    /// Smallest contour distance (nm) of interacting parts of one filament, at least `pi` radii:
    /// the half circle of a closed hairpin.
    pub apart: f64,
}

/// Repulsion between capsules: term `repulsion`, one element per capsule with half the energy of
/// each of its contacts. Parts of the same filament interact if their contour distance exceeds a
/// limit. In a periodic box, a capsule also interacts with the images of all capsules, including its
/// own.
///
/// ```text
/// E = sum_ab w_a w_b e (1 - r_ab^2/D^2)^4,   e = 27 k / (32 pi)
/// ```
///
/// The sum runs over pairs of points at distances `r_ab < D`. `D` is two radii (nm), `w` the length
/// per point (nm) and `k` the `stiffness` (pN/nm). The force of two perpendicular filaments at
/// distance `d` is `2 pi e d q^4` with `q = 1 - d^2/D^2`. Its maximum `0.351 k D` is at `d = D/3`;
/// a larger load makes filaments pass through each other. Forces are central and conserve momentum
/// and angular momentum.
///
/// Loads allocate memory only when the neighbour list is updated.
#[derive(Debug)]
pub struct Contacts {
    capsules: Vec<Capsule>,
    rows: Vec<Row>,
    radius: f64,
    kernel: Kernel,
    reach: Reach,
    neighbours: Mutex<Neighbours>,
}

impl Clone for Contacts {
    fn clone(&self) -> Self {
        Self {
            capsules: self.capsules.clone(),
            rows: self.rows.clone(),
            neighbours: Mutex::default(),
            ..*self
        }
    }
}

/// Smallest distance of two surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Distance of the surfaces (nm); negative for overlap.
    pub gap: f64,
    /// Indices of the capsules, equal for contact with a wall.
    pub capsules: [usize; 2],
    /// Arc lengths of the nearest points (nm).
    pub places: [f64; 2],
    /// Index of the periodic image of the second capsule; zero for the capsule itself.
    pub image: [i32; 3],
}

impl Contacts {
    /// Creates the contacts of all capsules.
    ///
    /// # Errors
    /// If a radius, stiffness or length is not positive and finite, or `apart` is below `pi` radii.
    ///
    /// ```
    /// use actin_coupling::repulsion::{Axis, Capsule, ContactParameters, Contacts};
    /// use actin_coupling::{Interaction, Loads, Point, State, Vector3};
    /// let mut state = State::default();
    /// // Two pieces of 20 nm that cross at a right angle at a distance of 5 nm.
    /// let ends = [(10.0, 0.0, 0.0), (-10.0, 0.0, 0.0), (0.0, 10.0, 5.0), (0.0, -10.0, 5.0)];
    /// let points = ends.map(|(x, y, z)| {
    ///     state.points.push(Point { position: Vector3::new(x, y, z), mass: 1.0 })
    /// });
    /// let capsule = |a, b, filament| Capsule::new(Axis::Points([a, b]), 20.0, (filament, 10.0));
    /// let capsules = vec![capsule(points[0], points[1], 0)?, capsule(points[2], points[3], 1)?];
    /// let like = ContactParameters { radius: 3.5, stiffness: 100.0, apart: 11.0 };
    /// let contacts = Contacts::new(capsules, like)?;
    /// let mut loads = Loads::zeros(&state);
    /// contacts.add_loads(&state, &mut loads);
    /// let force = loads.force.get(points[2]).z + loads.force.get(points[3]).z;
    /// // 2 pi e d q^4 with e = 27 k / (32 pi) = 26.86 pN/nm, d = 5 nm, q = 1 - 25/49.
    /// assert!((force / 48.59 - 1.0).abs() < 1e-3, "{force}");
    /// assert!((contacts.closest(&state).unwrap().gap + 2.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        capsules: Vec<Capsule>,
        parameters: ContactParameters,
    ) -> Result<Self, RepulsionError> {
        let ContactParameters {
            radius,
            stiffness,
            apart,
        } = parameters;
        positive("radius", radius)?;
        positive("stiffness", stiffness)?;
        positive("apart", apart)?;
        if apart < PI * radius {
            return Err(RepulsionError {
                key: "apart",
                value: apart,
                rule: "at least pi radii",
            });
        }
        Ok(Self {
            rows: capsules.iter().map(|c| Row::new(c, radius)).collect(),
            capsules,
            radius,
            kernel: Kernel::new(stiffness, 2.0 * radius),
            reach: Reach {
                known: (2.0 + MARGIN) * radius,
                skin: SKIN * radius,
                apart,
                cell: None,
            },
            neighbours: Mutex::default(),
        })
    }

    /// Adds contacts with the images of a periodic box.
    #[must_use]
    pub fn with_cell(mut self, cell: Option<PeriodicCell>) -> Self {
        self.reach.cell = cell;
        self
    }

    /// Contribution `sum r F^T` of contacts with periodic images to the virial (pN nm): `r` is the
    /// displacement of the image, and `F` the force on the other capsule (pN, lab frame).
    pub fn periodic_virial(&self, state: &State) -> Matrix3 {
        let lattice = self.reach.cell.map(|cell| cell.lattice(state));
        let mut virial = Matrix3::zeros();
        self.visit(state, self.kernel.reach, |pair, places| {
            let [forces, _] = places.forces(&self.kernel);
            virial += pair.shift(lattice) * (forces[0] + forces[1]).transpose();
        });
        virial
    }

    /// Number of pairs in the neighbour list of `state`.
    pub fn pairs(&self, state: &State) -> usize {
        self.neighbours(state).pairs.len()
    }

    /// Penetration depth at which the force of perpendicular filaments is largest, divided by the
    /// contact distance of two radii.
    pub fn yield_depth() -> f64 {
        1.0 - Kernel::YIELD
    }

    /// Upper bound of the contact stiffness per length of a filament (pN/nm^2). The bound applies
    /// to neighbours on all sides that move opposite to the filament.
    pub fn greatest_stiffness(&self) -> f64 {
        2.0 * PRESSING * self.kernel.greatest_parallel()
    }

    /// Smallest gap, or `None` if all gaps exceed a quarter of a radius.
    pub fn closest(&self, state: &State) -> Option<Gap> {
        let mut least: Option<Gap> = None;
        let known = self.neighbours(state);
        for pair in &known.pairs {
            let [i, j] = pair.capsules;
            let [a, b] = pair.ends(&known.ends, known.lattice);
            let nearest = segments::nearest_points(a, b);
            let gap = nearest.squared.sqrt() - 2.0 * self.radius;
            let is_least = least.is_none_or(|least| gap < least.gap);
            if gap <= MARGIN * self.radius && is_least {
                let at = |capsule: &Capsule, share: f64| {
                    capsule.middle() + (share - 0.5) * capsule.length()
                };
                let [a, b] = nearest.shares;
                let places = [at(&self.capsules[i], a), at(&self.capsules[j], b)];
                least = Some(Gap {
                    gap,
                    capsules: pair.capsules,
                    places,
                    image: pair.image,
                });
            }
        }
        least
    }

    fn neighbours(&self, state: &State) -> MutexGuard<'_, Neighbours> {
        let locked = self.neighbours.lock();
        let mut neighbours = locked.unwrap_or_else(PoisonError::into_inner);
        neighbours.update(&self.capsules, state, &self.reach);
        neighbours
    }

    /// Pairs that approach up to a limit on straight paths, with the fraction of the path; at most
    /// `most` pairs.
    fn approaching(
        &self,
        from: &State,
        to: &State,
        limit: Limit,
        most: usize,
    ) -> Vec<([usize; 2], f64)> {
        let later: Vec<_> = self.capsules.iter().map(|c| c.ends(to)).collect();
        let lattice = self.reach.cell.map(|cell| cell.lattice(to));
        let mut known = self.neighbours(from);
        let reach = (&self.reach, limit.least);
        let pairs = known.meeting_on_the_way(&self.capsules, (&later, lattice), reach);
        let approach = |pair: &NeighbourPair| {
            let ends = pair.ends(&known.ends, known.lattice);
            let fraction = passing::reaches(limit, ends, pair.ends(&later, lattice))?;
            Some((pair.capsules, fraction))
        };
        pairs.iter().filter_map(approach).take(most).collect()
    }

    fn push_stiffness(&self, state: &State, stiffness: &mut Stiffness, tangent: Tangent) {
        self.visit(state, self.reach.known, |pair, places| {
            let [i, j] = pair.capsules;
            let tangents = places.tangents(&self.kernel, tangent);
            let (a, b) = (&self.capsules[i], &self.capsules[j]);
            let (of_a, of_b) = (a.slopes(state), b.slopes(state));
            let bodies: [Follows; 4] = [(0, of_a[0]), (0, of_a[1]), (2, of_b[0]), (2, of_b[1])];
            push_blocks(&bodies, &tangents, stiffness);
        });
        if self.capsules.iter().all(Capsule::has_no_frame) {
            return;
        }
        self.visit(state, self.reach.known, |pair, places| {
            let forces = places.forces(&self.kernel);
            for (i, forces) in pair.capsules.into_iter().zip(forces) {
                self.capsules[i].push_curvature(forces, state, stiffness);
            }
        });
    }

    fn visit(&self, state: &State, within: f64, mut visit: impl FnMut(&NeighbourPair, &Pair)) {
        let known = self.neighbours(state);
        for (pair, ends) in known.within(within) {
            let rows = pair.capsules.map(|i| self.rows[i]);
            visit(pair, &Pair { ends, rows });
        }
    }
}

impl Interaction for Contacts {
    fn term(&self) -> &'static str {
        "repulsion"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        self.visit(state, self.kernel.reach, |pair, places| {
            let forces = places.forces(&self.kernel);
            for (i, forces) in pair.capsules.into_iter().zip(forces) {
                self.capsules[i].add_forces(forces, state, loads);
            }
        });
    }

    fn elements(&self) -> usize {
        self.capsules.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), self.elements(), "one energy per capsule");
        energies.fill(0.0);
        self.visit(state, self.kernel.reach, |pair, places| {
            let half = 0.5 * places.energy(&self.kernel);
            for i in pair.capsules {
                energies[i] += half;
            }
        });
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn random_stress(&self) -> Option<&dyn RandomStress> {
        Some(self)
    }

    /// Two axes count as crossing if their distance falls below a third of a radius. If it is below
    /// already, any further approach counts.
    fn passes_through(&self, from: &State, to: &State) -> Option<Coordinates> {
        let limit = Limit {
            least: IMPASSABLE * self.radius,
            kept: IMPASSABLE_KEPT,
        };
        let first = self.approaching(from, to, limit, 1);
        let ([i, _], _) = first.first()?;
        Some(self.capsules[*i].body())
    }

    fn approaches(&self, from: &State, to: &State) -> Vec<Approach> {
        let limit = Limit {
            least: MEETING * self.kernel.reach,
            kept: MEETING,
        };
        let approaching = self.approaching(from, to, limit, usize::MAX).into_iter();
        approaching
            .map(|(pair, fraction)| Approach {
                bodies: pair.map(|i| self.capsules[i].body()),
                fraction,
            })
            .collect()
    }
}

impl SecondOrder for Contacts {
    /// Adds links for all pairs with gaps below a quarter of a radius. Blocks of pairs without
    /// contact are zero, so that a new contact rarely changes the sparsity of the whole matrix.
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        self.push_stiffness(state, stiffness, Kernel::tangent);
    }

    fn couples_by_distance(&self) -> bool {
        true
    }
}

/// Contacts have no random stress. Only their convexity is used.
impl RandomStress for Contacts {
    fn components(&self) -> usize {
        0
    }

    fn draw(&self, _state: &State, _thermal_energy: f64, _stresses: &mut [f64]) {}

    fn balance(&self, _state: &State, _stresses: &mut [f64]) {}

    fn add_stress_loads(&self, _state: &State, _stresses: &[f64], _loads: &mut Loads) {}

    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    ) {
        let tangent = if stress.is_balanced {
            Kernel::convex_tangent
        } else {
            Kernel::tangent
        };
        self.push_stiffness(state, stiffness, tangent);
    }
}
