//! SVG output of plane shapes. Lengths are in pixels; y points down.

use crate::Colour;
use std::collections::BTreeMap;
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

/// The rim of a cylinder in pixels along its axis: its centre, and the distances from the centre of its point across
/// the axis and of its point on the axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    pub at: f64,
    pub side: f64,
    pub front: f64,
}

impl Rim {
    /// Half the ellipse, to the point across the axis at `to`, by two Bezier curves through the point on the axis at
    /// the side given by a sign.
    fn arc(&self, sign: f64, to: f64) -> String {
        /// Position of the control points of a quarter of a circle.
        const K: f64 = 0.5523;
        let Self { at, side, front } = *self;
        let (side, front) = (side * to.signum(), front * sign);
        let [x0, x1, x2] = [at - side + K * front, at + front - K * side, at + front];
        let [x3, x4, x5] = [at + front + K * side, at + side + K * front, at + side];
        let near = K * to;
        format!(
            "C{x0:.2} {:.2} {x1:.2} {:.2} {x2:.2} 0C{x3:.2} {near:.2} {x4:.2} {to:.2} {x5:.2} {to:.2}",
            -to, -near
        )
    }
}

/// An SVG file under construction. Identifiers have a prefix, so that several files can be part of one page.
#[derive(Debug)]
pub(super) struct Canvas {
    prefix: String,
    size: [f64; 2],
    body: String,
    /// Gradients in use, by name.
    shadings: BTreeMap<String, String>,
}

const BACKGROUND: &str = "#ffffff";
const INK: &str = "#222222";
/// Angles of gradients are rounded to multiples of this (deg).
const SHADING_STEP: f64 = 15.0;
/// Position of the highlight relative to the radius of a sphere, right and down.
const LIGHT: [f64; 2] = [-0.35, -0.45];
/// Opacity of highlights on opaque bodies.
const HIGHLIGHT: f64 = 0.5;

impl Canvas {
    pub(super) fn new(prefix: &str, size: [f64; 2]) -> Self {
        Self {
            prefix: prefix.to_owned(),
            size,
            body: String::new(),
            shadings: BTreeMap::new(),
        }
    }

    fn push(&mut self, text: std::fmt::Arguments<'_>) {
        self.body
            .write_fmt(text)
            .expect("writing to a string cannot fail");
        self.body.push('\n');
    }

    /// Draws an ellipsoid with semi-axes a and b, and the angle of a (deg, clockwise from the horizontal).
    pub(super) fn ball(&mut self, [x, y]: [f64; 2], [a, b]: [f64; 2], angle: f64, paint: Paint) {
        let (fill, edge) = (self.shading(paint, angle, true), edge(paint, b));
        self.push(format_args!(
            "<ellipse cx=\"{x:.1}\" cy=\"{y:.1}\" rx=\"{a:.2}\" ry=\"{b:.2}\" \
             transform=\"rotate({angle:.1} {x:.1} {y:.1})\" {fill} {edge}/>"
        ));
    }

    /// Draws a cylinder of radius r from a point in a direction (deg, clockwise from the horizontal), then its nearer
    /// end.
    pub(super) fn cylinder(
        &mut self,
        ([x, y], angle): ([f64; 2], f64),
        r: f64,
        rims: &[Rim; 2],
        near: usize,
        paint: Paint,
    ) {
        let (fill, edge) = (self.shading(paint, angle, false), edge(paint, r));
        let [upper, lower] = [-r, r];
        let from = rims[0].at - rims[0].side;
        let far = rims[1].at + rims[1].side;
        let body = [
            rims[0].arc(-1.0, lower),
            format!("L{far:.2} {lower:.2}"),
            rims[1].arc(1.0, upper),
        ]
        .concat();
        let rim = &rims[near];
        let start = rim.at - rim.side;
        let end = [rim.arc(1.0, lower), rim.arc(-1.0, upper)].concat();
        let (lighter, opacity) = (paint.fill.lighter(0.35).hex(), paint.opacity);
        self.push(format_args!(
            "<g transform=\"translate({x:.1} {y:.1}) rotate({angle:.2})\" {edge}>\
             <path d=\"M{from:.2} {upper:.2}{body}Z\" {fill}/>\
             <path d=\"M{start:.2} {upper:.2}{end}Z\" fill=\"{lighter}\" fill-opacity=\"{opacity:.2}\"/></g>"
        ));
    }

    /// Returns the attributes of a gradient whose highlight is independent of the rotation of the body.
    fn shading(&mut self, paint: Paint, angle: f64, is_round: bool) -> String {
        let (colour, opacity) = (paint.fill, paint.opacity);
        let angle = (angle / SHADING_STEP).round() * SHADING_STEP;
        let kind = if is_round { "r" } else { "l" };
        let name = format!(
            "{}-{}-{kind}{}",
            self.prefix,
            &colour.hex()[1..],
            angle + 360.0
        );
        let attributes = format!("fill=\"url(#{name})\" fill-opacity=\"{opacity:.2}\"");
        let gradient = || {
            if is_round {
                round(&name, colour, angle)
            } else {
                straight(&name, colour, angle)
            }
        };
        if !self.shadings.contains_key(&name) {
            self.shadings.insert(name.clone(), gradient());
        }
        attributes
    }

    pub(super) fn dot(&mut self, [x, y]: [f64; 2], radius: f64, paint: Paint) {
        let (fill, edge) = (paint.fill.hex(), paint.fill.darker(0.4).hex());
        self.push(format_args!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\" fill=\"{fill}\" \
             fill-opacity=\"{:.2}\" stroke=\"{edge}\" stroke-width=\"0.8\"/>",
            paint.opacity
        ));
    }

    /// Draws a bright area without an edge.
    pub(super) fn highlight(&mut self, corners: &[[f64; 2]], opacity: f64) {
        let opacity = HIGHLIGHT * opacity;
        let points = points(corners);
        self.push(format_args!(
            "<polygon points=\"{points}\" fill=\"#ffffff\" fill-opacity=\"{opacity:.2}\"/>"
        ));
    }

    pub(super) fn polygon(&mut self, corners: &[[f64; 2]], paint: Paint) {
        let points = points(corners);
        let (fill, edge) = (paint.fill.hex(), paint.fill.darker(0.25).hex());
        self.push(format_args!(
            "<polygon points=\"{points}\" fill=\"{fill}\" fill-opacity=\"{opacity:.2}\" \
             stroke=\"{edge}\" stroke-opacity=\"{edge_opacity:.2}\" stroke-width=\"0.8\" \
             stroke-linejoin=\"round\"/>",
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
        let shadings: String = self.shadings.into_values().collect();
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

fn points(corners: &[[f64; 2]]) -> String {
    let points = corners.iter().map(|[x, y]| format!("{x:.1},{y:.1}"));
    points.collect::<Vec<_>>().join(" ")
}

/// Returns the attributes of the edge of a body, which is thinner for small bodies.
fn edge(paint: Paint, radius: f64) -> String {
    let (colour, width) = (paint.fill.darker(0.45).hex(), (0.2 * radius).min(0.7));
    format!("stroke=\"{colour}\" stroke-width=\"{width:.2}\"")
}

/// Returns the position of the light relative to the radius of a body at an angle, along its axis and across.
fn light(angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.to_radians().sin_cos();
    [
        LIGHT[0] * cos + LIGHT[1] * sin,
        LIGHT[1] * cos - LIGHT[0] * sin,
    ]
    .map(|v| 0.5 + 0.5 * v)
}

fn stops(stops: [(f64, Colour); 3]) -> String {
    let stops = stops.map(|(offset, colour)| {
        let colour = colour.hex();
        format!("<stop offset=\"{offset:.2}\" stop-color=\"{colour}\"/>")
    });
    stops.concat()
}

fn round(name: &str, colour: Colour, angle: f64) -> String {
    let [x, y] = light(angle);
    let [bright, dark] = [colour.lighter(0.65), colour.darker(0.3)];
    let stops = stops([(0.0, bright), (0.5, colour.lighter(0.12)), (1.0, dark)]);
    format!("<radialGradient id=\"{name}\" fx=\"{x:.3}\" fy=\"{y:.3}\">{stops}</radialGradient>\n")
}

fn straight(name: &str, colour: Colour, angle: f64) -> String {
    let [_, y] = light(angle);
    let side = |at: f64| (at, colour.darker(0.28 * ((at - y).abs() / 0.75).min(1.0)));
    let stops = stops([side(0.0), (y, colour.lighter(0.42)), side(1.0)]);
    format!("<linearGradient id=\"{name}\" x2=\"0\" y2=\"1\">{stops}</linearGradient>\n")
}
