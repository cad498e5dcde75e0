//! Runs of monomers.

use crate::Helix;
use actin_mechanics::{Frame, Inertia, Point, State, UnitQuaternion, Vector3};
use thiserror::Error;

/// Largest lattice index that is exact as `f64`.
const LARGEST_INDEX: i64 = 1 << 53;

/// Error of the construction of monomers.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LatticeError {
    /// The run is empty.
    #[error("a run must have at least one monomer")]
    Empty,
    /// A lattice index is not exact as `f64`.
    #[error("{count} lattice indices starting at {first}: must be between -2^53 and 2^53")]
    Index {
        /// Lattice index of the first monomer.
        first: i64,
        /// Number of monomers.
        count: usize,
    },
    /// The placement has a non-finite component.
    #[error(
        "placement with rotation {} and translation {} nm: all components must be finite",
        .0.rotation.coords.transpose(), .0.translation.transpose()
    )]
    Placement(Placement),
}

/// Rigid motion that places a filament: rotation about the origin, then translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Rotation of a filament along lab +z.
    pub rotation: UnitQuaternion,
    /// Position of arc length 0 (nm, lab frame).
    pub translation: Vector3,
}

impl Default for Placement {
    /// The axis along lab +z, arc length 0 at the origin.
    fn default() -> Self {
        Self {
            rotation: UnitQuaternion::identity(),
            translation: Vector3::zeros(),
        }
    }
}

impl Placement {
    fn is_finite(&self) -> bool {
        let rotation = self.rotation.coords.iter();
        let mut all = rotation.chain(&self.translation);
        all.all(|component| component.is_finite())
    }
}

/// Run of consecutive monomers with contiguous points and frames in a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Monomers {
    /// Point of the first monomer.
    pub first_point: usize,
    /// Frame of the first monomer.
    pub first_frame: usize,
    /// Lattice index of the first monomer.
    pub first_index: i64,
    /// Number of monomers.
    pub count: usize,
}

impl Monomers {
    pub(crate) fn push(
        helix: &Helix,
        (mass, inertia): (f64, Inertia),
        placement: &Placement,
        (first_index, count): (i64, usize),
        state: &mut State,
    ) -> Result<Self, LatticeError> {
        let last = i64::try_from(count)
            .ok()
            .and_then(|n| first_index.checked_add(n - 1));
        let is_exact = |index: i64| (-LARGEST_INDEX..=LARGEST_INDEX).contains(&index);
        if count == 0 {
            return Err(LatticeError::Empty);
        }
        if !(is_exact(first_index) && last.is_some_and(is_exact)) {
            return Err(LatticeError::Index {
                first: first_index,
                count,
            });
        }
        if !placement.is_finite() {
            return Err(LatticeError::Placement(*placement));
        }
        let monomers = Self {
            first_point: state.points.len(),
            first_frame: state.frames.len(),
            first_index,
            count,
        };
        for index in monomers.indices() {
            state.points.push(Point {
                position: placement.rotation * helix.centre(index) + placement.translation,
                mass,
            });
            state.frames.push(Frame {
                orientation: placement.rotation * helix.orientation(index),
                inertia,
            });
        }
        Ok(monomers)
    }

    /// Point of monomer `k` of the run.
    ///
    /// # Panics
    /// If the run has no monomer `k`.
    #[inline]
    pub fn point(&self, k: usize) -> usize {
        self.assert_has(k);
        self.first_point + k
    }

    /// Frame of monomer `k` of the run.
    ///
    /// # Panics
    /// If the run has no monomer `k`.
    #[inline]
    pub fn frame(&self, k: usize) -> usize {
        self.assert_has(k);
        self.first_frame + k
    }

    /// Lattice index of monomer `k` of the run.
    ///
    /// # Panics
    /// If the run has no monomer `k`.
    pub fn index(&self, k: usize) -> i64 {
        self.assert_has(k);
        self.first_index + i64::try_from(k).expect("a run is shorter than 2^63")
    }

    #[inline]
    fn assert_has(&self, k: usize) {
        let count = self.count;
        assert!(k < count, "monomer {k} of a run of {count} monomers");
    }

    /// Lattice indices of the run.
    pub fn indices(&self) -> impl ExactSizeIterator<Item = i64> + use<> {
        let run = *self;
        (0..run.count).map(move |k| run.index(k))
    }
}

#[cfg(test)]
mod tests {
    use crate::{EllipsoidModel, EllipsoidParameters, LatticeError, Placement};
    use actin_mechanics::{State, UnitQuaternion, Vector3};

    /// Beyond 2^53 neighbouring monomers would coincide.
    #[test]
    fn empty_runs_and_inexact_indices_are_refused_and_leave_the_state_alone() {
        let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
        let mut state = State::default();
        let mut build = |first, count| model.build(&mut state, &Placement::default(), first, count);
        assert_eq!(build(0, 0), Err(LatticeError::Empty));
        for (first, count) in [(i64::MIN, 1), (1 << 53, 2), (i64::MAX, 3), (0, usize::MAX)] {
            assert_eq!(
                build(first, count),
                Err(LatticeError::Index { first, count })
            );
        }
        assert!(build(1 << 53, 1).is_ok() && build(-(1 << 53), 2).is_ok());
        assert_eq!(state.points.len(), 3);
    }

    #[test]
    fn placements_that_are_not_finite_are_refused() {
        let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
        let mut state = State::default();
        let shifted = Placement {
            translation: Vector3::x() * f64::INFINITY,
            ..Placement::default()
        };
        let turned = Placement {
            rotation: UnitQuaternion::new(Vector3::x() * f64::NAN),
            ..Placement::default()
        };
        for placement in [shifted, turned] {
            let refused = model.build(&mut state, &placement, 0, 2);
            assert!(matches!(refused, Err(LatticeError::Placement(_))));
        }
        assert_eq!(state, State::default());
    }

    #[test]
    fn monomers_beyond_the_run_are_refused() {
        let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
        let mut state = State::default();
        let run = model.build(&mut state, &Placement::default(), 0, 2);
        let run = run.unwrap();
        assert_eq!((run.point(1), run.frame(1), run.index(1)), (1, 1, 1));
        assert!(std::panic::catch_unwind(|| run.point(2)).is_err());
        assert!(std::panic::catch_unwind(|| run.frame(2)).is_err());
        assert!(std::panic::catch_unwind(|| run.index(2)).is_err());
    }
}
