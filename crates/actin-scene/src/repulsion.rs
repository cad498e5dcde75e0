//! Repulsion of filaments from each other and from walls, and its validation.

use super::rules::{all_finite, positive, show};
use super::{Scene, SceneProblem};
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
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
}

/// Plane wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// Point of the plane (lab frame); finite.
    pub at_nm: [f64; 3],
    /// Normal of the plane towards the filaments (lab frame); any length except zero.
    pub normal: [f64; 3],
}

/// Spherical wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Centre (lab frame); finite.
    pub at_nm: [f64; 3],
    /// Radius; positive. With `Inside` it is greater than the radius of filaments.
    pub radius_nm: f64,
    /// Side of the sphere on which the filaments are.
    pub side: SphereSide,
}

/// Side of a sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum SphereSide {
    /// Filaments are inside the sphere.
    Inside,
    /// Filaments are outside the sphere.
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
    pub(super) fn has_walls(&self) -> bool {
        !(self.planes.is_empty() && self.spheres.is_empty())
    }

    /// Distance (nm) of axes below which filaments repel each other, or 0.
    pub(super) fn contact_nm(&self) -> f64 {
        if self.filaments {
            2.0 * self.radius_nm
        } else {
            0.0
        }
    }

    fn check(&self, note: &mut impl FnMut(Result<(), SceneProblem>)) {
        if !self.filaments && !self.has_walls() {
            let rule = "repulsion has no effect: write planes or spheres, or omit this key";
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

pub(super) fn check(scene: &Scene, note: &mut impl FnMut(Result<(), SceneProblem>)) {
    if let Some(repulsion) = &scene.repulsion {
        repulsion.check(note);
    }
}

impl Scene {
    /// Returns whether the scene has walls, which can resist loads.
    pub(super) fn has_walls(&self) -> bool {
        self.repulsion.as_ref().is_some_and(Repulsion::has_walls)
    }
}
