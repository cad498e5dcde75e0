//! Progress bar of an artefact on a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

#[derive(Debug)]
pub(super) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    pub(super) fn new(id: &'static str) -> Self {
        let style = ProgressStyle::with_template("{prefix:7} {bar:32} {pos}/{len} runs, {elapsed}")
            .expect("the template of the progress bar is well formed");
        let bar = ProgressBar::new(0).with_style(style).with_prefix(id);
        bar.enable_steady_tick(Duration::from_secs(1));
        Self { bar }
    }

    pub(super) fn expect(&self, runs: usize) {
        self.bar.inc_length(runs as u64);
    }

    pub(super) fn done(&self) {
        self.bar.inc(1);
    }

    /// Removes the bar. Returns the number of runs.
    pub(super) fn finish(self) -> u64 {
        self.bar.finish_and_clear();
        self.bar.position()
    }
}
