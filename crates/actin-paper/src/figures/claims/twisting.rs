//! Claims on Figures 8 and 10 and Tables 3 and 5: twist is not resisted alike in both directions,
//! and what a rod makes of it.

use super::{Holds, Known, listed, rising};
use actin_draw::report::Row;

/// Turns of Figure 10 (deg).
const TURNS_DEG: [u32; 3] = [180, 270, 360];
/// Turns (deg) above which filaments have many equilibria, so that nothing is judged.
const JUDGED_DEG: u32 = 270;
/// Angles that the paper calls reliable (deg).
const RELIABLE_DEG: u32 = 200;
/// Angles to which both ways of the twist read the same (deg).
const ONE_STATE_DEG: u32 = 160;

pub(super) fn constant_rods(known: &Known<'_>) -> Vec<Row> {
    // The junction that the paper prints is judged as ours is.
    let trends = ["", "full/"]
        .map(|model| ["over", "under"].map(|direction| height_grows(known, model, direction)));
    let mut all: Vec<Row> = trends.into_iter().flatten().flatten().collect();
    let couple = |direction: &str| known.get(&format!("couple/{direction}/180/ellipsoids"));
    if let (Some(over), Some(under)) = (couple("over"), couple("under")) {
        let note = "monomers under-twist more easily than they over-twist; couple in under-twist \
                    over that in over-twist, monomers alone; of the rod it is 1";
        let holds = Holds::AtMost(1.0);
        all.push(known.claim("under_twist_easier", "", under / over, holds, note));
    }
    all
}

/// The buckled height is larger the more of the filament is rod.
fn height_grows(known: &Known<'_>, model: &str, direction: &str) -> Option<Row> {
    let heights = known.mixed(&format!("{model}height/{direction}/180"));
    let values: Vec<f64> = heights.iter().map(|h| h.1).collect();
    let note = format!(
        "filaments of lower resolution buckle higher; share of the steps to the next longer rod at \
         which the height (nm) grows: {}",
        listed(&heights)
    );
    let quantity = format!("height_grows_with_rod/{model}{direction}/180");
    let holds = Holds::AtLeast(1.0);
    (values.len() > 1).then(|| known.claim(&quantity, "", rising(&values), holds, note))
}

pub(super) fn extended_rods(known: &Known<'_>) -> Vec<Row> {
    let mut all = Vec::new();
    for direction in ["over", "under"] {
        for turn in TURNS_DEG {
            for model in ["", "coupling-energy/", "paper-balance/"] {
                let both = ["height", "couple"];
                all.extend(both.map(|name| improves(known, model, name, (direction, turn))));
            }
        }
    }
    all.push(larger_twist(known));
    all.into_iter().flatten().collect()
}

/// Spreads over resolutions are smaller with the extensions than without.
fn improves(
    known: &Known<'_>,
    model: &str,
    observable: &str,
    (direction, turn_deg): (&str, u32),
) -> Option<Row> {
    let turn = format!("{direction}/{turn_deg}");
    let extended = known.get(&format!("{model}{observable}_spread/{turn}"))?;
    let standard = known.get(&format!("standard/{observable}_spread/{turn}"))?;
    let note = format!(
        "the extended rod improves the agreement between resolutions; spread of the {observable} \
         over that with constant rigidities, {extended:.3} over {standard:.3}"
    );
    let quantity = format!("{observable}_improves/{model}{turn}");
    let ratio = extended / standard;
    if turn_deg > JUDGED_DEG {
        let note = format!("the paper: {note}; not judged, since the states are many");
        return Some(Row::measured(
            known.id,
            format!("claim/{quantity}"),
            "",
            ratio,
            note,
        ));
    }
    Some(known.claim(&quantity, "", ratio, Holds::AtMost(1.0), note))
}

/// In under-twist agreement is lower at larger twist.
fn larger_twist(known: &Known<'_>) -> Option<Row> {
    let (first, last) = (TURNS_DEG[0], JUDGED_DEG);
    let spread = |turn: u32| known.get(&format!("height_spread/under/{turn}"));
    let note = format!(
        "in under-twist agreement is lower at larger twist; spread of the height at {last} deg over \
         that at {first} deg"
    );
    let (large, small) = (spread(last)?, spread(first)?);
    let holds = Holds::AtLeast(1.0);
    Some(known.claim("under_spread_grows", "", large / small, holds, note))
}

/// Angles (deg) with the numbers of both directions below `path`.
fn pairs(known: &Known<'_>, path: &str) -> Vec<(u32, f64, f64)> {
    let over = known.below(&format!("{path}/over")).into_iter();
    let mut all: Vec<(u32, f64, f64)> = over
        .filter_map(|(angle, over)| {
            let under = known.get(&format!("{path}/under/{angle}"))?;
            Some((angle.parse().ok()?, over, under))
        })
        .collect();
    all.sort_by_key(|pair| pair.0);
    all
}

fn share(count: usize, of: usize) -> f64 {
    count as f64 / of as f64
}

pub(super) fn rigidity(known: &Known<'_>) -> Vec<Row> {
    let all = pairs(known, "b3");
    if all.is_empty() {
        return Vec::new();
    }
    let reliable: Vec<_> = all.iter().filter(|p| p.0 <= RELIABLE_DEG).collect();
    let easier = reliable.iter().filter(|p| p.2 < p.1).count();
    let note = format!(
        "it is easier to under-twist than to over-twist; share of the {} angles to {RELIABLE_DEG} \
         deg at which B3 is smaller in under-twist",
        reliable.len()
    );
    let share = share(easier, reliable.len());
    let easier = known.claim("under_twist_easier", "", share, Holds::AtLeast(1.0), note);
    std::iter::once(easier)
        .chain(unreliable(known, &all))
        .collect()
}

/// Above 200 deg values are not reliable: the way back reads otherwise than the way out.
fn unreliable(known: &Known<'_>, out: &[(u32, f64, f64)]) -> Option<Row> {
    let back = pairs(known, "b3/returning");
    let largest = |is_in: &dyn Fn(u32) -> bool| {
        let both = out
            .iter()
            .zip(&back)
            .filter(|(a, b)| a.0 == b.0 && is_in(a.0));
        let differences = both.flat_map(|(a, b)| [b.1 / a.1 - 1.0, b.2 / a.2 - 1.0]);
        differences.map(f64::abs).reduce(f64::max)
    };
    let note = format!(
        "values above {RELIABLE_DEG} deg are not reliable; largest relative difference there \
         between the way back from 240 deg and the way out; tolerance: that to {ONE_STATE_DEG} deg"
    );
    let within = largest(&|angle| angle <= ONE_STATE_DEG)?;
    let beyond = largest(&|angle| angle > RELIABLE_DEG)?;
    let holds = Holds::AtLeast(within);
    Some(known.claim("unreliable_above_200", "", beyond, holds, note))
}

pub(super) fn length(known: &Known<'_>) -> Vec<Row> {
    let all = pairs(known, "dl_over_l");
    let (Some(first), Some(last)) = (all.first(), all.last()) else {
        return Vec::new();
    };
    let shortening: Vec<f64> = all.iter().map(|p| -p.1).collect();
    let note = "the more a filament is over-twisted, the shorter it gets; share of the steps to \
                the next larger angle at which it does";
    let holds = Holds::AtLeast(1.0);
    let shortens = rising(&shortening);
    let shortens = known.claim("over_twist_shortens", "", shortens, holds, note);
    let note = format!(
        "an under-twisted filament lengthens first and contracts then; dL/L at {} deg, beside \
         {:.2e} at {} deg",
        first.0, last.2, last.0
    );
    let mut lengthens = known.claim(
        "under_twist_lengthens",
        "",
        first.2,
        Holds::AtLeast(0.0),
        note,
    );
    lengthens.pass = Some(first.2 > 0.0 && last.2 < 0.0);
    let more = all.iter().filter(|p| p.1.abs() > p.2.abs()).count();
    let note = format!(
        "over-twist contracts a filament more than under-twist; share of the {} angles at which \
         the length changes more",
        all.len()
    );
    let share = share(more, all.len());
    let more = known.claim("over_twist_contracts_more", "", share, holds, note);
    vec![shortens, lengthens, more]
}
