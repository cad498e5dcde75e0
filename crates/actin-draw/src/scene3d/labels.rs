//! Labels at points of the scene, placed inside the panel without overlap.

use super::Vector3;
use super::camera::Camera;
use super::svg::{Align, Canvas, Stroke, text_width};
use crate::Colour;

/// A text at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Labelled point (nm, lab frame).
    pub at: Vector3,
    /// Text.
    pub text: String,
    /// Offset of the text in pixels, right and down; the text is aligned away from the point.
    pub offset: [f64; 2],
}

pub(super) const LETTERS: f64 = 14.0;
/// Distance in pixels above which a label is connected to its point by a line.
const LEADER: f64 = 18.0;
const LEADER_COLOUR: Colour = Colour([120, 120, 120]);

type Area = [f64; 4];

pub(super) fn paint(labels: &[Label], camera: &Camera, panel: Area, canvas: &mut Canvas) {
    let mut taken: Vec<Area> = Vec::new();
    for label in labels {
        let named = camera.pixel(label.at);
        let area = free_area(label, named, panel, &taken);
        taken.push(area);
        let [left, top, right, bottom] = area;
        if label.offset[0].hypot(label.offset[1]) > LEADER {
            let near = [named[0].clamp(left, right), named[1].clamp(top, bottom)];
            let stroke = Stroke::solid(LEADER_COLOUR, 0.9);
            canvas.line([named, near], stroke, 1.0);
        }
        let baseline = bottom - 0.3 * LETTERS;
        canvas.text(
            [0.5 * (left + right), baseline],
            LETTERS,
            Align::Middle,
            false,
            &label.text,
        );
    }
}

/// Returns the area of a label: at its offset, moved into the panel, then moved down until free.
fn free_area(label: &Label, named: [f64; 2], panel: Area, taken: &[Area]) -> Area {
    let (width, height) = (text_width(&label.text, LETTERS), 1.25 * LETTERS);
    let [right, down] = label.offset;
    let share = |v: f64| {
        if v > 1.0 {
            0.0
        } else if v < -1.0 {
            1.0
        } else {
            0.5
        }
    };
    let left = named[0] + right - share(right) * width;
    let left = left.min(panel[2] - width).max(panel[0]);
    let mut top = named[1] + down - 0.5 * height;
    top = top.min(panel[3] - height).max(panel[1]);
    let meets = |top: f64| {
        taken.iter().find(|other| {
            left < other[2] && other[0] < left + width && top < other[3] && other[1] < top + height
        })
    };
    while let Some(other) = meets(top) {
        top = other[3] + 1.0;
    }
    [left, top, left + width, top + height]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_clear_of_edges_and_of_one_another() {
        let label = Label {
            at: Vector3::zeros(),
            text: "a name".into(),
            offset: [10.0, 0.0],
        };
        let panel = [0.0, 0.0, 100.0, 200.0];
        let mut taken: Vec<Area> = Vec::new();
        for _ in 0..3 {
            taken.push(free_area(&label, [95.0, 5.0], panel, &taken));
        }
        for (i, area) in taken.iter().enumerate() {
            assert!(area[0] >= panel[0] && area[2] <= panel[2] && area[1] >= panel[1]);
            assert!(taken[..i].iter().all(|other| area[1] >= other[3]));
        }
    }
}
