//! Loads of chains, computed on all threads.

use crate::components::{Components, blocks};
use actin_equilibrium::parallel;
use actin_mechanics::{Coordinates, Interaction, Loads, State};
use std::ops::Range;

/// Smallest number of points of a task. Shorter tasks take less time than their distribution.
const POINTS: usize = 250;

/// Chains by task. Each task has its own buffer, so that sums do not depend on the number of threads.
#[derive(Debug, Default)]
pub(crate) struct LoadTasks {
    tasks: Vec<LoadTask>,
    /// Interactions that act on bodies of several tasks.
    shared: Vec<usize>,
}

#[derive(Debug)]
struct LoadTask {
    interactions: Vec<usize>,
    points: Range<usize>,
    frames: Range<usize>,
    loads: Loads,
}

impl LoadTasks {
    /// Distributes interactions with random stress that act on a single component; their bodies are
    /// the bodies of their stiffness. All others are shared.
    pub(crate) fn new(
        components: &Components,
        interactions: &[Box<dyn Interaction>],
        state: &State,
    ) -> Self {
        let mut all = Self::default();
        for (k, interaction) in interactions.iter().enumerate() {
            let is_own = interaction.random_stress().is_some() && components.is_single(k);
            match Some(interaction).filter(|_| is_own) {
                Some(interaction) => all.push(k, interaction.as_ref(), state),
                None => all.shared.push(k),
            }
        }
        if all.tasks.len() < 2 || !all.are_disjoint() {
            return Self {
                tasks: Vec::new(),
                shared: (0..interactions.len()).collect(),
            };
        }
        all
    }

    fn push(&mut self, k: usize, interaction: &dyn Interaction, state: &State) {
        if self
            .tasks
            .last()
            .is_none_or(|task| task.points.len() >= POINTS)
        {
            self.tasks.push(LoadTask {
                interactions: Vec::new(),
                points: usize::MAX..0,
                frames: usize::MAX..0,
                loads: Loads::zeros(state),
            });
        }
        if let Some(task) = self.tasks.last_mut() {
            task.interactions.push(k);
            let stiffness = blocks(interaction, state);
            for body in stiffness.all().flat_map(|&(a, b, _)| [a, b]) {
                match body {
                    Coordinates::Point(i) => extend(&mut task.points, i),
                    Coordinates::Frame(i) => extend(&mut task.frames, i),
                }
            }
        }
    }

    /// Returns `true` if there are several tasks.
    pub(crate) fn are_several(&self) -> bool {
        self.tasks.len() > 1
    }

    fn are_disjoint(&self) -> bool {
        let mut pairs = self.tasks.windows(2);
        pairs.all(|pair| {
            pair[0].points.end <= pair[1].points.start && pair[0].frames.end <= pair[1].frames.start
        })
    }

    /// Adds what `add` adds for each of the selected interactions.
    pub(crate) fn add(
        &mut self,
        loads: &mut Loads,
        is_selected: impl Fn(usize) -> bool + Sync,
        add: impl Fn(usize, &mut Loads) + Sync,
    ) {
        let is_selected = |k: &&usize| is_selected(**k);
        let unknowns = self.tasks.iter().map(|task| {
            let selected = task.interactions.iter().filter(is_selected).count();
            6 * task.points.len() * selected / task.interactions.len()
        });
        let unknowns = unknowns.sum();
        parallel::map(
            self.tasks.iter_mut().collect(),
            unknowns,
            |task: &mut LoadTask| {
                task.clear();
                let LoadTask {
                    interactions,
                    loads,
                    ..
                } = task;
                interactions
                    .iter()
                    .filter(is_selected)
                    .for_each(|&k| add(k, loads));
            },
        );
        for task in &self.tasks {
            task.add_to(loads);
        }
        self.shared
            .iter()
            .filter(is_selected)
            .for_each(|&k| add(k, loads));
    }
}

impl LoadTask {
    fn clear(&mut self) {
        let Loads { force, torque } = &mut self.loads;
        for (vectors, own) in [(force, &self.points), (torque, &self.frames)] {
            for components in [&mut vectors.x, &mut vectors.y, &mut vectors.z] {
                components[own.clone()].fill(0.0);
            }
        }
    }

    fn add_to(&self, loads: &mut Loads) {
        for i in self.points.clone() {
            loads.force.add(i, self.loads.force.get(i));
        }
        for i in self.frames.clone() {
            loads.torque.add(i, self.loads.torque.get(i));
        }
    }
}

fn extend(range: &mut Range<usize>, i: usize) {
    *range = range.start.min(i)..range.end.max(i + 1);
}
