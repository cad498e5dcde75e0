//! The sections that a wanted accuracy needs.

use super::defects::Contribution;
use super::ideal::PERIOD;
use super::{ErrorEstimate, Located, at_rest, check, equilibrium, is_too_short, located};
use crate::advice::{sections_of, segments_of};
use crate::assembly::whole_length_nm;
use crate::scene::{Adaptive, Quantity, RodLaw, RodModel, Scene, SceneProblem, Want};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Segments to begin with: at least as long (nm), and at least this share of the filament.
const FIRST_SEGMENTS: (f64, f64) = (20.0, 0.01);
/// The shortest segments (nm).
const SHORTEST_SEGMENTS_NM: f64 = 2.5;
/// Most resolutions that are tried before all monomers.
const MOST_TRIALS: usize = 6;
/// By what share of each of its parts an estimate may be off: parts that cancel are no accuracy.
const DOUBT: f64 = 0.2;
/// What is left after marking, as a share of the wanted error.
const MARK_TO: f64 = 0.4;
/// Monomers over more of the length than this are monomers throughout.
const MOST_SHARE: f64 = 0.6;
/// A trial that leaves more than this share of the error before it has not helped.
const HELPS: f64 = 0.8;

/// What was chosen, and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chosen {
    /// What was wanted.
    pub quantity: Quantity,
    /// Its largest relative error.
    pub wanted_error: f64,
    /// Where monomers are resolved (nm of arc length).
    pub monomers_nm: Vec<[f64; 2]>,
    /// Length of segments (nm), as nearly as whole ones allow.
    pub segment_nm: f64,
    /// The error that is left; none where every monomer is resolved.
    pub estimate: Option<ErrorEstimate>,
    /// Resolutions that were tried, and the estimated relative error of each.
    pub tried: Vec<Tried>,
    /// Time that the choice took (s).
    pub wall_s: f64,
}

impl Chosen {
    /// The choice in a sentence or two.
    pub(crate) fn note(&self) -> String {
        let stretches = self.monomers_nm.iter();
        let stretches = stretches.map(|[from, to]| format!("{from:.0} to {to:.0} nm"));
        let monomers = stretches.collect::<Vec<_>>().join(", ");
        let resolved = match (monomers.is_empty(), self.estimate) {
            (true, _) => format!("a rod of segments of {} nm", self.segment_nm),
            (false, Some(_)) => format!(
                "monomers from {monomers}, and a rod of segments of {} nm",
                self.segment_nm
            ),
            (false, None) => "every monomer".to_owned(),
        };
        let left = self.estimate.map_or_else(String::new, |estimate| {
            let percent = 100.0 * estimate.relative();
            let corrected = estimate.corrected();
            let unit = self.quantity.unit();
            format!(
                ". It is {:.5} {unit} in the equilibrium at rest, {corrected:.5} with its estimated error of {percent:.2} %",
                estimate.value
            )
        });
        format!(
            "sections chosen for {:?} within {} %: {resolved}{left}",
            self.quantity,
            100.0 * self.wanted_error
        )
    }
}

/// A resolution that was tried.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    /// Where monomers were resolved (nm of arc length).
    pub monomers_nm: Vec<[f64; 2]>,
    /// Length of segments (nm).
    pub segment_nm: f64,
    /// Estimated error over the corrected value.
    pub relative_error: f64,
}

/// How a filament is resolved.
#[derive(Clone, Debug)]
struct Setting {
    length_nm: f64,
    monomers: Vec<[f64; 2]>,
    segment_nm: f64,
}

impl Setting {
    /// A rod, of a filament of this length (nm); monomers where it is too short to be judged.
    fn first(length_nm: f64, rise_nm: f64) -> Self {
        let (shortest, share) = FIRST_SEGMENTS;
        let monomers = if is_too_short(length_nm, rise_nm) {
            vec![[0.0, length_nm]]
        } else {
            Vec::new()
        };
        Self {
            length_nm,
            monomers,
            segment_nm: shortest.max(share * length_nm),
        }
    }

    fn apply(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        let sections = sections_of(self.length_nm, &self.monomers, |length| {
            segments_of(length, self.segment_nm)
        });
        scene.filament.sections = sections.into();
        scene
    }

    fn tried(&self, relative_error: f64) -> Tried {
        Tried {
            monomers_nm: self.monomers.clone(),
            segment_nm: self.segment_nm,
            relative_error,
        }
    }

    fn is_all_monomers(&self) -> bool {
        self.monomers == [[0.0, self.length_nm]]
    }
}

/// The scene with sections written for the `Adaptive` of its filament: a rod, of segments as long as they may be, and
/// monomers where the wanted number needs them, down to every monomer. A rod without parameters is one under
/// `Homogenised`.
///
/// Judged in the equilibrium that the scene leads to, also of a scene that asks for a motion. Each trial is solved,
/// [estimated](super::estimate), and what contributes most is resolved; where that does not help, since junctions
/// cost more than monomers gain, all of the filament is.
///
/// # Errors
/// As [`estimate`](super::estimate), and a trial without an equilibrium.
pub fn choose(scene: &Scene, adaptive: &Adaptive) -> Result<(Scene, Chosen), SceneProblem> {
    let began = Instant::now();
    check(scene, adaptive.want.quantity())?;
    // A motion may have what an equilibrium cannot.
    at_rest(scene).validate()?;
    let scene = &with_law(scene);
    let mut setting = Setting::first(
        whole_length_nm(scene, adaptive.length_nm)?,
        scene.filament.monomers.rise_nm,
    );
    let mut tried = Vec::new();
    let mut estimate = None;
    while !setting.is_all_monomers() {
        match trial(scene, adaptive.want, &setting, &mut tried)? {
            Trial::Good(found) => {
                estimate = Some(found);
                break;
            }
            Trial::Next(next) => setting = next,
        }
    }
    let chosen_scene = setting.apply(scene);
    let chosen = Chosen {
        quantity: adaptive.want.quantity(),
        wanted_error: adaptive.want.error(),
        monomers_nm: setting.monomers,
        segment_nm: setting.segment_nm,
        estimate,
        tried,
        wall_s: began.elapsed().as_secs_f64(),
    };
    Ok((chosen_scene, chosen))
}

/// What a trial says.
enum Trial {
    /// The resolution will do.
    Good(ErrorEstimate),
    /// Another is to be tried.
    Next(Setting),
}

/// Solves and judges one resolution.
fn trial(
    scene: &Scene,
    want: Want,
    setting: &Setting,
    tried: &mut Vec<Tried>,
) -> Result<Trial, SceneProblem> {
    let (assembly, state) = equilibrium(&setting.apply(scene))?;
    let found = located(&assembly, &state, want.quantity())?;
    let relative = found.total.relative();
    if !relative.is_finite() {
        let rule = format!(
            "what is wanted is {} here: there is no relative error",
            found.total.value
        );
        return Err(SceneProblem::new("filament.sections.want", "", rule));
    }
    let before = tried.last().map(|t: &Tried| t.relative_error);
    let helped = before.is_none_or(|before| relative < HELPS * before);
    tried.push(setting.tried(relative));
    let limit = want.error() * found.total.corrected().abs();
    if found.total.error.abs() + DOUBT * found.total.size_of_parts() <= limit {
        return Ok(Trial::Good(found.total));
    }
    let rise_nm = scene.filament.monomers.rise_nm;
    Ok(Trial::Next(if helped && tried.len() < MOST_TRIALS {
        refined(setting, &found, limit, rise_nm)
    } else {
        all_monomers(setting)
    }))
}

/// Rods that do not name a law have the one without a load case behind it.
fn with_law(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let rod = &mut scene.filament.rod;
    if *rod == RodModel::default() {
        rod.law = RodLaw::Homogenised;
    }
    scene
}

fn all_monomers(setting: &Setting) -> Setting {
    Setting {
        monomers: vec![[0.0, setting.length_nm]],
        ..setting.clone()
    }
}

/// Shorter segments where these are the larger part, else monomers where most of the rest comes from.
fn refined(setting: &Setting, found: &Located, limit: f64, rise_nm: f64) -> Setting {
    let rest = found.total.error - found.total.segments;
    let coarse = found.total.segments.abs();
    if coarse > rest.abs().max(0.25 * limit) && setting.segment_nm > SHORTEST_SEGMENTS_NM {
        return Setting {
            segment_nm: 0.5 * setting.segment_nm,
            ..setting.clone()
        };
    }
    let bin = PERIOD as f64 * rise_nm;
    let mut bins = contributions(&found.parts, setting.length_nm, bin);
    let sign = rest.signum();
    bins.sort_by(|a, b| (sign * b.error).total_cmp(&(sign * a.error)));
    let mut left = rest.abs();
    let mut monomers = setting.monomers.clone();
    for part in bins {
        if left <= MARK_TO * limit || sign * part.error <= 0.0 {
            break;
        }
        left -= sign * part.error;
        monomers.push(part.span_nm);
    }
    let grown = monomers.len() > setting.monomers.len();
    let merged = merged(monomers, setting.length_nm, bin);
    let covered: f64 = merged.iter().map(|[from, to]| to - from).sum();
    if !grown || covered > MOST_SHARE * setting.length_nm {
        return all_monomers(setting);
    }
    Setting {
        monomers: merged,
        ..setting.clone()
    }
}

/// What stretches of one period contribute.
fn contributions(parts: &[Contribution], length_nm: f64, bin: f64) -> Vec<Contribution> {
    let n = segments_of(length_nm, bin);
    let width = length_nm / n as f64;
    let span = |k: usize| [k as f64 * width, (k + 1) as f64 * width];
    (0..n)
        .map(|k| {
            let [from, to] = span(k);
            let share = |part: &Contribution| {
                let [a, b] = part.span_nm;
                let inside = b.min(to) - a.max(from);
                part.error * (inside / (b - a)).max(0.0)
            };
            Contribution {
                span_nm: [from, to],
                error: parts.iter().map(share).sum(),
            }
        })
        .collect()
}

/// Stretches in order, those closer to each other or to an end than two periods as one.
fn merged(mut stretches: Vec<[f64; 2]>, length_nm: f64, bin: f64) -> Vec<[f64; 2]> {
    stretches.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut all: Vec<[f64; 2]> = Vec::new();
    for [from, to] in stretches {
        match all.last_mut() {
            Some(last) if from - last[1] < 2.0 * bin => last[1] = last[1].max(to),
            _ => all.push([from, to]),
        }
    }
    if let Some(first) = all.first_mut().filter(|first| first[0] < bin) {
        first[0] = 0.0;
    }
    if let Some(last) = all.last_mut().filter(|last| length_nm - last[1] < bin) {
        last[1] = length_nm;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(span_nm: [f64; 2], error: f64) -> Contribution {
        Contribution { span_nm, error }
    }

    /// A part is shared by the periods that it reaches into; nothing is lost.
    #[test]
    fn contributions_are_kept() {
        let parts = [part([0.0, 10.0], 1.0), part([30.0, 50.0], 2.0)];
        let bins = contributions(&parts, 160.0, 40.0);
        let errors: Vec<f64> = bins.iter().map(|b| b.error).collect();
        assert_eq!(errors, [2.0, 1.0, 0.0, 0.0]);
    }

    #[test]
    fn near_stretches_are_one() {
        let all = merged(
            vec![[200.0, 235.0], [5.0, 40.0], [100.0, 135.0]],
            1000.0,
            35.0,
        );
        assert_eq!(all, [[0.0, 235.0]]);
        let all = merged(vec![[300.0, 335.0], [40.0, 75.0]], 340.0, 35.0);
        assert_eq!(all, [[40.0, 75.0], [300.0, 340.0]]);
    }
}
