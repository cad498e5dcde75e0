//! What the paper claims in words, as measured quantities with a verdict.
//!
//! Bounds follow the rule of [`super::bounds`]. Every claim is computed from rows of its artefact; a claim
//! whose rows a run does not have (`--quick` follows no motion) is left out. Claims that need more than
//! rows are with their recipes. A claim is judged once, on the paper's own model.

mod as_printed;
mod bending;
mod parameters;
mod twisting;

use actin_draw::report::{Origin, Row};

/// The claims on an artefact with these rows.
pub(super) fn rows(id: &'static str, rows: &[Row]) -> Vec<Row> {
    let known = Known { id, rows };
    match id {
        "fig4" => [bending::cantilever(&known), as_printed::cantilever(&known)].concat(),
        "fig5" => [
            bending::linkers_in_plane(&known),
            as_printed::linkers_in_plane(&known),
        ]
        .concat(),
        "fig6" => [
            bending::linkers_all_round(&known),
            as_printed::linkers_all_round(&known),
        ]
        .concat(),
        "fig8" => twisting::constant_rods(&known),
        "fig10" => twisting::extended_rods(&known),
        "table3" => twisting::rigidity(&known),
        "table4" => parameters::rigidities(&known),
        "table5" => twisting::length(&known),
        _ => Vec::new(),
    }
}

/// When a claim holds.
#[derive(Clone, Copy, Debug)]
enum Holds {
    AtMost(f64),
    AtLeast(f64),
}

/// The rows that claims are made from.
#[derive(Debug)]
struct Known<'a> {
    id: &'static str,
    rows: &'a [Row],
}

impl Known<'_> {
    /// The number of a row.
    fn get(&self, quantity: &str) -> Option<f64> {
        let row = self.rows.iter().find(|row| row.quantity == quantity)?;
        Some(row.ours)
    }

    /// Names and numbers of the rows below `path`, those further below left out.
    fn below(&self, path: &str) -> Vec<(&str, f64)> {
        let inside = self.rows.iter().filter_map(|row| {
            let name = row.quantity.strip_prefix(path)?.strip_prefix('/')?;
            (!name.contains('/')).then_some((name, row.ours))
        });
        inside.collect()
    }

    /// The mixed resolutions below `path`, by ascending length of their rod (nm).
    fn mixed(&self, path: &str) -> Vec<(u32, f64)> {
        let all = self.below(path).into_iter();
        let mut mixed: Vec<(u32, f64)> = all
            .filter_map(|(name, value)| Some((name.strip_prefix("rod-")?.parse().ok()?, value)))
            .collect();
        mixed.sort_by_key(|entry| entry.0);
        mixed
    }

    /// A claim, and whether it holds.
    fn claim(
        &self,
        quantity: &str,
        unit: &'static str,
        ours: f64,
        holds: Holds,
        note: impl Into<String>,
    ) -> Row {
        let (limit, pass, words) = match holds {
            Holds::AtMost(limit) => (limit, ours <= limit, "holds up to the tolerance"),
            Holds::AtLeast(limit) => (limit, ours >= limit, "holds from the tolerance on"),
        };
        let note = format!("the paper: {}; {words}", note.into());
        Row {
            tolerance: Some(limit),
            pass: Some(pass),
            origin: Some(Origin::Words),
            ..Row::measured(self.id, format!("claim/{quantity}"), unit, ours, note)
        }
    }
}

/// Smallest and largest value; none if there are fewer than two.
fn range(values: &[f64]) -> Option<(f64, f64)> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (values.len() > 1).then_some((low, high))
}

/// Largest minus smallest over the mean.
fn spread(values: &[f64]) -> Option<f64> {
    let (low, high) = range(values)?;
    Some((high - low) * values.len() as f64 / values.iter().sum::<f64>())
}

/// Share of the steps between neighbours that go up.
fn rising(values: &[f64]) -> f64 {
    let steps = values.windows(2);
    let up = steps.clone().filter(|pair| pair[1] > pair[0]).count();
    up as f64 / steps.count() as f64
}

/// Names and values in words.
fn listed(values: &[(u32, f64)]) -> String {
    let each: Vec<String> = values.iter().map(|(k, v)| format!("{k}: {v:.2}")).collect();
    each.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(numbers: &[(&str, f64)]) -> Vec<Row> {
        let row = |&(quantity, ours): &(&str, f64)| Row::measured("fig8", quantity, "", ours, "");
        numbers.iter().map(row).collect()
    }

    fn verdict(id: &'static str, numbers: &[(&str, f64)], quantity: &str) -> (f64, bool) {
        let all = rows(id, &known(numbers));
        let row = all.into_iter().find(|row| row.quantity == quantity);
        let row = row.expect("the claim is made");
        (row.ours, row.pass.expect("a claim has a verdict"))
    }

    /// 20 and 140 are lengths, not words: they are compared as numbers. One step of two goes down.
    #[test]
    fn heights_are_ordered_by_the_length_of_rod() {
        let heights = [
            ("height/over/180/rod-140", 37.0),
            ("height/over/180/rod-40", 35.0),
            ("height/over/180/rod-240", 36.0),
            ("height/over/180/rod", 50.0),
        ];
        let quantity = "claim/height_grows_with_rod/over/180";
        let (share, pass) = verdict("fig8", &heights, quantity);
        assert!((share - 0.5).abs() < 1e-15 && !pass);
        let rising = [heights[0], heights[1], ("height/over/180/rod-240", 38.0)];
        assert!(verdict("fig8", &rising, quantity).1);
    }

    /// What a run does not have it says nothing about.
    #[test]
    fn claims_without_rows_are_left_out() {
        for id in [
            "fig5", "fig6", "fig8", "fig10", "table3", "table4", "table5",
        ] {
            assert_eq!(rows(id, &[]), [], "{id}");
        }
    }

    /// Both verdicts are possible for the spread of energies: 5 % is close, 15 % is not.
    #[test]
    fn close_is_less_than_what_the_paper_calls_a_difference() {
        let quantity = "claim/energies_close";
        assert!(verdict("fig5", &[("energy_spread", 0.05)], quantity).1);
        assert!(!verdict("fig5", &[("energy_spread", 0.15)], quantity).1);
    }

    #[test]
    fn statistics_by_hand() {
        assert!((spread(&[1.0, 2.0, 3.0]).unwrap() - 1.0).abs() < 1e-15);
        assert!((rising(&[1.0, 2.0, 0.0, 5.0]) - 2.0 / 3.0).abs() < 1e-15);
        assert_eq!(range(&[1.0]), None);
    }
}
