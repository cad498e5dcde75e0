//! Colours of the schematics and their legend: one style for all of them.

use crate::figures::plot::resolution_colour;
use crate::figures::scene3d::{Colour, Item, Key, Solid, Stroke};
use actin_mechanics::Vector3;

/// Lateral and longitudinal bonds.
pub(super) const BONDS: [Colour; 2] = [Colour([120, 40, 150]), Colour([0, 150, 140])];
/// First, second and third axis of a frame.
pub(super) const AXES: [Colour; 3] = [
    Colour([213, 94, 0]),
    Colour([60, 140, 40]),
    Colour([0, 70, 160]),
];
pub(super) const JUNCTION: Colour = Colour([250, 205, 30]);
pub(super) const NODE: Colour = Colour([255, 255, 255]);
pub(super) const WALL: Colour = Colour([165, 165, 165]);
pub(super) const LINKER: Colour = Colour([40, 40, 40]);
pub(super) const ANCHOR: Colour = Colour([220, 30, 40]);
/// Forces, and what held ends are made to do.
pub(super) const FORCE: Colour = Colour([20, 20, 20]);

/// What lies on a monomer's surface counts so much nearer than its middle (nm).
pub(super) const ON_SURFACE_NM: f64 = 0.5;
/// What is to be seen through a body counts as nearer than any part of it (nm).
pub(super) const INSIDE_NM: f64 = 8.0;

/// Monomers: the end of the ramp where all is monomers.
pub(super) fn monomer() -> Colour {
    resolution_colour(0.0).into()
}

/// Rods: the end of the ramp where all is rod.
pub(super) fn rod() -> Colour {
    resolution_colour(1.0).into()
}

fn force() -> Stroke {
    Stroke::solid(FORCE, 3.0)
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
        entry(Key::Dot(NODE), "node"),
    ]
}

/// The two kinds of bonds.
pub(super) fn bonds() -> Vec<(Key, String)> {
    let key = |k: usize| Key::Line(Stroke::solid(BONDS[k], 2.5));
    vec![
        entry(key(0), "lateral bond"),
        entry(key(1), "longitudinal bond"),
    ]
}

/// The three axes of frames.
pub(super) fn axes() -> Vec<(Key, String)> {
    let key = |k: usize| Key::Arrow(Stroke::solid(AXES[k], 2.0));
    let names = ["d1", "d2", "d3"];
    (0..3).map(|k| entry(key(k), names[k])).collect()
}

/// A junction's bond.
pub(super) fn junction() -> (Key, String) {
    entry(Key::Line(Stroke::solid(JUNCTION, 5.0)), "junction bond")
}

/// What holds, and what the arrows are.
pub(super) fn holds(arrow: &str) -> Vec<(Key, String)> {
    vec![
        entry(Key::Area(WALL, 0.75), "clamp"),
        entry(Key::Arrow(force()), arrow),
    ]
}

/// Linkers and their anchors.
pub(super) fn linkers() -> Vec<(Key, String)> {
    let line = Stroke {
        dashed: true,
        ..Stroke::solid(LINKER, 2.2)
    };
    vec![
        entry(Key::Line(line), "linker"),
        entry(Key::Dot(ANCHOR), "anchor"),
    ]
}
