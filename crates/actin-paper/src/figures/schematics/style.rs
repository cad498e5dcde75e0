//! Colours and legends of the schematics.

use crate::palette::{self, BodyColours};
use actin_draw::Colour;
use actin_draw::scene3d::{Item, Key, Stroke};
use actin_mechanics::Vector3;
use actin_view::INSIDE_NM;
use serde::Deserialize;

/// Depth offset of items on the surface of a monomer (nm).
pub(super) const ON_SURFACE_NM: f64 = 0.5;
pub(super) fn of(thing: fn(&BodyColours) -> [u8; 3]) -> Colour {
    Colour(thing(palette::chosen().body_colours()))
}

pub(super) fn bond(kind: usize) -> Colour {
    Colour(palette::chosen().body_colours().bonds[kind])
}

pub(super) fn axis(k: usize) -> Colour {
    Colour(palette::chosen().body_colours().axes[k])
}

pub(super) fn rod() -> Colour {
    palette::resolution(1.0)
}

fn force() -> Stroke {
    Stroke::solid(of(|t| t.force), 3.0)
}

/// Arrow of a force or a displacement.
pub(super) fn arrow(ends: [Vector3; 2]) -> Item {
    Item::arrow(ends, force()).nearer(INSIDE_NM)
}

/// Part of a legend.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) enum LegendPart {
    Bodies,
    Bonds,
    Junction,
    Axes,
    Clamp,
    Force,
    ForceAndMotion,
    Linkers,
}

impl LegendPart {
    pub(super) fn entries(self) -> Vec<(Key, String)> {
        let line = |colour, width| Key::Line(Stroke::solid(colour, width));
        let axis = |k| Key::Arrow(Stroke::solid(axis(k), 2.0));
        let linker = Stroke {
            dashed: true,
            ..Stroke::solid(of(|t| t.linker), 2.2)
        };
        let entries = match self {
            Self::Bodies => vec![
                (Key::Ball(palette::resolution(0.0)), "monomer"),
                (Key::Area(rod(), 0.3), "rod segment"),
                (line(rod().darker(0.3), 1.6), "centre line of the rod"),
                (Key::Dot(of(|t| t.node)), "node"),
            ],
            Self::Bonds => vec![
                (line(bond(0), 2.5), "lateral bond"),
                (line(bond(1), 2.5), "longitudinal bond"),
            ],
            Self::Junction => vec![(line(of(|t| t.junction), 5.0), "junction bond")],
            Self::Axes => vec![(axis(0), "d1"), (axis(1), "d2"), (axis(2), "d3")],
            Self::Clamp => vec![(Key::Area(of(|t| t.clamp), 0.75), "clamp")],
            Self::Force => vec![(Key::Arrow(force()), "force")],
            Self::ForceAndMotion => vec![(Key::Arrow(force()), "force, shift, turn")],
            Self::Linkers => vec![
                (Key::Line(linker), "linker"),
                (Key::Dot(of(|t| t.anchor)), "anchor"),
            ],
        };
        let named = |(key, name): (Key, &str)| (key, name.to_owned());
        entries.into_iter().map(named).collect()
    }
}
