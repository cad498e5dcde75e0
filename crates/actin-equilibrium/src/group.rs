//! Groups of bodies.

use actin_mechanics::{Slider, State, Vector3};

/// Centre of rotation of a group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pivot {
    /// Position in the lab frame (nm).
    Lab(Vector3),
    /// Current position of a point, which may belong to the group.
    Point(usize),
}

impl Pivot {
    pub(crate) fn position(&self, state: &State) -> Vector3 {
        match *self {
            Self::Lab(position) => position,
            Self::Point(i) => state.points.position.get(i),
        }
    }
}

/// Points and frames that move as one rigid body along and about prescribed directions.
///
/// ```text
/// x -> p + t + exp(theta) (x - p),   Q -> exp(theta) Q
///
/// p       pivot (nm)
/// t       linear combination of `translations` (nm)
/// theta   linear combination of `rotations` (rad)
/// ```
///
/// All vectors are in the lab frame. Only the span of the directions matters; a
/// [`Layout`](crate::Layout) orthonormalises them. The bodies of a group move even if the
/// state holds them. A group without directions is held.
///
/// Last pair of a filament along z that slides along the axis:
///
/// ```
/// use actin_equilibrium::Group;
/// use actin_mechanics::Vector3;
/// let pair = Group::sliding(vec![28, 29], vec![28, 29], Vector3::z());
/// assert_eq!(pair.unknowns(), 1);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Points of the group.
    pub points: Vec<usize>,
    /// Frames of the group.
    pub frames: Vec<usize>,
    /// Centre of rotation.
    pub pivot: Pivot,
    /// Directions of translation (lab frame).
    pub translations: Vec<Vector3>,
    /// Axes of rotation (lab frame).
    pub rotations: Vec<Vector3>,
}

impl Group {
    /// Group that slides along one direction (lab frame) without rotation.
    pub fn sliding(points: Vec<usize>, frames: Vec<usize>, direction: Vector3) -> Self {
        Self {
            points,
            frames,
            pivot: Pivot::Lab(Vector3::zeros()),
            translations: vec![direction],
            rotations: Vec::new(),
        }
    }

    pub(crate) fn from_slider(slider: &Slider) -> Self {
        Self {
            translations: slider.directions.clone(),
            ..Self::sliding(slider.points.clone(), Vec::new(), Vector3::zeros())
        }
    }

    /// Group with six degrees of freedom, which rotates about its first point.
    pub fn rigid(points: Vec<usize>, frames: Vec<usize>) -> Self {
        let axes = vec![Vector3::x(), Vector3::y(), Vector3::z()];
        let pivot = points
            .first()
            .map_or(Pivot::Lab(Vector3::zeros()), |&i| Pivot::Point(i));
        Self {
            points,
            frames,
            pivot,
            translations: axes.clone(),
            rotations: axes,
        }
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.translations.len() + self.rotations.len()
    }

    pub(crate) fn displacement(&self, step: &[f64]) -> Vector3 {
        combine(&self.translations, step)
    }

    pub(crate) fn rotation(&self, step: &[f64]) -> Vector3 {
        combine(&self.rotations, &step[self.translations.len()..])
    }
}

fn combine(directions: &[Vector3], amounts: &[f64]) -> Vector3 {
    directions.iter().zip(amounts).map(|(d, a)| d * *a).sum()
}

/// `None` if linearly dependent or not finite.
pub(crate) fn orthonormal(directions: &[Vector3]) -> Option<Vec<Vector3>> {
    // Sine of the angle to the span of the others below which a direction is dependent.
    const SMALLEST_SINE: f64 = 1e-6;
    let mut basis: Vec<Vector3> = Vec::with_capacity(directions.len());
    for direction in directions {
        let length = direction.norm();
        if !(length.is_finite() && length > 0.0) {
            return None;
        }
        let mut rest = direction / length;
        for b in &basis {
            rest -= b * b.dot(&rest);
        }
        let sine = rest.norm();
        if sine < SMALLEST_SINE {
            return None;
        }
        basis.push(rest / sine);
    }
    Some(basis)
}
