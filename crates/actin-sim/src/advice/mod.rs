//! What is known of the trade of accuracy for speed: settings, the scenes they were measured on,
//! the table of what came out, and the one change that would save a scene most.
//!
//! The measurements are those of `cargo xtask tradeoff`; nothing here runs a scene.

mod change;
mod like;
pub mod scenes;
mod setting;
pub mod table;

pub use change::{Change, Expected, SLOW_MOTION};
pub use setting::FilamentSetting;
pub(crate) use setting::{sections_of, segments_of};
pub use table::Measured;

use crate::scene::{Scene, SceneProblem};
use crate::{Assembly, Estimate, Plan};
use std::fmt;

/// Largest expected error of the displacement that a change may bring.
pub const AT_MOST: f64 = 0.02;

/// What is known of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// The single change that saves most, if any is known to save.
    pub change: Option<Box<Change>>,
    /// The measured scene that it is like. Without one nothing is known of other resolutions.
    pub like: Option<&'static str>,
}

impl Advice {
    /// The single change that would save `scene` most time at an expected error of the displacement
    /// of [`AT_MOST`].
    ///
    /// # Errors
    /// A scene that cannot be built, or whose time step is refused.
    pub fn of(scene: &Scene) -> Result<Self, SceneProblem> {
        scene.validate()?;
        let assembly = Assembly::build(scene)?;
        Ok(Plan::new(&assembly)?.advice())
    }

    /// The same of a scene that has been built and, if it is a motion, estimated, which for large
    /// scenes takes most of the time.
    pub(crate) fn of_estimated(
        scene: &Scene,
        assembly: &Assembly,
        estimate: Option<&Estimate>,
    ) -> Self {
        let known = scenes::all();
        let like = known.iter().find(|(_, m)| like::is_like(scene, m));
        let like = like.map(|(name, measured)| (*name, like::length(measured)));
        Self {
            change: change::best(scene, (assembly, estimate), like).map(Box::new),
            like: like.map(|(name, _)| name),
        }
    }
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unknown = "nothing like this scene was measured: what cheaper resolutions would cost in \
                       accuracy is not known";
        match (&self.change, self.like) {
            (Some(change), Some(_)) => write!(f, "{change}"),
            (Some(change), None) => write!(f, "{change}; {unknown}"),
            (None, Some(like)) => write!(
                f,
                "no single change is known to save time at an error of {:.0} % or less (measured \
                 on {like})",
                100.0 * AT_MOST
            ),
            (None, None) => f.write_str(unknown),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RodLaw, Task};

    fn cantilever() -> Scene {
        scenes::all().remove(0).1
    }

    /// The advice for the cantilever of Figure 4, every monomer resolved. Most of its time are
    /// the files of a run, which any resolution has.
    #[test]
    fn the_advice_for_the_cantilever() {
        let advice = Advice::of(&cantilever()).unwrap().to_string();
        assert_eq!(
            advice,
            "replace all monomers by a rod of 40 nm segments with law Homogenised: 1.7 times cheaper, expected \
             errors: tip 2.0 %, energy 2.5 %, torque 0.6 %, curvature at the wall 19.2 % (filaments of 64 drawn \
             bonds scatter by 3.3 %; measured on cantilever-160)"
        );
    }

    /// What is advised is accepted by every rule, can be built, is cheaper, and has what the scene had:
    /// its loads, linkers, path and length.
    #[test]
    fn advice_is_never_refused() {
        for (name, scene) in scenes::all() {
            let Some(change) = Advice::of(&scene).unwrap().change else {
                continue;
            };
            change.scene.validate().unwrap();
            let seconds = |scene: &Scene| {
                let assembly = Assembly::build(scene).unwrap();
                Plan::new(&assembly).unwrap().cost().seconds.total()
            };
            assert!(seconds(&change.scene) < seconds(&scene), "{name}");
            assert_eq!(change.scene.loads, scene.loads);
            assert_eq!(change.scene.linkers, scene.linkers);
            assert_eq!(change.scene.path, scene.path);
            let length = |scene: &Scene| scene.filament.sections.last().unwrap().span_nm().1;
            assert!(
                (length(&change.scene) - length(&scene)).abs() < 1e-9,
                "{name}"
            );
            let Expected::Errors(row) = change.expected else {
                panic!("{name}: {change:?}");
            };
            assert!(row.displacement.is_some_and(|e| e <= AT_MOST), "{name}");
        }
    }

    /// A damped motion that stops at rest is an equilibrium in disguise, and a finer resolution is never
    /// advised: a pure rod has nothing to replace.
    #[test]
    fn advice_only_saves() {
        let mut scene = FilamentSetting::of(vec![], RodLaw::Constant).apply(&cantilever());
        let (nothing, like) = (None, Some("cantilever-160"));
        let change = nothing.clone();
        assert_eq!(Advice::of(&scene).unwrap(), Advice { change, like });
        let text = scene.to_ron();
        assert!(matches!(scene.task, Task::Equilibrium(_)), "{text}");
        scene.filament.monomers.rise_nm = 2.76;
        let (change, like) = (nothing, None);
        assert_eq!(Advice::of(&scene).unwrap(), Advice { change, like });
    }

    /// Outside of heat baths the law without heat is the one that was measured.
    #[test]
    fn the_law_without_heat_is_known() {
        let advised = |law| {
            let setting = FilamentSetting {
                bonds: 16,
                ..FilamentSetting::of(vec![[0.0, 60.0]], law)
            };
            let advice = Advice::of(&setting.apply(&cantilever())).unwrap();
            advice.change.map(|change| change.what)
        };
        let known = advised(RodLaw::Homogenised);
        assert!(
            known.as_deref().is_some_and(|what| what.contains("bonds")),
            "{known:?}"
        );
        assert_eq!(advised(RodLaw::HomogenisedAthermal), known);
    }

    /// 60 nm of monomers on a wall with this task.
    fn asked(task: &str) -> Scene {
        Scene::from_ron(&format!(
            "Scene(
                filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 60.0)]),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: (1.0, 0.0, 0.0))],
                task: {task},
            )"
        ))
        .unwrap()
    }

    /// A motion that is wanted for itself goes on with the method that is cheapest at the same share
    /// of its limit: four evaluations a step of 2.98945 / omega against one of 2 / omega.
    #[test]
    fn a_motion_is_cheaper_with_another_method() {
        let with = |task| Advice::of(&asked(task)).unwrap();
        // So long that setting up and writing take a thousandth.
        let motion = with("Dynamics(duration_ns: 1e5)");
        assert_eq!(motion.like, None);
        let change = motion.change.clone().unwrap();
        assert_eq!(change.expected, Expected::SlowMotion);
        let ratio = 4.0 / 2.989_45 * 2.0;
        assert!((change.times_cheaper - ratio).abs() < 0.01, "{change}");
        assert!(motion.to_string().contains("PositionVerlet"), "{motion}");
        for other in [
            "Dynamics(duration_ns: 100.0, integrator: PositionVerlet)",
            "Dynamics(duration_ns: 100.0, time_step_ns: 0.001)",
            "Dynamics(duration_ns: 100.0, step_safety: 0.9)",
            "Dynamics(duration_ns: 100.0, drag: (translational_per_ns: 2e4, rotational_per_ns: 1.0))",
            "Dynamics(duration_ns: 100.0, drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0), \
             thermal: (temperature_k: 298.0, seed: 1))",
        ] {
            assert_eq!(with(other).change, None, "{other}");
        }
    }

    /// Where a motion stops at rest, that state is had for less, whether the scene was measured or not.
    #[test]
    fn a_state_at_rest_is_asked_for_as_one() {
        let mut scene = asked(
            "Dynamics(duration_ns: 100.0, drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0), \
             stop: (force_pn: 1e-4, torque_pn_nm: 1e-4, kinetic_pn_nm: 1e-8))",
        );
        scene.filament.monomers.rise_nm = 2.76;
        let advice = Advice::of(&scene).unwrap();
        assert_eq!(advice.like, None);
        assert_eq!(advice.change.unwrap().expected, Expected::AtRest);
    }
}
