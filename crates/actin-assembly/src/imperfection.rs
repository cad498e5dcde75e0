//! Smooth initial displacements of filaments from their axis.
//!
//! ```text
//! u(s) = A sum_{k=1..4} w_k sin(pi x) sin(k pi x) d_k
//! x    = s / L    arc length over the length of the filament
//! w_k  = 1 / k^2
//! d_k             random directions across the axis
//! A    (nm)       factor such that max |u| is the amplitude
//! ```
//!
//! Displacement and slope vanish at both ends, so that held and sliding ends are unchanged. A
//! cross-section is displaced by `u` and turned by `axis x du/ds`. This gives no shear and, to
//! first order, no stretch. The field depends on arc length alone and is therefore the same for
//! every resolution.

use super::{FilamentSpan, FrameInfo, PointInfo};
use crate::scene::{Imperfection, Scene};
use actin_mechanics::{State, Vector3, rotation};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::{PI, TAU};

const MODES: usize = 4;

/// Sampling intervals for the largest displacement, with a relative error below `(2 MODES pi /
/// PLACES)^2 / 8`, about 1e-3.
const PLACES: u32 = 256;

/// Separates this random stream from other uses of the seed.
const PURPOSE: [u8; 8] = *b"imperfec";

pub(super) fn displace(
    scene: &Scene,
    filaments: &[FilamentSpan],
    (points, frames): (&[PointInfo], &[FrameInfo]),
    state: &mut State,
) {
    for (i, (written, span)) in scene.filaments().zip(filaments).enumerate() {
        let Some(imperfection) = &written.imperfection else {
            continue;
        };
        let field = Field::new(imperfection, i, written.length_nm());
        for p in span.points.clone() {
            if !state.points.is_free(p) {
                continue;
            }
            let s_nm = points[p].s_nm;
            let (shift, turn) = field.at(s_nm, span);
            let axis_point = span.axis_place(s_nm);
            let arm = state.points.position.get(p) - axis_point;
            let place = axis_point + shift + rotation::exp(turn) * arm;
            state.points.position.set(p, place);
        }
        for f in span.frames.clone() {
            if !state.frames.is_free(f) {
                continue;
            }
            let (_, turn) = field.at(frames[f].s_nm, span);
            let q = rotation::exp(turn) * state.frames.orientation.get(f);
            state.frames.orientation.set(f, q);
        }
    }
}

struct Field {
    length_nm: f64,
    coefficients: [Vector3; MODES],
}

impl Field {
    fn new(imperfection: &Imperfection, index: usize, length_nm: f64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&imperfection.seed.to_le_bytes());
        key[8..16].copy_from_slice(&PURPOSE);
        let mut generator = ChaCha8Rng::from_seed(key);
        generator.set_stream(index as u64);
        let coefficients = std::array::from_fn(|i| {
            let azimuth = TAU * (generator.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
            let (sin, cos) = azimuth.sin_cos();
            Vector3::new(cos, sin, 0.0) / ((i + 1) as f64).powi(2)
        });
        let mut field = Self {
            length_nm,
            coefficients,
        };
        let sizes = (0..=PLACES).map(|i| field.shift(f64::from(i) / f64::from(PLACES)).norm());
        let largest = sizes.fold(0.0, f64::max);
        for coefficient in &mut field.coefficients {
            *coefficient *= imperfection.amplitude_nm / largest;
        }
        field
    }

    fn shift(&self, x: f64) -> Vector3 {
        let of = |(k, c): (f64, &Vector3)| c * ((PI * x).sin() * (k * PI * x).sin());
        numbered(&self.coefficients).map(of).sum()
    }

    fn slope(&self, x: f64) -> Vector3 {
        let of = |(k, c): (f64, &Vector3)| {
            let ((sin, cos), (sin_k, cos_k)) = ((PI * x).sin_cos(), (k * PI * x).sin_cos());
            c * (PI * (cos * sin_k + k * sin * cos_k))
        };
        numbered(&self.coefficients).map(of).sum()
    }

    /// Displacement (nm) and rotation vector of the cross-section at `s_nm`, both in the lab frame.
    fn at(&self, s_nm: f64, span: &FilamentSpan) -> (Vector3, Vector3) {
        // Held monomers lie outside, and the resolved length deviates by up to half a rise.
        let x = (s_nm / self.length_nm).clamp(0.0, 1.0);
        let turn = Vector3::z().cross(&self.slope(x)) / self.length_nm;
        let rotation = span.frame_at(s_nm);
        (rotation * self.shift(x), rotation * turn)
    }
}

fn numbered(coefficients: &[Vector3; MODES]) -> impl Iterator<Item = (f64, &Vector3)> {
    coefficients
        .iter()
        .enumerate()
        .map(|(i, c)| ((i + 1) as f64, c))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Assembly;
    use crate::scene::Scene;

    const SECTIONS: [&str; 4] = [
        "Rod(from_nm: 0.0, to_nm: 90.0)",
        "Rod(from_nm: 0.0, to_nm: 90.0, segments: 30)",
        "Ellipsoids(from_nm: 0.0, to_nm: 90.0)",
        "Rod(from_nm: 0.0, to_nm: 30.0), Ellipsoids(from_nm: 30.0, to_nm: 60.0),
         Rod(from_nm: 60.0, to_nm: 90.0)",
    ];
    const CLAMPS: [&str; 3] = [
        "",
        "Clamp(end: Start), Clamp(end: End)",
        "Clamp(end: Start), Clamp(end: End, slides: AlongAxis)",
    ];

    fn build(sections: &str, clamps: &str, imperfection: &str) -> Assembly {
        let text = format!(
            "Scene(
                filament: Filament(
                    sections: [{sections}], {imperfection}
                    at_nm: (3.0, -2.0, 5.0), direction: (1.0, 2.0, 2.0), roll_deg: 20.0,
                ),
                clamps: [{clamps}],
                task: Equilibrium(),
            )"
        );
        Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap()
    }

    /// Tolerances cover the second order of the slope.
    #[test]
    fn the_field_depends_on_arc_length_in_every_model() {
        let imperfection = "imperfection: (amplitude_nm: 0.02, seed: 7),";
        for (sections, clamps) in SECTIONS.iter().flat_map(|s| CLAMPS.map(|c| (s, c))) {
            let assembly = build(sections, clamps, imperfection);
            let state = assembly.system.state();
            let written = assembly.scene.filament.imperfection.unwrap();
            let field = Field::new(&written, 0, 90.0);
            let span = &assembly.filaments[0];
            for (i, point) in assembly.points.iter().enumerate() {
                let (shift, _) = field.at(point.s_nm, span);
                let expected = span.origin_nm + span.axis() * point.s_nm + shift;
                // slope^2 / 2 times the radius of 2 nm.
                let distance = (assembly.centre_line_nm(state, i) - expected).norm();
                assert!(
                    distance < 1e-4,
                    "{sections} at {}: {distance:e}",
                    point.s_nm
                );
            }
            for (i, frame) in assembly.frames.iter().enumerate() {
                let (now, rest) = (
                    state.frames.orientation.get(i),
                    assembly.rest.frames.orientation.get(i),
                );
                let tilt = (now * (rest.inverse() * span.axis()) - span.axis()).norm();
                let expected = field.at(frame.s_nm, span).1.norm();
                // A held frame is not turned; the field there is below 1e-4 rad.
                assert!(
                    (tilt - expected).abs() < 1e-4,
                    "{sections} at {}",
                    frame.s_nm
                );
            }
            for clamp in &assembly.clamps {
                for &p in &clamp.points {
                    let moved = state.points.position.get(p) - assembly.rest.points.position.get(p);
                    assert_eq!(moved, Vector3::zeros());
                }
            }
        }
    }

    #[test]
    fn amplitude_and_seed_set_the_displacement() {
        let places = |imperfection: &Imperfection, index| {
            let field = Field::new(imperfection, index, 90.0);
            (0..=90)
                .map(|i| field.shift(f64::from(i) / 90.0))
                .collect::<Vec<_>>()
        };
        let one = Imperfection {
            amplitude_nm: 0.01,
            seed: 1,
        };
        let other = Imperfection { seed: 2, ..one };
        let largest = places(&one, 0)
            .iter()
            .map(Vector3::norm)
            .fold(0.0, f64::max);
        assert!((largest / 0.01 - 1.0).abs() < 1e-2, "{largest}");
        assert!(places(&one, 0) != places(&one, 1) && places(&one, 0) != places(&other, 0));
        let straight = build(SECTIONS[3], CLAMPS[1], "");
        assert_eq!(straight.system.state(), &straight.rest);
    }

    #[test]
    fn the_slope_belongs_to_the_shift() {
        let imperfection = Imperfection {
            amplitude_nm: 1.0,
            seed: 3,
        };
        let field = Field::new(&imperfection, 0, 90.0);
        let h = 1e-5;
        for x in [0.1, 0.37, 0.5, 0.92] {
            let slope = (field.shift(x + h) - field.shift(x - h)) / (2.0 * h);
            assert!((slope - field.slope(x)).norm() < 1e-7, "{x}");
        }
        for x in [0.0, 1.0] {
            assert!(field.shift(x).norm() < 1e-15 && field.slope(x).norm() < 1e-14);
        }
    }
}
