//! How far an artefact is: a line on a terminal that counts its runs, nothing otherwise.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// Counts the runs of an artefact; threads share it.
#[derive(Debug)]
pub(super) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// No run yet of the artefact `id`.
    pub(super) fn new(id: &'static str) -> Self {
        let style = ProgressStyle::with_template("{prefix:7} {bar:32} {pos}/{len} runs, {elapsed}")
            .expect("the template is well formed");
        let bar = ProgressBar::new(0).with_style(style).with_prefix(id);
        bar.enable_steady_tick(Duration::from_secs(1));
        Self { bar }
    }

    /// So many further runs are to be done.
    pub(super) fn expect(&self, runs: usize) {
        self.bar.inc_length(runs as u64);
    }

    /// One run is done.
    pub(super) fn done(&self) {
        self.bar.inc(1);
    }

    /// Takes the line away; the number of runs.
    pub(super) fn finish(self) -> u64 {
        self.bar.finish_and_clear();
        self.bar.position()
    }
}
