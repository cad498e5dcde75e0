//! Mapping of a scene to the pixels of a panel.

use super::camera::Camera;

#[derive(Debug)]
pub(super) struct Frame {
    pub camera: Camera,
    /// Pixels per unit of picture coordinates.
    pub scale: f64,
    /// Picture coordinates at `middle`.
    pub picture: [f64; 2],
    /// Centre of the area of the scene (pixels).
    pub middle: [f64; 2],
    /// Left, top, right and bottom of the area for labels (pixels).
    pub area: [f64; 4],
    /// Distance from the viewer to the middle of the scene (nm).
    pub distance: f64,
}

impl Frame {
    pub(super) fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.middle[0] + self.scale * (x - self.picture[0]),
            self.middle[1] - self.scale * (y - self.picture[1]),
        ]
    }
}
