//! Estimate of the memory of a scene before allocation, and the memory of the machine.

use crate::scene::{ForceLaw, RodLaw, RodModel, SceneProblem, Task};
use std::fs;
use std::sync::OnceLock;

/// Memory of the machine if the system does not report it (bytes).
const ASSUMED: f64 = 8e9;

/// Bytes per body or element during `Dynamics` and during an equilibrium.
///
/// Values are rounded up from the peak memory of `actin run` over the number of bodies, for 1e4 to
/// 1e5 segments, 5000 to 20,000 filaments and 3000 to 6000 monomers.
#[derive(Clone, Copy, Debug)]
struct BytesPerBody {
    motion: f64,
    statics: f64,
}

const FILAMENT: BytesPerBody = BytesPerBody {
    motion: 1.2e4,
    statics: 1.2e4,
};
/// Segment of constant rigidities with its node: state, loads, trial motions, matrix pattern and
/// factor.
const SEGMENT: BytesPerBody = BytesPerBody {
    motion: 1.5e3,
    statics: 6.6e3,
};
const LAW_SEGMENT: BytesPerBody = BytesPerBody {
    motion: 2.2e3,
    statics: 1.2e4,
};
/// Additional trial motions of nonconservative loads, all of which are kept.
const TRIAL_VECTORS: f64 = (6 * 8 * actin_integrate::KRYLOV_VECTORS) as f64;
const MONOMER: BytesPerBody = BytesPerBody {
    motion: 1.8e3,
    statics: 1.9e4,
};
/// Bond: two ends and a rest length.
const BOND: f64 = 56.0;

/// Memory of `Brownian` relative to statics: the second stepper, which checks the length of steps, and the assembly of its
/// matrix. Measured for 1000 to 10,000 linked filaments of ten segments.
const OF_WATER: f64 = 2.75;

impl BytesPerBody {
    fn of(self, task: &Task) -> f64 {
        match task {
            Task::Dynamics(_) => self.motion,
            Task::Equilibrium(_) => self.statics,
            Task::Brownian(_) => OF_WATER * self.statics,
        }
    }
}

pub(crate) fn of_filament(task: &Task) -> f64 {
    FILAMENT.of(task)
}

pub(crate) fn of_segments(count: f64, rod: &RodModel, task: &Task) -> f64 {
    let each = match rod.law {
        RodLaw::Constant => SEGMENT,
        _ => LAW_SEGMENT,
    };
    let trials = match (rod.force_law, task) {
        (ForceLaw::PaperBalance, Task::Dynamics(_)) => TRIAL_VECTORS,
        _ => 0.0,
    };
    count * (each.of(task) + trials)
}

pub(crate) fn of_monomers(count: f64, bonds: usize, task: &Task) -> f64 {
    count * (MONOMER.of(task) + BOND * bonds as f64)
}

/// Refuses `bytes` beyond the memory of the machine. `what` returns the start of the message,
/// before the estimate.
///
/// # Errors
/// Names `key` and its value.
pub fn check(
    bytes: f64,
    (key, value): (&str, String),
    what: impl FnOnce() -> String,
) -> Result<(), SceneProblem> {
    let machine = machine();
    if bytes <= machine.unwrap_or(ASSUMED) {
        return Ok(());
    }
    let there_is = machine.map_or_else(
        || format!("the assumed {}", in_words(ASSUMED)),
        |bytes| format!("the {} of this machine", in_words(bytes)),
    );
    let (what, need) = (what(), in_words(bytes));
    let rule = format!("{what} about {need} of memory, more than {there_is}");
    Err(SceneProblem::new(key, value, rule))
}

/// Returns a number of bytes with its unit.
pub fn in_words(bytes: f64) -> String {
    match bytes {
        b if b < 1e9 => format!("{:.0} MB", (b / 1e6).max(1.0)),
        b if b < 1e10 => format!("{:.1} GB", b / 1e9),
        b if b < 1e13 => format!("{:.0} GB", b / 1e9),
        b => format!("{:.1e} GB", b / 1e9),
    }
}

/// Memory of the machine or limit of its control group (bytes); `None` if the system does not
/// report it.
fn machine() -> Option<f64> {
    static BYTES: OnceLock<Option<f64>> = OnceLock::new();
    *BYTES.get_or_init(|| {
        let total = total(&fs::read_to_string("/proc/meminfo").ok()?)?;
        let limits = [
            "/sys/fs/cgroup/memory.max",
            "/sys/fs/cgroup/memory/memory.limit_in_bytes",
        ];
        let limits = limits.into_iter().filter_map(|path| {
            let text = fs::read_to_string(path).ok()?;
            text.trim().parse::<f64>().ok()
        });
        Some(limits.fold(total, f64::min))
    })
}

/// Total of `/proc/meminfo` (bytes).
fn total(meminfo: &str) -> Option<f64> {
    let line = meminfo.lines().find_map(|l| l.strip_prefix("MemTotal:"))?;
    let kibibytes: f64 = line.trim().strip_suffix(" kB")?.parse().ok()?;
    Some(kibibytes * 1024.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_total_is_read() {
        let text = "MemTotal:       24623104 kB\nMemFree:        1 kB\n";
        assert_eq!(total(text), Some(24_623_104.0 * 1024.0));
        assert_eq!(total("MemFree: 1 kB"), None);
        assert_eq!(total("MemTotal: 5 pages"), None);
    }

    #[test]
    fn amounts_in_words() {
        let words = [3e5, 145e6, 2.4e9, 24e9, 1.5e15].map(in_words);
        assert_eq!(words, ["1 MB", "145 MB", "2.4 GB", "24 GB", "1.5e6 GB"]);
    }

    #[test]
    fn a_refusal_tells_the_estimate() {
        let asked = |bytes| check(bytes, ("a.key", "7".into()), || "these need".into());
        assert!(asked(1e6).is_ok());
        let message = asked(1.5e20).unwrap_err().to_string();
        let expected = "a.key = 7: these need about 1.5e11 GB of memory, more than the ";
        assert!(message.starts_with(expected), "{message}");
    }
}
