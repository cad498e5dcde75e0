//! A view of a scene, fitted into a rectangle and drawn back to front.

use super::Vector3;
use super::camera::{Camera, View};
use super::frame::Frame;
use super::labels::{self, LETTERS, Label};
use super::solid::Item;
use super::svg::{Align, Canvas, Stroke};
use crate::Colour;

/// A view of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Title.
    pub title: String,
    /// Left, top, width and height in pixels.
    pub place: [f64; 4],
    /// View direction.
    pub view: View,
    /// Solids, in any order.
    pub items: Vec<Item>,
    /// Texts at points of the scene.
    pub labels: Vec<Label>,
    /// Length of the scale bar (nm).
    pub bar_nm: f64,
    /// Margins for labels in pixels: left, top, right, bottom.
    pub room: [f64; 4],
}

/// Distance of the viewer relative to the extent of the scene, a compromise between depth and accurate lengths.
const DISTANCE: f64 = 3.5;
const TITLE: f64 = 26.0;
const FOOT: f64 = 46.0;
const AXIS: f64 = 24.0;
/// Axes that appear shorter than this fraction are omitted.
const SHORT: f64 = 0.38;
const GREY: Colour = Colour([90, 90, 90]);

impl Panel {
    pub(super) fn paint(&self, canvas: &mut Canvas) {
        let frame = self.frame();
        let mut order: Vec<(f64, &Item)> = self
            .items
            .iter()
            .map(|item| (item.depth(&frame.camera), item))
            .collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, item) in order {
            item.solid.paint(item, &frame, canvas);
        }
        labels::paint(&self.labels, &frame, canvas);
        let [left, top, ..] = self.place;
        canvas.text(
            [left + 8.0, top + 18.0],
            16.0,
            Align::Start,
            true,
            &self.title,
        );
        self.paint_bar(&frame, canvas);
        self.paint_axes(&frame, canvas);
    }

    fn frame(&self) -> Frame {
        let middles: Vec<Vector3> = self.items.iter().map(|i| i.solid.middle()).collect();
        let target = middles.iter().sum::<Vector3>() / middles.len().max(1) as f64;
        let extent = middles
            .iter()
            .map(|p| (p - target).norm())
            .fold(1.0, f64::max);
        let distance = DISTANCE * 2.0 * extent;
        let camera = Camera::new(&self.view, target, distance);
        let places = || {
            self.items
                .iter()
                .flat_map(|item| item.solid.extent(&camera))
        };
        let low = |k: usize| places().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let high = |k: usize| places().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        let size = [0, 1].map(|k| (high(k) - low(k)).max(1e-9));
        let [left, top, width, height] = self.place;
        let [room_left, room_top, room_right, room_bottom] = self.room;
        let (from, to) = (left + room_left, left + width - room_right);
        let (upper, lower) = (top + TITLE + room_top, top + height - FOOT - room_bottom);
        Frame {
            camera,
            scale: ((to - from) / size[0]).min((lower - upper) / size[1]),
            picture: [0, 1].map(|k| 0.5 * (low(k) + high(k))),
            middle: [0.5 * (from + to), 0.5 * (upper + lower)],
            area: [
                left + 4.0,
                top + TITLE,
                left + width - 4.0,
                top + height - FOOT,
            ],
            distance,
        }
    }

    /// Draws the scale bar, which applies to transverse lengths in the middle of the scene.
    fn paint_bar(&self, frame: &Frame, canvas: &mut Canvas) {
        let length = frame.scale * self.bar_nm / frame.distance;
        let [left, top, _, height] = self.place;
        let (from, y) = (left + 16.0, top + height - 14.0);
        let stroke = Stroke::solid(GREY, 3.0);
        canvas.line([[from, y], [from + length, y]], stroke, 1.0);
        let text = format!("{} nm", self.bar_nm);
        canvas.text(
            [from + 0.5 * length, y - 8.0],
            LETTERS,
            Align::Middle,
            false,
            &text,
        );
    }

    fn paint_axes(&self, frame: &Frame, canvas: &mut Canvas) {
        let [left, top, width, height] = self.place;
        let origin = [left + width - 48.0, top + height - 32.0];
        let axes = [
            (Vector3::x(), "x"),
            (Vector3::y(), "y"),
            (Vector3::z(), "z"),
        ];
        for (axis, name) in axes {
            let seen = frame.camera.turn(axis);
            let across = seen.x.hypot(seen.y);
            if across < SHORT {
                continue;
            }
            let at = |length: f64| [origin[0] + length * seen.x, origin[1] - length * seen.y];
            canvas.arrow([origin, at(AXIS)], Stroke::solid(GREY, 1.6));
            let beyond = AXIS + 9.0 / across;
            let [x, y] = at(beyond);
            canvas.text([x, y + 4.0], 12.0, Align::Middle, false, name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene3d::Matrix3;
    use crate::scene3d::Solid;

    fn ball(x: f64, colour: [u8; 3]) -> Item {
        let solid = Solid::Ellipsoid {
            centre: Vector3::new(x, 0.0, 0.0),
            semi_axes: Matrix3::identity(),
        };
        Item::new(solid, Colour(colour))
    }

    /// The nearer sphere is drawn last for any order of the list, and both are inside the panel.
    #[test]
    fn what_is_nearer_is_painted_later() {
        let (near, far) = (ball(5.0, [1, 0, 0]), ball(-5.0, [0, 0, 1]));
        for items in [vec![near.clone(), far.clone()], vec![far, near]] {
            let panel = Panel {
                title: String::new(),
                place: [0.0, 0.0, 300.0, 200.0],
                view: View {
                    towards_viewer: Vector3::new(1.0, 0.1, 0.0),
                    up: Vector3::z(),
                },
                items,
                labels: Vec::new(),
                bar_nm: 1.0,
                room: [0.0; 4],
            };
            let mut canvas = Canvas::new("test", [300.0, 200.0]);
            panel.paint(&mut canvas);
            let text = canvas.finish();
            let place = |name: &str| text.find(&format!("fill=\"url(#test-{name}")).unwrap();
            assert!(place("010000") > place("000001"));
            let frame = panel.frame();
            for item in &panel.items {
                for [x, y] in item
                    .solid
                    .extent(&frame.camera)
                    .into_iter()
                    .map(|p| frame.pixel(p))
                {
                    // Round-off of the fit, which touches two edges.
                    assert!((-1e-9..=300.0 + 1e-9).contains(&x) && (-1e-9..=200.0).contains(&y));
                }
            }
        }
    }
}
