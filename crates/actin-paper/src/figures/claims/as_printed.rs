//! Claims on Figures 4 to 6 judged by the paper's own model: junctions of full weight, and in Figure
//! 4 the printed balance of the rod as well. What our model makes of the same claims is in
//! `bending.rs`. Shapes have to lie within the radius of the helix, numbers within 10 %, printed
//! numbers within half a digit.

use super::bending::ELASTICA_NM;
use super::{Holds, Known, range, spread};
use crate::figures::bounds::{A_DIFFERENCE, SHAPE_NM};
use actin_draw::report::Row;

/// Models of Figure 4: their name in quantities, and what they are.
const MODELS: [(&str, &str); 2] = [
    ("full", "the junction as printed"),
    ("paper-balance", "junction and balance as printed"),
];
/// The deflection that the paper's text states, and half a digit of it (nm).
const PRINTED_NM: (f64, f64) = (10.0, 0.5);

pub(super) fn cantilever(known: &Known<'_>) -> Vec<Row> {
    let mut all = Vec::new();
    all.extend(energies_close(known, "energy_spread/shared", ""));
    for (model, words) in MODELS {
        all.extend(tips(known, model, words).into_iter().flatten());
        let energies = format!("energy_spread/{model}");
        all.extend(energies_close(known, &energies, &format!("/{model}")));
    }
    let motions = ["frequency", "decay"].map(|name| motion(known, name));
    all.extend(motions.into_iter().flatten());
    all.extend(printed_deflection(known));
    all
}

/// Tips overlap, and where theory has them.
fn tips(known: &Known<'_>, model: &str, words: &str) -> [Option<Row>; 2] {
    let mixed = known.mixed(&format!("tip_drop/{model}"));
    let drops: Vec<f64> = mixed.iter().map(|d| d.1).collect();
    let Some((low, high)) = range(&drops) else {
        return [None, None];
    };
    let note = format!(
        "filaments of all resolutions overlap; {words}: largest minus smallest tip drop of the mixed \
         ones, beside the radius of the helix"
    );
    let holds = Holds::AtMost(SHAPE_NM);
    let overlap = known.claim(
        &format!("tips_overlap/{model}"),
        "nm",
        high - low,
        holds,
        note,
    );
    let farthest = f64::max(high / ELASTICA_NM - 1.0, 1.0 - low / ELASTICA_NM);
    let note = format!(
        "all resolutions have the deflection that theory expects; {words}: largest relative \
         difference of a mixed one from the exact elastica with Table 4's B1, {ELASTICA_NM} nm"
    );
    let holds = Holds::AtMost(A_DIFFERENCE);
    let theory = known.claim(&format!("theory/{model}"), "", farthest, holds, note);
    [Some(overlap), Some(theory)]
}

/// Frequencies and decays of junction and balance as printed match across resolutions, pure ones
/// included.
fn motion(known: &Known<'_>, name: &str) -> Option<Row> {
    let mixed = known.mixed(&format!("{name}/paper-balance"));
    let mut values: Vec<f64> = mixed.iter().map(|v| v.1).collect();
    values.push(known.get(&format!("{name}/paper-balance/rod"))?);
    values.push(known.get(&format!("{name}/ellipsoids"))?);
    let note = format!(
        "the dynamics of all resolutions match; junction and balance as printed: (max - min)/mean of \
         the {name} of the first flexural motion over {} resolutions, pure ones included",
        values.len()
    );
    let holds = Holds::AtMost(A_DIFFERENCE);
    Some(known.claim(
        &format!("{name}_spread/paper-balance"),
        "",
        spread(&values)?,
        holds,
        note,
    ))
}

/// The printed deflection at every resolution, with the rigidity that it belongs to.
fn printed_deflection(known: &Known<'_>) -> Option<Row> {
    let mixed = known.mixed("tip_drop/preceding-paper/full");
    let (printed, half_a_digit) = PRINTED_NM;
    let away = mixed.iter().map(|(_, drop)| (drop - printed).abs());
    let farthest = away.reduce(f64::max)?;
    let note = format!(
        "all resolutions have the expected deflection of about {printed} nm; with monomers and rod of \
         the preceding paper's rigidity and the junction as printed, the largest difference of a \
         mixed one from it"
    );
    let holds = Holds::AtMost(half_a_digit);
    Some(known.claim("deflection/preceding-paper", "nm", farthest, holds, note))
}

pub(super) fn linkers_in_plane(known: &Known<'_>) -> Vec<Row> {
    let agreement = agreement(known, "structural agreement is excellent");
    agreement.into_iter().chain(linkers_close(known)).collect()
}

pub(super) fn linkers_all_round(known: &Known<'_>) -> Vec<Row> {
    let agreement = agreement(known, "agreement is still good");
    agreement.into_iter().chain(linkers_close(known)).collect()
}

/// Filaments on linkers have much the same shape.
fn agreement(known: &Known<'_>, claim: &str) -> Option<Row> {
    let spread = known.get("node_spread/full")?;
    let note = format!(
        "{claim}; the junction as printed: largest distance of two centre lines, beside the radius of \
         the helix"
    );
    let holds = Holds::AtMost(SHAPE_NM);
    Some(known.claim("node_spread/full", "nm", spread, holds, note))
}

fn linkers_close(known: &Known<'_>) -> Option<Row> {
    energies_close(known, "energy_spread/full", "/full")
}

/// Energies of all resolutions match closely (Section 5).
fn energies_close(known: &Known<'_>, spread: &str, suffix: &str) -> Option<Row> {
    let note = "energies match closely; (max - min)/mean over the mixed resolutions; tolerance: what \
                the paper calls a difference in Figure 7";
    let spread = known.get(spread)?;
    let quantity = format!("energies_close{suffix}");
    Some(known.claim(&quantity, "", spread, Holds::AtMost(A_DIFFERENCE), note))
}

#[cfg(test)]
mod tests {
    use super::super::rows;
    use super::*;

    fn verdict(id: &'static str, numbers: &[(&str, f64)], quantity: &str) -> Option<bool> {
        let row = |&(quantity, ours): &(&str, f64)| Row::measured(id, quantity, "", ours, "");
        let known: Vec<Row> = numbers.iter().map(row).collect();
        let all = rows(id, &known);
        let claim = all.into_iter().find(|row| row.quantity == quantity)?;
        claim.pass
    }

    /// Tips 1.7 nm apart lie within the radius of the helix, tips 1.9 nm apart do not, and another
    /// model's tips have no part in it.
    #[test]
    fn each_model_is_judged_by_its_own_tips() {
        let tips = |apart| {
            [
                ("tip_drop/full/rod-20", 60.0),
                ("tip_drop/full/rod-140", 60.0 - apart),
                ("tip_drop/shared/rod-20", 60.0),
                ("tip_drop/shared/rod-140", 50.0),
            ]
        };
        let overlap = |apart| verdict("fig4", &tips(apart), "claim/tips_overlap/full");
        assert_eq!((overlap(1.7), overlap(1.9)), (Some(true), Some(false)));
        let printed = verdict("fig4", &tips(1.7), "claim/tips_overlap/paper-balance");
        assert_eq!(printed, None);
    }

    /// Half a digit of the printed 10 nm, which the farthest of the resolutions has to meet.
    #[test]
    fn every_resolution_has_to_have_the_printed_deflection() {
        let deflection = |farthest| {
            let numbers = [
                ("tip_drop/preceding-paper/full/rod-20", farthest),
                ("tip_drop/preceding-paper/full/rod-140", 10.0),
            ];
            verdict("fig4", &numbers, "claim/deflection/preceding-paper")
        };
        assert_eq!(
            (deflection(10.4), deflection(9.4)),
            (Some(true), Some(false))
        );
    }

    #[test]
    fn shapes_and_energies_on_linkers_can_miss() {
        let both = |value| {
            let numbers = [("node_spread/full", value), ("energy_spread/full", value)];
            ["node_spread", "energies_close"].map(|claim| {
                let quantity = format!("claim/{claim}/full");
                verdict("fig6", &numbers, &quantity)
            })
        };
        assert_eq!(both(0.05), [Some(true); 2]);
        assert_eq!(both(1.9), [Some(false); 2]);
    }
}
