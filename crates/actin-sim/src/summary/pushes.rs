//! Perturbations at saddles in `summary.json`.

use crate::SaddlePush;

pub(super) fn numbers((i, push): (usize, &SaddlePush)) -> [(String, f64); 5] {
    [
        ("time_ns", push.time_ns),
        ("energy_pn_nm", push.energy_pn_nm),
        ("lowest_eigenvalue", push.lowest_eigenvalue),
        ("displacement_nm", push.displacement_nm),
        ("turn_rad", push.turn_rad),
    ]
    .map(|(key, value)| (format!("pushes[{i}].{key}"), value))
}
