//! Notes and warnings on how far the results of a scene can be trusted.
//!
//! `actin check` and `actin run` print them. `summary.json` has the texts of all under `notes` and the warnings with
//! their codes under `warnings`. Notes known before a run are in [`Assembly::notes`] and
//! [`Plan::notes`](crate::Plan::notes); the summary adds those of the run.

pub mod codes;
mod laws;
mod mesh;

use crate::assembly::{Rod, Sampled};
use crate::scene::{Anchors, Following, Monomers, Observable, Scene, Task, unset_loads};
use crate::trade::Chosen;
use crate::{Assembly, Outcome, Record, shape};
use actin_ellipsoid::{Cubature, EllipsoidParameters, InterfaceKind, MomentCheck};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// Note on a scene or a run; a warning if it has a code.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Note {
    /// Code of a warning, one of [`codes`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub code: Option<Cow<'static, str>>,
    /// Text of a sentence or two.
    pub message: String,
}

impl Note {
    pub(crate) fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code: Some(code.into()),
            message: message.into(),
        }
    }
}

impl From<String> for Note {
    fn from(message: String) -> Self {
        Self {
            code: None,
            message,
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.code {
            None => write!(f, "note: {}", self.message),
            Some(code) => write!(f, "warning: {} [{code}]", self.message),
        }
    }
}

/// Warnings of one code.
fn warnings(
    code: &'static str,
    messages: impl IntoIterator<Item = String>,
) -> impl Iterator<Item = Note> {
    let messages = messages.into_iter();
    messages.map(move |message| Note::warning(code, message))
}

/// Length (nm) of a rod under `Homogenised` below which the direction of a load across it matters.
///
/// # Source
/// `cargo xtask load-cases --ends`: monomers 60 nm long are within 11 % of their mean over azimuths.
const SHORTEST_NM: f64 = 60.0;

/// Largest error (relative) of the stiffness of one interface that is called known; of a filament it is smaller by
/// the root of their number.
const UNSURE: f64 = 0.1;

/// Largest error of the energy that is not told, over what a motion exchanged.
const LEDGER_OPEN: f64 = 0.01;
/// The same at all (pN nm).
const LEDGER_LEAST: f64 = 1e-3;

impl Assembly {
    /// Where cells that follow a motion have shorter segments than its time step needs.
    fn note_on_short_segments(&self, following: &Following) -> Option<String> {
        let segments = following.segments;
        let Task::Brownian(motion) = &self.scene.task else {
            return None;
        };
        let is_bound = motion.time_step_ns.is_none() && motion.thermal().is_some();
        (is_bound && segments > 1).then(|| {
            format!(
                "cells of rod have {segments} segments, which bound the time step: with `segments: 1` in `Following` it \
                 may be up to {:.0} times longer",
                (segments as f64).powi(4)
            )
        })
    }

    /// Notes on this scene before it runs.
    pub fn notes(&self) -> Vec<Note> {
        let mut notes: Vec<Note> = self.chosen.iter().map(Chosen::note).collect();
        if let Some(following) = self.scene.filament.sections.following() {
            let note = "sections follow the motion: numbers of bodies, time step and cost are those of a rod, with which it \
                        begins";
            notes.push(note.to_owned().into());
            notes.extend(self.note_on_short_segments(following).map(Note::from));
        }
        for filament in self.scene.filaments() {
            let sections = filament.sections.iter().filter(|s| !s.is_rod());
            for section in sections {
                let monomers = section.monomers(&filament.monomers);
                let few = InterfaceKind::ALL.map(|kind| few_bonds(&monomers, kind));
                notes.extend(warnings(codes::FEW_BONDS, few.into_iter().flatten()));
            }
        }
        notes.extend(warnings(codes::PATH_LOADS, loads_along_path(&self.scene)));
        notes.extend(warnings(codes::SHORT_ROD, self.short_rods()));
        notes.extend(warnings(codes::LONG_SEGMENTS, self.long_segments()));
        notes.extend(warnings(codes::OVERLAP, self.notes_on_repulsion()));
        let bath_k = self.scene.thermal().map(|thermal| thermal.temperature_k);
        for filament in self.scene.filaments() {
            let of_laws = laws::notes(filament, bath_k);
            notes.extend(warnings(codes::ROD_LAW, of_laws));
        }
        let untold = self.untold_lengths();
        notes.extend(warnings(codes::PERSISTENCE_LENGTH, untold));
        notes.extend(self.sampled.iter().map(Sampled::note));
        let mut unique = Vec::new();
        for note in notes {
            if !unique.contains(&note) {
                unique.push(note);
            }
        }
        unique
    }

    /// Tangent correlations in a heat bath from which no persistence length follows.
    fn untold_lengths(&self) -> Vec<String> {
        let observed =
            (self.scene.observe.iter().enumerate()).filter(|_| self.scene.thermal().is_some());
        let untold = observed.filter_map(|(i, observable)| {
            let Observable::TangentCorrelation { filament, .. } = *observable else {
                return None;
            };
            let reason = self.scene.bends_besides_heat(filament)?;
            Some(format!(
                "observe[{i}]: no persistence length of filament {filament} is given: {reason}, so that its \
                 tangents show more than heat"
            ))
        });
        untold.collect()
    }

    /// The note on the shortest rod under a law of which it is known how short its rods may be.
    fn short_rods(&self) -> Option<String> {
        let under_law = |rod: &&Rod| {
            let filament = self.filament_of_section(rod.section);
            let written = self.scene.filament_at(filament);
            let i = rod.section - self.filaments[filament].sections.start;
            written.is_some_and(|f| f.sections[i].rod_model(&f.rod).law.is_homogenised())
        };
        let lengths = self.rods.iter().filter(under_law);
        let shortest = lengths
            .map(|rod| rod.layout.length())
            .min_by(f64::total_cmp)?;
        (shortest < SHORTEST_NM).then(|| {
            format!(
                "a rod of {shortest:.1} nm under the law Homogenised: it is as stiff across in all directions, but \
                 monomers between walls 60, 41, 30, 25 nm apart give way by up to 10, 25, 50, 55 % more or less than \
                 on average. That average a rod has within 3 % from 41 nm on, 4 % at 30 nm, 7 % at 25 nm \
                 (cargo xtask load-cases --ends)"
            )
        })
    }
}

impl Sampled {
    /// What is known of the interfaces of a run of monomers.
    fn note(&self) -> Note {
        let Self { monomers, error } = self;
        let is_unsure = *error > UNSURE;
        let more = if is_unsure {
            ": sample longer (task.interfaces.sampled_ns)"
        } else {
            ""
        };
        let message = format!(
            "{monomers} monomers with quasi-harmonic interfaces: the stiffness of each is known to {:.1} %{more}. It was sampled \
             without loads: shear does not stiffen under tension",
            100.0 * error
        );
        if is_unsure {
            Note::warning(codes::SAMPLED_INTERFACES, message)
        } else {
            message.into()
        }
    }
}

impl Outcome {
    /// Notes on what this run could not determine; `last` is its last record.
    pub(crate) fn notes(&self, assembly: &Assembly, last: &Record) -> Vec<Note> {
        let twist = unknown_twist(assembly, last);
        let mut notes: Vec<Note> = warnings(codes::UNKNOWN_TWIST, twist).collect();
        let error = self.equilibrium.as_ref().and_then(|e| e.error.as_ref());
        match error {
            Some(Err(problem)) => {
                let message = format!("its error is not known: {problem}");
                notes.push(Note::warning(codes::UNKNOWN_ERROR, message));
            }
            Some(Ok((error, scatter))) => notes.push(error.note(scatter).into()),
            None => {}
        }
        let states = several_states(assembly, &last.state);
        notes.extend(warnings(codes::MONOMER_STATES, states));
        let rates = assembly.note_on_rates(&last.state);
        notes.extend(warnings(codes::LINKER_RATES, rates));
        let ledger = self.note_on_ledger(assembly, last);
        notes.extend(warnings(codes::ENERGY_BALANCE, ledger));
        let is_motion = !matches!(assembly.scene.task, Task::Equilibrium(_));
        if is_motion && self.has_converged() && self.at_rest.is_none() {
            notes.push(Note::warning(
                codes::UNKNOWN_STABILITY,
                "the stop rule was met, but it is not known whether the state at rest is stable: no \
                 equilibrium was found next to it (force_law: PaperBalance and loads that follow have no energy)",
            ));
        }
        notes
    }

    /// The note on an athermal motion whose energy changed by more than came from outside. Of loads without an energy nothing
    /// is known.
    fn note_on_ledger(&self, assembly: &Assembly, last: &Record) -> Option<String> {
        let begun = self.begun_with_pn_nm?;
        let mut terms = assembly.system.interactions().iter();
        let is_known = assembly.scene.thermal().is_none()
            && self.pushes.is_empty()
            && terms.all(|term| term.is_conservative());
        let booked = last.booked;
        let open = last.potential_pn_nm() + last.kinetic_pn_nm - begun - booked.sum_pn_nm();
        let sizes = [
            booked.work_pn_nm,
            booked.heat_pn_nm,
            booked.events_pn_nm,
            self.largest_kinetic_pn_nm,
        ];
        let size = sizes.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
        let is_open = open.abs() > LEDGER_LEAST.max(LEDGER_OPEN * size);
        (is_known && is_open).then(|| {
            format!(
                "the energy at the end is {open:+.3} pN nm from what work and drag account for, where {size:.3} were \
                 exchanged: the error of the time steps; a shorter time_step_ns makes it less"
            )
        })
    }
}

/// Filaments of which it is not known whether they have lost twist.
fn unknown_twist(assembly: &Assembly, last: &Record) -> Vec<String> {
    let filaments = 0..assembly.filaments.len();
    let here = (&last.state, last.at);
    let unknown = filaments.filter(|&filament| shape::link_is_unknown(assembly, filament, here));
    unknown
        .map(|filament| {
            format!(
                "filament {filament}: whether it has lost twist is not known. Twist plus writhe does not \
                 decide where one end has passed the other, where the straight lines beyond the ends cross, or \
                 where the ends are tilted and the filament turns back"
            )
        })
        .collect()
}

/// The note on rods under a potential whose monomers would have several states. Not in a heat bath, which takes monomers
/// from one to another.
fn several_states(assembly: &Assembly, state: &State) -> Option<String> {
    let is_asked = |rod: &Rod| rod.law.0.potential().is_some();
    let found = assembly.several_states(state, is_asked);
    if found.is_empty() || assembly.scene.thermal().is_some() {
        return None;
    }
    let place = |(filament, [from, to]): &(usize, [f64; 2])| match filament {
        0 => format!("from {from:.0} to {to:.0} nm"),
        _ => format!("of filament {filament} from {from:.0} to {to:.0} nm"),
    };
    let places: Vec<String> = found.iter().map(place).collect();
    Some(format!(
        "the rod {} is under-twisted and bent so that monomers would have several states, whose couples about the axis differ by 5 to \
         110 pN nm. A rod has one of them. Resolve monomers there to tell them \
         apart (cargo xtask homogenise states)",
        places.join(", ")
    ))
}

/// The note on loads that act in full along a path that sets none of them.
fn loads_along_path(scene: &Scene) -> Option<String> {
    let unset = unset_loads(scene);
    let first = unset.first()?;
    let which = match unset.len() {
        1 => format!("loads[{first}] acts"),
        2 => format!("loads[{first}] and loads[{}] act", unset[1]),
        more => format!("{more} loads from loads[{first}] on act"),
    };
    Some(format!(
        "{which} in full from the start of the path, which sets no loads. To raise a load along the path, add \
         LoadFactor(load: {first}, factor: 1.0) to a stage"
    ))
}

/// The note on weighted bonds that are too few to represent all.
fn few_bonds(monomers: &Monomers, kind: InterfaceKind) -> Option<String> {
    if monomers.anchors != Anchors::Cubature {
        return None;
    }
    let parameters = EllipsoidParameters::from(monomers);
    let found = Cubature::of(&parameters, kind).ok()?;
    let MomentCheck { residual, .. } = found.certificate;
    (!found.certificate.meets_moments()).then(|| {
        format!(
            "{} weighted bonds for a {kind} interface are too few to represent all: a moment is off by \
             {:.0} % of its root mean square. Eight make twist a quarter too soft, four many times \
             (docs/bonds.md); 12 meet all moments, and anchors: Independent draws as many bonds as asked",
            found.points.len(),
            100.0 * residual
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    /// The page on run directories explains every code, and no code stands for two warnings.
    #[test]
    fn codes_are_documented() {
        let page = include_str!("../../../../docs/reference/run-directory.md");
        for (i, code) in codes::ALL.iter().enumerate() {
            assert!(page.contains(&format!("| `{code}` |")), "{code}");
            assert!(!codes::ALL[..i].contains(code), "{code}");
        }
    }

    pub(super) fn notes(filaments: &str, task: &str) -> Vec<String> {
        let text =
            format!("Scene(filaments: [{filaments}], task: Dynamics(duration_ns: 1.0, {task}))");
        let scene = Scene::from_ron(&text).unwrap_or_else(|error| panic!("{error}"));
        let notes = Assembly::build(&scene).unwrap().notes();
        notes.into_iter().map(|note| note.message).collect()
    }

    /// Too few weighted bonds are noted for each kind of interface, once; drawn ones may be few.
    #[test]
    fn few_weighted_bonds_are_noted() {
        let monomers = |model: &str| {
            format!(
                "Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0)],
                    monomers: Monomers({model})),
                 Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0)],
                    monomers: Monomers({model}), at_nm: (20.0, 0.0, 0.0)),"
            )
        };
        let found = notes(&monomers("lateral_bonds: 8, longitudinal_bonds: 8"), "");
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].starts_with("8 weighted bonds for a lateral interface"));
        assert_eq!(notes(&monomers(""), ""), [""; 0]);
        let drawn = "anchors: Independent, lateral_bonds: 8, longitudinal_bonds: 8";
        assert_eq!(notes(&monomers(drawn), ""), [""; 0]);
    }

    /// Sections with too few bonds of their own are noted as filaments are.
    #[test]
    fn few_weighted_bonds_of_a_section_are_noted() {
        let filament = "Filament(sections: [
            Ellipsoids(from_nm: 0.0, to_nm: 12.0),
            Ellipsoids(from_nm: 12.0, to_nm: 24.0, altered: (lateral_bonds: 8)),
        ])";
        let found = notes(filament, "");
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with("8 weighted bonds for a lateral interface"));
    }

    /// Of rods under the law the shortest is noted, and none that are long or under another.
    #[test]
    fn short_rods_are_noted() {
        let rods = |law: &str, lengths: [f64; 2]| {
            let rod = |k: usize| {
                let (to, x) = (lengths[k], 20.0 * k as f64);
                format!(
                    "Filament(sections: [Rod(from_nm: 0.0, to_nm: {to:?})], rod: RodModel(law: {law}),
                        at_nm: ({x:?}, 0.0, 0.0)),"
                )
            };
            notes(&[rod(0), rod(1)].concat(), "")
        };
        let found = rods("Homogenised", [40.0, 25.0]);
        assert_eq!(found.len(), 1);
        assert!(found[0].starts_with("a rod of 25.0 nm under the law Homogenised"));
        assert_eq!(rods("Homogenised", [61.0, 100.0]), [""; 0]);
        assert_eq!(rods("Fitted", [40.0, 25.0]), [""; 0]);
    }
}
