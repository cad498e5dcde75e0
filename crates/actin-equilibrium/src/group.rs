//! Bodies that are tied together and move as one.

use actin_mechanics::{Slider, State, Vector3};

/// The point about which a group turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pivot {
    /// A place in the lab frame.
    Lab(Vector3),
    /// The present position of a point, which may be one of the group.
    Point(usize),
}

impl Pivot {
    /// Where the pivot is.
    pub(crate) fn position(&self, state: &State) -> Vector3 {
        match *self {
            Self::Lab(position) => position,
            Self::Point(i) => state.points.position.get(i),
        }
    }
}

/// Points and frames that move as one rigid body, along and about prescribed directions only.
///
/// A point of the group goes from `x` to `p + t + exp(theta) (x - p)`, a frame from `Q` to
/// `exp(theta) Q`, with `p` the pivot, `t` a combination of `translations` and `theta` one of
/// `rotations`, all in the lab frame. Only the span of the directions matters; they are made
/// orthonormal when the group enters a [`Layout`](crate::Layout).
///
/// Whether the state holds these bodies or not makes no difference: the group says how they move.
/// A group without directions holds its bodies.
///
/// A pair at the end of a filament along z that slides along the axis has one translation:
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
    /// The point about which the group turns.
    pub pivot: Pivot,
    /// Directions along which the group moves, lab frame.
    pub translations: Vec<Vector3>,
    /// Axes about which the group turns, lab frame.
    pub rotations: Vec<Vector3>,
}

impl Group {
    /// A group that slides along one direction (lab frame) and does not turn.
    pub fn sliding(points: Vec<usize>, frames: Vec<usize>, direction: Vector3) -> Self {
        Self {
            points,
            frames,
            pivot: Pivot::Lab(Vector3::zeros()),
            translations: vec![direction],
            rotations: Vec::new(),
        }
    }

    /// The group of a sliding body.
    pub(crate) fn from_slider(slider: &Slider) -> Self {
        Self {
            translations: slider.directions.clone(),
            ..Self::sliding(slider.points.clone(), Vec::new(), Vector3::zeros())
        }
    }

    /// A group with all six freedoms of a rigid body; it turns about its first point.
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

    /// The displacement for the unknowns `step` of the group.
    pub(crate) fn displacement(&self, step: &[f64]) -> Vector3 {
        combine(&self.translations, step)
    }

    /// The rotation vector for the unknowns `step` of the group.
    pub(crate) fn rotation(&self, step: &[f64]) -> Vector3 {
        combine(&self.rotations, &step[self.translations.len()..])
    }
}

/// `sum_k a_k d_k`.
fn combine(directions: &[Vector3], amounts: &[f64]) -> Vector3 {
    directions.iter().zip(amounts).map(|(d, a)| d * *a).sum()
}

/// The directions made orthonormal, in order; `None` if they are dependent or not finite.
pub(crate) fn orthonormal(directions: &[Vector3]) -> Option<Vec<Vector3>> {
    // Below this sine of the angle to the span of the others a direction counts as dependent.
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
