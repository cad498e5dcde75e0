//! Progress bars, shown on a terminal only.

use actin_sim::At;
use indicatif::{ProgressBar, ProgressStyle};

/// Resolution of the bar: thousandths of the duration.
const TICKS: u64 = 1000;

pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// Creates a bar, which is hidden if standard error is not a terminal.
    pub(crate) fn new() -> Self {
        let bar = ProgressBar::new(TICKS);
        let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  remaining {eta}")
            .expect("the template names known fields only");
        bar.set_style(style);
        Self { bar }
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
        self.bar.set_position((share * TICKS as f64) as u64);
        self.bar.set_message(format!(
            "{:.2} of {:.0} {unit}, {steps_per_s:.0} steps/s, residual {:.1e} pN",
            at.at.value(),
            at.end,
            at.residual_force_pn
        ));
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
