//! Cross-sections of a filament in one state, for every resolution.

use super::Ribbon;
use crate::Assembly;
use actin_mechanics::{State, UnitQuaternion, Vector3};

/// Tolerance (nm) for equal arc lengths of frames.
const SAME_PLACE_NM: f64 = 1e-6;

/// Position (nm) and axes (body to lab) of a cross-section.
pub(crate) type CrossSection = (Vector3, UnitQuaternion);

/// Position and axes of every cross-section of a filament.
///
/// Positions follow the cubic Hermite curve through the vertices of the [`Ribbon`] along its
/// frames. Axes are interpolated uniformly between frames. Beyond the outermost vertex the filament
/// continues straight.
#[derive(Debug)]
pub(crate) struct Axis {
    /// Arc length, position and derivative by arc length of each vertex.
    vertices: Vec<(f64, Vector3, Vector3)>,
    /// Arc lengths and axes of frames.
    frames: Vec<(f64, UnitQuaternion)>,
}

impl Axis {
    pub(crate) fn new(assembly: &Assembly, state: &State) -> Self {
        Self::from_ribbon(&Ribbon::new(assembly, state))
    }

    pub(crate) fn from_ribbon(ribbon: &Ribbon) -> Self {
        let frames = ribbon.frames.iter().copied();
        let inside = ribbon.frame_s_nm.iter().copied().zip(frames);
        let mut frames: Vec<_> = ribbon.outermost[0]
            .into_iter()
            .chain(inside)
            .chain(ribbon.outermost[1])
            .collect();
        frames.dedup_by(|b, a| (b.0 - a.0).abs() < SAME_PLACE_NM);
        let mut axis = Self {
            vertices: Vec::new(),
            frames,
        };
        let places = ribbon.s_nm.iter().zip(&ribbon.points_nm);
        axis.vertices = places
            .map(|(&s, &place)| (s, place, axis.axes(s) * Vector3::z()))
            .collect();
        axis
    }

    fn axes(&self, s_nm: f64) -> UnitQuaternion {
        let frames = &self.frames;
        let [(s_a, a), (s_b, b)] = match frames.len() {
            1 => return frames[0].1,
            n => {
                let after = frames.partition_point(|f| f.0 < s_nm).clamp(1, n - 1);
                [frames[after - 1], frames[after]]
            }
        };
        a.slerp(&b, ((s_nm - s_a) / (s_b - s_a)).clamp(0.0, 1.0))
    }

    pub(crate) fn at(&self, s_nm: f64) -> CrossSection {
        let (first, last) = (self.vertices[0], self.vertices[self.vertices.len() - 1]);
        let place = if s_nm <= first.0 {
            first.1 + first.2 * (s_nm - first.0)
        } else if s_nm >= last.0 {
            last.1 + last.2 * (s_nm - last.0)
        } else {
            let after = self.vertices.partition_point(|v| v.0 < s_nm);
            cubic(self.vertices[after - 1], self.vertices[after], s_nm)
        };
        (place, self.axes(s_nm))
    }
}

/// Linear interpolation of values at ascending arc lengths (nm), constant beyond the outermost.
pub(crate) fn interpolated(known: &[(f64, Vector3)], s_nm: f64) -> Vector3 {
    let after = known.partition_point(|k| k.0 < s_nm);
    if after == 0 || after == known.len() {
        return known[after.min(known.len() - 1)].1;
    }
    let ((s_a, a), (s_b, b)) = (known[after - 1], known[after]);
    a.lerp(&b, (s_nm - s_a) / (s_b - s_a))
}

/// Cubic Hermite interpolation between two vertices.
fn cubic(a: (f64, Vector3, Vector3), b: (f64, Vector3, Vector3), s_nm: f64) -> Vector3 {
    let length = b.0 - a.0;
    let t = (s_nm - a.0) / length;
    let (t2, t3) = (t * t, t * t * t);
    a.1 * (2.0 * t3 - 3.0 * t2 + 1.0)
        + b.1 * (3.0 * t2 - 2.0 * t3)
        + (a.2 * (t3 - 2.0 * t2 + t) + b.2 * (t3 - t2)) * length
}
