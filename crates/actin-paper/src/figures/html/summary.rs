//! The texts of the page: its head, what is found, how to read it, and what stands above the verdicts.

use super::{TITLE, findings, score};
use crate::palette;
use actin_draw::page::{Page, Verdicts};
use actin_draw::report::Artefact;
use maud::{Markup, html};

/// Title and origin, in two lines: figures follow.
pub(super) fn head(artefacts: &[Artefact], quick: bool, version: &str) -> Markup {
    let all: Verdicts = artefacts.iter().map(|a| Verdicts::of(&a.rows)).sum();
    html! {
        h1 id="summary" { (TITLE) }
        p class="soft" {
            "Gunaratne, Floyd, Ni, Papoian and Erban, arXiv 2203.01284. Version " (version) ". "
            @if all.compared() > 0 {
                (all.agree) " of " (all.compared()) " numbers that are judged agree: "
                a href="#verdicts" { "verdicts" } "."
            }
        }
        @if quick {
            p class="quick" {
                "This was a quick run: fewer resolutions and samplings, equilibria more often than \
                 motions. The full run leaves " code { "--quick" } " out; the reasons given for what \
                 was missed, and the numbers in them, are those of the full run."
            }
        }
    }
}

/// What is found, in words, and what was chosen beforehand.
pub(super) fn words(artefacts: &[Artefact]) -> Markup {
    html! { (findings::html(artefacts)) (judged(artefacts)) (choices()) }
}

/// How to read the page.
pub(super) fn how_to_read(page: &mut Page<'_>) -> Markup {
    let stops = palette::chosen().ramp().stops().iter();
    let stops: Vec<String> = stops.map(|&stop| page.colour(stop)).collect();
    reading(&stops)
}

/// What stands above the table of verdicts.
pub(super) fn verdicts(artefacts: &[Artefact]) -> Markup {
    html! {
        (score::html(artefacts))
        p {
            "Every number that is judged, figure by figure: first what was missed, under its reason. The \
             reasons, and the numbers in them, are those of the full run of this version. The note of a row \
             says how its number came about; the " a href="#errata" { "errata" }
            " say where the paper is open or contradicts itself."
        }
    }
}

fn judged(artefacts: &[Artefact]) -> Markup {
    let all: Verdicts = artefacts.iter().map(|a| Verdicts::of(&a.rows)).sum();
    html! {
        p {
            (all.compared()) " numbers are judged: "
            span class="pass" { (all.agree) " agree" } " within their tolerance; "
            span class="miss" { (all.missed) " do not" } ". " (all.measured)
            " more were measured and are not judged. All numbers and pictures come from simulations of \
             the run that wrote this page. Nothing was fitted in it, but for the laws of Figure 9 and \
             the rows named fitted; the choices that follow were made beforehand to meet Tables 3, 4 \
             and 5."
        }
    }
}

/// What the paper leaves open and Tables 3 and 4 decided. A reader has to know, since agreement with
/// these tables is then no proof of those choices.
fn choices() -> Markup {
    html! {
        p {
            strong { "Choices." }
            " The paper does not say clearly how far from the axis the centres of monomers lie, how \
             monomers are turned, nor how many bonds join two of them. These values were chosen because \
             an earlier calculation with them reproduced Tables 3 and 4 best, and are used for \
             everything here: 1.8 nm, which Table 1 calls an effective interaction radius; the shortest \
             of the three axes points away from the filament; 64 bonds, drawn anew for every two \
             monomers, none shorter than 0.20 nm, which was chosen on Tables 3 to 5 themselves. The \
             published rigidities of bonds are multiplied by 1.4, with which the paper itself meets a \
             persistence length (Appendix B). So these tables test the choices and the rest of the model \
             together. A further choice departs from the paper's text: the two bonds between monomers \
             and rod count one half each, since with one each the joint is too stiff; Figure 4 shows \
             both."
        }
    }
}

fn reading(stops: &[String]) -> Markup {
    let ramp = format!("background:linear-gradient(to right,{})", stops.join(","));
    html! {
        p {
            "A row agrees if ours differs from the expected number by no more than the tolerance; where \
             no number is expected, the tolerance is the bound itself, and the note says on which side \
             of it to be. Who expects the number or sets the bound stands under " em { "by" }
            ". Units are nm, pN, ns and rad; a row without one is a ratio or a count. On a narrow screen a \
             picture grows when it is touched. Colour is resolution, the share of the filament that \
             is rod:"
        }
        div class="ramp" style=(ramp) {}
        div class="ends" { span { "all monomers" } span { "all rod" } }
        details {
            summary { "What the names of quantities mean" }
            dl {
                @for (name, meaning) in NAMES {
                    dt { code { (name) } } dd { (meaning) }
                }
            }
        }
        p class="soft" {
            "Another set of colours: " code { "--palette paper" } " or "
            code { "--palette colour-blind" } "."
        }
    }
}

/// Parts of the names of quantities, and what they stand for.
const NAMES: [(&str, &str); 21] = [
    (
        "…/over/180, …/under/180",
        "over-twist or under-twist of the ends against each other, in degrees",
    ),
    (
        "ellipsoid, ellipsoids",
        "the whole filament as monomers, each a rigid ellipsoid",
    ),
    ("rod", "the whole filament as an elastic (Cosserat) rod"),
    (
        "rod-140",
        "140 nm of the filament as rod, the rest as monomers",
    ),
    (
        "independent-64, identical-20",
        "bonds between two monomers that touch: drawn anew at every interface, or one set for all",
    ),
    ("bonds-32", "32 bonds instead of 64 between two monomers"),
    ("…/sd", "standard deviation of a single filament"),
    ("seed-0", "one filament, not the mean of several"),
    (
        "returning",
        "the same filament on the way back from the largest twist",
    ),
    (
        "shared, full",
        "weight of the two bonds that join monomers to rod: half each, or one each",
    ),
    (
        "wall",
        "ends held by half a segment; without it the paper's way is followed, which holds nodes and \
         frames",
    ),
    (
        "standard",
        "rods with constant rigidities, beside those that follow their twist",
    ),
    (
        "mean-filament",
        "12 weighted bonds between two monomers that stand for all that could be drawn, with nothing left to \
         chance",
    ),
    (
        "coupling-energy, paper-balance",
        "rods that follow their twist in the two other ways of the paper: by an energy of twist times \
         stretch, and by its balance of forces as printed",
    ),
    (
        "fitted, fine",
        "rods of the law fitted to the monomers; rods with segments of 1.25 nm",
    ),
    (
        "b1, b3, s1, s3",
        "rigidity in bending, in twist (couple times length over angle, pN nm^2), in shear and in \
         stretch (pN)",
    ),
    ("dl_over_l", "change of length over length"),
    (
        "height, couple, force",
        "of a buckled filament: largest distance from the axis, torque and thrust at its ends",
    ),
    (
        "…_spread",
        "largest minus smallest over resolutions, relative to the mean where it has no unit",
    ),
    ("…_rms", "root mean square difference"),
    (
        "claim/…",
        "a statement of the paper in words, as a measured quantity",
    ),
];
