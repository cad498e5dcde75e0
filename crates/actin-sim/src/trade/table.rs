//! A trade as a table.

use super::{Candidate, Trade};
use std::fmt;

/// Width of the column of names.
const NAME: usize = 60;

impl Trade {
    /// The candidates as CSV: name, bodies, time, the error of each item, the largest at the loads of the scene and at
    /// all that were tried, whether it is the best, and why it has no result.
    ///
    /// # Panics
    /// Never: it is written into memory.
    pub fn to_csv(&self) -> String {
        let mut table = csv::Writer::from_writer(Vec::new());
        let mut header: Vec<String> = ["candidate", "monomers", "segments", "wall_s", "faster"]
            .map(str::to_owned)
            .into();
        header.extend(self.items.iter().map(|item| format!("{} error", item.name)));
        header.extend(["error", "error_at_all_loads", "is_best", "failure"].map(str::to_owned));
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
        let errors = (0..self.items.len()).map(|k| candidate.errors.get(k).copied().flatten());
        row.extend(errors.map(|error| error.map_or_else(String::new, number)));
        row.extend([
            number(candidate.error()),
            number(candidate.worst_error()),
            (self.best == Some(i)).to_string(),
            candidate.failure.clone().unwrap_or_default(),
        ]);
        row
    }
}

/// As on a terminal: a row for each candidate with its errors in per cent, and what is not compared.
impl fmt::Display for Trade {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_reference(f)?;
        write!(f, "{:NAME$}{:>9}{:>8}", "errors in %", "time", "faster")?;
        for item in &self.items {
            write!(f, "{:>13.12}", item.name)?;
        }
        writeln!(f, "   worst")?;
        for (i, candidate) in self.candidates.iter().enumerate() {
            self.write_candidate(f, candidate, self.best == Some(i))?;
        }
        if let Some(scatter) = &self.scatter {
            write!(
                f,
                "{:NAME$}{:17}",
                "filaments of 64 drawn bonds scatter by", ""
            )?;
            write_errors(f, scatter, &[])?;
            writeln!(f)?;
        }
        for left in &self.left_out {
            writeln!(f, "not compared: {left}")?;
        }
        let [ladder, all] = self.runs_of_reference;
        writeln!(
            f,
            "time of the candidates and the reference: {ladder:.1} times that of the reference; with other loads and \
             drawn bonds: {all:.1}"
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
                "warning: the reference is itself off by more than a third of the wanted error:"
            )?;
            write_errors(f, &reference.own_errors, &[])?;
            writeln!(f)?;
        }
        Ok(())
    }

    fn write_candidate(
        &self,
        f: &mut fmt::Formatter<'_>,
        one: &Candidate,
        is_best: bool,
    ) -> fmt::Result {
        let name = &one.name;
        if let Some(failure) = &one.failure {
            return writeln!(f, "{name:NAME$} no result: {failure}");
        }
        let faster = self.usual_s() / one.wall_s;
        write!(f, "{name:NAME$}{:>9}{faster:>8.2}", time(one.wall_s))?;
        write_errors(f, &one.errors, &one.standard_errors)?;
        write!(f, "   {:.2}", 100.0 * one.error())?;
        for (share, error) in &one.at_loads {
            write!(f, ", {:.2} at {share} of the loads", 100.0 * error)?;
        }
        writeln!(f, "{}", if is_best { "  <- cheapest" } else { "" })
    }
}

fn write_errors(
    f: &mut fmt::Formatter<'_>,
    errors: &[Option<f64>],
    standard_errors: &[f64],
) -> fmt::Result {
    let standard = standard_errors
        .iter()
        .copied()
        .chain(std::iter::repeat(0.0));
    errors
        .iter()
        .zip(standard)
        .try_for_each(|(error, standard)| match error {
            Some(error) if standard > 0.0 => {
                let both = format!("{:.1} +- {:.1}", 100.0 * error, 100.0 * standard);
                write!(f, "{both:>13}")
            }
            Some(error) => write!(f, "{:>13.2}", 100.0 * error),
            None => write!(f, "{:>13}", "-"),
        })
}

fn time(seconds: f64) -> String {
    if seconds < 1.0 {
        format!("{:.1} ms", 1e3 * seconds)
    } else {
        format!("{seconds:.2} s")
    }
}
