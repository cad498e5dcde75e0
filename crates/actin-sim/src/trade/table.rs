//! A trade as a table.

use super::Trade;

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
