//! Claims on Figures 4, 5 and 6: filaments of all resolutions bend and move alike.

use super::{Holds, Known, range, spread};
use crate::figures::bounds::{A_DIFFERENCE, SHAPE_NM};
use actin_draw::report::Row;

/// Exact inextensible elastica of 160 nm under 2 pN with B = 3.9e4 pN nm^2 (nm).
pub(super) const ELASTICA_NM: f64 = 59.8;
/// Force (pN), length (nm), E (pN/nm^2) and I (nm^4) of the deflection that Section 4.1 computes.
const PRINTED: [f64; 4] = [2.0, 160.0, 2000.0, 120.0];

pub(super) fn cantilever(known: &Known<'_>) -> Vec<Row> {
    let drops: Vec<f64> = known.mixed("tip_drop/shared").iter().map(|d| d.1).collect();
    let mut all = vec![printed_deflection(known)];
    if let Some((low, high)) = range(&drops) {
        let note = "filaments of all resolutions overlap; largest minus smallest tip drop of the \
                    mixed ones, beside the radius of the helix";
        let holds = Holds::AtMost(SHAPE_NM);
        all.push(known.claim("tips_overlap", "nm", high - low, holds, note));
        let farthest = f64::max(high / ELASTICA_NM - 1.0, 1.0 - low / ELASTICA_NM);
        let note = format!(
            "all resolutions have the deflection that theory expects; largest relative difference \
             of a mixed one from the exact elastica with Table 4's B1, {ELASTICA_NM} nm (the \
             paper's 10 nm belong to another rigidity); tolerance: what the paper calls a difference \
             in Figure 7"
        );
        let holds = Holds::AtMost(A_DIFFERENCE);
        all.push(known.claim("theory", "", farthest, holds, note));
    }
    all.extend(motion(known));
    all.extend(cost(known));
    all
}

/// The formula of Section 4.1 with the numbers that it names.
fn printed_deflection(known: &Known<'_>) -> Row {
    let [force, length, modulus, inertia] = PRINTED;
    let deflection = force * length.powi(3) / (3.0 * modulus * inertia);
    let note = "F L^3 / 3 E I with the numbers printed beside it: 2 pN, 160 nm, 2000 pN/nm^2, \
                120 nm^4; tolerance: half a digit of the paper's 10";
    Row::measured(known.id, "claim/printed_deflection", "nm", deflection, note).derived("10")
}

/// Frequencies and decays match across resolutions.
fn motion(known: &Known<'_>) -> Vec<Row> {
    let both = ["frequency", "decay"].map(|name| {
        let mut values: Vec<f64> = known
            .mixed(&format!("{name}/shared"))
            .iter()
            .map(|v| v.1)
            .collect();
        values.extend(known.get(&format!("{name}/rod")));
        values.extend(known.get(&format!("{name}/ellipsoids")));
        let note = format!(
            "the dynamics of all resolutions match; (max - min)/mean of the {name} of the first \
             flexural motion over {} resolutions, pure ones included; tolerance: what the paper \
             calls a difference in Figure 7",
            values.len()
        );
        let holds = Holds::AtMost(A_DIFFERENCE);
        Some(known.claim(&format!("{name}_spread"), "", spread(&values)?, holds, note))
    });
    both.into_iter().flatten().collect()
}

/// Rods cost less than monomers, as fewer bonds must: shown, not judged.
fn cost(known: &Known<'_>) -> Option<Row> {
    let (most, work) = known.mixed("work/shared").pop()?;
    let note = format!(
        "the paper: replacing monomers by rod lowers the cost; evaluations of bonds and segments until \
         the stop rule is met, with {most} nm of rod over those of monomers alone; not judged, since \
         fewer bonds cost less"
    );
    let ratio = work / known.get("work/ellipsoids")?;
    Some(Row::measured(known.id, "claim/cost", "", ratio, note))
}

pub(super) fn linkers_in_plane(known: &Known<'_>) -> Vec<Row> {
    energies_close(known).into_iter().collect()
}

pub(super) fn linkers_all_round(known: &Known<'_>) -> Vec<Row> {
    let agreement = known.get("node_spread").map(|spread| {
        let note = "agreement is still good; largest distance of two centre lines, beside the \
                    radius of the helix, as in Figure 5";
        let holds = Holds::AtMost(SHAPE_NM);
        known.claim("node_spread", "nm", spread, holds, note)
    });
    energies_close(known).into_iter().chain(agreement).collect()
}

/// Energies of all resolutions match closely (Section 5).
fn energies_close(known: &Known<'_>) -> Option<Row> {
    let note = "energies match closely; (max - min)/mean over the mixed resolutions; tolerance: \
                what the paper calls a difference in Figure 7";
    let spread = known.get("energy_spread")?;
    let holds = Holds::AtMost(A_DIFFERENCE);
    Some(known.claim("energies_close", "", spread, holds, note))
}
