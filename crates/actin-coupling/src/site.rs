//! Where on a filament a linker holds. What holds it there is in `linker.rs`.

use crate::{LinkerError, LinkerKey};
use actin_cosserat::RodLayout;
use actin_mechanics::{Coordinates, Loads, Matrix3, State, Vector3};

/// A point of a filament that follows its bodies: `r = sum_k w_k x_k + Q b`.
///
/// `x_k` are points (lab frame, nm) with weights `w_k` that sum to 1, `Q` a frame and `b` an arm
/// fixed in it (body frame, nm). On a monomer there is one point, its centre; on a rod there are
/// the two nodes of a segment, and the arm lies across the segment.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    shares: Vec<(usize, f64)>,
    frame: usize,
    arm: Vector3,
}

/// A place on a rod, as [`Site::on_rod`] takes it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RodPlace {
    /// Which segment, counted from 0.
    pub segment: usize,
    /// Share `A` of the segment's length, from 0 at its first node to 1 at its second.
    pub fraction: f64,
    /// Distance `R` from the axis (nm).
    pub radius: f64,
    /// Angle `phi` from the segment's d1 towards its d2 (rad).
    pub azimuth: f64,
}

impl Site {
    /// A site on a monomer: `r = x + Q b`, with `b = arm` fixed in its body frame (nm).
    ///
    /// # Errors
    /// An arm that is not finite.
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
            shares: vec![(point, 1.0)],
            frame,
            arm,
        })
    }

    /// A site on segment `i` of a rod:
    /// `r = (1 - A) x_i + A x_{i+1} + R Q_i (cos phi, sin phi, 0)`.
    ///
    /// # Errors
    /// A segment that the rod does not have, a fraction outside 0 to 1, a negative radius, or an
    /// azimuth that is not finite.
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
        Ok(Self {
            shares: vec![(node, 1.0 - fraction), (node + 1, fraction)],
            frame: layout.frames().start + segment,
            arm: Vector3::new(radius * cos, radius * sin, 0.0),
        })
    }

    /// The points that the site follows, each with its weight.
    pub fn shares(&self) -> &[(usize, f64)] {
        &self.shares
    }

    /// The frame that the site follows.
    pub fn frame(&self) -> usize {
        self.frame
    }

    /// The arm in axes of the frame (nm).
    pub fn arm(&self) -> Vector3 {
        self.arm
    }

    /// Where the site is (nm, lab frame).
    #[inline]
    pub fn position(&self, state: &State) -> Vector3 {
        let points = self
            .shares
            .iter()
            .map(|&(i, weight)| state.points.position.get(i) * weight);
        points.sum::<Vector3>() + state.frames.orientation.get(self.frame) * self.arm
    }

    /// Adds what a force at the site (pN, lab frame) does to the bodies: `w_k F` on each point and
    /// the couple `b x Q^T F` on the frame.
    #[inline]
    pub(crate) fn add_force(&self, force: Vector3, state: &State, loads: &mut Loads) {
        for &(i, weight) in &self.shares {
            loads.force.add(i, force * weight);
        }
        let q = state.frames.orientation.get(self.frame);
        let body = q.inverse_transform_vector(&force);
        loads.torque.add(self.frame, self.arm.cross(&body));
    }

    /// The derivative of the site's place by each coordinate that it follows.
    pub(crate) fn slopes(&self, state: &State) -> impl Iterator<Item = (Coordinates, Matrix3)> {
        let q = state.frames.orientation.get(self.frame);
        let turn = -(q.to_rotation_matrix().matrix() * self.arm.cross_matrix());
        self.shares
            .iter()
            .map(|&(i, w)| (Coordinates::Point(i), Matrix3::from_diagonal_element(w)))
            .chain([(Coordinates::Frame(self.frame), turn)])
    }

    /// Second derivative, by the turn of the frame, of the work `g . r` of a fixed vector `g` (lab
    /// frame): `(c b^T + b c^T) / 2 - (c . b) 1` with `c = Q^T g`.
    pub(crate) fn curvature_of_work(&self, g: Vector3, state: &State) -> Matrix3 {
        let q = state.frames.orientation.get(self.frame);
        let product = q.inverse_transform_vector(&g) * self.arm.transpose();
        0.5 * (product + product.transpose()) - Matrix3::from_diagonal_element(product.trace())
    }
}

/// Refuses a number that breaks its rule.
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
