//! Names of bodies and parts in messages and files.

use super::{Assembly, BodyKind, FrameInfo, Part, PointInfo};
use crate::scene::WallName;
use actin_coupling::LinkerEnd;
use actin_integrate::Body;

impl Assembly {
    /// Describes a body and its arc length at rest, such as `the node at s = 80.79 nm`. The
    /// filament is named if the scene has several.
    pub fn describe(&self, body: Body) -> String {
        let (kind, s_nm, filament) = match body {
            Body::Point(i) => {
                let PointInfo { kind, s_nm, .. } = self.points[i];
                (kind, s_nm, self.filament_of_point(i))
            }
            Body::Frame(i) => {
                let FrameInfo { kind, s_nm } = self.frames[i];
                (kind, s_nm, self.filament_of_frame(i))
            }
        };
        let name = match kind {
            BodyKind::Junction => "junction frame",
            BodyKind::Joint => "cross-section between rods",
            other => other.name(),
        };
        match self.filaments.len() {
            1 => format!("the {name} at s = {s_nm:.2} nm"),
            _ => format!("the {name} at s = {s_nm:.2} nm of filament {filament}"),
        }
    }

    /// Describes the body at the first end of linker `i`, such as `the segment at s = 75.00 nm`.
    pub fn linked(&self, i: usize) -> String {
        self.describe(Body::Frame(self.linkers[i].site().frame()))
    }

    /// Describes the body at the second end of linker `i`; `None` for an anchor.
    pub fn linked_to(&self, i: usize) -> Option<String> {
        match self.linkers[i].end() {
            LinkerEnd::Anchor(_) => None,
            LinkerEnd::Site(site) => Some(self.describe(Body::Frame(site.frame()))),
        }
    }

    /// Returns the name of a part in files: `section_0`, or `filament_1_section_0` for filaments
    /// after the first.
    pub fn name_of(&self, part: Part) -> String {
        let within = |section: usize| {
            let (filament, i) = self.place_of_section(section);
            let prefix = match filament {
                0 => String::new(),
                _ => format!("filament_{filament}_"),
            };
            (prefix, i)
        };
        match part {
            Part::Section(section) => {
                let (prefix, i) = within(section);
                format!("{prefix}section_{i}")
            }
            Part::Junction(section) => {
                let (prefix, i) = within(section);
                format!("{prefix}junction_{i}_{}", i + 1)
            }
            Part::Load(i) => format!("load_{i}"),
            Part::Linker(i) => format!("linker_{i}"),
            Part::Clamp(i) => format!("clamp_{i}"),
            Part::Contacts => "contacts".to_owned(),
            Part::Wall(WallName { shape, index }) => format!("{shape}_{index}"),
        }
    }
}
