//! Positions of ends, end-to-end vector, and reactions of clamps.

use super::{View, vector};
use crate::End;

/// Columns of the position of an end.
pub(super) fn tip_columns(filament: usize, end: End) -> Vec<String> {
    let name = match end {
        End::Start => "start",
        End::End => "tip",
    };
    vector(&format!("{name}[{filament}]"), "_nm")
}

/// Position of an end.
pub(super) fn tip(view: &View<'_>, filament: usize, end: End) -> Vec<f64> {
    let tip = view.assembly.tip_of(filament, view.state, end);
    tip.as_slice().to_vec()
}

/// Columns of the vector from the start to the end, and of its length.
pub(super) fn end_to_end_columns(filament: usize) -> Vec<String> {
    let name = format!("end_to_end[{filament}]");
    let mut columns = vector(&name, "_nm");
    columns.push(format!("{name}_nm"));
    columns
}

/// Vector from the start to the end, and its length.
pub(super) fn end_to_end(view: &View<'_>, filament: usize) -> Vec<f64> {
    let at = |end| view.assembly.tip_of(filament, view.state, end);
    let reach = at(End::End) - at(End::Start);
    vec![reach.x, reach.y, reach.z, reach.norm()]
}

/// Columns of the force and torque of a clamp on the filament, with the torque about the clamped point.
pub(super) fn reaction_columns(filament: usize, end: End) -> Vec<String> {
    let name = format!("reaction[{filament}]_{end}");
    let force = vector(&format!("{name}_force"), "_pn");
    let torque = vector(&format!("{name}_torque"), "_pn_nm");
    [force, torque].concat()
}

/// Force and torque of a clamp on the filament.
pub(super) fn reaction(view: &View<'_>, filament: usize, end: End) -> Vec<f64> {
    let clamp = view.assembly.clamp_at(filament, end);
    let clamp = clamp.expect("the rules of scenes refuse reactions of free ends");
    let reaction = clamp.reaction(view.state, view.loads());
    let numbers = reaction.force_pn.iter().chain(&reaction.torque_pn_nm);
    numbers.copied().collect()
}
