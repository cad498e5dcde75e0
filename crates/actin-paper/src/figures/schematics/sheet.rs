//! Sheets of `data/schematics.ron`: panels of drawn scenes, with a legend.

use super::annotations;
use super::style::LegendPart;
use crate::palette;
use actin_draw::scene3d::{self, Camera, Item, Label};
use actin_sim::Solution;
use actin_view::{Attitude, Drawing, bodies};
use serde::Deserialize;
use std::sync::LazyLock;

#[derive(Debug, Deserialize)]
struct Schematics {
    sheets: Vec<Sheet>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Sheet {
    id: String,
    /// Files in `scenarios`, without extension.
    pub scenes: Vec<String>,
    /// Width and height in pixels.
    size: [f64; 2],
    pub panels: Vec<Panel>,
    legend: Vec<LegendPart>,
    pub caption: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct Panel {
    title: String,
    /// Index of the scene.
    scene: usize,
    /// Left, top, width and height in pixels.
    place: [f64; 4],
    margins: [f64; 4],
    /// Drawn range of arc length (nm); all if `None`.
    #[serde(default)]
    range_nm: Option<[f64; 2]>,
    towards: [f64; 3],
    up: [f64; 3],
    bar_nm: f64,
    /// Layers with their sizes.
    layers: Vec<(Layer, f64)>,
    #[serde(default)]
    labels: Labels,
}

#[derive(Clone, Copy, Debug, Deserialize)]
enum Layer {
    Clamps,
    Monomers,
    Bonds,
    Rods,
    SegmentFrames,
    JunctionBonds,
    /// Frames of junction bonds.
    BondFrames,
    Forces,
    ImposedMotions,
    Linkers,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
enum Labels {
    #[default]
    None,
    /// Position along an arrow (nm/pN), and offset (pixels).
    Forces(f64, [f64; 2]),
    /// Monomers, frames and node of a junction.
    Junction,
}

/// Offsets (pixels right, down) of the labels of monomer and frame of each junction bond.
const BOND_OFFSETS: [[[f64; 2]; 2]; 2] = [
    [[-100.0, -120.0], [-20.0, -155.0]],
    [[-124.0, 120.0], [-20.0, 155.0]],
];
const NODE_OFFSET: [f64; 2] = [60.0, 140.0];

static SHEETS: LazyLock<Schematics> = LazyLock::new(|| {
    actin_sim::read_ron(include_str!("../../../data/schematics.ron"), "Schematics")
        .expect("`data/schematics.ron` is well formed")
});

impl Sheet {
    pub(super) fn of(id: &str) -> Result<&'static Self, String> {
        let found = SHEETS.sheets.iter().find(|sheet| sheet.id == id);
        found.ok_or_else(|| format!("`data/schematics.ron` has no sheet {id}"))
    }

    pub(super) fn svg(&self, prefix: &'static str, solved: &[Solution]) -> String {
        let [width, height] = self.size;
        let sheet = scene3d::Sheet {
            prefix,
            width,
            height,
            panels: self.panels.iter().map(|p| p.draw(solved)).collect(),
            legend: self.legend.iter().flat_map(|part| part.entries()).collect(),
        };
        sheet.svg()
    }
}

impl Panel {
    pub(super) fn drawing<'a>(&self, solved: &'a [Solution]) -> Drawing<'a> {
        let solved = &solved[self.scene];
        let whole = Drawing::new(&solved.assembly, solved.state(), palette::chosen());
        let range_nm = self.range_nm.unwrap_or(whole.range_nm);
        Drawing { range_nm, ..whole }
    }

    fn draw(&self, solved: &[Solution]) -> scene3d::Panel {
        let drawn = self.drawing(solved);
        let layers = self.layers.iter();
        let items: Vec<Item> = layers
            .flat_map(|(l, size)| l.items(&drawn, *size))
            .collect();
        let attitude = Attitude {
            towards: self.towards,
            up: self.up,
        };
        let balls = items.iter().flat_map(|item| item.solid.balls());
        let area = scene3d::Panel::area(self.place, self.margins);
        scene3d::Panel {
            title: self.title.clone(),
            place: self.place,
            camera: Camera::fitted(attitude, balls, area),
            items,
            labels: self.labels.of(&drawn),
            bar_nm: self.bar_nm,
        }
    }
}

impl Layer {
    fn items(self, drawn: &Drawing<'_>, size: f64) -> Vec<Item> {
        match self {
            Self::Clamps => drawn.clamps(size),
            Self::Monomers => drawn.monomers(size),
            Self::Bonds => annotations::bonds(drawn, size).items,
            Self::Rods => annotations::rods(drawn, size),
            Self::SegmentFrames => annotations::segment_frames(drawn, size),
            Self::JunctionBonds => drawn.junction_bonds(size),
            Self::BondFrames => annotations::bond_frames(drawn, size),
            Self::Forces => drawn.forces(3.0, |force| force * size),
            Self::ImposedMotions => annotations::imposed(drawn, size),
            Self::Linkers => drawn.linkers(size, 6.0, true),
        }
    }
}

impl Labels {
    fn of(self, drawn: &Drawing<'_>) -> Vec<Label> {
        match self {
            Self::None => Vec::new(),
            Self::Forces(nm_per_pn, offset) => {
                let forces = bodies::forces(drawn.assembly, drawn.state).into_iter();
                let label = |(at, force): (_, scene3d::Vector3)| Label {
                    at: at + force * nm_per_pn,
                    text: format!("{} pN", force.norm()),
                    offset,
                };
                forces.map(label).collect()
            }
            Self::Junction => junction_labels(drawn),
        }
    }
}

fn junction_labels(drawn: &Drawing<'_>) -> Vec<Label> {
    let mut labels = Vec::new();
    let mut name = |at, text: String, offset| labels.push(Label { at, text, offset });
    for (k, bond) in annotations::junction_bonds(drawn) {
        let [monomer, node] = bodies::ends_of(&bond, drawn.state);
        let [monomer_offset, frame_offset] = BOND_OFFSETS[k - 1];
        let middle = 0.5 * (monomer + node);
        name(monomer, format!("monomer {k}"), monomer_offset);
        name(middle, format!("frame {k} (Q_MR)"), frame_offset);
        if k == 1 {
            name(node, "end of the rod".into(), NODE_OFFSET);
        }
    }
    labels
}
