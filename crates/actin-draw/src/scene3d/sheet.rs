//! A picture with panels and a legend.

use super::panel::Panel;
use super::svg::{Align, Canvas, Paint, Stroke, text_width};
use crate::Colour;

/// Symbol of a legend entry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Key {
    /// A shaded ellipsoid.
    Ball(Colour),
    /// A disc.
    Dot(Colour),
    /// A line.
    Line(Stroke),
    /// An arrow.
    Arrow(Stroke),
    /// A filled rectangle with an opacity.
    Area(Colour, f64),
}

/// A picture with panels and a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Prefix of identifiers in the file, unique among the pictures of a page.
    pub prefix: &'static str,
    /// Width in pixels.
    pub width: f64,
    /// Height without the legend, in pixels.
    pub height: f64,
    /// Panels, each in its own rectangle.
    pub panels: Vec<Panel>,
    /// Entries of the legend, below the panels.
    pub legend: Vec<(Key, String)>,
}

const LETTERS: f64 = 14.0;
const ROW: f64 = 26.0;
const KEY: f64 = 28.0;
const GAP: f64 = 22.0;
const MARGIN: f64 = 16.0;

impl Sheet {
    /// Returns the picture as SVG.
    pub fn svg(&self) -> String {
        let places = self.legend_places();
        let legend = places.last().map_or(0.0, |[_, y]| y + ROW + MARGIN);
        let size = [self.width, self.height + legend];
        let mut canvas = Canvas::new(self.prefix, size);
        for panel in &self.panels {
            panel.paint(&mut canvas);
        }
        for ((key, text), [x, y]) in self.legend.iter().zip(places) {
            let y = self.height + y + 0.5 * ROW;
            key.paint([x, y], &mut canvas);
            canvas.text([x + KEY + 6.0, y + 5.0], LETTERS, Align::Start, false, text);
        }
        canvas.finish()
    }

    fn legend_places(&self) -> Vec<[f64; 2]> {
        let (mut x, mut y) = (MARGIN, 0.0);
        let entries = self.legend.iter();
        entries
            .map(|(_, text)| {
                let width = KEY + 6.0 + text_width(text, LETTERS);
                if x > MARGIN && x + width > self.width - MARGIN {
                    (x, y) = (MARGIN, y + ROW);
                }
                let place = [x, y];
                x += width + GAP;
                place
            })
            .collect()
    }
}

impl Key {
    fn paint(self, [x, y]: [f64; 2], canvas: &mut Canvas) {
        let ends = [[x, y], [x + KEY, y]];
        let middle = [x + 0.5 * KEY, y];
        let opaque = |fill| Paint { fill, opacity: 1.0 };
        match self {
            Self::Ball(colour) => canvas.ball(middle, [11.0, 8.0], 0.0, opaque(colour)),
            Self::Dot(colour) => canvas.dot(middle, 4.5, opaque(colour)),
            Self::Line(stroke) => canvas.line(ends, stroke, 1.0),
            Self::Arrow(stroke) => canvas.arrow(ends, stroke),
            Self::Area(fill, opacity) => {
                let (top, bottom) = (y - 7.0, y + 7.0);
                let corners = [[x, top], [x + KEY, top], [x + KEY, bottom], [x, bottom]];
                canvas.polygon(&corners, Paint { fill, opacity });
            }
        }
    }
}
