//! Distribution of the parts of a matrix to tasks.

use crate::layout::Layout;
use crate::pattern::Pattern;
use actin_mechanics::Stiffness;
use std::ops::Range;

/// Parts whose blocks are in the columns of one task, and other parts.
#[derive(Debug, Default)]
pub(crate) struct Distribution {
    pub(crate) tasks: Vec<TaskParts>,
    /// Parts with links, without blocks, or with blocks in several tasks.
    pub(crate) shared: Vec<usize>,
}

#[derive(Debug, Default)]
pub(crate) struct TaskParts {
    /// Nodes whose columns belong to the task.
    pub(crate) nodes: Range<usize>,
    /// Parts (ascending).
    pub(crate) parts: Vec<usize>,
    /// Blocks of one part.
    pub(crate) blocks: Stiffness,
}

impl Distribution {
    /// Distributes parts with the given first blocks and links.
    pub(crate) fn new(pattern: &Pattern, starts: &[[usize; 2]], layout: &Layout) -> Self {
        let mut tasks: Vec<TaskParts> = Vec::new();
        let mut of_nodes = Vec::with_capacity(layout.len());
        for (node, (_, columns)) in layout.nodes().enumerate() {
            if pattern.tasks.binary_search(&columns.start).is_ok() {
                tasks.push(TaskParts {
                    nodes: node..node,
                    ..TaskParts::default()
                });
            }
            let task = tasks.len() - 1;
            tasks[task].nodes.end = node + 1;
            of_nodes.push(task);
        }
        let mut shared = Vec::new();
        for (k, part) in starts.windows(2).enumerate() {
            let places = &pattern.places[part[0][0]..part[1][0]];
            let nodes = places.iter().filter_map(|place| place.column_node());
            let mut own = nodes.map(|node| of_nodes[node]);
            let first = own.next();
            match first.filter(|first| part[0][1] == part[1][1] && own.all(|task| task == *first)) {
                Some(task) => tasks[task].parts.push(k),
                None => shared.push(k),
            }
        }
        Self { tasks, shared }
    }
}
