//! SVG output of plane shapes. Lengths are in pixels; y points down.

use crate::Colour;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Style of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Colour.
    pub colour: Colour,
    /// Width in pixels.
    pub width: f64,
    /// True for a dashed line.
    pub dashed: bool,
}

impl Stroke {
    /// Creates a solid line.
    pub fn solid(colour: Colour, width: f64) -> Self {
        Self {
            colour,
            width,
            dashed: false,
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Paint {
    pub fill: Colour,
    pub opacity: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Align {
    Start,
    Middle,
}

/// An SVG file under construction. Identifiers have a prefix, so that several files can be part of one page.
#[derive(Debug)]
pub(super) struct Canvas {
    prefix: String,
    size: [f64; 2],
    body: String,
    /// Colours and angles (deg) of the gradients in use.
    shadings: BTreeSet<(Colour, i16)>,
}

const BACKGROUND: &str = "#fcfcfa";
const INK: &str = "#222222";
/// Angles of gradients are rounded to multiples of this (deg).
const SHADING_STEP: f64 = 15.0;
/// Position of the highlight relative to the radius of a sphere, right and down.
const LIGHT: [f64; 2] = [-0.35, -0.45];

impl Canvas {
    pub(super) fn new(prefix: &str, size: [f64; 2]) -> Self {
        Self {
            prefix: prefix.to_owned(),
            size,
            body: String::new(),
            shadings: BTreeSet::new(),
        }
    }

    fn push(&mut self, text: std::fmt::Arguments<'_>) {
        self.body
            .write_fmt(text)
            .expect("writing to a string cannot fail");
        self.body.push('\n');
    }

    pub(super) fn ball(&mut self, [x, y]: [f64; 2], [a, b]: [f64; 2], angle: f64, paint: Paint) {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "a turn between -180 and 180 deg"
        )]
        let turn = ((angle / SHADING_STEP).round() * SHADING_STEP) as i16;
        self.shadings.insert((paint.fill, turn));
        let fill = self.shading_name(paint.fill, turn);
        let edge = paint.fill.darker(0.45).hex();
        self.push(format_args!(
            "<ellipse cx=\"{x:.1}\" cy=\"{y:.1}\" rx=\"{a:.2}\" ry=\"{b:.2}\" \
             transform=\"rotate({angle:.1} {x:.1} {y:.1})\" fill=\"url(#{fill})\" \
             fill-opacity=\"{:.2}\" stroke=\"{edge}\" stroke-width=\"0.7\"/>",
            paint.opacity
        ));
    }

    fn shading_name(&self, colour: Colour, turn: i16) -> String {
        let [red, green, blue] = colour.0;
        format!(
            "{}-{red:02x}{green:02x}{blue:02x}-{}",
            self.prefix,
            turn + 360
        )
    }

    pub(super) fn dot(&mut self, [x, y]: [f64; 2], radius: f64, paint: Paint) {
        let (fill, edge) = (paint.fill.hex(), paint.fill.darker(0.4).hex());
        self.push(format_args!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\" fill=\"{fill}\" \
             fill-opacity=\"{:.2}\" stroke=\"{edge}\" stroke-width=\"0.8\"/>",
            paint.opacity
        ));
    }

    pub(super) fn polygon(&mut self, corners: &[[f64; 2]], paint: Paint) {
        let corners: Vec<String> = corners
            .iter()
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        let (fill, edge) = (paint.fill.hex(), paint.fill.darker(0.25).hex());
        self.push(format_args!(
            "<polygon points=\"{}\" fill=\"{fill}\" fill-opacity=\"{opacity:.2}\" \
             stroke=\"{edge}\" stroke-opacity=\"{edge_opacity:.2}\" stroke-width=\"0.8\" \
             stroke-linejoin=\"round\"/>",
            corners.join(" "),
            opacity = paint.opacity,
            edge_opacity = (paint.opacity + 0.2).min(1.0),
        ));
    }

    pub(super) fn line(&mut self, ends: [[f64; 2]; 2], stroke: Stroke, opacity: f64) {
        let [[x1, y1], [x2, y2]] = ends;
        let dashes = if stroke.dashed {
            " stroke-dasharray=\"5 3\""
        } else {
            ""
        };
        self.push(format_args!(
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{}\" \
             stroke-width=\"{:.1}\" stroke-opacity=\"{opacity:.2}\" stroke-linecap=\"round\"{dashes}/>",
            stroke.colour.hex(),
            stroke.width,
        ));
    }

    pub(super) fn arrow(&mut self, [from, to]: [[f64; 2]; 2], stroke: Stroke) {
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]).max(1e-9);
        let unit = along.map(|v| v / length);
        let head = (3.6 * stroke.width).min(length);
        let neck = [to[0] - head * unit[0], to[1] - head * unit[1]];
        let half = 0.45 * head;
        let side = |s: f64| [neck[0] - s * half * unit[1], neck[1] + s * half * unit[0]];
        self.line([from, neck], stroke, 1.0);
        let paint = Paint {
            fill: stroke.colour,
            opacity: 1.0,
        };
        self.polygon(&[side(1.0), to, side(-1.0)], paint);
    }

    pub(super) fn text(
        &mut self,
        [x, y]: [f64; 2],
        size: f64,
        align: Align,
        bold: bool,
        text: &str,
    ) {
        let anchor = match align {
            Align::Start => "start",
            Align::Middle => "middle",
        };
        let weight = if bold { " font-weight=\"600\"" } else { "" };
        let text = text.replace('&', "&amp;").replace('<', "&lt;");
        self.push(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" \
             fill=\"{INK}\" stroke=\"{BACKGROUND}\" stroke-width=\"3.5\" stroke-linejoin=\"round\" \
             paint-order=\"stroke\"{weight}>{text}</text>"
        ));
    }

    pub(super) fn finish(self) -> String {
        let [width, height] = self.size;
        let shadings: String = self
            .shadings
            .iter()
            .map(|&(colour, turn)| shading(&self.shading_name(colour, turn), colour, turn))
            .collect();
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\">\n<defs>\n{shadings}\
             </defs>\n<rect width=\"{width}\" height=\"{height}\" fill=\"{BACKGROUND}\"/>\n{}</svg>\n",
            self.body
        )
    }
}

/// Estimates the width of a text in pixels for a wide sans-serif font.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let width = |letter: char| match letter {
        'm' | 'w' | 'M' | 'W' | '_' => 0.95,
        'i' | 'j' | 'l' | 't' | 'f' | 'r' | ' ' | ',' | '.' | '\'' | '(' | ')' => 0.38,
        _ => 0.63,
    };
    size * text.chars().map(width).sum::<f64>()
}

/// Returns a radial gradient whose highlight is independent of the rotation of the ellipse.
fn shading(name: &str, colour: Colour, turn: i16) -> String {
    let (sin, cos) = f64::from(turn).to_radians().sin_cos();
    let x = 0.5 + 0.5 * (LIGHT[0] * cos + LIGHT[1] * sin);
    let y = 0.5 + 0.5 * (LIGHT[1] * cos - LIGHT[0] * sin);
    format!(
        "<radialGradient id=\"{name}\" fx=\"{x:.3}\" fy=\"{y:.3}\"><stop offset=\"0\" \
         stop-color=\"{}\"/><stop offset=\"0.5\" stop-color=\"{}\"/><stop offset=\"1\" \
         stop-color=\"{}\"/></radialGradient>\n",
        colour.lighter(0.65).hex(),
        colour.lighter(0.12).hex(),
        colour.darker(0.3).hex(),
    )
}
