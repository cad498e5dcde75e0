//! The search from one start.

use crate::options::Options;
use crate::problem::{Linearisation, Problem};
use crate::report::{Ending, StartReport};
use crate::step::{Room, damped_step};

/// Damping beyond which a step is too short to change a parameter.
const LARGEST_DAMPING: f64 = 1e16;
/// Damping below which a step is that of Gauss and Newton; keeps the damped matrix regular.
const SMALLEST_DAMPING: f64 = 1e-14;
/// Least part of the promised decrease that a step must bring.
const LEAST_RATIO: f64 = 1e-4;
/// Steps taken on trust where rounding hides whether chi squared falls.
const TRUSTED_STEPS: usize = 20;

/// A search: a point, its residuals and the state of the damping.
struct Descent<'a> {
    problem: &'a Problem<'a>,
    options: &'a Options,
    p: Vec<f64>,
    residuals: Vec<f64>,
    chi_squared: f64,
    /// Largest lengths of columns so far, by which steps are measured.
    scales: Vec<f64>,
    damping: f64,
    growth: f64,
    trusted: usize,
    evaluations: usize,
}

/// What came of trying steps from one linearisation.
enum Trial {
    Taken,
    Ended(Ending),
}

/// Levenberg and Marquardt's search from one start.
///
/// # Source
/// More, Lecture Notes in Mathematics 630 (1978) 105, for the scaling; Nielsen, IMM-REP-1999-05, for
/// the damping.
pub(crate) fn descend(problem: &Problem<'_>, options: &Options, start: &[f64]) -> StartReport {
    let mut search = Descent::new(problem, options, start);
    let mut iterations = 0;
    let ending = loop {
        if iterations == options.iterations {
            break Ending::Iterations;
        }
        iterations += 1;
        if let Some(ending) = search.iterate() {
            break ending;
        }
    };
    StartReport {
        start: start.to_vec(),
        chi_squared: search.chi_squared,
        ending,
        iterations,
        evaluations: search.evaluations,
        parameters: search.p,
    }
}

impl<'a> Descent<'a> {
    fn new(problem: &'a Problem<'a>, options: &'a Options, start: &[f64]) -> Self {
        let mut residuals = vec![0.0; problem.data.len()];
        Self {
            chi_squared: problem.residuals(start, &mut residuals),
            residuals,
            p: start.to_vec(),
            scales: vec![0.0; start.len()],
            damping: options.damping,
            growth: 2.0,
            trusted: 0,
            evaluations: 1,
            problem,
            options,
        }
    }

    /// One linearisation and the step that it leads to; the ending, if it is reached.
    fn iterate(&mut self) -> Option<Ending> {
        if !self.chi_squared.is_finite() {
            return Some(Ending::NotFinite);
        }
        if self.chi_squared <= self.problem.least() {
            return Some(Ending::Exact);
        }
        let derivatives = self.problem.derivatives(&self.p);
        let Some(linear) = Linearisation::new(derivatives.as_ref(), &self.residuals) else {
            return Some(Ending::NotFinite);
        };
        let free = free(self.problem, &self.p, &linear);
        let stationary = (0..self.p.len())
            .all(|j| !free[j] || linear.cosine(j, self.chi_squared).abs() <= self.options.cosine);
        if stationary {
            return Some(Ending::Stationary);
        }
        self.measure(&linear);
        let room = self.room(free);
        match self.try_steps(&linear, &room) {
            Trial::Taken => None,
            Trial::Ended(ending) => Some(ending),
        }
    }

    /// Lets the scales grow with the columns. A column that has always been zero gets some scale:
    /// it does not move anyway.
    fn measure(&mut self, linear: &Linearisation) {
        let units = self.problem.units(&self.p);
        for (j, scale) in self.scales.iter_mut().enumerate() {
            *scale = scale.max(linear.lengths[j]);
            if *scale == 0.0 {
                *scale = 1.0 / units[j];
            }
        }
    }

    fn room(&self, free: Vec<bool>) -> Room {
        let bounds = self.problem.bounds;
        let distance = |bound: fn(&crate::Bounds, usize) -> f64| {
            let to = |(j, v): (usize, &f64)| bound(bounds, j) - v;
            self.p.iter().enumerate().map(to).collect()
        };
        Room {
            down: distance(crate::Bounds::lower),
            up: distance(crate::Bounds::upper),
            free,
        }
    }

    /// Shorter and shorter steps until one is taken; or, where not even the full step promises more
    /// than rounding hides, the full step.
    fn try_steps(&mut self, linear: &Linearisation, room: &Room) -> Trial {
        let full = damped_step(linear, SMALLEST_DAMPING, &self.scales, room);
        if linear.promised(&full) <= self.problem.rounding(self.chi_squared) {
            return self.trust(room, &full);
        }
        while self.damping <= LARGEST_DAMPING {
            let step = damped_step(linear, self.damping, &self.scales, room);
            let (moved, residuals, chi_squared) = self.evaluate(room, &step);
            let ratio = (self.chi_squared - chi_squared) / linear.promised(&step);
            if ratio > LEAST_RATIO {
                self.relax(ratio);
                self.accept(moved, residuals, chi_squared);
                return Trial::Taken;
            }
            self.damping *= self.growth;
            self.growth *= 2.0;
        }
        Trial::Ended(Ending::Stalled)
    }

    /// Takes a full step though rounding hides whether chi squared falls, a few times: the
    /// derivatives still tell where the minimum is.
    fn trust(&mut self, room: &Room, step: &[f64]) -> Trial {
        let (moved, residuals, chi_squared) = self.evaluate(room, step);
        let rise = chi_squared - self.chi_squared;
        let harmless = rise <= self.problem.rounding(self.chi_squared);
        if self.trusted == TRUSTED_STEPS || !harmless {
            return Trial::Ended(Ending::RoundingFloor);
        }
        self.trusted += 1;
        self.accept(moved, residuals, chi_squared);
        Trial::Taken
    }

    /// The point after a step, its residuals and chi squared.
    fn evaluate(&mut self, room: &Room, step: &[f64]) -> (Vec<f64>, Vec<f64>, f64) {
        self.evaluations += 1;
        let moved = self.moved(room, step);
        let mut residuals = vec![0.0; self.residuals.len()];
        let chi_squared = self.problem.residuals(&moved, &mut residuals);
        (moved, residuals, chi_squared)
    }

    fn accept(&mut self, p: Vec<f64>, residuals: Vec<f64>, chi_squared: f64) {
        self.p = p;
        self.residuals = residuals;
        self.chi_squared = chi_squared;
    }

    /// The point after a step; exactly on a bound where the step ends there.
    fn moved(&self, room: &Room, step: &[f64]) -> Vec<f64> {
        let bounds = self.problem.bounds;
        let to = |(j, (p, s)): (usize, (&f64, &f64))| {
            if *s <= room.down[j] {
                bounds.lower(j)
            } else if *s >= room.up[j] {
                bounds.upper(j)
            } else {
                p + s
            }
        };
        self.p.iter().zip(step).enumerate().map(to).collect()
    }

    /// Less damping the better the last step kept its promise.
    fn relax(&mut self, ratio: f64) {
        let factor = (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(0.1, 2.0);
        self.damping = (self.damping * factor).max(SMALLEST_DAMPING);
        self.growth = 2.0;
    }
}

/// Parameters that are neither held nor pushed against a bound that they sit on.
pub(crate) fn free(problem: &Problem<'_>, p: &[f64], linear: &Linearisation) -> Vec<bool> {
    let bounds = problem.bounds;
    (0..p.len())
        .map(|j| {
            let down = p[j] <= bounds.lower(j) && linear.descent[j] < 0.0;
            let up = p[j] >= bounds.upper(j) && linear.descent[j] > 0.0;
            !(bounds.holds(j) || down || up)
        })
        .collect()
}
