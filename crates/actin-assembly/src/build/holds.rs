//! Clamps and hinges at the ends of filaments.

use super::{Body, Builder};
use crate::hinge::Hinge;
use crate::scene::{Clamp, End, SceneProblem};
use crate::{Clamped, Part, models, problem_at};
use actin_mechanics::Slider;
use std::ops::Range;

impl Builder<'_> {
    pub(super) fn hold_ends(&mut self) -> Result<(), SceneProblem> {
        let masses: Vec<f64> = self.stock.state.points.inverse_mass().to_vec();
        for (i, clamp) in self.scene.clamps.iter().enumerate() {
            let (points, frames) = self.hold(i, clamp)?;
            // Only the other clamp of the same filament can hold the same bodies.
            let others = [End::Start, End::End].map(|end| self.held.clamp_at(clamp.filament, end));
            let others = others.into_iter().flatten().filter(|other| *other < i);
            let held_before = others.map(|other| &self.clamps[other]).any(|other| {
                points.clone().any(|p| other.points.contains(&p))
                    || frames.clone().any(|f| other.frames.contains(&f))
            });
            if held_before {
                return Err(SceneProblem::new(
                    format!("clamps[{i}].hold"),
                    format!("{:?}", clamp.hold),
                    "both clamps hold the same bodies: the filament is too short for two clamps",
                ));
            }
            let strand = &self.strands[clamp.filament];
            let axis = strand.tangent_at(strand.end_nm(clamp.end));
            let directions = clamp.slides.directions(axis);
            if !directions.is_empty() {
                self.stock.state.sliders.push(Slider {
                    points: points.clone().collect(),
                    directions,
                    mass: points.clone().map(|i| 1.0 / masses[i]).sum(),
                });
            }
            let clamped = self.clamped(clamp, points, frames);
            self.clamps.push(clamped);
        }
        Ok(())
    }

    fn clamped(&self, clamp: &Clamp, points: Range<usize>, frames: Range<usize>) -> Clamped {
        let strand = &self.strands[clamp.filament];
        let s_nm = strand.end_nm(clamp.end);
        let about_nm = strand.axis_at(s_nm);
        let state = &self.stock.state;
        Clamped {
            filament: clamp.filament,
            end: clamp.end,
            axis: strand.tangent_at(s_nm),
            arm_nm: state.points.position.get(points.start) - about_nm,
            rest: if frames.is_empty() {
                strand.frame_at(s_nm)
            } else {
                state.frames.orientation.get(frames.start)
            },
            points: points.collect(),
            frames: frames.collect(),
            about_nm,
            slides: clamp.slides,
        }
    }

    fn hold(
        &mut self,
        i: usize,
        clamp: &Clamp,
    ) -> Result<(Range<usize>, Range<usize>), SceneProblem> {
        let strand = &self.strands[clamp.filament];
        let state = &mut self.stock.state;
        match &strand.bodies[strand.filament.end_index(clamp.end)] {
            Body::Monomers(m) => {
                let k = match clamp.end {
                    End::Start => 0,
                    End::End => m.count - 2,
                };
                let bodies = (m.point(k)..m.point(k) + 2, m.frame(k)..m.frame(k) + 2);
                bodies.0.clone().for_each(|p| state.points.hold(p));
                bodies.1.clone().for_each(|f| state.frames.hold(f));
                Ok(bodies)
            }
            Body::Rod(layout) => {
                let held = models::rod_clamp(clamp.hold)
                    .hold(layout, clamp.end, state)
                    .map_err(|error| {
                        let key = format!("clamps[{i}].hold");
                        SceneProblem::new(key, format!("{:?}", clamp.hold), error.to_string())
                    })?;
                let Some(anchor) = strand.hinge_frames[clamp.end as usize] else {
                    return Ok((held.points, held.frames));
                };
                // The wall frame becomes the free cross-section, which the spring joins to the held
                // frame.
                if let Some(wall) = layout.wall(clamp.end) {
                    state.frames.release(wall);
                    let hinge = Hinge::new(clamp, [anchor, wall])
                        .map_err(problem_at(format!("clamps[{i}].hinge")))?;
                    self.stock.push_term(Box::new(hinge), Part::Clamp(i));
                }
                Ok((held.points, anchor..anchor + 1))
            }
        }
    }
}
