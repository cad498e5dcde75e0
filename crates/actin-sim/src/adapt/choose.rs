//! The sections that a wanted accuracy needs.

use super::cells::Cells;
use super::setting::{Lengths, Setting};
use super::{
    Chosen, ErrorEstimate, Located, MISSED, Tried, at_rest, check, equilibrium, finer, located,
};
use crate::scene::{Adaptive, Scene, SceneProblem, Task};
use std::time::Instant;

/// What rounding leaves of a zero (nm, pN, pN nm).
const ZERO: f64 = 1e-9;
/// Most resolutions that are tried before all monomers.
const MOST_TRIALS: usize = 6;
/// By what share of each of its parts an estimate may be off: parts that cancel are no accuracy.
pub(super) const DOUBT: f64 = 0.2;
/// Share of the wanted error that the part of the law may miss: a quarter of [`DOUBT`] of it.
const MISSED_OF_WANTED: f64 = 0.05;
/// A trial that leaves more than this share of the error before it has not helped.
const HELPS: f64 = 0.8;

/// The scene with sections written for the `Adaptive` of its filament: a rod, of segments as long as they may be at each place, and
/// monomers where the wanted number needs them, down to every monomer. A rod without parameters is one under
/// `Homogenised`.
///
/// Judged in the equilibrium that the scene leads to, also of a scene that asks for a motion. Each trial is solved and
/// [estimated](super::estimate). Where monomers have several states they are resolved, else what contributes most to the error; where
/// that does not help, since junctions cost more than monomers gain, all of the filament is. With a largest number of monomers, and the wanted error beyond
/// it, that resolution of those tried is taken whose estimate, with a fifth of each of its parts, is least.
///
/// # Errors
/// As [`estimate`](super::estimate), a trial without an equilibrium, and a filament that is too short to be judged and
/// has more monomers than are allowed.
pub fn choose(scene: &Scene, adaptive: &Adaptive) -> Result<(Scene, Chosen), SceneProblem> {
    let began = Instant::now();
    check(scene, adaptive.want.quantity())?;
    // A motion may have what an equilibrium cannot.
    at_rest(scene).validate()?;
    let mut search = Search {
        scene,
        adaptive,
        lengths: Lengths::of(scene, adaptive.length_nm)?,
        cells: None,
        tried: Vec::new(),
        best: None,
        after_states: false,
        next: Vec::new(),
    };
    let Judged {
        setting,
        estimate,
        several_states,
    } = search.run()?;
    let is_good = estimate.is_none_or(|estimate| search.is_good(&estimate));
    let chosen = Chosen {
        quantity: adaptive.want.quantity(),
        wanted_error: adaptive.want.error(),
        most_monomers: adaptive.monomers,
        is_met: is_good && several_states.is_empty(),
        several_states_nm: several_states,
        relative_error: estimate.map_or(0.0, |estimate| estimate.relative()),
        monomers: setting.count(scene, search.lengths)?,
        monomers_nm: setting.monomers.clone(),
        segment_nm: setting.segment_nm,
        graded: setting.rods(scene, search.lengths),
        estimate,
        tried: search.tried,
        wall_s: began.elapsed().as_secs_f64(),
    };
    Ok((setting.apply(scene, search.lengths), chosen))
}

/// A resolution that has been judged.
#[derive(Clone)]
struct Judged {
    setting: Setting,
    /// The error that it leaves; none where it is every monomer.
    estimate: Option<ErrorEstimate>,
    /// Where it has rods whose monomers would have several states (nm).
    several_states: Vec<[f64; 2]>,
}

impl Judged {
    /// Less is better: whether states are left, then the bound of the error.
    fn rank(&self) -> (bool, f64) {
        let error = self.estimate.as_ref().map_or(0.0, bound);
        (!self.several_states.is_empty(), error)
    }
}

/// A choice under way.
struct Search<'a> {
    scene: &'a Scene,
    adaptive: &'a Adaptive,
    lengths: Lengths,
    /// Cells that are known, of a filament that is judged.
    cells: Option<Cells>,
    tried: Vec<Tried>,
    /// The best so far.
    best: Option<Judged>,
    /// Whether the trial before was followed for the states of its monomers: its estimate said nothing of them.
    after_states: bool,
    /// What is to be tried after all that follows from the present trial, last first.
    next: Vec<Setting>,
}

impl Search<'_> {
    fn run(&mut self) -> Result<Judged, SceneProblem> {
        let mut setting = Setting::first(self.lengths);
        loop {
            if setting.is_all_monomers(self.lengths) {
                self.ensure_fits(&setting)?;
                return Ok(Judged {
                    setting,
                    estimate: None,
                    several_states: Vec::new(),
                });
            }
            let found = self.judge(&setting)?;
            if self.is_good(&found.total) && found.several_states.is_empty() {
                break;
            }
            let next = self.with_states(&setting, &found);
            let is_for_states = next.is_some();
            match next.or_else(|| self.follow(&setting, &found)) {
                Some(next) => setting = next,
                None => break,
            }
            self.after_states = is_for_states;
        }
        Ok(self.best.clone().expect("the first trial is one"))
    }

    /// Monomers, too, where they have several states, of which rods and estimates know one; none where that is no more, or more than
    /// is allowed.
    fn with_states(&self, setting: &Setting, found: &Located) -> Option<Setting> {
        if found.several_states.is_empty() {
            return None;
        }
        let fits = |more: &Setting| self.fits(more);
        let more = setting.resolving(&found.several_states, self.lengths, fits);
        let all = setting.all_monomers(self.lengths);
        let is_all = self.tried.len() >= MOST_TRIALS || more.is_mostly_monomers(self.lengths);
        if is_all && self.fits(&all) {
            return Some(all);
        }
        let is_new = more != *setting && self.tried.len() < MOST_TRIALS;
        (is_new && self.is_judged(&more)).then_some(more)
    }

    /// Solves and judges one resolution.
    fn judge(&mut self, setting: &Setting) -> Result<Located, SceneProblem> {
        let (assembly, state) = equilibrium(&setting.apply(self.scene, self.lengths))?;
        let missed = MISSED.max(MISSED_OF_WANTED * self.adaptive.want.error());
        let quantity = self.adaptive.want.quantity();
        let cells = match self.cells.take() {
            Some(cells) => cells,
            None => Cells::of(&self.scene.filament.monomers)?,
        };
        let found = located((&assembly, &state), quantity, (&cells, missed))?;
        self.cells = Some(cells);
        let relative = found.total.relative();
        let is_rounding = found.total.value.abs() < ZERO;
        if is_rounding || !relative.is_finite() {
            let rule = format!(
                "what is wanted is {} here: there is no relative error",
                found.total.value
            );
            return Err(SceneProblem::new("filament.sections.want", "", rule));
        }
        self.tried.push(setting.tried(relative));
        let judged = Judged {
            setting: setting.clone(),
            estimate: Some(found.total),
            several_states: found.several_states.clone(),
        };
        let best = self.best.as_ref();
        if best.is_none_or(|best| judged.rank() < best.rank()) {
            self.best = Some(judged);
        }
        Ok(found)
    }

    fn is_good(&self, estimate: &ErrorEstimate) -> bool {
        bound(estimate) <= self.adaptive.want.error()
    }

    /// What is to be tried next; none where that would be more monomers than are allowed.
    fn follow(&mut self, setting: &Setting, found: &Located) -> Option<Setting> {
        let limit = self.adaptive.want.error() * found.total.corrected().abs();
        let all = setting.all_monomers(self.lengths);
        let may_be_all = self.fits(&all);
        let helped = match self.tried.as_slice() {
            [.., before, last] if !self.after_states => {
                last.relative_error < HELPS * before.relative_error
            }
            _ => true,
        };
        let is_last = self.tried.len() >= MOST_TRIALS;
        if may_be_all && (is_last || !helped) {
            return Some(all);
        }
        if is_last {
            return None;
        }
        if let Some(finer) = self.finer(setting, found, limit) {
            return Some(finer);
        }
        let marked = setting.marked((found, limit), self.lengths, |more| self.fits(more));
        if may_be_all {
            let is_better = marked != *setting
                && !marked.is_mostly_monomers(self.lengths)
                && self.is_judged(&marked);
            return Some(if is_better { marked } else { all });
        }
        if setting.monomers.is_empty() {
            let most = self.adaptive.monomers.unwrap_or(usize::MAX);
            let window = setting.window((found, most), self.lengths, |more| self.fits(more));
            self.next.extend(window);
        }
        self.next.push(marked);
        let next = std::mem::take(&mut self.next);
        self.next = next.into_iter().filter(|one| self.is_judged(one)).collect();
        self.untried()
    }

    /// Shorter segments, where these are the larger part of the error: graded, where that takes fewer. A motion keeps
    /// one length, since its step is that of the shortest.
    fn finer(&self, setting: &Setting, found: &Located, limit: f64) -> Option<Setting> {
        let halved = setting.halved(found, limit)?;
        if !matches!(self.scene.task, Task::Equilibrium(_)) {
            return Some(halved);
        }
        let scene = setting.apply(self.scene, self.lengths);
        let longest_nm = Setting::first(self.lengths).segment_nm;
        let graded = finer::graded(&scene, &found.total, longest_nm);
        Some(graded.map_or(halved, |graded| setting.with_graded(graded)))
    }

    /// The next that has not been tried.
    fn untried(&mut self) -> Option<Setting> {
        while let Some(setting) = self.next.pop() {
            if !self.tried.iter().any(|t| setting.is_no_finer_than(t)) {
                return Some(setting);
            }
        }
        None
    }

    /// Whether its error can be estimated.
    fn is_judged(&self, setting: &Setting) -> bool {
        let scene = setting.apply(self.scene, self.lengths);
        check(&scene, self.adaptive.want.quantity()).is_ok()
    }

    /// Whether it has no more monomers than are allowed.
    fn fits(&self, setting: &Setting) -> bool {
        self.adaptive.monomers.is_none_or(|most| {
            let count = setting.count(self.scene, self.lengths);
            count.is_ok_and(|count| count <= most)
        })
    }

    /// Refuses monomers throughout where they are too many.
    fn ensure_fits(&self, all: &Setting) -> Result<(), SceneProblem> {
        match self.adaptive.monomers {
            Some(most) if !self.fits(all) => {
                let count = all.count(self.scene, self.lengths)?;
                let rule = format!(
                    "must be at least {count} here: of filaments as short as this errors are not known, so that \
                     every monomer is resolved"
                );
                Err(SceneProblem::new("filament.sections.monomers", most, rule))
            }
            _ => Ok(()),
        }
    }
}

/// An estimate with what it may be off by, over the corrected value.
fn bound(estimate: &ErrorEstimate) -> f64 {
    let doubt = DOUBT * estimate.size_of_parts();
    (estimate.error.abs() + doubt) / estimate.corrected().abs()
}
