//! Bending of a straight filament to the curve of its shape, and twisting to its rest twist.

use super::SceneParts;
use super::strand::{Body, Strand, check_angle};
use crate::built_axis::BuiltAxis;
use crate::scene::{Curve, SceneProblem};
use actin_cosserat::RodLayout;
use actin_mechanics::{Vector3, rotation};
use std::ops::Range;

impl Strand<'_> {
    /// Moves the bodies of the filament to its curve and rest twist. Segments keep their lengths.
    ///
    /// # Errors
    /// If neighbouring segments would form a right or larger angle.
    pub(super) fn bend(
        &mut self,
        frames: Range<usize>,
        stock: &mut SceneParts,
    ) -> Result<(), SceneProblem> {
        let from: Vec<f64> = self.resolved.iter().map(|r| r.from_nm).collect();
        let curve = Curve::new(self.filament, &from);
        if self.filament.shape.is_none() && curve.is_straight() {
            return Ok(());
        }
        let mut built = BuiltAxis::new(curve);
        self.turn_frames(frames, built.curve(), stock);
        for (i, body) in self.bodies.iter().enumerate() {
            let (from_nm, to_nm) = (self.resolved[i].from_nm, self.resolved[i].to_nm);
            let shift = match body {
                Body::Monomers(monomers) => {
                    let shift = built.last_shift();
                    for k in 0..monomers.count {
                        self.move_point(monomers.point(k), built.curve(), shift, stock);
                    }
                    shift
                }
                Body::Rod(layout) => {
                    check_angles(i, layout, stock)?;
                    let start = built.curve().at(from_nm).0 + built.last_shift();
                    self.lay(layout, start, stock) - built.curve().at(to_nm).0
                }
            };
            built.push([from_nm, to_nm], shift);
        }
        self.built = Some(built);
        Ok(())
    }

    fn turn_frames(&self, frames: Range<usize>, curve: &Curve, stock: &mut SceneParts) {
        let rotation = self.placement.rotation;
        for f in frames {
            let turn = rotation * curve.at(stock.frames[f].s_nm).1 * rotation.inverse();
            let q = stock.state.frames.orientation.get(f);
            stock.state.frames.orientation.set(f, turn * q);
        }
    }

    fn move_point(&self, point: usize, curve: &Curve, shift: Vector3, stock: &mut SceneParts) {
        let s_nm = stock.points[point].s_nm;
        let own = stock.state.points.position.get(point) - self.placement.translation;
        let own = self.placement.rotation.inverse_transform_vector(&own);
        let (place, frame) = curve.at(s_nm);
        let moved = place + shift + frame * (own - Vector3::z() * s_nm);
        let lab = self.placement.translation + self.placement.rotation * moved;
        stock.state.points.position.set(point, lab);
    }

    fn lay(&self, layout: &RodLayout, start: Vector3, stock: &mut SceneParts) -> Vector3 {
        let (rotation, translation) = (self.placement.rotation, self.placement.translation);
        let mut place = start;
        let first = layout.points().start;
        let state = &mut stock.state;
        state
            .points
            .position
            .set(first, translation + rotation * place);
        let segments = layout.frames().zip(layout.segment_lengths());
        for (node, (frame, &length)) in (first + 1..).zip(segments) {
            let along = state.frames.orientation.get(frame) * Vector3::z();
            place += rotation.inverse_transform_vector(&along) * length;
            state
                .points
                .position
                .set(node, translation + rotation * place);
        }
        place
    }
}

fn check_angles(i: usize, layout: &RodLayout, stock: &SceneParts) -> Result<(), SceneProblem> {
    let q = &stock.state.frames.orientation;
    let chain = layout.bending_chain();
    let angles = chain.clone().zip(chain.skip(1));
    let angles = angles.map(|(a, b)| rotation::log(q.get(a).inverse() * q.get(b)).norm());
    let largest = angles.fold(0.0, f64::max);
    check_angle(i, layout.segments(), largest)
}
