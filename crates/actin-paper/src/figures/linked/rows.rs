//! Numbers of Figures 5 and 6 as rows of the report and as tables.

use super::case::{Case, Figure, STANDARD, VARIANTS, Variant};
use super::solve::{self, Outcome, SAME_PN_NM};
use super::spread::Spread;
use crate::figures::bounds::SHAPE_NM;
use crate::figures::settles::energy_decays;
use actin_draw::report::{Origin, Row, write_csv};
use std::path::Path;

/// What is read off a spread.
type Pick = fn(&Spread) -> f64;

/// The rows that both figures have.
pub(super) fn of_figure(figure: &Figure, outcomes: &[Outcome]) -> Vec<Row> {
    let mut all = Vec::new();
    for variant in VARIANTS {
        all.extend(spreads(figure, outcomes, variant));
    }
    all.extend(with_pure(figure, outcomes));
    all.extend(rolls(figure, outcomes));
    all.extend(of_variants(figure, outcomes));
    all.extend(evidence(figure, outcomes));
    all.extend(motions(figure, outcomes));
    all
}

/// Spreads of one variant: of the first sampling, and mean and standard deviation over samplings.
fn spreads(figure: &Figure, outcomes: &[Outcome], variant: Variant) -> Vec<Row> {
    let all = over_seeds(figure, outcomes, variant);
    let first = &all[0];
    let (suffix, words) = (variant.suffix(), variant.words());
    let [(high, highest), (low, lowest)] = &first.energies;
    let energy = format!(
        "(max - min)/mean over {} mixed resolutions, {words}; {low:.2} ({lowest}) to {high:.2} \
         pN nm ({highest})",
        first.resolutions
    );
    let node = format!("largest between {}; {words}", first.farthest);
    let force = format!("largest (max - min)/mean of a linker's pull; {words}");
    let picks: [Pick; 3] = [|s| s.energy, |s| s.node, |s| s.force];
    let names = [
        ("energy_spread", "", energy),
        ("node_spread", "nm", node),
        ("linker_force_spread", "", force),
    ];
    let measures = names.into_iter().zip(picks);
    let rows = measures.flat_map(|((name, unit, note), pick)| {
        let (mean, sd) = statistics(all.iter().map(pick));
        let over = format!("{} samplings of the bonds, sd {sd:.4}; {words}", all.len());
        let quantity = format!("{name}{suffix}");
        let of_mean = format!("{quantity}/mean");
        let of_mean = Row::measured(figure.id, of_mean, unit, mean, over);
        let of_first = Row::measured(figure.id, quantity, unit, pick(first), note);
        let has_mean = variant.is_drawn_at_random();
        [Some(of_first), has_mean.then_some(of_mean)]
    });
    rows.flatten().collect()
}

fn with_pure(figure: &Figure, outcomes: &[Outcome]) -> [Row; 2] {
    let all = Spread::over(outcomes, figure, STANDARD, 0, true);
    let row = |name: &str, unit, ours, note: String| {
        Row::measured(figure.id, format!("{name}/with-pure"), unit, ours, note)
    };
    let [(high, highest), (low, lowest)] = &all.energies;
    let note = format!(
        "pure rod and pure monomers included; {low:.2} ({lowest}) to {high:.2} pN nm ({highest})"
    );
    [
        row("energy_spread", "", all.energy, note),
        row(
            "node_spread",
            "nm",
            all.node,
            format!("between {}", all.farthest),
        ),
    ]
}

fn rolls(figure: &Figure, outcomes: &[Outcome]) -> [Row; 2] {
    let (least, most) = Spread::over(outcomes, figure, STANDARD, 0, true).roll;
    let note = "turn of the body that holds the second linker, from how it was built, over all \
                resolutions and the pure cases";
    [
        Row::measured(figure.id, "roll/least", "deg", least, note),
        Row::measured(figure.id, "roll/most", "deg", most, note),
    ]
}

/// Energy of each filament of the first sampling, pure cases included.
fn of_variants(figure: &Figure, outcomes: &[Outcome]) -> Vec<Row> {
    let first = outcomes.iter().filter(|o| o.case.seed == 0);
    let rows = first.map(|o| {
        let (suffix, found) = (o.case.variant.suffix(), &o.lowest);
        Row::measured(
            figure.id,
            format!("energy{suffix}/{}", o.case.name()),
            "pN nm",
            found.energy,
            format!(
                "of it {:.2} in the linkers; {} Newton iterations, residual {:.1e} pN and {:.1e} \
                 pN nm, lowest eigenvalue {:.1e} pN/nm",
                found.linkers,
                found.iterations,
                found.residual.0,
                found.residual.1,
                found.lowest.unwrap_or(f64::NAN)
            ),
        )
    });
    rows.collect()
}

/// Certificates, and how many filaments have more than one equilibrium.
fn evidence(figure: &Figure, outcomes: &[Outcome]) -> [Row; 3] {
    let count = |keep: &dyn Fn(&Outcome) -> bool| outcomes.iter().filter(|o| keep(o)).count();
    let above = |o: &Outcome| {
        let starts = o.starts.iter().map(|e| e - o.lowest.energy);
        starts.fold(0.0, f64::max)
    };
    let unstable = count(&|o| !o.lowest.stable);
    let several = count(&|o| above(o) > SAME_PN_NM);
    let highest = outcomes.iter().map(above).fold(0.0, f64::max);
    let note = format!("of {} filaments", outcomes.len());
    [
        Row {
            tolerance: Some(0.0),
            pass: Some(unstable == 0),
            origin: Some(Origin::Bound),
            ..Row::measured(
                figure.id,
                "not_certified_stable",
                "",
                unstable as f64,
                format!("{note}: equilibria whose stiffness is not positive definite"),
            )
        },
        Row::measured(
            figure.id,
            "several_equilibria",
            "",
            several as f64,
            format!(
                "{note}: those for which starts turned by 0, 90, 180 and 270 deg find energies \
                 more than {SAME_PN_NM} pN nm apart"
            ),
        ),
        Row::measured(
            figure.id,
            "highest_equilibrium",
            "pN nm",
            highest,
            "how far the highest of them is above the lowest of its filament, which counts",
        ),
    ]
}

/// Damped dynamics against Newton's method.
fn motions(figure: &Figure, outcomes: &[Outcome]) -> Vec<Row> {
    let moved = outcomes.iter();
    let moved: Vec<_> = moved
        .filter_map(|o| Some((o, o.motion.as_ref()?)))
        .collect();
    if moved.is_empty() {
        return Vec::new();
    }
    let last = |m: &solve::Motion| m.energy.last().map_or(f64::NAN, |e| e[1]);
    let energies = moved.iter().map(|(_, m)| (last(m) - m.limit.energy).abs());
    let nodes = moved.iter().map(|(_, m)| m.from_limit_nm);
    let (energy, node) = (energies.fold(0.0, f64::max), nodes.fold(0.0, f64::max));
    let is_elsewhere =
        |(o, m): &&(&Outcome, &solve::Motion)| m.limit.energy > o.lowest.energy + SAME_PN_NM;
    let elsewhere = moved.iter().filter(is_elsewhere).count() as f64;
    let unfinished = moved.iter().filter(|(_, m)| !m.converged).count();
    let count = moved.len();
    let note = format!(
        "largest difference between the end of damped dynamics and the certified equilibrium that \
         Newton's method reaches from there, {count} motions; {unfinished} ended by time, all \
         others by the stop rule"
    );
    let to = format!("of {count} motions: those that end in another equilibrium than the lowest");
    let row = |quantity, unit, ours, note| Row::measured(figure.id, quantity, unit, ours, note);
    vec![
        row("newton_difference/energy", "pN nm", energy, note.clone()),
        row("newton_difference/node", "nm", node, note),
        row("motions_to_a_higher_equilibrium", "", elsewhere, to),
        energy_decays(
            figure.id,
            moved.iter().map(|(_, m)| m.energy.iter().map(|e| e[1])),
        ),
    ]
}

/// What the paper says of Figure 5: excellent structural agreement.
pub(super) fn bending_claim(figure: &Figure, outcomes: &[Outcome]) -> [Row; 1] {
    let spread = Spread::over(outcomes, figure, STANDARD, 0, false);
    let first = outcomes.iter().find(|o| o.case.is_mixed());
    let moved = first.map_or(f64::NAN, |o| o.lowest.centre_line.displacement());
    [Row {
        tolerance: Some(SHAPE_NM),
        pass: Some(spread.node < SHAPE_NM),
        origin: Some(Origin::Words),
        ..Row::measured(
            figure.id,
            "claim/node_spread",
            "nm",
            spread.node,
            format!(
                "the paper: excellent structural agreement. Ours: yes if all centre lines lie \
                 within the radius of the helix, the tolerance; filaments are displaced by up to \
                 {moved:.1} nm"
            ),
        )
    }]
}

/// What the paper says of Figure 6: deviations of shape and energy are larger than in Figure 5.
pub(super) fn larger_claims(here: (&Figure, &[Outcome]), there: (&Figure, &[Outcome])) -> Vec<Row> {
    let picks: [Pick; 3] = [|s| s.node, Spread::energy_range, |s| s.energy];
    let claims = [
        ("node_spread", "deviations of shape are more noticeable"),
        ("energy_range", "energies vary more (in pN nm)"),
        ("energy_spread", "energies vary more (relative to the mean)"),
    ];
    // The paper's variants are judged, by what its Figure 6(c) shows: energies in pN nm.
    let is_judged = |variant: Variant, claim| variant.is_of_the_paper() && claim != "energy_spread";
    let of_variant = |variant| {
        let spreads = [here, there].map(|(figure, o)| over_seeds(figure, o, variant));
        let pairs = claims.into_iter().zip(picks);
        pairs.map(move |(claim, pick)| {
            let row = larger(here.0, variant, claim, &spreads, pick);
            if is_judged(variant, claim.0) {
                judged_larger(row)
            } else {
                row
            }
        })
    };
    VARIANTS.into_iter().flat_map(of_variant).collect()
}

/// One claim on one variant: the ratio of the means over samplings; variants that are not the paper's
/// have no verdict.
fn larger(
    figure: &Figure,
    variant: Variant,
    (name, claim): (&str, &str),
    [here, there]: &[Vec<Spread>; 2],
    pick: Pick,
) -> Row {
    let (ours, sd) = statistics(here.iter().map(pick));
    let (theirs, planar_sd) = statistics(there.iter().map(pick));
    let pairs = here.iter().zip(there);
    let larger = pairs.filter(|(a, b)| pick(a) > pick(b)).count();
    let quantity = format!("claim/{name}_over_fig5{}", variant.suffix());
    let note = format!(
        "the paper: {claim} than in Figure 5. Means over \
         samplings: {ours:.4} (sd {sd:.4}) here, {theirs:.4} (sd {planar_sd:.4}) there, larger in \
         {larger} of {} samplings; {}",
        here.len(),
        variant.words()
    );
    Row::measured(figure.id, quantity, "", ours / theirs, note)
}

/// The ratio judged: larger than 1.
fn judged_larger(row: Row) -> Row {
    Row {
        tolerance: Some(1.0),
        pass: Some(row.ours > 1.0),
        origin: Some(Origin::Words),
        note: format!("{}; more than the tolerance passes", row.note),
        ..row
    }
}

/// Spreads of all samplings of the bonds; the mean filament has one.
fn over_seeds(figure: &Figure, outcomes: &[Outcome], variant: Variant) -> Vec<Spread> {
    let over = |seed| Spread::over(outcomes, figure, variant, seed, false);
    let seeds = if variant.is_drawn_at_random() {
        seeds(outcomes)
    } else {
        1
    };
    (0..seeds).map(over).collect()
}

/// The pure rod with its sites exactly in the plane of the anchors.
pub(super) fn in_plane(case: &Case) -> Result<[Row; 2], String> {
    let (saddle, iterations) = solve::in_plane(case)?;
    Ok([
        Row::measured(
            case.figure.id,
            "in_plane/rod",
            "pN nm",
            saddle.energy,
            format!(
                "energy of the pure rod that keeps its sites on the inner side of the bend: {} \
                 (found in {} Newton iterations). It rolls by half a turn from there",
                if saddle.stable { "stable" } else { "a saddle" },
                saddle.iterations
            ),
        ),
        Row::measured(
            case.figure.id,
            "in_plane/iterations",
            "",
            iterations as f64,
            "Newton iterations of the pure rod, sites exactly in the plane: to that saddle and \
             from there to the equilibrium",
        ),
    ])
}

/// How the cases were run, in words.
pub(super) fn settings(figure: &Figure, outcomes: &[Outcome]) -> String {
    let worst = |pick: fn(&Outcome) -> f64| outcomes.iter().map(pick).fold(0.0, f64::max);
    format!(
        "Scene scenarios/{}, the rod in the middle resolved as named, {} filaments, {} samplings \
         of the bonds (seeds from 0; 0 unless named; the mean filament has weighted bonds and none). \
         Equilibria by Newton's method from the built filament \
         turned by 0, 90, 180 and 270 deg about its axis, residual below {:.1e} pN and {:.1e} \
         pN nm; the lowest counts. Motions: anchors away from the sites at once, drag 0.3 per ns \
         for velocities and for angular momenta.",
        figure.file,
        outcomes.len(),
        seeds(outcomes),
        worst(|o| o.lowest.residual.0),
        worst(|o| o.lowest.residual.1),
    )
}

fn seeds(outcomes: &[Outcome]) -> u64 {
    outcomes.iter().map(|o| o.case.seed + 1).max().unwrap_or(0)
}

/// Mean and standard deviation of a single value.
fn statistics(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    let squares: f64 = values.map(|x| (x - mean).powi(2)).sum();
    (mean, (squares / (n - 1.0).max(1.0)).sqrt())
}

/// Writes the tables behind rows and pictures.
pub(super) fn write_tables(
    figure: &Figure,
    outcomes: &[Outcome],
    out: &Path,
) -> Result<(), String> {
    let name = |table: &str| format!("{}{table}.csv", figure.id);
    write_csv(out, &name(""), &COLUMNS, outcomes.iter().map(columns))?;
    let lines = outcomes.iter().flat_map(|o| {
        let line = &o.lowest.centre_line;
        let points = line.arc_lengths().iter().zip(line.points());
        points.map(move |(s, [x, y, z])| {
            let numbers = [s, x, y, z].map(|v| number(*v));
            label(&o.case).into_iter().chain(numbers).collect()
        })
    });
    let header = ["case", "variant", "seed", "s_nm", "x_nm", "y_nm", "z_nm"];
    write_csv(out, &name("_centre_lines"), &header, lines)?;
    let moved = outcomes
        .iter()
        .filter_map(|o| Some((o, o.motion.as_ref()?)));
    let energies = moved.flat_map(|(o, motion)| {
        let rows = motion.energy.iter();
        rows.map(|e| [vec![o.case.name()], e.map(number).to_vec()].concat())
    });
    let header = ["case", "time_ns", "total_pn_nm", "potential_pn_nm"];
    write_csv(out, &name("_energy"), &header, energies)
}

const COLUMNS: [&str; 13] = [
    "case",
    "variant",
    "seed",
    "energy_pn_nm",
    "linkers_pn_nm",
    "stable",
    "lowest_eigenvalue_pn_per_nm",
    "newton_iterations",
    "roll_deg",
    "energies_by_start_pn_nm",
    "motion_limit_pn_nm",
    "motion_time_ns",
    "motion_force_evaluations",
];

/// One outcome under [`COLUMNS`].
fn columns(o: &Outcome) -> Vec<String> {
    let found = &o.lowest;
    let starts: Vec<String> = o.starts.iter().map(|e| format!("{e:.6}")).collect();
    let of_motion = |pick: &dyn Fn(&solve::Motion) -> String| {
        let motion = o.motion.as_ref();
        motion.map_or_else(String::new, pick)
    };
    let rest = [
        number(found.energy),
        number(found.linkers),
        found.stable.to_string(),
        found.lowest.map_or_else(String::new, number),
        found.iterations.to_string(),
        format!("{:.3}", found.roll),
        starts.join(" "),
        of_motion(&|m| number(m.limit.energy)),
        of_motion(&|m| format!("{:.2}", m.time_ns)),
        of_motion(&|m| m.force_evaluations.to_string()),
    ];
    label(&o.case).into_iter().chain(rest).collect()
}

fn label(case: &Case) -> [String; 3] {
    let variant = case.variant.suffix().trim_start_matches('/');
    let variant = if variant.is_empty() {
        "standard"
    } else {
        variant
    };
    [case.name(), variant.into(), case.seed.to_string()]
}

fn number(x: f64) -> String {
    format!("{x:.9e}")
}
