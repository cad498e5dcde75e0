//! What a reader sees first: what stands and what does not, how many numbers agree, artefact by
//! artefact, how to read the page, and every number that does not agree, with its reason.

use super::tables::{self, Among};
use super::verdicts::Verdicts;
use super::{TITLE, escape, findings, name, push, version};
use crate::figures::palette;
use crate::figures::report::{Artefact, Row};

/// Writes title, counts, misses, and how to read the page.
pub(super) fn write(page: &mut String, artefacts: &[Artefact], quick: bool) {
    let all: Verdicts = artefacts.iter().map(|a| Verdicts::of(&a.rows)).sum();
    push(
        page,
        format_args!(
            "<h1 id=\"summary\">{TITLE}</h1>\n<p class=\"soft\">Gunaratne, Floyd, Ni, Papoian and \
             Erban, arXiv 2203.01284. Version {}.</p>\n",
            escape(&version())
        ),
    );
    if quick {
        page.push_str(
            "<p class=\"quick\">This was a quick run: fewer resolutions and samplings, equilibria \
             more often than motions. The full run leaves <code>--quick</code> out.</p>\n",
        );
    }
    findings::write(page, artefacts);
    push(
        page,
        format_args!(
            "<p>Of {} numbers that the paper gives or bounds, or that the note of a row takes from \
             elsewhere, <span class=\"pass\">{} agree</span> within the tolerance beside them and \
             <span class=\"miss\">{} do not</span>; {} of all these are compared with an earlier, \
             independent calculation (called prototype in the notes), since the paper prints no number. {} \
             more were measured with nothing to compare them with. All numbers and pictures come from \
             simulations of the run that wrote this page; but for the choices that follow nothing is \
             fitted to meet the paper unless a row says so.</p>\n",
            all.compared(),
            all.agree,
            all.missed,
            from_prototype(artefacts),
            all.measured
        ),
    );
    page.push_str(CHOICES);
    counts(page, artefacts);
    reading(page);
    misses(page, artefacts);
}

/// How many numbers are compared with those of the prototype, as their notes say.
fn from_prototype(artefacts: &[Artefact]) -> usize {
    let rows = artefacts.iter().flat_map(|a| &a.rows);
    rows.filter(|row| row.pass.is_some() && row.note.contains("prototype"))
        .count()
}

/// What the paper leaves open and Tables 3 to 5 decided. A reader has to know, since agreement with
/// these tables is then no proof of those choices.
const CHOICES: &str = "<p><strong>Choices.</strong> The paper does not say clearly how far from the axis \
    the centres of monomers lie, how monomers are turned, nor how many bonds join two of them. An \
    earlier, independent calculation tried what is possible against Tables 3 to 5, and one answer is used \
    for everything here: 1.8 nm, which Table 1 calls an effective interaction radius (with 1.6 or 2.0 nm \
    Table 3 is missed); the shortest of the three axes points away from the filament (along the filament \
    it would be 6 to 10 times too soft in twist, around it a quarter off in under-twist); 64 bonds (fewer \
    than about 12 are far too soft; Tables 3 and 5 below show other numbers). So these tables test the \
    choices and the rest of the model together. A fourth choice departs from the paper's text: the two \
    bonds between monomers and rod count one half each, since with one each the joint is a stiff spot; \
    Figure 4 shows both.</p>\n";

fn counts(page: &mut String, artefacts: &[Artefact]) {
    page.push_str(
        "<h2>Verdicts</h2>\n<table class=\"verdicts\"><thead><tr><th>figure or table</th><th class=\"n\">agree</th>\
         <th class=\"n\">missed</th><th class=\"n\">measured only</th>\
         <th class=\"n\">time (s)</th><th></th></tr></thead><tbody>\n",
    );
    for artefact in artefacts {
        let verdicts = Verdicts::of(&artefact.rows);
        push(
            page,
            format_args!(
                "<tr><td class=\"wide\"><a href=\"#{id}\">{}</a>: {}</td>\
                 <td class=\"n {}\" data-label=\"agree\">{}</td>\
                 <td class=\"n {}\" data-label=\"missed\">{}</td>\
                 <td class=\"n\" data-label=\"measured only\">{}</td>\
                 <td class=\"n\" data-label=\"time (s)\">{:.1}</td><td class=\"wide\">{}</td></tr>\n",
                name(artefact.id),
                escape(artefact.title),
                if verdicts.agree > 0 { "pass" } else { "open" },
                verdicts.agree,
                if verdicts.missed > 0 { "miss" } else { "open" },
                verdicts.missed,
                verdicts.measured,
                artefact.wall_s,
                bar(verdicts),
                id = artefact.id,
            ),
        );
    }
    page.push_str("</tbody></table>\n");
}

/// Shares of what agrees and what does not; nothing where nothing is compared.
fn bar(verdicts: Verdicts) -> String {
    if verdicts.compared() == 0 {
        return String::new();
    }
    let share = |count: usize| 100.0 * count as f64 / verdicts.compared() as f64;
    format!(
        "<div class=\"bar\" role=\"img\" aria-label=\"{} of {} agree\"><div class=\"good\" \
         style=\"width:{:.1}%\"></div><div class=\"bad\" style=\"width:{:.1}%\"></div></div>",
        verdicts.agree,
        verdicts.compared(),
        share(verdicts.agree),
        share(verdicts.missed),
    )
}

fn misses(page: &mut String, artefacts: &[Artefact]) {
    let rows = artefacts.iter().flat_map(|a| &a.rows);
    let missed: Vec<&Row> = rows.filter(|row| row.pass == Some(false)).collect();
    page.push_str("<h2>What was missed, and why</h2>\n");
    if missed.is_empty() {
        page.push_str("<p>Nothing that was compared.</p>\n");
        return;
    }
    page.push_str(
        "<p>Every comparison that failed, under its reason. The note of a row says how its number came \
         about; the <a href=\"#errata\">errata</a> say where the paper is open or contradicts \
         itself.</p>\n",
    );
    tables::missed(page, &missed, Among::All);
}

fn reading(page: &mut String) {
    let palette = palette::chosen();
    let stops: Vec<String> = palette
        .stops()
        .iter()
        .map(|[red, green, blue]| format!("rgb({red},{green},{blue})"))
        .collect();
    push(
        page,
        format_args!(
            "<h2>How to read this page</h2>\n<p>A row agrees if ours differs from the paper's number \
             by no more than the tolerance; where the note says at most or at least, the tolerance \
             is the bound itself. Where the note names another source, a theory or the \
             earlier calculation, the number under <em>paper</em> is from there. Units are nm, pN, ns and rad; a row without one is a ratio or a count. \
             On a narrow screen wide pictures are scrolled sideways. Colour is resolution, the share \
             of the filament that is rod:</p>\n<div class=\"ramp\" \
             style=\"background:linear-gradient(to right,{})\"></div><div class=\"ends\"><span>all \
             monomers</span><span>all rod</span></div>\n<details><summary>What the names of quantities \
             mean</summary><dl>{}</dl></details>\n<p class=\"soft\">Another set of colours: \
             <code>--palette paper</code> or <code>--palette colour-blind</code>.</p>\n",
            stops.join(","),
            words(&NAMES)
        ),
    );
}

/// Parts of the names of quantities, and what they stand for.
const NAMES: [(&str, &str); 18] = [
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

fn words(entries: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for (name, meaning) in entries {
        let (name, meaning) = (escape(name), escape(meaning));
        push(
            &mut text,
            format_args!("<dt><code>{name}</code></dt><dd>{meaning}</dd>"),
        );
    }
    text
}
