//! Bodies in words, for messages.

use super::{Assembly, BodyKind};
use actin_integrate::Body;

impl Assembly {
    /// What a body is and where it stands at rest, such as `the node at s = 80.79 nm`.
    pub fn describe(&self, body: Body) -> String {
        let (kind, s_nm) = match body {
            Body::Point(i) => (self.points[i].kind, self.points[i].s_nm),
            Body::Frame(i) => (self.frames[i].kind, self.frames[i].s_nm),
        };
        let name = match kind {
            BodyKind::Monomer => "monomer",
            BodyKind::Node => "node",
            BodyKind::Segment => "segment",
            BodyKind::Junction => "junction frame",
            BodyKind::Wall => "wall",
        };
        format!("the {name} at s = {s_nm:.2} nm")
    }

    /// What linker `i` holds on to, such as `the segment at s = 75.00 nm`.
    pub fn linked(&self, i: usize) -> String {
        self.describe(Body::Frame(self.linkers[i].site().frame()))
    }
}
