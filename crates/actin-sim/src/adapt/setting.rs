//! How a filament is resolved, and how it is resolved further.

use super::defects::Contribution;
use super::finer::parts;
use super::ideal::PERIOD;
use super::{Located, RodStretch, Tried, is_too_short};
use crate::advice::{sections_of, segments_of};
use crate::assembly::{count_monomers, whole_length_nm};
use crate::scene::{Scene, SceneProblem};

/// Segments to begin with: at least as long (nm), and at least this share of the filament.
const FIRST_SEGMENTS: (f64, f64) = (20.0, 0.025);
/// The shortest segments (nm).
pub(super) const SHORTEST_SEGMENTS_NM: f64 = 2.5;
/// What is left after marking, as a share of the wanted error.
const MARK_TO: f64 = 0.4;
/// Monomers over more of the length than this are monomers throughout.
const MOST_SHARE: f64 = 0.6;

/// Length of a filament, and stretches of it that are counted together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lengths {
    length_nm: f64,
    rise_nm: f64,
}

impl Lengths {
    /// Those of the filament of a scene, with its length rounded to whole monomers.
    ///
    /// # Errors
    /// A length of more monomers than are told apart.
    pub(super) fn of(scene: &Scene, length_nm: f64) -> Result<Self, SceneProblem> {
        Ok(Self {
            length_nm: whole_length_nm(scene, length_nm)?,
            rise_nm: scene.filament.monomers.rise_nm,
        })
    }

    /// One period of monomers (nm).
    fn bin_nm(&self) -> f64 {
        PERIOD as f64 * self.rise_nm
    }
}

/// How a filament is resolved.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Setting {
    /// Where monomers are (nm), in order.
    pub monomers: Vec<[f64; 2]>,
    /// Length of segments elsewhere (nm); the longest, where they are graded.
    pub segment_nm: f64,
    /// Where segments are graded, in order; none where all are as long.
    pub graded: Vec<RodStretch>,
}

impl Setting {
    /// A rod; monomers where the filament is too short to be judged.
    pub(super) fn first(lengths: Lengths) -> Self {
        let (shortest, share) = FIRST_SEGMENTS;
        let length_nm = lengths.length_nm;
        let monomers = if is_too_short(length_nm, lengths.rise_nm) {
            vec![[0.0, length_nm]]
        } else {
            Vec::new()
        };
        Self {
            monomers,
            segment_nm: shortest.max(share * length_nm),
            graded: Vec::new(),
        }
    }

    /// The scene with its filament resolved so.
    pub(super) fn apply(&self, scene: &Scene, lengths: Lengths) -> Scene {
        let mut scene = scene.clone();
        let sections = sections_of(lengths.length_nm, &self.monomers, |length| {
            segments_of(length, self.segment_nm)
        });
        let parts = sections
            .iter()
            .flat_map(|section| parts(section, &self.graded));
        scene.filament.sections = parts.collect::<Vec<_>>().into();
        scene
    }

    /// Its rods, where their segments are graded.
    pub(super) fn rods(&self, scene: &Scene, lengths: Lengths) -> Vec<RodStretch> {
        if self.graded.is_empty() {
            return Vec::new();
        }
        let sections = self.apply(scene, lengths).filament.sections;
        sections.iter().filter_map(RodStretch::of).collect()
    }

    /// Number of its monomers, held ones included.
    ///
    /// # Errors
    /// Stretches that are no sections.
    pub(super) fn count(&self, scene: &Scene, lengths: Lengths) -> Result<usize, SceneProblem> {
        count_monomers(&self.apply(scene, lengths))
    }

    pub(super) fn tried(&self, relative_error: f64) -> Tried {
        Tried {
            monomers_nm: self.monomers.clone(),
            segment_nm: self.segment_nm,
            graded: self.graded.clone(),
            relative_error,
        }
    }

    pub(super) fn is_all_monomers(&self, lengths: Lengths) -> bool {
        self.monomers == [[0.0, lengths.length_nm]]
    }

    pub(super) fn all_monomers(&self, lengths: Lengths) -> Self {
        self.with_monomers(vec![[0.0, lengths.length_nm]])
    }

    fn with_monomers(&self, monomers: Vec<[f64; 2]>) -> Self {
        Self {
            monomers,
            ..self.clone()
        }
    }

    /// The same with monomers in a stretch (nm), too.
    fn with_span(&self, span: [f64; 2], lengths: Lengths) -> Self {
        let mut monomers = self.monomers.clone();
        monomers.push(span);
        self.with_monomers(merged(monomers, lengths.length_nm, lengths.bin_nm()))
    }

    /// Segments of half the length, where these are the larger part of the error.
    pub(super) fn halved(&self, found: &Located, limit: f64) -> Option<Self> {
        let rest = found.total.error - found.total.segments;
        let coarse = found.total.segments.abs();
        let is_coarse = coarse > rest.abs().max(0.25 * limit);
        (is_coarse && self.segment_nm > SHORTEST_SEGMENTS_NM).then(|| Self {
            segment_nm: 0.5 * self.segment_nm,
            graded: self.graded.iter().map(RodStretch::halved).collect(),
            ..self.clone()
        })
    }

    /// The same with graded segments.
    pub(super) fn with_graded(&self, graded: Vec<RodStretch>) -> Self {
        let lengths = graded.iter().map(RodStretch::segment_nm);
        Self {
            segment_nm: lengths.fold(0.0, f64::max),
            graded,
            ..self.clone()
        }
    }

    /// Whether a resolution that was tried has the same monomers and segments nowhere longer.
    pub(super) fn is_no_finer_than(&self, tried: &Tried) -> bool {
        let middles = self.graded.iter().chain(&tried.graded);
        let mut middles = middles.map(|stretch| 0.5 * (stretch.from_nm + stretch.to_nm));
        let (own, other) = (
            (&self.graded, self.segment_nm),
            (&tried.graded, tried.segment_nm),
        );
        let is_longer = |s_nm: f64| length_at(other, s_nm) > length_at(own, s_nm);
        tried.monomers_nm == self.monomers
            && tried.segment_nm <= self.segment_nm
            && !middles.any(is_longer)
    }

    /// Monomers where most of the error comes from, as far as `fits` allows; itself where there is no such place.
    pub(super) fn marked(
        &self,
        (found, limit): (&Located, f64),
        lengths: Lengths,
        fits: impl Fn(&Self) -> bool,
    ) -> Self {
        let rest = found.total.error - found.total.segments;
        let bin = lengths.bin_nm();
        let mut bins = contributions(&found.parts, lengths.length_nm, bin);
        let sign = rest.signum();
        bins.sort_by(|a, b| (sign * b.error).total_cmp(&(sign * a.error)));
        let mut left = rest.abs();
        let mut marked = self.clone();
        for part in bins {
            if left <= MARK_TO * limit || sign * part.error <= 0.0 {
                break;
            }
            let more = marked.with_span(part.span_nm, lengths);
            if fits(&more) {
                left -= sign * part.error;
                marked = more;
            }
        }
        marked
    }

    /// Monomers, too, in the periods that these stretches (nm) reach into, in as many as `fits` allows.
    pub(super) fn resolving(
        &self,
        stretches: &[[f64; 2]],
        lengths: Lengths,
        fits: impl Fn(&Self) -> bool,
    ) -> Self {
        let is_in = |[a, b]: [f64; 2]| stretches.iter().any(|[from, to]| *from < b && a < *to);
        let mut resolved = self.clone();
        let periods = periods(lengths.length_nm, lengths.bin_nm());
        for span in periods.into_iter().filter(|span| is_in(*span)) {
            let more = resolved.with_span(span, lengths);
            if fits(&more) {
                resolved = more;
            }
        }
        resolved
    }

    /// Of a rod the one stretch of at most `most` monomers that leaves least of the error, of as many periods as `fits` allows; none
    /// where not even one does.
    pub(super) fn window(
        &self,
        (found, most): (&Located, usize),
        lengths: Lengths,
        fits: impl Fn(&Self) -> bool,
    ) -> Option<Self> {
        let rest = found.total.error - found.total.segments;
        let bin = lengths.bin_nm();
        let bins = contributions(&found.parts, lengths.length_nm, bin);
        let stretch = |from: usize, periods: usize| {
            let span = [bins[from].span_nm[0], bins[from + periods - 1].span_nm[1]];
            self.with_monomers(merged(vec![span], lengths.length_nm, bin))
        };
        let longest = bins.len().min(most / PERIOD);
        let mut of_length = (1..=longest).rev().filter_map(|periods| {
            let starts = (0..=bins.len() - periods).filter(|&from| fits(&stretch(from, periods)));
            let of_start = |from: &usize| -> f64 {
                let inside = bins[*from..*from + periods].iter();
                (rest - inside.map(|part| part.error).sum::<f64>()).abs()
            };
            let best = starts.min_by(|a, b| of_start(a).total_cmp(&of_start(b)));
            best.map(|from| stretch(from, periods))
        });
        of_length.next()
    }

    /// Whether its monomers are so many that they may as well be everywhere.
    pub(super) fn is_mostly_monomers(&self, lengths: Lengths) -> bool {
        let covered: f64 = self.monomers.iter().map(|[from, to]| to - from).sum();
        covered > MOST_SHARE * lengths.length_nm
    }
}

/// Length of segments about an arc length (nm).
fn length_at((graded, segment_nm): (&Vec<RodStretch>, f64), s_nm: f64) -> f64 {
    let about = |stretch: &&RodStretch| (stretch.from_nm..=stretch.to_nm).contains(&s_nm);
    let stretch = graded.iter().find(about);
    stretch.map_or(segment_nm, RodStretch::segment_nm)
}

/// Stretches of about one period, in order (nm).
fn periods(length_nm: f64, bin: f64) -> Vec<[f64; 2]> {
    let n = segments_of(length_nm, bin);
    let width = length_nm / n as f64;
    (0..n)
        .map(|k| [k as f64 * width, (k + 1) as f64 * width])
        .collect()
}

/// What stretches of one period contribute.
fn contributions(parts: &[Contribution], length_nm: f64, bin: f64) -> Vec<Contribution> {
    periods(length_nm, bin)
        .into_iter()
        .map(|[from, to]| {
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

    /// Monomers cut the rods that they lie in, whose segments stay as long; what was tried with segments nowhere longer
    /// is not tried again.
    #[test]
    fn graded_rods_are_cut_and_compared() {
        let text = "Scene(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 160.0)]), clamps: [Clamp(end: Start)], \
                    task: Equilibrium())";
        let scene = Scene::from_ron(text).unwrap();
        let lengths = Lengths {
            length_nm: 160.0,
            rise_nm: 71.2 / 26.0,
        };
        let rod = |from_nm: f64, to_nm: f64, segments: usize| RodStretch {
            from_nm,
            to_nm,
            segments,
        };
        let even = Setting::first(lengths);
        let graded = even.with_graded(vec![rod(0.0, 40.0, 8), rod(40.0, 160.0, 6)]);
        assert_eq!(graded.rods(&scene, lengths), graded.graded);
        let mixed = graded.with_monomers(vec![[60.0, 100.0]]);
        let rods = [rod(0.0, 40.0, 8), rod(40.0, 60.0, 1), rod(100.0, 160.0, 3)];
        assert_eq!(mixed.rods(&scene, lengths), rods);
        let tried = graded.tried(0.1);
        assert!(even.is_no_finer_than(&tried) && graded.is_no_finer_than(&tried));
        assert!(!mixed.is_no_finer_than(&tried));
        assert!(!graded.is_no_finer_than(&even.tried(0.1)));
    }
}
