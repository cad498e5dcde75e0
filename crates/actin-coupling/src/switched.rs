use crate::{Linker, LinkerEnd, PeriodicImage, Site};
use actin_mechanics::{
    ControlId, Interaction, Loads, RandomStress, SecondOrder, State, StepStress, Stiffness, Vector3,
};
use std::sync::Arc;

/// End of a linker that can be released, and bound at one of several sites.
///
/// Two controls of the state hold the index of the site and `1` if the hand is bound.
#[derive(Clone, Debug)]
pub struct Hand {
    sites: Arc<[Site]>,
    site: ControlId,
    bound: ControlId,
}

/// Linker with one or two hands: term `linker`, one element. It exerts forces if all hands are
/// bound.
#[derive(Clone, Debug)]
pub struct SwitchedLinker {
    hand: Hand,
    other: OtherEnd,
    /// Linker at the sites of its construction.
    built: Linker,
    /// Random force on the first end in the last step (pN, lab frame).
    random: [ControlId; 3],
}

#[derive(Clone, Debug)]
enum OtherEnd {
    Fixed(LinkerEnd),
    Hand(Hand),
}

impl Hand {
    /// Creates a hand at the site `site` and adds its controls to the state.
    ///
    /// # Panics
    /// If the site does not exist.
    pub fn new(state: &mut State, sites: Arc<[Site]>, site: usize, is_bound: bool) -> Self {
        assert!(site < sites.len(), "no site {site}");
        Self {
            sites,
            bound: state.add_control(f64::from(u8::from(is_bound))),
            site: state.add_control(site as f64),
        }
    }

    /// Returns `true` if the hand is bound.
    pub fn is_bound(&self, state: &State) -> bool {
        state.controls[self.bound] > 0.0
    }

    /// Index of the present site, or of the last one of a free hand.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an index that was set as one"
    )]
    pub fn site(&self, state: &State) -> usize {
        let site = state.controls[self.site] as usize;
        site.min(self.sites.len() - 1)
    }

    /// Releases the hand.
    pub fn release(&self, state: &mut State) {
        state.controls[self.bound] = 0.0;
    }

    /// Binds the hand at a site.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn bind(&self, state: &mut State, site: usize) {
        assert!(site < self.sites.len(), "no site {site}");
        state.controls[self.bound] = 1.0;
        state.controls[self.site] = site as f64;
    }
}

impl SwitchedLinker {
    /// Creates a linker from a hand to a fixed end, with the springs and the image of `linker`,
    /// and adds the controls of its random force to the state.
    pub fn to_end(state: &mut State, hand: Hand, linker: &Linker) -> Self {
        let other = OtherEnd::Fixed(linker.end().clone());
        Self::new(state, hand, other, linker)
    }

    /// Creates a linker with two hands and the springs and the image of `linker`, and adds the
    /// controls of its random force to the state.
    pub fn between_hands(state: &mut State, [hand, other]: [Hand; 2], linker: &Linker) -> Self {
        Self::new(state, hand, OtherEnd::Hand(other), linker)
    }

    fn new(state: &mut State, hand: Hand, other: OtherEnd, linker: &Linker) -> Self {
        Self {
            hand,
            other,
            built: linker.clone(),
            random: [0.0; 3].map(|zero| state.add_control(zero)),
        }
    }

    /// Mean force on the first end in the last step (pN, lab frame): elastic minus random force.
    ///
    /// Linkers that relax within a step follow their random force. Only this difference is
    /// transmitted to the filaments.
    pub fn transmitted_force(&self, state: &State) -> Vector3 {
        let random = Vector3::from(self.random.map(|control| state.controls[control]));
        self.linker(state).force(state) - random
    }

    /// One or two hands.
    pub fn hands(&self) -> impl Iterator<Item = &Hand> {
        let other = match &self.other {
            OtherEnd::Fixed(_) => None,
            OtherEnd::Hand(hand) => Some(hand),
        };
        std::iter::once(&self.hand).chain(other)
    }

    /// Periodic image of the second end, or `None` for the end itself.
    pub fn image(&self) -> Option<&PeriodicImage> {
        self.built.image()
    }

    /// Returns `true` if all hands are bound.
    pub fn is_bound(&self, state: &State) -> bool {
        self.hands().all(|hand| hand.is_bound(state))
    }

    /// Linker at the present sites, bound or not.
    pub fn linker(&self, state: &State) -> Linker {
        self.linker_at(
            &self
                .hands()
                .map(|hand| hand.site(state))
                .collect::<Vec<_>>(),
        )
    }

    /// Linker at the given sites, one per hand.
    ///
    /// # Panics
    /// If a site does not exist.
    pub fn linker_at(&self, sites: &[usize]) -> Linker {
        let end = match &self.other {
            OtherEnd::Fixed(end) => end.clone(),
            OtherEnd::Hand(hand) => LinkerEnd::Site(hand.sites[sites[1]]),
        };
        self.built.between(self.hand.sites[sites[0]], end)
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
        self.built.components()
    }

    fn draw(&self, state: &State, thermal_energy: f64, stresses: &mut [f64]) {
        if self.is_bound(state) {
            self.linker(state).draw(state, thermal_energy, stresses);
        }
    }

    fn balance(&self, state: &State, stresses: &mut [f64]) {
        if self.is_bound(state) {
            self.linker(state).balance(state, stresses);
        }
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        if self.is_bound(state) {
            self.linker(state).add_stress_loads(state, stresses, loads);
        }
    }

    fn record(&self, stresses: &[f64], state: &mut State) {
        let random = if self.is_bound(state) {
            self.linker(state).random_force(state, stresses)
        } else {
            Vector3::zeros()
        };
        for (control, force) in self.random.into_iter().zip(&random) {
            state.controls[control] = *force;
        }
    }

    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    ) {
        if self.is_bound(state) {
            let linker = self.linker(state);
            stiffness.extend_links(|links| linker.add_stressed_stiffness(state, stress, links));
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
