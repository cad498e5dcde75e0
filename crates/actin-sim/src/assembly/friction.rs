//! The drag of a fluid on an assembly: that of one cylinder for each filament, shared out to its bodies.

use super::{Assembly, BodyKind, SectionSpan};
use crate::scene::{End, Fluid, SceneProblem};
use actin_brownian::{Cylinder, Dashpot, Friction, TurnDashpot};
use actin_cosserat::{RodEnd, RodLayout};
use actin_mechanics::Vector3;

impl Assembly {
    /// The drag of `fluid` on all filaments.
    ///
    /// A monomer has that of its share of its section's length, at the axis of the filament; a segment that of its length, spread
    /// evenly between its nodes. Frames of junctions and joints, which no piece of cylinder is left for, turn as
    /// if they had a rise.
    ///
    /// # Errors
    /// A filament that is too short for its radius.
    pub(crate) fn friction(&self, fluid: &Fluid) -> Result<Friction, SceneProblem> {
        let Fluid::Water { at_ends, .. } = *fluid;
        let mut friction = Friction::default();
        for filament in 0..self.filaments.len() {
            let drag = FilamentDrag {
                assembly: self,
                filament,
                cylinder: self.cylinder(fluid, filament)?,
                at_ends,
            };
            drag.add(&mut friction);
        }
        Ok(friction)
    }

    /// The cylinder that a filament is in `fluid`.
    ///
    /// # Errors
    /// A filament that is too short for its radius.
    pub(crate) fn cylinder(
        &self,
        fluid: &Fluid,
        filament: usize,
    ) -> Result<Cylinder, SceneProblem> {
        let Fluid::Water {
            viscosity_mpa_s,
            radius_nm,
            ..
        } = *fluid;
        Cylinder::new(viscosity_mpa_s, self.length_of(filament), radius_nm).map_err(|error| {
            let key = "task.drag.radius_nm";
            SceneProblem::new(key, format!("{radius_nm:?}"), error.to_string())
        })
    }
}

/// The drag of one filament.
struct FilamentDrag<'a> {
    assembly: &'a Assembly,
    filament: usize,
    cylinder: Cylinder,
    at_ends: bool,
}

impl FilamentDrag<'_> {
    fn add(&self, friction: &mut Friction) {
        let spans = &self.assembly.filaments[self.filament];
        for section in spans.sections.clone() {
            match self.rod(section) {
                Some(rod) => self.add_rod(rod, friction),
                None => self.add_monomers(&self.assembly.sections[section], friction),
            }
        }
        for frame in spans.frames.clone() {
            let kind = self.assembly.frames[frame].kind;
            if matches!(kind, BodyKind::Junction | BodyKind::Joint) {
                friction.turns.push(self.turn(frame, self.rise()));
            }
        }
        if self.at_ends {
            let ends = [End::Start, End::End].map(|end| self.of_end(end));
            friction.dashpots.extend(ends);
        }
    }

    /// The rod that a section is, if it is one.
    fn rod(&self, section: usize) -> Option<&RodLayout> {
        let mut rods = self.assembly.rods.iter();
        let rod = rods.find(|rod| rod.section == section)?;
        Some(&rod.layout)
    }

    fn rise(&self) -> f64 {
        self.assembly.monomers_of(self.filament).rise_nm
    }

    /// From the centre of a monomer to the axis (nm, body frame).
    fn to_axis(&self) -> Vector3 {
        -Vector3::x() * self.assembly.monomers_of(self.filament).radius_nm
    }

    /// Drag of a length of cylinder (pN ns/nm, axes of its frame), that at the ends left out.
    fn of_length(&self, length: f64) -> Vector3 {
        let across = if self.at_ends {
            self.cylinder.between_ends()
        } else {
            self.cylinder.across()
        };
        Vector3::new(across, across, self.cylinder.along()) * length
    }

    fn turn(&self, frame: usize, length: f64) -> TurnDashpot {
        let (tilt, about) = (self.cylinder.tilt(), self.cylinder.about());
        let friction = Vector3::new(tilt, tilt, about) * length;
        TurnDashpot { frame, friction }
    }

    fn add_monomers(&self, section: &SectionSpan, friction: &mut Friction) {
        // Nearly a rise: those at both ends of a section stand for less.
        let share = (section.to_nm - section.from_nm) / section.points.len() as f64;
        let (of_share, arm) = (self.of_length(share), self.to_axis());
        for (point, frame) in section.points.clone().zip(section.frames.clone()) {
            let dashpot = Dashpot::of_body(point, frame, arm, of_share);
            friction.dashpots.push(dashpot);
            friction.turns.push(self.turn(frame, share));
        }
    }

    fn add_rod(&self, rod: &RodLayout, friction: &mut Friction) {
        let segments = rod
            .segment_lengths()
            .iter()
            .zip(rod.frames())
            .zip(rod.points());
        for ((&length, frame), point) in segments {
            let of_line = Dashpot::of_line([point, point + 1], frame, self.of_length(length));
            friction.dashpots.extend(of_line);
            friction.turns.push(self.turn(frame, length));
        }
    }

    /// The drag that acts at an end.
    fn of_end(&self, end: End) -> Dashpot {
        let sections = self.assembly.filaments[self.filament].sections.clone();
        let (section, rod_end) = match end {
            End::Start => (sections.start, RodEnd::Start),
            End::End => (sections.end - 1, RodEnd::End),
        };
        let across = self.cylinder.at_ends();
        let friction = Vector3::new(across, across, 0.0);
        if let Some(rod) = self.rod(section) {
            let (point, frame) = (rod.end_point(rod_end), rod.end_frame(rod_end));
            return Dashpot::of_body(point, frame, Vector3::zeros(), friction);
        }
        let SectionSpan { points, frames, .. } = &self.assembly.sections[section];
        let (point, frame) = match end {
            End::Start => (points.start, frames.start),
            End::End => (points.end - 1, frames.end - 1),
        };
        Dashpot::of_body(point, frame, self.to_axis(), friction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    /// A filament that moves along or across has the drag of the cylinder, however it is resolved.
    #[test]
    fn resolutions_have_the_same_drag() {
        for (sections, tolerance) in [
            ("Rod(from_nm: 0.0, to_nm: 120.0, segments: 2)", 1e-12),
            ("Rod(from_nm: 0.0, to_nm: 120.0)", 1e-12),
            ("Ellipsoids(from_nm: 0.0, to_nm: 120.0)", 1e-12),
            (
                "Rod(from_nm: 0.0, to_nm: 50.0), Ellipsoids(from_nm: 50.0, to_nm: 120.0)",
                1e-12,
            ),
        ] {
            let text = format!(
                "Scene(filament: Filament(sections: [{sections}]),
                    task: Brownian(duration_ms: 1.0, temperature_k: 298.0))"
            );
            let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
            let friction = assembly.friction(&Fluid::default()).unwrap();
            let cylinder = Cylinder::new(0.89, assembly.length_nm(), 3.5).unwrap();
            let mut total = Vector3::zeros();
            for dashpot in &friction.dashpots {
                let weight: f64 = dashpot.points.iter().map(|(_, weight)| weight).sum();
                total += dashpot.friction * (weight * weight);
            }
            let length = assembly.length_nm();
            let expected = [cylinder.across() * length, cylinder.along() * length];
            for (total, expected) in [(total.x, expected[0]), (total.z, expected[1])] {
                assert!(
                    (total / expected - 1.0).abs() < tolerance,
                    "{sections}: {total} {expected}"
                );
            }
        }
    }
}
