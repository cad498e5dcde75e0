use crate::Friction;
use actin_equilibrium::{ImplicitSolver, Selection};
use actin_mechanics::{Coordinates, Interaction, State, Stiffness};

/// Components of coupled bodies, such as rods, and those selected for an iteration.
#[derive(Debug)]
pub(crate) struct Components {
    of_points: Vec<Option<usize>>,
    of_frames: Vec<Option<usize>>,
    /// Components of each interaction; empty for links that may change.
    of_interactions: Vec<Vec<usize>>,
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
        let of_body = |body| match body {
            Coordinates::Point(i) => of_points[i],
            Coordinates::Frame(i) => of_frames[i],
        };
        let of_interactions = interactions.iter().map(|interaction| {
            let bodies = bodies(interaction.as_ref(), state).into_iter();
            let mut components: Vec<_> = bodies.filter_map(of_body).collect();
            components.sort_unstable();
            components.dedup();
            components
        });
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
        Self {
            of_interactions: of_interactions.collect(),
            selected: Subset {
                parts: vec![true; interactions.len() + count],
                components: vec![true; count],
            },
            pattern: solver.patterns(),
            of_points,
            of_frames,
            dashpots,
            turns,
        }
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

    /// Every subset includes all links that may change.
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
            let own = &self.of_interactions[k];
            if own.is_empty() {
                return self.subset(self.selected.components.clone());
            }
            for &c in own {
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
        let own = &self.of_interactions[k];
        own.is_empty() || own.iter().any(|c| components.binary_search(c).is_ok())
    }
}

/// Bodies that the stiffness of an interaction always couples.
fn bodies(interaction: &dyn Interaction, state: &State) -> Vec<Coordinates> {
    let mut stiffness = Stiffness::default();
    if let Some(second_order) = interaction.second_order() {
        second_order.add_stiffness(state, &mut stiffness);
    }
    // Linkers between fixed sites also have chain blocks, at their sites.
    let blocks = stiffness.blocks().iter();
    blocks.flat_map(|&(a, b, _)| [a, b]).collect()
}
