//! Tables 3 and 5: the paper's entries beside ours, for the default filament and for ensembles.

use super::ensemble::{Ensemble, Kind, ensemble, turn_deg, value};
use super::statistics::{rms, sample};
use super::{lengths, listings, pictures};
use crate::figures::Run;
use crate::figures::bounds::A_DIFFERENCE;
use crate::published::{CURVATURE_ROUNDING, Entry, Table, entries};
use actin_draw::report::DEVIATIONS;
use actin_draw::report::{Artefact, Origin, Row};
use std::time::Instant;

/// Angles (deg) over which the root mean square is taken.
const COMPARED_DEG: std::ops::RangeInclusive<f64> = 40.0..=200.0;

/// Computes Table 3.
pub(in crate::figures) fn table3(run: Run<'_>) -> Result<Artefact, String> {
    reproduce(Table::Rigidity, run)
}

/// Computes Table 5.
pub(in crate::figures) fn table5(run: Run<'_>) -> Result<Artefact, String> {
    reproduce(Table::LengthChange, run)
}

fn reproduce(table: Table, run: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let out = run.out;
    let ensemble = ensemble(run)?;
    let entries = entries(table)?;
    listings::write(table, ensemble, &entries, out)?;
    let pictures = pictures::draw(table, ensemble, &entries, out)?;
    let mut rows = Vec::new();
    for entry in &entries {
        rows.push(mean_row(table, ensemble, entry));
    }
    for one in [DEFAULT_FILAMENT, MEAN_FILAMENT] {
        let row = |entry| filament_row(table, ensemble, one, entry);
        rows.extend(entries.iter().filter_map(row));
    }
    rows.extend(entries.iter().map(|e| returning_row(table, ensemble, e)));
    rows.push(printed_length(table, &entries));
    for kind in ensemble.kinds() {
        rows.push(rms_row(table, ensemble, kind, &entries));
    }
    if table == Table::Rigidity && !run.quick {
        rows.extend(lengths::rows(run)?);
    }
    Ok(Artefact {
        id: table.id(),
        title: table.title(),
        settings: settings(ensemble, &entries),
        rows,
        pictures,
        views: Vec::new(),
        wall_s: started.elapsed().as_secs_f64(),
    })
}

impl Table {
    pub(super) fn id(self) -> &'static str {
        match self {
            Self::Rigidity => "table3",
            Self::LengthChange => "table5",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Rigidity => "Secant twisting rigidity of the ellipsoid filament",
            Self::LengthChange => "Change of length of the twisted ellipsoid filament",
        }
    }

    pub(super) fn quantity(self) -> &'static str {
        match self {
            Self::Rigidity => "b3",
            Self::LengthChange => "dl_over_l",
        }
    }

    /// How far a value is from the paper's: relative for rigidities.
    fn difference(self, ours: f64, entry: &Entry) -> f64 {
        match self {
            Self::Rigidity => ours / entry.value - 1.0,
            Self::LengthChange => ours - entry.value,
        }
    }

    fn unit(self) -> &'static str {
        match self {
            Self::Rigidity => "pN nm^2",
            Self::LengthChange => "",
        }
    }
}

fn settings(ensemble: &Ensemble, entries: &[Entry]) -> String {
    let doubts = ensemble.doubts(Kind::DEFAULT, entries);
    let unreached = ensemble.unreached();
    let unreached = match unreached.first() {
        None => "Every angle was reached.".to_owned(),
        Some(first) => format!("{} angles were not reached: {first}.", unreached.len()),
    };
    format!(
        "30 monomers, two held at each end, 73.94 nm between the inner held ones; the far pair is \
         turned about the axis and slides along it only; secants at the printed curvatures. {} \
         samplings of the bonds of each drawn kind, seeds from 0; the mean is over those with 64 \
         independent bonds. Of these {}. The mean filament has 12 weighted bonds at each interface that \
         stand for all, and no seed. {unreached}",
        ensemble.seeds,
        doubts.describe()
    )
}

/// One entry: the mean over samplings of the default kind.
fn mean_row(table: Table, ensemble: &Ensemble, entry: &Entry) -> Row {
    let sample = ensemble.sample(Kind::DEFAULT, entry, table);
    let doubts = ensemble.doubts(Kind::DEFAULT, std::slice::from_ref(entry));
    let along = slope(table, ensemble, entry) * CURVATURE_ROUNDING;
    let tolerance = entry.rounding + along + DEVIATIONS * sample.sd;
    let note = format!(
        "mean of {} samplings at {:.2} deg, sd {}; {}",
        sample.count,
        turn_deg(entry),
        short(sample.sd),
        doubts.describe()
    );
    let quantity = path(table, "", entry);
    let row = |note| Row::measured(table.id(), quantity, table.unit(), sample.mean, note);
    if !entry.is_reliable() {
        let note = format!("{note}; the paper calls its value unreliable");
        return Row {
            paper: Some(entry.value),
            origin: Some(Origin::Paper),
            ..row(note)
        };
    }
    row(format!(
        "{note}; tolerance: half a digit of the paper's value {} and of its curvature {}, and 2 sd \
         of one sampling of ours (of the paper's, neither number nor pattern of bonds is known)",
        short(entry.rounding),
        short(along)
    ))
    .against(entry.value, tolerance)
}

/// The length that the printed angles and curvatures belong to.
fn printed_length(table: Table, entries: &[Entry]) -> Row {
    let lengths = entries
        .iter()
        .map(|e| e.phi_deg.to_radians() / e.curvature.abs());
    let lengths = sample(lengths);
    let note = format!(
        "angle over curvature as printed, mean of {} entries, range {:.2} to {:.2}; ours is 73.94 nm \
         and turned to the printed curvatures",
        lengths.count, lengths.low, lengths.high
    );
    let row = Row::measured(table.id(), "printed_length", "nm", lengths.mean, note);
    match table {
        Table::Rigidity => row.derived("75"),
        // The same columns again.
        Table::LengthChange => row.beside(75.0, Origin::Derived),
    }
}

/// A filament without scatter: its kind, the name of its rows and what it is.
type Filament = (Kind, &'static str, &'static str);
const DEFAULT_FILAMENT: Filament = (Kind::DEFAULT, "seed-0/", "drawn bonds, seed 0");
const MEAN_FILAMENT: Filament = (
    Kind::MEAN,
    "",
    "mean filament: weighted bonds that stand for all, nothing drawn",
);

/// One filament itself, the first of its kind.
fn filament_row(
    table: Table,
    ensemble: &Ensemble,
    (kind, before, words): Filament,
    entry: &Entry,
) -> Option<Row> {
    let points = ensemble.points(kind, entry);
    let (_, point) = points.iter().find(|(seed, _)| *seed == 0)?;
    let evidence = &point.evidence;
    let note = format!(
        "{words}; couple {:.3} pN nm, residual {:.1e} pN, {:?}",
        point.torque_pn_nm,
        evidence.residual_force_pn,
        evidence.stability()
    );
    let quantity = of_kind(kind, path(table, before, entry));
    Some(Row {
        paper: Some(entry.value),
        origin: Some(Origin::Paper),
        ..Row::measured(
            table.id(),
            quantity,
            table.unit(),
            value(point, table),
            note,
        )
    })
}

/// The mean filament has rows under a path of its own.
fn of_kind(kind: Kind, quantity: String) -> String {
    match kind {
        Kind::MEAN => format!("{}/{quantity}", kind.name()),
        _ => quantity,
    }
}

/// The mean on the way back from the largest angle: where it differs there are two equilibria.
fn returning_row(table: Table, ensemble: &Ensemble, entry: &Entry) -> Row {
    let sample = ensemble.sample(Kind::RETURNING, entry, table);
    let doubts = ensemble.doubts(Kind::RETURNING, std::slice::from_ref(entry));
    let note = format!(
        "the same filaments on the way back from 240 deg, sd {}; {}",
        short(sample.sd),
        doubts.describe()
    );
    let quantity = path(table, "returning/", entry);
    Row {
        paper: Some(entry.value),
        origin: Some(Origin::Paper),
        ..Row::measured(table.id(), quantity, table.unit(), sample.mean, note)
    }
}

/// The difference to the paper over the angles that are compared.
fn rms_row(table: Table, ensemble: &Ensemble, kind: Kind, entries: &[Entry]) -> Row {
    let compared: Vec<Entry> = entries.iter().copied().filter(is_compared).collect();
    let differences = || {
        compared
            .iter()
            .map(|entry| table.difference(ensemble.sample(kind, entry, table).mean, entry))
    };
    let ours = rms(differences());
    let (what, scale) = match table {
        Table::Rigidity => ("relative difference", 1.0),
        Table::LengthChange => ("difference", rms(compared.iter().map(|entry| entry.value))),
    };
    let (of, single) = match kind {
        Kind::MEAN => ("the mean filament".to_owned(), String::new()),
        _ => (
            format!("the mean of {} samplings", ensemble.seeds),
            single_rms(table, ensemble, kind, &compared),
        ),
    };
    let note = format!(
        "rms {what} of {of} from the paper, 40 to 200 deg in both directions, mean {what} \
         {:+.2e}; {single}{}",
        sample(differences()).mean,
        ensemble.doubts(kind, &compared).describe()
    );
    let name = table.quantity();
    if kind == Kind::DEFAULT {
        let row = Row::measured(table.id(), format!("{name}_rms"), "", ours, note);
        return row.against(0.0, A_DIFFERENCE * scale).of(Origin::Bound);
    }
    let quantity = match kind {
        Kind::MEAN => of_kind(kind, format!("{name}_rms")),
        _ => format!("{name}_rms/{}", kind.name()),
    };
    Row::measured(table.id(), quantity, "", ours, note)
}

/// The range of the root mean square over single samplings, in words.
fn single_rms(table: Table, ensemble: &Ensemble, kind: Kind, compared: &[Entry]) -> String {
    let single = sample(ensemble.of_kind(kind).map(|sampling| {
        rms(compared
            .iter()
            .filter_map(|entry| Some(table.difference(sampling.value(entry, table)?, entry))))
    }));
    format!(
        "of a single sampling the rms is {:.2e} to {:.2e}; ",
        single.low, single.high
    )
}

fn is_compared(entry: &Entry) -> bool {
    COMPARED_DEG.contains(&entry.phi_deg)
}

/// Change of our mean per curvature at an entry, from its neighbours.
fn slope(table: Table, ensemble: &Ensemble, entry: &Entry) -> f64 {
    // Zero twist is a point of both tables' curves as far as a slope goes.
    let near = 0.8 * entry.curvature;
    let at = |curvature: f64| {
        let points: Vec<(f64, f64)> = curve(table, ensemble, entry.direction());
        interpolate(&points, curvature)
    };
    ((at(entry.curvature) - at(near)) / (entry.curvature - near)).abs()
}

/// Means of the default kind in one direction against curvature.
fn curve(table: Table, ensemble: &Ensemble, direction: &str) -> Vec<(f64, f64)> {
    let all = entries(table).unwrap_or_default();
    let mut points: Vec<(f64, f64)> = all
        .iter()
        .filter(|entry| entry.direction() == direction)
        .map(|entry| {
            let mean = ensemble.sample(Kind::DEFAULT, entry, table).mean;
            (entry.curvature, mean)
        })
        .collect();
    points.push((0.0, 0.0));
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}

fn interpolate(points: &[(f64, f64)], x: f64) -> f64 {
    let pair = points.windows(2).find(|w| w[0].0 <= x && x <= w[1].0);
    pair.map_or(f64::NAN, |w| {
        let t = (x - w[0].0) / (w[1].0 - w[0].0);
        w[0].1 + t * (w[1].1 - w[0].1)
    })
}

fn path(table: Table, before: &str, entry: &Entry) -> String {
    let (name, direction) = (table.quantity(), entry.direction());
    format!("{name}/{before}{direction}/{}", entry.phi_deg)
}

fn short(value: f64) -> String {
    if value.abs() >= 0.1 {
        format!("{value:.0}")
    } else {
        format!("{value:.1e}")
    }
}
