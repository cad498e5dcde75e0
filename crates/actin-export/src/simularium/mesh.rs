//! Surface meshes of ellipsoids in Wavefront OBJ format.

use std::f64::consts::PI;
use std::fmt::Write;

/// Number of rings between the poles, and of points on each ring.
const RINGS: usize = 15;
const AROUND: usize = 24;

/// Returns an ellipsoid centred at the origin, with semi-axes along x, y and z, and its normals.
pub(super) fn ellipsoid(semi_axes: [f64; 3]) -> String {
    let mut text = String::from("# ellipsoid\n");
    let mut point = |direction: [f64; 3]| {
        let [x, y, z] = [0, 1, 2].map(|k| semi_axes[k] * direction[k]);
        // The gradient of the quadratic form; readers normalise it.
        let [u, v, w] = [0, 1, 2].map(|k| direction[k] / semi_axes[k]);
        writeln!(text, "v {x:.6} {y:.6} {z:.6}\nvn {u:.6} {v:.6} {w:.6}")
            .expect("writing to a string cannot fail");
    };
    point([0.0, 0.0, 1.0]);
    for ring in 1..=RINGS {
        let polar = PI * ring as f64 / (RINGS + 1) as f64;
        for step in 0..AROUND {
            let azimuth = 2.0 * PI * step as f64 / AROUND as f64;
            let across = polar.sin();
            point([across * azimuth.cos(), across * azimuth.sin(), polar.cos()]);
        }
    }
    point([0.0, 0.0, -1.0]);
    for face in faces() {
        let corners: Vec<String> = face.iter().map(|i| format!("{i}//{i}")).collect();
        writeln!(text, "f {}", corners.join(" ")).expect("writing to a string cannot fail");
    }
    text
}

/// Returns the corners of all faces, counted from 1, anticlockwise as seen from outside.
fn faces() -> Vec<Vec<usize>> {
    let at = |ring: usize, step: usize| 2 + (ring - 1) * AROUND + step % AROUND;
    let last = 2 + RINGS * AROUND;
    let steps = 0..AROUND;
    let top = steps.clone().map(|s| vec![1, at(1, s), at(1, s + 1)]);
    let between = (1..RINGS).flat_map(|ring| {
        let quadrangle = move |s| {
            vec![
                at(ring, s),
                at(ring + 1, s),
                at(ring + 1, s + 1),
                at(ring, s + 1),
            ]
        };
        (0..AROUND).map(quadrangle)
    });
    let bottom = steps.map(|s| vec![last, at(RINGS, s + 1), at(RINGS, s)]);
    top.chain(between).chain(bottom).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertices(text: &str) -> Vec<[f64; 3]> {
        let lines = text.lines().filter_map(|line| line.strip_prefix("v "));
        let numbers =
            |line: &str| -> Vec<f64> { line.split(' ').map(|n| n.parse().unwrap()).collect() };
        lines
            .map(|line| numbers(line).try_into().unwrap())
            .collect()
    }

    /// All corners lie on the ellipsoid. The tetrahedra from the centre to the faces have positive volume, and their
    /// sum is 4/3 pi abc except for the discretisation error.
    #[test]
    fn faces_close_the_ellipsoid() {
        let axes = [0.7, 1.0, 0.9];
        let text = ellipsoid(axes);
        let vertices = vertices(&text);
        for v in &vertices {
            let form: f64 = (0..3).map(|k| (v[k] / axes[k]).powi(2)).sum();
            // The file has six decimals.
            assert!((form - 1.0).abs() < 1e-5);
        }
        let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
            a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        let mut volume = 0.0;
        for face in faces() {
            let corner = |i: usize| vertices[face[i] - 1];
            for k in 1..face.len() - 1 {
                let part = det(corner(0), corner(k), corner(k + 1)) / 6.0;
                assert!(part > 0.0, "{face:?}");
                volume += part;
            }
        }
        let exact = 4.0 / 3.0 * PI * axes.iter().product::<f64>();
        // Relative volume error of the facets: about 2 (pi/16)^2 / 6 + (2 pi/24)^2 / 6.
        let cut = 1.0 - volume / exact;
        assert!(cut > 0.0 && cut < 0.03, "{cut}");
    }
}
