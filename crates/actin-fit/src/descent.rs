use crate::acceleration::{Probe, accelerated};
use crate::options::Options;
use crate::problem::{Linearisation, Problem};
use crate::search_report::{Progress, StartReport, Termination};
use crate::step::{BoundDistances, Damped, LARGEST_DAMPING, SMALLEST_DAMPING, Step};
use faer::Mat;

/// Least accepted ratio of actual to predicted decrease.
const LEAST_RATIO: f64 = 1e-4;
/// Maximum number of steps accepted while the change of chi squared is within rounding.
const TRUSTED_STEPS: usize = 20;
/// Acceleration is used if the last ratio of actual to predicted decrease was below this ...
const KEPT: f64 = 0.9;
/// ... and the step is shorter than this fraction of the undamped step.
const SHORTENED: f64 = 0.9;
/// Factors that shorten a rejected step: in the first `HALVINGS` rejections, and later.
const SHORTER: [f64; 2] = [0.5, 0.1];
const HALVINGS: usize = 8;

struct Descent<'a> {
    problem: &'a Problem<'a>,
    options: &'a Options,
    p: Vec<f64>,
    residuals: Vec<f64>,
    chi_squared: f64,
    /// Largest column norms so far, the scales of the parameters.
    scales: Vec<f64>,
    /// `None` before the first step.
    damping: Option<f64>,
    /// Ratio of actual to predicted decrease of the last step.
    kept: f64,
    trusted: usize,
    evaluations: usize,
    last: Progress,
}

enum Trial {
    Taken,
    Ended(Termination),
}

/// Levenberg-Marquardt search from one start, with step lengths of a trust region.
///
/// The first step is at most as long as the start, in the scaled norm. A rejected step is halved.
/// The damping falls if the ratio of actual to predicted decrease is above one half. Otherwise it
/// grows, to the minimum of a parabola along the last step. Steps shortened by curvature include
/// the geodesic acceleration.
///
/// # Source
/// More, Lecture Notes in Mathematics 630 (1978) 105, for scales and lengths; Nielsen,
/// IMM-REP-1999-05, for the damping; Transtrum and Sethna, arXiv 1201.5885, for the acceleration.
pub(crate) fn descend(problem: &Problem<'_>, options: &Options, start: &[f64]) -> StartReport {
    let mut search = Descent::new(problem, options, start);
    let mut iterations = 0;
    let ending = loop {
        if iterations == options.iterations {
            break Termination::Iterations;
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
        last: Progress {
            damping: search.damping.unwrap_or(0.0),
            ..search.last
        },
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
            damping: None,
            kept: 1.0,
            trusted: 0,
            evaluations: 1,
            last: Progress::default(),
            problem,
            options,
        }
    }

    fn iterate(&mut self) -> Option<Termination> {
        if !self.chi_squared.is_finite() {
            let point = largest(&self.residuals);
            return Some(Termination::NotFinite { point });
        }
        if self.chi_squared <= self.problem.least() {
            return Some(Termination::Exact);
        }
        let derivatives = self.problem.derivatives(&self.p);
        let Some(linear) = Linearisation::new(derivatives.as_ref(), &self.residuals) else {
            let point = not_finite(&derivatives);
            return Some(Termination::NotFinite { point });
        };
        let free = free(self.problem, &self.p, &linear);
        self.last.parameter = steepest(&linear, &free);
        self.last.cosine = self
            .last
            .parameter
            .map_or(0.0, |j| linear.cosine(j, self.chi_squared).abs());
        if self.last.cosine <= self.options.cosine {
            return Some(Termination::Stationary);
        }
        self.measure(&linear);
        let room = self.room(free);
        let damped = Damped {
            linear: &linear,
            scales: &self.scales.clone(),
            room: &room,
        };
        match self.try_steps(&damped, &derivatives) {
            Trial::Taken => None,
            Trial::Ended(ending) => Some(ending),
        }
    }

    fn measure(&mut self, linear: &Linearisation) {
        let units = self.problem.units(&self.p);
        for (j, scale) in self.scales.iter_mut().enumerate() {
            *scale = scale.max(linear.lengths[j]);
            if *scale == 0.0 {
                *scale = 1.0 / units[j];
            }
        }
    }

    fn room(&self, free: Vec<bool>) -> BoundDistances {
        let bounds = self.problem.bounds;
        let distance = |bound: fn(&crate::Bounds, usize) -> f64| {
            let to = |(j, v): (usize, &f64)| bound(bounds, j) - v;
            self.p.iter().enumerate().map(to).collect()
        };
        BoundDistances {
            down: distance(crate::Bounds::lower),
            up: distance(crate::Bounds::upper),
            free,
        }
    }

    /// Damping of the first step, whose length is at most `reach` times the length of the start.
    fn first(&self, damped: &Damped<'_>) -> f64 {
        let start = match damped.length(&self.p) {
            0.0 => damped.length(&self.problem.units(&self.p)),
            length => length,
        };
        damped.damping_for(self.options.reach * start, SMALLEST_DAMPING)
    }

    /// Shortens the step until it is accepted. Takes the full step if its predicted decrease is
    /// within rounding.
    fn try_steps(&mut self, damped: &Damped<'_>, derivatives: &Mat<f64>) -> Trial {
        let full = damped.step(SMALLEST_DAMPING).values;
        if damped.linear.promised(&full) <= self.problem.rounding(self.chi_squared) {
            return self.trust(damped.room, &full);
        }
        let most = damped.length(&full);
        let mut damping = self.damping.unwrap_or_else(|| self.first(damped));
        for refused in 0.. {
            let step = damped.step(damping);
            let length = damped.length(&step.values);
            if damping > LARGEST_DAMPING || self.moved(damped.room, &step.values) == self.p {
                break;
            }
            let curves = self.kept < KEPT && length < SHORTENED * most;
            let curved = if curves {
                self.accelerated(damped, derivatives, damping, &step)
            } else {
                Some(step.values.clone())
            };
            if let Some(curved) = curved {
                let (moved, residuals, chi_squared) = self.evaluate(damped.room, &curved);
                self.kept = (self.chi_squared - chi_squared) / damped.linear.promised(&step.values);
                if self.kept > LEAST_RATIO {
                    self.damping = Some(relaxed(damped, damping, length, self.kept));
                    self.accept(moved, residuals, chi_squared);
                    return Trial::Taken;
                }
            }
            let shorter = SHORTER[usize::from(refused >= HALVINGS)] * length;
            damping = damped.damping_for(shorter, damping).max(2.0 * damping);
        }
        self.damping = Some(damping);
        Trial::Ended(Termination::Stalled)
    }

    fn accelerated(
        &mut self,
        damped: &Damped<'_>,
        derivatives: &Mat<f64>,
        damping: f64,
        step: &Step,
    ) -> Option<Vec<f64>> {
        let (_, residuals, _) = self.evaluate(damped.room, &Probe::of(&step.values));
        let probe = Probe {
            before: &self.residuals,
            after: &residuals,
            derivatives,
        };
        accelerated(damped, &probe, damping, step)
    }

    /// Accepts a limited number of full steps whose effect on chi squared is within rounding, since
    /// the derivatives still point to the minimum.
    fn trust(&mut self, room: &BoundDistances, step: &[f64]) -> Trial {
        let (moved, residuals, chi_squared) = self.evaluate(room, step);
        let rise = chi_squared - self.chi_squared;
        let harmless = rise <= self.problem.rounding(self.chi_squared);
        if self.trusted == TRUSTED_STEPS || !harmless {
            return Trial::Ended(Termination::RoundingFloor);
        }
        self.trusted += 1;
        self.accept(moved, residuals, chi_squared);
        Trial::Taken
    }

    fn evaluate(&mut self, room: &BoundDistances, step: &[f64]) -> (Vec<f64>, Vec<f64>, f64) {
        self.evaluations += 1;
        let moved = self.moved(room, step);
        let mut residuals = vec![0.0; self.residuals.len()];
        let chi_squared = self.problem.residuals(&moved, &mut residuals);
        (moved, residuals, chi_squared)
    }

    fn accept(&mut self, p: Vec<f64>, residuals: Vec<f64>, chi_squared: f64) {
        let changes = self.p.iter().zip(&p).map(|(old, new)| match new.abs() {
            0.0 => f64::from(u8::from(*old != 0.0)),
            size => (new - old).abs() / size,
        });
        self.last.step = changes.fold(0.0, f64::max);
        self.p = p;
        self.residuals = residuals;
        self.chi_squared = chi_squared;
    }

    fn moved(&self, room: &BoundDistances, step: &[f64]) -> Vec<f64> {
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
}

/// Damping after an accepted step with ratio `kept` of actual to predicted decrease. Below one
/// half, a parabola along the step has its minimum at the fraction `1 / (2 - kept)` of its length.
fn relaxed(damped: &Damped<'_>, damping: f64, length: f64, kept: f64) -> f64 {
    if kept < 0.5 {
        return damped.damping_for(length / (2.0 - kept), damping);
    }
    let factor = (1.0 - (2.0 * kept - 1.0).powi(3)).clamp(0.1, 1.0);
    (damping * factor).max(SMALLEST_DAMPING)
}

fn steepest(linear: &Linearisation, free: &[bool]) -> Option<usize> {
    let of = |j: &usize| linear.descent[*j].abs();
    let candidates = (0..free.len()).filter(|&j| free[j]);
    candidates.max_by(|a, b| of(a).total_cmp(&of(b)))
}

fn largest(residuals: &[f64]) -> usize {
    let order = |a: &usize, b: &usize| residuals[*a].abs().total_cmp(&residuals[*b].abs());
    let first = residuals.iter().position(|r| !r.is_finite());
    first
        .or_else(|| (0..residuals.len()).max_by(order))
        .unwrap_or(0)
}

pub(crate) fn not_finite(derivatives: &Mat<f64>) -> usize {
    let is_bad = |i: &usize| (0..derivatives.ncols()).any(|j| !derivatives[(*i, j)].is_finite());
    (0..derivatives.nrows()).find(is_bad).unwrap_or(0)
}

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
