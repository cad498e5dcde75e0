//! Size, asymmetry and planarity of buckled centre lines, for comparison of simulators.
//!
//! # Source
//! Definitions of simularium/subcell-pipeline (Allen Institute for Cell Science, 2024),
//! reimplemented.

use crate::scene::{Spline, SplineEnds};
use actin_mechanics::Vector3;
use nalgebra::Matrix3;

/// Length (nm) below which a vector has no direction.
const LEAST_NM: f64 = 1e-6;

/// Sine of the angle between edges below which they have no normal: far above round-off of positions.
const LEAST_SINE: f64 = 1e-9;

/// Pieces of a spline per point. Their chords change angles between points by less than 1e-3.
const PIECES: usize = 16;

/// Measures of a centre line that has buckled between its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Buckle {
    /// Length of the polyline (nm).
    pub contour_nm: f64,
    /// Mean distance of its points from the line through its ends (nm).
    pub mean_distance_nm: f64,
    /// Distance of the farthest point from the middle along that line, over the distance of the
    /// ends.
    pub peak_asymmetry: f64,
    /// Share of the variance of the points along the direction of least variance: 0 in a plane, at
    /// most 1/3.
    pub non_coplanarity: f64,
    /// Mean of `1 - cos` of the angle between successive edges.
    pub bend: f64,
    /// Sum of the absolute angles between successive normals (cross products of successive edges),
    /// over the length (rad/nm). Parallel edges have no normal.
    pub normals_rad_per_nm: f64,
    /// Supertwist (deg): angle about the axis between the first edge and the reversed last edge,
    /// with the sign of most rotations from edge to edge. Positive for right-handed coils.
    ///
    /// Between clamped ends these two edges are nearly parallel to the axis. Their residual angle
    /// comes from the helix of monomers and the spacing of points, and the supertwist does not
    /// measure the shape (`docs/studies.md`).
    pub supertwist_deg: f64,
}

impl Buckle {
    /// Computes the measures of a polyline along the unit vector `axis`.
    ///
    /// # Panics
    /// If there are fewer than three points.
    pub(crate) fn new(points: &[Vector3], axis: Vector3) -> Self {
        assert!(
            points.len() > 2,
            "a buckled curve needs at least three points"
        );
        let edges: Vec<Vector3> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let contour_nm = edges.iter().map(Vector3::norm).sum();
        let (mean_distance_nm, peak_asymmetry) = distances(points);
        Self {
            contour_nm,
            mean_distance_nm,
            peak_asymmetry,
            non_coplanarity: non_coplanarity(points),
            bend: bend(&edges),
            normals_rad_per_nm: turn_of_normals(&edges) / contour_nm,
            supertwist_deg: supertwist(&edges, axis).to_degrees(),
        }
    }
}

/// Returns `count` points at equal distances along a centre line, including both ends.
///
/// The line is the polyline through `vertices` or, with at most `count` of them, a cubic spline. On
/// a polyline several points would lie on one straight edge.
///
/// # Panics
/// If there are fewer than two vertices or points.
pub(crate) fn resampled(vertices: &[Vector3], count: usize) -> Vec<Vector3> {
    if vertices.len() > count {
        return equally_spaced(vertices, count);
    }
    let spline = Spline::new(vertices, SplineEnds::NotAKnot);
    let chords = vertices.len() - 1;
    let pieces = PIECES * count.div_ceil(chords);
    let share = |i: usize| (i % pieces) as f64 / pieces as f64;
    let inner = (0..chords * pieces).map(|i| spline.at(i / pieces, share(i)).0);
    let fine: Vec<Vector3> = inner.chain([vertices[chords]]).collect();
    equally_spaced(&fine, count)
}

/// Returns `count` points of a polyline at equal distances along it, including both ends.
///
/// # Panics
/// If `points` or `count` has fewer than two points.
fn equally_spaced(points: &[Vector3], count: usize) -> Vec<Vector3> {
    assert!(
        points.len() > 1 && count > 1,
        "a polyline needs at least two points"
    );
    let edge = |i: usize| (points[i + 1] - points[i]).norm();
    let total: f64 = (0..points.len() - 1).map(edge).sum();
    let (mut i, mut before) = (0, 0.0);
    let mut at = |length: f64| {
        while i + 2 < points.len() && before + edge(i) < length {
            before += edge(i);
            i += 1;
        }
        let share = if edge(i) > 0.0 {
            (length - before) / edge(i)
        } else {
            0.0
        };
        points[i] + (points[i + 1] - points[i]) * share
    };
    let inner = (0..count - 1).map(|k| at(total * k as f64 / (count - 1) as f64));
    let mut spaced: Vec<Vector3> = inner.collect();
    spaced.push(points[points.len() - 1]);
    spaced
}

/// Mean distance from the line through the ends, and offset of the farthest point from the middle.
fn distances(points: &[Vector3]) -> (f64, f64) {
    let first = points[0];
    let line = points[points.len() - 1] - first;
    let length = line.norm();
    let along = direction(line);
    let (mut sum, mut farthest, mut asymmetry) = (0.0, LEAST_NM, 0.0);
    for point in points {
        let arm = point - first;
        let place = arm.dot(&along);
        let distance = (arm - along * place).norm();
        sum += distance;
        if distance > farthest {
            (farthest, asymmetry) = (distance, (place / length - 0.5).abs());
        }
    }
    (sum / points.len() as f64, asymmetry)
}

fn non_coplanarity(points: &[Vector3]) -> f64 {
    let centre = points.iter().sum::<Vector3>() / points.len() as f64;
    let spread = |m: Matrix3<f64>, p: &Vector3| m + (p - centre) * (p - centre).transpose();
    let covariance = points.iter().fold(Matrix3::zeros(), spread);
    let variances = covariance.symmetric_eigenvalues();
    // Round-off of a plane curve can be negative.
    variances.min().max(0.0) / variances.sum()
}

fn bend(edges: &[Vector3]) -> f64 {
    let turns = edges
        .windows(2)
        .map(|pair| 1.0 - pair[0].angle(&pair[1]).cos());
    turns.sum::<f64>() / (edges.len() - 1) as f64
}

fn turn_of_normals(edges: &[Vector3]) -> f64 {
    let pairs = edges.windows(2).filter_map(|pair| {
        let normal = pair[0].cross(&pair[1]);
        normal.try_normalize(LEAST_SINE * pair[0].norm() * pair[1].norm())
    });
    let normals: Vec<Vector3> = pairs.collect();
    normals.windows(2).map(|pair| pair[0].angle(&pair[1])).sum()
}

fn supertwist(edges: &[Vector3], axis: Vector3) -> f64 {
    let across = |edge: &Vector3| direction(edge - axis * edge.dot(&axis));
    let seen: Vec<Vector3> = edges.iter().map(across).collect();
    let (first, last) = (seen[0], -seen[seen.len() - 1]);
    let turns = seen
        .windows(2)
        .map(|pair| axis.dot(&pair[0].cross(&pair[1])));
    let sign = sign(turns.map(sign).sum());
    let (sine, cosine) = (first.cross(&last).norm(), first.dot(&last));
    sign * sine.atan2(cosine)
}

/// Returns the unit vector along `v`, or zero if `v` has no direction.
fn direction(v: Vector3) -> Vector3 {
    let length = v.norm();
    if length < LEAST_NM {
        Vector3::zeros()
    } else {
        v / length
    }
}

/// Returns the sign of a number, or zero for zero.
fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn curve(count: usize, at: impl Fn(f64) -> [f64; 3]) -> Vec<Vector3> {
        let share = |i: usize| i as f64 / (count - 1) as f64;
        (0..count).map(|i| at(share(i)).into()).collect()
    }

    /// An arc of radius R and half angle a has length 2 R a and mean distance R (sin a / a - cos a)
    /// from its chord.
    #[test]
    fn an_arc_is_flat_and_even() {
        let (radius, a, n) = (100.0, 1.2_f64, 1201);
        let arc = curve(n, |t| {
            let angle = a * (2.0 * t - 1.0);
            [
                0.6 * radius * angle.cos(),
                0.8 * radius * angle.cos(),
                radius * angle.sin(),
            ]
        });
        let buckle = Buckle::new(&arc, Vector3::z());
        // Chords are shorter than arcs by (2 a / n)^2 / 24.
        assert!((buckle.contour_nm - 2.0 * radius * a).abs() < 1e-4);
        let distance = radius * (a.sin() / a - a.cos());
        // Ends have half weight in the integral.
        assert!((buckle.mean_distance_nm - distance).abs() < 2.0 * distance / n as f64);
        assert!(buckle.peak_asymmetry < 1e-12 && buckle.non_coplanarity < 1e-14);
        assert!(buckle.supertwist_deg.abs() < 1e-6 && buckle.normals_rad_per_nm < 1e-6);
        let between = 2.0 * a / (n - 1) as f64;
        assert!((buckle.bend - (1.0 - between.cos())).abs() < 1e-12);
    }

    /// A helix of less than half a turn has a supertwist of 180 deg minus the turn, positive if
    /// right-handed along the axis.
    #[test]
    fn supertwist_has_the_sign_of_the_hand() {
        for (turn, hand) in [(1.9, 1.0), (1.9, -1.0), (0.3, 1.0)] {
            let n = 400;
            let helix = curve(n, |t| {
                let angle = turn * t;
                [10.0 * angle.cos(), hand * 10.0 * angle.sin(), 40.0 * t]
            });
            let between = turn * (n - 2) as f64 / (n - 1) as f64;
            let expected = hand * (PI - between).to_degrees();
            let found = Buckle::new(&helix, Vector3::z()).supertwist_deg;
            assert!((found - expected).abs() < 1e-6, "{found} {expected}");
            let mirrored = Buckle::new(&helix, -Vector3::z()).supertwist_deg;
            assert!((mirrored + expected).abs() < 1e-6, "{mirrored}");
        }
    }

    /// For a helix of whole turns the transverse variances are `R^2 / 2`, compared with `H^2 / 12`
    /// along the axis. Its normals turn by `2 pi` times the sine of its pitch angle per turn.
    #[test]
    fn a_coil_is_not_flat() {
        let (radius, height, turns, n) = (5.0, 200.0, 8.0, 8001);
        let coil = curve(n, |t| {
            let angle = 2.0 * PI * turns * t;
            [radius * angle.cos(), radius * angle.sin(), height * t]
        });
        let buckle = Buckle::new(&coil, Vector3::z());
        let (across, along) = (radius * radius / 2.0, height * height / 12.0);
        // Correlation of the sine with the axis: 6 / (2 pi turns)^2 of the smaller variance.
        let exact = across / (2.0 * across + along);
        assert!((buckle.non_coplanarity / exact - 1.0).abs() < 0.01);
        let pitch = height / turns;
        let edge = (pitch * pitch + (2.0 * PI * radius).powi(2)).sqrt();
        let torsion = 2.0 * PI * pitch / (edge * edge);
        // Differences of second order, and one normal fewer at each end.
        assert!((buckle.normals_rad_per_nm / torsion - 1.0).abs() < 1e-3);
    }

    #[test]
    fn points_are_spaced_by_length() {
        let corners = [
            [0.0, 0.0, 0.0],
            [30.0, 0.0, 40.0],
            [30.0, 0.0, 40.0],
            [0.0, 0.0, 80.0],
        ];
        let spaced = equally_spaced(&corners.map(Vector3::from), 101);
        assert_eq!(spaced.len(), 101);
        for pair in spaced.windows(2) {
            assert!(((pair[1] - pair[0]).norm() - 1.0).abs() < 1e-9);
        }
        let buckle = Buckle::new(&spaced, Vector3::z());
        assert!((buckle.contour_nm - 100.0).abs() < 1e-9 && buckle.peak_asymmetry < 1e-9);
        assert!((buckle.mean_distance_nm - 30.0 * 50.0 / 101.0).abs() < 1e-9);
        let lopsided = [[0.0, 0.0, 0.0], [3.0, 0.0, 20.0], [0.0, 0.0, 80.0]].map(Vector3::from);
        assert!((Buckle::new(&lopsided, Vector3::z()).peak_asymmetry - 0.25).abs() < 1e-12);
    }
}
