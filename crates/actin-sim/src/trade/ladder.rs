//! Candidates of a scene in the order of their runs: longer steps, rods, windows of monomers, single filaments as rods.

use super::resolution::{FullResolution, Rods};
use crate::scene::{Integrator, Monomers, RodLaw, RotaryInertia, Scene, Section, Task};

/// Time step of position Verlet candidates as a fraction of the stability limit.
const LONGEST: f64 = 0.9;

/// Time steps of overdamped candidates in units of the default step.
const MULTIPLES: [u32; 2] = [4, 20];

#[derive(Clone, Debug)]
pub(super) struct Proposal {
    pub name: String,
    pub scene: Scene,
}

/// Returns the scene at half of its default step.
pub(super) fn at_half_step(scene: &Scene, default_ns: Option<f64>) -> Scene {
    let mut half = scene.clone();
    match &mut half.task {
        Task::Equilibrium(_) => {}
        Task::Dynamics(dynamics) => match &mut dynamics.time_step_ns {
            Some(step) => *step *= 0.5,
            None => dynamics.step_safety *= 0.5,
        },
        Task::Brownian(brownian) => brownian.time_step_ns = default_ns.map(|step| 0.5 * step),
    }
    half
}

/// Returns the scene with longer steps and cheaper integrators; `default_ns` is its default step.
pub(super) fn steps(scene: &Scene, default_ns: Option<f64>) -> Vec<Proposal> {
    let name = |what: &str| format!("every monomer, {what}");
    let mut all = Vec::new();
    if scene.thermal().is_some() {
        return all;
    }
    if !matches!(scene.task, Task::Equilibrium(_)) {
        all.push(Proposal {
            name: name("default step"),
            scene: scene.clone(),
        });
    }
    match (&scene.task, default_ns) {
        (Task::Dynamics(_), _) => all.push(Proposal {
            name: name("position Verlet at 0.9 of the stable step"),
            scene: quick(scene, default_ns),
        }),
        (Task::Brownian(_), Some(step_ns)) => all.extend(MULTIPLES.map(|multiple| Proposal {
            name: name(&format!("{multiple} times the default step")),
            scene: with_step(scene, f64::from(multiple) * step_ns),
        })),
        _ => {}
    }
    all
}

fn with_step(scene: &Scene, step_ns: f64) -> Scene {
    let mut scene = scene.clone();
    if let Task::Brownian(brownian) = &mut scene.task {
        let interval_ns = brownian.record_every_ns.unwrap_or(f64::INFINITY);
        brownian.time_step_ns = Some(step_ns.min(interval_ns));
    }
    scene
}

fn quick(scene: &Scene, default_ns: Option<f64>) -> Scene {
    let mut scene = scene.clone();
    let is_hot = scene.thermal().is_some();
    match &mut scene.task {
        Task::Equilibrium(_) => {}
        Task::Brownian(brownian) if is_hot => brownian.time_step_ns = None,
        Task::Dynamics(_) if is_hot => {}
        Task::Dynamics(dynamics) => {
            dynamics.time_step_ns = None;
            dynamics.step_safety = LONGEST;
            dynamics.integrator = Integrator::PositionVerlet;
        }
        Task::Brownian(_) => {
            if let Some(step_ns) = default_ns {
                return with_step(&scene, f64::from(MULTIPLES[0]) * step_ns);
            }
        }
    }
    scene
}

struct Places<'a> {
    full: &'a FullResolution,
    bends_most: &'a [Option<f64>],
}

impl Places<'_> {
    fn walls_and_sites(&self, filament: usize) -> Vec<f64> {
        let (walls, sites) = (self.full.walls(filament), self.full.sites(filament));
        [walls, sites].concat()
    }

    fn rods(&self, rods: &[(RodLaw, f64)]) -> impl Iterator<Item = Proposal> {
        rods.iter().map(|(law, segment_nm)| {
            let rods = self::rods(&self.full.scene, law, *segment_nm);
            Proposal {
                name: rods.name(),
                scene: self.full.resolved(&rods, &self.full.no_windows()),
            }
        })
    }

    /// Returns filaments of rods with windows of monomers, where these leave room for rods.
    fn all_windows(&self, windows: &[(Kind, f64, RodLaw, f64)]) -> impl Iterator<Item = Proposal> {
        windows
            .iter()
            .filter_map(|(kind, width_nm, law, segment_nm)| {
                let windows = self.windows(*kind, *width_nm)?;
                let rods = rods(&self.full.scene, law, *segment_nm);
                Some(Proposal {
                    name: format!("{width_nm} nm {}, {}", kind.name(), rods.name()),
                    scene: self.full.resolved(&rods, &windows),
                })
            })
    }

    fn windows(&self, of: Kind, width_nm: f64) -> Option<Vec<Vec<[f64; 2]>>> {
        self.full.windows(
            |filament| match of {
                Kind::Everywhere => self.walls_and_sites(filament),
                Kind::Sites => self.full.sites(filament),
                Kind::Bend => Vec::from_iter(self.bends_most[filament]),
            },
            width_nm,
        )
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Everywhere,
    Sites,
    Bend,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Everywhere => "at walls, loads and linkers",
            Self::Sites => "at loads and linkers",
            Self::Bend => "where it bends most",
        }
    }
}

use RodLaw::{Constant, Fitted, Homogenised};

/// Smallest number of resolutions without `--all`, where windows leave room for as many.
const FEWEST: usize = 8;

/// Laws and segment lengths (nm) of all-rod candidates: by default, and for `--all` or short filaments.
const RODS: [(RodLaw, f64); 5] = [
    (Fitted, 40.0),
    (Homogenised, 40.0),
    (Fitted, 20.0),
    (Homogenised, 20.0),
    (Homogenised, 10.0),
];
const MORE_RODS: [(RodLaw, f64); 5] = [
    (Fitted, 10.0),
    (Fitted, 5.0),
    (Homogenised, 5.0),
    (Constant, 40.0),
    (Constant, 20.0),
];

/// Windows of monomers: centres, width (nm), and law and segment length (nm) of the rods between them.
const WINDOWS: [(Kind, f64, RodLaw, f64); 4] = [
    (Kind::Everywhere, 20.0, Fitted, 20.0),
    (Kind::Everywhere, 40.0, Homogenised, 40.0),
    (Kind::Sites, 40.0, Homogenised, 20.0),
    (Kind::Bend, 80.0, Homogenised, 40.0),
];
const MORE_WINDOWS: [(Kind, f64, RodLaw, f64); 4] = [
    (Kind::Everywhere, 20.0, Homogenised, 20.0),
    (Kind::Everywhere, 40.0, Fitted, 20.0),
    (Kind::Everywhere, 80.0, Homogenised, 20.0),
    (Kind::Bend, 40.0, Homogenised, 20.0),
];

/// Returns candidates of rods, and of rods with windows of monomers.
///
/// `bends_most` is the arc length (nm) of the largest curvature of each filament in the reference.
pub(super) fn resolutions(
    full: &FullResolution,
    default_ns: Option<f64>,
    bends_most: &[Option<f64>],
    is_all: bool,
) -> Vec<Proposal> {
    let full = FullResolution {
        scene: quick(&full.scene, default_ns),
        ..full.clone()
    };
    let places = Places {
        full: &full,
        bends_most,
    };
    let default = places.rods(&RODS).chain(places.all_windows(&WINDOWS));
    let mut all = Vec::new();
    for proposal in default.chain(single_rods(&full)) {
        push_new(&mut all, proposal);
    }
    let more_windows = places.all_windows(&MORE_WINDOWS);
    for proposal in places.rods(&MORE_RODS).chain(more_windows) {
        if is_all || all.len() < FEWEST {
            push_new(&mut all, proposal);
        }
    }
    if is_all {
        push_new(&mut all, with_eight_bonds(&full.scene));
    }
    all
}

fn push_new(all: &mut Vec<Proposal>, proposal: Proposal) {
    if all.iter().all(|known| known.scene != proposal.scene) {
        all.push(proposal);
    }
}

/// Resolutions of `Adaptive`: segment lengths (nm) of all-rod filaments, and windows of monomers with their width (nm) and
/// the segment length of the rods between them (nm).
const SEGMENTS_NM: [f64; 3] = [40.0, 20.0, 10.0];
const CHOSEN: [(Kind, f64, f64); 5] = [
    (Kind::Everywhere, 20.0, 20.0),
    (Kind::Everywhere, 40.0, 20.0),
    (Kind::Everywhere, 80.0, 20.0),
    (Kind::Sites, 40.0, 20.0),
    (Kind::Sites, 40.0, 40.0),
];

/// Returns the candidates of `Adaptive`, with the rods and the time step of the scene.
pub(super) fn sections(full: &FullResolution) -> Vec<Proposal> {
    let places = Places {
        full,
        bends_most: &[],
    };
    let of_rods = SEGMENTS_NM.map(|segment_nm| {
        let name = format!("a rod of segments of {segment_nm} nm");
        (name, segment_nm, Some(full.no_windows()))
    });
    let of_windows = CHOSEN.map(|(kind, width_nm, segment_nm)| {
        let name = format!(
            "{width_nm} nm of monomers {}, and a rod of segments of {segment_nm} nm",
            kind.name()
        );
        (name, segment_nm, places.windows(kind, width_nm))
    });
    let all = of_rods.into_iter().chain(of_windows);
    all.filter_map(|(name, segment_nm, windows)| {
        let scene = full.with_sections(segment_nm, &windows?);
        Some(Proposal { name, scene })
    })
    .collect()
}

/// Returns references from coarse to fine for scenes with too many monomers: rods, then windows of increasing width.
pub(super) fn references(full: &FullResolution) -> Vec<Proposal> {
    let rods = rods(&full.scene, &Homogenised, 20.0);
    let places = Places {
        full,
        bends_most: &[],
    };
    let coarse = self::rods(&full.scene, &Homogenised, 40.0);
    let first = Proposal {
        name: coarse.name(),
        scene: full.resolved(&coarse, &full.no_windows()),
    };
    let none = (rods.name(), Some(full.no_windows()));
    let widths = [20.0, 40.0, 80.0].map(|width_nm| {
        let windows = places.windows(Kind::Everywhere, width_nm);
        let name = format!("{width_nm} nm {}, {}", Kind::Everywhere.name(), rods.name());
        (name, windows)
    });
    let finer = [none].into_iter().chain(widths);
    let finer = finer.filter_map(|(name, windows)| {
        let scene = full.resolved(&rods, &windows?);
        Some(Proposal { name, scene })
    });
    [first].into_iter().chain(finer).collect()
}

fn rods(scene: &Scene, law: &RodLaw, segment_nm: f64) -> Rods {
    let inertia = match scene.task {
        Task::Dynamics(_) => RotaryInertia::RigidSegment,
        Task::Brownian(_) | Task::Equilibrium(_) => RotaryInertia::CrossSection,
    };
    Rods {
        law: law.clone(),
        segment_nm,
        inertia,
    }
}

impl Rods {
    fn name(&self) -> String {
        let law = match self.law {
            Fitted => "Fitted",
            Constant => "Constant",
            _ => "Homogenised",
        };
        format!("rod {law} {} nm", self.segment_nm)
    }
}

fn single_rods(full: &FullResolution) -> Vec<Proposal> {
    let free: Vec<usize> = full.free().collect();
    if free.len() < 2 || free.len() > 4 {
        return Vec::new();
    }
    let of = |one: usize| {
        let rods = rods(&full.scene, &Homogenised, 20.0);
        let windows = (0..full.fixed.len()).map(|f| {
            let whole_nm = [0.0, full.lengths_nm[f]];
            if f == one { Vec::new() } else { vec![whole_nm] }
        });
        Proposal {
            name: format!("filament {one} as {}", rods.name()),
            scene: full.resolved(&rods, &windows.collect::<Vec<_>>()),
        }
    };
    free.into_iter().map(of).collect()
}

fn with_eight_bonds(scene: &Scene) -> Proposal {
    let mut scene = scene.clone();
    for filament in scene.filaments_mut() {
        if filament
            .sections
            .iter()
            .any(|section| !Section::is_rod(section))
        {
            filament.monomers = Monomers {
                lateral_bonds: 8,
                longitudinal_bonds: 8,
                ..filament.monomers.clone()
            };
        }
    }
    Proposal {
        name: "every monomer, 8 bonds".to_owned(),
        scene,
    }
}
