//! What is done to held ends, as arrows: shifts and turns from the scene's path.

use super::filament::Drawn;
use super::style;
use actin_draw::scene3d::{Item, Stroke};
use actin_mechanics::{Vector3, rotation};
use actin_sim::Setting;

/// Straight pieces of an arc.
const PIECES: u32 = 24;
/// Distance of arrows of shifts from the held point, and of arcs beyond it (nm).
const CLEAR_NM: f64 = 3.0;

/// Shifts as arrows of their own length that end beside the held point; turns as arcs of their own
/// angle about the axis.
pub(super) fn arrows(drawn: &Drawn<'_>, radius_nm: f64) -> Vec<Item> {
    let settings = drawn
        .assembly
        .scene
        .path
        .iter()
        .flat_map(|stage| &stage.set);
    settings
        .flat_map(|setting| match setting {
            Setting::Shift {
                filament,
                end,
                shift_nm,
            } => shift(drawn.held(*filament, *end), (*shift_nm).into()),
            Setting::Turn {
                filament,
                end,
                turn_deg,
            } => turn(drawn.held(*filament, *end), (*turn_deg).into(), radius_nm),
            // A load is drawn as it acts, an anchor where it ends.
            Setting::LoadFactor { .. } | Setting::Anchor { .. } => Vec::new(),
        })
        .collect()
}

/// A held point, the direction out of the filament there, and one across it.
type Held = Option<[Vector3; 3]>;

fn shift(held: Held, shift: Vector3) -> Vec<Item> {
    let Some([at, outward, _]) = held else {
        return Vec::new();
    };
    let to = at + outward * CLEAR_NM;
    vec![style::arrow([to - shift, to])]
}

fn turn(held: Held, turn_deg: Vector3, radius_nm: f64) -> Vec<Item> {
    let Some([at, outward, across]) = held else {
        return Vec::new();
    };
    let centre = at + outward * CLEAR_NM;
    let on_arc = |k: u32| {
        let share = f64::from(k) / f64::from(PIECES);
        let angle = turn_deg.map(f64::to_radians) * share;
        centre + rotation::exp(angle) * across * radius_nm
    };
    let pieces = (0..PIECES - 1).map(|k| {
        let stroke = Stroke::solid(style::of(|t| t.force), 2.2);
        Item::line([on_arc(k), on_arc(k + 1)], stroke)
    });
    let head = style::arrow([on_arc(PIECES - 3), on_arc(PIECES)]);
    pieces.chain([head]).collect()
}
