//! How many Newton steps equilibria take: counts on the scenes of `cargo xtask tradeoff` and on long
//! filaments, by what a filament is made of and how it is led to its equilibrium.

use crate::scene::{Anchors, Equilibrium, Filament, Setting, Task};
use crate::{Assembly, SectionSpan, near_equilibrium};
use actin_mechanics::Vector3;

/// What a filament is made of, by the number of Newton steps it takes: the slowest of a scene counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    /// Rods of constant rigidities.
    Constant,
    /// Rods under a law that follows curvature, twist or shear.
    Law,
    /// Monomers, whose bonds hardly resist at rest and stiffen where they are strained.
    Monomers,
}

/// Steps of one equilibrium for each [`Kind`], in their order.
type Steps = [f64; 3];

/// From the state as built, of what is clamped: 4 to 5, 7 to 48, and 9 to 13 on 60 monomers.
const FROM_REST: Steps = [5.0, 24.0, 12.0];
/// From the state as built, of what nothing but linkers holds: 16 to 44, 29 to 44, 12 to 63.
const FLOATING: Steps = [32.0, 34.0, 27.0];
/// Of a path from one to the next, turned, pulled or loaded: up to 1, 2, 8 to 10.
const DRIVEN: Steps = [0.5, 2.0, 9.0];
/// The same where the ends of a filament are pushed together, which buckles: 15, 20 to 40, 40 to 50.
const PUSHED: Steps = [15.0, 29.0, 42.0];

/// From a random start about an equilibrium to a stable state: 50 to 72, 213 to 247, and, of bonds that snap, some
/// 4000.
const SEARCHED: Steps = [60.0, 230.0, 4000.0];

/// More monomers in a row than these take more steps from rest, by a power of their number.
const SHORT: f64 = 60.0;
/// That power. Drawn bonds: 28 of 300, 44 of 600, 69 of 1200, 141 of 2400. Weighted ones, which leave all
/// monomers alike, so that nothing keeps the borders of patches that give way to one side or the other:
/// 61, 77, 309, 307, and 1030 of 5842.
const GROWTH_DRAWN: f64 = 0.62;
const GROWTH_WEIGHTED: f64 = 0.95;

/// From a state near the equilibrium: 7 to 11 of 1461 to 5842 monomers with weighted bonds.
const FROM_NEAR: f64 = 11.0;

/// Newton steps that one certificate is worth, and what is found once for a solver: where the entries
/// of the stiffness and of its factor stand.
const CERTIFICATE: f64 = 2.5;
const SYMBOLIC: f64 = 2.0;

/// Newton steps of all equilibria of a scene, and how many equilibria those are, about.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the conversion saturates, and a count is positive"
)]
pub(super) fn steps(assembly: &Assembly) -> (u64, u64) {
    let Task::Equilibrium(task) = &assembly.scene.task else {
        return (0, 0);
    };
    let kind = kind(assembly);
    let scene = &assembly.scene;
    let from_rest = from_rest(assembly, kind);
    let starts = task.states as f64;
    let searched = starts * SEARCHED[kind as usize];
    if scene.path.is_empty() {
        return ((from_rest + searched) as u64, 1 + starts as u64);
    }
    let each = points_of_stage(task);
    let stages = scene.path.iter().enumerate().map(|(i, stage)| {
        let pushed = stage.set.iter().any(|setting| pushes(assembly, i, setting));
        let of = if pushed { PUSHED } else { DRIVEN };
        each * of[kind as usize]
    });
    // Loads that no stage sets act from the start.
    let is_loaded = !scene.linkers.is_empty() || scene.loads.len() > set_loads(assembly);
    let first = if is_loaded { from_rest } else { 0.0 };
    let steps = first + stages.sum::<f64>() + searched;
    let equilibria = 1.0 + each * scene.path.len() as f64 + starts;
    (steps.round() as u64, equilibria as u64)
}

/// Newton steps, each of which assembles and factorises, that all of this is worth.
pub(super) fn counted(steps: u64, equilibria: u64) -> f64 {
    steps as f64 + CERTIFICATE * equilibria as f64 + SYMBOLIC
}

/// The slowest kind of a scene's filaments.
fn kind(assembly: &Assembly) -> Kind {
    let each = assembly.scene.filaments().enumerate().map(|(i, filament)| {
        let mut laws = filament.rod_models().map(|rod| rod.law);
        if assembly
            .sections_of(i)
            .iter()
            .any(SectionSpan::is_ellipsoids)
        {
            Kind::Monomers
        } else if laws.all(|law| law.is_published()) {
            Kind::Constant
        } else {
            Kind::Law
        }
    });
    each.max().unwrap_or(Kind::Constant)
}

/// Steps from the state as built; none where nothing acts.
fn from_rest(assembly: &Assembly, kind: Kind) -> f64 {
    let scene = &assembly.scene;
    if scene.linkers.is_empty() && scene.loads.is_empty() {
        return 0.0;
    }
    if scene.clamps.is_empty() {
        return FLOATING[kind as usize];
    }
    if near_equilibrium(assembly).is_some() {
        return FROM_NEAR;
    }
    let sections = assembly.sections.iter().filter(|s| s.is_ellipsoids());
    let longest = sections.map(|section| section.points.len()).max();
    let rows = longest.unwrap_or(0) as f64 / SHORT;
    let mut rods = (assembly.scene.filaments()).flat_map(Filament::rod_models);
    let has_law = rods.any(|rod| !rod.law.is_published());
    let of_rods = match kind {
        Kind::Monomers if has_law => FROM_REST[Kind::Law as usize],
        _ => 0.0,
    };
    let weighted = assembly
        .scene
        .filaments()
        .any(|one| one.monomers.anchors == Anchors::Cubature);
    let growth = if weighted {
        GROWTH_WEIGHTED
    } else {
        GROWTH_DRAWN
    };
    (FROM_REST[kind as usize] * rows.max(1.0).powf(growth)).max(of_rods)
}

/// Equilibria of a stage: steps of the largest length, and a few shorter ones at its start.
fn points_of_stage(task: &Equilibrium) -> f64 {
    (1.0 / task.largest_step).ceil() + 2.0
}

/// How many loads some stage sets.
fn set_loads(assembly: &Assembly) -> usize {
    let mut set = vec![false; assembly.scene.loads.len()];
    let settings = assembly.scene.path.iter().flat_map(|stage| &stage.set);
    for setting in settings {
        if let Setting::LoadFactor { load, .. } = setting {
            set[*load] = true;
        }
    }
    set.iter().filter(|is_set| **is_set).count()
}

/// Whether a setting of stage `i` pushes a filament together: a shift of an end towards the other, or
/// a load along the filament towards a held end.
fn pushes(assembly: &Assembly, i: usize, setting: &Setting) -> bool {
    let scene = &assembly.scene;
    match *setting {
        Setting::Shift {
            filament,
            end,
            shift_nm,
        } => {
            let axis = assembly.filaments[filament].axis();
            let before = assembly
                .drive
                .shift_after(filament_clamp(assembly, filament, end), i);
            let moved = (Vector3::from(shift_nm) - before).dot(&axis);
            let inward = if end == crate::End::Start {
                moved
            } else {
                -moved
            };
            let other = match end {
                crate::End::Start => crate::End::End,
                crate::End::End => crate::End::Start,
            };
            inward > 0.0 && assembly.clamp_at(filament, other).is_some()
        }
        Setting::LoadFactor { load, factor } => {
            let load = &scene.loads[load];
            load.presses(factor, assembly.filaments[load.filament()].axis())
        }
        Setting::Turn { .. } | Setting::Anchor { .. } => false,
    }
}

/// The index of the clamp that a shift moves, which validation asks for.
fn filament_clamp(assembly: &Assembly, filament: usize, end: crate::End) -> usize {
    let clamp = assembly.held.clamp_at(filament, end);
    clamp.expect("only held ends are shifted")
}
