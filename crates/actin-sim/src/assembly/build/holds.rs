//! Holding the ends of a filament, once all its bodies stand.

use super::{Body, Builder};
use crate::assembly::{Clamped, models};
use crate::scene::{Clamp, End, Problem};
use actin_mechanics::{Slider, Vector3};
use std::ops::Range;

impl Builder<'_> {
    /// Holds the bodies of every clamp.
    pub(super) fn hold_ends(&mut self) -> Result<(), Problem> {
        let masses: Vec<f64> = self.state.points.inverse_mass().to_vec();
        for (i, clamp) in self.scene.clamps.iter().enumerate() {
            let section = self.scene.filament.end_index(clamp.end);
            let (points, frames) = self.hold(i, clamp, section)?;
            let held_before = self.clamps.iter().any(|other| {
                points.clone().any(|p| other.points.contains(&p))
                    || frames.clone().any(|f| other.frames.contains(&f))
            });
            if held_before {
                return Err(Problem::new(
                    format!("clamps[{i}].hold"),
                    format!("{:?}", clamp.hold),
                    "holds bodies that the other clamp holds: the filament is too short for both",
                ));
            }
            let directions = clamp.slides.directions();
            if !directions.is_empty() {
                self.state.sliders.push(Slider {
                    points: points.clone().collect(),
                    directions,
                    mass: points.clone().map(|i| 1.0 / masses[i]).sum(),
                });
            }
            let s_nm = match clamp.end {
                End::Start => self.resolved[section].from_nm,
                End::End => self.resolved[section].to_nm,
            };
            let about_nm = Vector3::z() * s_nm;
            self.clamps.push(Clamped {
                end: clamp.end,
                arm_nm: self.state.points.position.get(points.start) - about_nm,
                rest: self.state.frames.orientation.get(frames.start),
                points: points.collect(),
                frames: frames.collect(),
                about_nm,
                slides: clamp.slides,
            });
        }
        Ok(())
    }

    /// Holds the bodies of clamp `i` at the end that `section` has; returns points and frames.
    fn hold(
        &mut self,
        i: usize,
        clamp: &Clamp,
        section: usize,
    ) -> Result<(Range<usize>, Range<usize>), Problem> {
        match &self.bodies[section] {
            Body::Monomers(m) => {
                let k = match clamp.end {
                    End::Start => 0,
                    End::End => m.count - 2,
                };
                let bodies = (m.point(k)..m.point(k) + 2, m.frame(k)..m.frame(k) + 2);
                bodies.0.clone().for_each(|p| self.state.points.hold(p));
                bodies.1.clone().for_each(|f| self.state.frames.hold(f));
                Ok(bodies)
            }
            Body::Rod(layout) => {
                let held = models::rod_clamp(clamp.hold)
                    .hold(layout, models::rod_end(clamp.end), &mut self.state)
                    .map_err(|error| {
                        let key = format!("clamps[{i}].hold");
                        Problem::new(key, format!("{:?}", clamp.hold), error.to_string())
                    })?;
                Ok((held.points, held.frames))
            }
        }
    }
}
