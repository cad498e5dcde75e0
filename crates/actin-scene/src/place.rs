//! Filaments by index, and their reference positions.

use super::curve::Curve;
use super::rules::check_index;
use super::types::along_z;
use super::{
    End, Filament, FreeTranslation, Hold, JunctionModel, Monomers, RodModel, Scene, SceneProblem,
    Section,
};
use actin_mechanics::{UnitQuaternion, Vector3};
use nalgebra::Quaternion;

impl Filament {
    /// Creates a straight filament of these sections along lab +z from the origin, with default parameters.
    pub fn new(sections: Vec<Section>) -> Self {
        Self {
            sections: sections.into(),
            monomers: Monomers::default(),
            rod: RodModel::default(),
            junction: JunctionModel::default(),
            at_nm: [0.0; 3],
            direction: along_z(),
            roll_deg: 0.0,
            shape: None,
            imperfection: None,
        }
    }

    /// Returns the unit vector along the filament as built (lab frame).
    pub fn axis(&self) -> Vector3 {
        unit_vector(self.direction)
    }

    /// Returns the rotation from a filament along lab +z, with azimuth 0 at +x, to the filament as built:
    /// `roll_deg` about lab z, then the shortest rotation from lab z to the axis. For opposite vectors it is
    /// half a turn about lab x.
    pub fn rotation(&self) -> UnitQuaternion {
        let axis = self.axis();
        let (sine, cosine) = (Vector3::z().cross(&axis), axis.z);
        // Sine and cosine of the half angle; the smaller one is computed from the larger one.
        let larger = (0.5 * (1.0 + cosine.abs())).sqrt();
        let smaller = 0.5 * sine.norm() / larger;
        let about = sine.try_normalize(0.0).unwrap_or_else(Vector3::x);
        let (cos, sin) = if cosine < 0.0 {
            (smaller, larger)
        } else {
            (larger, smaller)
        };
        let tilt = Quaternion::from_parts(cos, about * sin);
        let tilt = UnitQuaternion::from_quaternion(tilt);
        let roll = self.roll_deg.to_radians();
        tilt * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), roll)
    }

    /// Returns the reference position (lab frame, nm) of the axis at an arc length (nm).
    pub(crate) fn place_at(&self, s_nm: f64) -> Vector3 {
        self.places_at(&[s_nm])[0]
    }

    /// Returns the arc lengths (nm) of sites at equal distances (nm); the first one is half a distance from the start.
    pub fn sites_nm(&self, spacing: f64) -> Vec<f64> {
        let length = self.length_nm();
        let places = (0..).map(|i| (f64::from(i) + 0.5) * spacing);
        places.take_while(|s| *s <= length).collect()
    }

    /// Returns the azimuth (-180 to 180 degrees) of the monomer at an arc length (nm). Sites on the axis,
    /// with a radius of 0, have azimuth 0.
    pub fn azimuth_at_radius_deg(&self, s_nm: f64, radius_nm: f64) -> f64 {
        if radius_nm <= 0.0 {
            return 0.0;
        }
        let helix = &self.monomers;
        let index = (s_nm / helix.rise_nm).round();
        let azimuth = helix.azimuth_deg + index * helix.turn_deg;
        azimuth - 360.0 * (azimuth / 360.0).round()
    }

    /// Returns the reference positions (lab frame, nm) of the axis at arc lengths (nm).
    pub(crate) fn places_at(&self, s_nm: &[f64]) -> Vec<Vector3> {
        let axes = self.axes_at(s_nm).into_iter();
        axes.map(|(place, _)| place).collect()
    }

    /// Returns the reference positions (lab frame, nm) of the axis at arc lengths (nm), and the rotations from lab +z to
    /// the axis there.
    pub(crate) fn axes_at(&self, s_nm: &[f64]) -> Vec<(Vector3, UnitQuaternion)> {
        let (at, turn) = (Vector3::from(self.at_nm), self.rotation());
        let curve = Curve::new(self, &self.boundaries());
        let axis = |s: &f64| {
            let (place, own) = curve.at(*s);
            (at + turn * place, turn * own)
        };
        s_nm.iter().map(axis).collect()
    }

    /// Returns the rod models of the sections, without rigidity factors and rest curvature.
    pub fn rod_models(&self) -> impl Iterator<Item = RodModel> {
        let rods = self.sections.iter().filter(|section| section.is_rod());
        rods.map(|section| section.rod_model(&self.rod))
    }

    /// Returns the arc lengths (nm) at which sections start, as written.
    pub(crate) fn boundaries(&self) -> Vec<f64> {
        self.sections.iter().map(|s| s.span_nm().0).collect()
    }

    /// Returns the unit tangent at one end of the filament as built (lab frame).
    pub(crate) fn axis_at(&self, end: End) -> Vector3 {
        if self.shape.is_none() {
            return self.axis();
        }
        let s_nm = match end {
            End::Start => 0.0,
            End::End => self.length_nm(),
        };
        let (_, frame) = Curve::new(self, &self.boundaries()).at(s_nm);
        self.rotation() * frame * Vector3::z()
    }

    /// Returns the index of the section at one end.
    pub fn end_index(&self, end: End) -> usize {
        match end {
            End::Start => 0,
            End::End => self.sections.len() - 1,
        }
    }

    /// Returns the length (nm), as written.
    pub fn length_nm(&self) -> f64 {
        self.sections.last().map_or(0.0, |s| s.span_nm().1)
    }

    /// Returns whether the section at one end is a rod.
    pub(crate) fn is_rod_at(&self, end: End) -> bool {
        self.sections[self.end_index(end)].is_rod()
    }
}

impl Scene {
    /// Iterates over all filaments in the order of their indices.
    pub fn filaments(&self) -> impl Iterator<Item = &Filament> {
        std::iter::once(&self.filament).chain(&self.other_filaments)
    }

    /// Iterates mutably over all filaments.
    pub fn filaments_mut(&mut self) -> impl Iterator<Item = &mut Filament> {
        std::iter::once(&mut self.filament).chain(&mut self.other_filaments)
    }

    /// Returns the number of filaments.
    pub fn number_of_filaments(&self) -> usize {
        1 + self.other_filaments.len()
    }

    /// Returns a filament by its index.
    pub fn filament_at(&self, index: usize) -> Option<&Filament> {
        match index.checked_sub(1) {
            None => Some(&self.filament),
            Some(further) => self.other_filaments.get(further),
        }
    }

    /// Returns the key of a filament in the text of the scene.
    pub fn filament_key(&self, index: usize) -> String {
        if self.other_filaments.is_empty() {
            "filament".to_owned()
        } else {
            format!("filaments[{index}]")
        }
    }

    /// Returns a filament by the index at `key`.
    ///
    /// # Errors
    /// If the index is out of range.
    pub(super) fn named_filament(
        &self,
        key: &str,
        index: usize,
    ) -> Result<&Filament, SceneProblem> {
        check_index(key, "filament", index, self.number_of_filaments())?;
        Ok(self.filament_at(index).unwrap_or(&self.filament))
    }
}

/// Clamps by filament and end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClampedEnds {
    held: Vec<[Option<HeldEnd>; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct HeldEnd {
    clamp: usize,
    is_pinned: bool,
    has_hinge: bool,
}

impl ClampedEnds {
    /// Finds the clamps of a scene. The first clamp of an end counts; invalid filament indices are skipped.
    pub fn new(scene: &Scene) -> Self {
        let mut held = vec![[None; 2]; scene.number_of_filaments()];
        for (clamp, one) in scene.clamps.iter().enumerate() {
            if let Some(ends) = held.get_mut(one.filament) {
                ends[one.end as usize].get_or_insert(HeldEnd {
                    clamp,
                    is_pinned: one.hold == Hold::Pin,
                    has_hinge: one.hinge.is_some(),
                });
            }
        }
        Self { held }
    }

    fn find(&self, filament: usize, end: End, is_found: fn(&HeldEnd) -> bool) -> Option<usize> {
        let held = self.held.get(filament)?[end as usize].filter(is_found);
        held.map(|held| held.clamp)
    }

    /// Returns the index of the clamp at one end of a filament, or `None` if the end is free.
    pub fn clamp_at(&self, filament: usize, end: End) -> Option<usize> {
        self.find(filament, end, |_| true)
    }

    /// Returns the index of the clamp at one end if it holds the orientation, which a pin does not.
    pub fn fixed_at(&self, filament: usize, end: End) -> Option<usize> {
        self.find(filament, end, |held| !held.is_pinned)
    }

    /// Returns the index of the clamp at one end if it has a frame: at the end, or at the other side of a
    /// hinge.
    pub fn turned_at(&self, filament: usize, end: End) -> Option<usize> {
        self.find(filament, end, |held| !held.is_pinned || held.has_hinge)
    }

    /// Returns whether an end is clamped.
    pub(crate) fn is_clamped(&self, filament: usize, end: End) -> bool {
        self.clamp_at(filament, end).is_some()
    }
}

impl FreeTranslation {
    /// Returns the orthonormal free directions (lab frame) for an axis as built.
    pub fn directions(self, axis: Vector3) -> Vec<Vector3> {
        match self {
            Self::Nowhere => Vec::new(),
            Self::AlongAxis => vec![axis],
            Self::Freely => vec![Vector3::x(), Vector3::y(), Vector3::z()],
        }
    }
}

/// Returns the unit vector along a direction that is not zero.
pub fn unit_vector(direction: [f64; 3]) -> Vector3 {
    let direction = Vector3::from(direction);
    // The division prevents overflow and underflow of squares.
    (direction / direction.amax()).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(direction: [f64; 3], roll_deg: f64) -> Filament {
        Filament {
            direction,
            roll_deg,
            ..Filament::new(Vec::new())
        }
    }

    #[test]
    fn the_default_rotation_is_the_identity() {
        assert_eq!(
            along([0.0, 0.0, 1.0], 0.0).rotation(),
            UnitQuaternion::identity()
        );
        assert_eq!(
            along([0.0, 0.0, 7e200], 0.0).rotation(),
            UnitQuaternion::identity()
        );
    }

    #[test]
    fn rotations_follow_direction_and_roll() {
        for direction in [
            [3.0, 0.0, 4.0],
            [0.0, -2.0, -1e-9],
            [1e-200, 0.0, 0.0],
            [1e-9, 0.0, -1.0],
            [0.0, 0.0, -1.0],
        ] {
            let filament = along(direction, 90.0);
            let axis = filament.axis();
            assert!((axis.norm() - 1.0).abs() < 1e-15);
            let unrolled = along(direction, 0.0).rotation();
            assert!(
                (unrolled * Vector3::z() - axis).norm() < 1e-15,
                "{direction:?}"
            );
            let (x, y) = (unrolled * Vector3::x(), unrolled * Vector3::y());
            assert!((filament.rotation() * Vector3::x() - y).norm() < 1e-15);
            assert!(x.cross(&y).dot(&axis) > 0.999);
        }
        let turned = along([1.0, 0.0, 0.0], 0.0).rotation() * Vector3::x();
        assert!((turned + Vector3::z()).norm() < 1e-15);
    }
}
