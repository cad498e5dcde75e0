//! Scene of one buckled filament: composition, clamps, rotation and compression of the ends.

use super::{LENGTH_NM, file};
use crate::figures::model::{Model, Resolution};
use crate::run::{scenario, sections};
use actin_sim::{Hold, Scene, Setting, Stage, Task, TimeCourse};

/// Length between the inner clamped monomers of a filament without rod (nm). It corresponds to rods of [`LENGTH_NM`]
/// with clamped nodes and frames, because a clamped frame lies half a segment inside.
const MONOMERS_NM: f64 = 290.0;
/// Step of a path in small steps, as a fraction of a stage.
const SMALL_STEP: f64 = 0.04;
const STATES: usize = 16;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    TwistFirst,
    CompressionFirst,
    Together,
}

/// Properties that select one of several equilibria.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Start {
    pub order: Order,
    /// Azimuth of the symmetry-breaking force (deg).
    pub pull_deg: u32,
    pub small_steps: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Case {
    pub model: &'static Model,
    pub resolution: Resolution,
    /// Rotation of each end, in opposite directions (deg). Positive values are over-twist.
    pub turn_deg: i32,
    pub seed: u64,
    pub start: Start,
    /// True for turns with all starts, whose rows include the other stable states.
    pub is_started: bool,
}

impl Start {
    /// Twist first, with the force towards +x.
    pub(super) const DEFAULT: Self = Self {
        order: Order::TwistFirst,
        pull_deg: 0,
        small_steps: false,
    };
    pub(super) const COMPRESSION_FIRST: Self = Self {
        order: Order::CompressionFirst,
        ..Self::DEFAULT
    };

    pub(super) fn orders() -> Vec<Self> {
        vec![Self::DEFAULT, Self::COMPRESSION_FIRST]
    }

    /// Eight starts: three orders with two directions of the force, and two orders in small steps.
    pub(super) fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for order in [Order::TwistFirst, Order::CompressionFirst, Order::Together] {
            all.extend([0, 120].map(|pull_deg| Self {
                order,
                pull_deg,
                small_steps: false,
            }));
        }
        let small = Self::orders().into_iter();
        all.extend(small.map(|start| Self {
            small_steps: true,
            ..start
        }));
        all
    }

    pub(super) fn name(self) -> String {
        let order = match self.order {
            Order::TwistFirst => "twist-first",
            Order::CompressionFirst => "compression-first",
            Order::Together => "together",
        };
        let steps = if self.small_steps { "/small-steps" } else { "" };
        format!("{order}/pull-{}{steps}", self.pull_deg)
    }
}

pub(super) fn turn_name(turn_deg: i32) -> String {
    let direction = if turn_deg > 0 { "over" } else { "under" };
    format!("{direction}/{}", turn_deg.abs())
}

impl Case {
    pub(super) fn path(&self) -> String {
        format!("{}/{}", turn_name(self.turn_deg), self.resolution.name())
    }

    pub(super) fn name(&self) -> String {
        format!("{}/seed-{}/{}", self.path(), self.seed, self.start.name())
    }

    pub(super) fn rod_nm(&self) -> f64 {
        self.resolution.rod_nm(LENGTH_NM)
    }

    /// +1 for over-twist, -1 for under-twist.
    pub(super) fn sign(&self) -> f64 {
        f64::from(self.turn_deg.signum())
    }

    /// True if other stable states are searched: first sampling of filaments in the pictures at turns with all starts,
    /// and filaments without rod in Figure 8 only.
    fn has_states(&self) -> bool {
        let is_new = self.resolution != Resolution::Ellipsoids || self.model.figure == "fig8";
        let is_first = self.seed == 0 && self.start == Start::DEFAULT;
        self.is_started && self.model.is_shown() && is_new && is_first
    }

    pub(super) fn scene(&self) -> Result<Scene, String> {
        let mut scene = scenario(&file(&self.model.figure))?;
        scene.title = self.name();
        scene.filament.sections = sections(self.length_nm(), self.rods(), |_| None).into();
        self.model.apply(&mut scene, self.seed);
        let hold = match self.resolution {
            Resolution::Ellipsoids => Hold::Wall,
            _ => self.model.hold,
        };
        scene.clamps.iter_mut().for_each(|clamp| clamp.hold = hold);
        for linker in &mut scene.linkers {
            linker.at_nm = 0.5 * self.length_nm();
            let (sin, cos) = f64::from(self.start.pull_deg).to_radians().sin_cos();
            let [x, y, z] = linker.displaced_nm.unwrap_or_default();
            linker.displaced_nm = Some([cos * x - sin * y, sin * x + cos * y, z]);
        }
        scene.path = self.path_of(&scene.path);
        if let Task::Equilibrium(equilibrium) = &mut scene.task {
            if self.start.small_steps {
                equilibrium.largest_step = SMALL_STEP;
            }
            if self.has_states() {
                equilibrium.states = STATES;
            }
        }
        Ok(scene)
    }

    fn length_nm(&self) -> f64 {
        match (self.resolution, self.model.hold) {
            (Resolution::Ellipsoids, Hold::NodeAndFrame | Hold::TwoNodesAndFrame) => MONOMERS_NM,
            _ => LENGTH_NM,
        }
    }

    /// Arc lengths of rods (nm).
    fn rods(&self) -> Vec<[f64; 2]> {
        let (length, half) = (self.length_nm(), 0.5 * self.rod_nm());
        match self.resolution {
            Resolution::Rod => vec![[0.0, length]],
            Resolution::Ellipsoids => Vec::new(),
            Resolution::Mixed(_) => vec![[0.0, half], [length - half, length]],
        }
    }

    /// Stages of the scene (turn, then shift) with the turn and the order of the case.
    fn path_of(&self, stages: &[Stage]) -> Vec<Stage> {
        let mut stages = stages.to_vec();
        for setting in stages.iter_mut().flat_map(|stage| &mut stage.set) {
            if let Setting::Turn { turn_deg, .. } = setting {
                turn_deg[2] = f64::from(self.turn_deg).copysign(turn_deg[2] * self.sign());
            }
        }
        match self.start.order {
            Order::TwistFirst => stages,
            Order::CompressionFirst => stages.into_iter().rev().collect(),
            Order::Together => vec![Stage {
                duration_ns: stages.iter().map(|stage| stage.duration_ns).sum(),
                set: stages.into_iter().flat_map(|stage| stage.set).collect(),
                pace: TimeCourse::Smooth,
            }],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Plan;
    use super::*;

    #[test]
    fn turns_and_orders_are_applied() {
        let plan = Plan::figure8(false);
        let turns = |turn_deg, order| -> Vec<f64> {
            let case = plan.case(plan.shown(), Resolution::Mixed(140), turn_deg, 0);
            let start = Start {
                order,
                ..Start::DEFAULT
            };
            let scene = Case { start, ..case }.scene().unwrap();
            let settings = scene.path.iter().flat_map(|stage| &stage.set);
            let turn = settings.filter_map(|setting| match setting {
                Setting::Turn { turn_deg, .. } => Some(turn_deg[2]),
                _ => None,
            });
            turn.collect()
        };
        assert_eq!(turns(180, Order::TwistFirst), [-180.0, 180.0]);
        assert_eq!(turns(-270, Order::CompressionFirst), [270.0, -270.0]);
        assert_eq!(turns(360, Order::Together), [-360.0, 360.0]);
    }
}
