//! How the scene of a panel becomes pixels.

use super::camera::Camera;

/// How a panel's scene becomes pixels.
#[derive(Debug)]
pub(super) struct Frame {
    pub camera: Camera,
    /// Pixels per unit of the picture.
    pub scale: f64,
    /// What of the picture stands at `middle`.
    pub picture: [f64; 2],
    /// Pixels of the middle of the room for the scene.
    pub middle: [f64; 2],
    /// Left, top, right, bottom of the area for labels.
    pub area: [f64; 4],
    /// Distance from the eye to the middle of the scene (nm).
    pub distance: f64,
}

impl Frame {
    /// Pixels of a place in the picture.
    pub(super) fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.middle[0] + self.scale * (x - self.picture[0]),
            self.middle[1] - self.scale * (y - self.picture[1]),
        ]
    }
}
