//! How filaments of a candidate are resolved: rods under a law, with windows of monomers.

use crate::Assembly;
use crate::scene::{
    Anchors, Couple, End, Force, Hold, Load, Monomers, RodLaw, RodModel, RotaryInertia, Scene,
    Section, Task,
};

/// Rods shorter than this (nm), a period of monomers, are resolved with their neighbours.
const SHORTEST_ROD_NM: f64 = 36.0;

/// Share of a filament from which on windows of monomers save nothing.
const MOST_MONOMERS: f64 = 0.75;

/// Points of a weighted interface.
const POINTS: usize = 12;

/// A scene with every monomer resolved, as far as that can be.
#[derive(Clone, Debug)]
pub(super) struct Whole {
    pub scene: Scene,
    /// Length of each filament (nm), as its lattice has it.
    pub lengths_nm: Vec<f64>,
    /// Why filaments keep the sections that they have.
    pub kept: Kept,
}

/// Why each filament keeps the sections that it has, if it does.
pub(super) type Kept = Vec<Option<&'static str>>;

/// The scene with every monomer resolved and weighted bonds; in overdamped motion in heat with quasi-harmonic
/// interfaces, since bonds take ten thousand times longer.
pub(super) fn every_monomer(scene: &Scene) -> (Scene, Kept) {
    let (mut whole, kept) = every_monomer_of(scene, |_| true);
    for filament in whole.filaments_mut() {
        filament.monomers = weighted(&filament.monomers);
    }
    if let Task::Brownian(task) = &mut whole.task {
        task.interfaces.allow_long_steps(task.temperature_k);
    }
    (whole, kept)
}

/// The scene with every monomer of some filaments resolved.
pub(super) fn every_monomer_of(scene: &Scene, is_free: impl Fn(usize) -> bool) -> (Scene, Kept) {
    let mut whole = scene.clone();
    let why = |filament: usize| {
        if is_free(filament) {
            why_kept(scene, filament)
        } else {
            Some("sections that are written stay")
        }
    };
    let kept: Kept = (0..scene.number_of_filaments()).map(why).collect();
    for (filament, kept) in whole.filaments_mut().zip(&kept) {
        if kept.is_none() {
            let to_nm = filament.length_nm();
            filament.sections = vec![monomers(0.0, to_nm)].into();
        }
    }
    (whole, kept)
}

pub(crate) fn weighted(written: &Monomers) -> Monomers {
    if written.anchors == Anchors::Cubature {
        return written.clone();
    }
    Monomers {
        seed: 0,
        anchors: Anchors::Cubature,
        lateral_bonds: POINTS,
        longitudinal_bonds: POINTS,
        ..written.clone()
    }
}

/// Monomers from one arc length to another.
fn monomers(from_nm: f64, to_nm: f64) -> Section {
    Section::Ellipsoids {
        from_nm,
        to_nm,
        altered: None,
    }
}

fn why_kept(scene: &Scene, filament: usize) -> Option<&'static str> {
    let sections = &scene.filament_at(filament)?.sections;
    let mut clamps = scene.clamps.iter();
    if sections.iter().any(Section::is_altered) {
        Some("sections that are altered stay as they are")
    } else if clamps.any(|clamp| clamp.filament == filament && clamp.hold != Hold::Wall) {
        Some("an end that is held by other than Wall is one of a rod")
    } else {
        None
    }
}

/// Rods of one law.
#[derive(Clone, Debug)]
pub(super) struct Rods {
    pub law: RodLaw,
    pub segment_nm: f64,
    pub inertia: RotaryInertia,
}

impl Whole {
    /// That of an assembled scene with every monomer.
    pub(super) fn new(assembly: &Assembly, kept: Kept) -> Self {
        let filaments = 0..assembly.filaments.len();
        Self {
            scene: assembly.scene.clone(),
            lengths_nm: filaments.map(|f| assembly.length_of(f)).collect(),
            kept,
        }
    }

    /// Filaments that can be resolved in several ways.
    pub(super) fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.kept.len()).filter(|f| self.kept[*f].is_none())
    }

    /// The scene with rods, and monomers where `windows` has them (nm), filament by filament.
    pub(super) fn resolved(&self, rods: &Rods, windows: &[Vec<[f64; 2]>]) -> Scene {
        let mut scene = self.with_sections(rods.segment_nm, windows);
        for (filament, kept) in scene.filaments_mut().zip(&self.kept) {
            if kept.is_none() && filament.sections.iter().any(Section::is_rod) {
                filament.rod = RodModel {
                    rotary_inertia: rods.inertia,
                    ..RodModel::of_law(rods.law.clone())
                };
            }
        }
        scene
    }

    /// The scene with sections so, its rods as they are.
    pub(super) fn with_sections(&self, segment_nm: f64, windows: &[Vec<[f64; 2]>]) -> Scene {
        let mut scene = self.scene.clone();
        for (f, filament) in scene.filaments_mut().enumerate() {
            if self.kept[f].is_none() {
                filament.sections = sections(self.lengths_nm[f], &windows[f], segment_nm).into();
            }
        }
        scene
    }

    /// No window in any filament.
    pub(super) fn no_windows(&self) -> Vec<Vec<[f64; 2]>> {
        vec![Vec::new(); self.kept.len()]
    }

    /// Windows so wide (nm) about places, filament by filament; none where that is most of what is resolved.
    pub(super) fn windows(
        &self,
        places: impl Fn(usize) -> Vec<f64>,
        width_nm: f64,
    ) -> Option<Vec<Vec<[f64; 2]>>> {
        let windows: Vec<Vec<[f64; 2]>> = (0..self.kept.len())
            .map(|f| merged(places(f), width_nm, self.lengths_nm[f]))
            .collect();
        let of = |f: usize| windows[f].iter().map(|w| w[1] - w[0]).sum::<f64>();
        let resolved: f64 = self.free().map(of).sum();
        let length: f64 = self.free().map(|f| self.lengths_nm[f]).sum();
        (resolved > 0.0 && resolved < MOST_MONOMERS * length).then_some(windows)
    }

    /// Arc lengths of a filament (nm) at which it is held.
    pub(super) fn walls(&self, filament: usize) -> Vec<f64> {
        let clamps = self.scene.clamps.iter();
        let of = clamps.filter(|clamp| clamp.filament == filament);
        of.map(|clamp| self.end_nm(filament, clamp.end)).collect()
    }

    /// Arc lengths at which a load acts or begins or ends, or a linker holds.
    pub(super) fn sites(&self, filament: usize) -> Vec<f64> {
        let scene = &self.scene;
        let loads = scene
            .loads
            .iter()
            .filter(|load| load.filament() == filament);
        let of_loads = loads.flat_map(|load| match load {
            Load::Acceleration(_) => Vec::new(),
            Load::EndForce { end, .. } => vec![self.end_nm(filament, *end)],
            Load::Force(Force { end, at_nm, .. }) | Load::Couple(Couple { end, at_nm, .. }) => {
                let end = end.map(|end| self.end_nm(filament, end));
                end.or(*at_nm).into_iter().collect()
            }
            Load::ForcePerLength(_) | Load::CouplePerLength(_) => {
                load.interval(scene).map_or_else(Vec::new, Vec::from)
            }
        });
        let linkers = scene.linkers.iter();
        let of_linkers = linkers.flat_map(|linker| {
            let other = linker.to.map(|site| (site.filament, site.at_nm));
            let sites = [(linker.filament, linker.at_nm)].into_iter().chain(other);
            sites.filter_map(|(of, at_nm)| (of == filament).then_some(at_nm))
        });
        of_loads.chain(of_linkers).collect()
    }

    fn end_nm(&self, filament: usize, end: End) -> f64 {
        match end {
            End::Start => 0.0,
            End::End => self.lengths_nm[filament],
        }
    }
}

/// Monomers in windows, rods of segments as nearly as long as wanted elsewhere.
fn sections(length_nm: f64, windows: &[[f64; 2]], segment_nm: f64) -> Vec<Section> {
    let rod = |from_nm: f64, to_nm: f64| {
        let segments = segments(to_nm - from_nm, segment_nm);
        (to_nm > from_nm).then(|| Section::rod(from_nm, to_nm, Some(segments)))
    };
    let mut all = Vec::new();
    let mut at = 0.0;
    for &[from_nm, to_nm] in windows {
        all.extend(rod(at, from_nm));
        all.push(monomers(from_nm, to_nm));
        at = to_nm;
    }
    all.extend(rod(at, length_nm));
    all
}

/// Number of segments that makes them most nearly as long (nm), at least 1.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a filament has fewer segments than 2^53"
)]
fn segments(length_nm: f64, segment_nm: f64) -> usize {
    (length_nm / segment_nm).round().max(1.0) as usize
}

/// Windows about places, those together that leave too little between them or before an end. A window at an end of the
/// filament has its whole width inside.
fn merged(mut places: Vec<f64>, width_nm: f64, length_nm: f64) -> Vec<[f64; 2]> {
    places.sort_by(f64::total_cmp);
    let mut windows: Vec<[f64; 2]> = Vec::new();
    for place in places {
        let last = (length_nm - width_nm).max(0.0);
        let from = (place - 0.5 * width_nm).clamp(0.0, last);
        let mut window = [from, (from + width_nm).min(length_nm)];
        if window[0] < SHORTEST_ROD_NM {
            window[0] = 0.0;
        }
        if length_nm - window[1] < SHORTEST_ROD_NM {
            window[1] = length_nm;
        }
        match windows.last_mut() {
            Some(before) if window[0] - before[1] < SHORTEST_ROD_NM => {
                before[1] = before[1].max(window[1]);
            }
            _ => windows.push(window),
        }
    }
    windows
}
