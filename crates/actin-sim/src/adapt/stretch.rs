//! A stretch of rod with segments of one length, as a section of a scene.

use crate::advice::segments_of;
use crate::scene::Section;
use serde::{Deserialize, Serialize};

/// Lengths of segments that differ by a smaller share are the same.
const SAME: f64 = 1e-6;

/// A stretch of rod with segments of one length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RodStretch {
    /// Where it begins (nm of arc length).
    pub from_nm: f64,
    /// Where it ends (nm).
    pub to_nm: f64,
    /// Number of its segments.
    pub segments: usize,
}

impl RodStretch {
    /// A section that is a rod whose segments are counted.
    pub(super) fn of(section: &Section) -> Option<Self> {
        let (from_nm, to_nm) = section.span_nm();
        match section {
            Section::Rod {
                segments: Some(segments),
                ..
            } => Some(Self {
                from_nm,
                to_nm,
                segments: *segments,
            }),
            _ => None,
        }
    }

    pub(super) fn section(&self) -> Section {
        Section::rod(self.from_nm, self.to_nm, Some(self.segments))
    }

    /// Length of its segments (nm).
    pub fn segment_nm(&self) -> f64 {
        (self.to_nm - self.from_nm) / self.segments as f64
    }

    /// The same of twice as many segments.
    pub(super) fn halved(&self) -> Self {
        Self {
            segments: 2 * self.segments,
            ..*self
        }
    }

    pub(super) fn is_like(&self, other: &Self) -> bool {
        (self.segment_nm() / other.segment_nm() - 1.0).abs() < SAME
    }

    /// Its parts of at most so many whole segments, of about as many each.
    pub(super) fn cut(&self, most: usize) -> Vec<Self> {
        let parts = self.segments.div_ceil(most.max(1));
        let node = |k: usize| match k * self.segments / parts {
            n if n == self.segments => (n, self.to_nm),
            n => (n, self.from_nm + n as f64 * self.segment_nm()),
        };
        let part = |k: usize| {
            let ((first, from_nm), (last, to_nm)) = (node(k), node(k + 1));
            Self {
                from_nm,
                to_nm,
                segments: last - first,
            }
        };
        (0..parts).map(part).collect()
    }

    /// Itself as sections, with twice the segments in a part that begins and ends at nodes.
    pub(super) fn with_halved(&self, part: &Self) -> Vec<Section> {
        let rest = |from_nm: f64, to_nm: f64| {
            let segments = ((to_nm - from_nm) / self.segment_nm()).round();
            (segments >= 1.0).then(|| Self::of_length([from_nm, to_nm], self.segment_nm()))
        };
        let all = [
            rest(self.from_nm, part.from_nm),
            Some(part.halved()),
            rest(part.to_nm, self.to_nm),
        ];
        all.iter().flatten().map(Self::section).collect()
    }

    /// A stretch of segments that are most nearly as long (nm).
    fn of_length([from_nm, to_nm]: [f64; 2], segment_nm: f64) -> Self {
        Self {
            from_nm,
            to_nm,
            segments: segments_of(to_nm - from_nm, segment_nm),
        }
    }
}

/// Neighbours of one length as one.
pub(super) fn joined(stretches: impl IntoIterator<Item = RodStretch>) -> Vec<RodStretch> {
    let mut all: Vec<RodStretch> = Vec::new();
    for next in stretches {
        match all.last_mut() {
            Some(last) if last.is_like(&next) && last.to_nm >= next.from_nm => {
                last.to_nm = next.to_nm;
                last.segments += next.segments;
            }
            _ => all.push(next),
        }
    }
    all
}

/// A rod between two places with segments as long as those of the stretches that it lies in: what is left between
/// them, or is shorter than half a segment, goes to a neighbour.
pub(super) fn divided([from, to]: [f64; 2], stretches: &[RodStretch]) -> Vec<RodStretch> {
    let inside = stretches.iter().filter_map(|stretch| {
        let begins = stretch.from_nm.max(from);
        let length_nm = stretch.to_nm.min(to) - begins;
        let segment_nm = stretch.segment_nm();
        (length_nm >= 0.5 * segment_nm).then_some((begins, segment_nm))
    });
    let mut parts: Vec<(f64, f64)> = inside.collect();
    if let Some(first) = parts.first_mut() {
        first.0 = from;
    }
    let ends = parts.iter().skip(1).map(|part| part.0).chain([to]);
    let all = parts.iter().zip(ends.collect::<Vec<_>>());
    joined(
        all.map(|(&(begins, segment_nm), ends)| RodStretch::of_length([begins, ends], segment_nm)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stretch(from_nm: f64, to_nm: f64, segments: usize) -> RodStretch {
        RodStretch {
            from_nm,
            to_nm,
            segments,
        }
    }

    /// No segment is lost or cut.
    #[test]
    fn a_rod_is_cut_at_its_nodes() {
        let rod = stretch(5.0, 75.0, 7);
        let parts = rod.cut(3);
        assert_eq!(parts.iter().map(|part| part.segments).sum::<usize>(), 7);
        assert_eq!((parts[0].from_nm, parts[2].to_nm), (5.0, 75.0));
        for part in &parts {
            assert!(part.is_like(&rod) && part.segments <= 3, "{parts:?}");
            let sections = rod.with_halved(part);
            let all = sections.iter().filter_map(RodStretch::of);
            let all: Vec<_> = all.collect();
            let counted = all.iter().map(|one| one.segments).sum::<usize>();
            assert_eq!(counted, 7 + part.segments, "{all:?}");
        }
        assert_eq!(joined(parts), [rod]);
    }

    /// Where monomers end within a stretch its segments stay as long as they can; what is left of one is no section.
    #[test]
    fn a_rod_between_monomers_keeps_its_lengths() {
        let all = [
            stretch(0.0, 40.0, 2),
            stretch(40.0, 80.0, 8),
            stretch(80.0, 160.0, 4),
        ];
        assert_eq!(divided([0.0, 160.0], &all), all);
        let parts = divided([30.0, 86.0], &all);
        assert_eq!(parts, [stretch(30.0, 40.0, 1), stretch(40.0, 86.0, 9)]);
        assert_eq!(divided([50.0, 70.0], &all), [stretch(50.0, 70.0, 4)]);
    }
}
