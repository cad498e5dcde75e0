use crate::{LinkerError, LinkerKey};
use actin_cosserat::RodLayout;
use actin_mechanics::{Coordinates, Loads, Matrix3, State, UnitQuaternion, Vector3};

/// Material point of a filament.
///
/// ```text
/// r = sum_k w_k x_k + Q b
/// ```
///
/// `x_k` are points (nm, lab frame) with weights `w_k` that sum to 1, and `b` is an arm (nm, body
/// frame) in the frame `Q`. A site on a monomer has one point. A site on a rod has the two nodes of
/// a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    shares: [(usize, f64); 2],
    /// Number of points.
    points: usize,
    frame: usize,
    arm: Vector3,
    normal: Vector3,
}

/// Position of a site on a rod, for [`Site::on_rod`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RodPlace {
    /// Index of the segment, counted from 0.
    pub segment: usize,
    /// Relative position `A` along the segment, from 0 to 1.
    pub fraction: f64,
    /// Distance `R` from the axis (nm).
    pub radius: f64,
    /// Angle `phi` from d1 to d2 of the segment (rad).
    pub azimuth: f64,
}

/// Distance (nm) below which a place lies at a node, above the round-off of sums of lengths.
const NODE_TOLERANCE_NM: f64 = 1e-9;

impl RodPlace {
    /// Place on the axis at an arc length `s` (nm) from the start of the rod, limited to the rod.
    /// `nodes` are its [`node_positions`](RodLayout::node_positions). A node belongs to the segment
    /// before it.
    pub fn on_axis(layout: &RodLayout, nodes: &[f64], s: f64) -> Self {
        let lengths = layout.segment_lengths();
        let is_past = |end: &f64| end + NODE_TOLERANCE_NM < s;
        let segment = nodes[1..].partition_point(is_past).min(lengths.len() - 1);
        let fraction = (s - nodes[segment]) / lengths[segment];
        Self {
            segment,
            fraction: fraction.clamp(0.0, 1.0),
            ..Self::default()
        }
    }
}

impl Site {
    /// Creates a site on a monomer: `r = x + Q b` with the arm `b` (nm, body frame). Its normal is the part of the arm
    /// across the third axis, or the first axis.
    ///
    /// # Errors
    /// If the arm is not finite.
    ///
    /// ```
    /// use actin_coupling::Site;
    /// use actin_mechanics::{Frame, Inertia, Point, State, UnitQuaternion, Vector3};
    /// let mut state = State::default();
    /// let point = state.points.push(Point { position: Vector3::z() * 5.0, mass: 1.0 });
    /// let frame = state.frames.push(Frame {
    ///     orientation: UnitQuaternion::identity(),
    ///     inertia: Inertia::from_moments([1.0, 1.0, 2.0])?,
    /// });
    /// let site = Site::on_monomer(point, frame, Vector3::x() * 1.8)?;
    /// assert_eq!(site.position(&state), Vector3::new(1.8, 0.0, 5.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn on_monomer(point: usize, frame: usize, arm: Vector3) -> Result<Self, LinkerError> {
        for value in arm.iter().copied() {
            ensure(value.is_finite(), LinkerKey::Arm, value, "finite")?;
        }
        Ok(Self {
            shares: [(point, 1.0), (point, 0.0)],
            points: 1,
            frame,
            arm,
            normal: (arm - Vector3::z() * arm.z)
                .try_normalize(0.0)
                .unwrap_or_else(Vector3::x),
        })
    }

    /// Creates a site on segment `i` of a rod:
    ///
    /// ```text
    /// r = (1 - A) x_i + A x_{i+1} + R Q_i n,   n = (cos phi, sin phi, 0)
    /// ```
    ///
    /// Its normal is `n`.
    ///
    /// # Errors
    /// If the segment does not exist, the fraction is outside 0 to 1, the radius is negative, or
    /// the azimuth is not finite.
    ///
    /// # Source
    /// arXiv 2203.01284, Section 3 (`A_0`, `R`, `phi_0`).
    pub fn on_rod(layout: &RodLayout, place: RodPlace) -> Result<Self, LinkerError> {
        let RodPlace {
            segment,
            fraction,
            radius,
            azimuth,
        } = place;
        let segments = layout.segments();
        if segment >= segments {
            return Err(LinkerError::Segment { segment, segments });
        }
        let inside = (0.0..=1.0).contains(&fraction);
        ensure(inside, LinkerKey::Fraction, fraction, "from 0 to 1")?;
        let outward = radius.is_finite() && radius >= 0.0;
        ensure(
            outward,
            LinkerKey::Radius,
            radius,
            "finite and not negative",
        )?;
        ensure(azimuth.is_finite(), LinkerKey::Azimuth, azimuth, "finite")?;
        let node = layout.points().start + segment;
        let (sin, cos) = azimuth.sin_cos();
        let normal = Vector3::new(cos, sin, 0.0);
        Ok(Self {
            shares: [(node, 1.0 - fraction), (node + 1, fraction)],
            points: 2,
            frame: layout.frames().start + segment,
            arm: normal * radius,
            normal,
        })
    }

    /// Changes the normal to the direction of a vector that is not zero (body frame).
    #[must_use]
    pub fn with_normal(self, normal: Vector3) -> Self {
        Self {
            normal: normal.normalize(),
            ..self
        }
    }

    /// Direction away from the axis of the filament (unit vector, body frame).
    pub fn normal(&self) -> Vector3 {
        self.normal
    }

    /// Points with their weights.
    pub fn shares(&self) -> &[(usize, f64)] {
        &self.shares[..self.points]
    }

    /// Two points with their weights; the second weight is zero on a monomer.
    pub fn weighted_points(&self) -> [(usize, f64); 2] {
        self.shares
    }

    /// Index of the frame.
    pub fn frame(&self) -> usize {
        self.frame
    }

    /// Arm (nm, body frame).
    pub fn arm(&self) -> Vector3 {
        self.arm
    }

    /// Position (nm, lab frame).
    #[inline]
    pub fn position(&self, state: &State) -> Vector3 {
        let points = self
            .shares()
            .iter()
            .map(|&(i, weight)| state.points.position.get(i) * weight);
        points.sum::<Vector3>() + state.frames.orientation.get(self.frame) * self.arm
    }

    /// Adds the loads of a force at the site (pN, lab frame): `w_k F` on each point and the torque
    /// `b x Q^T F` on the frame.
    #[inline]
    pub(crate) fn add_force(&self, force: Vector3, state: &State, loads: &mut Loads) {
        for &(i, weight) in self.shares() {
            loads.force.add(i, force * weight);
        }
        let q = state.frames.orientation.get(self.frame);
        let body = q.inverse_transform_vector(&force);
        loads.torque.add(self.frame, self.arm.cross(&body));
    }

    /// Returns `true` if the site follows the rotation of its frame.
    pub(crate) fn has_arm(&self) -> bool {
        self.arm != Vector3::zeros()
    }

    /// Derivatives with respect to the points, and to the frame of a site with an arm.
    pub(crate) fn slopes(&self, state: &State) -> impl Iterator<Item = (Coordinates, Matrix3)> {
        let of_frame = || {
            let q = state.frames.orientation.get(self.frame);
            let turn = -(q.to_rotation_matrix().matrix() * self.arm.cross_matrix());
            (Coordinates::Frame(self.frame), turn)
        };
        self.shares()
            .iter()
            .map(|&(i, w)| (Coordinates::Point(i), Matrix3::from_diagonal_element(w)))
            .chain(self.has_arm().then(of_frame))
    }

    /// [`curvature_of_work`] of a constant vector `g` (lab frame) at the site.
    pub(crate) fn curvature_of_work(&self, g: Vector3, state: &State) -> Matrix3 {
        curvature_of_work(state.frames.orientation.get(self.frame), g, self.arm)
    }
}

/// Second derivative of the work `g . Q b` of a constant vector `g` (lab frame) with respect to the
/// rotation `Q` of a frame with the arm `b`: `(c b^T + b c^T) / 2 - (c . b) 1` with `c = Q^T g`.
pub(crate) fn curvature_of_work(q: UnitQuaternion, g: Vector3, arm: Vector3) -> Matrix3 {
    curvature_of_product(q.inverse_transform_vector(&g), arm)
}

/// Second derivative of `g . Q b` with respect to the rotation `Q` for `c = Q^T g`, see [`curvature_of_work`].
pub(crate) fn curvature_of_product(c: Vector3, b: Vector3) -> Matrix3 {
    let product = c * b.transpose();
    0.5 * (product + product.transpose()) - Matrix3::from_diagonal_element(product.trace())
}

pub(crate) fn ensure(
    holds: bool,
    key: LinkerKey,
    value: f64,
    rule: &'static str,
) -> Result<(), LinkerError> {
    if holds {
        Ok(())
    } else {
        Err(LinkerError::Parameter { key, value, rule })
    }
}
