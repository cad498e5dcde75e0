//! Dead load: a constant force on points.

use crate::{ControlId, Interaction, Loads, SecondOrder, State, Stiffness, Vector3};
use thiserror::Error;

/// Invalid load or weight.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// A component of a force or an acceleration is not finite.
    #[error("{key} = ({}, {}, {}): all components must be finite", .value.x, .value.y, .value.z)]
    NotFinite {
        /// `force` or `acceleration`.
        key: &'static str,
        /// The vector.
        value: Vector3,
    },
    /// A share of the load is not finite.
    #[error("share = {0}: shares of a load must be finite")]
    Share(f64),
    /// The state does not have this point.
    #[error("a load acts on point {point}: the state has {count} points")]
    Point {
        /// Index of the point.
        point: usize,
        /// Number of points of the state.
        count: usize,
    },
    /// The state does not have this control.
    #[error("a load has {0:?}, which the state does not have")]
    Control(ControlId),
}

impl LoadError {
    /// Returns an error if a component of `value` is not finite; `key` is its name in the message.
    ///
    /// # Errors
    /// If a component is infinite or NaN.
    pub fn check_finite(key: &'static str, value: Vector3) -> Result<(), Self> {
        let is_finite = value.iter().all(|component| component.is_finite());
        is_finite
            .then_some(())
            .ok_or(Self::NotFinite { key, value })
    }
}

/// A force of constant direction, distributed over points and scaled by a control.
#[derive(Clone, Debug, PartialEq)]
pub struct PointLoad {
    shares: Vec<(usize, f64)>,
    /// Reference position of each point, at zero potential (lab frame).
    origin: Vec<Vector3>,
    /// Force at control value 1 (lab frame).
    force: Vector3,
    control: ControlId,
}

impl PointLoad {
    /// Creates the load `force` (lab frame) on one point, with a new control of value 1.
    ///
    /// # Errors
    /// See [`new`](Self::new). The state is unchanged on error.
    pub fn at(state: &mut State, point: usize, force: Vector3) -> Result<Self, LoadError> {
        Self::shared(state, &[point], force)
    }

    /// Creates the load `force` (lab frame), shared equally among points, with a new control of
    /// value 1.
    ///
    /// # Errors
    /// See [`new`](Self::new). The state is unchanged on error.
    pub fn shared(state: &mut State, points: &[usize], force: Vector3) -> Result<Self, LoadError> {
        let share = 1.0 / points.len() as f64;
        let shares: Vec<_> = points.iter().map(|&point| (point, share)).collect();
        check(state, &shares, force)?;
        let control = state.add_control(1.0);
        Self::new(state, shares, force, control)
    }

    /// Creates the load `force` (lab frame, at control value 1) on points with the given shares.
    ///
    /// The present positions have zero potential. The load factor is `control`.
    ///
    /// # Errors
    /// If `state` lacks a point or the control, or if the force or a share is not finite.
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

    /// Control that is the load factor.
    pub fn control(&self) -> ControlId {
        self.control
    }
}

fn check(state: &State, shares: &[(usize, f64)], force: Vector3) -> Result<(), LoadError> {
    LoadError::check_finite("force", force)?;
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
    fn add_stiffness(&self, _state: &State, _stiffness: &mut Stiffness) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::testing::push_point;

    #[test]
    fn a_shared_load_adds_a_control() {
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
    fn loads_on_missing_points_and_controls_are_refused() {
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
