//! Sections of the page: head, findings, guide and verdicts.

use super::TITLE;
use super::texts::{Cause, Finding, Reason, TEXTS};
use crate::palette;
use actin_draw::page::{Page, Verdicts, breakable, name};
use actin_draw::report::{Artefact, Origin, Row};
use maud::{Markup, html};

fn all(artefacts: &[Artefact]) -> Verdicts {
    artefacts.iter().map(|a| Verdicts::from_rows(&a.rows)).sum()
}

pub(super) fn head(artefacts: &[Artefact], quick: bool, version: &str) -> Markup {
    let all = all(artefacts);
    html! {
        h1 id="summary" { (TITLE) }
        p class="soft" {
            "Gunaratne, Floyd, Ni, Papoian and Erban, arXiv 2203.01284. Version " (version) ". "
            @if all.compared() > 0 {
                (all.agree) " of " (all.compared()) " compared numbers agree: "
                a href="#verdicts" { "verdicts" } "."
            }
        }
        @if quick {
            p class="quick" {
                "This is a quick run with fewer resolutions and samplings, and without most \
                 motions. Omit " code { "--quick" } " for a full run. The reasons of \
                 misses and the numbers in them refer to the full run."
            }
        }
    }
}

pub(super) fn words(artefacts: &[Artefact]) -> Markup {
    let all = all(artefacts);
    html! {
        (findings(artefacts))
        p {
            (all.compared()) " numbers are compared: "
            span class="pass" { (all.agree) " agree" } " within their tolerance; "
            span class="miss" { (all.missed) " do not" } ". " (all.measured)
            " further numbers have no verdict. All numbers and pictures are from simulations of the run that wrote \
             this page. The run fitted only the laws of Figure 9; rows named fitted use a law fitted to monomers. \
             The following choices were made in advance to reproduce Tables 3, 4 and 5."
        }
        p { strong { "Choices." } " " (TEXTS.choices) }
    }
}

pub(super) fn verdicts(artefacts: &[Artefact]) -> Markup {
    html! {
        (score(artefacts))
        p {
            "All compared numbers by figure, first the misses with their reasons. The \
             reasons and the numbers in them refer to the full run of this version. The note of a row \
             explains its number; the " a href="#errata" { "errata" }
            " list gaps and contradictions in the paper."
        }
    }
}

pub(super) fn how_to_read(page: &mut Page<'_>) -> Markup {
    let stops = palette::chosen().ramp().stops().iter();
    let stops: Vec<String> = stops.map(|&stop| page.colour(stop)).collect();
    let ramp = format!("background:linear-gradient(to right,{})", stops.join(","));
    html! {
        p {
            "A row agrees if our number differs from the expected one by at most the tolerance. If \
             no number is expected, the tolerance is the bound itself, and the note states whether \
             it is an upper or a lower bound. The column " em { "by" } " gives the origin of the number or bound"
            ". Units are nm, pN, ns and rad; rows without a unit are ratios or counts. On a narrow screen, touch a \
             picture to enlarge it. Colours show the resolution, the share of the filament that \
             is rod:"
        }
        div class="ramp" style=(ramp) {}
        div class="ends" { span { "all monomers" } span { "all rod" } }
        details {
            summary { "Names of quantities" }
            dl {
                @for (name, meaning) in &TEXTS.names {
                    dt { code { (name) } } dd { (meaning) }
                }
            }
        }
        p class="soft" {
            "Other palettes: " code { "--palette paper" } " or "
            code { "--palette colour-blind" } "."
        }
    }
}

impl Finding {
    /// Verdict; `None` if rows are missing in the run.
    fn verdict(&self, artefacts: &[Artefact]) -> Option<bool> {
        let artefact = artefacts.iter().find(|a| a.id == self.artefact)?;
        let verdict = |name: &String| {
            let row = artefact.rows.iter().find(|row| row.quantity == *name)?;
            row.pass
        };
        let verdicts: Option<Vec<bool>> = self.quantities.iter().map(verdict).collect();
        verdicts.map(|all| all.into_iter().all(|pass| pass))
    }
}

fn findings(artefacts: &[Artefact]) -> Markup {
    let sentences = sentences(artefacts);
    html! {
        @for (title, class, text) in sentences.iter().filter(|(.., text)| !text.is_empty()) {
            p class="lead" { span class=(class) { (title) ":" } " " (text) "." }
        }
    }
}

fn sentences(artefacts: &[Artefact]) -> [(&'static str, &'static str, String); 3] {
    let verdicts = TEXTS.findings.iter().map(|f| (f, f.verdict(artefacts)));
    let of = |wanted: bool| {
        let chosen = verdicts.clone().filter(move |(_, v)| *v == Some(wanted));
        let words = chosen.map(|(f, _)| f.in_words(wanted));
        words.collect::<Vec<_>>().join("; ")
    };
    let rows = artefacts.iter().flat_map(|a| &a.rows);
    let missed: Vec<&Row> = rows.filter(|row| row.pass == Some(false)).collect();
    [
        ("Confirmed", "pass", of(true)),
        ("Not confirmed", "miss", of(false)),
        ("Reasons", "open", causes(&missed)),
    ]
}

/// Numbers of misses by cause; empty without misses.
fn causes(missed: &[&Row]) -> String {
    let count = |cause: Option<Cause>| {
        let causes = missed
            .iter()
            .map(|row| Reason::from_row(row).map(|r| r.cause));
        causes.filter(|found| *found == cause).count()
    };
    let known = Cause::ALL.map(|cause| (count(Some(cause)), Some(cause)));
    let counted = known.into_iter().chain([(count(None), None)]);
    let causes: Vec<String> = counted
        .filter(|(count, _)| *count > 0)
        .map(|(count, cause)| {
            let unknown = || format!("{count} without known cause");
            cause.map_or_else(unknown, |cause| cause.in_words(count))
        })
        .collect();
    match missed.len() {
        0 => String::new(),
        1 => format!("1 comparison failed. {}", causes.concat()),
        many => format!("{many} comparisons failed. {}", causes.join("; ")),
    }
}

const GROUPS: [(Origin, &str); 6] = [
    (Origin::Paper, "Printed numbers compared with simulations"),
    (
        Origin::Derived,
        "Printed numbers compared with values computed from other printed numbers (no simulation)",
    ),
    (Origin::Words, "Verbal statements of the paper"),
    (Origin::Theory, "Theory"),
    (
        Origin::CrossCheck,
        "Cross-checks with an earlier calculation of the same modelling decisions",
    ),
    (
        Origin::Bound,
        "Checks of the computation, and bounds set here",
    ),
];

/// Rule and counts; empty without verdicts.
fn score(artefacts: &[Artefact]) -> Markup {
    let groups = GROUPS.map(|(origin, title)| group(artefacts, origin, title));
    if groups.iter().all(|group| group.0.is_empty()) {
        return Markup::default();
    }
    html! {
        h3 { "What agrees" }
        p {
            "One rule applies to all figures and tables. A printed number agrees within half a unit of its last \
             digit and, for sampled bonds, twice the standard deviation of a single filament. Shapes that the paper \
             calls equal agree within 1.8 nm, the radius of the helix. Numbers that it calls equal agree within 10 \
             %, the size of a difference that it reports as one. For an order, the sign decides."
        }
        details {
            summary { "Complete rule, and rows without a verdict" }
            dl {
                @for (of, bound) in &TEXTS.rule {
                    dt { (of) } dd { (bound) "." }
                }
            }
            p class="soft" {
                "Rows without a verdict are not counted: numbers copied from the paper, variants of its models, \
                 identities, and twist of 360 deg."
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

/// Line of all artefacts and, for numbers and statements of the paper, one line per artefact.
fn group(artefacts: &[Artefact], origin: Origin, title: &str) -> Markup {
    let judged = |a: &Artefact| -> Vec<Row> {
        let rows = a.rows.iter().filter(|row| row.origin == Some(origin));
        rows.filter(|row| row.pass.is_some()).cloned().collect()
    };
    let each = artefacts.iter().map(|a| (a.id, judged(a)));
    let each: Vec<(&str, Vec<Row>)> = each.filter(|(_, rows)| !rows.is_empty()).collect();
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
    let verdicts = Verdicts::from_rows(rows);
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
#[path = "summary_tests.rs"]
mod tests;
