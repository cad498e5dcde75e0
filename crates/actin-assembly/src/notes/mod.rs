//! Notes and warnings on the validity and accuracy of results.
//!
//! `actin check` and `actin run` print them. In `summary.json`, `notes` has the texts of all and
//! `warnings` the warnings with their codes. Notes known before a run are in [`Assembly::notes`]
//! and `Plan::notes` of `actin-sim`; the summary adds those of the run.

mod codes;
mod laws;
mod mesh;
mod softened;

use crate::scene::{
    AdaptiveResolution, Anchors, Filament, Flow, Monomers, Observable, Scene, Setting, Task,
    unset_loads,
};
use crate::{Assembly, InterfaceSampling, Rod, SectionChoice, SectionSpan};
use actin_ellipsoid::{Cubature, EllipsoidParameters, InterfaceKind, MomentCheck};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// Note on a scene or a run; a warning if it has a code.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Note {
    /// Stable code of a warning, for use by other programs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub code: Option<Cow<'static, str>>,
    /// One or two sentences.
    pub message: String,
}

impl Note {
    /// Creates a warning with a code.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code: Some(code.into()),
            message: message.into(),
        }
    }

    /// Creates a warning with a code from each message.
    pub fn warnings(
        code: &'static str,
        messages: impl IntoIterator<Item = String>,
    ) -> impl Iterator<Item = Self> {
        let messages = messages.into_iter();
        messages.map(move |message| Self::warning(code, message))
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

/// Largest delay of averaged forces over the time of a change.
const LAGGING: f64 = 0.1;

/// Distance (nm) above which monomers shorten the persistence length by about 4 % or less (`docs/measured/heat.md`).
const FAR_NM: f64 = 150.0;

/// Length (nm) below which the direction of a transverse load on a rod under `Homogenised` matters.
///
/// # Source
/// `cargo xtask load-cases --ends`: monomers 60 nm long are within 11 % of their mean over
/// azimuths.
const SHORTEST_NM: f64 = 60.0;

/// Largest relative error of the stiffness of one interface without a warning. For a filament the
/// error is divided by the root of the number of interfaces.
const UNSURE: f64 = 0.1;

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

    /// Notes that are not warnings.
    fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        if let Some(following) = self.scene.filament.sections.following() {
            let note = "sections follow the motion: numbers of bodies, time step and cost apply to the rods at its start";
            remarks.push(note.to_owned());
            remarks.extend(self.note_on_short_segments(following));
        }
        let is_reaction = |one: &Observable| matches!(one, Observable::EndReaction { .. });
        if self.scene.observe.iter().any(is_reaction) && self.has_drag_on_held_bodies() {
            let note = "reactions do not include the drag on held bodies: half a segment and the end of the filament";
            remarks.push(note.to_owned());
        }
        if self.scene.repulsion.is_some() && !self.scene.beads.is_empty() {
            remarks.push("repulsion does not act on beads".to_owned());
        }
        remarks
    }

    /// Returns `true` if held bodies move relative to a fluid.
    fn has_drag_on_held_bodies(&self) -> bool {
        let mut settings = self.scene.path.iter().flat_map(|stage| &stage.set);
        let is_move = |one: &Setting| matches!(one, Setting::Shift { .. } | Setting::Turn { .. });
        let moves = settings.any(is_move);
        match &self.scene.task {
            Task::Brownian(motion) => moves || motion.flow != Flow::AtRest,
            Task::Dynamics(motion) => moves && motion.drag.fluid().is_some(),
            Task::Equilibrium(_) => false,
        }
    }

    /// Returns the notes on this scene before its run.
    pub fn notes(&self) -> Vec<Note> {
        let mut notes: Vec<Note> = self.chosen.iter().map(SectionChoice::note).collect();
        notes.extend(self.remarks().into_iter().map(Note::from));
        let bath_k = self.scene.thermal().map(|thermal| thermal.temperature_k);
        let few_bonds = self.scene.filaments().flat_map(few_bonds_of_sections);
        let laws = self.scene.filaments();
        let laws = laws.flat_map(|filament| laws::notes(filament, bath_k));
        let warnings = [
            (codes::FEW_BONDS, few_bonds.collect()),
            (
                codes::PATH_LOADS,
                Vec::from_iter(loads_along_path(&self.scene)),
            ),
            (codes::SHORT_ROD, Vec::from_iter(self.short_rods())),
            (codes::LONG_SEGMENTS, self.long_segments()),
            (codes::LONG_SEGMENTS, Vec::from_iter(self.coarse_in_water())),
            (codes::PARTLY_RESOLVED, self.partly_resolved()),
            (codes::OVERLAP, self.notes_on_repulsion()),
            (
                codes::ROD_LAW,
                Vec::from_iter(self.short_segments_in_water()),
            ),
            (codes::ROD_LAW, laws.collect()),
            (codes::PERSISTENCE_LENGTH, self.undetermined_lengths()),
            (codes::NEAR_CORRELATION, self.shortened_lengths()),
        ];
        for (code, messages) in warnings {
            notes.extend(Note::warnings(code, messages));
        }
        notes.extend(self.sampled.iter().map(InterfaceSampling::note));
        without_repetitions(notes)
    }

    /// Warnings on tangent correlations from which no persistence length can be computed.
    fn undetermined_lengths(&self) -> Vec<String> {
        let message = |i: usize, filament: usize, _: f64| {
            let reason = self.scene.persistence_length_obstacle(filament)?;
            Some(format!(
                "observe[{i}]: no persistence length of filament {filament} is computed: {reason}"
            ))
        };
        self.correlation_messages(message)
    }

    /// Warnings on tangent correlations of monomers at small distances.
    fn shortened_lengths(&self) -> Vec<String> {
        let message = |i: usize, filament: usize, over_nm: f64| {
            let mut sections = self.sections_of(filament).iter();
            let is_near = over_nm < FAR_NM && sections.any(SectionSpan::is_ellipsoids);
            let is_computed = self.scene.persistence_length_obstacle(filament).is_none();
            (is_near && is_computed).then(|| {
                format!(
                    "observe[{i}]: monomers turn relative to the axis, which shortens the persistence length over \
                     {over_nm:?} nm: unaltered ones by 39, 25, 14 and 7 % over 11, 22, 44 and 88 nm. The means m_a and m_b \
                     over two distances a < b give it as (b - a) / ln(m_a / m_b)"
                )
            })
        };
        self.correlation_messages(message)
    }

    /// Messages on observed tangent correlations in heat, from the index, the filament and the distance (nm).
    fn correlation_messages(
        &self,
        message: impl Fn(usize, usize, f64) -> Option<String>,
    ) -> Vec<String> {
        if self.scene.thermal().is_none() {
            return Vec::new();
        }
        let observed = self.scene.observe.iter().enumerate();
        let messages = observed.filter_map(|(i, observable)| match *observable {
            Observable::TangentCorrelation { filament, over_nm } => message(i, filament, over_nm),
            _ => None,
        });
        messages.collect()
    }

    /// Warning on linkers whose averaged forces follow changes of the scene too late in steps of `step_ns`.
    pub fn note_on_averages(&self, step_ns: f64) -> Option<String> {
        let change = self.scene.times_of_change().min_by(f64::total_cmp)?;
        let kinetics = self.kinetics.as_ref()?;
        let delays = kinetics.delays(step_ns);
        let mut lagging = delays.filter(|(_, delay)| *delay > LAGGING * change);
        let (linker, delay) = lagging.next()?;
        let others = match lagging.count() {
            0 => String::new(),
            count => format!(" (likewise for {count} more)"),
        };
        Some(format!(
            "linker {linker}: rates follow the averaged force within {delay:.1e} ns{others}, which lags behind changes of \
             the scene in {change:.1e} ns: write averaging_ns of at most a tenth of it"
        ))
    }

    fn short_rods(&self) -> Option<String> {
        let under_law = |rod: &&Rod| self.rod_model_of(rod.section).law.is_homogenised();
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

fn without_repetitions(notes: Vec<Note>) -> Vec<Note> {
    let mut unique = Vec::new();
    for note in notes {
        if !unique.contains(&note) {
            unique.push(note);
        }
    }
    unique
}

impl SectionChoice {
    /// Returns the choice and its errors as a note, or as a warning if the wanted errors are not met.
    fn note(&self) -> Note {
        let wanted = self.wanted.iter();
        let wanted: Vec<String> = wanted
            .map(|(what, error)| format!("{what} within {} %", 100.0 * error))
            .collect();
        let limit = self
            .most_monomers
            .map_or_else(String::new, |most| format!(" with at most {most} monomers"));
        let found = if self.errors.is_empty() {
            "; the all-monomer equilibrium is the reference, so no comparison was run".to_owned()
        } else {
            let errors = self.errors.iter().map(|e| format!("{:.2} %", 100.0 * e));
            let errors: Vec<String> = errors.collect();
            let part = if self.share < 1.0 {
                format!(" in the first {:.0} % of the motion", 100.0 * self.share)
            } else {
                String::new()
            };
            format!(
                "; the error relative to the all-monomer model is {}{part}",
                errors.join(", ")
            )
        };
        let missed = if self.is_met {
            ""
        } else {
            ". The requested errors are not reached with at most this number of monomers: this resolution has \
             the smallest error of those compared. Increase `monomers` or `error`"
        };
        let message = format!(
            "sections chosen for {}{limit}: {}{found}{missed}",
            wanted.join(", "),
            self.name
        );
        if self.is_met {
            message.into()
        } else {
            Note::warning(codes::RESOLUTION, message)
        }
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

fn few_bonds_of_sections(filament: &Filament) -> impl Iterator<Item = String> {
    let sections = filament.sections.iter().filter(|s| !s.is_rod());
    sections.flat_map(|section| {
        let monomers = section.monomers(&filament.monomers);
        let few = InterfaceKind::ALL.map(|kind| few_bonds(&monomers, kind));
        few.into_iter().flatten()
    })
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
    use crate::scene::Scene;

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

    #[test]
    fn averages_that_lag_are_noted() {
        let found = |averaging: &str| {
            let scene = Scene::from_ron(&format!(
                "Scene(
                    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)]),
                    clamps: [Clamp(end: Start)],
                    linkers: [Linker(at_nm: 40.0, displaced_nm: (1.0, 0.0, 0.0), stiffness_pn_per_nm: 1.0,
                        kinetics: (seed: 1, breaks: (rate_per_ns: 1e-3, force_pn: 5.0){averaging}))],
                    path: [Stage(duration_ns: 0.5, set: [Anchor(linker: 0, shift_nm: (2.0, 0.0, 0.0))])],
                    task: Dynamics(duration_ns: 1.0),
                )"
            ));
            Assembly::build(&scene.unwrap())
                .unwrap()
                .note_on_averages(1e-3)
        };
        let late = found(", averaging_ns: 0.06").unwrap();
        assert!(
            late.contains("within 6.0e-2 ns") && late.contains("changes of the scene in 5.0e-1 ns")
        );
        assert_eq!(found(", averaging_ns: 0.05"), None);
        // Without heat the recent average is the force of the last step.
        assert_eq!(found(""), None);
    }
}
