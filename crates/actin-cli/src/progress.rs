//! A progress bar on a terminal, nothing elsewhere.

use actin_sim::At;
use indicatif::{ProgressBar, ProgressStyle};

/// Steps by which the bar counts simulated time: thousandths of the duration.
const TICKS: u64 = 1000;

/// Progress through simulated time.
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar; indicatif hides it where standard error is no terminal.
    pub(crate) fn new() -> Self {
        let bar = ProgressBar::new(TICKS);
        let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  remaining {eta}")
            .expect("the template names known fields only");
        bar.set_style(style);
        Self { bar }
    }

    /// Shows how far the run is.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share between 0 and 1 of a thousand ticks"
    )]
    pub(crate) fn show(&self, at: &actin_sim::Progress, steps_per_s: f64) {
        let share = (at.at.value() / at.end).clamp(0.0, 1.0);
        let unit = match at.at {
            At::Time(_) => "ns",
            At::Path(_) => "stages",
        };
        self.bar.set_position((share * TICKS as f64) as u64);
        self.bar.set_message(format!(
            "{:.2} of {:.0} {unit}, {steps_per_s:.0} steps/s, residual {:.1e} pN",
            at.at.value(),
            at.end,
            at.residual_force_pn
        ));
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// A bar of pictures; indicatif hides it where standard error is no terminal.
pub(crate) fn pictures(count: usize) -> ProgressBar {
    let bar = ProgressBar::new(count as u64);
    let style = ProgressStyle::with_template("{bar:32} {pos} of {len} pictures  remaining {eta}")
        .expect("the template names known fields only");
    bar.set_style(style);
    bar
}

/// A line that says what runs.
pub(crate) fn spinner() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    bar.enable_steady_tick(std::time::Duration::from_millis(200));
    bar
}
