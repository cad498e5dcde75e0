//! Resolutions of filaments: rods under a law, with windows of monomers.

use crate::scene::{
    Anchors, Couple, End, Force, Hold, Load, RodLaw, RodModel, RotaryInertia, Scene, SceneProblem,
    Section, Task,
};
use crate::{Assembly, Estimate, Plan};
use actin_assembly::whole::to_count;
use actin_cosserat::Homogenised;

/// Shortest rod (nm): a period of monomers. Monomers replace rods below this length.
const SHORTEST_ROD_NM: f64 = 36.0;

/// Largest fraction of monomers in candidates with windows; above it windows save little time.
const MOST_MONOMERS: f64 = 0.75;

/// Sampled bonds per interface, and number of filaments with sampled bonds.
pub(super) const DRAWN: (usize, u64) = (64, 3);

/// A scene with every monomer resolved, except for filaments with fixed sections.
#[derive(Clone, Debug)]
pub(super) struct FullResolution {
    pub scene: Scene,
    /// Length of each filament (nm) on its lattice.
    pub lengths_nm: Vec<f64>,
    /// Filaments with fixed sections.
    pub fixed: FixedSections,
    /// Default time step and number of records of a motion.
    pub estimate: Option<Estimate>,
}

/// Reason for the fixed sections of each filament; `None` if its sections may be replaced.
pub(super) type FixedSections = Vec<Option<&'static str>>;

/// Returns the scene with every monomer resolved and quadrature bonds.
///
/// Overdamped motion in heat uses quasi-harmonic interfaces, since bonds take ten thousand times longer.
pub(super) fn every_monomer(scene: &Scene) -> (Scene, FixedSections) {
    let (mut full, fixed) = every_monomer_of(scene, |_| true);
    for filament in full.filaments_mut() {
        filament.monomers = filament.monomers.with_quadrature_bonds();
    }
    if let Task::Brownian(task) = &mut full.task {
        task.interfaces.allow_long_steps(task.temperature_k);
    }
    (full, fixed)
}

/// Returns the scene with every monomer resolved in the filaments for which `is_free` returns true.
pub(super) fn every_monomer_of(
    scene: &Scene,
    is_free: impl Fn(usize) -> bool,
) -> (Scene, FixedSections) {
    let mut full = scene.clone();
    let why = |filament: usize| {
        if is_free(filament) {
            reason_fixed(scene, filament)
        } else {
            Some("the sections are given explicitly")
        }
    };
    let fixed: FixedSections = (0..scene.number_of_filaments()).map(why).collect();
    for (filament, fixed) in full.filaments_mut().zip(&fixed) {
        if fixed.is_none() {
            let to_nm = filament.length_nm();
            filament.sections = vec![monomers(0.0, to_nm)].into();
        }
    }
    (full, fixed)
}

/// Returns the scene with the record interval of the plan and without extra results of equilibria.
pub(super) fn with_records_of(mut scene: Scene, planned: &Scene) -> Scene {
    match (&mut scene.task, &planned.task) {
        (Task::Dynamics(one), Task::Dynamics(other)) => one.record_every_ns = other.record_every_ns,
        (Task::Brownian(one), Task::Brownian(other)) => one.record_every_ns = other.record_every_ns,
        _ => {}
    }
    if let Task::Equilibrium(settings) = &mut scene.task {
        (
            settings.states,
            settings.error_of,
            settings.lowest_eigenvalue,
        ) = (0, None, false);
    }
    scene
}

/// Returns the scene with sampled bonds in every interface.
pub(super) fn drawn(scene: &Scene, seed: u64) -> Scene {
    let mut drawn = scene.clone();
    for filament in drawn.filaments_mut() {
        let monomers = &mut filament.monomers;
        (monomers.anchors, monomers.seed) = (Anchors::Independent, seed);
        (monomers.lateral_bonds, monomers.longitudinal_bonds) = (DRAWN.0, DRAWN.0);
    }
    drawn
}

fn monomers(from_nm: f64, to_nm: f64) -> Section {
    Section::Ellipsoids {
        from_nm,
        to_nm,
        altered: None,
    }
}

fn reason_fixed(scene: &Scene, filament: usize) -> Option<&'static str> {
    let sections = &scene.filament_at(filament)?.sections;
    let mut clamps = scene.clamps.iter();
    if sections.iter().any(Section::is_altered) {
        Some("sections with altered monomers are not replaced")
    } else if clamps.any(|clamp| clamp.filament == filament && clamp.hold != Hold::Wall) {
        Some("a clamp other than `hold: Wall` requires a rod at this end")
    } else {
        None
    }
}

impl FullResolution {
    /// Assembles and plans a scene with every monomer.
    ///
    /// # Errors
    /// If the scene cannot be built or planned.
    pub(super) fn new(
        every: Scene,
        fixed: FixedSections,
    ) -> Result<(Self, Assembly), SceneProblem> {
        let assembly = Assembly::build(&every)?;
        let plan = Plan::new(&assembly)?;
        let filaments = 0..assembly.filaments.len();
        let full = Self {
            scene: with_records_of(every, plan.scene()),
            lengths_nm: filaments.map(|f| assembly.length_of(f)).collect(),
            fixed,
            estimate: plan.estimate().copied(),
        };
        Ok((full, assembly))
    }

    /// Default time step of a motion (ns).
    pub(super) fn default_ns(&self) -> Option<f64> {
        self.estimate.map(|estimate| estimate.time_step_ns)
    }

    pub(super) fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.fixed.len()).filter(|f| self.fixed[*f].is_none())
    }

    /// Returns the scene with monomers in the `windows` (nm) of each filament and rods of a law elsewhere.
    pub(super) fn resolved(
        &self,
        law: &RodLaw,
        segment_nm: f64,
        windows: &[Vec<[f64; 2]>],
    ) -> Scene {
        let rotary_inertia = match self.scene.task {
            Task::Dynamics(_) => RotaryInertia::RigidSegment,
            Task::Brownian(_) | Task::Equilibrium(_) => RotaryInertia::CrossSection,
        };
        let mut scene = self.with_sections(segment_nm, windows);
        for (filament, fixed) in scene.filaments_mut().zip(&self.fixed) {
            if fixed.is_none() && filament.sections.iter().any(Section::is_rod) {
                filament.rod = RodModel {
                    rotary_inertia,
                    ..RodModel::with_law(law.clone())
                };
            }
        }
        scene
    }

    /// Returns the scene with monomers in the `windows` (nm) of each filament; the rod model stays unchanged.
    pub(super) fn with_sections(&self, segment_nm: f64, windows: &[Vec<[f64; 2]>]) -> Scene {
        let mut scene = self.scene.clone();
        for (f, filament) in scene.filaments_mut().enumerate() {
            if self.fixed[f].is_none() {
                filament.sections = sections(self.lengths_nm[f], &windows[f], segment_nm).into();
            }
        }
        scene
    }

    /// Returns windows of `width_nm` about the `places` of each filament; `None` if they cover most of the length or nothing.
    pub(super) fn windows(
        &self,
        places: impl Fn(usize) -> Vec<f64>,
        width_nm: f64,
    ) -> Option<Vec<Vec<[f64; 2]>>> {
        let windows: Vec<Vec<[f64; 2]>> = (0..self.fixed.len())
            .map(|f| merged(places(f), width_nm, self.lengths_nm[f]))
            .collect();
        let of = |f: usize| windows[f].iter().map(|w| w[1] - w[0]).sum::<f64>();
        let resolved: f64 = self.free().map(of).sum();
        let length: f64 = self.free().map(|f| self.lengths_nm[f]).sum();
        (resolved > 0.0 && resolved < MOST_MONOMERS * length).then_some(windows)
    }

    pub(super) fn walls(&self, filament: usize) -> Vec<f64> {
        let clamps = self.scene.clamps.iter();
        let of = clamps.filter(|clamp| clamp.filament == filament);
        of.map(|clamp| self.end_nm(filament, clamp.end)).collect()
    }

    /// Returns the arc lengths (nm) of point loads, of the ends of distributed loads, and of linkers.
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

/// Returns sections of monomers in the windows and of rods elsewhere, with segments of about `segment_nm`.
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

/// Returns the number of segments with a length closest to `segment_nm`, at least 1, with segments that are permitted in a
/// heat bath.
fn segments(length_nm: f64, segment_nm: f64) -> usize {
    let most = (length_nm / Homogenised::SHORTEST_HEATED_NM).floor();
    to_count((length_nm / segment_nm).round().min(most).max(1.0))
}

/// Returns windows about `places`. Windows merge if the rod between them would be too short, and extend to an end of the
/// filament if the rod before the end would be too short. A window at an end lies inside the filament with its full width.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// 33 segments of 163 nm would be 4.94 nm long.
    #[test]
    fn segments_are_permitted_in_a_heat_bath() {
        for (length_nm, segment_nm, expected) in [
            (163.0, 5.0, 32),
            (163.0, 10.0, 16),
            (160.0, 5.0, 32),
            (3.0, 5.0, 1),
        ] {
            assert_eq!(segments(length_nm, segment_nm), expected, "{length_nm}");
        }
        for length_nm in (36..300).map(f64::from) {
            let count = segments(length_nm, 5.0) as f64;
            assert!(
                Homogenised::heated_rod(length_nm / count, 298.0).is_ok(),
                "{length_nm}"
            );
        }
    }
}
