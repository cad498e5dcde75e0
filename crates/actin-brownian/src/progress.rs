use crate::StepLimits;
use actin_equilibrium::{ComponentStep, StepSize};

/// Largest accepted energy error of a component (kT).
const ENOUGH: f64 = 1e-2;

/// As [`ENOUGH`], for components in contact in [`POLISHING`] iterations more. Forces of contacts then have errors of a
/// few per cent: a depth `p` with the force `F ~ p^4` and the energy `F p / 5`, of a tenth of kT in long steps, changes
/// the energy by `2 F p (dp/p)^2`.
const ENOUGH_IN_CONTACT: f64 = 1e-5;

/// Largest number of iterations after all components have reached [`ENOUGH`].
const POLISHING: usize = 3;

/// Changes of energy (pN nm), one per component, below which components count as solved.
pub(crate) fn tolerances(in_contact: &[bool], thermal_energy: f64) -> Vec<f64> {
    let of = |touches: &bool| if *touches { ENOUGH_IN_CONTACT } else { ENOUGH };
    in_contact
        .iter()
        .map(|touches| of(touches) * thermal_energy)
        .collect()
}

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
    /// Iterations after which all components had reached [`ENOUGH`].
    near: usize,
    /// Largest displacement of the first iteration (nm).
    first: Option<f64>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Component {
    last: ComponentStep,
    /// Added friction in units of the friction over the time step.
    damping: f64,
    /// `true` if the last two iterations had equal friction.
    is_even: bool,
    is_solved: bool,
    /// `true` if the last iteration had reached [`ENOUGH`].
    is_near: bool,
}

impl Progress {
    /// Begins iterations of a step, also after a change of the components within the step.
    pub(crate) fn begin_iterations(&mut self, components: usize) {
        self.components.clear();
        self.components.resize(components, Component::default());
        self.iterations = 0;
        self.near = 0;
    }

    /// Returns `true` if components in contact are still solved more precisely.
    pub(crate) fn is_polishing(&self) -> bool {
        self.near <= POLISHING
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

    /// Reopens solved components whose loads allow a further decrease of energy of more than a
    /// tolerance (pN nm, one per component). Returns `true` if there are none.
    pub(crate) fn reopen(&mut self, decreases: &[f64], tolerances: &[f64]) -> bool {
        let decreases = decreases.iter().zip(tolerances);
        for (component, (decrease, enough)) in self.components.iter_mut().zip(decreases) {
            // Also for NaN.
            component.is_solved &= decrease.abs() <= *enough;
        }
        self.components.iter().all(|component| component.is_solved)
    }

    /// Records an iteration. Returns `true` if the predicted next step of each component is within
    /// the limits, or changes the energy by less than its tolerance (pN nm).
    pub(crate) fn record(
        &mut self,
        steps: &[ComponentStep],
        is_selected: impl Fn(usize) -> bool,
        limits: &StepLimits,
        (tolerances, thermal_energy): (&[f64], f64),
    ) -> bool {
        let is_first = self.is_first();
        let components = self.components.iter_mut().zip(steps).enumerate();
        for (c, (component, step)) in components.filter(|(c, _)| is_selected(*c)) {
            if is_first {
                component.begin(step, limits);
            } else {
                let enough = [tolerances[c], ENOUGH * thermal_energy];
                component.record(step, self.iterations, limits, enough);
            }
        }
        let largest = self.largest().displacement;
        if self.first.is_none() && largest > 0.0 {
            self.first = Some(largest);
        }
        self.iterations += 1;
        let is_near = self.components.iter().all(|component| component.is_near);
        self.near += usize::from(is_near);
        self.components.iter().all(|component| component.is_solved)
    }
}

impl Component {
    fn begin(&mut self, step: &ComponentStep, limits: &StepLimits) {
        self.last = *step;
        self.is_even = true;
        self.is_solved = limits.hold(&step.size);
        self.is_near = self.is_solved;
    }

    fn record(
        &mut self,
        step: &ComponentStep,
        iterations: usize,
        limits: &StepLimits,
        [enough, near]: [f64; 2],
    ) {
        // Ratios of iterations with different friction do not measure convergence.
        let ratio = if self.is_even {
            (step.decrease.abs() / self.last.decrease.abs()).min(1.0)
        } else {
            1.0
        };
        let before = self.damping;
        let energy = ratio * (1.0 + before) * step.decrease.abs();
        let has_grown = energy > near && step.decrease.abs() > GROWTH * self.last.decrease.abs();
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
        self.is_solved = limits.hold(&rest) || energy <= enough;
        self.is_near = self.is_solved || energy <= near;
    }
}
