//! Numbers to compare with, where the paper prints none: those of an independent prototype (Newton
//! statics, 32 independent bonds per interface, weight `Shared`).

use super::case::Resolved;
use super::group::Figure;

/// Rods with two nodes and a frame held, constant rigidities: (resolution, height in nm, couple
/// in pN nm) over-twisted by 180 deg.
const EIGHT_OVER: [(Resolved, f64, f64); 5] = [
    (Resolved::Rod, 39.4, 275.0),
    (Resolved::Mixed(240), 38.5, 266.0),
    (Resolved::Mixed(140), 36.5, 251.0),
    (Resolved::Mixed(40), 34.8, 229.0),
    (Resolved::Ellipsoids, 34.4, 218.0),
];

/// The same, under-twisted; the rod is the mirror image of the over-twisted one.
const EIGHT_UNDER: [(Resolved, f64, f64); 5] = [
    (Resolved::Rod, 39.4, 275.0),
    (Resolved::Mixed(240), 39.4, 240.0),
    (Resolved::Mixed(140), 39.4, 188.0),
    (Resolved::Mixed(40), 39.2, 145.0),
    (Resolved::Ellipsoids, 40.1, 132.0),
];

/// Extended rods with node and frame held, over-twisted by 180 deg: heights (nm).
const TEN_OVER: [(Resolved, f64); 5] = [
    (Resolved::Rod, 33.6),
    (Resolved::Mixed(240), 33.9),
    (Resolved::Mixed(140), 34.0),
    (Resolved::Mixed(40), 34.2),
    (Resolved::Ellipsoids, 34.2),
];

/// Tolerance of heights, and of couples in over-twist, relative.
const CLOSE: f64 = 0.03;
/// Tolerance of couples in under-twist, relative.
const UNDER_COUPLE: f64 = 0.06;

/// Value and largest difference for an observable at a turn, if there is one.
pub(super) fn of(
    figure: Figure,
    observable: &str,
    resolved: Resolved,
    turn_deg: i32,
) -> Option<(f64, f64)> {
    let table = match (figure, turn_deg) {
        (Figure::Eight, 180) => EIGHT_OVER.as_slice(),
        (Figure::Eight, -180) => EIGHT_UNDER.as_slice(),
        (Figure::Ten, 180) => {
            let entry = TEN_OVER.iter().find(|entry| entry.0 == resolved)?;
            return (observable == "height").then_some((entry.1, CLOSE * entry.1));
        }
        _ => return None,
    };
    let &(_, height, couple) = table.iter().find(|entry| entry.0 == resolved)?;
    match observable {
        "height" => Some((height, CLOSE * height)),
        "couple" if turn_deg > 0 => Some((couple, CLOSE * couple)),
        "couple" => Some((couple, UNDER_COUPLE * couple)),
        _ => None,
    }
}
