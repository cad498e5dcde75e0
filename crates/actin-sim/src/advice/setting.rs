//! What a user can vary in how a filament is resolved, and a scene resolved that way.

use crate::scene::{JunctionWeight, RodLaw, RotaryInertia, Scene, Section};

/// How a filament is resolved.
#[derive(Clone, Debug, PartialEq)]
pub struct FilamentSetting {
    /// Stretches of arc length resolved as monomers (nm), in order, apart from each other; the rest
    /// is rod.
    pub monomers: Vec<[f64; 2]>,
    /// The rod's law.
    pub law: RodLaw,
    /// Length of segments (nm), met as nearly as whole segments allow.
    pub segment_nm: f64,
    /// Bonds per interface, lateral and longitudinal alike.
    pub bonds: usize,
    /// Weight of a junction's bonds.
    pub weight: JunctionWeight,
    /// Monomers that a junction attaches to.
    pub attached: usize,
    /// Whether segments have [`RotaryInertia::RigidSegment`]; otherwise they have what the scene gives them.
    pub rigid_segments: bool,
}

impl FilamentSetting {
    /// Every default of a scene, with these stretches of monomers.
    pub fn of(monomers: Vec<[f64; 2]>, law: RodLaw) -> Self {
        let filament = crate::Monomers::default();
        let junction = crate::JunctionModel::default();
        Self {
            monomers,
            law,
            segment_nm: 10.0,
            bonds: filament.lateral_bonds,
            weight: junction.weight,
            attached: junction.attached_monomers,
            rigid_segments: false,
        }
    }

    /// `scene` resolved this way over the same length.
    pub fn apply(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        let filament = &mut scene.filament;
        let length = filament.sections.last().map_or(0.0, |s| s.span_nm().1);
        let segments = |length| segments_of(length, self.segment_nm);
        filament.sections = sections_of(length, &self.monomers, segments).into();
        filament.monomers.lateral_bonds = self.bonds;
        filament.monomers.longitudinal_bonds = self.bonds;
        filament.rod.law = self.law.clone();
        if self.rigid_segments {
            filament.rod.rotary_inertia = RotaryInertia::RigidSegment;
        }
        filament.junction.weight = self.weight;
        filament.junction.attached_monomers = self.attached;
        scene
    }

    /// Length of filament resolved as monomers (nm).
    pub fn monomers_nm(&self) -> f64 {
        self.monomers.iter().map(|[from, to]| to - from).sum()
    }
}

/// The sections of a filament: these stretches as monomers, in order and apart from each other, the rest rods of
/// as many segments as `segments` gives their length (nm).
pub(crate) fn sections_of(
    length: f64,
    monomers: &[[f64; 2]],
    segments: impl Fn(f64) -> usize,
) -> Vec<Section> {
    // A rod, if there is any length for it.
    let rod = |from_nm: f64, to_nm: f64| {
        let segments = || Some(segments(to_nm - from_nm));
        (to_nm > from_nm).then(|| Section::rod(from_nm, to_nm, segments()))
    };
    let mut all = Vec::new();
    let mut at = 0.0;
    for &[from_nm, to_nm] in monomers {
        all.extend(rod(at, from_nm));
        all.push(Section::Ellipsoids {
            from_nm,
            to_nm,
            altered: None,
        });
        at = to_nm;
    }
    all.extend(rod(at, length));
    all
}

/// Number of segments that makes them most nearly as long (nm), at least 1.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at least 1, and the conversion saturates"
)]
pub(crate) fn segments_of(length_nm: f64, segment_nm: f64) -> usize {
    (length_nm / segment_nm).round().max(1.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rod before, between and behind two stretches; none where a stretch reaches an end.
    #[test]
    fn the_rest_is_rod() {
        let scene = &super::super::scenes::all()[0].1;
        let length = scene.filament.sections[0].span_nm().1;
        let spans = |monomers: Vec<[f64; 2]>| {
            let scene = FilamentSetting::of(monomers, RodLaw::Fitted).apply(scene);
            let sections = scene.filament.sections.iter();
            let spans = sections.map(|s| (matches!(s, Section::Rod { .. }), s.span_nm()));
            spans.collect::<Vec<_>>()
        };
        assert_eq!(spans(vec![]), [(true, (0.0, length))]);
        assert_eq!(spans(vec![[0.0, length]]), [(false, (0.0, length))]);
        assert_eq!(
            spans(vec![[20.0, 40.0], [60.0, length]]),
            [
                (true, (0.0, 20.0)),
                (false, (20.0, 40.0)),
                (true, (40.0, 60.0)),
                (false, (60.0, length)),
            ]
        );
    }
}
