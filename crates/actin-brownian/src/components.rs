use crate::Friction;
use actin_equilibrium::{ImplicitSolver, Selection};
use actin_mechanics::{Coordinates, Interaction, SecondOrder, State, Stiffness};

/// Components of coupled bodies, such as rods, and those selected for an iteration.
#[derive(Debug)]
pub(crate) struct Components {
    of_points: Vec<Option<usize>>,
    of_frames: Vec<Option<usize>>,
    /// Components of each interaction; empty for couplings by distance.
    of_interactions: Vec<Vec<usize>>,
    /// `true` for interactions that couple by distance.
    are_everywhere: Vec<bool>,
    /// Interactions whose couplings may change between steps.
    switchable: Vec<usize>,
    /// Dashpots of each component.
    pub(crate) dashpots: Vec<Vec<usize>>,
    /// Rotational friction of each component.
    pub(crate) turns: Vec<Vec<usize>>,
    selected: Subset,
    pattern: u64,
}

/// Selected components, and the parts of the matrix that belong to them.
#[derive(Debug)]
pub(crate) struct Subset {
    components: Vec<bool>,
    /// Interactions, then the friction of each component.
    parts: Vec<bool>,
}

impl Subset {
    pub(crate) fn selection(&self) -> Selection<'_> {
        Selection {
            components: &self.components,
            parts: &self.parts,
        }
    }
}

impl Components {
    pub(crate) fn new(
        solver: &ImplicitSolver,
        interactions: &[Box<dyn Interaction>],
        state: &State,
        friction: &Friction,
    ) -> Self {
        let count = solver.components();
        let of_points = solver.components_of((0..state.points.len()).map(Coordinates::Point));
        let of_frames = solver.components_of((0..state.frames.len()).map(Coordinates::Frame));
        let mut dashpots = vec![Vec::new(); count];
        for (k, dashpot) in friction.dashpots.iter().enumerate() {
            let mut of_bodies = dashpot.points().map(|(i, _)| of_points[i]);
            if let Some(c) = of_frames[dashpot.frame].or_else(|| of_bodies.find_map(|c| c)) {
                dashpots[c].push(k);
            }
        }
        let mut turns = vec![Vec::new(); count];
        for (k, turn) in friction.turns.iter().enumerate() {
            if let Some(c) = of_frames[turn.frame] {
                turns[c].push(k);
            }
        }
        let is_switchable =
            |k: &usize| blocks(interactions[*k].as_ref(), state).blocks().is_empty();
        let mut components = Self {
            of_interactions: vec![Vec::new(); interactions.len()],
            are_everywhere: interactions
                .iter()
                .map(|interaction| couples_by_distance(interaction.as_ref()))
                .collect(),
            switchable: (0..interactions.len()).filter(is_switchable).collect(),
            selected: Subset {
                parts: vec![true; interactions.len() + count],
                components: vec![true; count],
            },
            pattern: solver.patterns(),
            of_points,
            of_frames,
            dashpots,
            turns,
        };
        (0..interactions.len()).for_each(|k| components.find_couplings(k, interactions, state));
        components
    }

    /// Finds the couplings of a step at its start.
    pub(crate) fn begin_step(&mut self, interactions: &[Box<dyn Interaction>], state: &State) {
        for i in 0..self.switchable.len() {
            self.find_couplings(self.switchable[i], interactions, state);
        }
    }

    fn find_couplings(&mut self, k: usize, interactions: &[Box<dyn Interaction>], state: &State) {
        let mut own = std::mem::take(&mut self.of_interactions[k]);
        own.clear();
        if !self.are_everywhere[k] {
            let stiffness = blocks(interactions[k].as_ref(), state);
            let bodies = stiffness.all().flat_map(|&(a, b, _)| [a, b]);
            own.extend(bodies.filter_map(|body| match body {
                Coordinates::Point(i) => self.of_points[i],
                Coordinates::Frame(i) => self.of_frames[i],
            }));
            own.sort_unstable();
            own.dedup();
        }
        self.of_interactions[k] = own;
    }

    pub(crate) fn count(&self) -> usize {
        self.selected.components.len()
    }

    /// Returns `true` if the components belong to the present pattern of the matrix.
    pub(crate) fn fit(&self, solver: &ImplicitSolver) -> bool {
        self.pattern == solver.patterns()
    }

    /// Selects components for the next iteration; others are held.
    pub(crate) fn select(&mut self, components: Vec<bool>) {
        self.selected = self.subset(components);
    }

    /// Selects components and their coupled components. Couplings by distance select all components.
    pub(crate) fn select_with_neighbours(&mut self, mut components: Vec<bool>) {
        if self.are_everywhere.contains(&true) {
            components.fill(true);
        }
        let own = components.clone();
        for coupled in &self.of_interactions {
            if coupled.iter().any(|&c| own[c]) {
                for &c in coupled {
                    components[c] = true;
                }
            }
        }
        self.select(components);
    }

    /// Every subset includes interactions without couplings at the start of the step.
    fn subset(&self, components: Vec<bool>) -> Subset {
        let of_interactions = self.of_interactions.iter();
        let parts = of_interactions
            .map(|own| own.is_empty() || own.iter().any(|&c| components[c]))
            .chain(components.iter().copied())
            .collect();
        Subset { components, parts }
    }

    /// Selected components that are coupled by at least one of the interactions.
    pub(crate) fn coupled_by(&self, interactions: &[usize]) -> Subset {
        let mut components = vec![false; self.count()];
        for &k in interactions {
            if self.are_everywhere[k] {
                return self.subset(self.selected.components.clone());
            }
            for &c in &self.of_interactions[k] {
                components[c] = self.selected.components[c];
            }
        }
        self.subset(components)
    }

    /// Selection for an iteration; `None` if it contains all components.
    pub(crate) fn selection(&self) -> Option<Selection<'_>> {
        let is_all = self.selected.components.iter().all(|selected| *selected);
        (!is_all).then(|| self.selected.selection())
    }

    pub(crate) fn has_component(&self, c: usize) -> bool {
        self.selected.components[c]
    }

    pub(crate) fn has_point(&self, i: usize) -> bool {
        self.of_points[i].is_none_or(|c| self.has_component(c))
    }

    pub(crate) fn has_frame(&self, i: usize) -> bool {
        self.of_frames[i].is_none_or(|c| self.has_component(c))
    }

    pub(crate) fn has_interaction(&self, k: usize) -> bool {
        self.selected.parts[k]
    }

    /// Returns `true` if interaction `k` couples one of the components (ascending), or may do so.
    pub(crate) fn couples(&self, k: usize, components: &[usize]) -> bool {
        let mut own = self.of_interactions[k].iter();
        self.are_everywhere[k] || own.any(|c| components.binary_search(c).is_ok())
    }
}

pub(crate) fn couples_by_distance(interaction: &dyn Interaction) -> bool {
    let second_order = interaction.second_order();
    second_order.is_some_and(SecondOrder::couples_by_distance)
}

fn blocks(interaction: &dyn Interaction, state: &State) -> Stiffness {
    let mut stiffness = Stiffness::default();
    if let Some(second_order) = interaction.second_order() {
        second_order.add_stiffness(state, &mut stiffness);
    }
    stiffness
}
