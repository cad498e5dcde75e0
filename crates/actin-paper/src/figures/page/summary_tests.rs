//! Tests of findings and counts of the page.

use super::*;
use crate::workspace_root;
use actin_draw::report;

fn committed() -> Vec<Artefact> {
    let rows = report::read(&workspace_root().join("docs/report.json")).unwrap();
    let mut artefacts: Vec<Artefact> = Vec::new();
    for row in rows {
        if artefacts.last().is_none_or(|a| a.id != row.artefact) {
            artefacts.push(Artefact {
                id: row.artefact,
                title: "",
                settings: String::new(),
                rows: Vec::new(),
                pictures: Vec::new(),
                views: Vec::new(),
                wall_s: 0.0,
            });
        }
        artefacts.last_mut().unwrap().rows.push(row);
    }
    artefacts
}

#[test]
fn statements_follow_the_verdicts() {
    let mut artefacts = committed();
    for finding in &TEXTS.findings {
        assert!(
            finding.verdict(&artefacts).is_some(),
            "{}",
            finding.confirmed
        );
    }
    let sentences = |artefacts: &[Artefact]| sentences(artefacts).map(|(.., text)| text);
    let before = sentences(&artefacts);
    assert!(before[0].contains("take one shape") && !before[1].contains("take one shape"));
    let fig5 = artefacts.iter_mut().find(|a| a.id == "fig5").unwrap();
    let row = fig5.rows.iter_mut();
    let mut row = row.filter(|row| row.quantity == "claim/node_spread");
    row.next().unwrap().pass = Some(false);
    let after = sentences(&artefacts);
    assert!(!after[0].contains("take one shape") && after[1].contains("take one shape"));
    assert!(after[2].contains("without known cause"));
}

/// In a run of one artefact, a statement has no neighbours to refer to.
#[test]
fn every_statement_can_be_read_alone() {
    let artefacts = committed();
    for finding in &TEXTS.findings {
        let mut own = artefacts
            .iter()
            .find(|a| a.id == finding.artefact)
            .unwrap()
            .clone();
        own.rows
            .retain(|row| finding.quantities.contains(&row.quantity));
        for (pass, title, text) in [
            (true, "Confirmed:</span> ", finding.in_words(true)),
            (
                false,
                "Not confirmed:</span> that ",
                finding.in_words(false),
            ),
        ] {
            own.rows.iter_mut().for_each(|row| row.pass = Some(pass));
            let page = findings(std::slice::from_ref(&own)).into_string();
            let shown = html! { (text) }.into_string();
            assert!(page.contains(title) && page.contains(&shown), "{page}");
            let words: Vec<&str> = text.split([' ', ',', ';']).collect();
            for leaning in ["they", "them", "too", "so", "also", "ones", "other"] {
                assert!(!words.contains(&leaning), "{leaning}: {text}");
            }
            assert!(
                text.contains(&actin_draw::page::name(&finding.artefact)),
                "{text}"
            );
        }
    }
}

#[test]
fn misses_are_counted_by_their_cause() {
    let artefacts = committed();
    let rows = artefacts.iter().flat_map(|a| &a.rows);
    let missed: Vec<&Row> = rows.filter(|row| row.pass == Some(false)).collect();
    let words = causes(&missed);
    let of_paper = |row: &&&Row| Reason::from_row(row).is_some_and(|r| r.cause == Cause::Paper);
    let begin = format!(
        "{} comparisons failed. In {} the paper contradicts itself; ",
        missed.len(),
        missed.iter().filter(of_paper).count()
    );
    assert!(words.starts_with(&begin), "{words}");
    let unknown = Row::measured("fig1", "q", "nm", 1.0, "").with_paper_value(2.0, 0.5);
    assert_eq!(
        causes(&[&unknown]),
        "1 comparison failed. 1 without known cause"
    );
    assert_eq!(causes(&[]), "");
}

#[test]
fn artefacts_without_rows_have_no_findings() {
    assert_eq!(findings(&[]).into_string(), "");
}

/// Printed numbers come first, by table, with the names of misses. Rows without a verdict are not counted.
#[test]
fn printed_numbers_come_first() {
    let row = |quantity: &str| Row::measured("table3", quantity, "", 1.0, "");
    let artefact = Artefact {
        id: "table3",
        title: "",
        settings: String::new(),
        rows: vec![
            row("link")
                .with_paper_value(1.0, 0.1)
                .with_origin(Origin::Theory),
            row("b3/over/10").with_paper_value(1.0, 0.1),
            row("b3/over/20").with_paper_value(2.0, 0.1),
            row("b3/over/220").with_reference(2.0, Origin::Paper),
        ],
        pictures: Vec::new(),
        views: Vec::new(),
        wall_s: 0.0,
    };
    let page = score(&[artefact]).into_string();
    let place = |text: &str| page.find(text).unwrap();
    assert!(place("Printed numbers compared with simulations") < place("Table 3</a>"));
    assert!(place("Table 3</a>") < place("Theory"));
    assert!(page.contains("data-label=\"met\">1</td><td class=\"n\" data-label=\"of\">2</td>"));
    assert!(page.contains("b3/<wbr>over/<wbr>20") && !page.contains("220"));
    assert_eq!(score(&[]).into_string(), "");
}
