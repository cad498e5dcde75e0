use super::capsule::{Capsule, MARGIN, RepulsionError, Row, positive, push_blocks};
use super::contacts::Gap;
use super::kernel::WallKernel;
use super::passing::{self, Limit};
use super::wall::Wall;
use actin_mechanics::{
    Approach, Coordinates, Interaction, Loads, Matrix3, SecondOrder, State, Stiffness, Vector3,
};

/// Distance of an axis from a sphere or cylinder up to which filaments approach in one iteration, in radii.
const MEETING: f64 = 0.8;
/// Fraction of the initial distance from the centre or axis that closer filaments keep.
const KEPT: f64 = 0.99;

/// Repulsion of capsules from a wall: term `repulsion`, one element per capsule.
///
/// ```text
/// E = sum w k p^4 / (24 R^3)
/// ```
///
/// The sum runs over the points of the axis with length `w` (nm) and penetration depth `p` (nm).
/// `k` is the stiffness (pN/nm) and `R` the radius of the filaments (nm). A piece of length `2 R`
/// whose axis is in the surface of the wall has the stiffness `k`.
#[derive(Clone, Debug)]
pub struct WallContact {
    capsules: Vec<Capsule>,
    rows: Vec<Row>,
    wall: Wall,
    kernel: WallKernel,
}

/// Point of an axis in contact: depth, gradient and curvature of the wall distance.
struct ContactPoint {
    depth: f64,
    away: Vector3,
    curving: f64,
    share: f64,
    weight: f64,
}

impl WallContact {
    /// Creates the contacts of capsules of a `radius` (nm) with a wall of a `stiffness` (pN/nm).
    ///
    /// # Errors
    /// If a number is not positive and finite, or the inside of the wall is too small.
    pub fn new(
        capsules: Vec<Capsule>,
        wall: Wall,
        radius: f64,
        stiffness: f64,
    ) -> Result<Self, RepulsionError> {
        positive("radius", radius)?;
        positive("stiffness", stiffness)?;
        if let Some(of_wall) = wall.inner_radius()
            && of_wall <= radius
        {
            return Err(RepulsionError {
                key: "radius of a wall",
                value: of_wall,
                rule: "greater than the radius of filaments inside",
            });
        }
        Ok(Self {
            rows: capsules.iter().map(|c| Row::new(c, radius)).collect(),
            capsules,
            wall,
            kernel: WallKernel::new(stiffness, radius),
        })
    }

    /// Penetration depth, divided by the radius, at which the axis lies in the surface of the wall.
    pub fn yield_depth() -> f64 {
        1.0
    }

    /// Stiffness per length (pN/nm^2) if the axis lies in the surface of the wall.
    pub fn greatest_stiffness(&self) -> f64 {
        self.kernel.tangent(self.kernel.radius)
    }

    /// Smallest gap, or `None` if all gaps exceed a quarter of a radius.
    pub fn closest(&self, state: &State) -> Option<Gap> {
        let all = self.capsules.iter().enumerate().map(|(i, capsule)| {
            let (share, distance) = self.wall.nearest(capsule.ends(state));
            let place = capsule.middle() + (share - 0.5) * capsule.length();
            Gap {
                gap: distance - self.kernel.radius,
                capsules: [i; 2],
                places: [place; 2],
                image: [0; 3],
            }
        });
        let least = all.min_by(|a, b| a.gap.total_cmp(&b.gap))?;
        (least.gap <= MARGIN * self.kernel.radius).then_some(least)
    }

    fn touches(&self, i: usize, [start, end]: [Vector3; 2], mut visit: impl FnMut(&ContactPoint)) {
        let row = self.rows[i];
        for k in 0..row.count {
            let share = row.share(k);
            let (distance, away, curving) = self.wall.distance(start + (end - start) * share);
            let depth = self.kernel.radius - distance;
            if depth > 0.0 {
                visit(&ContactPoint {
                    depth,
                    away,
                    curving,
                    share,
                    weight: row.weight,
                });
            }
        }
    }

    /// Indices and ends of the capsules with gaps below `margin` (nm).
    fn near(&self, state: &State, margin: f64) -> impl Iterator<Item = (usize, [Vector3; 2])> {
        let ends = self.capsules.iter().map(|capsule| capsule.ends(state));
        let near =
            move |ends: [Vector3; 2]| self.wall.nearest(ends).1 < self.kernel.radius + margin;
        ends.enumerate().filter(move |(_, ends)| near(*ends))
    }

    fn forces(&self, i: usize, ends: [Vector3; 2]) -> [Vector3; 2] {
        let mut forces = [Vector3::zeros(); 2];
        self.touches(i, ends, |t| {
            let force = t.away * (t.weight * self.kernel.force(t.depth));
            forces[0] += force * (1.0 - t.share);
            forces[1] += force * t.share;
        });
        forces
    }

    fn tangents(&self, i: usize, ends: [Vector3; 2]) -> [[Matrix3; 2]; 2] {
        let mut blocks = [[Matrix3::zeros(); 2]; 2];
        self.touches(i, ends, |t| {
            let outer = t.away * t.away.transpose();
            let across =
                (self.wall.curved_directions() - outer) * (self.kernel.force(t.depth) * t.curving);
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

impl WallContact {
    /// Bodies outside of a sphere or cylinder whose straight paths lead within a distance (nm) of it,
    /// with the fraction of the path up to there. Other walls need no check, since the energy grows
    /// with the penetration depth. An axis can enter a sphere and leave on the other side within one
    /// step.
    fn approaching(
        &self,
        from: &State,
        to: &State,
        distance: f64,
    ) -> impl Iterator<Item = (Coordinates, f64)> {
        self.wall
            .outer_radius()
            .into_iter()
            .flat_map(move |radius| {
                let limit = Limit {
                    least: radius + distance,
                    kept: KEPT,
                };
                let approach = move |capsule: &Capsule| {
                    let ways = [from, to].map(|state| {
                        let arms = capsule.ends(state).map(|x| self.wall.arm(x));
                        [arms, [Vector3::zeros(); 2]]
                    });
                    let fraction = passing::reaches(limit, ways[0], ways[1])?;
                    Some((capsule.body(), fraction))
                };
                self.capsules.iter().filter_map(approach)
            })
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

    fn passes_through(&self, from: &State, to: &State) -> Option<Coordinates> {
        let mut approaching = self.approaching(from, to, 0.0);
        approaching.next().map(|(body, _)| body)
    }

    fn approaches(&self, from: &State, to: &State) -> Vec<Approach> {
        let approaching = self.approaching(from, to, MEETING * self.kernel.radius);
        approaching
            .map(|(body, fraction)| Approach {
                bodies: [body; 2],
                fraction,
            })
            .collect()
    }
}

impl SecondOrder for WallContact {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for (i, ends) in self.near(state, MARGIN * self.kernel.radius) {
            let tangents = self.tangents(i, ends);
            let capsule = &self.capsules[i];
            let bodies = capsule.slopes(state).map(|slopes| (0, slopes));
            push_blocks(&bodies, &tangents, stiffness);
            capsule.push_curvature(self.forces(i, ends), state, stiffness);
        }
    }

    fn couples_by_distance(&self) -> bool {
        true
    }
}
