//! Progress bars, shown on a terminal only; elsewhere runs print a line from time to time.

use actin_sim::At;
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::Cell;
use std::time::{Duration, Instant};

/// Resolution of the bar: thousandths of the duration.
const TICKS: u64 = 1000;

/// Time between lines of progress without a bar.
const BETWEEN_LINES: Duration = Duration::from_mins(1);

pub(crate) struct Progress {
    bar: ProgressBar,
    last_line: Cell<Instant>,
}

impl Progress {
    /// Creates a bar. If standard error is not a terminal, there is a line per minute instead.
    pub(crate) fn new() -> Self {
        let bar = ProgressBar::new(TICKS);
        let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  remaining {eta}")
            .expect("the template names known fields only");
        bar.set_style(style);
        Self {
            bar,
            last_line: Cell::new(Instant::now()),
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the position is between 0 and 1000"
    )]
    pub(crate) fn show(&self, at: &actin_sim::Progress, steps_per_s: f64) {
        let share = (at.at.value() / at.end).clamp(0.0, 1.0);
        let unit = match at.at {
            At::Time(_) => "ns",
            At::Path(_) => "stages",
        };
        let message = format!(
            "{:.2} of {:.0} {unit}, {steps_per_s:.0} steps/s, residual {:.1e} pN",
            at.at.value(),
            at.end,
            at.residual_force_pn
        );
        if self.bar.is_hidden() && self.last_line.get().elapsed() >= BETWEEN_LINES {
            eprintln!("{:3.0} %  {message}", 100.0 * share);
            self.last_line.set(Instant::now());
        }
        self.bar.set_position((share * TICKS as f64) as u64);
        self.bar.set_message(message);
    }

    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

pub(crate) fn pictures(count: usize) -> ProgressBar {
    let bar = ProgressBar::new(count as u64);
    let style = ProgressStyle::with_template("{bar:32} {pos} of {len} pictures  remaining {eta}")
        .expect("the template names known fields only");
    bar.set_style(style);
    bar
}

pub(crate) fn spinner() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    bar.enable_steady_tick(std::time::Duration::from_millis(200));
    bar
}
