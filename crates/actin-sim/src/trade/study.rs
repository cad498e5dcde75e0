//! Runs of a trade: reference, candidates, other loads, sampled bonds.

use super::branches::{self, Branch, OtherState};
use super::ladder::{self, Proposal};
use super::measure::Values;
use super::reference::Setup;
use super::resolution::{DRAWN, drawn, with_records_of};
use super::run::{RunResult, TrialFailure};
use super::sample::{SEEDS, Sample};
use super::{Candidate, Options, Reference, SETTLED, Trade, TradeCallbacks, TradeError, worst};
use crate::Counts;
use crate::scene::{Scene, SceneProblem, Setting};
use crate::shape::Ribbon;
use std::cell::{Cell, OnceCell};

/// Prefix of the name of the candidate with every monomer at the default step.
pub(super) const USUAL: &str = "every monomer, default step";

/// Largest relative scatter of a compared item between filaments with sampled bonds.
const MOST_SCATTER: f64 = 0.4;

/// Runs the reference and the candidates of a scene.
///
/// ```
/// use actin_sim::Scene;
/// use actin_sim::trade::{Options, TradeCallbacks, trade};
/// let scene = Scene::from_ron("Scene(
///     filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 108.0)]),
///     clamps: [Clamp(end: Start)],
///     loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
///     task: Equilibrium(),
/// )")?;
/// let trade = trade(&scene, &Options::default(), &TradeCallbacks::NONE)?;
/// assert!(trade.candidates.len() >= 8);
/// let best = trade.best.map(|best| trade.candidates[best].worst_error());
/// assert!(best.is_none_or(|error| error <= 0.02));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Invalid options, quantities without a counterpart in the scene, sections that follow a motion, a reference without a
/// result, an interruption before the end of the reference. A later interruption returns the runs so far.
pub fn trade(
    scene: &Scene,
    options: &Options,
    watch: &TradeCallbacks<'_>,
) -> Result<Trade, TradeError> {
    check(scene, options)?;
    let mut study = Study::begin(scene, options, watch)?;
    let steps = ladder::steps(&study.setup.full);
    study.run_candidates(steps);
    if scene.thermal().is_none() {
        study.run_drawn();
    }
    let resolutions = study.resolutions(scene);
    study.run_candidates(resolutions);
    if scene.thermal().is_none() {
        study.run_at_other_loads();
    }
    Ok(study.end())
}

fn check(scene: &Scene, options: &Options) -> Result<(), SceneProblem> {
    let refuse =
        |key: &str, value: f64, rule: &str| Err(SceneProblem::new(key, format!("{value:?}"), rule));
    if !(options.error > 0.0 && options.error < 1.0) {
        return refuse("error", options.error, "must be greater than 0 and below 1");
    }
    if let Some(share) = options
        .load_shares
        .iter()
        .find(|share| !(**share > 0.0 && share.is_finite()))
    {
        return refuse("loads", *share, "must be positive");
    }
    if scene
        .filaments()
        .any(|filament| filament.sections.following().is_some())
    {
        let rule = "cannot be compared: replace sections that follow a motion by explicit sections";
        return Err(SceneProblem::new(
            "filament.sections",
            "Following(..)",
            rule,
        ));
    }
    Ok(())
}

struct Study<'a> {
    setup: Setup<'a>,
    reference: Reference,
    values: Values,
    standard_errors: Vec<f64>,
    /// Number of compared records; `None` if the reference ran to its end.
    records: Option<usize>,
    bends_most: Vec<Option<f64>>,
    candidates: Vec<Candidate>,
    left_out: Vec<String>,
    scatter: Option<Vec<Option<f64>>>,
    /// Time of the reference and the candidates (s).
    ladder_s: f64,
    is_interrupted: bool,
    /// Time of all runs (s).
    spent_s: Cell<f64>,
    /// Other stable states of the reference, once searched.
    branches: OnceCell<Vec<Branch>>,
}

impl<'a> Study<'a> {
    fn begin(
        scene: &Scene,
        options: &'a Options,
        watch: &'a TradeCallbacks<'a>,
    ) -> Result<Self, TradeError> {
        let mut setup = Setup::new(scene, options, watch)?;
        let found = setup.reference()?;
        setup.measurer.set_scales(&found.sample.values);
        let is_whole = found.reference.share >= 1.0;
        let mut study = Self {
            records: (!is_whole).then_some(found.sample.last_run.records.len()),
            bends_most: bends_most(&found.sample.last_run),
            reference: found.reference,
            values: found.sample.values,
            standard_errors: found.sample.standard_errors,
            candidates: Vec::new(),
            left_out: Vec::new(),
            scatter: None,
            ladder_s: found.spent_s,
            is_interrupted: false,
            spent_s: Cell::new(found.spent_s),
            branches: OnceCell::new(),
            setup,
        };
        study.note_what_is_left_out();
        Ok(study)
    }

    fn note_what_is_left_out(&mut self) {
        if self.setup.measurer.leaves_out_azimuth() {
            let note = "directions across the axis: no load above 0.01 pN fixes them. Vectors are compared by \
                        their axial and transverse parts";
            self.left_out.push(note.to_owned());
        }
        let of = |filament: usize| match self.setup.full.fixed.len() {
            1 => String::new(),
            _ => format!("filament {filament}: "),
        };
        let fixed = self.setup.full.fixed.iter().enumerate();
        let fixed = fixed.filter_map(|(f, reason)| Some(format!("{}{}", of(f), (*reason)?)));
        self.left_out.extend(fixed);
        if let Some(seeds) = self.seeds_needed() {
            self.left_out.push(format!(
                "single runs: the table compares means and root mean squares of {SEEDS} seeds, with standard errors. \
                 Standard errors of a third of the wanted error require about {seeds} seeds"
            ));
        }
        if self.reference.share < 1.0 {
            self.left_out.push(format!(
                "records after the first {:.0} % of the motion: the reference reaches no further within the budget of {} s",
                100.0 * self.reference.share,
                self.setup.options.budget.as_secs_f64()
            ));
        }
    }

    /// Returns the number of seeds that reduces the standard errors of the reference in heat to a third of the wanted error.
    fn seeds_needed(&self) -> Option<f64> {
        self.setup.full.scene.thermal()?;
        let largest = worst(&self.reference.own_errors);
        let ratio = largest / (SETTLED * self.setup.options.error);
        Some((SEEDS as f64 * ratio * ratio).ceil().max(SEEDS as f64))
    }

    fn run(&self, what: &str, scene: &Scene) -> Result<Sample, TrialFailure> {
        let limits = self.setup.limits(self.records);
        let sample = self.setup.sample(what, scene, limits);
        if let Ok(sample) = &sample {
            self.spent_s.set(self.spent_s.get() + sample.wall_s);
        }
        sample
    }

    fn errors(&self, values: &Values) -> Vec<Option<f64>> {
        self.setup.measurer.errors(&self.values, values)
    }

    fn resolutions(&self, written: &Scene) -> Vec<Proposal> {
        let mut proposals = ladder::resolutions(
            &self.setup.full,
            &self.bends_most,
            self.setup.options.is_all,
        );
        let mut filaments = written.filaments();
        if filaments.all(|filament| filament.sections.adaptive().is_none()) {
            let scene = with_records_of(written.clone(), &self.setup.full.scene);
            if scene != self.setup.full.scene {
                let name = "as written".to_owned();
                proposals.push(Proposal { name, scene });
            }
        }
        proposals
    }

    fn run_candidates(&mut self, proposals: Vec<Proposal>) {
        for proposal in proposals {
            if (self.setup.watch.is_interrupted)() {
                self.is_interrupted = true;
                return;
            }
            let mut candidate = self.candidate(proposal);
            if candidate.name.starts_with(USUAL) && candidate.failure.is_none() {
                candidate.errors = self.drop_unsettled(&candidate.errors);
                candidate.standard_errors = vec![0.0; candidate.errors.len()];
            }
            self.ladder_s += candidate.wall_s.max(0.0);
            self.candidates.push(candidate);
        }
    }

    fn candidate(&self, Proposal { name, scene }: Proposal) -> Candidate {
        let mut candidate = Candidate {
            name,
            scene,
            counts: Counts::default(),
            wall_s: f64::NAN,
            errors: Vec::new(),
            standard_errors: Vec::new(),
            at_loads: Vec::new(),
            other_state: None,
            failure: None,
        };
        match self.run(&candidate.name, &candidate.scene) {
            Ok(sample) => {
                (candidate.counts, candidate.wall_s) = (sample.counts(), sample.wall_s);
                if sample.last_run.is_cut {
                    candidate.failure = Some("exceeds the budget".to_owned());
                } else {
                    candidate.errors = self.errors(&sample.values);
                    candidate.standard_errors = self.relative(&sample.standard_errors);
                    candidate.other_state = self.other_state(&sample.values, candidate.error());
                }
            }
            Err(failure) => candidate.failure = Some(failure.to_string()),
        }
        candidate
    }

    /// Returns the other stable state of the reference that is much closer to `values` than the reference, which differs by
    /// `error`.
    fn other_state(&self, values: &Values, error: f64) -> Option<OtherState> {
        if error <= branches::SUSPICIOUS * self.setup.options.error {
            return None;
        }
        let branches = self.branches.get_or_init(|| {
            let scene = &self.setup.full.scene;
            let limits = self.setup.limits(self.records);
            let (found, wall_s) = branches::other_states(scene, &self.setup.measurer, limits);
            self.spent_s.set(self.spent_s.get() + wall_s);
            found
        });
        branches::closest(&self.setup.measurer, branches, values, error)
    }

    /// Returns relative standard errors of the differences from the reference.
    fn relative(&self, standard_errors: &[f64]) -> Vec<f64> {
        let items = self.setup.measurer.items.iter().zip(&self.values);
        let both = standard_errors.iter().zip(&self.standard_errors);
        let all = items.zip(both);
        all.map(|((item, values), (one, other))| one.hypot(*other) / item.mean_size(values))
            .collect()
    }

    /// Excludes items that do not converge with the time step of the reference; returns the errors of the rest.
    fn drop_unsettled(&mut self, own: &[Option<f64>]) -> Vec<Option<f64>> {
        self.reference.own_errors = own.to_vec();
        let limit = SETTLED * self.setup.options.error;
        let is_done = self.leave_out(own, limit, |error| {
            format!("the reference changes by {error:.2} % between the default step and half of it")
        });
        self.reference.is_settled &= is_done;
        self.reference.own_errors.clone()
    }

    /// Excludes items with errors above `limit`; returns false, without a change, if no item would remain.
    fn leave_out(
        &mut self,
        errors: &[Option<f64>],
        limit: f64,
        why: impl Fn(f64) -> String,
    ) -> bool {
        let is_kept: Vec<bool> = errors
            .iter()
            .map(|e| e.is_some_and(|e| e <= limit))
            .collect();
        if !is_kept.iter().any(|kept| *kept) {
            return false;
        }
        for (item, error) in self.setup.measurer.items.iter().zip(errors) {
            let reason = match error {
                Some(error) if *error <= limit => continue,
                Some(error) => why(100.0 * error),
                None => "a run to compare it with has other records".to_owned(),
            };
            self.left_out.push(format!("{}: {reason}", item.name));
        }
        retain(&mut self.setup.measurer.items, &is_kept);
        retain(&mut self.values, &is_kept);
        retain(&mut self.standard_errors, &is_kept);
        retain(&mut self.reference.own_errors, &is_kept);
        for candidate in self.candidates.iter_mut().filter(|c| !c.errors.is_empty()) {
            retain(&mut candidate.errors, &is_kept);
            retain(&mut candidate.standard_errors, &is_kept);
        }
        if let Some(scatter) = &mut self.scatter {
            retain(scatter, &is_kept);
        }
        true
    }

    /// Runs candidates within the wanted error again at other loads.
    fn run_at_other_loads(&mut self) {
        for share in self.setup.options.load_shares.clone() {
            if (self.setup.watch.is_interrupted)() {
                return;
            }
            let substitute = self.reference_for_loads();
            let Some(usual) = at_load(&substitute, share) else {
                return;
            };
            let what = format!("every monomer at {share} of the loads");
            let Ok(reference) = self.run(&what, &usual) else {
                self.left_out.push(format!(
                    "{share} of the loads: the reference has no result at these loads"
                ));
                continue;
            };
            let reference = reference.values;
            for i in 0..self.candidates.len() {
                let candidate = &self.candidates[i];
                let is_slow = candidate.wall_s > self.reference.wall_s;
                let is_good =
                    candidate.failure.is_none() && candidate.error() <= self.setup.options.error;
                if !is_good || is_slow || candidate.scene == substitute {
                    continue;
                }
                let Some(scene) = at_load(&candidate.scene, share) else {
                    continue;
                };
                let what = format!("{} at {share} of the loads", candidate.name);
                let error = self.run(&what, &scene).map_or(f64::INFINITY, |sample| {
                    worst(&self.setup.measurer.errors(&reference, &sample.values))
                });
                self.candidates[i].at_loads.push((share, error));
            }
        }
    }

    /// Returns the fastest scene with every monomer and an error of at most a tenth of the wanted error, or the reference.
    fn reference_for_loads(&self) -> Scene {
        let is_as_good = |candidate: &&Candidate| {
            candidate.name.starts_with("every monomer, ")
                && candidate.failure.is_none()
                && candidate.error() <= 0.1 * self.setup.options.error
        };
        let good = self.candidates.iter().filter(is_as_good);
        let quickest = good.min_by(|a, b| a.wall_s.total_cmp(&b.wall_s));
        quickest.map_or(&self.reference.scene, |c| &c.scene).clone()
    }

    /// Runs filaments with sampled bonds and excludes items with large scatter.
    fn run_drawn(&mut self) {
        let seeds = DRAWN.1;
        let usual = self.reference_for_loads();
        if usual
            .filaments()
            .any(|filament| filament.sections.iter().any(crate::Section::is_rod))
        {
            return;
        }
        let mut all: Vec<Vec<Option<f64>>> = Vec::new();
        for seed in 1..=seeds {
            let drawn = drawn(&usual, seed);
            let Ok(sample) = self.run(&format!("sampled bonds, {seed} of {seeds}"), &drawn) else {
                return;
            };
            all.push(self.errors(&sample.values));
        }
        let of_item = |item: usize| {
            let errors: Option<Vec<f64>> = all.iter().map(|errors| errors[item]).collect();
            let errors = errors?;
            let squares = errors.iter().map(|e| e * e).sum::<f64>();
            Some((squares / errors.len() as f64).sqrt())
        };
        let scatter: Vec<Option<f64>> = (0..self.setup.measurer.items.len()).map(of_item).collect();
        self.scatter = Some(scatter.clone());
        self.leave_out(&scatter, MOST_SCATTER, |error| {
            format!("its scatter between filaments with sampled bonds is {error:.0} %, so quadrature bonds do not predict it")
        });
    }

    /// Reports a stable state of lower energy than the reference.
    fn note_lower_state(&mut self) {
        let branches = self.branches.get().into_iter().flatten();
        let energies = branches.map(|branch| branch.above_reference_pn_nm);
        let lowest = energies.fold(0.0, f64::min);
        if lowest < 0.0 {
            self.left_out.push(format!(
                "states of lower energy: a stable state lies {:.3} pN nm below the reference",
                -lowest
            ));
        }
    }

    fn end(mut self) -> Trade {
        self.note_lower_state();
        if self.is_interrupted {
            let note = "candidates after the interruption";
            self.left_out.push(note.to_owned());
        }
        let is_good = |i: &usize| {
            let candidate = &self.candidates[*i];
            candidate.failure.is_none() && candidate.worst_error() <= self.setup.options.error
        };
        let time = |i: usize| self.candidates[i].wall_s;
        let good = (0..self.candidates.len()).filter(is_good);
        let best = good.min_by(|a, b| time(*a).total_cmp(&time(*b)));
        let is_reference = |best: &usize| time(*best) < self.reference.wall_s;
        Trade {
            runs_of_reference: [self.ladder_s, self.spent_s.get()]
                .map(|s| s / self.reference.wall_s),
            options: self.setup.options.clone(),
            items: self.setup.measurer.items.clone(),
            left_out: self.left_out,
            scatter: self.scatter,
            best: best.filter(is_reference),
            reference: self.reference,
            candidates: self.candidates,
        }
    }
}

fn retain<T>(all: &mut Vec<T>, kept: &[bool]) {
    let mut kept = kept.iter();
    all.retain(|_| kept.next().is_none_or(|kept| *kept));
}

/// Returns the arc length of the largest curvature of each filament in the last record (nm).
fn bends_most(result: &RunResult) -> Vec<Option<f64>> {
    let Some(last) = result.records.last() else {
        return Vec::new();
    };
    let of = |filament: usize| {
        let ribbon = Ribbon::from_state(&result.assembly, filament, &last.state);
        let sizes = ribbon.curvatures().into_iter().map(|c| c.x.hypot(c.y));
        let places = ribbon.s_nm.iter().copied().zip(sizes);
        let most = places.max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(most.0)
    };
    (0..result.assembly.filaments.len()).map(of).collect()
}

fn at_load(scene: &Scene, share: f64) -> Option<Scene> {
    let mut scene = scene.clone();
    let mut is_loaded = !scene.loads.is_empty();
    scene.loads.iter_mut().for_each(|load| load.scale(share));
    let settings = scene.path.iter_mut().flat_map(|stage| &mut stage.set);
    for setting in settings {
        let vector = match setting {
            Setting::LoadFactor { .. } | Setting::Shear { .. } => continue,
            Setting::Shift { shift_nm: v, .. }
            | Setting::Turn { turn_deg: v, .. }
            | Setting::Anchor { shift_nm: v, .. } => v,
        };
        is_loaded = true;
        *vector = vector.map(|x| share * x);
    }
    is_loaded.then_some(scene)
}
