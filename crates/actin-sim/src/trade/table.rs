//! Trades as tables.

use super::{Candidate, Trade};
use std::fmt;

const MOST_COLUMNS: usize = 8;

const NAME: usize = 60;

/// Smallest width of a column of errors.
const ERROR: usize = 13;

impl Trade {
    /// Returns the candidates as CSV with one row each.
    ///
    /// Columns are name, bodies, time, speed-up, and the error of each item. The largest error at the loads of the scene and
    /// the largest at all loads follow, then a mark of the best candidate and the reason for a missing result.
    ///
    /// # Panics
    /// Never: the CSV is written into memory.
    pub fn to_csv(&self) -> String {
        let mut table = csv::Writer::from_writer(Vec::new());
        let mut header: Vec<String> = ["candidate", "monomers", "segments", "wall_s", "faster"]
            .map(str::to_owned)
            .into();
        header.extend(self.items.iter().map(|item| format!("{} error", item.name)));
        let last = [
            "error",
            "error_at_all_loads",
            "is_best",
            "failure",
            "other_state_error",
        ];
        header.extend(last.map(str::to_owned));
        let rows = (0..self.candidates.len()).map(|i| self.row(i));
        for row in std::iter::once(header).chain(rows) {
            table.write_record(row).expect("memory takes it");
        }
        let bytes = table.into_inner().expect("memory takes it");
        String::from_utf8(bytes).expect("names and numbers are UTF-8")
    }

    fn row(&self, i: usize) -> Vec<String> {
        let candidate = &self.candidates[i];
        let number = |x: f64| format!("{x:?}");
        let mut row = vec![
            candidate.name.clone(),
            candidate.counts.monomers.to_string(),
            candidate.counts.segments.to_string(),
            number(candidate.wall_s),
            number(self.usual_s() / candidate.wall_s),
        ];
        let other_state = candidate.other_state;
        let errors = (0..self.items.len()).map(|k| candidate.errors.get(k).copied().flatten());
        row.extend(errors.map(|error| error.map_or_else(String::new, number)));
        row.extend([
            number(candidate.error()),
            number(candidate.worst_error()),
            (self.best == Some(i)).to_string(),
            candidate.failure.clone().unwrap_or_default(),
            other_state.map_or_else(String::new, |state| number(state.error)),
        ]);
        row
    }
}

/// Formats the table for a terminal: one row for each candidate with its errors in per cent, and the exclusions.
impl fmt::Display for Trade {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_reference(f)?;
        write!(f, "{:NAME$}{:>9}{:>8}", "errors in %", "time", "faster")?;
        let columns = self.columns();
        for (name, _) in &columns {
            write!(f, "{name:>0$}", width(name))?;
        }
        writeln!(f, "   worst")?;
        for (i, candidate) in self.candidates.iter().enumerate() {
            self.write_candidate(f, candidate, (&columns, self.best == Some(i)))?;
        }
        if let Some(scatter) = &self.scatter {
            write!(
                f,
                "{:NAME$}{:17}",
                "scatter of filaments with 64 sampled bonds", ""
            )?;
            write_errors(f, &columns, (scatter, &[]))?;
            writeln!(f)?;
        }
        for left in &self.left_out {
            writeln!(f, "not compared: {left}")?;
        }
        let [ladder, all] = self.runs_of_reference;
        writeln!(
            f,
            "run time in units of the reference: {ladder:.1} for the reference and the candidates, {all:.1} with other \
             loads and sampled bonds"
        )?;
        let best = self.best.map(|best| self.candidates[best].name.as_str());
        let wanted = 100.0 * self.options.error;
        write!(
            f,
            "cheapest within {wanted} %: {}",
            best.unwrap_or("the reference itself")
        )
    }
}

impl Trade {
    fn write_reference(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let reference = &self.reference;
        writeln!(
            f,
            "reference: {}: {} monomers, {} segments, {}",
            reference.name,
            reference.counts.monomers,
            reference.counts.segments,
            time(reference.wall_s)
        )?;
        if !reference.is_settled {
            write!(
                f,
                "warning: the error of the reference itself is unknown or exceeds a third of the wanted error:"
            )?;
            write_errors(f, &self.columns(), (&reference.own_errors, &[]))?;
            writeln!(f)?;
        }
        Ok(())
    }

    /// Returns the columns of the table: one for each item, or one for each quantity if there are many items.
    fn columns(&self) -> Vec<Column> {
        let items = self.items.iter().enumerate();
        if self.items.len() <= MOST_COLUMNS {
            return items
                .map(|(i, item)| (item.name.clone(), vec![i]))
                .collect();
        }
        let mut columns: Vec<Column> = Vec::new();
        for (i, item) in items {
            let name = item.measure.to_string();
            match columns.iter_mut().find(|column| column.0 == name) {
                Some(column) => column.1.push(i),
                None => columns.push((name, vec![i])),
            }
        }
        columns
    }

    fn write_candidate(
        &self,
        f: &mut fmt::Formatter<'_>,
        one: &Candidate,
        (columns, is_best): (&[Column], bool),
    ) -> fmt::Result {
        let name = &one.name;
        if let Some(failure) = &one.failure {
            return writeln!(f, "{name:NAME$} no result: {failure}");
        }
        let faster = self.usual_s() / one.wall_s;
        write!(f, "{name:NAME$}{:>9}{faster:>8.2}", time(one.wall_s))?;
        write_errors(f, columns, (&one.errors, &one.standard_errors))?;
        write!(f, "   {:.2}", 100.0 * one.error())?;
        for (share, error) in &one.at_loads {
            write!(f, ", {:.2} at {share} of the loads", 100.0 * error)?;
        }
        if let Some(state) = one.other_state {
            write!(
                f,
                ", another stable state ({:.2} % from the one {:+.3} pN nm above the reference)",
                100.0 * state.error,
                state.above_reference_pn_nm
            )?;
        }
        writeln!(f, "{}", if is_best { "  <- cheapest" } else { "" })
    }
}

/// Column name and indices of the items; the column shows the largest error of these items.
type Column = (String, Vec<usize>);

fn shown(
    columns: &[Column],
    errors: &[Option<f64>],
    standard_errors: &[f64],
) -> Vec<Option<(f64, f64)>> {
    let standard = |i: usize| standard_errors.get(i).copied().unwrap_or_default();
    let of = |i: &usize| {
        errors
            .get(*i)
            .copied()
            .flatten()
            .map(|error| (error, standard(*i)))
    };
    let worst = |items: &Vec<usize>| {
        let all: Option<Vec<(f64, f64)>> = items.iter().map(of).collect();
        all?.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))
    };
    columns.iter().map(|(_, items)| worst(items)).collect()
}

/// Width of a column: one space and its name, or an error.
fn width(name: &str) -> usize {
    ERROR.max(name.len() + 1)
}

fn write_errors(
    f: &mut fmt::Formatter<'_>,
    columns: &[Column],
    (errors, standard_errors): (&[Option<f64>], &[f64]),
) -> fmt::Result {
    let shown = shown(columns, errors, standard_errors);
    let mut cells = columns.iter().zip(shown);
    cells.try_for_each(|((name, _), error)| {
        let text = match error {
            Some((error, standard)) if standard > 0.0 => {
                format!("{:.1} +- {:.1}", 100.0 * error, 100.0 * standard)
            }
            Some((error, _)) => format!("{:.2}", 100.0 * error),
            None => "-".to_owned(),
        };
        write!(f, "{text:>0$}", width(name))
    })
}

fn time(seconds: f64) -> String {
    if seconds < 1.0 {
        format!("{:.1} ms", 1e3 * seconds)
    } else {
        format!("{seconds:.2} s")
    }
}
