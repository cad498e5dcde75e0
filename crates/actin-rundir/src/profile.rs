//! `profile.csv`: local fields of the last record along each filament.

use crate::RunDirectoryError;
use crate::finite::ensure_finite;
use actin_sim::shape::ProfilePoint;
use std::io::{self, Write};

const COLUMNS: [&str; 7] = [
    "s_nm",
    "x_nm",
    "y_nm",
    "z_nm",
    "curvature_rad_per_nm",
    "twist_rad_per_nm",
    "energy_per_length_pn",
];

fn numbers(point: &ProfilePoint) -> [f64; 7] {
    let [x, y, z] = point.position_nm.into();
    [
        point.s_nm,
        x,
        y,
        z,
        point.curvature_rad_per_nm,
        point.twist_rad_per_nm,
        point.energy_per_length_pn,
    ]
}

/// Refuses values that are not finite; `points` has one list per filament.
pub(crate) fn ensure_all_finite(
    points: &[Vec<ProfilePoint>],
    file: &str,
) -> Result<(), RunDirectoryError> {
    let count = points.iter().map(Vec::len).sum();
    for (column, name) in COLUMNS.iter().enumerate() {
        let values = points.iter().flatten().map(|point| numbers(point)[column]);
        ensure_finite(file, name, &[count], values)?;
    }
    Ok(())
}

/// Writes a header and one row per point; the last two columns are the section kind and the
/// filament index. Numbers have enough digits for an exact round trip.
pub(crate) fn write(points: &[Vec<ProfilePoint>], out: &mut impl Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(COLUMNS.into_iter().chain(["section", "filament"]))?;
    for (filament, points) in points.iter().enumerate() {
        let filament = filament.to_string();
        for point in points {
            let section = if point.is_ellipsoids {
                "ellipsoids"
            } else {
                "rod"
            };
            let row = numbers(point).map(|value| format!("{value:?}"));
            let what = [section, &filament];
            writer.write_record(row.iter().map(String::as_str).chain(what))?;
        }
    }
    writer.flush()
}
