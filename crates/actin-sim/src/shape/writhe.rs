//! Writhe of polygons and of polylines with straight extensions.
//!
//! Each pair of edges contributes the solid angle of the directions between them, the exact Gauss
//! integral over both edges. The only error is round-off.
//!
//! # Source
//! K. Klenin and J. Langowski, Biopolymers 54 (2000) 307, method 1a. Solid angles are sums of
//! triangles after A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125, which
//! are accurate where the arcsines of the paper lose half of their digits.

use actin_mechanics::Vector3;
use std::f64::consts::PI;

/// Angle (rad) below which rays are parallel: the accuracy of a scene's six digits.
const SAME_WAY: f64 = 1e-5;

/// Writhe of the closed polygon through `points`; the last edge leads back to the first point.
///
/// ```text
/// Wr = 1/(4 pi) oint oint (dr1 x dr2) . (r1 - r2) / |r1 - r2|^3
/// ```
///
/// Right-handed crossings are positive; a planar polygon has zero writhe. The cost is `n^2 / 2`
/// solid angles.
#[cfg(test)]
fn closed_writhe(points: &[Vector3]) -> f64 {
    let n = points.len();
    let edge = |i: usize| [points[i], points[(i + 1) % n]];
    let mut sum = 0.0;
    for i in 0..n {
        // Adjacent edges are coplanar and contribute zero.
        for j in i + 2..n {
            if (j + 1) % n != i {
                sum += edge_and_edge(edge(i), edge(j));
            }
        }
    }
    sum / (2.0 * PI)
}

/// Writhe of the polyline through `points` with extensions from infinity along the unit vector
/// `tangents[0]` and to infinity along `tangents[1]`.
///
/// For equal tangents it is the limit of closed curves that return in a distant plane arc. Then
/// `twist + writhe = link` holds, with the link given by the relative rotation of the extensions
/// (Fuller and White). For other tangents it is a smooth function of the curve, but the link is not
/// defined.
pub(crate) fn extended_writhe(points: &[Vector3], tangents: [Vector3; 2]) -> f64 {
    let edges: Vec<[Vector3; 2]> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let (first, last) = (points[0], points[points.len() - 1]);
    let mut sum = ray_and_ray(tangents[0], last - first, tangents[1]);
    for (i, &edge) in edges.iter().enumerate() {
        for &other in edges.iter().skip(i + 2) {
            sum += edge_and_edge(edge, other);
        }
        if i > 0 {
            // The ray is traversed towards its end point.
            sum += edge_and_ray(edge, first, -tangents[0], -1.0);
        }
        if i + 1 < edges.len() {
            sum += edge_and_ray(edge, last, tangents[1], 1.0);
        }
    }
    sum / (2.0 * PI)
}

/// Signed solid angle of the directions from the points of edge `ab` to the points of edge `cd`.
fn edge_and_edge([a, b]: [Vector3; 2], [c, d]: [Vector3; 2]) -> f64 {
    let [ac, ad, bd, bc] = [c - a, d - a, d - b, c - b];
    triangle(ac, ad, bd) + triangle(ac, bd, bc)
}

/// Signed solid angle for the ray from `c` along `u`, whose far end lies in the direction `u` from
/// everywhere. A ray traversed towards `c` has `sense = -1`.
fn edge_and_ray([a, b]: [Vector3; 2], c: Vector3, u: Vector3, sense: f64) -> f64 {
    sense * triangle(c - a, u, c - b)
}

/// Signed solid angle from a ray that ends along `t` to a ray along `u` that begins `d` further.
/// Parallel rays are coplanar up to round-off.
fn ray_and_ray(t: Vector3, d: Vector3, u: Vector3) -> f64 {
    if (t + u).norm() < SAME_WAY {
        return 0.0;
    }
    triangle(t, u, d)
}

/// Signed solid angle of the triangle of three directions of any length, within `(-2 pi, 2 pi]`. It
/// is positive if they are clockwise seen from the origin, the sense of a right-handed crossing.
pub(super) fn triangle(a: Vector3, b: Vector3, c: Vector3) -> f64 {
    let (p, q, r) = (a.norm(), b.norm(), c.norm());
    let volume = a.dot(&b.cross(&c));
    let across = p * q * r + a.dot(&b) * r + b.dot(&c) * p + c.dot(&a) * q;
    if volume == 0.0 {
        return 0.0;
    }
    -2.0 * volume.atan2(across)
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::Xorshift;
    use actin_mechanics::rotation;

    fn curve(n: usize, at: impl Fn(f64) -> Vector3) -> Vec<Vector3> {
        (0..n).map(|k| at(2.0 * PI * k as f64 / n as f64)).collect()
    }

    fn random(n: usize, noise: &mut Xorshift) -> Vec<Vector3> {
        (0..n).map(|_| noise.vector()).collect()
    }

    /// Gauss integral over two edges by the midpoint rule on 200 x 200 pieces.
    fn by_quadrature([a, b]: [Vector3; 2], [c, d]: [Vector3; 2]) -> f64 {
        let m = 200;
        let at = |from: Vector3, to: Vector3, k: i32| {
            from + (to - from) * ((f64::from(k) + 0.5) / f64::from(m))
        };
        let pieces = (0..m).flat_map(|i| (0..m).map(move |j| (i, j)));
        let sum: f64 = pieces
            .map(|(i, j)| {
                let r = at(a, b, i) - at(c, d, j);
                (b - a).cross(&(d - c)).dot(&r) / r.norm().powi(3)
            })
            .sum();
        sum / f64::from(m * m)
    }

    #[test]
    fn solid_angles_are_gauss_integrals() {
        let mut noise = Xorshift::new(1);
        for _ in 0..5 {
            let edge = |shift: f64, noise: &mut Xorshift| {
                [noise.vector(), noise.vector()].map(|v| v + Vector3::z() * shift)
            };
            let (one, other) = (edge(0.0, &mut noise), edge(2.5, &mut noise));
            let expected = by_quadrature(one, other);
            // Error of the midpoint rule, (1/200)^2 / 24 of the second derivatives.
            assert!((edge_and_edge(one, other) - expected).abs() < 1e-5);
            assert!((edge_and_edge(other, one) - expected).abs() < 1e-5);
        }
    }

    #[test]
    fn curves_without_handedness_do_not_writhe() {
        let tilt = rotation::exp(Vector3::new(0.3, -0.8, 0.5));
        let ellipse = curve(37, |t| tilt * Vector3::new(2.0 * t.cos(), t.sin(), 0.0));
        assert!(closed_writhe(&ellipse).abs() < 1e-14);
        let saddle = curve(64, |t| {
            Vector3::new(t.cos(), t.sin(), 0.7 * (2.0 * t).cos())
        });
        assert!(closed_writhe(&saddle).abs() < 1e-13);
        let arch = curve(9, |t| tilt * Vector3::new(0.0, (0.5 * t).sin(), t));
        let z = tilt * Vector3::z();
        assert!(extended_writhe(&arch, [z, z]).abs() < 1e-14);
    }

    /// Nearly flat curves have one unit of writhe per crossing: one for a figure of eight, three
    /// for a trefoil. The error is of the order of the height.
    #[test]
    fn flat_curves_writhe_by_their_crossings() {
        let height = 1e-3;
        let eight = |h: f64| {
            // Self-crossing at t = pi/2, descending, and at 3 pi/2, ascending.
            curve(400, |t| {
                Vector3::new(t.cos(), (2.0 * t).sin(), -h * t.sin())
            })
        };
        let trefoil = |h: f64| {
            curve(600, |t| {
                let r = 2.0 + (3.0 * t).cos();
                Vector3::new(
                    r * (2.0 * t).cos(),
                    r * (2.0 * t).sin(),
                    h * (3.0 * t).sin(),
                )
            })
        };
        let sign = closed_writhe(&eight(height)).signum();
        for h in [height, -height] {
            let (one, three) = (closed_writhe(&eight(h)), closed_writhe(&trefoil(h)));
            assert!((one - h.signum() * sign).abs() < 0.01, "{one}");
            assert!((three.abs() - 3.0).abs() < 0.01, "{three}");
            // At x = 3 the curve moves along y and turns from x to z: left-handed about its core.
            assert!(three * h < 0.0, "{three}");
        }
    }

    /// Each turn of a right-handed helix adds `1 - sin(alpha)`, with `tan(alpha)` its pitch over
    /// its circumference.
    #[test]
    fn each_turn_of_a_helix_adds_its_own() {
        let (radius, pitch) = (1.0, 2.0);
        let helix = |turns: usize, sense: f64| {
            let n = 120 * turns;
            let points: Vec<Vector3> = (0..=n)
                .map(|k| {
                    let t = 2.0 * PI * k as f64 / 120.0;
                    let (sin, cos) = (sense * t).sin_cos();
                    Vector3::new(radius * cos, radius * sin, pitch * t / (2.0 * PI))
                })
                .collect();
            extended_writhe(&points, [Vector3::z(); 2])
        };
        let per_turn = 1.0 - pitch / (2.0 * PI * radius).hypot(pitch);
        for sense in [1.0, -1.0] {
            let gain = (helix(24, sense) - helix(12, sense)) / 12.0;
            // Interaction of the ends at a distance d is 1/d^2; the error of polygons of 120 edges
            // per turn is (2 pi / 120)^2.
            assert!((gain - sense * per_turn).abs() < 2e-3, "{gain} {per_turn}");
        }
    }

    #[test]
    fn the_writhe_is_invariant() {
        let mut noise = Xorshift::new(3);
        let points = random(12, &mut noise);
        let writhe = closed_writhe(&points);
        assert!(writhe.abs() > 0.1);
        let cut: Vec<Vector3> = (0..12)
            .flat_map(|i| {
                [
                    points[i],
                    points[i] + (points[(i + 1) % 12] - points[i]) * 0.3,
                ]
            })
            .collect();
        let turn = rotation::exp(noise.vector());
        let shift = noise.vector() * 30.0;
        let moved: Vec<Vector3> = points.iter().map(|p| turn * p * 7.0 + shift).collect();
        let back: Vec<Vector3> = points.iter().rev().copied().collect();
        for same in [cut, moved, back] {
            // Round-off of positions of 30 over edges of 1.
            assert!((closed_writhe(&same) - writhe).abs() < 1e-12);
        }
        let mirror: Vec<Vector3> = points
            .iter()
            .map(|p| Vector3::new(p.x, p.y, -p.z))
            .collect();
        assert!((closed_writhe(&mirror) + writhe).abs() < 1e-13);
    }

    /// The difference from closed curves vanishes with the distance of the closing arc.
    #[test]
    fn the_closing_far_away_adds_nothing() {
        let mut noise = Xorshift::new(5);
        let mut points = random(10, &mut noise);
        for (k, point) in points.iter_mut().enumerate() {
            point.z += 0.4 * k as f64;
        }
        let writhe = extended_writhe(&points, [Vector3::z(); 2]);
        assert!(writhe.abs() > 0.1);
        let closed = |far: f64| {
            let (up, aside) = (Vector3::z() * far, Vector3::x() * far);
            let (first, last) = (points[0], points[9]);
            let mut all = vec![first - up + aside, first - up];
            all.extend(points.iter().copied());
            all.extend([last + up, last + up + aside]);
            closed_writhe(&all) - writhe
        };
        let errors = [1e2, 1e3, 1e4].map(closed);
        assert!(errors[2].abs() < 1e-3, "{errors:?}");
        assert!((errors[1] / errors[0]).abs() < 0.2, "{errors:?}");
        assert!((errors[2] / errors[1]).abs() < 0.2, "{errors:?}");
    }
}
