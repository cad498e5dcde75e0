//! Capsules that a plane or a sphere repels, as an interaction.

use super::capsule::{Capsule, RepulsionError, Row, positive};
use super::contacts::Gap;
use super::distance;
use super::kernel::WallKernel;
use super::passing::comes_within;
use actin_mechanics::{
    Coordinates, Interaction, Loads, Matrix3, SecondOrder, State, Stiffness, Vector3,
};

/// Distance from contact within which a capsule is in the pattern of the stiffness, in radii.
const MARGIN: f64 = 0.25;

/// A surface that filaments stay on one side of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wall {
    /// A plane; filaments are where its normal points.
    Plane {
        /// A point of it (nm, lab frame).
        point: Vector3,
        /// Its normal, of any length but zero.
        normal: Vector3,
    },
    /// A sphere.
    Sphere {
        /// Its centre (nm, lab frame).
        centre: Vector3,
        /// Its radius (nm).
        radius: f64,
        /// Where filaments are.
        side: Side,
    },
}

/// A side of a sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Within it.
    Inside,
    /// Around it.
    Outside,
}

/// Repulsion of capsules from a wall: term `repulsion`, one element for each capsule.
///
/// With `p` (nm) what the surface of the filament is pressed into the wall by at a point of its axis,
/// `E = sum w k p^4 / (24 R^3)` over points of the axis that each stand for a length `w`; `k` (pN/nm) is
/// the stiffness, `R` (nm) the radius of filaments. A stretch as long as it is thick, pressed in until its
/// axis lies in the surface, has the stiffness `k`.
#[derive(Clone, Debug)]
pub struct WallContact {
    capsules: Vec<Capsule>,
    rows: Vec<Row>,
    wall: Wall,
    kernel: WallKernel,
}

/// A point of an axis in contact: depth, gradient of the distance from the wall, and the curvature of that.
struct Touch {
    depth: f64,
    away: Vector3,
    curving: f64,
    share: f64,
    weight: f64,
}

impl WallContact {
    /// Capsules of a `radius` (nm) at a wall of a `stiffness` (pN/nm).
    ///
    /// # Errors
    /// A number that is not positive and finite, a normal that has no direction, or a sphere inside of
    /// which there is no room.
    pub fn new(
        capsules: Vec<Capsule>,
        wall: Wall,
        radius: f64,
        stiffness: f64,
    ) -> Result<Self, RepulsionError> {
        positive("radius", radius)?;
        positive("stiffness", stiffness)?;
        let refused = |key, value, rule| Err(RepulsionError { key, value, rule });
        let wall = match wall {
            Wall::Plane { point, normal } => {
                // Scaled first, so that squares neither overflow nor underflow.
                let unit = (normal / normal.amax()).normalize();
                if !unit.iter().chain(&point).all(|v| v.is_finite()) {
                    return refused("normal", normal.norm(), "finite and not zero");
                }
                Wall::Plane {
                    point,
                    normal: unit,
                }
            }
            Wall::Sphere {
                radius: of_sphere,
                side,
                ..
            } => {
                positive("radius of a sphere", of_sphere)?;
                if side == Side::Inside && of_sphere <= radius {
                    let rule = "greater than that of filaments inside";
                    return refused("radius of a sphere", of_sphere, rule);
                }
                wall
            }
        };
        Ok(Self {
            rows: capsules.iter().map(|c| Row::of(c, radius)).collect(),
            capsules,
            wall,
            kernel: WallKernel::new(stiffness, radius),
        })
    }

    /// Depth over the radius at which the axis comes to lie in the surface.
    pub fn yield_depth() -> f64 {
        1.0
    }

    /// What the wall can stiffen a filament by per length (pN/nm^2) before its axis is in the surface.
    pub fn greatest_stiffness(&self) -> f64 {
        self.kernel.tangent(self.kernel.radius)
    }

    /// Where a filament is nearest to the wall; none if all are farther than a quarter of a radius.
    pub fn closest(&self, state: &State) -> Option<Gap> {
        let all = self.capsules.iter().enumerate().map(|(i, capsule)| {
            let (share, distance) = self.nearest(capsule.ends(state));
            let place = capsule.middle() + (share - 0.5) * capsule.length();
            Gap {
                gap: distance - self.kernel.radius,
                capsules: [i; 2],
                places: [place; 2],
            }
        });
        let least = all.min_by(|a, b| a.gap.total_cmp(&b.gap))?;
        (least.gap <= MARGIN * self.kernel.radius).then_some(least)
    }

    /// Where an axis is nearest to the wall, as a share of it, and how far it is (nm); negative behind
    /// the wall.
    fn nearest(&self, ends: [Vector3; 2]) -> (f64, f64) {
        let least_of_ends = || {
            let distances = ends.map(|x| self.distance(x).0);
            if distances[0] <= distances[1] {
                (0.0, distances[0])
            } else {
                (1.0, distances[1])
            }
        };
        match self.wall {
            Wall::Sphere {
                centre,
                radius,
                side: Side::Outside,
            } => {
                let (share, squared) = distance::to_point(ends, centre);
                (share, squared.sqrt() - radius)
            }
            _ => least_of_ends(),
        }
    }

    /// Distance of a point from the wall (nm), its gradient `g`, and `c` in its second derivative
    /// `c (1 - g g^T)` (1/nm). At the centre of a sphere there is no direction, and no gradient.
    fn distance(&self, x: Vector3) -> (f64, Vector3, f64) {
        match self.wall {
            Wall::Plane { point, normal } => ((x - point).dot(&normal), normal, 0.0),
            Wall::Sphere {
                centre,
                radius,
                side,
            } => {
                let arm = x - centre;
                let length = arm.norm();
                let (direction, curving) = if length > f64::MIN_POSITIVE {
                    (arm / length, 1.0 / length)
                } else {
                    (Vector3::zeros(), 0.0)
                };
                match side {
                    Side::Inside => (radius - length, -direction, -curving),
                    Side::Outside => (length - radius, direction, curving),
                }
            }
        }
    }

    /// Goes through the points of capsule `i`, whose ends are given, that are in contact.
    fn touches(&self, i: usize, [start, end]: [Vector3; 2], mut visit: impl FnMut(&Touch)) {
        let row = self.rows[i];
        for k in 0..row.count {
            let share = row.share(k);
            let (distance, away, curving) = self.distance(start + (end - start) * share);
            let depth = self.kernel.radius - distance;
            if depth > 0.0 {
                visit(&Touch {
                    depth,
                    away,
                    curving,
                    share,
                    weight: row.weight,
                });
            }
        }
    }

    /// The ends of those capsules whose surface comes within `margin` (nm) of the wall, with their indices.
    fn near(&self, state: &State, margin: f64) -> impl Iterator<Item = (usize, [Vector3; 2])> {
        let ends = self.capsules.iter().map(|capsule| capsule.ends(state));
        let near = move |ends: [Vector3; 2]| self.nearest(ends).1 < self.kernel.radius + margin;
        ends.enumerate().filter(move |(_, ends)| near(*ends))
    }

    /// Forces on the two ends of capsule `i`.
    fn forces(&self, i: usize, ends: [Vector3; 2]) -> [Vector3; 2] {
        let mut forces = [Vector3::zeros(); 2];
        self.touches(i, ends, |t| {
            let force = t.away * (t.weight * self.kernel.force(t.depth));
            forces[0] += force * (1.0 - t.share);
            forces[1] += force * t.share;
        });
        forces
    }

    /// Second derivatives by the two ends of capsule `i`.
    fn tangents(&self, i: usize, ends: [Vector3; 2]) -> [[Matrix3; 2]; 2] {
        let mut blocks = [[Matrix3::zeros(); 2]; 2];
        self.touches(i, ends, |t| {
            let outer = t.away * t.away.transpose();
            let across = (Matrix3::identity() - outer) * (self.kernel.force(t.depth) * t.curving);
            let tangent = (outer * self.kernel.tangent(t.depth) - across) * t.weight;
            let factors = [1.0 - t.share, t.share];
            for (row, f) in blocks.iter_mut().zip(factors) {
                for (block, g) in row.iter_mut().zip(factors) {
                    *block += tangent * (f * g);
                }
            }
        });
        blocks
    }
}

impl Interaction for WallContact {
    fn term(&self) -> &'static str {
        "repulsion"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for (i, ends) in self.near(state, 0.0) {
            self.capsules[i].add_forces(self.forces(i, ends), state, loads);
        }
    }

    fn elements(&self) -> usize {
        self.capsules.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), self.elements(), "one energy per capsule");
        energies.fill(0.0);
        for (i, ends) in self.near(state, 0.0) {
            let energy = &mut energies[i];
            self.touches(i, ends, |t| {
                *energy += t.weight * self.kernel.energy(t.depth);
            });
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    /// An axis that comes into a sphere that it is to stay out of may come out on the other side. Behind
    /// other walls there is no way out but back.
    fn passes_through(&self, from: &State, to: &State) -> Option<Coordinates> {
        let Wall::Sphere {
            centre,
            radius,
            side: Side::Outside,
        } = self.wall
        else {
            return None;
        };
        let still = [centre; 2];
        let passes = |capsule: &&Capsule| {
            let ways = [from, to].map(|state| [capsule.ends(state), still]);
            comes_within(radius, ways[0], ways[1])
        };
        self.capsules.iter().find(passes).map(Capsule::body)
    }
}

impl SecondOrder for WallContact {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for (i, ends) in self.near(state, MARGIN * self.kernel.radius) {
            let tangents = self.tangents(i, ends);
            let capsule = &self.capsules[i];
            let bodies = capsule.slopes(state);
            for (k, (a, slopes_a)) in bodies.iter().enumerate() {
                for (b, slopes_b) in &bodies[k..] {
                    let mut block = Matrix3::zeros();
                    for (e, slope_a) in slopes_a.iter().enumerate() {
                        for (f, slope_b) in slopes_b.iter().enumerate() {
                            block += slope_a.transpose() * tangents[e][f] * slope_b;
                        }
                    }
                    if a == b {
                        block = 0.5 * (block + block.transpose());
                    }
                    stiffness.push(*a, *b, block);
                }
            }
            let work = self.forces(i, ends).map(|f| -f);
            if let Some((frame, block)) = capsule.curvature_of_work(work, state) {
                stiffness.push(frame, frame, block);
            }
        }
    }
}
