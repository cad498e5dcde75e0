//! Length, size and twist of the centre line.

use super::View;
use crate::shape::Ribbon;
use actin_mechanics::Vector3;

pub(super) fn columns(filament: usize) -> Vec<String> {
    [
        "length_nm",
        "gyration_radius_nm",
        "largest_distance_nm",
        "twist_turns",
    ]
    .map(|what| format!("contour[{filament}]_{what}"))
    .into()
}

/// Length, radius of gyration, largest distance from the axis as built, and twist of the centre
/// line.
pub(super) fn values(view: &View<'_>, filament: usize) -> Vec<f64> {
    let ribbon = view.ribbon(filament);
    let edges = ribbon.points_nm.windows(2);
    vec![
        edges.map(|ends| (ends[1] - ends[0]).norm()).sum(),
        gyration_radius(ribbon),
        ribbon.largest_distance_nm(),
        ribbon.twist(),
    ]
}

fn edges(ribbon: &Ribbon) -> impl Iterator<Item = (f64, Vector3, Vector3)> + '_ {
    let lengths = ribbon.s_nm.windows(2).map(|s| s[1] - s[0]);
    let ends = ribbon.points_nm.windows(2).map(|p| (p[0], p[1]));
    lengths.zip(ends).map(|(length, (a, b))| (length, a, b))
}

fn length_at_rest(ribbon: &Ribbon) -> f64 {
    ribbon.s_nm[ribbon.s_nm.len() - 1] - ribbon.s_nm[0]
}

/// Centre of the centre line, weighted by rest length (nm).
pub(super) fn centre(ribbon: &Ribbon) -> Vector3 {
    let sum: Vector3 = edges(ribbon).map(|(l, a, b)| (a + b) * (0.5 * l)).sum();
    sum / length_at_rest(ribbon)
}

/// Root-mean-square distance of the centre line from its centre (nm), exact for straight edges: `L
/// / sqrt(12)` for a straight filament.
fn gyration_radius(ribbon: &Ribbon) -> f64 {
    let centre = centre(ribbon);
    let squares = edges(ribbon).map(|(length, a, b)| {
        let (a, b) = (a - centre, b - centre);
        length * (a.norm_squared() + a.dot(&b) + b.norm_squared()) / 3.0
    });
    (squares.sum::<f64>() / length_at_rest(ribbon)).sqrt()
}
