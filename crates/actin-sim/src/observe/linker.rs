//! Forces and lengths of linkers.

use super::{Observe, StoredPositions, View, vector};

/// Force of a linker on the filament at its site, tension, and distance of its ends. The force is
/// zero if unbound.
#[derive(Debug)]
pub(super) struct Linker {
    pub(super) linker: usize,
}

impl Observe for Linker {
    fn columns(&self) -> Vec<String> {
        let name = format!("linker[{}]", self.linker);
        let mut columns = vector(&format!("{name}_force"), "_pn");
        columns.extend([format!("{name}_tension_pn"), format!("{name}_length_nm")]);
        columns
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        let (linker, is_bound) = view.assembly.linker_in(self.linker, view.state);
        let written = &view.assembly.scene.linkers[self.linker];
        let holds = f64::from(u8::from(is_bound));
        let extension = linker.extension(view.state);
        row.extend((holds * linker.force(view.state)).iter());
        row.push(holds * written.stiffness_pn_per_nm * extension);
        row.push(written.rest_length_nm + extension);
    }
}
