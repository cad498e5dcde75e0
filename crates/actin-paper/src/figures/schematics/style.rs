//! Colours and legends of the schematics.

use crate::palette::{self, BodyColours};
use actin_draw::Colour;
use actin_draw::scene3d::{Item, Key, Stroke};
use actin_mechanics::Vector3;
use actin_view::INSIDE_NM;

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

pub(super) fn monomer() -> Colour {
    palette::resolution(0.0)
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

fn entry(key: Key, text: &str) -> (Key, String) {
    (key, text.to_owned())
}

pub(super) fn bodies() -> Vec<(Key, String)> {
    let line = Stroke::solid(rod().darker(0.3), 1.6);
    vec![
        entry(Key::Ball(monomer()), "monomer"),
        entry(Key::Area(rod(), 0.3), "rod segment"),
        entry(Key::Line(line), "centre line of the rod"),
        entry(Key::Dot(of(|t| t.node)), "node"),
    ]
}

pub(super) fn bonds() -> Vec<(Key, String)> {
    let key = |k: usize| Key::Line(Stroke::solid(bond(k), 2.5));
    vec![
        entry(key(0), "lateral bond"),
        entry(key(1), "longitudinal bond"),
    ]
}

pub(super) fn axes() -> Vec<(Key, String)> {
    let key = |k: usize| Key::Arrow(Stroke::solid(axis(k), 2.0));
    let names = ["d1", "d2", "d3"];
    (0..3).map(|k| entry(key(k), names[k])).collect()
}

pub(super) fn junction() -> (Key, String) {
    entry(
        Key::Line(Stroke::solid(of(|t| t.junction), 5.0)),
        "junction bond",
    )
}

pub(super) fn holds(arrow: &str) -> Vec<(Key, String)> {
    vec![
        entry(Key::Area(of(|t| t.clamp), 0.75), "clamp"),
        entry(Key::Arrow(force()), arrow),
    ]
}

pub(super) fn linkers() -> Vec<(Key, String)> {
    let line = Stroke {
        dashed: true,
        ..Stroke::solid(of(|t| t.linker), 2.2)
    };
    vec![
        entry(Key::Line(line), "linker"),
        entry(Key::Dot(of(|t| t.anchor)), "anchor"),
    ]
}
