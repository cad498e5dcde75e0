//! The curve along which a filament is built, with a frame at every arc length: pieces of constant curvature,
//! of which a spline has many.
//!
//! A filament is seen as if it were along lab +z from the origin; where it is built is in `place.rs`.

use super::{AlteredRod, Filament, Shape};
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use std::f64::consts::TAU;

/// Pieces of a spline between two of its points.
const PIECES: u32 = 64;

/// A curve with frames whose third axes are its tangents.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    pieces: Vec<Piece>,
    /// Where it ends (nm), if it does.
    length: Option<f64>,
}

/// A stretch of constant curvature, with the place and the frame of its start.
#[derive(Clone, Debug, PartialEq)]
struct Piece {
    from: f64,
    place: Vector3,
    frame: UnitQuaternion,
    /// Curvature (rad/nm, body axes) of frames that go with the normal of the curve.
    curvature: Vector3,
    /// Rate (rad/nm) at which frames without twist turn back against these.
    unroll: f64,
}

impl Piece {
    fn straight() -> Self {
        Self {
            from: 0.0,
            place: Vector3::zeros(),
            frame: UnitQuaternion::identity(),
            curvature: Vector3::zeros(),
            unroll: 0.0,
        }
    }

    fn at(&self, s: f64) -> (Vector3, UnitQuaternion) {
        let along = s - self.from;
        let theta = self.curvature * along;
        let place = self.place + self.frame * swept(theta, Vector3::z() * along);
        let frame = self.frame * rotation::exp(theta);
        (
            place,
            frame * rotation::exp(Vector3::z() * (-self.unroll * along)),
        )
    }
}

impl Curve {
    /// That of a filament whose sections meet at these arc lengths (nm).
    pub fn of(filament: &Filament, boundaries: &[f64]) -> Self {
        match &filament.shape {
            None => Self::of_pieces(vec![Piece::straight()]),
            Some(Shape::Arc {
                radius_nm,
                azimuth_deg,
            }) => Self::of_pieces(vec![Piece {
                curvature: towards(*azimuth_deg) / *radius_nm,
                ..Piece::straight()
            }]),
            Some(Shape::Helix {
                radius_nm,
                pitch_nm,
                azimuth_deg,
            }) => Self::of_pieces(vec![helix(*radius_nm, *pitch_nm, *azimuth_deg)]),
            Some(Shape::Points { nm, .. }) => Self::through(nm),
            Some(Shape::AtRest) => Self::at_rest(filament, boundaries),
        }
    }

    fn of_pieces(pieces: Vec<Piece>) -> Self {
        Self {
            pieces,
            length: None,
        }
    }

    fn at_rest(filament: &Filament, boundaries: &[f64]) -> Self {
        let mut pieces: Vec<Piece> = Vec::with_capacity(boundaries.len());
        for (section, &from) in filament.sections.iter().zip(boundaries) {
            let (place, frame) = pieces.last().map_or_else(
                || (Vector3::zeros(), UnitQuaternion::identity()),
                |before| before.at(from),
            );
            let altered = section.altered_rod();
            pieces.push(Piece {
                from,
                place,
                frame,
                curvature: altered.map_or_else(Vector3::zeros, AlteredRod::rest_curvature),
                unroll: 0.0,
            });
        }
        Self::of_pieces(pieces)
    }

    /// The natural cubic spline through points, with frames that turn as little as they can.
    fn through(points: &[[f64; 3]]) -> Self {
        let spline = Spline::through(points);
        let mut pieces: Vec<Piece> = Vec::new();
        let (mut s, mut before) = (0.0, spline.at(0, 0.0));
        for k in 0..spline.chords.len() {
            for i in 0..PIECES {
                let share = |i: u32| f64::from(i) / f64::from(PIECES);
                let h = spline.chords[k] / f64::from(PIECES);
                let after = spline.at(k, share(i + 1));
                let middle = spline.at(k, share(i) + 0.5 / f64::from(PIECES));
                let frame = pieces
                    .last()
                    .map_or_else(UnitQuaternion::identity, |p| p.frame);
                let frame = turned_to(frame, before.1);
                // Simpson's rule.
                let speeds = before.1.norm() + 4.0 * middle.1.norm() + after.1.norm();
                let length = h * speeds / 6.0;
                let next = turned_to(frame, after.1);
                pieces.push(Piece {
                    from: s,
                    place: before.0,
                    curvature: rotation::log(frame.inverse() * next) / length,
                    frame,
                    unroll: 0.0,
                });
                s += length;
                before = after;
            }
        }
        Self {
            pieces,
            length: Some(s),
        }
    }

    /// Place (nm) and frame at an arc length; beyond its ends the curve goes on as it is there.
    pub fn at(&self, s_nm: f64) -> (Vector3, UnitQuaternion) {
        let past = self.pieces.partition_point(|piece| piece.from <= s_nm);
        self.pieces[past.saturating_sub(1)].at(s_nm)
    }

    /// Where it ends (nm), if it does.
    pub fn length(&self) -> Option<f64> {
        self.length
    }

    /// Largest curvature up to an arc length, and where its piece begins (nm).
    pub fn largest_curvature(&self, length: f64) -> (f64, f64) {
        let reached = self.pieces.iter().take_while(|piece| piece.from < length);
        let bends = reached.map(|piece| (piece.from, piece.curvature.xy().norm()));
        let largest = bends.max_by(|a, b| a.1.total_cmp(&b.1));
        largest.unwrap_or_default()
    }
}

/// Curvature of 1 that bends what is along z towards an azimuth.
fn towards(azimuth_deg: f64) -> Vector3 {
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    Vector3::new(-sin, cos, 0.0)
}

/// A helix about an axis along z that stands at a distance towards an azimuth of the start.
fn helix(radius: f64, pitch: f64, azimuth_deg: f64) -> Piece {
    let rise = pitch / TAU;
    let squared = radius * radius + rise * rise;
    let torsion = rise / squared;
    let azimuth = rotation::exp(Vector3::z() * azimuth_deg.to_radians());
    // The tangent is across the way to the axis, which is along x before the turn to the azimuth: on the way
    // round the axis to the left where the helix rises, so that it is right-handed.
    let slope = radius.atan2(rise.abs());
    let sense = if rise < 0.0 { -1.0 } else { 1.0 };
    let tilt = rotation::exp(Vector3::x() * (sense * slope));
    Piece {
        frame: azimuth * tilt,
        curvature: Vector3::new(0.0, radius / squared, torsion),
        unroll: torsion,
        ..Piece::straight()
    }
}

/// A frame turned as little as possible until its third axis is along a vector.
fn turned_to(frame: UnitQuaternion, along: Vector3) -> UnitQuaternion {
    let axis = frame * Vector3::z();
    let turn = UnitQuaternion::rotation_between(&axis, &along);
    // Opposite vectors have no least turn: any half turn does.
    let half = || rotation::exp(frame * Vector3::x() * std::f64::consts::PI);
    turn.unwrap_or_else(half) * frame
}

/// `J_l(theta) v`: what becomes of `v` that is swept from no rotation to that by `theta`.
pub fn swept(theta: Vector3, v: Vector3) -> Vector3 {
    let angle = theta.norm();
    if angle < 1e-8 {
        return v + 0.5 * theta.cross(&v);
    }
    let (sin, cos) = angle.sin_cos();
    let axis = theta / angle;
    v * (sin / angle)
        + axis * (axis.dot(&v) * (1.0 - sin / angle))
        + axis.cross(&v) * ((1.0 - cos) / angle)
}

/// A natural cubic spline over the lengths of the chords between its points.
struct Spline {
    points: Vec<Vector3>,
    chords: Vec<f64>,
    /// Second derivatives at the points (1/nm).
    second: Vec<Vector3>,
}

impl Spline {
    fn through(points: &[[f64; 3]]) -> Self {
        let points: Vec<Vector3> = points.iter().copied().map(Vector3::from).collect();
        let chords: Vec<f64> = points.windows(2).map(|p| (p[1] - p[0]).norm()).collect();
        let slopes = points
            .windows(2)
            .zip(&chords)
            .map(|(p, h)| (p[1] - p[0]) / *h);
        let slopes: Vec<Vector3> = slopes.collect();
        // Thomas' elimination of `h' m' + 2 (h' + h) m + h m'' = 6 (slope - slope')`; zero at the ends.
        let n = points.len();
        let (mut above, mut right) = (vec![0.0; n], vec![Vector3::zeros(); n]);
        for i in 1..n - 1 {
            let (before, after) = (chords[i - 1], chords[i]);
            let pivot = 2.0 * (before + after) - before * above[i - 1];
            above[i] = after / pivot;
            right[i] = (6.0 * (slopes[i] - slopes[i - 1]) - before * right[i - 1]) / pivot;
        }
        let mut second = vec![Vector3::zeros(); n];
        for i in (1..n - 1).rev() {
            second[i] = right[i] - above[i] * second[i + 1];
        }
        Self {
            points,
            chords,
            second,
        }
    }

    /// Place and derivative by the length of the chord at a share of chord `k`.
    fn at(&self, k: usize, share: f64) -> (Vector3, Vector3) {
        let h = self.chords[k];
        let (a, b) = (1.0 - share, share);
        let (from, to) = (self.points[k], self.points[k + 1]);
        let (m, n) = (self.second[k], self.second[k + 1]);
        let place = from * a + to * b + ((a * a * a - a) * m + (b * b * b - b) * n) * (h * h / 6.0);
        let slope =
            (to - from) / h + ((1.0 - 3.0 * a * a) * m + (3.0 * b * b - 1.0) * n) * (h / 6.0);
        (place, slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Section;

    fn curve(shape: Shape) -> Curve {
        let filament = Filament {
            shape: Some(shape),
            ..Filament::new(vec![Section::rod(0.0, 100.0, None)])
        };
        Curve::of(&filament, &filament.boundaries())
    }

    /// Tangents are third axes and derivatives of places; the frames have no twist: turned by the curve alone.
    fn assert_is_untwisted(curve: &Curve, tolerance: f64) {
        let h = 1e-4;
        for i in 1..20 {
            let s = 4.9 * f64::from(i);
            let slope = (curve.at(s + h).0 - curve.at(s - h).0) / (2.0 * h);
            let axis = curve.at(s).1 * Vector3::z();
            assert!((slope - axis).norm() < tolerance, "{s}: {slope} {axis}");
            let turn = curve.at(s - h).1.inverse() * curve.at(s + h).1;
            let twist = rotation::log(turn).z / (2.0 * h);
            assert!(twist.abs() < tolerance, "{s}: {twist}");
        }
    }

    /// An arc towards azimuth 90 ends where the circle about (0, R) does.
    #[test]
    fn an_arc_bends_towards_its_azimuth() {
        let arc = curve(Shape::Arc {
            radius_nm: 50.0,
            azimuth_deg: 90.0,
        });
        assert_is_untwisted(&arc, 1e-7);
        let (place, frame) = arc.at(50.0);
        let (sin, cos) = 1.0_f64.sin_cos();
        let expected = Vector3::new(0.0, 50.0 * (1.0 - cos), 50.0 * sin);
        assert!((place - expected).norm() < 1e-12, "{place}");
        assert!((frame * Vector3::x() - Vector3::x()).norm() < 1e-14);
    }

    /// Every point of a helix is at its radius from the axis, and rises as the pitch says, to either hand.
    #[test]
    fn a_helix_goes_round_its_axis() {
        for pitch in [40.0, -40.0] {
            let helix = curve(Shape::Helix {
                radius_nm: 8.0,
                pitch_nm: pitch,
                azimuth_deg: 30.0,
            });
            assert_is_untwisted(&helix, 1e-6);
            let (sin, cos) = 30.0_f64.to_radians().sin_cos();
            let axis = Vector3::new(8.0 * cos, 8.0 * sin, 0.0);
            let turn = (TAU * 8.0).hypot(40.0);
            for i in 0..10 {
                let s = 10.0 * f64::from(i);
                let place = helix.at(s).0;
                assert!(((place - axis).xy().norm() - 8.0).abs() < 1e-12);
                assert!((place.z - 40.0 * s / turn).abs() < 1e-12);
            }
            // A little above the start, to the left of the axis where it is right-handed.
            let near = helix.at(1.0).0 - helix.at(0.0).0;
            let handed = (helix.at(0.0).0 - axis).cross(&near).z;
            assert!(handed * pitch > 0.0, "{handed} {pitch}");
        }
    }

    /// The spline through points of a circle is that circle to the fourth power of their distance inside, goes
    /// through all of them, and its frames have no twist.
    #[test]
    fn a_spline_goes_through_its_points() {
        let points = |n: u32| -> Vec<[f64; 3]> {
            let angle = |i: u32| 2.0 * f64::from(i) / f64::from(n);
            (0..=n)
                .map(|i| [60.0 * (1.0 - angle(i).cos()), 0.0, 60.0 * angle(i).sin()])
                .collect()
        };
        let miss = |n: u32| {
            let spline = curve(Shape::Points {
                nm: points(n),
                file: None,
            });
            assert_is_untwisted(&spline, 1e-4);
            let middle = spline.at(60.0).0 - Vector3::x() * 60.0;
            assert!((spline.length().unwrap() - 120.0).abs() < 0.5);
            (middle.norm() - 60.0).abs()
        };
        let [coarse, fine] = [20, 40].map(miss);
        assert!(fine < 1e-4 && fine < coarse, "{coarse:e} {fine:e}");
    }

    /// Twist at rest makes a helix of an arc; a second section goes on from the first.
    #[test]
    fn pieces_at_rest_follow_one_another() {
        let rod = |from, to, altered| Section::Rod {
            from_nm: from,
            to_nm: to,
            segments: None,
            altered: Some(Box::new(altered)),
        };
        let bent = AlteredRod {
            rest_curvature_per_nm: [0.02, 0.0],
            ..AlteredRod::default()
        };
        let twisted = AlteredRod {
            rest_twist_per_nm: 0.05,
            ..bent.clone()
        };
        let sections = vec![rod(0.0, 40.0, bent), rod(40.0, 100.0, twisted)];
        let filament = Filament {
            shape: Some(Shape::AtRest),
            ..Filament::new(sections)
        };
        let curve = Curve::of(&filament, &filament.boundaries());
        let [before, after] = [40.0 - 1e-9, 40.0].map(|s| curve.at(s));
        assert!((before.0 - after.0).norm() < 1e-8);
        let turn = rotation::log(curve.at(70.0).1.inverse() * curve.at(71.0).1);
        assert!((turn - Vector3::new(0.02, 0.0, 0.05)).norm() < 1e-13);
    }

    /// `J_l` against the integral that it is.
    #[test]
    fn sweeping_is_integrating() {
        let (theta, v) = (Vector3::new(0.3, -1.2, 0.7), Vector3::new(0.2, 1.0, -0.4));
        let n = 1000;
        let middle = |i: i32| (f64::from(i) + 0.5) / f64::from(n);
        let sum: Vector3 = (0..n).map(|i| rotation::exp(theta * middle(i)) * v).sum();
        assert!((sum / f64::from(n) - swept(theta, v)).norm() < 1e-6);
        assert_eq!(swept(Vector3::zeros(), v), v);
    }
}
