use super::capsule::{RepulsionError, positive};
use actin_mechanics::{Matrix3, Vector3, segments};

/// Surface that confines filaments to one side: a plane, a sphere or a cylinder of infinite length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Point of the plane, centre, or point of the axis (nm, lab frame).
    point: Vector3,
    /// Unit normal of a plane, unit axis of a cylinder, zero for a sphere.
    axis: Vector3,
    /// Radius (nm) and side of the filaments; `None` for a plane.
    round: Option<(f64, Side)>,
}

/// Side of a sphere or cylinder on which the filaments are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Side {
    /// Filaments are inside.
    Inside,
    /// Filaments are outside.
    Outside,
}

impl Wall {
    /// Creates a plane through a point (nm, lab frame). Filaments are on the side of the normal, a
    /// vector of any nonzero length.
    ///
    /// # Errors
    /// If the normal is zero, or a component is not finite.
    pub fn plane(point: Vector3, normal: Vector3) -> Result<Self, RepulsionError> {
        Ok(Self {
            point: finite(point)?,
            axis: unit("normal", normal)?,
            round: None,
        })
    }

    /// Creates a sphere with a centre and a radius (nm, lab frame).
    ///
    /// # Errors
    /// If the radius is not positive, or a number is not finite.
    pub fn sphere(centre: Vector3, radius: f64, side: Side) -> Result<Self, RepulsionError> {
        positive("radius of a wall", radius)?;
        Ok(Self {
            point: finite(centre)?,
            axis: Vector3::zeros(),
            round: Some((radius, side)),
        })
    }

    /// Creates a cylinder of infinite length with a point of its axis, the direction of its axis (any
    /// nonzero length) and a radius (nm, lab frame).
    ///
    /// # Errors
    /// If the radius is not positive, the direction is zero, or a number is not finite.
    ///
    /// ```
    /// use actin_coupling::{Vector3, repulsion::{Side, Wall}};
    /// let wall = Wall::cylinder(Vector3::zeros(), Vector3::z(), 5.0, Side::Inside)?;
    /// // The second end is 1 nm from the wall.
    /// let nearest = wall.nearest([Vector3::x(), Vector3::new(4.0, 0.0, 9.0)]);
    /// assert_eq!(nearest, (1.0, 1.0));
    /// # Ok::<(), actin_coupling::repulsion::RepulsionError>(())
    /// ```
    pub fn cylinder(
        point: Vector3,
        axis: Vector3,
        radius: f64,
        side: Side,
    ) -> Result<Self, RepulsionError> {
        positive("radius of a wall", radius)?;
        Ok(Self {
            point: finite(point)?,
            axis: unit("axis", axis)?,
            round: Some((radius, side)),
        })
    }

    /// Radius (nm) of a sphere or cylinder with filaments inside.
    pub(super) fn inner_radius(&self) -> Option<f64> {
        let inside = self.round.filter(|(_, side)| *side == Side::Inside);
        inside.map(|(radius, _)| radius)
    }

    /// Radius (nm) of a sphere or cylinder with filaments outside.
    pub(super) fn outer_radius(&self) -> Option<f64> {
        let outside = self.round.filter(|(_, side)| *side == Side::Outside);
        outside.map(|(radius, _)| radius)
    }

    /// Vector to a point from the centre of a sphere, or perpendicular from the axis of a cylinder
    /// (nm, lab frame).
    pub(super) fn arm(&self, x: Vector3) -> Vector3 {
        let arm = x - self.point;
        arm - self.axis * self.axis.dot(&arm)
    }

    /// Relative position, from 0 to 1, of the point of a line segment nearest to the wall, and its
    /// distance (nm), negative beyond the wall.
    pub fn nearest(&self, ends: [Vector3; 2]) -> (f64, f64) {
        if let Some(radius) = self.outer_radius() {
            let arms = ends.map(|x| self.arm(x));
            let (share, squared) = segments::nearest_to_point(arms, Vector3::zeros());
            return (share, squared.sqrt() - radius);
        }
        let distances = ends.map(|x| self.distance(x).0);
        if distances[0] <= distances[1] {
            (0.0, distances[0])
        } else {
            (1.0, distances[1])
        }
    }

    /// Distance of a point from the wall (nm), its gradient `g`, and the factor `c` of its second
    /// derivative `c (P - g g^T)` (1/nm) with the [`curved_directions`](Self::curved_directions)
    /// `P`. The gradient is zero at the centre or on the axis.
    pub(super) fn distance(&self, x: Vector3) -> (f64, Vector3, f64) {
        let Some((radius, side)) = self.round else {
            return ((x - self.point).dot(&self.axis), self.axis, 0.0);
        };
        let arm = self.arm(x);
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

    /// Projection on the directions across the axis of a cylinder; identity for a sphere.
    pub(super) fn curved_directions(&self) -> Matrix3 {
        Matrix3::identity() - self.axis * self.axis.transpose()
    }
}

fn finite(point: Vector3) -> Result<Vector3, RepulsionError> {
    let rule = "finite";
    match point.iter().find(|x| !x.is_finite()) {
        None => Ok(point),
        Some(&value) => Err(RepulsionError {
            key: "point of a wall",
            value,
            rule,
        }),
    }
}

fn unit(key: &'static str, direction: Vector3) -> Result<Vector3, RepulsionError> {
    // Scaling avoids overflow and underflow of the squares.
    let unit = (direction / direction.amax()).normalize();
    if unit.iter().all(|x| x.is_finite()) {
        return Ok(unit);
    }
    let (value, rule) = (direction.norm(), "finite and not zero");
    Err(RepulsionError { key, value, rule })
}
