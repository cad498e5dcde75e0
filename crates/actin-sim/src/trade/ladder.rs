//! Candidates of a scene in the order of their runs: longer steps, rods, windows of monomers, single filaments as rods.

use super::resolution::FullResolution;
use crate::scene::{Integrator, RodLaw, Scene, Section, Task};

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
pub(super) fn at_half_step(full: &FullResolution) -> Scene {
    let mut half = full.scene.clone();
    match &mut half.task {
        Task::Equilibrium(_) => {}
        Task::Dynamics(dynamics) => match &mut dynamics.time_step_ns {
            Some(step) => *step *= 0.5,
            None => dynamics.step_safety *= 0.5,
        },
        Task::Brownian(brownian) => {
            brownian.time_step_ns = full.default_ns().map(|step| 0.5 * step);
        }
    }
    half
}

/// Returns the scene with longer steps and cheaper integrators.
pub(super) fn steps(full: &FullResolution) -> Vec<Proposal> {
    let (scene, default_ns) = (&full.scene, full.default_ns());
    let every = |what: &str, scene| Proposal {
        name: format!("every monomer, {what}"),
        scene,
    };
    let default = || every("default step", scene.clone());
    match (&scene.task, default_ns) {
        _ if scene.thermal().is_some() => Vec::new(),
        (Task::Equilibrium(_), _) => Vec::new(),
        (Task::Dynamics(_), _) => {
            let verlet = quick(scene, default_ns);
            vec![
                default(),
                every("position Verlet at 0.9 of the stable step", verlet),
            ]
        }
        (Task::Brownian(_), default_ns) => {
            let longer = default_ns.into_iter().flat_map(|step_ns| {
                MULTIPLES.map(|multiple| {
                    let longer = with_step(scene, f64::from(multiple) * step_ns);
                    every(&format!("{multiple} times the default step"), longer)
                })
            });
            std::iter::once(default()).chain(longer).collect()
        }
    }
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

/// Windows of monomers in a candidate: their centres and their width (nm); `None` for rods only.
type Windows = Option<(Centres, f64)>;

/// Windows of a candidate, and law and segment length (nm) of its rods.
type Resolution = (Windows, RodLaw, f64);

/// Centres of windows.
#[derive(Clone, Copy)]
enum Centres {
    Everywhere,
    Sites,
    Bend,
}

impl Centres {
    fn name(self) -> &'static str {
        match self {
            Self::Everywhere => "at walls, loads and linkers",
            Self::Sites => "at loads and linkers",
            Self::Bend => "where it bends most",
        }
    }
}

use Centres::{Bend, Everywhere, Sites};
use RodLaw::{Constant, Fitted, Homogenised};

/// Smallest number of resolutions without `--all`, where windows leave room for as many.
const FEWEST: usize = 8;

/// Resolutions by default, and for `--all` or short filaments.
const DEFAULT: [Resolution; 9] = [
    (None, Fitted, 40.0),
    (None, Homogenised, 40.0),
    (None, Fitted, 20.0),
    (None, Homogenised, 20.0),
    (None, Homogenised, 10.0),
    (Some((Everywhere, 20.0)), Fitted, 20.0),
    (Some((Everywhere, 40.0)), Homogenised, 40.0),
    (Some((Sites, 40.0)), Homogenised, 20.0),
    (Some((Bend, 80.0)), Homogenised, 40.0),
];
const MORE: [Resolution; 9] = [
    (None, Fitted, 10.0),
    (None, Fitted, 5.0),
    (None, Homogenised, 5.0),
    (None, Constant, 40.0),
    (None, Constant, 20.0),
    (Some((Everywhere, 20.0)), Homogenised, 20.0),
    (Some((Everywhere, 40.0)), Fitted, 20.0),
    (Some((Everywhere, 80.0)), Homogenised, 20.0),
    (Some((Bend, 40.0)), Homogenised, 20.0),
];

/// References for scenes with too many monomers, from coarse to fine.
const REFERENCES: [Resolution; 5] = [
    (None, Homogenised, 40.0),
    (None, Homogenised, 20.0),
    (Some((Everywhere, 20.0)), Homogenised, 20.0),
    (Some((Everywhere, 40.0)), Homogenised, 20.0),
    (Some((Everywhere, 80.0)), Homogenised, 20.0),
];

/// Resolutions of `Adaptive`: windows of monomers, and segment length (nm) of the rods.
const CHOSEN: [(Windows, f64); 8] = [
    (None, 40.0),
    (None, 20.0),
    (None, 10.0),
    (Some((Everywhere, 20.0)), 20.0),
    (Some((Everywhere, 40.0)), 20.0),
    (Some((Everywhere, 80.0)), 20.0),
    (Some((Sites, 40.0)), 20.0),
    (Some((Sites, 40.0)), 40.0),
];

struct Places<'a> {
    full: &'a FullResolution,
    /// Arc length (nm) of the largest curvature of each filament in the reference.
    bends_most: &'a [Option<f64>],
}

impl Places<'_> {
    /// Returns the candidate of a resolution; `None` if its windows leave no room for rods.
    fn proposal(&self, (windows, law, segment_nm): &Resolution) -> Option<Proposal> {
        let rods = name_of(law, *segment_nm);
        let name = match windows {
            None => rods,
            Some((centres, width_nm)) => format!("{width_nm} nm {}, {rods}", centres.name()),
        };
        let windows = self.windows(*windows)?;
        let scene = self.full.resolved(law, *segment_nm, &windows);
        Some(Proposal { name, scene })
    }

    fn windows(&self, windows: Windows) -> Option<Vec<Vec<[f64; 2]>>> {
        let Some((centres, width_nm)) = windows else {
            return Some(vec![Vec::new(); self.full.fixed.len()]);
        };
        let places = |filament| match centres {
            Everywhere => [self.full.walls(filament), self.full.sites(filament)].concat(),
            Sites => self.full.sites(filament),
            Bend => Vec::from_iter(self.bends_most[filament]),
        };
        self.full.windows(places, width_nm)
    }
}

fn name_of(law: &RodLaw, segment_nm: f64) -> String {
    let law = match law {
        Fitted => "Fitted",
        Constant => "Constant",
        _ => "Homogenised",
    };
    format!("rod {law} {segment_nm} nm")
}

/// Returns candidates of rods, and of rods with windows of monomers.
///
/// `bends_most` is the arc length (nm) of the largest curvature of each filament in the reference.
pub(super) fn resolutions(
    full: &FullResolution,
    bends_most: &[Option<f64>],
    is_all: bool,
) -> Vec<Proposal> {
    let full = FullResolution {
        scene: quick(&full.scene, full.default_ns()),
        ..full.clone()
    };
    let places = Places {
        full: &full,
        bends_most,
    };
    let default = DEFAULT.iter().filter_map(|one| places.proposal(one));
    let mut all = Vec::new();
    for proposal in default.chain(single_rods(&full)) {
        push_new(&mut all, proposal);
    }
    for proposal in MORE.iter().filter_map(|one| places.proposal(one)) {
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

/// Returns the candidates of `Adaptive`, with the rods and the time step of the scene.
pub(super) fn sections(full: &FullResolution) -> impl Iterator<Item = Proposal> {
    let places = Places {
        full,
        bends_most: &[],
    };
    CHOSEN.iter().filter_map(move |&(windows, segment_nm)| {
        let rod = format!("a rod of segments of {segment_nm} nm");
        let name = match windows {
            None => rod,
            Some((centres, width_nm)) => {
                format!("{width_nm} nm of monomers {}, and {rod}", centres.name())
            }
        };
        let scene = full.with_sections(segment_nm, &places.windows(windows)?);
        Some(Proposal { name, scene })
    })
}

/// Returns references from coarse to fine for scenes with too many monomers: rods, then windows of increasing width.
pub(super) fn references(full: &FullResolution) -> impl Iterator<Item = Proposal> {
    let places = Places {
        full,
        bends_most: &[],
    };
    REFERENCES
        .iter()
        .filter_map(move |one| places.proposal(one))
}

/// Returns candidates with a single filament of rods, for two to four filaments.
fn single_rods(full: &FullResolution) -> Vec<Proposal> {
    let free: Vec<usize> = full.free().collect();
    if free.len() < 2 || free.len() > 4 {
        return Vec::new();
    }
    let of = |one: usize| {
        let windows = (0..full.fixed.len()).map(|f| {
            let whole_nm = [0.0, full.lengths_nm[f]];
            if f == one { Vec::new() } else { vec![whole_nm] }
        });
        Proposal {
            name: format!("filament {one} as {}", name_of(&Homogenised, 20.0)),
            scene: full.resolved(&Homogenised, 20.0, &windows.collect::<Vec<_>>()),
        }
    };
    free.into_iter().map(of).collect()
}

fn with_eight_bonds(scene: &Scene) -> Proposal {
    let mut scene = scene.clone();
    for filament in scene.filaments_mut() {
        if !filament.sections.iter().all(Section::is_rod) {
            filament.monomers.lateral_bonds = 8;
            filament.monomers.longitudinal_bonds = 8;
        }
    }
    Proposal {
        name: "every monomer, 8 bonds".to_owned(),
        scene,
    }
}
