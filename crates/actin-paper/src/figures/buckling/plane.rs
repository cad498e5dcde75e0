//! Plane of buckling of a filament.

/// Rotates a centre line about the axis (lab z) into its plane of buckling.
///
/// The plane is the principal plane of the largest second moment of (x, y) about the axis. Returns coordinates (nm)
/// along the axis from the middle between the ends, in the plane (positive on average), and out of the plane.
pub(super) fn in_own_plane(line: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let moment = |product: fn(&[f64; 3]) -> f64| line.iter().map(product).sum::<f64>();
    let (xx, xy, yy) = (
        moment(|p| p[0] * p[0]),
        moment(|p| p[0] * p[1]),
        moment(|p| p[1] * p[1]),
    );
    let (sin, cos) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
    let mean: f64 = line.iter().map(|p| cos * p[0] + sin * p[1]).sum();
    let sign = 1.0_f64.copysign(mean);
    let (sin, cos) = (sign * sin, sign * cos);
    let ends = line.first().zip(line.last());
    let middle = ends.map_or(0.0, |(first, last)| 0.5 * (first[2] + last[2]));
    line.iter()
        .map(|[x, y, z]| [*z - middle, cos * x + sin * y, cos * y - sin * x])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::in_own_plane;

    #[test]
    fn plane_arc_has_no_out_of_plane_part() {
        for azimuth in [0.0_f64, 0.7, 2.0, -2.5] {
            let line: Vec<[f64; 3]> = (0..20)
                .map(|k| 0.3 * f64::from(k))
                .map(|z| (z, 4.0 * (z * 0.5).sin().powi(2)))
                .map(|(z, r)| [r * azimuth.cos(), r * azimuth.sin(), z])
                .collect();
            for (seen, place) in in_own_plane(&line).iter().zip(&line) {
                let r = place[0].hypot(place[1]);
                assert!((seen[1] - r).abs() < 1e-12 && seen[2].abs() < 1e-12);
            }
        }
    }
}
