use crate::Site;
use actin_mechanics::{
    ControlId, Coordinates, Interaction, LoadError, Loads, SecondOrder, State, Stiffness,
    UnitQuaternion, Vector3,
};

/// Direction of a force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceKind {
    /// Constant direction in the lab frame, with the potential `-F . u` of the displacement `u`.
    Dead,
    /// Direction fixed in the frame of the site, without a potential.
    Follower,
}

/// Force at sites, scaled by a control: one element per site.
///
/// The force on a site is `force` times its weight. Weights are fractions of a force, or lengths
/// for a force per length.
#[derive(Clone, Debug, PartialEq)]
pub struct SiteForce {
    /// Sites with weight, initial position and initial orientation of the frame.
    sites: Vec<(Site, f64, Vector3, UnitQuaternion)>,
    /// Force at control value 1 and weight 1 (pN, lab frame).
    force: Vector3,
    kind: ForceKind,
    control: ControlId,
}

impl SiteForce {
    /// Creates a force (pN, lab frame) on sites at their current positions, with a weight each.
    /// `control` is the factor of the force.
    ///
    /// ```
    /// use actin_coupling::{ForceKind, Interaction, RodPlace, Site, SiteForce, State, StraightRod};
    /// use actin_coupling::{Loads, Vector3};
    /// let mut state = State::default();
    /// let rod = StraightRod::uniform(2, 10.0).push(&mut state)?;
    /// let site = Site::on_rod(&rod, RodPlace { segment: 1, fraction: 0.25, ..RodPlace::default() })?;
    /// let factor = state.add_control(1.0);
    /// let force = Vector3::x() * 4.0;
    /// let load = SiteForce::new(&state, vec![(site, 1.0)], force, ForceKind::Dead, factor)?;
    /// let mut loads = Loads::zeros(&state);
    /// load.add_loads(&state, &mut loads);
    /// assert_eq!([1, 2].map(|i| loads.force.get(i).x), [3.0, 1.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the control does not exist, or the force or a weight is not finite.
    ///
    /// # Panics
    /// If a body of a site does not exist.
    pub fn new(
        state: &State,
        sites: Vec<(Site, f64)>,
        force: Vector3,
        kind: ForceKind,
        control: ControlId,
    ) -> Result<Self, LoadError> {
        if !state.controls.has(control) {
            return Err(LoadError::Control(control));
        }
        LoadError::check_finite("force", force)?;
        if let Some(&(_, weight)) = sites.iter().find(|(_, weight)| !weight.is_finite()) {
            return Err(LoadError::Share(weight));
        }
        let begin = |(site, weight): (Site, f64)| {
            let place = site.position(state);
            let rest = state.frames.orientation.get(site.frame());
            (site, weight, place, rest)
        };
        Ok(Self {
            sites: sites.into_iter().map(begin).collect(),
            force,
            kind,
            control,
        })
    }

    /// Force on a site (pN, lab frame); `rest` is the initial orientation of its frame.
    fn force_on(&self, site: &Site, rest: UnitQuaternion, state: &State) -> Vector3 {
        let force = self.force * state.controls[self.control];
        match self.kind {
            ForceKind::Dead => force,
            ForceKind::Follower => {
                let now = state.frames.orientation.get(site.frame());
                now * rest.inverse_transform_vector(&force)
            }
        }
    }
}

impl Interaction for SiteForce {
    fn term(&self) -> &'static str {
        "load"
    }

    fn is_conservative(&self) -> bool {
        self.kind == ForceKind::Dead
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for (site, weight, _, rest) in &self.sites {
            let force = self.force_on(site, *rest, state) * *weight;
            site.add_force(force, state, loads);
        }
    }

    fn elements(&self) -> usize {
        self.sites.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        energies.fill(0.0);
        if !self.is_conservative() {
            return;
        }
        for (energy, (site, weight, place, rest)) in energies.iter_mut().zip(&self.sites) {
            let displacement = site.position(state) - place;
            *energy = -weight * self.force_on(site, *rest, state).dot(&displacement);
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        self.is_conservative().then_some(self as &dyn SecondOrder)
    }
}

impl SecondOrder for SiteForce {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for (site, weight, _, rest) in &self.sites {
            if site.arm() == Vector3::zeros() {
                continue;
            }
            let work = self.force_on(site, *rest, state) * -*weight;
            let frame = Coordinates::Frame(site.frame());
            stiffness.push(frame, frame, site.curvature_of_work(work, state));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RodPlace, StraightRod};
    use actin_mechanics::testing::{
        assert_is_gradient, assert_is_stiffness, loads_of, move_rigidly, resultant,
    };
    use actin_mechanics::{Xorshift, perturb};

    fn loaded(kind: ForceKind) -> (State, SiteForce) {
        let mut state = State::default();
        let rod = StraightRod::uniform(3, 10.0).push(&mut state).unwrap();
        let control = state.add_control(1.5);
        let site = |segment, radius| {
            let place = RodPlace {
                segment,
                fraction: 0.3,
                radius,
                azimuth: 0.4,
            };
            Site::on_rod(&rod, place).unwrap()
        };
        let sites = vec![(site(0, 1.8), 2.0), (site(2, 0.0), 0.5)];
        let force = Vector3::new(0.4, -1.0, 2.0);
        let load = SiteForce::new(&state, sites, force, kind, control).unwrap();
        perturb(&mut state, &mut Xorshift::new(2), 0.5, 0.3);
        (state, load)
    }

    #[test]
    fn dead_forces_have_a_potential() {
        let (state, load) = loaded(ForceKind::Dead);
        assert_is_gradient(&load, &state, 1e-2, 1e-10);
        assert_is_stiffness(&load, &state, 1e-2, 1e-9);
        let (force, _) = resultant(&state, &loads_of(&load, &state));
        let expected = Vector3::new(0.4, -1.0, 2.0) * 1.5 * 2.5;
        assert!((force - expected).norm() < 1e-14);
    }

    #[test]
    fn followers_turn_along() {
        let (mut state, load) = loaded(ForceKind::Follower);
        let (before, torque) = resultant(&state, &loads_of(&load, &state));
        let turn = Vector3::new(0.5, -2.0, 0.3);
        move_rigidly(&mut state, turn, Vector3::zeros());
        let (after, turned) = resultant(&state, &loads_of(&load, &state));
        let expected = actin_mechanics::rotation::exp(turn) * before;
        assert!((after - expected).norm() < 1e-13);
        let expected = actin_mechanics::rotation::exp(turn) * torque;
        assert!((turned - expected).norm() < 1e-12);
        assert!(!load.is_conservative() && load.second_order().is_none());
        assert!(load.energy(&state).abs() <= 0.0);
    }
}
