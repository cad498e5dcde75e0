//! Length, size and twist of the centre line.

use super::View;
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
    let edges = edges(view, filament);
    vec![
        edges.iter().map(|(_, [a, b])| (b - a).norm()).sum(),
        gyration_radius(&edges),
        ribbon.largest_distance_nm(),
        ribbon.twist(),
    ]
}

/// Length at rest (nm) and ends of an edge of the centre line.
type Edge = (f64, [Vector3; 2]);

/// Edges between the ends of a filament. Its centre line continues to held monomers beyond them.
pub(super) fn edges(view: &View<'_>, filament: usize) -> Vec<Edge> {
    let ribbon = view.ribbon(filament);
    let end_nm = view.assembly.length_of(filament);
    let places = ribbon.s_nm.windows(2).zip(ribbon.points_nm.windows(2));
    let inside = places.filter_map(|(s_nm, points)| {
        let [from, to] = [s_nm[0], s_nm[1]].map(|s| s.clamp(0.0, end_nm));
        let length = s_nm[1] - s_nm[0];
        let at = |s: f64| points[0].lerp(&points[1], (s - s_nm[0]) / length);
        (from < to).then(|| (to - from, [at(from), at(to)]))
    });
    inside.collect()
}

fn length_at_rest(edges: &[Edge]) -> f64 {
    edges.iter().map(|(length, _)| length).sum()
}

/// Centre of the centre line, weighted by rest length (nm).
pub(super) fn centre(edges: &[Edge]) -> Vector3 {
    let moments = edges
        .iter()
        .map(|(length, [a, b])| (a + b) * (0.5 * length));
    moments.sum::<Vector3>() / length_at_rest(edges)
}

/// Root-mean-square distance of the centre line from its centre (nm), exact for straight edges: `L
/// / sqrt(12)` for a straight filament.
fn gyration_radius(edges: &[Edge]) -> f64 {
    let centre = centre(edges);
    let squares = edges.iter().map(|(length, ends)| {
        let [a, b] = ends.map(|end| end - centre);
        length * (a.norm_squared() + a.dot(&b) + b.norm_squared()) / 3.0
    });
    (squares.sum::<f64>() / length_at_rest(edges)).sqrt()
}

#[cfg(test)]
mod tests {
    use crate::observe::tests::{build, observe, value};

    /// Held monomers beyond the clamped points do not count. A straight line has the radius of gyration `L / sqrt(12)`.
    #[test]
    fn a_contour_lies_between_the_ends() {
        for clamps in [
            "",
            "Clamp(end: Start)",
            "Clamp(end: Start), Clamp(end: End)",
        ] {
            let assembly = build(&format!(
                "Scene(
                    filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 30.0)]),
                    clamps: [{clamps}],
                    observe: [Contour()],
                    task: Equilibrium(),
                )"
            ));
            let row = observe(&assembly, &assembly.rest);
            let length = assembly.length_nm();
            let found = value(&assembly, &row, "contour[0]_length_nm");
            assert!((found - length).abs() < 1e-12, "{clamps}: {found} {length}");
            let found = value(&assembly, &row, "contour[0]_gyration_radius_nm");
            assert!(
                (found - length / 12.0_f64.sqrt()).abs() < 1e-12,
                "{clamps}: {found}"
            );
        }
    }
}
