//! A view of a scene, fitted into a rectangle and drawn back to front.

use super::Vector3;
use super::camera::Camera;
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
    /// Camera, fitted into [`Panel::area`].
    pub camera: Camera,
    /// Solids, in any order.
    pub items: Vec<Item>,
    /// Texts at points of the scene.
    pub labels: Vec<Label>,
    /// Length of the scale bar (nm).
    pub bar_nm: f64,
}

/// Smallest width and height of the area of solids, relative to the panel.
const LEAST: f64 = 0.3;
const TITLE: f64 = 26.0;
const FOOT: f64 = 46.0;
const AXIS: f64 = 24.0;
/// Axes that appear shorter than this fraction are omitted.
const SHORT: f64 = 0.38;
const GREY: Colour = Colour([90, 90, 90]);

impl Panel {
    /// Returns the area of the solids in a panel at `place`, with margins for labels: left, top, right, bottom.
    pub fn area([left, top, width, height]: [f64; 4], room: [f64; 4]) -> [f64; 4] {
        let (x, across) = between(left, width, room[0], room[2]);
        let (y, down) = between(top, height, TITLE + room[1], FOOT + room[3]);
        [x, y, across, down]
    }

    pub(super) fn paint(&self, canvas: &mut Canvas) {
        let camera = &self.camera;
        let mut order: Vec<(f64, &Item)> =
            self.items.iter().map(|i| (i.depth(camera), i)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, item) in order {
            item.paint(camera, canvas);
        }
        let [left, top, width, height] = self.place;
        let area = [
            left + 4.0,
            top + TITLE,
            left + width - 4.0,
            top + height - FOOT,
        ];
        labels::paint(&self.labels, camera, area, canvas);
        canvas.text(
            [left + 8.0, top + 18.0],
            16.0,
            Align::Start,
            true,
            &self.title,
        );
        self.paint_bar(canvas);
        self.paint_axes(canvas);
    }

    fn paint_bar(&self, canvas: &mut Canvas) {
        let length = self.camera.per_nm() * self.bar_nm;
        let [left, top, _, height] = self.place;
        let (from, y) = (left + 16.0, top + height - 14.0);
        let stroke = Stroke::solid(GREY, 3.0);
        canvas.line([[from, y], [from + length, y]], stroke, 1.0);
        let text = match self.bar_nm {
            length if length >= 1000.0 => format!("{} µm", length / 1000.0),
            length => format!("{length} nm"),
        };
        canvas.text(
            [from + 0.5 * length, y - 8.0],
            LETTERS,
            Align::Middle,
            false,
            &text,
        );
    }

    fn paint_axes(&self, canvas: &mut Canvas) {
        let [left, top, width, height] = self.place;
        let origin = [left + width - 48.0, top + height - 32.0];
        let axes = [
            (Vector3::x(), "x"),
            (Vector3::y(), "y"),
            (Vector3::z(), "z"),
        ];
        for (axis, name) in axes {
            let seen = self.camera.turn(axis);
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

/// Returns start and length between margins, or the middle if the margins leave less than a fraction of the length.
fn between(start: f64, length: f64, before: f64, after: f64) -> (f64, f64) {
    let least = LEAST * length;
    match length - before - after {
        free if free < least => (start + 0.5 * (length - least), least),
        free => (start + before, free),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene3d::{Attitude, Matrix3, Solid};

    fn ball(x: f64, colour: [u8; 3]) -> Item {
        let solid = Solid::Ellipsoid {
            centre: Vector3::new(x, 0.0, 0.0),
            semi_axes: Matrix3::identity(),
        };
        Item::new(solid, Colour(colour))
    }

    /// The nearer sphere is drawn last for any order of the list, and the farther one is lighter.
    #[test]
    fn what_is_nearer_is_painted_later() {
        let (near, far) = (ball(5.0, [1, 0, 0]), ball(-5.0, [0, 0, 1]));
        for items in [vec![near.clone(), far.clone()], vec![far, near]] {
            let place = [0.0, 0.0, 300.0, 200.0];
            let attitude = Attitude {
                towards: [1.0, 0.1, 0.0],
                up: [0.0, 0.0, 1.0],
            };
            let balls = items.iter().flat_map(|item| item.solid.balls());
            let panel = Panel {
                title: String::new(),
                place,
                camera: Camera::fitted(attitude, balls, Panel::area(place, [0.0; 4])),
                items,
                labels: Vec::new(),
                bar_nm: 1.0,
            };
            let mut canvas = Canvas::new("test", [300.0, 200.0]);
            panel.paint(&mut canvas);
            let text = canvas.finish();
            let last = &text[text.rfind("<ellipse").unwrap()..];
            assert!(last.contains("url(#test-010000"));
            assert!(!text.contains("url(#test-000001"));
        }
    }
}
