//! Colours of the schematics and their legend: one style for all of them.

use crate::palette::{self, Things};
use actin_draw::Colour;
use actin_draw::scene3d::{Item, Key, Solid, Stroke};
use actin_mechanics::Vector3;

/// What lies on a monomer's surface counts so much nearer than its middle (nm).
pub(super) const ON_SURFACE_NM: f64 = 0.5;
/// What is to be seen through a body counts as nearer than any part of it (nm).
pub(super) const INSIDE_NM: f64 = 8.0;

/// The colour of a thing in the palette of this run.
pub(super) fn of(thing: fn(&Things) -> [u8; 3]) -> Colour {
    Colour(thing(palette::chosen().things()))
}

/// The colour of lateral (0) or longitudinal (1) bonds.
pub(super) fn bond(kind: usize) -> Colour {
    Colour(palette::chosen().things().bonds[kind])
}

/// The colour of the axis number `k` of a frame.
pub(super) fn axis(k: usize) -> Colour {
    Colour(palette::chosen().things().axes[k])
}

/// Monomers: the end of the ramp where all is monomers.
pub(super) fn monomer() -> Colour {
    palette::resolution(0.0)
}

/// Rods: the end of the ramp where all is rod.
pub(super) fn rod() -> Colour {
    palette::resolution(1.0)
}

fn force() -> Stroke {
    Stroke::solid(of(|t| t.force), 3.0)
}

/// A force or a displacement.
pub(super) fn arrow(ends: [Vector3; 2]) -> Item {
    let stroke = force();
    Item::new(Solid::Arrow { ends, stroke }, stroke.colour).nearer(INSIDE_NM)
}

fn entry(key: Key, text: &str) -> (Key, String) {
    (key, text.to_owned())
}

/// Monomer, rod and what belongs to it.
pub(super) fn bodies() -> Vec<(Key, String)> {
    let line = Stroke::solid(rod().darker(0.3), 1.6);
    vec![
        entry(Key::Ball(monomer()), "monomer"),
        entry(Key::Area(rod(), 0.3), "rod segment"),
        entry(Key::Line(line), "centre line of the rod"),
        entry(Key::Dot(of(|t| t.node)), "node"),
    ]
}

/// The two kinds of bonds.
pub(super) fn bonds() -> Vec<(Key, String)> {
    let key = |k: usize| Key::Line(Stroke::solid(bond(k), 2.5));
    vec![
        entry(key(0), "lateral bond"),
        entry(key(1), "longitudinal bond"),
    ]
}

/// The three axes of frames.
pub(super) fn axes() -> Vec<(Key, String)> {
    let key = |k: usize| Key::Arrow(Stroke::solid(axis(k), 2.0));
    let names = ["d1", "d2", "d3"];
    (0..3).map(|k| entry(key(k), names[k])).collect()
}

/// A junction's bond.
pub(super) fn junction() -> (Key, String) {
    entry(
        Key::Line(Stroke::solid(of(|t| t.junction), 5.0)),
        "junction bond",
    )
}

/// What holds, and what the arrows are.
pub(super) fn holds(arrow: &str) -> Vec<(Key, String)> {
    vec![
        entry(Key::Area(of(|t| t.clamp), 0.75), "clamp"),
        entry(Key::Arrow(force()), arrow),
    ]
}

/// Linkers and their anchors.
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
