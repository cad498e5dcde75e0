use crate::StepLimits;
use actin_equilibrium::{ComponentStep, StepSize};

/// Largest accepted energy error of a component (kT). The energy of a mode with `kT/2` then has an error of at most
/// `2 sqrt(ENOUGH / 2)`, 1.4 % of `kT`: iterations approach a spring that is stiff compared with the friction from one
/// side. The force of a contact has an error of about a per cent.
const ENOUGH: f64 = 1e-4;

/// Predicted changes of energy (kT) below which iterations do not count as growing.
const CALM: f64 = 1e-2;

/// Number of initial iterations that may grow without added friction.
const FREE_ITERATIONS: usize = 2;

/// Factor by which added friction is increased or reduced.
const DAMPING: f64 = 4.0;

/// Least and largest added friction in units of the friction over the time step.
const LEAST_DAMPING: f64 = 0.5;
const MOST_DAMPING: f64 = 64.0;

/// Friction is added if the predicted decrease of energy grows by more than this factor.
const GROWTH: f64 = 2.0;

/// Largest accepted displacement of a solution, in units of the displacement of the first
/// iteration.
const FARTHEST: f64 = 3.0;

/// Iterations of a step, for each component.
#[derive(Clone, Debug, Default)]
pub(crate) struct Progress {
    components: Vec<Component>,
    iterations: usize,
    /// Largest displacement of the first iteration (nm).
    first: Option<f64>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Component {
    last: ComponentStep,
    /// Added friction in units of the friction over the time step.
    damping: f64,
    /// Added friction of the last iteration.
    last_damping: f64,
    /// `true` if the last two iterations had equal friction.
    is_even: bool,
    is_solved: bool,
    /// `true` if it has moved, and others have not, since the loads of its neighbours were checked.
    has_moved: bool,
}

impl Progress {
    /// Begins iterations of a step, also after a change of the components within the step.
    pub(crate) fn begin_iterations(&mut self, components: usize) {
        self.components.clear();
        self.components.resize(components, Component::default());
        self.iterations = 0;
    }

    pub(crate) fn iterations(&self) -> usize {
        self.iterations
    }

    pub(crate) fn is_solved(&self, component: usize) -> bool {
        self.components[component].is_solved
    }

    pub(crate) fn is_first(&self) -> bool {
        self.iterations == 0
    }

    /// Factor of the friction of a component in the next iteration, above 1 if iterations grow.
    pub(crate) fn friction(&self, component: usize) -> f64 {
        1.0 + self.components[component].damping
    }

    /// Limits of the next iteration.
    pub(crate) fn limits(&self, largest_turn: f64) -> StepSize {
        StepSize {
            displacement: self.first.unwrap_or(f64::INFINITY),
            rotation: largest_turn,
            strain: f64::INFINITY,
        }
    }

    /// Returns `true` if a displacement (nm) from the start of the step is too long: the iterations
    /// have then found a distant solution.
    pub(crate) fn is_far(&self, displacement: f64) -> bool {
        self.first
            .is_some_and(|first| displacement > FARTHEST * first)
    }

    /// Largest step of the last iteration.
    pub(crate) fn largest(&self) -> StepSize {
        let sizes = self.components.iter().map(|component| component.last.size);
        sizes.fold(StepSize::default(), |largest, size| StepSize {
            displacement: largest.displacement.max(size.displacement),
            rotation: largest.rotation.max(size.rotation),
            strain: largest.strain.max(size.strain),
        })
    }

    /// Components whose motion has not been checked for its effects on others.
    pub(crate) fn moved_alone(&self) -> Vec<bool> {
        let components = self.components.iter();
        components.map(|component| component.has_moved).collect()
    }

    /// Reopens selected components whose loads allow a further decrease of energy (pN nm) of more than
    /// the tolerance. Returns `true` if there are none.
    pub(crate) fn reopen(
        &mut self,
        decreases: &[f64],
        is_selected: impl Fn(usize) -> bool,
        thermal_energy: f64,
    ) -> bool {
        let components = self.components.iter_mut().zip(decreases).enumerate();
        for (c, (component, decrease)) in components {
            // Without added friction, the decrease is larger.
            let decrease = (1.0 + component.last_damping) * decrease.abs();
            // Also for NaN.
            component.is_solved &= !is_selected(c) || decrease <= ENOUGH * thermal_energy;
            component.has_moved = false;
        }
        self.components.iter().all(|component| component.is_solved)
    }

    /// Records an iteration. Returns `true` if the predicted next step of each component is within
    /// the limits, or changes the energy by less than the tolerance.
    pub(crate) fn record(
        &mut self,
        steps: &[ComponentStep],
        is_selected: impl Fn(usize) -> bool,
        limits: &StepLimits,
        thermal_energy: f64,
    ) -> bool {
        let is_first = self.is_first();
        let is_part = !(0..self.components.len()).all(&is_selected);
        let components = self.components.iter_mut().zip(steps).enumerate();
        for (_, (component, step)) in components.filter(|(c, _)| is_selected(*c)) {
            if is_first {
                component.begin(step, limits);
            } else {
                component.record(step, self.iterations, limits, thermal_energy);
            }
            component.has_moved = is_part;
        }
        let largest = self.largest().displacement;
        if self.first.is_none() && largest > 0.0 {
            self.first = Some(largest);
        }
        self.iterations += 1;
        self.components.iter().all(|component| component.is_solved)
    }
}

impl Component {
    fn begin(&mut self, step: &ComponentStep, limits: &StepLimits) {
        self.last = *step;
        self.is_even = true;
        self.is_solved = limits.hold(&step.size);
    }

    fn record(
        &mut self,
        step: &ComponentStep,
        iterations: usize,
        limits: &StepLimits,
        thermal_energy: f64,
    ) {
        // Ratios of iterations with different friction do not measure convergence.
        let ratio = if self.is_even {
            (step.decrease.abs() / self.last.decrease.abs()).min(1.0)
        } else {
            1.0
        };
        let before = self.damping;
        self.last_damping = before;
        let energy = ratio * (1.0 + before) * step.decrease.abs();
        let is_calm = energy <= CALM * thermal_energy;
        let has_grown = !is_calm && step.decrease.abs() > GROWTH * self.last.decrease.abs();
        if self.is_even && iterations >= FREE_ITERATIONS && has_grown {
            self.damping = (DAMPING * before).clamp(LEAST_DAMPING, MOST_DAMPING);
        } else if self.is_even {
            self.damping = if before > LEAST_DAMPING {
                before / DAMPING
            } else {
                0.0
            };
        }
        self.is_even = self.damping.total_cmp(&before).is_eq();
        self.last = *step;
        // Without added friction, the step is longer.
        let factor = 1.0 + before;
        let length = ratio.sqrt() * factor;
        let rest = StepSize {
            displacement: length * step.size.displacement,
            rotation: length * step.size.rotation,
            strain: 0.0,
        };
        self.is_solved = limits.hold(&rest) || energy <= ENOUGH * thermal_energy;
    }
}
