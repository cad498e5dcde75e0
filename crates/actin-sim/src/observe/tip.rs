//! Ends of filaments and the vector between them.

use super::{Observe, StoredPositions, View, vector};
use crate::End;

/// Position of an end.
#[derive(Debug)]
pub(super) struct Tip {
    pub(super) filament: usize,
    pub(super) end: End,
}

impl Observe for Tip {
    fn columns(&self) -> Vec<String> {
        let name = match self.end {
            End::Start => "start",
            End::End => "tip",
        };
        vector(&format!("{name}[{}]", self.filament), "_nm")
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        let tip = view.assembly.tip_of(self.filament, view.state, self.end);
        row.extend(tip.iter());
    }
}

/// Vector from the start to the end, and its length.
#[derive(Debug)]
pub(super) struct EndToEnd {
    pub(super) filament: usize,
}

impl Observe for EndToEnd {
    fn columns(&self) -> Vec<String> {
        let name = format!("end_to_end[{}]", self.filament);
        let mut columns = vector(&name, "_nm");
        columns.push(format!("{name}_nm"));
        columns
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        let at = |end| view.assembly.tip_of(self.filament, view.state, end);
        let reach = at(End::End) - at(End::Start);
        row.extend(reach.iter().copied().chain([reach.norm()]));
    }
}
