//! `profile.csv`: local fields of the last record along each filament.

use crate::names::PROFILE;
use crate::table::{self, Cell};
use actin_sim::mechanics::State;
use actin_sim::{Assembly, shape};
use std::io::{self, Write};

const COLUMNS: [&str; 13] = [
    "s_nm",
    "x_nm",
    "y_nm",
    "z_nm",
    "curvature_rad_per_nm",
    "twist_rad_per_nm",
    "energy_per_length_pn",
    "section",
    "filament",
    "tension_pn",
    "shear_pn",
    "moment_pn_nm",
    "torque_pn_nm",
];

/// Writes the profiles of all filaments in a state.
pub(crate) fn write(assembly: &Assembly, state: &State, out: &mut impl Write) -> io::Result<()> {
    let filaments = 0..assembly.filaments.len();
    let rows = filaments.flat_map(|filament| {
        let points = shape::profile_of(assembly, filament, state).into_iter();
        points.map(move |point| {
            let [x, y, z] = point.position_nm.into();
            let section = if point.is_ellipsoids {
                "ellipsoids"
            } else {
                "rod"
            };
            let numbers = [
                point.s_nm,
                x,
                y,
                z,
                point.curvature_rad_per_nm,
                point.twist_rad_per_nm,
                point.energy_per_length_pn,
            ];
            let texts = [section.to_owned(), filament.to_string()];
            let loads = [
                point.load.tension_pn(),
                point.load.shear_pn(),
                point.load.bending_moment_pn_nm(),
                point.load.torque_pn_nm(),
            ];
            Ok(numbers
                .map(Cell::Number)
                .into_iter()
                .chain(texts.map(Cell::Text))
                .chain(loads.map(Cell::Number)))
        })
    });
    table::write(PROFILE, &COLUMNS.map(str::to_owned), rows, out)
}
