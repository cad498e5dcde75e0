//! Reference curve of a filament, of pieces of constant curvature. It starts at the origin along lab +z.

use super::{Filament, Shape, Spline, SplineEnds};
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use std::f64::consts::TAU;

const PIECES: u32 = 64;

/// Curve with a frame at every arc length. The third axis is the tangent.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    pieces: Vec<Piece>,
    /// Length (nm) of a spline.
    length: Option<f64>,
    /// Rest twist of the sections, where the pieces do not include it.
    rolls: Vec<Roll>,
}

/// Rotation of the frames about the tangent.
#[derive(Clone, Debug, PartialEq)]
struct Roll {
    from: f64,
    angle: f64,
    /// Rate (rad/nm).
    rate: f64,
}

impl Roll {
    fn at(&self, s: f64) -> f64 {
        self.angle + self.rate * (s - self.from)
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Piece {
    from: f64,
    place: Vector3,
    frame: UnitQuaternion,
    /// Curvature (rad/nm, body axes) of the Frenet frame.
    curvature: Vector3,
    /// Rotation rate (rad/nm) of the Frenet frame relative to the untwisted frame.
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
        let place = self.place + self.frame * left_jacobian_product(theta, Vector3::z() * along);
        let frame = self.frame * rotation::exp(theta);
        (
            place,
            frame * rotation::exp(Vector3::z() * (-self.unroll * along)),
        )
    }
}

impl Curve {
    /// Creates the curve of a filament whose sections start at these arc lengths (nm). Fewer than two points, which
    /// are refused, count as a straight line.
    pub fn new(filament: &Filament, boundaries: &[f64]) -> Self {
        let curve = match &filament.shape {
            Some(Shape::Points { nm, .. }) if nm.len() > 1 => Self::through(nm),
            None | Some(Shape::Points { .. }) => Self::from_pieces(vec![Piece::straight()]),
            Some(Shape::Arc {
                radius_nm,
                azimuth_deg,
            }) => Self::from_pieces(vec![Piece {
                curvature: towards(*azimuth_deg) / *radius_nm,
                ..Piece::straight()
            }]),
            Some(Shape::Helix {
                radius_nm,
                pitch_nm,
                azimuth_deg,
            }) => Self::from_pieces(vec![helix(*radius_nm, *pitch_nm, *azimuth_deg)]),
            Some(Shape::AtRest) => return Self::at_rest(filament, boundaries),
        };
        curve.rolled(filament, boundaries)
    }

    /// Adds the rest twist of the sections.
    fn rolled(mut self, filament: &Filament, boundaries: &[f64]) -> Self {
        let mut angle = 0.0;
        for (section, &from) in filament.sections.iter().zip(boundaries) {
            angle = self.rolls.last().map_or(angle, |before| before.at(from));
            let rate = section.rest_curvature(&filament.monomers).z;
            self.rolls.push(Roll { from, angle, rate });
        }
        if self.rolls.iter().all(|roll| roll.rate.abs() <= 0.0) {
            self.rolls.clear();
        }
        self
    }

    /// Returns whether the curve is straight without twist.
    pub fn is_straight(&self) -> bool {
        self.rolls.is_empty() && self.pieces == [Piece::straight()]
    }

    fn from_pieces(pieces: Vec<Piece>) -> Self {
        Self {
            pieces,
            length: None,
            rolls: Vec::new(),
        }
    }

    fn at_rest(filament: &Filament, boundaries: &[f64]) -> Self {
        let mut pieces: Vec<Piece> = Vec::with_capacity(boundaries.len());
        for (section, &from) in filament.sections.iter().zip(boundaries) {
            let (place, frame) = pieces.last().map_or_else(
                || (Vector3::zeros(), UnitQuaternion::identity()),
                |before| before.at(from),
            );
            pieces.push(Piece {
                from,
                place,
                frame,
                curvature: section.rest_curvature(&filament.monomers),
                unroll: 0.0,
            });
        }
        Self::from_pieces(pieces)
    }

    /// Natural cubic spline with rotation-minimising frames.
    fn through(points: &[[f64; 3]]) -> Self {
        let points: Vec<Vector3> = points.iter().copied().map(Vector3::from).collect();
        let spline = Spline::new(&points, SplineEnds::Natural);
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
            rolls: Vec::new(),
        }
    }

    /// Returns position (nm) and frame at an arc length. Outside its ends the curve continues with the same
    /// curvature.
    pub fn at(&self, s_nm: f64) -> (Vector3, UnitQuaternion) {
        let past = self.pieces.partition_point(|piece| piece.from <= s_nm);
        let (place, frame) = self.pieces[past.saturating_sub(1)].at(s_nm);
        let past = self.rolls.partition_point(|roll| roll.from <= s_nm);
        let roll = self.rolls.get(past.saturating_sub(1));
        let turned = roll.map(|roll| frame * rotation::exp(Vector3::z() * roll.at(s_nm)));
        (place, turned.unwrap_or(frame))
    }

    /// Returns the length (nm) of a spline; other curves are unbounded.
    pub(crate) fn length(&self) -> Option<f64> {
        self.length
    }

    /// Returns the start (nm) of the piece with the largest curvature up to an arc length, and this curvature (1/nm).
    pub(crate) fn largest_curvature(&self, length: f64) -> (f64, f64) {
        let reached = self.pieces.iter().take_while(|piece| piece.from < length);
        let bends = reached.map(|piece| (piece.from, piece.curvature.xy().norm()));
        let largest = bends.max_by(|a, b| a.1.total_cmp(&b.1));
        largest.unwrap_or_default()
    }
}

/// Unit curvature vector that bends the z axis towards an azimuth.
fn towards(azimuth_deg: f64) -> Vector3 {
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    Vector3::new(-sin, cos, 0.0)
}

/// Helix about an axis parallel to z, at a distance `radius` from the start in the direction of the azimuth.
fn helix(radius: f64, pitch: f64, azimuth_deg: f64) -> Piece {
    let rise = pitch / TAU;
    let squared = radius * radius + rise * rise;
    let torsion = rise / squared;
    let azimuth = rotation::exp(Vector3::z() * azimuth_deg.to_radians());
    // The axis lies towards x before rotation to the azimuth. The tangent is tilted about x.
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

/// Rotates a frame by the smallest angle that aligns its third axis with a vector.
fn turned_to(frame: UnitQuaternion, along: Vector3) -> UnitQuaternion {
    let axis = frame * Vector3::z();
    let turn = UnitQuaternion::rotation_between(&axis, &along);
    // The rotation is not unique for opposite vectors.
    let half = || rotation::exp(frame * Vector3::x() * std::f64::consts::PI);
    turn.unwrap_or_else(half) * frame
}

/// Returns `J_l(theta) v`, with the left Jacobian of SO(3): the mean of `exp(t theta) v` over `t` in [0, 1].
pub fn left_jacobian_product(theta: Vector3, v: Vector3) -> Vector3 {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RodChanges, Section};

    fn curve(shape: Shape) -> Curve {
        let filament = Filament {
            shape: Some(shape),
            ..Filament::new(vec![Section::rod(0.0, 100.0, None)])
        };
        Curve::new(&filament, &filament.boundaries())
    }

    /// Asserts that tangents are third axes and derivatives of positions, and that frames are untwisted.
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

    #[test]
    fn a_helix_has_a_constant_radius() {
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
            // A right-handed helix starts to the left of the axis.
            let near = helix.at(1.0).0 - helix.at(0.0).0;
            let handed = (helix.at(0.0).0 - axis).cross(&near).z;
            assert!(handed * pitch > 0.0, "{handed} {pitch}");
        }
    }

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

    #[test]
    fn pieces_at_rest_are_continuous() {
        let rod = |from, to, altered| Section::Rod {
            from_nm: from,
            to_nm: to,
            segments: None,
            altered: Some(Box::new(altered)),
        };
        let bent = RodChanges {
            rest_curvature_per_nm: [0.02, 0.0],
            ..RodChanges::default()
        };
        let twisted = RodChanges {
            rest_twist_per_nm: 0.05,
            ..bent.clone()
        };
        let sections = vec![rod(0.0, 40.0, bent), rod(40.0, 100.0, twisted)];
        let filament = Filament {
            shape: Some(Shape::AtRest),
            ..Filament::new(sections)
        };
        let curve = Curve::new(&filament, &filament.boundaries());
        let [before, after] = [40.0 - 1e-9, 40.0].map(|s| curve.at(s));
        assert!((before.0 - after.0).norm() < 1e-8);
        let turn = rotation::log(curve.at(70.0).1.inverse() * curve.at(71.0).1);
        assert!((turn - Vector3::new(0.02, 0.0, 0.05)).norm() < 1e-13);
    }

    #[test]
    fn swept_is_the_mean_of_rotated_vectors() {
        let (theta, v) = (Vector3::new(0.3, -1.2, 0.7), Vector3::new(0.2, 1.0, -0.4));
        let n = 1000;
        let middle = |i: i32| (f64::from(i) + 0.5) / f64::from(n);
        let sum: Vector3 = (0..n).map(|i| rotation::exp(theta * middle(i)) * v).sum();
        assert!((sum / f64::from(n) - left_jacobian_product(theta, v)).norm() < 1e-6);
        assert_eq!(left_jacobian_product(Vector3::zeros(), v), v);
    }
}
