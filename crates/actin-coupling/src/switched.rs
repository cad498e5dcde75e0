use crate::Linker;
use actin_mechanics::{ControlId, Interaction, Loads, RandomStress, SecondOrder, State, Stiffness};

/// Linker that can be released, and bound at one of several places: term `linker`, one element.
///
/// Two controls of the state hold the current place and whether the linker is bound.
#[derive(Clone, Debug)]
pub struct SwitchedLinker {
    places: Vec<Linker>,
    bound: ControlId,
    place: ControlId,
}

impl SwitchedLinker {
    /// Creates a linker at the first place and adds its controls to the state.
    ///
    /// # Panics
    /// If `places` is empty.
    pub fn new(state: &mut State, places: Vec<Linker>, is_bound: bool) -> Self {
        assert!(!places.is_empty(), "a linker needs at least one place");
        Self {
            places,
            bound: state.add_control(f64::from(u8::from(is_bound))),
            place: state.add_control(0.0),
        }
    }

    /// Linkers of all places.
    pub fn places(&self) -> &[Linker] {
        &self.places
    }

    /// Returns `true` if the linker is bound.
    pub fn is_bound(&self, state: &State) -> bool {
        state.controls[self.bound] > 0.0
    }

    /// Index of the current place.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an index that was set as one"
    )]
    pub fn place(&self, state: &State) -> usize {
        let place = state.controls[self.place] as usize;
        place.min(self.places.len() - 1)
    }

    /// Linker at the current place, bound or not.
    pub fn linker(&self, state: &State) -> &Linker {
        &self.places[self.place(state)]
    }

    /// Releases the linker.
    pub fn release(&self, state: &mut State) {
        state.controls[self.bound] = 0.0;
    }

    /// Binds the linker at a place.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn bind(&self, state: &mut State, place: usize) {
        assert!(place < self.places.len(), "no place {place}");
        state.controls[self.bound] = 1.0;
        state.controls[self.place] = place as f64;
    }
}

impl Interaction for SwitchedLinker {
    fn term(&self) -> &'static str {
        "linker"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        if self.is_bound(state) {
            self.linker(state).add_loads(state, loads);
        }
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        if self.is_bound(state) {
            self.linker(state).write_energies(state, energies);
        } else {
            energies.fill(0.0);
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn random_stress(&self) -> Option<&dyn RandomStress> {
        Some(self)
    }
}

impl RandomStress for SwitchedLinker {
    fn components(&self) -> usize {
        self.places[0].components()
    }

    fn draw(&self, state: &State, thermal_energy: f64, stresses: &mut [f64]) {
        self.linker(state).draw(state, thermal_energy, stresses);
    }

    fn balance(&self, state: &State, stresses: &mut [f64]) {
        self.linker(state).balance(state, stresses);
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        if self.is_bound(state) {
            self.linker(state).add_stress_loads(state, stresses, loads);
        }
    }

    fn add_stress_stiffness(&self, state: &State, stresses: &[f64], stiffness: &mut Stiffness) {
        if self.is_bound(state) {
            let linker = self.linker(state);
            stiffness.extend_links(|links| linker.add_stress_stiffness(state, stresses, links));
        }
    }

    fn add_convexity(&self, state: &State, is_wanted: bool, stiffness: &mut Stiffness) {
        if self.is_bound(state) {
            let linker = self.linker(state);
            stiffness.extend_links(|links| linker.add_convexity(state, is_wanted, links));
        }
    }
}

impl SecondOrder for SwitchedLinker {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        if self.is_bound(state) {
            stiffness.extend_links(|links| self.linker(state).add_stiffness(state, links));
        }
    }
}
