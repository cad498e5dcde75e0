//! Numbers to compare with, where the paper prints none: those of an earlier calculation that shares this code's
//! modelling decisions (Newton statics, 32 drawn bonds per interface, of any length, weight `Shared`).

use super::group::Figure;
use super::resolved::Resolved;

/// Rods with two nodes and a frame held, constant rigidities: (resolution, height in nm, couple
/// in pN nm) over-twisted by 180 deg.
const EIGHT_OVER: [(Resolved, &str, &str); 5] = [
    (Resolved::Rod, "39.4", "275"),
    (Resolved::Mixed(240), "38.5", "266"),
    (Resolved::Mixed(140), "36.5", "251"),
    (Resolved::Mixed(40), "34.8", "229"),
    (Resolved::Ellipsoids, "34.4", "218"),
];

/// The same, under-twisted; the rod is the mirror image of the over-twisted one.
const EIGHT_UNDER: [(Resolved, &str, &str); 5] = [
    (Resolved::Rod, "39.4", "275"),
    (Resolved::Mixed(240), "39.4", "240"),
    (Resolved::Mixed(140), "39.4", "188"),
    (Resolved::Mixed(40), "39.2", "145"),
    (Resolved::Ellipsoids, "40.1", "132"),
];

/// Extended rods with node and frame held, over-twisted by 180 deg: heights (nm).
const TEN_OVER: [(Resolved, &str); 5] = [
    (Resolved::Rod, "33.6"),
    (Resolved::Mixed(240), "33.9"),
    (Resolved::Mixed(140), "34.0"),
    (Resolved::Mixed(40), "34.2"),
    (Resolved::Ellipsoids, "34.2"),
];

/// Value of an observable at a turn, to the digits that are known, if there is one.
pub(super) fn of(
    figure: Figure,
    observable: &str,
    resolved: Resolved,
    turn_deg: i32,
) -> Option<&'static str> {
    let table = match (figure, turn_deg) {
        (Figure::Eight, 180) => EIGHT_OVER.as_slice(),
        (Figure::Eight, -180) => EIGHT_UNDER.as_slice(),
        (Figure::Ten, 180) => {
            let entry = TEN_OVER.iter().find(|entry| entry.0 == resolved)?;
            return (observable == "height").then_some(entry.1);
        }
        _ => return None,
    };
    let &(_, height, couple) = table.iter().find(|entry| entry.0 == resolved)?;
    match observable {
        "height" => Some(height),
        "couple" => Some(couple),
        _ => None,
    }
}
