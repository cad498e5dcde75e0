//! Fluid drag on an assembly: the drag of one cylinder per filament, distributed over its bodies.

use super::{Assembly, BodyKind, SectionSpan};
use crate::scene::{End, Fluid, SceneProblem, Water};
use actin_brownian::{Cylinder, Dashpot, Friction, TurnDashpot};
use actin_cosserat::RodLayout;
use actin_mechanics::Vector3;
use std::f64::consts::PI;

/// Largest share of a segment's rotational friction for the frames of one junction, and for the
/// cross-section at its end.
const OF_SEGMENT: f64 = 0.25;

impl Assembly {
    /// Returns the drag of `fluid` on all filaments and beads.
    ///
    /// A monomer carries the drag of its share of the section's length, acting at the axis of the
    /// filament. A segment's drag is split evenly between its nodes. Each junction frame takes the
    /// rotational friction of one rise from the nearest segment, in total at most a quarter of that
    /// segment's friction. The total therefore does not depend on the resolution. Frames of joints
    /// have no length of cylinder and receive the rotational friction of a rise in addition.
    ///
    /// # Errors
    /// If a filament is too short for its radius.
    pub fn friction(&self, fluid: &Fluid) -> Result<Friction, SceneProblem> {
        let Fluid::Water(Water {
            at_ends,
            viscosity_mpa_s,
            ..
        }) = *fluid;
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
        for (site, radius) in &self.beads {
            // Friction of a sphere at low Reynolds number.
            let of_place = 6.0 * PI * viscosity_mpa_s * radius;
            let of_turns = 8.0 * PI * viscosity_mpa_s * radius.powi(3);
            friction.dashpots.push(Dashpot {
                points: site.weighted_points(),
                frame: site.frame(),
                arm: site.arm(),
                friction: Vector3::repeat(of_place),
            });
            friction.turns.push(TurnDashpot {
                frame: site.frame(),
                friction: Vector3::repeat(of_turns),
                is_sphere: true,
            });
        }
        Ok(friction)
    }

    /// Returns the cylinder that represents a filament in `fluid`.
    ///
    /// # Errors
    /// If a filament is too short for its radius.
    pub fn cylinder(&self, fluid: &Fluid, filament: usize) -> Result<Cylinder, SceneProblem> {
        let Fluid::Water(Water {
            viscosity_mpa_s,
            radius_nm,
            ..
        }) = *fluid;
        Cylinder::new(viscosity_mpa_s, self.length_of(filament), radius_nm).map_err(|error| {
            let key = "task.drag.radius_nm";
            SceneProblem::new(key, format!("{radius_nm:?}"), error.to_string())
        })
    }
}

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
            match self.assembly.frames[frame].kind {
                BodyKind::Junction => self.add_junction(frame, friction),
                BodyKind::Joint => friction.turns.push(self.turn(frame, self.rise())),
                BodyKind::Wall if self.is_end_of_rod(frame) => {
                    self.share_turns(frame, |length| OF_SEGMENT * length, friction);
                }
                _ => {}
            }
        }
        if self.at_ends {
            let ends = [End::Start, End::End].map(|end| self.of_end(end));
            friction.dashpots.extend(ends);
        }
    }

    fn rod(&self, section: usize) -> Option<&RodLayout> {
        Some(&self.assembly.rod_of(section)?.layout)
    }

    fn rise(&self) -> f64 {
        self.assembly.monomers_of(self.filament).rise_nm
    }

    /// Vector from the centre of a monomer to the axis (nm, body frame).
    fn to_axis(&self) -> Vector3 {
        -Vector3::x() * self.assembly.monomers_of(self.filament).radius_nm
    }

    /// Drag of a length of cylinder (pN ns/nm, body axes) without end effects.
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
        TurnDashpot {
            frame,
            friction,
            is_sphere: false,
        }
    }

    fn add_monomers(&self, section: &SectionSpan, friction: &mut Friction) {
        // Nearly a rise; monomers at the ends of a section have a shorter share.
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

    /// Returns `true` for a free wall frame, under an end couple or in heat, that is no hinge.
    fn is_end_of_rod(&self, frame: usize) -> bool {
        let mut ends = [End::Start, End::End].into_iter();
        self.assembly.rest.frames.is_free(frame)
            && ends.all(|end| {
                let hinge = self.assembly.hinge_frames(self.filament, end);
                hinge.is_none_or(|[_, wall]| wall != frame)
            })
    }

    /// Transfers rotational friction from the nearest segment to a junction frame.
    fn add_junction(&self, frame: usize, friction: &mut Friction) {
        let filament = self.assembly.written(self.filament);
        let attached = filament.junction.attached_monomers as f64;
        let share = |length: f64| f64::min(self.rise(), OF_SEGMENT * length / attached);
        self.share_turns(frame, share, friction);
    }

    /// Transfers rotational friction from the nearest segment to a frame. `share` returns the
    /// transferred fraction for a given length of the segment (nm).
    fn share_turns(&self, frame: usize, share: impl Fn(f64) -> f64, friction: &mut Friction) {
        let place = |f: usize| self.assembly.frames[f].s_nm;
        let spans = &self.assembly.filaments[self.filament];
        let rods = spans.sections.clone().filter_map(|i| self.rod(i));
        let segments = rods.flat_map(|rod| rod.segment_lengths().iter().copied().zip(rod.frames()));
        let distance = |f: usize| (place(f) - place(frame)).abs();
        let (length, segment) = segments
            .min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))
            .expect("such a frame is at a rod");
        let share = self.turn(frame, share(length));
        let mut turns = friction.turns.iter_mut();
        if let Some(turn) = turns.find(|turn| turn.frame == segment) {
            turn.friction -= share.friction;
        }
        friction.turns.push(share);
    }

    fn of_end(&self, end: End) -> Dashpot {
        let first = self.assembly.filaments[self.filament].sections.start;
        let section = first + self.assembly.written(self.filament).end_index(end);
        let across = self.cylinder.at_ends();
        let friction = Vector3::new(across, across, 0.0);
        if let Some(rod) = self.rod(section) {
            let (point, frame) = (rod.end_point(end), rod.end_frame(end));
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
    use crate::scene::Scene;

    fn friction_of(sections: &str) -> (Assembly, Friction) {
        let text = format!(
            "Scene(filament: Filament(sections: [{sections}], rod: (law: Constant)),
                task: Brownian(duration_ms: 1.0, temperature_k: 298.0))"
        );
        let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
        let friction = assembly.friction(&Fluid::default()).unwrap();
        (assembly, friction)
    }

    #[test]
    fn resolutions_have_the_same_drag() {
        for sections in [
            "Rod(from_nm: 0.0, to_nm: 120.0, segments: 2)",
            "Rod(from_nm: 0.0, to_nm: 120.0)",
            "Ellipsoids(from_nm: 0.0, to_nm: 120.0)",
            "Rod(from_nm: 0.0, to_nm: 50.0), Ellipsoids(from_nm: 50.0, to_nm: 120.0)",
            "Ellipsoids(from_nm: 0.0, to_nm: 40.0), Rod(from_nm: 40.0, to_nm: 46.0, segments: 1),
             Ellipsoids(from_nm: 46.0, to_nm: 120.0)",
        ] {
            let (assembly, friction) = friction_of(sections);
            let cylinder = Cylinder::new(0.89, assembly.length_nm(), 3.5).unwrap();
            let of_place = |dashpot: &Dashpot| {
                let weight: f64 = dashpot.points.iter().map(|(_, weight)| weight).sum();
                dashpot.friction * (weight * weight)
            };
            let total: Vector3 = friction.dashpots.iter().map(of_place).sum();
            let turning: Vector3 = friction.turns.iter().map(|turn| turn.friction).sum();
            assert!(friction.turns.iter().all(|turn| turn.friction.min() > 0.0));
            let pairs = [
                (total.x, cylinder.across()),
                (total.z, cylinder.along()),
                (turning.x, cylinder.tilt()),
                (turning.z, cylinder.about()),
            ];
            for (total, per_length) in pairs {
                let expected = per_length * assembly.length_nm();
                let is_close = (total / expected - 1.0).abs() < 1e-12;
                assert!(is_close, "{sections}: {total} {expected}");
            }
        }
    }

    #[test]
    fn cells_drag_as_much_however_they_are_resolved() {
        let rods = "Rod(from_nm: 0.0, to_nm: 35.6, segments: 1), Rod(from_nm: 35.6, to_nm: 71.2, segments: 1),
            Rod(from_nm: 71.2, to_nm: 106.8, segments: 1)";
        let mixed =
            "Rod(from_nm: 0.0, to_nm: 35.6, segments: 1), Ellipsoids(from_nm: 35.6, to_nm: 71.2),
            Rod(from_nm: 71.2, to_nm: 106.8, segments: 1)";
        let [of_rod, of_monomers] = [rods, mixed].map(|sections| {
            let (assembly, friction) = friction_of(sections);
            let is_inside = |dashpot: &&Dashpot| {
                let s_nm = assembly.frames[dashpot.frame].s_nm;
                let total: f64 = dashpot.points.iter().map(|(_, weight)| weight).sum();
                35.0 < s_nm && s_nm < 72.0 && total > 0.5
            };
            let inside = friction.dashpots.iter().filter(is_inside);
            inside.map(|dashpot| dashpot.friction).sum::<Vector3>()
        });
        assert!(
            (of_rod - of_monomers).norm() < 1e-9 * of_rod.norm(),
            "{of_rod:?} {of_monomers:?}"
        );
    }
}
