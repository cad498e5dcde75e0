//! What a scene costs, known before it runs: evaluations, what each evaluates, and seconds at
//! measured rates. How accurate the answer will be is told by `advice`.
//!
//! Seconds are those of `actin run` on one core of the [reference machine](REFERENCE), from reading
//! the scene to the last file. `cargo xtask costs` prints them beside measured ones.

mod newton;
mod rates;

pub use rates::{
    BONDS_PER_S, BROWNIAN_CONTACTS_PER_S, CONTACTS_PER_S, DIRECTORY_S, DRAWN_BONDS_PER_S,
    ELEMENTS_PER_S, FILAMENTS_PER_S, FINAL_BODIES_PER_S, FLUID_BODIES_PER_S, LAW_ELEMENTS_PER_S,
    MONOMERS_PER_S, MOVED_BODIES_PER_S, NEWTON_BONDS_PER_S, NEWTON_CONTACTS_PER_S,
    NEWTON_ELEMENTS_PER_S, NEWTON_LAW_ELEMENTS_PER_S, NEWTON_MONOMERS_PER_S, NEWTON_TERMS_PER_S,
    NOISY_BODIES_PER_S, RECORD_S, RECORDED_BODIES_PER_S, REFERENCE, SOLID_ANGLES_PER_S,
    STAGES_PER_S, TERMS_PER_S, TRIAL_BODIES_PER_S,
};

use crate::scene::{Anchors, Dynamics, Filament, RodLaw, RodModel, Task};
use crate::{Assembly, Estimate, memory, shape};
use std::fmt;

/// What one evaluation of the loads evaluates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Evaluated {
    /// Bonds between monomers.
    pub bonds: usize,
    /// Segments of rods and bonds of junctions.
    pub elements: usize,
}

/// What a scene costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// What one evaluation evaluates.
    pub work: Evaluated,
    /// Evaluations of the loads in a motion, at most; Newton steps of all equilibria, about.
    pub evaluations: u64,
    /// Equilibria of a path, about; one without a path, none of a motion.
    pub equilibria: u64,
    /// Time on one core of the reference machine.
    pub seconds: Seconds,
    /// Memory (bytes) of a run into a directory, where records go to the disk.
    pub bytes: f64,
    /// Pairs of near segments and monomers between which repulsion is evaluated, as built; `None` without
    /// repulsion.
    pub contacts: Option<usize>,
}

/// Time on one core of the reference machine (s), by what it goes into.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seconds {
    /// Reading, building, and finding the time step of a motion.
    pub set_up: f64,
    /// The motion, or Newton's method with its certificates.
    pub solve: f64,
    /// Records and files.
    pub results: f64,
}

impl Seconds {
    /// All together (s).
    pub fn total(&self) -> f64 {
        self.set_up + self.solve + self.results
    }
}

impl Evaluated {
    /// Of an assembled scene.
    pub fn of(assembly: &Assembly) -> Self {
        let each = (0..assembly.filaments.len()).map(|filament| Self::of_one(assembly, filament));
        each.fold(Self::default(), |sum, one| Self {
            bonds: sum.bonds + one.bonds,
            elements: sum.elements + one.elements,
        })
    }

    /// Of one filament.
    fn of_one(assembly: &Assembly, filament: usize) -> Self {
        let counts = assembly.counts_of(filament);
        let scene = assembly.scene.filament_at(filament);
        let attached = scene.map_or(0, |one| one.junction.attached_monomers);
        Self {
            bonds: counts.bonds,
            elements: counts.segments + counts.junctions * attached,
        }
    }
}

impl Cost {
    /// Of an assembled scene; `estimate` is that of its motion, none of an equilibrium.
    pub fn of(assembly: &Assembly, estimate: Option<&Estimate>) -> Self {
        let elements = Elements::of(assembly);
        let (evaluations, equilibria, records) = if let Some(estimate) = estimate {
            (estimate.force_evaluations, 0, estimate.records())
        } else {
            let (steps, equilibria) = newton::steps(assembly);
            (steps, equilibria, equilibria as f64)
        };
        let solve = match (&assembly.scene.task, estimate) {
            (Task::Dynamics(dynamics), Some(estimate)) => {
                evaluations as f64 * elements.seconds_of_evaluation()
                    + elements.bodies / MOVED_BODIES_PER_S
                    + seconds_of_noise(assembly, dynamics, estimate)
            }
            (_, estimate) => {
                let contacts_per_s = match estimate {
                    Some(_) => BROWNIAN_CONTACTS_PER_S,
                    None => NEWTON_CONTACTS_PER_S,
                };
                let contacts = elements.contacts / contacts_per_s;
                newton::counted(evaluations, equilibria)
                    * (elements.seconds_of_newton_step() + contacts)
            }
        };
        Self {
            work: elements.work,
            evaluations,
            equilibria,
            seconds: Seconds {
                set_up: elements.seconds_of_set_up(assembly),
                solve,
                results: elements.seconds_of_results(assembly, records),
            },
            bytes: assembly.bytes,
            contacts: contacts(assembly),
        }
    }

    /// Evaluations of bonds.
    pub fn bond_evaluations(&self) -> f64 {
        self.evaluations as f64 * self.work.bonds as f64
    }

    /// Evaluations of elements.
    pub fn element_evaluations(&self) -> f64 {
        self.evaluations as f64 * self.work.elements as f64
    }
}

impl fmt::Display for Cost {
    /// What is evaluated, how long it takes, and the memory for it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.equilibria == 0 {
            write!(f, "at most {} force evaluations", self.evaluations)?;
        } else {
            let (steps, of) = (self.evaluations, self.equilibria);
            let plural = if of == 1 { "um" } else { "a" };
            write!(f, "about {steps} Newton steps to {of} equilibri{plural}")?;
        }
        let Seconds {
            set_up,
            solve,
            results,
        } = self.seconds;
        write!(
            f,
            ", each of {} bonds and {} elements: {:.1e} evaluations of bonds, {:.1e} of elements; an \
             estimated {} on one core of the reference machine ({REFERENCE}): {} to set up, {} to \
             solve, {} for results; about {} of memory",
            self.work.bonds,
            self.work.elements,
            self.bond_evaluations(),
            self.element_evaluations(),
            time(self.seconds.total()),
            time(set_up),
            time(solve),
            time(results),
            memory::in_words(self.bytes)
        )?;
        if let Some(contacts) = self.contacts {
            write!(
                f,
                "; {contacts} contacts of the repulsion are counted, as built: more take longer, in proportion"
            )?;
        }
        Ok(())
    }
}

/// A time in words, to the digits that an estimate has.
fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => format!("{s:.1e} s"),
        s if s < 10.0 => format!("{s:.1} s"),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.0} h", s / 3600.0),
    }
}

/// What a scene is made of, as far as it takes time.
struct Elements {
    work: Evaluated,
    monomers: f64,
    /// Bonds that are drawn.
    drawn: f64,
    /// Elements of rods of constant rigidities, and of those under laws.
    constant: f64,
    following: f64,
    terms: f64,
    bodies: f64,
    /// Pairs between which repulsion is evaluated.
    contacts: f64,
}

fn contacts(assembly: &Assembly) -> Option<usize> {
    let repelled = assembly.repelled.as_ref()?;
    Some(repelled.pairs(&assembly.rest))
}

impl Elements {
    fn of(assembly: &Assembly) -> Self {
        let mut all = Self {
            work: Evaluated::default(),
            monomers: assembly.counts().monomers as f64,
            drawn: 0.0,
            constant: 0.0,
            following: 0.0,
            terms: assembly.terms.len() as f64,
            bodies: (assembly.points.len() + assembly.frames.len()) as f64,
            contacts: contacts(assembly).unwrap_or(0) as f64,
        };
        for (i, filament) in assembly.scene.filaments().enumerate() {
            let one = Evaluated::of_one(assembly, i);
            all.work.bonds += one.bonds;
            all.work.elements += one.elements;
            if filament.monomers.anchors != Anchors::Cubature {
                all.drawn += one.bonds as f64;
            }
            let is_constant = |rod: RodModel| rod.law == RodLaw::Constant;
            let elements = if filament.rod_models().all(is_constant) {
                &mut all.constant
            } else {
                &mut all.following
            };
            *elements += one.elements as f64;
        }
        all
    }

    /// Of one evaluation of the loads, with its share of a step.
    fn seconds_of_evaluation(&self) -> f64 {
        self.work.bonds as f64 / BONDS_PER_S
            + self.monomers / MONOMERS_PER_S
            + self.constant / ELEMENTS_PER_S
            + self.following / LAW_ELEMENTS_PER_S
            + self.terms / TERMS_PER_S
            + self.contacts / CONTACTS_PER_S
    }

    fn seconds_of_newton_step(&self) -> f64 {
        self.work.bonds as f64 / NEWTON_BONDS_PER_S
            + self.monomers / NEWTON_MONOMERS_PER_S
            + self.constant / NEWTON_ELEMENTS_PER_S
            + self.following / NEWTON_LAW_ELEMENTS_PER_S
            + self.terms / NEWTON_TERMS_PER_S
    }

    fn seconds_of_set_up(&self, assembly: &Assembly) -> f64 {
        let filaments = assembly.filaments.len() as f64;
        let stages = assembly.scene.path.len() as f64;
        let built =
            filaments / FILAMENTS_PER_S + self.drawn / DRAWN_BONDS_PER_S + stages / STAGES_PER_S;
        let Task::Dynamics(_) = assembly.scene.task else {
            return built;
        };
        let trials = trials(assembly.counts().dofs);
        let each = self.seconds_of_evaluation() + self.bodies / TRIAL_BODIES_PER_S;
        let mut rods = (assembly.scene.filaments()).flat_map(Filament::rod_models);
        // The same filaments with constant rods are built and asked too.
        if rods.any(|rod| rod.law.shears_softly()) {
            2.0 * (built + trials * each)
        } else {
            built + trials * each
        }
    }

    fn seconds_of_results(&self, assembly: &Assembly, records: f64) -> f64 {
        let angles = shape::solid_angles(assembly);
        DIRECTORY_S
            + records * (RECORD_S + self.bodies / RECORDED_BODIES_PER_S)
            + self.bodies / FINAL_BODIES_PER_S
            + angles / SOLID_ANGLES_PER_S
    }
}

/// Evaluations that the largest frequency of so many degrees of freedom takes.
fn trials(dofs: usize) -> f64 {
    2.0 * dofs.min(actin_integrate::KRYLOV_VECTORS) as f64
}

/// Time that thermal noise adds to a motion (s): two half steps for each point and each frame.
fn seconds_of_noise(assembly: &Assembly, dynamics: &Dynamics, estimate: &Estimate) -> f64 {
    let bodies = assembly.counts().dofs as f64 / 3.0;
    if dynamics.drag.fluid().is_some() {
        return bodies * estimate.steps as f64 / FLUID_BODIES_PER_S;
    }
    let draws = 2.0 * bodies * estimate.steps as f64;
    dynamics.thermal.map_or(0.0, |_| draws / NOISY_BODIES_PER_S)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Plan, Scene};

    fn cost(sections: &str, task: &str) -> Cost {
        let text = format!(
            "Scene(
                filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: (1.0, 0.0, 0.0))],
                task: {task},
            )"
        );
        let scene = Scene::from_ron(&text).unwrap();
        Plan::new(&Assembly::build(&scene).unwrap()).unwrap().cost()
    }

    const MOTION: &str = "Dynamics(duration_ns: 1.0, time_step_ns: 0.001)";

    /// 1 ns in steps of 0.001 ns of four evaluations; 6 segments and two bonds of a junction.
    #[test]
    fn counts_are_those_of_the_scene() {
        let rod = cost("Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)", MOTION);
        assert_eq!((rod.work.bonds, rod.work.elements), (0, 6));
        assert_eq!(rod.evaluations, 4000);
        // One term for the rod and one for its load.
        let expected = 24_000.0 / ELEMENTS_PER_S + 8000.0 / TERMS_PER_S;
        let longer = MOTION.replace("duration_ns: 1.0", "duration_ns: 2.0");
        let longer = cost("Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)", &longer);
        let more = longer.seconds.solve - rod.seconds.solve;
        assert!((more - expected).abs() < 1e-12);
        let mixed = cost(
            "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0, segments: 3)",
            MOTION,
        );
        assert_eq!(mixed.work.elements, 5);
        // 12 monomers with the outer held one: 11 lateral and 10 longitudinal interfaces of 12.
        assert_eq!(mixed.work.bonds, 21 * 12);
        assert!((mixed.bond_evaluations() - 4000.0 * 21.0 * 12.0).abs() < 1e-6);
    }

    /// A held end leaves 6 points and 6 frames, each with two half steps in each of 1000 steps.
    #[test]
    fn noise_has_its_price() {
        let rod = "Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)";
        let task = |thermal: &str| {
            format!(
                "Dynamics(duration_ns: 1.0, time_step_ns: 0.001, drag: (translational_per_ns: 1.0, \
                 rotational_per_ns: 1.0){thermal})"
            )
        };
        let still = cost(rod, &task(""));
        let heated = cost(rod, &task(", thermal: (temperature_k: 298.0, seed: 1)"));
        assert_eq!(heated.evaluations, still.evaluations);
        let noise = heated.seconds.solve - still.seconds.solve;
        assert!((noise - 24_000.0 / NOISY_BODIES_PER_S).abs() < 1e-12);
    }

    /// Two filaments side by side have contacts that take time, far from each other none; without repulsion they
    /// are not mentioned.
    #[test]
    fn contacts_count() {
        let of = |apart: f64, repulsion: &str| {
            let text = format!(
                "Scene(
                    filaments: [
                        Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)]),
                        Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)], at_nm: ({apart:?}, 0.0, 0.0)),
                    ],
                    {repulsion}
                    task: Dynamics(duration_ns: 1.0, time_step_ns: 0.001),
                )"
            );
            let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
            Plan::new(&assembly).unwrap().cost()
        };
        let near = of(8.0, "repulsion: Repulsion(),");
        let far = of(80.0, "repulsion: Repulsion(),");
        // 8 nm apart: at least each segment with the one beside it and with its neighbours.
        let pairs = near.contacts.unwrap();
        assert!(pairs >= 16 && far.contacts == Some(0), "{pairs}");
        let more = near.seconds.solve - far.seconds.solve;
        let expected = 4000.0 * pairs as f64 / CONTACTS_PER_S;
        assert!((more / expected - 1.0).abs() < 1e-9);
        assert!(near.to_string().contains("contacts of the repulsion"));
        assert!(!of(80.0, "").to_string().contains("contacts"));
    }

    /// Each start of a search for other states is an equilibrium of its own.
    #[test]
    fn starts_of_a_search_count() {
        let rod = "Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)";
        let one = cost(rod, "Equilibrium()");
        let many = cost(rod, "Equilibrium(states: 100)");
        assert_eq!(many.equilibria, 101);
        assert!(many.seconds.solve > 100.0 * one.seconds.solve);
    }

    /// An equilibrium is estimated without time steps, and for less than the motion towards it.
    #[test]
    fn an_equilibrium_counts_newton_steps() {
        let monomers = "Ellipsoids(from_nm: 0.0, to_nm: 60.0)";
        let still = cost(monomers, "Equilibrium()");
        // 22 monomers: as many steps as of 60.
        assert_eq!((still.evaluations, still.equilibria), (12, 1));
        let motion = cost(monomers, "Dynamics(duration_ns: 100.0)");
        assert!(still.seconds.total() < motion.seconds.total());
        assert_eq!(motion.equilibria, 0);
    }

    /// As many filaments again take as much time and memory again, whatever the task: the counts behind
    /// them are sums.
    #[test]
    fn costs_are_proportional_to_the_number_of_filaments() {
        let of = |count: usize, task: &str| {
            let filament = "Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)]),";
            let filaments = filament.repeat(count);
            let text = format!("Scene(filaments: [{filaments}], task: {task})");
            let scene = Scene::from_ron(&text).unwrap();
            Plan::new(&Assembly::build(&scene).unwrap()).unwrap().cost()
        };
        for task in [MOTION, "Equilibrium()"] {
            let all = [20, 40, 60].map(|count| of(count, task));
            assert_eq!(all[0].evaluations, all[2].evaluations);
            for part in [
                |cost: &Cost| cost.seconds.set_up,
                |cost: &Cost| cost.seconds.solve,
                |cost: &Cost| cost.seconds.results,
                |cost: &Cost| cost.bytes,
            ] {
                let [a, b, c] = all.each_ref().map(part);
                assert!(
                    ((c - b) - (b - a)).abs() <= 1e-12 * c,
                    "{task}: {a}, {b}, {c}"
                );
            }
        }
    }

    /// What is told names the machine and says that it is an estimate.
    #[test]
    fn the_words_say_what_is_estimated() {
        let words = cost("Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)", MOTION).to_string();
        let expected = "at most 4000 force evaluations, each of 0 bonds and 6 elements: 0.0e0 \
                        evaluations of bonds, 2.4e4 of elements; an estimated ";
        assert!(words.starts_with(expected), "{words}");
        assert!(
            words.contains("on one core of the reference machine"),
            "{words}"
        );
    }
}
