//! Which cases belong to which figure.

use super::case::{Case, Order, ROD_LENGTHS, Start};
use super::group::{Figure, Group, Rods};
use super::resolved::Resolved;
use actin_sim::{Hold, JunctionWeight};

/// Resolutions, samplings and starts of one run.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub figure: Figure,
    /// Turns of the ends (deg).
    pub turns: Vec<i32>,
    pub resolved: Vec<Resolved>,
    /// Samplings of the bonds.
    pub seeds: u64,
    /// Starts from which every resolution of the main group is solved, and at which turns.
    pub starts: Vec<Start>,
    pub started: Vec<i32>,
    /// Whether filaments are also moved along their path in time.
    pub moving: bool,
}

/// Turn (deg) beyond which the balance as printed is not followed: states are many there.
const FEW_STATES_DEG: i32 = 270;

impl Plan {
    pub(super) fn eight(quick: bool) -> Self {
        Self {
            figure: Figure::Eight,
            turns: vec![180, -180],
            resolved: resolved(quick),
            seeds: if quick { 2 } else { 8 },
            starts: if quick { orders() } else { starts() },
            started: vec![180, -180],
            moving: !quick,
        }
    }

    pub(super) fn ten(quick: bool) -> Self {
        Self {
            figure: Figure::Ten,
            turns: vec![180, -180, 270, -270, 360, -360],
            seeds: if quick { 1 } else { 4 },
            starts: starts(),
            started: if quick { vec![360] } else { vec![360, -360] },
            resolved: resolved(quick),
            moving: !quick,
        }
    }

    /// Groups by the name that precedes their quantities; the first is the one that is compared
    /// and has no name.
    pub(super) fn groups(&self) -> Vec<(&'static str, Group)> {
        let main = self.main();
        let rods = |rods| Group { rods, ..main };
        let wall = Group {
            hold: Hold::Wall,
            ..main
        };
        let full = Group {
            weight: JunctionWeight::Full,
            ..main
        };
        let mean = Group { mean: true, ..main };
        let mut groups = vec![("", main), ("mean-filament/", mean), ("wall/", wall)];
        match self.figure {
            Figure::Eight => groups.push(("full/", full)),
            Figure::Ten => {
                groups.push(("standard/", rods(Rods::Constant)));
                groups.push(("coupling-energy/", rods(Rods::CouplingEnergy)));
                if self.moving {
                    let printed = Group {
                        rods: Rods::PaperBalance,
                        ..mean
                    };
                    groups.push(("paper-balance/", printed));
                }
            }
        }
        groups
    }

    /// The turns at which a group is compared (deg).
    pub(super) fn turns_of(&self, group: Group) -> impl Iterator<Item = i32> {
        let most = match group.rods {
            Rods::PaperBalance => FEW_STATES_DEG,
            _ => i32::MAX,
        };
        let turns = self.turns.iter().copied();
        turns.filter(move |turn| turn.abs() <= most)
    }

    /// Samplings of the bonds of a group.
    pub(super) fn seeds_of(&self, group: Group) -> u64 {
        if group.mean { 1 } else { self.seeds }
    }

    /// The group that is compared.
    pub(super) fn main(&self) -> Group {
        Group::main(self.figure)
    }

    /// Every case, none twice.
    pub(super) fn cases(&self) -> Vec<Case> {
        let mut all = Vec::new();
        for (_, group) in self.groups() {
            let seeds = self.seeds_of(group);
            for turn in self.turns_of(group) {
                for &resolved in &self.resolved {
                    all.extend((0..seeds).map(|s| Case::new(group, resolved, turn, s)));
                }
            }
        }
        for &turn in &self.turns {
            for &resolved in &self.resolved {
                let case = Case::new(self.main(), resolved, turn, 0);
                all.extend(
                    self.starts_at(turn)
                        .into_iter()
                        .map(|start| case.from(start)),
                );
            }
        }
        let mut unique: Vec<Case> = Vec::with_capacity(all.len());
        for case in all {
            if !unique.contains(&case) {
                unique.push(case);
            }
        }
        unique
    }

    /// Starts at a turn: at least both orders.
    pub(super) fn starts_at(&self, turn: i32) -> Vec<Start> {
        if self.started.contains(&turn) {
            self.starts.clone()
        } else {
            orders()
        }
    }
}

fn resolved(quick: bool) -> Vec<Resolved> {
    let lengths: &[u32] = if quick { &[40, 140, 240] } else { &ROD_LENGTHS };
    Resolved::all(lengths)
}

/// Twist first and compression first.
fn orders() -> Vec<Start> {
    let start = |order| Start {
        order,
        ..Start::DEFAULT
    };
    [Order::TwistFirst, Order::CompressionFirst]
        .map(start)
        .into()
}

/// Three orders, each pulled two ways, and two of them in small steps: eight starts.
fn starts() -> Vec<Start> {
    let orders = [Order::TwistFirst, Order::CompressionFirst, Order::Together];
    let mut all: Vec<Start> = orders
        .into_iter()
        .flat_map(|order| {
            [0, 120].map(|pull_deg| Start {
                order,
                pull_deg,
                small_steps: false,
            })
        })
        .collect();
    all.extend(
        [Order::TwistFirst, Order::CompressionFirst].map(|order| Start {
            order,
            pull_deg: 0,
            small_steps: true,
        }),
    );
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At least three samplings, six starts, all resolutions of the paper and both pure cases.
    #[test]
    fn the_plans_hold_what_the_figures_show() {
        for plan in [Plan::eight(false), Plan::ten(false)] {
            assert!(plan.seeds >= 3 && plan.starts.len() >= 6);
            assert_eq!(plan.resolved.len(), 9);
            let cases = plan.cases();
            let default = Case::new(plan.main(), Resolved::Mixed(240), 180, 2);
            assert_eq!(cases.iter().filter(|case| **case == default).count(), 1);
        }
    }

    /// What means nothing for a resolution makes no case of its own: eight of the mean filament, since
    /// the rod has no bonds, and seven junctions as printed at each turn. The balance as printed is a
    /// law of rods.
    #[test]
    fn every_group_adds_the_filaments_that_it_changes() {
        let count = |plan: &Plan, is_in: fn(&Case) -> bool| {
            plan.cases().iter().filter(|case| is_in(case)).count()
        };
        let (eight, ten) = (Plan::eight(false), Plan::ten(false));
        assert_eq!(count(&eight, |case| case.group.mean), 2 * 8);
        let full = |case: &Case| case.group.weight == JunctionWeight::Full;
        assert_eq!(count(&eight, full), 2 * 7 * 8);
        let printed = |case: &Case| case.group.rods == Rods::PaperBalance;
        assert_eq!(count(&ten, printed), 4 * 8);
        assert_eq!(count(&Plan::ten(true), printed), 0);
    }
}
