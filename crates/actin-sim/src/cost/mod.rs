//! What a scene costs, known before it runs: evaluations, what each evaluates, and seconds at
//! measured rates. How accurate the answer will be is told by `advice`.

mod rates;

pub use rates::{
    BONDS_PER_S, ELEMENTS_PER_S, LAW_ELEMENTS_PER_S, NEWTON_BONDS_PER_S, NEWTON_ELEMENTS_PER_S,
    NEWTON_LAW_ELEMENTS_PER_S, NOISY_BODIES_PER_S,
};

use crate::scene::{Problem, RodLaw, Task};
use crate::{Assembly, Estimate};

/// Newton steps of one equilibrium that the estimate takes: the middle of what `cargo xtask
/// tradeoff` counts, which is 4 to 70.
const NEWTON_STEPS: u64 = 20;

/// What one evaluation of the loads evaluates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Bonds between monomers.
    pub bonds: usize,
    /// Segments of rods and bonds of junctions.
    pub elements: usize,
}

/// What a scene costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// What one evaluation evaluates.
    pub work: Work,
    /// Evaluations of the loads in a motion, at most; Newton steps of an equilibrium, about.
    pub evaluations: u64,
    /// Time on one core (s).
    pub seconds: f64,
}

impl Work {
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
        let scene = assembly.scene.filaments().nth(filament);
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
        let work = Work::of(assembly);
        let of_elements = |rate: fn(&RodLaw) -> f64| -> f64 {
            let filaments = assembly.scene.filaments().enumerate();
            filaments
                .map(|(i, one)| Work::of_one(assembly, i).elements as f64 / rate(&one.rod.law))
                .sum()
        };
        let bonds = work.bonds as f64;
        let (evaluations, each, noise) = match estimate {
            Some(estimate) => (
                estimate.force_evaluations,
                bonds / BONDS_PER_S + of_elements(rates::elements_per_s),
                seconds_of_noise(assembly, estimate),
            ),
            None => (
                NEWTON_STEPS * equilibria(assembly),
                bonds / NEWTON_BONDS_PER_S + of_elements(rates::newton_elements_per_s),
                0.0,
            ),
        };
        Self {
            work,
            evaluations,
            seconds: evaluations as f64 * each + noise,
        }
    }

    /// Of an assembled scene.
    ///
    /// # Errors
    /// What [`estimate`](crate::estimate) refuses.
    pub fn estimated(assembly: &Assembly) -> Result<Self, Problem> {
        let estimate = crate::estimate(assembly)?;
        Ok(Self::of(assembly, estimate.as_ref()))
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

/// Time that thermal noise adds to a motion (s): two half steps for each point and each frame.
fn seconds_of_noise(assembly: &Assembly, estimate: &Estimate) -> f64 {
    let Task::Dynamics(dynamics) = &assembly.scene.task else {
        return 0.0;
    };
    let bodies = assembly.counts().dofs as f64 / 3.0;
    let draws = 2.0 * bodies * estimate.steps as f64;
    dynamics.thermal.map_or(0.0, |_| draws / NOISY_BODIES_PER_S)
}

/// Equilibria on the path of a scene: steps of the largest length, and a few shorter ones at the
/// start of each stage.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the conversion saturates, and a count is positive"
)]
fn equilibria(assembly: &Assembly) -> u64 {
    let Task::Equilibrium(equilibrium) = &assembly.scene.task else {
        return 1;
    };
    let stages = assembly.scene.path.len() as u64;
    let steps = (1.0 / equilibrium.largest_step).ceil() as u64;
    if stages == 0 {
        1
    } else {
        stages.saturating_mul(steps.saturating_add(2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    fn cost(sections: &str, task: &str) -> Cost {
        let text = format!(
            "Scene(
                filament: Filament(sections: [{sections}]),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: (1.0, 0.0, 0.0))],
                task: {task},
            )"
        );
        let scene = Scene::from_ron(&text).unwrap();
        Cost::estimated(&Assembly::build(&scene).unwrap()).unwrap()
    }

    const MOTION: &str = "Dynamics(duration_ns: 1.0, time_step_ns: 0.001)";

    /// 1 ns in steps of 0.001 ns of four evaluations; 6 segments and two bonds of a junction.
    #[test]
    fn counts_are_those_of_the_scene() {
        let rod = cost("Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)", MOTION);
        assert_eq!((rod.work.bonds, rod.work.elements), (0, 6));
        assert_eq!(rod.evaluations, 4000);
        assert!((rod.seconds - 24_000.0 / ELEMENTS_PER_S).abs() < 1e-12);
        let mixed = cost(
            "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0, segments: 3)",
            MOTION,
        );
        assert_eq!(mixed.work.elements, 5);
        // 12 monomers with the outer held one: 11 lateral and 10 longitudinal interfaces of 64.
        assert_eq!(mixed.work.bonds, 21 * 64);
        assert!((mixed.bond_evaluations() - 4000.0 * 21.0 * 64.0).abs() < 1e-6);
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
        let noise = heated.seconds - still.seconds;
        assert!((noise - 24_000.0 / NOISY_BODIES_PER_S).abs() < 1e-12);
    }

    /// An equilibrium is estimated without time steps, and for less than the motion towards it.
    #[test]
    fn an_equilibrium_counts_newton_steps() {
        let monomers = "Ellipsoids(from_nm: 0.0, to_nm: 60.0)";
        let still = cost(monomers, "Equilibrium()");
        assert_eq!(still.evaluations, NEWTON_STEPS);
        assert!(still.seconds < cost(monomers, "Dynamics(duration_ns: 100.0)").seconds);
    }
}
