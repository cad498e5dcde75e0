//! Finished pictures, with lines and text.

use super::letters;
use std::io::{self, Write};

/// An RGB picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    size: [usize; 2],
    pixels: Vec<u8>,
}

impl Picture {
    pub(super) fn new(size: [usize; 2], pixels: Vec<u8>) -> Self {
        Self { size, pixels }
    }

    /// Returns the colour of a pixel, counted from the upper left corner.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    pub fn pixel(&self, column: usize, row: usize) -> [u8; 3] {
        let at = 3 * (row * self.size[0] + column);
        [self.pixels[at], self.pixels[at + 1], self.pixels[at + 2]]
    }

    /// Draws a polyline (pixels) with a width in pixels and round ends.
    pub fn stroke(&mut self, points: &[[f64; 2]], width: f64, colour: [u8; 3]) {
        for pair in points.windows(2) {
            self.segment([pair[0], pair[1]], width, colour);
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "casts to integers saturate, and are clamped to the picture"
    )]
    fn segment(&mut self, [a, b]: [[f64; 2]; 2], width: f64, colour: [u8; 3]) {
        let reach = 0.5 * width + 1.0;
        let range = |k: usize| {
            let from = (a[k].min(b[k]) - reach).max(0.0) as usize;
            from..((a[k].max(b[k]) + reach).max(0.0) as usize + 1).min(self.size[k])
        };
        let (columns, rows) = (range(0), range(1));
        let d = [b[0] - a[0], b[1] - a[1]];
        let squared = (d[0] * d[0] + d[1] * d[1]).max(1e-12);
        for row in rows {
            for column in columns.clone() {
                let p = [column as f64 + 0.5 - a[0], row as f64 + 0.5 - a[1]];
                let t = ((p[0] * d[0] + p[1] * d[1]) / squared).clamp(0.0, 1.0);
                let distance = (p[0] - t * d[0]).hypot(p[1] - t * d[1]);
                let share = (0.5 * width + 0.5 - distance).clamp(0.0, 1.0);
                let at = 3 * (row * self.size[0] + column);
                for (pixel, ink) in self.pixels[at..at + 3].iter_mut().zip(colour) {
                    let mixed = f64::from(*pixel) + share * (f64::from(ink) - f64::from(*pixel));
                    *pixel = mixed.round() as u8;
                }
            }
        }
    }

    /// Writes text from the start of its base line (pixels), with a letter height in pixels. Returns the width of the
    /// text. Unknown characters are skipped.
    pub fn text(&mut self, [x, y]: [f64; 2], height: f64, colour: [u8; 3], text: &str) -> f64 {
        let unit = height / letters::HEIGHT;
        let mut at = x;
        for letter in text.chars() {
            for line in letters::strokes(letter) {
                let points: Vec<[f64; 2]> = line
                    .iter()
                    .map(|[u, v]| [at + unit * u, y - unit * v])
                    .collect();
                self.stroke(&points, 0.13 * height, colour);
            }
            at += unit * letters::advance(letter);
        }
        at - x
    }

    /// Writes a PNG file.
    ///
    /// # Errors
    /// If `out` returns an error.
    pub fn write_png(&self, out: impl Write) -> io::Result<()> {
        let side = |n: usize| u32::try_from(n).map_err(io::Error::other);
        let mut encoder = png::Encoder::new(out, side(self.size[0])?, side(self.size[1])?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(io::Error::other)?;
        writer
            .write_image_data(&self.pixels)
            .map_err(io::Error::other)?;
        writer.finish().map_err(io::Error::other)
    }
}
