//! Repulsion of filaments from each other and from walls, and its validation.

use super::problem::Problems;
use super::rules::show;
use super::{Scene, SceneProblem, unit_vector};
use actin_coupling::repulsion::{RepulsionError, Side, Wall};
use actin_mechanics::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Radius (nm) that contains a monomer: centre at 1.8 nm, radial semi-axis 1.9 nm.
const RADIUS_NM: f64 = 3.7;

/// Default stiffness (pN/nm). Time steps become 7 % shorter; two crossing filaments overlap by 0.7 nm at 10 pN.
const STIFFNESS_PN_PER_NM: f64 = 1000.0;

/// Repulsion of filaments from each other and from walls. It depends on the axes of filaments, not on their
/// resolution. There is no friction between surfaces.
///
/// Filaments repel each other at distances below `2 R`. At a distance `d`, two filaments that cross at a right
/// angle repel each other with the force `2 pi e d q^4`, where `q = 1 - d^2/(4 R^2)` and `e = 0.27 k`. The
/// force is largest, `0.70 k R`, at `d = 2 R/3`. A run fails if two filaments are closer than this in a record,
/// or closer than half of it at any time: they would pass through each other. `Equilibrium` rejects such steps.
/// A wall exerts the force per length `k p^3/(6 R^3)` on a filament whose surface penetrates it by `p`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Repulsion {
    /// True if filaments repel each other. Parts of the same filament repel each other if their distance along
    /// it is at least three segments, three rises and `pi R`. `false` requires a wall.
    pub filaments: bool,
    /// Radius `R` of filaments; positive. The default radius contains the monomers.
    pub radius_nm: f64,
    /// Stiffness `k`; positive. It is the largest stiffness of two filaments that cross at a right angle, and
    /// the stiffness of a piece of filament of length `2 R` with its axis on the surface of a wall.
    pub stiffness_pn_per_nm: f64,
    /// Plane walls.
    pub planes: Vec<Plane>,
    /// Spherical walls.
    pub spheres: Vec<Sphere>,
    /// Cylindrical walls.
    pub cylinders: Vec<Cylinder>,
    /// Boxes around the filaments.
    pub cuboids: Vec<Cuboid>,
}

/// Plane wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Plane {
    /// Point of the plane (lab frame); finite.
    pub at_nm: [f64; 3],
    /// Normal of the plane towards the filaments (lab frame); any length except zero.
    pub normal: [f64; 3],
}

/// Spherical wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Sphere {
    /// Centre (lab frame); finite.
    pub at_nm: [f64; 3],
    /// Radius; positive. With `Inside` it is greater than the radius of filaments.
    pub radius_nm: f64,
    /// Side of the sphere on which the filaments are.
    pub side: Side,
}

/// Cylindrical wall of infinite length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Cylinder {
    /// Point of the axis (lab frame); finite.
    pub at_nm: [f64; 3],
    /// Direction of the axis (lab frame); any length except zero.
    pub axis: [f64; 3],
    /// Radius; positive. With `Inside` it is greater than the radius of filaments.
    pub radius_nm: f64,
    /// Side of the cylinder on which the filaments are.
    pub side: Side,
}

/// Box of six plane walls around the filaments.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Cuboid {
    /// Centre (lab frame); finite.
    pub at_nm: [f64; 3],
    /// Edges along x, y and z; greater than the diameter of filaments.
    pub size_nm: [f64; 3],
}

/// Shape of a wall and its index in the list of this shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct WallName {
    /// Name of the shape, such as `plane`.
    pub shape: &'static str,
    /// Index in the list of this shape.
    pub index: usize,
}

impl WallName {
    /// Key of the wall in a scene, such as `repulsion.planes[0]`.
    pub fn key(self) -> String {
        format!("repulsion.{}s[{}]", self.shape, self.index)
    }
}

impl Default for Repulsion {
    fn default() -> Self {
        Self {
            filaments: true,
            radius_nm: RADIUS_NM,
            stiffness_pn_per_nm: STIFFNESS_PN_PER_NM,
            planes: Vec::new(),
            spheres: Vec::new(),
            cylinders: Vec::new(),
            cuboids: Vec::new(),
        }
    }
}

impl Repulsion {
    pub(super) fn has_walls(&self) -> bool {
        !(self.planes.is_empty()
            && self.spheres.is_empty()
            && self.cylinders.is_empty()
            && self.cuboids.is_empty())
    }

    /// Returns all walls in the order of shapes and indices. A cuboid has six.
    ///
    /// # Errors
    /// If a number is out of its range. Scenes that are read have no such walls.
    pub fn walls(&self) -> Result<Vec<(WallName, Wall)>, RepulsionError> {
        let planes = named("plane", self.planes.iter().map(|one| [one.wall()]));
        let spheres = named("sphere", self.spheres.iter().map(|one| [one.wall()]));
        let cylinders = named("cylinder", self.cylinders.iter().map(|one| [one.wall()]));
        let cuboids = named("cuboid", self.cuboids.iter().map(Cuboid::walls));
        planes
            .chain(spheres)
            .chain(cylinders)
            .chain(cuboids)
            .collect()
    }

    /// Places (nm) of the planes normal to an axis between which filaments are; infinite without planes.
    pub(super) fn layer(&self, axis: usize) -> [f64; 2] {
        let facing = |sign: f64| {
            let planes = self.planes.iter();
            let planes = planes.filter(move |plane| sign * unit_vector(plane.normal)[axis] > 0.5);
            planes.map(move |plane| plane.at_nm[axis])
        };
        [
            facing(1.0).fold(f64::NEG_INFINITY, f64::max),
            facing(-1.0).fold(f64::INFINITY, f64::min),
        ]
    }

    /// Distance (nm) of axes below which filaments repel each other, or 0.
    pub(super) fn contact_nm(&self) -> f64 {
        if self.filaments {
            2.0 * self.radius_nm
        } else {
            0.0
        }
    }

    /// Checks the rules of walls, whose numbers must be valid.
    pub(super) fn check(&self, problems: &mut Problems) {
        if !self.filaments && !self.has_walls() {
            let rule = "repulsion has no effect: write planes, spheres, cylinders or cuboids, or omit this key";
            let problem = SceneProblem::new("repulsion.filaments", false, rule);
            problems.note(Err(problem));
        }
        if !self.radius_nm.is_finite() {
            return;
        }
        let spheres = self.spheres.iter().map(|one| (one.radius_nm, one.side));
        let cylinders = self.cylinders.iter().map(|one| (one.radius_nm, one.side));
        let round = (spheres.enumerate().map(|(i, one)| ("sphere", i, one)))
            .chain(cylinders.enumerate().map(|(i, one)| ("cylinder", i, one)));
        for (shape, index, (radius_nm, side)) in round {
            let key = WallName { shape, index }.key();
            problems.check(&key, || self.check_radius(&key, radius_nm, side));
        }
        for (index, cuboid) in self.cuboids.iter().enumerate() {
            let shape = "cuboid";
            let key = WallName { shape, index }.key();
            problems.check(&key, || self.check_edges(&key, cuboid));
        }
    }

    /// Checks the radius of a round wall, which contains filaments inside.
    fn check_radius(&self, key: &str, radius_nm: f64, side: Side) -> Result<(), SceneProblem> {
        let radius = self.radius_nm;
        if side == Side::Outside || radius_nm > radius {
            return Ok(());
        }
        let rule = format!("must be greater than the radius of filaments inside, {radius:?}");
        let key = format!("{key}.radius_nm");
        Err(SceneProblem::new(key, show(radius_nm), rule))
    }

    fn check_edges(&self, key: &str, cuboid: &Cuboid) -> Result<(), SceneProblem> {
        let diameter = 2.0 * self.radius_nm;
        if cuboid.size_nm.iter().all(|edge| *edge > diameter) {
            return Ok(());
        }
        let rule = format!("each must be greater than the diameter of filaments, {diameter:?}");
        let key = format!("{key}.size_nm");
        Err(SceneProblem::new(key, show(cuboid.size_nm), rule))
    }
}

fn named<const N: usize>(
    shape: &'static str,
    walls: impl Iterator<Item = [Result<Wall, RepulsionError>; N]>,
) -> impl Iterator<Item = Result<(WallName, Wall), RepulsionError>> {
    walls.enumerate().flat_map(move |(index, walls)| {
        let name = WallName { shape, index };
        walls.map(|wall| Ok((name, wall?)))
    })
}

impl Plane {
    fn wall(&self) -> Result<Wall, RepulsionError> {
        Wall::plane(self.at_nm.into(), self.normal.into())
    }
}

impl Sphere {
    fn wall(&self) -> Result<Wall, RepulsionError> {
        Wall::sphere(self.at_nm.into(), self.radius_nm, self.side)
    }
}

impl Cylinder {
    fn wall(&self) -> Result<Wall, RepulsionError> {
        Wall::cylinder(
            self.at_nm.into(),
            self.axis.into(),
            self.radius_nm,
            self.side,
        )
    }
}

impl Cuboid {
    fn walls(&self) -> [Result<Wall, RepulsionError>; 6] {
        let centre = Vector3::from(self.at_nm);
        [0, 1, 2, 3, 4, 5].map(|face| {
            let outward = Vector3::ith(face / 2, if face % 2 == 0 { -1.0 } else { 1.0 });
            Wall::plane(centre + outward * (0.5 * self.size_nm[face / 2]), -outward)
        })
    }
}

impl Scene {
    /// Returns whether the scene has walls, which can resist loads.
    pub(super) fn has_walls(&self) -> bool {
        self.repulsion.as_ref().is_some_and(Repulsion::has_walls)
    }
}
