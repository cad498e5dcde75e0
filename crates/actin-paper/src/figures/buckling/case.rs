//! One buckled filament: what it is made of, how it is held, turned and pushed together, and the
//! scene that says so.

use super::group::{Figure, Group};
use super::resolved::{LENGTH_NM, Resolved};
use crate::run::scenario;
use actin_sim::{Hold, Scene, Section, Setting, Stage, Task};

/// Length of a filament of monomers alone between its inner held monomers, where rods of
/// [`LENGTH_NM`] are held in node and frame (nm): the frame held lies half a segment inside.
const MONOMERS_NM: f64 = 290.0;

/// Lengths of the rod part (nm), split evenly between the ends, as in the paper.
pub(super) const ROD_LENGTHS: [u32; 7] = [40, 73, 107, 140, 173, 207, 240];

/// The order in which the ends are moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// Turned, then pushed together.
    TwistFirst,
    /// Pushed together, then turned.
    CompressionFirst,
    /// Both at once.
    Together,
}

/// What decides which of several equilibria is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Start {
    pub order: Order,
    /// Azimuth of the pull that breaks the symmetry (deg).
    pub pull_deg: u32,
    /// Whether the path is followed in small steps.
    pub small_steps: bool,
}

/// One filament along one path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Case {
    pub group: Group,
    pub resolved: Resolved,
    /// Turn of each end, opposite at the other; positive is over-twist (deg).
    pub turn_deg: i32,
    /// Seed of the bonds.
    pub seed: u64,
    pub start: Start,
}

/// Largest step of a path in small steps, as a share of a stage.
const SMALL_STEP: f64 = 0.04;
/// Random starts from which other stable states are looked for.
const STATES: usize = 16;

impl Start {
    /// Twist first, pulled towards +x.
    pub(super) const DEFAULT: Self = Self {
        order: Order::TwistFirst,
        pull_deg: 0,
        small_steps: false,
    };

    /// Name in tables.
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

impl Case {
    /// A case from its default start.
    pub(super) fn new(group: Group, resolved: Resolved, turn_deg: i32, seed: u64) -> Self {
        Self {
            group: group.relevant_to(resolved),
            resolved,
            turn_deg,
            seed: if resolved == Resolved::Rod {
                0
            } else {
                group.seed(seed)
            },
            start: Start::DEFAULT,
        }
    }

    /// The same case from another start.
    pub(super) fn from(self, start: Start) -> Self {
        Self { start, ..self }
    }

    /// `over/180` or `under/180`.
    pub(super) fn turn_name(turn_deg: i32) -> String {
        let direction = if turn_deg > 0 { "over" } else { "under" };
        format!("{direction}/{}", turn_deg.abs())
    }

    /// Name in messages.
    pub(super) fn name(&self) -> String {
        let (turn, resolved) = (Self::turn_name(self.turn_deg), self.resolved.name());
        format!("{turn}/{resolved}/seed-{}/{}", self.seed, self.start.name())
    }

    /// The scene: the one in the folder of the figure, with what the case changes.
    pub(super) fn scene(&self) -> Result<Scene, String> {
        let folder = match self.group.figure {
            Figure::Eight => "figure-8",
            Figure::Ten => "figure-10",
        };
        let mut scene = scenario(&format!("{folder}/rod-140.ron"))?;
        self.apply(&mut scene);
        Ok(scene)
    }

    /// Whether other stable states are looked for: of the filaments that the figure shows, one sampling.
    fn looks_around(&self) -> bool {
        let is_shown = self.group == Group::main(self.group.figure);
        is_shown && self.seed == 0 && self.start == Start::DEFAULT
    }

    fn apply(&self, scene: &mut Scene) {
        scene.title = self.name();
        scene.filament.sections = self.sections().into();
        self.group.apply(scene, self.seed);
        let hold = match self.resolved {
            Resolved::Ellipsoids => Hold::Wall,
            _ => self.group.hold,
        };
        scene.clamps.iter_mut().for_each(|clamp| clamp.hold = hold);
        for linker in &mut scene.linkers {
            linker.at_nm = 0.5 * self.length_nm();
            let (sin, cos) = f64::from(self.start.pull_deg).to_radians().sin_cos();
            let [x, y, z] = linker.displaced_nm.unwrap_or_default();
            linker.displaced_nm = Some([cos * x - sin * y, sin * x + cos * y, z]);
        }
        scene.path = self.path(&scene.path);
        if let Task::Equilibrium(equilibrium) = &mut scene.task {
            if self.start.small_steps {
                equilibrium.largest_step = SMALL_STEP;
            }
            if self.looks_around() {
                equilibrium.states = STATES;
            }
        }
    }

    fn length_nm(&self) -> f64 {
        match (self.resolved, self.group.hold) {
            (Resolved::Ellipsoids, Hold::NodeAndFrame | Hold::TwoNodesAndFrame) => MONOMERS_NM,
            _ => LENGTH_NM,
        }
    }

    fn sections(&self) -> Vec<Section> {
        let rod = |from_nm, to_nm| Section::rod(from_nm, to_nm, None);
        let monomers = |from_nm, to_nm| Section::Ellipsoids {
            from_nm,
            to_nm,
            altered: None,
        };
        let length = self.length_nm();
        match self.resolved {
            Resolved::Rod => vec![rod(0.0, length)],
            Resolved::Ellipsoids => vec![monomers(0.0, length)],
            Resolved::Mixed(total) => {
                let (from, to) = (0.5 * f64::from(total), length - 0.5 * f64::from(total));
                vec![rod(0.0, from), monomers(from, to), rod(to, length)]
            }
        }
    }

    /// The stages of the scene, turn before shift, with the turn and in the order of the case.
    fn path(&self, stages: &[Stage]) -> Vec<Stage> {
        let mut stages = stages.to_vec();
        for setting in stages.iter_mut().flat_map(|stage| &mut stage.set) {
            if let Setting::Turn { turn_deg, .. } = setting {
                turn_deg[2] = f64::from(self.turn_deg).copysign(turn_deg[2] * self.sign());
            }
        }
        match self.start.order {
            Order::TwistFirst => stages,
            Order::CompressionFirst => stages.into_iter().rev().collect(),
            Order::Together => {
                let duration_ns = stages.iter().map(|stage| stage.duration_ns).sum();
                let set = stages.into_iter().flat_map(|stage| stage.set).collect();
                vec![Stage {
                    set,
                    duration_ns,
                    pace: actin_sim::Pace::Smooth,
                }]
            }
        }
    }

    /// +1 for over-twist, -1 for under-twist.
    pub(super) fn sign(&self) -> f64 {
        f64::from(self.turn_deg.signum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(turn_deg: i32, order: Order) -> Case {
        let group = Group::main(Figure::Eight);
        let start = Start {
            order,
            ..Start::DEFAULT
        };
        Case::new(group, Resolved::Mixed(140), turn_deg, 0).from(start)
    }

    /// The default case is the scene as written; under-twist turns both ends the other way; the
    /// orders hold the same settings.
    #[test]
    fn cases_change_what_they_name() {
        let turns = |case: Case| -> Vec<f64> {
            let scene = case.scene().unwrap();
            let settings = scene.path.iter().flat_map(|stage| &stage.set);
            let turn = settings.filter_map(|setting| match setting {
                Setting::Turn { turn_deg, .. } => Some(turn_deg[2]),
                _ => None,
            });
            turn.collect()
        };
        assert_eq!(turns(case(180, Order::TwistFirst)), [-180.0, 180.0]);
        assert_eq!(turns(case(-270, Order::CompressionFirst)), [270.0, -270.0]);
        assert_eq!(turns(case(360, Order::Together)), [-360.0, 360.0]);
    }
}
