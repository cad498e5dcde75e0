//! A dead load: a constant force on some points.

use crate::{ControlId, Interaction, Loads, SecondOrder, State, Stiffness, Vector3};
use thiserror::Error;

/// Reason for which a load or a weight was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// A force or an acceleration with a component that is not finite.
    #[error("{key} = ({}, {}, {}): all components must be finite", .value.x, .value.y, .value.z)]
    NotFinite {
        /// `force` or `acceleration`.
        key: &'static str,
        /// The vector.
        value: Vector3,
    },
    /// A share of the load that is not finite.
    #[error("share = {0}: shares of a load must be finite")]
    Share(f64),
    /// A point that the state does not have.
    #[error("a load acts on point {point}: the state has {count} points")]
    Point {
        /// Index of the point.
        point: usize,
        /// Number of points of the state.
        count: usize,
    },
    /// A control that the state does not have.
    #[error("a load has {0:?}, which the state does not have")]
    Control(ControlId),
}

impl LoadError {
    /// Refuses a vector that is not finite; `key` is its name.
    ///
    /// # Errors
    /// A component that is infinite or NaN.
    pub fn unless_finite(key: &'static str, value: Vector3) -> Result<(), Self> {
        let is_finite = value.iter().all(|component| component.is_finite());
        is_finite
            .then_some(())
            .ok_or(Self::NotFinite { key, value })
    }
}

/// A force that keeps its direction, shared among points and scaled by a control.
#[derive(Clone, Debug, PartialEq)]
pub struct PointLoad {
    /// Points and the share of the force that each takes.
    shares: Vec<(usize, f64)>,
    /// Where each of these points has zero potential, lab frame.
    origin: Vec<Vector3>,
    /// Force at control value 1, lab frame.
    force: Vector3,
    /// The load factor.
    control: ControlId,
}

impl PointLoad {
    /// The load of `force` (lab frame) on one point, with a control of its own that begins at 1.
    ///
    /// # Errors
    /// As [`new`](Self::new); the state is then unchanged.
    pub fn at(state: &mut State, point: usize, force: Vector3) -> Result<Self, LoadError> {
        Self::shared(state, &[point], force)
    }

    /// The load of `force` (lab frame) shared equally among points, with a control of its own that
    /// begins at 1.
    ///
    /// # Errors
    /// As [`new`](Self::new); the state is then unchanged.
    pub fn shared(state: &mut State, points: &[usize], force: Vector3) -> Result<Self, LoadError> {
        let share = 1.0 / points.len() as f64;
        let shares: Vec<_> = points.iter().map(|&point| (point, share)).collect();
        check(state, &shares, force)?;
        let control = state.add_control(1.0);
        Self::new(state, shares, force, control)
    }

    /// The load of `force` (lab frame, at control value 1) shared among points, with its zero of
    /// potential at the present positions; `control` is its factor.
    ///
    /// # Errors
    /// A point or a control that `state` does not have, a force or a share that is not finite.
    pub fn new(
        state: &State,
        shares: Vec<(usize, f64)>,
        force: Vector3,
        control: ControlId,
    ) -> Result<Self, LoadError> {
        check(state, &shares, force)?;
        if !state.controls.has(control) {
            return Err(LoadError::Control(control));
        }
        let origin = shares
            .iter()
            .map(|&(i, _)| state.points.position.get(i))
            .collect();
        Ok(Self {
            shares,
            origin,
            force,
            control,
        })
    }

    /// Its factor.
    pub fn control(&self) -> ControlId {
        self.control
    }
}

/// Refuses forces and shares that are not finite, and points that the state does not have.
fn check(state: &State, shares: &[(usize, f64)], force: Vector3) -> Result<(), LoadError> {
    LoadError::unless_finite("force", force)?;
    let count = state.points.len();
    shares.iter().try_for_each(|&(point, share)| {
        if point >= count {
            return Err(LoadError::Point { point, count });
        }
        let is_finite = share.is_finite();
        is_finite.then_some(()).ok_or(LoadError::Share(share))
    })
}

impl Interaction for PointLoad {
    fn term(&self) -> &'static str {
        "load"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        let factor = state.controls[self.control];
        for &(i, share) in &self.shares {
            loads.force.add(i, self.force * (factor * share));
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn elements(&self) -> usize {
        self.shares.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        let factor = state.controls[self.control];
        for ((energy, &(i, share)), origin) in
            energies.iter_mut().zip(&self.shares).zip(&self.origin)
        {
            let displacement = state.points.position.get(i) - origin;
            *energy = -factor * share * self.force.dot(&displacement);
        }
    }
}

impl SecondOrder for PointLoad {
    /// A dead load has no stiffness.
    fn add_stiffness(&self, _state: &State, _stiffness: &mut Stiffness) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::testing::push_point;

    /// A load of its own control pulls at once, with all of its force, and beside other controls.
    #[test]
    fn a_shared_load_brings_its_control() {
        let mut state = State::default();
        for mass in [1.0, 2.0] {
            let position = Vector3::zeros();
            push_point(&mut state, position, mass);
        }
        state.add_control(7.0);
        let load = PointLoad::shared(&mut state, &[0, 1], Vector3::x() * 3.0).unwrap();
        let second = state.controls.ids().nth(1).unwrap();
        assert_eq!((load.control(), state.controls[second]), (second, 1.0));
        let loads = crate::testing::loads_of(&load, &state);
        assert_eq!(loads.force.get(1), Vector3::x() * 1.5);
    }

    #[test]
    fn loads_on_what_is_not_there_are_refused() {
        let mut state = State::default();
        let (position, mass) = (Vector3::zeros(), 1.0);
        push_point(&mut state, position, mass);
        let own = state.add_control(1.0);
        let other = state.clone().add_control(1.0);
        let refusal = |point, share, force, control| {
            PointLoad::new(&state, vec![(point, share)], force, control).err()
        };
        assert_eq!(refusal(0, 1.0, Vector3::x(), own), None);
        let count = 1;
        let missing = LoadError::Point { point: 1, count };
        assert_eq!(refusal(1, 1.0, Vector3::x(), own), Some(missing));
        let foreign = LoadError::Control(other);
        assert_eq!(refusal(0, 1.0, Vector3::x(), other), Some(foreign));
        let share = f64::INFINITY;
        let infinite = LoadError::Share(share);
        assert_eq!(refusal(0, share, Vector3::x(), own), Some(infinite));
        let before = state.clone();
        let refused = PointLoad::at(&mut state, 0, Vector3::x() * f64::NAN).unwrap_err();
        let message = "force = (NaN, NaN, NaN): all components must be finite";
        assert_eq!(refused.to_string(), message);
        assert_eq!(state, before);
    }
}
