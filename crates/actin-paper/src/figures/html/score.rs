//! The head of the page: what decides a verdict, and how many expected numbers are met, by where they come
//! from: first what the paper prints, table by table, then what it says, then the rest.

use crate::figures::bounds::RULE;
use actin_draw::page::{Verdicts, breakable, name};
use actin_draw::report::{Artefact, Origin, Row};
use maud::{Markup, html};

/// Where expected numbers come from, and what the page says of it.
const GROUPS: [(Origin, &str); 6] = [
    (
        Origin::Paper,
        "Numbers that the paper prints, beside simulated ones",
    ),
    (
        Origin::Derived,
        "Numbers that the paper prints, beside what follows from others that it prints (no simulation)",
    ),
    (Origin::Words, "Statements of the paper in words"),
    (Origin::Theory, "Theory"),
    (
        Origin::CrossCheck,
        "Cross-checks: an earlier calculation that shares this code's modelling decisions",
    ),
    (
        Origin::Bound,
        "Checks of the calculation, and bounds set here",
    ),
];

/// The rule and the counts; nothing if nothing is judged.
pub(super) fn html(artefacts: &[Artefact]) -> Markup {
    let groups = GROUPS.map(|(origin, title)| group(artefacts, origin, title));
    if groups.iter().all(|group| group.0.is_empty()) {
        return Markup::default();
    }
    html! {
        h3 { "What agrees" }
        p {
            "One rule decides in all figures and tables. A printed number is met within half a unit of \
             its last digit and, where bonds are drawn, twice the standard deviation of a single \
             filament; shapes called alike within 1.8 nm, the radius of the helix; numbers called alike \
             within 10 %, which the paper calls a difference itself; an order by its sign."
        }
        details {
            summary { "The rule in full, and what is not judged" }
            dl {
                @for (of, bound) in RULE {
                    dt { (of) } dd { (bound) "." }
                }
            }
            p class="soft" {
                "Not judged, and not counted: numbers copied from the paper, variants of its models, \
                 what cannot come out otherwise, and twist of 360 deg."
            }
        }
        table class="verdicts" {
            thead {
                tr {
                    th { "expected" } th class="n" { "met" } th class="n" { "of" } th { "not met" }
                }
            }
            tbody { @for group in groups { (group) } }
        }
    }
}

/// One line for all artefacts and, of what the paper says, one for each.
fn group(artefacts: &[Artefact], origin: Origin, title: &str) -> Markup {
    let judged = |a: &Artefact| -> Vec<Row> {
        let rows = a.rows.iter().filter(|row| row.origin == Some(origin));
        rows.filter(|row| row.pass.is_some()).cloned().collect()
    };
    let each: Vec<(&str, Vec<Row>)> = artefacts.iter().map(|a| (a.id, judged(a))).collect();
    let each: Vec<_> = each
        .into_iter()
        .filter(|(_, rows)| !rows.is_empty())
        .collect();
    let all: Vec<Row> = each.iter().flat_map(|(_, rows)| rows.clone()).collect();
    if all.is_empty() {
        return Markup::default();
    }
    let is_told = matches!(origin, Origin::Paper | Origin::Derived | Origin::Words);
    html! {
        (line(&html! { strong { (title) } }, &all, !is_told))
        @if is_told {
            @for (id, rows) in &each {
                (line(&html! { a href={ "#" (id) } { (name(id)) } }, rows, true))
            }
        }
    }
}

fn line(title: &Markup, rows: &[Row], with_misses: bool) -> Markup {
    let verdicts = Verdicts::of(rows);
    let missed = rows
        .iter()
        .filter(|row| with_misses && row.pass == Some(false));
    html! {
        tr {
            td class="wide" { (title) }
            td class="n pass" data-label="met" { (verdicts.agree) }
            td class="n" data-label="of" { (verdicts.compared()) }
            td class="wide" {
                @for (i, row) in missed.enumerate() {
                    @if i > 0 { ", " }
                    code { (breakable(&row.quantity)) }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Printed numbers come first, table by table, with the names of misses; what is not judged is not counted.
    #[test]
    fn printed_numbers_come_first() {
        let row = |quantity: &str| Row::measured("table3", quantity, "", 1.0, "");
        let artefact = Artefact {
            id: "table3",
            title: "",
            settings: String::new(),
            rows: vec![
                row("link").against(1.0, 0.1).of(Origin::Theory),
                row("b3/over/10").against(1.0, 0.1),
                row("b3/over/20").against(2.0, 0.1),
                row("b3/over/220").beside(2.0, Origin::Paper),
            ],
            pictures: Vec::new(),
            views: Vec::new(),
            wall_s: 0.0,
        };
        let page = html(&[artefact]).into_string();
        let place = |text: &str| page.find(text).unwrap();
        assert!(place("the paper prints, beside simulated") < place("Table 3</a>"));
        assert!(place("Table 3</a>") < place("Theory"));
        assert!(page.contains("data-label=\"met\">1</td><td class=\"n\" data-label=\"of\">2</td>"));
        assert!(page.contains("b3/<wbr>over/<wbr>20") && !page.contains("220"));
        assert_eq!(html(&[]).into_string(), "");
    }
}
