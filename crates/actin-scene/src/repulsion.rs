//! What a scene says of filaments that keep out of each other and out of walls, and the rules of its numbers.

use super::rules::{all_finite, positive, show};
use super::{Scene, SceneProblem};
use serde::{Deserialize, Serialize};

/// Radius (nm) within which a monomer lies: its centre is 1.8 nm from the axis, its semi-axis outward 1.9 nm.
const RADIUS_NM: f64 = 3.7;

/// Default stiffness (pN/nm): time steps become 7 % shorter, and 10 pN press two crossing filaments 0.7 nm
/// into each other.
const STIFFNESS_PN_PER_NM: f64 = 1000.0;

/// Repulsion of filaments from each other and from walls, by their axes: a surface is the same whatever
/// resolves it.
///
/// Two filaments repel each other within twice their radius, softly at first: `2 pi e d q^4` where they
/// cross at a right angle at a distance `d`, with `q = 1 - d^2/(4 R^2)` and `e` 0.27 of the stiffness. At a
/// third of the contact distance this is greatest, `0.70 k R`; a run with a record
/// that comes closer has failed, and so has one in which, at any time, two come twice as close as that: they
/// pass through each other. No step of `Equilibrium` leads there. A wall pushes
/// with `k p^3/(6 R^3)` per length where a surface is pressed into it by `p`. Drag or friction between surfaces
/// there is none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Repulsion {
    /// Whether filaments repel each other, and parts of one that are at least three segments, three rises and
    /// `pi` radii apart along it. With `false` there is a wall.
    pub filaments: bool,
    /// Radius `R` of filaments; positive. By default all of a monomer lies within it.
    pub radius_nm: f64,
    /// Stiffness `k`; positive. Two filaments that cross at a right angle are this stiff at most, and so is
    /// a stretch as long as it is thick with its axis pressed to the surface of a wall.
    pub stiffness_pn_per_nm: f64,
    /// Planes that filaments stay in front of.
    pub planes: Vec<Plane>,
    /// Spheres that filaments stay inside or outside of.
    pub spheres: Vec<Sphere>,
}

/// A plane that filaments stay in front of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// A point of it (lab frame); finite.
    pub at_nm: [f64; 3],
    /// Direction in which filaments are (lab frame); of any length but zero.
    pub normal: [f64; 3],
}

/// A sphere that filaments stay inside or outside of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Its centre (lab frame); finite.
    pub at_nm: [f64; 3],
    /// Its radius; positive, and greater than that of filaments inside.
    pub radius_nm: f64,
    /// Where filaments are.
    pub side: SphereSide,
}

/// A side of a sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum SphereSide {
    /// Within it.
    Inside,
    /// Around it.
    Outside,
}

impl Default for Repulsion {
    fn default() -> Self {
        Self {
            filaments: true,
            radius_nm: RADIUS_NM,
            stiffness_pn_per_nm: STIFFNESS_PN_PER_NM,
            planes: Vec::new(),
            spheres: Vec::new(),
        }
    }
}

impl Repulsion {
    /// Whether there is a wall.
    pub(super) fn has_walls(&self) -> bool {
        !(self.planes.is_empty() && self.spheres.is_empty())
    }

    /// Every broken rule.
    fn check(&self, note: &mut impl FnMut(Result<(), SceneProblem>)) {
        if !self.filaments && !self.has_walls() {
            let rule = "nothing is repelled: write planes or spheres, or leave repulsion out";
            note(Err(SceneProblem::new("repulsion.filaments", false, rule)));
        }
        note(positive("repulsion.radius_nm", self.radius_nm));
        let stiffness = self.stiffness_pn_per_nm;
        note(positive("repulsion.stiffness_pn_per_nm", stiffness));
        for (i, plane) in self.planes.iter().enumerate() {
            note(plane.check(&format!("repulsion.planes[{i}]")));
        }
        for (i, sphere) in self.spheres.iter().enumerate() {
            note(sphere.check(&format!("repulsion.spheres[{i}]"), self.radius_nm));
        }
    }
}

impl Plane {
    fn check(&self, key: &str) -> Result<(), SceneProblem> {
        all_finite(&format!("{key}.at_nm"), self.at_nm)?;
        let key = format!("{key}.normal");
        all_finite(&key, self.normal)?;
        if self.normal.iter().all(|n| n.abs() <= 0.0) {
            let rule = "must not be zero";
            return Err(SceneProblem::new(key, show(self.normal), rule));
        }
        Ok(())
    }
}

impl Sphere {
    fn check(&self, key: &str, of_filaments: f64) -> Result<(), SceneProblem> {
        all_finite(&format!("{key}.at_nm"), self.at_nm)?;
        let key = format!("{key}.radius_nm");
        positive(&key, self.radius_nm)?;
        if self.side == SphereSide::Inside && self.radius_nm <= of_filaments {
            let rule =
                format!("must be greater than the radius of filaments inside, {of_filaments:?}");
            return Err(SceneProblem::new(key, show(self.radius_nm), rule));
        }
        Ok(())
    }
}

/// Every broken rule of what a scene says of repulsion.
pub(super) fn check(scene: &Scene, note: &mut impl FnMut(Result<(), SceneProblem>)) {
    if let Some(repulsion) = &scene.repulsion {
        repulsion.check(note);
    }
}

impl Scene {
    /// Whether something bears loads that no clamp does.
    pub(super) fn has_walls(&self) -> bool {
        self.repulsion.as_ref().is_some_and(Repulsion::has_walls)
    }
}
