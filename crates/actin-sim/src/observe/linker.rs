//! Force of a linker on the filament at its site, tension, and distance of its ends.

use super::{View, vector};

pub(super) fn columns(linker: usize) -> Vec<String> {
    let name = format!("linker[{linker}]");
    let mut columns = vector(&format!("{name}_force"), "_pn");
    columns.extend([format!("{name}_tension_pn"), format!("{name}_length_nm")]);
    columns
}

/// The force is zero if the linker is unbound.
pub(super) fn values(view: &View<'_>, i: usize) -> Vec<f64> {
    let (linker, is_bound) = view.assembly.linker_in(i, view.state);
    let written = &view.assembly.scene.linkers[i];
    let holds = f64::from(u8::from(is_bound));
    let extension = linker.extension(view.state);
    let force = holds * linker.force(view.state);
    let tension = holds * written.stiffness_pn_per_nm * extension;
    let length = written.rest_length_nm + extension;
    vec![force.x, force.y, force.z, tension, length]
}
