//! How wrong a result is for the resolution that it was computed with, and a resolution that is good enough.
//!
//! [`estimate`] is what to call first: the error of one number of an equilibrium against the same filament with
//! every monomer resolved, which is not computed. What the laws of rods, junctions and walls do otherwise than
//! monomers under the same loads is found from periods of monomers (`ideal.rs`, `cells.rs`, `defects.rs`) and short
//! filaments at ends (`wall.rs`, `short.rs`) and where something acts inside (`site.rs`); what that does to the number
//! follows from one linear solve (`adjoint.rs`). The
//! part of the segments' lengths comes from halving them (`halving.rs`). [`choose`] resolves as monomers what the
//! number needs, and grades the lengths of segments (`grade.rs`).
//!
//! # Source
//! Dual-weighted residuals: R. Becker and R. Rannacher, Acta Numerica 10 (2001) 1. Of model errors: J. T. Oden and
//! S. Prudhomme, J. Comput. Phys. 182 (2002) 496.

mod adjoint;
mod cells;
mod choose;
mod chosen;
mod defects;
mod finer;
mod grade;
mod halving;
mod ideal;
mod nearby;
mod runs;
mod sampling;
mod scatter;
mod section_loads;
mod setting;
mod short;
mod site;
mod stretch;
mod wall;

#[cfg(test)]
mod graded_tests;
#[cfg(test)]
mod tests;

pub use choose::choose;
pub use chosen::{Chosen, Tried};
pub use finer::finer;
pub use scatter::{Scatter, scatter};
pub use stretch::RodStretch;

use crate::scene::{Equilibrium, Hold, Quantity, Scene, SceneProblem, Section, Slides, Task};
use crate::{Assembly, End, Plan, RunError};
use actin_mechanics::State;
use adjoint::Adjoint;
use cells::Cells;
use defects::{Contribution, Look};
pub(crate) use ideal::{EndlessFilament, PERIOD};
use runs::{Run, runs};
use section_loads::SectionLoads;
use serde::{Deserialize, Serialize};

/// Share of a number that the part of the law may miss in an estimate.
const MISSED: f64 = 5e-5;
/// Rises below which the ends of a filament are not told apart.
const SHORTEST_RISES: f64 = 16.0;

fn is_too_short(length_nm: f64, rise_nm: f64) -> bool {
    length_nm < SHORTEST_RISES * rise_nm
}

/// How far a number of an equilibrium is from that of the same filament with every monomer resolved.
///
/// To first order in what rods and junctions do wrong. Monomers are those of the mean filament or, where the scene
/// draws bonds for each interface, the mean over drawings, about which filaments scatter. Left out are strains that change over
/// the length of a few bonds, but for those at ends and where something acts, other states that monomers have where they are under-twisted
/// and bent (a run that estimates an error notes where), and errors of the second order: those of laws without twist-stretch coupling
/// (`Constant`) may be as large as the first. Left out, too, is what monomers do where a couple acts on a free end or, of a
/// curvature, within two periods of its place; what a couple across the axis does inside a rod (1 % of a tip) is not told well.
/// A rod that ends between two places of the lattice is longer or shorter than monomers can be; that is no part of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorEstimate {
    /// Of what.
    pub quantity: Quantity,
    /// Its value, in its [unit](Quantity::unit).
    pub value: f64,
    /// What is to be added to it: the sum of the parts.
    pub error: f64,
    /// From the laws of rods, with what rods do beside their ends taken from the number.
    pub law: f64,
    /// From the lengths of segments.
    pub segments: f64,
    /// From junctions.
    pub junctions: f64,
    /// From what monomers do at walls that hold rods, and at tips that bear a force. It may cancel with what rods do there;
    /// each is doubted for itself.
    pub walls: f64,
    /// From what monomers do about places inside rods at which a linker holds or a force or couple acts.
    pub sites: f64,
}

impl ErrorEstimate {
    /// One whose error is that of the lengths of segments alone.
    fn of_segments(quantity: Quantity, value: f64, segments: f64) -> Self {
        Self {
            quantity,
            value,
            error: segments,
            law: 0.0,
            segments,
            junctions: 0.0,
            walls: 0.0,
            sites: 0.0,
        }
    }

    /// The value with the error added.
    pub fn corrected(&self) -> f64 {
        self.value + self.error
    }

    /// The sum of the sizes of its parts.
    fn size_of_parts(&self) -> f64 {
        self.law.abs()
            + self.segments.abs()
            + self.junctions.abs()
            + self.walls.abs()
            + self.sites.abs()
    }

    /// The estimate in a sentence, with how filaments with drawn bonds scatter, where it is known; none of a number that
    /// is zero.
    pub(crate) fn note(&self, scatter: Option<&Scatter>) -> Option<String> {
        let percent = |part: f64| 100.0 * part / self.corrected().abs();
        let all = [
            self.error,
            self.law,
            self.segments,
            self.junctions,
            self.walls,
            self.sites,
        ];
        if !all.iter().all(|part| percent(*part).is_finite()) {
            return None;
        }
        let drawn = scatter.map_or_else(String::new, |drawn| {
            let bonds = match drawn.bonds {
                [lateral, longitudinal] if lateral == longitudinal => lateral.to_string(),
                [lateral, longitudinal] => format!("{lateral} and {longitudinal}"),
            };
            format!(
                "; filaments with {bonds} drawn bonds an interface are {:+.2} % from the mean one, and scatter by {:.2} %",
                percent(drawn.shift),
                percent(drawn.deviation)
            )
        });
        let [error, law, segments, junctions, walls, sites] = all.map(percent);
        Some(format!(
            "{} is {}, {} with its estimated error against every monomer ({error:+.2} %: laws {law:+.2}, segments \
             {segments:+.2}, junctions {junctions:+.2}, walls {walls:+.2}, sites {sites:+.2}){drawn}",
            self.quantity,
            self.quantity.show(self.value),
            self.quantity.show(self.corrected()),
        ))
    }

    /// The size of the error over that of the corrected value.
    pub fn relative(&self) -> f64 {
        (self.error / self.corrected()).abs()
    }
}

/// An estimate with where its parts come from.
#[derive(Clone, Debug)]
struct Located {
    total: ErrorEstimate,
    /// Of laws, walls and sites.
    parts: Vec<Contribution>,
    /// Where monomers have several states, of which rods know one (nm).
    several_states: Vec<[f64; 2]>,
}

/// The error of a number of an equilibrium of `assembly`, in whose scene everything stands for itself: `state` is the
/// equilibrium that its task leads to.
///
/// ```
/// use actin_sim::adapt::estimate;
/// use actin_sim::{Assembly, Plan, Quantity, Scene};
/// let text = "Scene(
///     filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 160.2)], rod: RodModel(law: Constant)),
///     clamps: [Clamp(end: Start)],
///     loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
///     task: Equilibrium(),
/// )";
/// let assembly = Assembly::build(&Scene::from_ron(text)?)?;
/// let (trajectory, _) = Plan::new(&assembly)?.run()?;
/// let error = estimate(&assembly, &trajectory.records[0].state, Quantity::Tip)?;
/// // Monomers give 62.99 nm.
/// assert!((error.value - 61.73).abs() < 0.01 && (error.corrected() - 62.99).abs() < 0.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Scenes of which errors are not known: several filaments, filaments built along a curve, altered, shorter than 16
/// rises, held by nothing or not by `Wall`, a heat bath, a quantity that the scene does not have; and where a short filament or a period of monomers finds no equilibrium.
pub fn estimate(
    assembly: &Assembly,
    state: &State,
    quantity: Quantity,
) -> Result<ErrorEstimate, SceneProblem> {
    let cells = Cells::of(assembly.monomers_of(0))?;
    let located = located((assembly, state), quantity, (&cells, MISSED));
    located.map(|located| located.total)
}

/// The number itself in some state, in its [unit](Quantity::unit).
pub fn value(assembly: &Assembly, state: &State, quantity: Quantity) -> f64 {
    Adjoint::value_of(quantity, assembly, state)
}

/// The same with where it comes from; with cells that are known, and the share of the number that the law's part may miss.
fn located(
    (assembly, state): (&Assembly, &State),
    quantity: Quantity,
    (cells, missed): (&Cells, f64),
) -> Result<Located, SceneProblem> {
    ensure_known(assembly, quantity)?;
    let look = Look {
        assembly,
        state,
        loads: &SectionLoads::of(assembly, state),
        adjoint: &Adjoint::of(quantity, assembly, state)?,
        cells,
        missed,
    };
    let runs = runs(assembly);
    let mut parts = Vec::new();
    for (span, rod) in runs.iter().filter_map(|run| Some((&run.span, run.rod?))) {
        parts.extend(look.law(span, rod).ok_or_else(wall::no_cell)?);
        parts.extend(look.ends_of_rod(span, rod));
    }
    parts.extend(look.drawn(&runs)?);
    let (law, junctions) = (sum(&parts), sum(&look.junctions(&runs)?));
    let (at_ends, at_sites) = (look.ends(&runs)?, look.sites(&runs, quantity)?);
    let (walls, sites) = (sum(&at_ends), sum(&at_sites));
    parts.extend(at_ends.into_iter().chain(at_sites));
    let value = look.adjoint.value;
    let segments = halving::of_all((assembly, state), quantity, value)?;
    let total = ErrorEstimate {
        quantity,
        value,
        error: law + segments + junctions + walls + sites,
        law,
        segments,
        junctions,
        walls,
        sites,
    };
    let several_states = assembly.several_states(state, |_| true);
    Ok(Located {
        total,
        parts,
        several_states: several_states.iter().map(|one| one.1).collect(),
    })
}

/// Refuses filaments of which errors are not known.
fn ensure_known(assembly: &Assembly, quantity: Quantity) -> Result<(), SceneProblem> {
    check(&assembly.scene, quantity)?;
    if is_too_short(assembly.length_nm(), assembly.monomers_of(0).rise_nm) {
        let rule = format!("errors are not known of filaments shorter than {SHORTEST_RISES} rises");
        return Err(SceneProblem::new("filament.sections", "", rule));
    }
    Ok(())
}

impl Look<'_> {
    fn junctions(&self, runs: &[Run]) -> Result<Vec<Contribution>, SceneProblem> {
        let pairs = runs.windows(2).map(|pair| {
            let (one, other) = (&pair[0].span, &pair[1].span);
            let (monomers, rod) = if one.is_ellipsoids() {
                (one, other)
            } else {
                (other, one)
            };
            self.junction(monomers, rod).ok_or_else(wall::no_cell)
        });
        pairs.collect()
    }
}

fn sum(parts: &[Contribution]) -> f64 {
    parts.iter().fold(0.0, |sum, part| sum + part.error)
}

/// The equilibrium that a scene leads to.
fn equilibrium(scene: &Scene) -> Result<(Assembly, State), SceneProblem> {
    let assembly = Assembly::build(&at_rest(scene))?;
    let run = Plan::new(&assembly)?.run();
    let (trajectory, _) = run.map_err(|error| match error {
        RunError::Refused(problem) => problem,
        RunError::Failed(failed) => {
            let rule = format!("finds no equilibrium to judge it by: {}", failed.failure);
            SceneProblem::new("filament.sections", "", rule)
        }
    })?;
    let last = trajectory
        .records
        .last()
        .expect("a run that ended well has one");
    let state = last.state.clone();
    Ok((assembly, state))
}

/// The scene, asked for its equilibrium and for nothing else.
fn at_rest(scene: &Scene) -> Scene {
    let mut rest = scene.clone();
    rest.observe.clear();
    rest.burn_in_ns = None;
    rest.task = Task::Equilibrium(match &scene.task {
        Task::Equilibrium(settings) => Equilibrium {
            states: 0,
            lowest_eigenvalue: false,
            error_of: None,
            ..settings.clone()
        },
        _ => Equilibrium::default(),
    });
    rest
}

/// Refuses scenes of which errors are not known.
pub(crate) fn check(scene: &Scene, quantity: Quantity) -> Result<(), SceneProblem> {
    let of_scene =
        unknown(scene).map(|(key, rule)| (key, format!("errors are not known of {rule}")));
    let of_quantity = missing(scene, quantity);
    match of_scene.or(of_quantity) {
        Some((key, rule)) => Err(SceneProblem::new(key, "", rule)),
        None => Ok(()),
    }
}

/// What errors are not known of, with its key.
fn unknown(scene: &Scene) -> Option<(&'static str, &'static str)> {
    let filament = &scene.filament;
    if !scene.further.is_empty() {
        Some(("filaments", "several filaments"))
    } else if scene.clamps.is_empty() && scene.linkers.is_empty() {
        Some(("clamps", "filaments that nothing holds"))
    } else if filament.shape.is_some() {
        Some(("filament.shape", "filaments that are not built straight"))
    } else if filament.sections.iter().any(Section::is_altered) {
        Some(("filament.sections", "altered sections"))
    } else if scene.thermal().is_some() || matches!(scene.task, Task::Brownian(_)) {
        Some(("task", "filaments in heat"))
    } else if scene.clamps.iter().any(|clamp| clamp.hold != Hold::Wall) {
        Some(("clamps", "ends that are not held by Wall"))
    } else {
        None
    }
}

/// Why a scene does not have a quantity, with the key that is to blame.
fn missing(scene: &Scene, quantity: Quantity) -> Option<(&'static str, String)> {
    if let Quantity::LinkerForce { linker } = quantity {
        let rule = || {
            format!(
                "the force of linker {linker} is wanted, of {}",
                scene.linkers.len()
            )
        };
        return (linker >= scene.linkers.len()).then(|| ("linkers", rule()));
    }
    if let Quantity::Curvature { at_nm } = quantity {
        let rule = no_curvature_at(scene, at_nm)?;
        return Some(("filament.sections", rule));
    }
    let clamp = scene.clamps.iter().find(|clamp| clamp.end == End::End);
    let rule = match (quantity, clamp.map(|clamp| clamp.slides)) {
        (Quantity::Tip, Some(Slides::Nowhere)) => "the tip at the end is wanted, but it is clamped",
        (Quantity::EndForce | Quantity::EndCouple, None) => {
            "what the end bears is wanted, but it is free"
        }
        (Quantity::EndForce, Some(Slides::AlongAxis | Slides::Freely)) => {
            "the force on the end is wanted, along which it slides"
        }
        _ => return None,
    };
    Some(("clamps", rule.to_owned()))
}

/// Why the error of the curvature about an arc length (nm) is not known, if it is not: walls and junctions bend what is about
/// them in their own way.
fn no_curvature_at(scene: &Scene, at_nm: f64) -> Option<String> {
    let sections = &scene.filament.sections;
    let length_nm = sections.iter().map(|s| s.span_nm().1).fold(0.0, f64::max);
    let periods_nm = 2.0 * PERIOD as f64 * scene.filament.monomers.rise_nm;
    let is_held = |end: End| scene.clamps.iter().any(|clamp| clamp.end == end);
    let walls = [(End::Start, 0.0), (End::End, length_nm)];
    let walls = walls.into_iter().filter(|wall| is_held(wall.0));
    let pairs = sections.windows(2);
    let junctions = pairs.filter(|pair| pair[0].is_rod() != pair[1].is_rod());
    let mut places = walls
        .map(|wall| wall.1)
        .chain(junctions.map(|pair| pair[0].span_nm().1));
    let is_known = length_nm >= periods_nm
        && (0.0..=length_nm).contains(&at_nm)
        && places.all(|place| (place - at_nm).abs() >= periods_nm);
    (!is_known).then(|| {
        format!(
            "the curvature at {at_nm:?} nm is wanted, of a filament of {length_nm:?} nm: errors are known of it inside, \
             {periods_nm:.1} nm or more from clamped ends and junctions"
        )
    })
}
