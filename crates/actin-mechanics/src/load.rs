//! A dead load: a constant force on some points.

use crate::{ControlId, Interaction, Loads, SecondOrder, State, Stiffness, Vector3};

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
    /// # Panics
    /// As [`new`](Self::new).
    pub fn at(state: &mut State, point: usize, force: Vector3) -> Self {
        Self::shared(state, &[point], force)
    }

    /// The load of `force` (lab frame) shared equally among points, with a control of its own that
    /// begins at 1.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn shared(state: &mut State, points: &[usize], force: Vector3) -> Self {
        let control = state.add_control(1.0);
        let share = 1.0 / points.len() as f64;
        let shares = points.iter().map(|&point| (point, share)).collect();
        Self::new(state, shares, force, control)
    }

    /// The load of `force` (lab frame, at control value 1) shared among points, with its zero of
    /// potential at the present positions; `control` is its factor.
    ///
    /// # Panics
    /// If `state` has no such point or control, or if the force or a share is not finite.
    pub fn new(
        state: &State,
        shares: Vec<(usize, f64)>,
        force: Vector3,
        control: ControlId,
    ) -> Self {
        let points = state.points.len();
        for &(i, share) in &shares {
            assert!(
                i < points,
                "there are {points} points, a load acts on point {i}"
            );
            assert!(
                share.is_finite(),
                "shares of a load must be finite, got {share}"
            );
        }
        assert!(
            state.controls.has(control),
            "a load has {control:?}, which the state does not have"
        );
        assert!(
            force.iter().all(|f| f.is_finite()),
            "a force must be finite, got {force:?}"
        );
        let origin = shares
            .iter()
            .map(|&(i, _)| state.points.position.get(i))
            .collect();
        Self {
            shares,
            origin,
            force,
            control,
        }
    }

    /// Its factor.
    pub fn control(&self) -> ControlId {
        self.control
    }
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
    use crate::Point;

    /// A load of its own control pulls at once, with all of its force, and beside other controls.
    #[test]
    fn a_shared_load_brings_its_control() {
        let mut state = State::default();
        for mass in [1.0, 2.0] {
            let position = Vector3::zeros();
            state.points.push(Point { position, mass });
        }
        state.add_control(7.0);
        let load = PointLoad::shared(&mut state, &[0, 1], Vector3::x() * 3.0);
        let second = state.controls.ids().nth(1).unwrap();
        assert_eq!((load.control(), state.controls[second]), (second, 1.0));
        let loads = crate::testing::loads_of(&load, &state);
        assert_eq!(loads.force.get(1), Vector3::x() * 1.5);
    }

    #[test]
    fn loads_on_what_is_not_there_are_refused() {
        let mut state = State::default();
        let (position, mass) = (Vector3::zeros(), 1.0);
        state.points.push(Point { position, mass });
        let own = state.add_control(1.0);
        let other = state.clone().add_control(1.0);
        let is_refused = |point, share, force, control| {
            let make = || PointLoad::new(&state, vec![(point, share)], force, control);
            std::panic::catch_unwind(make).is_err()
        };
        assert!(!is_refused(0, 1.0, Vector3::x(), own));
        assert!(is_refused(1, 1.0, Vector3::x(), own));
        assert!(is_refused(0, 1.0, Vector3::x(), other));
        assert!(is_refused(0, f64::NAN, Vector3::x(), own));
        assert!(is_refused(0, 1.0, Vector3::repeat(f64::INFINITY), own));
    }
}
