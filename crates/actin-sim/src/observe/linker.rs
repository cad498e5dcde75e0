//! What linkers do.

use super::{Observe, Past, View, vector};

/// The force of a linker on the filament at its site, its tension and its length.
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

    fn observe(&self, view: &View<'_>, _past: &mut Past, row: &mut Vec<f64>) {
        let linker = &view.assembly.linkers[self.linker];
        let written = &view.assembly.scene.linkers[self.linker];
        let force = linker.force(view.state);
        let extension = linker.extension(view.state);
        row.extend(force.iter());
        row.push(written.stiffness_pn_per_nm * extension);
        row.push(written.rest_length_nm + extension);
    }
}
