//! Notes and warnings on the validity and accuracy of results.
//!
//! `actin check` and `actin run` print them. In `summary.json`, `notes` has the texts of all and
//! `warnings` the warnings with their codes. Notes known before a run are in [`Assembly::notes`]
//! and [`Plan::notes`](crate::Plan::notes); the summary adds those of the run.

pub(crate) mod codes;
mod laws;
mod mesh;

use crate::assembly::{InterfaceSampling, Rod};
use crate::scene::{
    AdaptiveResolution, Anchors, Monomers, Observable, RodLaw, Scene, Task, unset_loads,
};
use crate::trade::SectionChoice;
use crate::{Assembly, Outcome, Record, shape};
use actin_ellipsoid::{Cubature, EllipsoidParameters, InterfaceKind, MomentCheck};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// Note on a scene or a run; a warning if it has a code.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Note {
    /// Code of a warning, one of `codes`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub code: Option<Cow<'static, str>>,
    /// One or two sentences.
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

fn warnings(
    code: &'static str,
    messages: impl IntoIterator<Item = String>,
) -> impl Iterator<Item = Note> {
    let messages = messages.into_iter();
    messages.map(move |message| Note::warning(code, message))
}

/// Length (nm) below which the direction of a transverse load on a rod under `Homogenised` matters.
///
/// # Source
/// `cargo xtask load-cases --ends`: monomers 60 nm long are within 11 % of their mean over
/// azimuths.
const SHORTEST_NM: f64 = 60.0;

/// Largest relative error of the stiffness of one interface without a warning. For a filament the
/// error is divided by the root of the number of interfaces.
const UNSURE: f64 = 0.1;

/// Largest energy error without a warning, over the energy exchanged by a motion.
const LEDGER_OPEN: f64 = 0.01;
/// Largest energy error without a warning (pN nm).
const LEDGER_LEAST: f64 = 1e-3;

impl Assembly {
    /// Note on rod cells with more segments than necessary, which limit the time step.
    fn note_on_short_segments(&self, following: &AdaptiveResolution) -> Option<String> {
        let segments = following.segments;
        let Task::Brownian(motion) = &self.scene.task else {
            return None;
        };
        let is_bound = motion.time_step_ns.is_none() && motion.thermal().is_some();
        (is_bound && segments > 1).then(|| {
            format!(
                "cells of rod have {segments} segments, which limit the time step: with `segments: 1` in `Following` the time step \
                 may be up to {:.0} times longer",
                (segments as f64).powi(4)
            )
        })
    }

    /// Returns the notes on this scene before its run.
    pub fn notes(&self) -> Vec<Note> {
        let mut notes: Vec<Note> = self.chosen.iter().map(SectionChoice::note).collect();
        if let Some(following) = self.scene.filament.sections.following() {
            let note = "sections follow the motion: numbers of bodies, time step and cost apply to the rods at its start";
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
        notes.extend(warnings(codes::ROD_LAW, self.short_segments_in_water()));
        let bath_k = self.scene.thermal().map(|thermal| thermal.temperature_k);
        for filament in self.scene.filaments() {
            let of_laws = laws::notes(filament, bath_k);
            notes.extend(warnings(codes::ROD_LAW, of_laws));
        }
        let untold = self.untold_lengths();
        notes.extend(warnings(codes::PERSISTENCE_LENGTH, untold));
        notes.extend(self.sampled.iter().map(InterfaceSampling::note));
        let mut unique = Vec::new();
        for note in notes {
            if !unique.contains(&note) {
                unique.push(note);
            }
        }
        unique
    }

    /// Warnings on tangent correlations from which no persistence length can be computed.
    fn untold_lengths(&self) -> Vec<String> {
        let observed =
            (self.scene.observe.iter().enumerate()).filter(|_| self.scene.thermal().is_some());
        let untold = observed.filter_map(|(i, observable)| {
            let Observable::TangentCorrelation { filament, .. } = *observable else {
                return None;
            };
            let reason = self.scene.nonthermal_bending_cause(filament)?;
            Some(format!(
                "observe[{i}]: no persistence length of filament {filament} is computed: {reason}, so that its \
                 bending is not due to heat alone"
            ))
        });
        untold.collect()
    }

    fn law_of(&self, rod: &Rod) -> Option<RodLaw> {
        let filament = self.filament_of_section(rod.section);
        let written = self.scene.filament_at(filament)?;
        let i = rod.section - self.filaments[filament].sections.start;
        Some(written.sections[i].rod_model(&written.rod).law)
    }

    fn short_rods(&self) -> Option<String> {
        let under_law =
            |rod: &&Rod| (self.law_of(rod)).is_some_and(|law| RodLaw::is_homogenised(&law));
        let lengths = self.rods.iter().filter(under_law);
        let shortest = lengths
            .map(|rod| rod.layout.length())
            .min_by(f64::total_cmp)?;
        (shortest < SHORTEST_NM).then(|| {
            format!(
                "a rod of {shortest:.1} nm with the law Homogenised: its bending is isotropic, but the compliance of \
                 monomers between walls 60, 41, 30, 25 nm apart depends on the direction by up to 10, 25, 50, 55 % of the \
                 mean. A rod meets the mean to 3 % for 41 nm and more, 4 % at 30 nm, 7 % at 25 nm"
            )
        })
    }
}

impl InterfaceSampling {
    fn note(&self) -> Note {
        let Self { monomers, error } = self;
        let is_unsure = *error > UNSURE;
        let more = if is_unsure {
            ": sample longer (task.interfaces.sampled_ns)"
        } else {
            ""
        };
        let message = format!(
            "{monomers} monomers with quasi-harmonic interfaces: the stiffness of each interface has an error of {:.1} %{more}. \
             It was sampled without loads: shear does not stiffen under tension",
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
    /// Returns notes on unknown errors and states of this run; `last` is its last record.
    pub(crate) fn notes(&self, assembly: &Assembly, last: &Record) -> Vec<Note> {
        let twist = unknown_twist(assembly, last);
        let mut notes: Vec<Note> = warnings(codes::UNKNOWN_TWIST, twist).collect();
        let error = self.equilibrium.as_ref().and_then(|e| e.error.as_ref());
        match error {
            Some(Err(problem)) => {
                let message = format!("the model error is unknown: {problem}");
                notes.push(Note::warning(codes::UNKNOWN_ERROR, message));
            }
            Some(Ok((error, scatter))) => notes.push(error.note(scatter).into()),
            None => {}
        }
        let states = several_states(assembly, &last.state);
        notes.extend(warnings(codes::MONOMER_STATES, states));
        let rates = assembly.note_on_rates(&last.state);
        notes.extend(warnings(codes::LINKER_RATES, rates));
        let energy_balance = self.note_on_energy_balance(assembly, last);
        notes.extend(warnings(codes::ENERGY_BALANCE, energy_balance));
        let is_motion = !matches!(assembly.scene.task, Task::Equilibrium(_));
        if is_motion && self.has_converged() && self.at_rest.is_none() {
            notes.push(Note::warning(
                codes::UNKNOWN_STABILITY,
                "the stop rule was met, but it is not known whether the state at rest is stable: no \
                 equilibrium was found near it (force_law: PaperBalance and following loads have no energy)",
            ));
        }
        notes
    }

    /// Warning on the energy balance of an athermal motion with conservative loads.
    fn note_on_energy_balance(&self, assembly: &Assembly, last: &Record) -> Option<String> {
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
                "the final energy differs by {open:+.3} pN nm from the balance of work and drag, at an exchange of {size:.3} \
                 pN nm: this is the error of the time steps; use a shorter time_step_ns"
            )
        })
    }
}

fn unknown_twist(assembly: &Assembly, last: &Record) -> Vec<String> {
    let filaments = 0..assembly.filaments.len();
    let here = (&last.state, last.at);
    let unknown = filaments.filter(|&filament| shape::link_is_unknown(assembly, filament, here));
    unknown
        .map(|filament| {
            format!(
                "filament {filament}: a loss of twist cannot be excluded. Twist plus writhe is not \
                 conclusive if one end has passed the other, if the straight extensions of the ends cross, or \
                 if the ends are tilted and the filament turns back"
            )
        })
        .collect()
}

/// Warning on rods under a potential where monomers would have several states. In a heat bath
/// monomers change between the states, and there is no warning.
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
        "the rod {} has an under-twist and bending at which monomers would have several states, with axial torques that differ by \
         5 to 110 pN nm. A rod has one state. Resolve monomers there to distinguish \
         them (docs/measured/homogenised.md)",
        places.join(", ")
    ))
}

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

fn few_bonds(monomers: &Monomers, kind: InterfaceKind) -> Option<String> {
    if monomers.anchors != Anchors::Cubature {
        return None;
    }
    let parameters = EllipsoidParameters::from(monomers);
    let found = Cubature::for_interface(&parameters, kind).ok()?;
    let MomentCheck { residual, .. } = found.certificate;
    (!found.certificate.meets_moments()).then(|| {
        format!(
            "{} quadrature bonds for a {kind} interface are too few: a moment has an error of \
             {:.0} % of its root mean square. Eight bonds make twist a quarter too soft, four much softer \
             (docs/decisions.md). Use 12, which meet all moments, or anchors: Independent for sampled bonds",
            found.points.len(),
            100.0 * residual
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    #[test]
    fn codes_are_documented() {
        let page = include_str!("../../../../docs/reference/troubleshooting.md");
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
        assert!(found[0].starts_with("8 quadrature bonds for a lateral interface"));
        assert_eq!(notes(&monomers(""), ""), [""; 0]);
        let drawn = "anchors: Independent, lateral_bonds: 8, longitudinal_bonds: 8";
        assert_eq!(notes(&monomers(drawn), ""), [""; 0]);
    }

    #[test]
    fn few_weighted_bonds_of_a_section_are_noted() {
        let filament = "Filament(sections: [
            Ellipsoids(from_nm: 0.0, to_nm: 12.0),
            Ellipsoids(from_nm: 12.0, to_nm: 24.0, altered: (lateral_bonds: 8)),
        ])";
        let found = notes(filament, "");
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with("8 quadrature bonds for a lateral interface"));
    }

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
        assert!(found[0].starts_with("a rod of 25.0 nm with the law Homogenised"));
        assert_eq!(rods("Homogenised", [61.0, 100.0]), [""; 0]);
        assert_eq!(rods("Fitted", [40.0, 25.0]), [""; 0]);
    }
}
