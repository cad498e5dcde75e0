//! Postprocessing of a picture: ambient occlusion, outlines, haze, downsampling.

use super::canvas::{Cell, FINER};
use super::{Canvas, Picture};

/// Fraction of the background visible through the farthest body.
const HAZE: f32 = 0.45;
/// Radius of ambient occlusion (nm).
const HOLLOW_NM: f64 = 5.0;
/// Its largest value (cells).
const WIDEST: f64 = 68.0;
const PAIRS: usize = 10;
const OUTLINE: ([f32; 3], f32) = ([10.0, 13.0, 18.0], 0.62);

impl Canvas {
    /// Returns the finished picture on a background colour.
    pub fn finish(&self, ground: [u8; 3]) -> Picture {
        let ground = ground.map(f32::from);
        let [width, height] = self.size.map(|n| n / FINER);
        let mut pixels = Vec::with_capacity(3 * width * height);
        let offsets = self.offsets();
        for row in 0..height {
            for column in 0..width {
                let mut sum = [0.0; 3];
                for k in 0..FINER * FINER {
                    let at = (FINER * column + k % FINER, FINER * row + k / FINER);
                    let colour = self.finished(at, ground, &offsets);
                    sum = [0, 1, 2].map(|k| sum[k] + colour[k]);
                }
                pixels.extend(sum.map(|v| byte(v / (FINER * FINER) as f32)));
            }
        }
        Picture::new([width, height], pixels)
    }

    #[expect(clippy::cast_possible_truncation, reason = "a few cells")]
    fn offsets(&self) -> [(isize, isize); PAIRS] {
        let wide = (HOLLOW_NM * self.scale()).clamp(3.0, WIDEST);
        std::array::from_fn(|k| {
            let (angle, share) = (2.4 * k as f64, (k as f64 + 0.5) / PAIRS as f64);
            let far = wide * share.sqrt();
            ((far * angle.cos()) as isize, (far * angle.sin()) as isize)
        })
    }

    fn beside(&self, (column, row): (usize, usize), (dx, dy): (isize, isize)) -> &Cell {
        let [width, height] = self.size;
        let column = column.saturating_add_signed(dx).min(width - 1);
        let row = row.saturating_add_signed(dy).min(height - 1);
        &self.cells[row * width + column]
    }

    #[expect(clippy::cast_possible_truncation, reason = "lengths of pictures")]
    fn finished(
        &self,
        at: (usize, usize),
        ground: [f32; 3],
        offsets: &[(isize, isize)],
    ) -> [f32; 3] {
        let cell = self.beside(at, (0, 0));
        let reach = self.camera.reach as f32;
        let clear = |depth: f32| 1.0 - HAZE * ((reach - depth) / (2.0 * reach)).clamp(0.0, 1.0);
        let mut colour = ground;
        if !cell.is_empty() {
            let shade = if cell.is_body {
                self.hollow(at, offsets)
            } else {
                0.0
            };
            colour = mixed(
                ground,
                cell.colour.map(|v| v * (1.0 - shade)),
                clear(cell.depth),
            );
        }
        let around = [
            (-1, 0),
            (1, 0),
            (0, -1),
            (0, 1),
            (-1, -1),
            (1, 1),
            (-1, 1),
            (1, -1),
        ];
        let depths = around.map(|step| self.beside(at, step).depth);
        let nearest = depths.into_iter().fold(f32::NEG_INFINITY, f32::max);
        let before = nearest - if cell.is_empty() { -reach } else { cell.depth };
        if nearest == f32::NEG_INFINITY || before < 1.2 {
            return colour;
        }
        let near = ((self.camera.per_nm as f32 - 0.7) / 1.8).clamp(0.0, 1.0);
        let edge = ((before - 1.2) / 1.8).min(1.0) * near * OUTLINE.1;
        mixed(colour, OUTLINE.0, edge * clear(nearest))
    }

    /// Returns the occlusion of a cell, from 0 to 0.75.
    #[expect(clippy::cast_possible_truncation, reason = "lengths of pictures")]
    fn hollow(&self, at: (usize, usize), offsets: &[(isize, isize)]) -> f32 {
        let depth = self.beside(at, (0, 0)).depth;
        let wide = (HOLLOW_NM * self.scale()).clamp(3.0, WIDEST);
        let span = (wide / self.scale()) as f32;
        let above = |step| {
            let cell = self.beside(at, step);
            let is_body = cell.is_body && !cell.is_empty();
            if is_body {
                (cell.depth - depth).clamp(-span, span)
            } else {
                -span
            }
        };
        let pairs = offsets
            .iter()
            .map(|&(dx, dy)| above((dx, dy)) + above((-dx, -dy)));
        let sum: f32 = pairs.map(|both| (both / span).clamp(0.0, 1.0)).sum();
        0.75 * (sum / PAIRS as f32).min(1.0)
    }
}

fn mixed(from: [f32; 3], to: [f32; 3], share: f32) -> [f32; 3] {
    [0, 1, 2].map(|k| from[k] + share * (to[k] - from[k]))
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a byte"
)]
fn byte(v: f32) -> u8 {
    v.round().clamp(0.0, 255.0) as u8
}
