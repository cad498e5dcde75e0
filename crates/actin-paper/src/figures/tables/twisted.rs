//! Tables 3 and 5: entries of the paper compared with single filaments and ensembles.

use super::ensemble::{Ensemble, Kind, Sampled, StabilityCounts, core, ensemble, turn_deg, value};
use super::lengths;
use crate::figures::charts::{dots, line};
use crate::figures::draft::{Column, Draft, number};
use crate::figures::expected::{DIFFERENCE, Holds};
use crate::figures::texts::{ChartText, Values};
use crate::fit::FitData;
use crate::palette;
use crate::published::{CURVATURE_ROUNDING, Entry, Table, entries};
use crate::statistics::{SampleStatistics, rms, sample};
use actin_draw::report::{DEVIATIONS, Origin, Row};
use actin_draw::{Colour, Mark, Series};
use actin_sim::Anchors;

const COMPARED_DEG: std::ops::RangeInclusive<f64> = 40.0..=200.0;
/// Half the width of the cap of an error bar (rad/nm).
const CAP: f64 = 3.5e-4;

pub(in crate::figures) fn table3(draft: &mut Draft<'_>) -> Result<(), String> {
    let twisted = TwistTable::new(Table::Rigidity, draft)?;
    twisted.reproduce(draft)?;
    let reliable = twisted.entries.iter().filter(|e| e.is_reliable());
    let (over, under): (Vec<&Entry>, Vec<&Entry>) = reliable.partition(|e| e.direction() == "over");
    let easier = over.iter().filter(|o| {
        let mirrored = under
            .iter()
            .find(|u| u.phi_deg.total_cmp(&o.phi_deg).is_eq());
        mirrored.is_some_and(|u| twisted.mean(Kind::DEFAULT, u) < twisted.mean(Kind::DEFAULT, o))
    });
    let share = easier.count() as f64 / over.len() as f64;
    let statement = format!(
        "it is easier to under-twist than to over-twist; share of the {} angles to 200 deg at which B3 is smaller \
         in under-twist",
        over.len()
    );
    draft.claim(
        "under_twist_easier",
        share,
        Some((Holds::AtLeast, 1.0)),
        statement,
    );
    if draft.quick {
        return Ok(());
    }
    lengths::rows(draft)
}

pub(in crate::figures) fn table5(draft: &mut Draft<'_>) -> Result<(), String> {
    TwistTable::new(Table::LengthChange, draft)?.reproduce(draft)
}

/// Twisting rigidity and change of length of our filaments at the reliable entries of the paper, for Figure 9: mean
/// over samplings of the bonds, and mean filament.
pub(in crate::figures) fn monomers(draft: &Draft<'_>) -> Result<[FitData; 2], String> {
    let ensemble = core(draft)?;
    let of = |kind, source: String| {
        let column = |table| {
            let all = entries(table).into_iter().filter(Entry::is_reliable);
            let points = all.map(|e| (e.curvature, ensemble.sample(kind, &e, table).mean));
            points.collect()
        };
        FitData {
            source,
            rigidity: column(Table::Rigidity),
            length: column(Table::LengthChange),
            ..FitData::default()
        }
    };
    let drawn = format!("our monomers, mean of {} samplings", ensemble.seeds);
    Ok([
        of(Kind::DEFAULT, drawn),
        of(Kind::MEAN, "our monomers, mean filament".to_owned()),
    ])
}

struct TwistTable {
    table: Table,
    column: &'static str,
    unit: &'static str,
    ensemble: &'static Ensemble,
    entries: Vec<Entry>,
}

impl TwistTable {
    fn new(table: Table, draft: &Draft<'_>) -> Result<Self, String> {
        let (column, unit) = match table {
            Table::Rigidity => ("b3", "pN nm^2"),
            Table::LengthChange => ("dl_over_l", ""),
        };
        Ok(Self {
            table,
            column,
            unit,
            ensemble: ensemble(draft)?,
            entries: entries(table),
        })
    }

    fn reproduce(&self, draft: &mut Draft<'_>) -> Result<(), String> {
        self.settings(draft)?;
        for entry in &self.entries {
            self.mean_row(draft, entry);
            self.filament_row(draft, Kind::DEFAULT, "seed-0/", entry);
            self.filament_row(draft, Kind::MEAN, "", entry);
        }
        self.printed_length(draft);
        for kind in self.ensemble.kinds() {
            self.rms_row(draft, kind);
        }
        self.listings(draft)?;
        self.pictures(draft)
    }

    fn mean(&self, kind: Kind, entry: &Entry) -> f64 {
        self.ensemble.sample(kind, entry, self.table).mean
    }

    fn path(&self, folder: &str, entry: &Entry) -> String {
        format!(
            "{}/{folder}{}/{}",
            self.column,
            entry.direction(),
            entry.phi_deg
        )
    }

    fn settings(&self, draft: &mut Draft<'_>) -> Result<(), String> {
        let doubts = self.ensemble.doubts(Kind::DEFAULT, &self.entries);
        let unreached = match &self.ensemble.unreached[..] {
            [] => "Every angle was reached.".to_owned(),
            [first, ..] => {
                let count = self.ensemble.unreached.len();
                format!("{count} angles were not reached: {first}.")
            }
        };
        let values: Values<'_> = &[
            ("seeds", &self.ensemble.seeds),
            ("doubts", &doubts.describe()),
            ("unreached", &unreached),
        ];
        draft.describe("twisted", values)
    }

    /// Row of an entry: mean over samplings of the default kind.
    fn mean_row(&self, draft: &mut Draft<'_>, entry: &Entry) {
        let sample = self.ensemble.sample(Kind::DEFAULT, entry, self.table);
        let doubts = self
            .ensemble
            .doubts(Kind::DEFAULT, std::slice::from_ref(entry));
        let along = self.slope(entry) * CURVATURE_ROUNDING;
        let note = format!(
            "mean of {} samplings at {:.2} deg, sd {}; {}",
            sample.count,
            turn_deg(entry),
            short(sample.sd()),
            doubts.describe()
        );
        let row =
            |note| Row::measured(draft.id, self.path("", entry), self.unit, sample.mean, note);
        if !entry.is_reliable() {
            let row = row(format!("{note}; the paper calls its value unreliable"));
            draft.compared(row.with_reference(entry.value, Origin::Paper));
            return;
        }
        let note = format!(
            "{note}; tolerance: half a digit of the printed value {} and of the printed twist {}, and 2 sd of one \
             of our samplings (number and pattern of the bonds of the paper are unknown)",
            short(entry.rounding),
            short(along)
        );
        let tolerance = entry.rounding + along + DEVIATIONS * sample.sd();
        let row = row(note).with_paper_value(entry.value, tolerance);
        draft.compared(row);
    }

    fn filament_row(&self, draft: &mut Draft<'_>, kind: Kind, folder: &str, entry: &Entry) {
        let mut points = self.ensemble.points(kind, entry);
        let Some((.., point)) = points.find(|point| point.1 == 0) else {
            return;
        };
        let (words, before) = match kind {
            Kind::MEAN => ("quadrature bonds", "mean-filament/"),
            _ => ("sampled bonds, seed 0", ""),
        };
        let evidence = &point.evidence;
        let note = format!(
            "{words}; torque {:.3} pN nm, residual {:.1e} pN, {:?}",
            point.torque_pn_nm,
            evidence.residual_force_pn,
            evidence.stability()
        );
        let quantity = format!("{before}{}", self.path(folder, entry));
        let ours = value(point, self.table);
        let row = Row::measured(draft.id, quantity, self.unit, ours, note);
        draft.compared(row.with_reference(entry.value, Origin::Paper));
    }

    /// Row of the length that follows from the printed angles and twists.
    fn printed_length(&self, draft: &mut Draft<'_>) {
        let lengths = self.entries.iter();
        let lengths = sample(lengths.map(|e| e.phi_deg.to_radians() / e.curvature.abs()));
        let note = format!(
            "printed angle divided by printed twist, mean of {} entries, range {:.2} to {:.2}; our length is 73.94 \
             nm, with the printed twists",
            lengths.count, lengths.low, lengths.high
        );
        draft.row("printed_length", "nm", lengths.mean, note);
    }

    /// Difference from the value of the paper, relative for rigidities.
    fn difference(&self, ours: f64, entry: &Entry) -> f64 {
        match self.table {
            Table::Rigidity => ours / entry.value - 1.0,
            Table::LengthChange => ours - entry.value,
        }
    }

    /// Row of the root mean square difference from the paper.
    fn rms_row(&self, draft: &mut Draft<'_>, kind: Kind) {
        let is_compared = |e: &Entry| COMPARED_DEG.contains(&e.phi_deg);
        let compared: Vec<Entry> = self.entries.iter().copied().filter(is_compared).collect();
        let differences = || {
            compared
                .iter()
                .map(|e| self.difference(self.mean(kind, e), e))
        };
        let seeds = kind.seeds(self.ensemble.seeds);
        let single = sample(seeds.map(|seed| {
            let value = |e: &Entry| self.ensemble.value(kind, seed, e, self.table);
            let values = compared.iter().filter_map(|e| Some((e, value(e)?)));
            rms(values.map(|(e, value)| self.difference(value, e)))
        }));
        let (what, scale) = match self.table {
            Table::Rigidity => ("relative difference", 1.0),
            Table::LengthChange => ("difference", rms(compared.iter().map(|e| e.value))),
        };
        let note = format!(
            "rms {what} between the mean of {} samplings and the paper, 40 to 200 deg in both directions, mean {what} \
             {:+.2e}; rms of a single sampling {:.2e} to {:.2e}; {}",
            single.count,
            sample(differences()).mean,
            single.low,
            single.high,
            self.ensemble.doubts(kind, &compared).describe()
        );
        let name = format!("{}_rms", self.column);
        let quantity = match kind {
            Kind::DEFAULT => name,
            Kind::MEAN => format!("{}/{name}", kind.name()),
            _ => format!("{name}/{}", kind.name()),
        };
        let mut row = Row::measured(draft.id, quantity, "", rms(differences()), note);
        if kind == Kind::DEFAULT {
            row = row
                .with_paper_value(0.0, DIFFERENCE * scale)
                .with_origin(Origin::Bound);
        }
        draft.compared(row);
    }

    /// Derivative of our mean with respect to the twist at an entry.
    fn slope(&self, entry: &Entry) -> f64 {
        let own = self
            .entries
            .iter()
            .filter(|e| e.direction() == entry.direction());
        let mut points: Vec<(f64, f64)> = own
            .map(|e| (e.curvature, self.mean(Kind::DEFAULT, e)))
            .collect();
        // Zero twist is added for entries without an inner neighbour.
        points.push((0.0, 0.0));
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let near = 0.8 * entry.curvature;
        let [here, there] =
            [entry.curvature, near].map(|curvature| interpolate(&points, curvature));
        ((here - there) / (entry.curvature - near)).abs()
    }

    /// Writes tables of kinds with their scatter, and of single filaments.
    fn listings(&self, draft: &Draft<'_>) -> Result<(), String> {
        let (mut kinds, mut filaments) = (Vec::new(), Vec::new());
        for kind in self.ensemble.kinds() {
            for &entry in &self.entries {
                kinds.push(OfKind {
                    kind,
                    entry,
                    sample: self.ensemble.sample(kind, &entry, self.table),
                    doubts: self.ensemble.doubts(kind, &[entry]),
                });
                filaments.extend(self.ensemble.points(kind, &entry).copied());
            }
        }
        draft.table(&format!("{}.csv", draft.id), &kinds, &KINDS)?;
        draft.table(
            &format!("{}_samplings.csv", draft.id),
            &filaments,
            &FILAMENTS,
        )
    }

    /// Draws the default kind with error bars, and all kinds if they were computed.
    fn pictures(&self, draft: &mut Draft<'_>) -> Result<(), String> {
        self.chart(draft, "twisted", "", self.of_default())?;
        if self.ensemble.kinds().len() == Kind::CORE.len() {
            return Ok(());
        }
        self.chart(draft, "twisted_bonds", "_bonds", self.of_kinds())
    }

    fn chart(
        &self,
        draft: &mut Draft<'_>,
        text: &str,
        suffix: &str,
        mut series: Vec<Series>,
    ) -> Result<(), String> {
        let mean = self.curve(Kind::MEAN);
        series.push(line("mean filament", palette::line(4), mean));
        for (is_reliable, label, colour) in [
            (true, "paper", palette::DATA),
            (false, "paper, unreliable", palette::LIGHT_GREY),
        ] {
            let own = self
                .entries
                .iter()
                .filter(|e| e.is_reliable() == is_reliable);
            let points = own.map(|e| (e.curvature, e.value)).collect();
            series.push(Series {
                label: Some(label.into()),
                ..dots(colour, points)
            });
        }
        let (symbol, quantity, factor) = match self.table {
            // In thousands, for short axis labels.
            Table::Rigidity => ("B3", "secant twisting rigidity B3 (1000 pN nm^2)", 1e-3),
            Table::LengthChange => ("dL/L", "relative change of length dL/L", 1.0),
        };
        let points = series.iter_mut().flat_map(|s| &mut s.points);
        points.for_each(|point| point.1 *= factor);
        let [few, many] = palette::chosen().end_names();
        let values: Values<'_> = &[
            ("symbol", &symbol),
            ("quantity", &quantity),
            ("seeds", &self.ensemble.seeds),
            ("few", &few),
            ("many", &many),
        ];
        let file = format!("{}{suffix}.svg", draft.id);
        draft.plot(file, &ChartText::new(text, values)?, series)
    }

    fn of_default(&self) -> Vec<Series> {
        let blue = palette::resolution(1.0);
        let mut series = self.bars(Kind::DEFAULT, blue);
        series.push(line(
            "sampled, mean and 2 sd",
            blue,
            self.curve(Kind::DEFAULT),
        ));
        let value = |e: &Entry| self.ensemble.value(Kind::DEFAULT, 0, e, self.table);
        let entries = self.entries.iter();
        let seed_0 = entries.filter_map(|e| Some((e.curvature, value(e)?)));
        series.push(line(
            "sampled, seed 0",
            palette::resolution(0.25),
            seed_0.collect(),
        ));
        series
    }

    fn of_kinds(&self) -> Vec<Series> {
        let pattern = Kind {
            anchors: Anchors::Identical,
            bonds: 40,
        };
        let mut series = self.bars(pattern, palette::GREY);
        series.push(line(
            "one pattern of 40",
            palette::GREY,
            self.curve(pattern),
        ));
        let mut independent: Vec<Kind> = self.ensemble.kinds();
        independent.retain(|kind| kind.anchors == Anchors::Independent);
        independent.sort_by_key(|kind| kind.bonds);
        let last = (independent.len() - 1).max(1) as f64;
        for (i, kind) in independent.into_iter().enumerate() {
            let colour = palette::resolution(i as f64 / last);
            let label = format!("{} independent", kind.bonds);
            series.push(line(label, colour, self.curve(kind)));
        }
        series
    }

    fn curve(&self, kind: Kind) -> Vec<(f64, f64)> {
        let points = self
            .entries
            .iter()
            .map(|e| (e.curvature, self.mean(kind, e)));
        points.collect()
    }

    fn bars(&self, kind: Kind, colour: Colour) -> Vec<Series> {
        let bar = |entry: &Entry| {
            let s = self.ensemble.sample(kind, entry, self.table);
            let (low, high) = (s.mean - 2.0 * s.sd(), s.mean + 2.0 * s.sd());
            let x = entry.curvature;
            let cap = |y| [(x - CAP, y), (x + CAP, y), (x, y)];
            let upper = cap(high).into_iter().rev();
            let points = cap(low).into_iter().chain(upper).collect();
            Series {
                mark: Mark::Line,
                ..dots(colour, points)
            }
        };
        self.entries.iter().map(bar).collect()
    }
}

struct OfKind {
    kind: Kind,
    entry: Entry,
    sample: SampleStatistics,
    doubts: StabilityCounts,
}

const KINDS: [Column<OfKind>; 14] = [
    ("kind", |k| k.kind.name()),
    ("direction", |k| k.entry.direction().to_owned()),
    ("phi_deg", |k| k.entry.phi_deg.to_string()),
    ("kappa3_rad_per_nm", |k| k.entry.curvature.to_string()),
    ("paper_calls_it_reliable", |k| {
        k.entry.is_reliable().to_string()
    }),
    ("paper", |k| number(k.entry.value)),
    ("mean", |k| number(k.sample.mean)),
    ("sd", |k| number(k.sample.sd())),
    ("low", |k| number(k.sample.low)),
    ("high", |k| number(k.sample.high)),
    ("samplings", |k| k.sample.count.to_string()),
    ("saddles", |k| k.doubts.saddles.to_string()),
    ("neutral", |k| k.doubts.neutral.to_string()),
    ("off_the_branch", |k| k.doubts.off_the_branch.to_string()),
];

const FILAMENTS: [Column<Sampled>; 13] = [
    ("kind", |(kind, ..)| kind.name()),
    ("seed", |(_, seed, _)| seed.to_string()),
    ("turn_deg", |(.., p)| number(p.turn_deg)),
    ("kappa3_rad_per_nm", |(.., p)| {
        number(p.curvature_rad_per_nm)
    }),
    ("torque_pn_nm", |(.., p)| number(p.torque_pn_nm)),
    ("b3", |(.., p)| number(p.rigidity_pn_nm2)),
    ("dl_over_l", |(.., p)| number(p.relative_length_change)),
    ("residual_pn", |(.., p)| {
        number(p.evidence.residual_force_pn)
    }),
    ("residual_pn_nm", |(.., p)| {
        number(p.evidence.residual_torque_pn_nm)
    }),
    ("negative_eigenvalues", |(.., p)| {
        p.evidence.certificate.negative.to_string()
    }),
    ("unresolved_eigenvalues", |(.., p)| {
        p.evidence.certificate.unresolved.to_string()
    }),
    ("saddles_left", |(.., p)| {
        p.evidence.saddles_left.to_string()
    }),
    ("jumps", |(.., p)| p.evidence.jumps.to_string()),
];

fn interpolate(points: &[(f64, f64)], x: f64) -> f64 {
    let pair = points.windows(2).find(|w| w[0].0 <= x && x <= w[1].0);
    pair.map_or(f64::NAN, |w| {
        let t = (x - w[0].0) / (w[1].0 - w[0].0);
        w[0].1 + t * (w[1].1 - w[0].1)
    })
}

fn short(value: f64) -> String {
    if value.abs() >= 0.1 {
        format!("{value:.0}")
    } else {
        format!("{value:.1e}")
    }
}
