//! Runs that are killed repeatedly end with the files of an undisturbed run.

use super::common::files;
use super::program::{self, Ending};
use super::spoil::between;
use super::{Case, Tally, scenes};
use std::fs;
use std::path::Path;
use std::time::Duration;

const MOST_KILLS: u32 = 200;

const UNDISTURBED: Duration = Duration::from_mins(5);

/// Kills a run, on one to four threads, at random times until it is done. Its files must equal those of an
/// undisturbed run.
pub(super) fn kill(case: &mut Case<'_>) -> Result<Tally, String> {
    let length = whole(case)?;
    let (mut kills, mut survived) = (0, 0);
    loop {
        let has_checkpoint = case.folder.join("a/checkpoint.bin").exists();
        let go_on = if has_checkpoint {
            "--resume"
        } else {
            "--overwrite"
        };
        let threads = 1 + kills % 4;
        let mut started = program::start(case.folder, &arguments("a", go_on), threads)?;
        // The time between kills grows, so that a run on a busy machine advances.
        let factor = f64::from(1 + kills / 8);
        let patience = factor * between(&mut case.random, 0.01, 0.5) * length.as_secs_f64();
        if started.wait(Duration::from_secs_f64(patience))? {
            let ending = started.ending(false)?;
            same(case.folder, "a", &ending)?;
            return Ok(Tally::from([
                ("kills", u64::from(kills)),
                ("of them with a checkpoint", survived),
            ]));
        }
        started.kill()?;
        kills += 1;
        survived += u64::from(case.folder.join("a/checkpoint.bin").exists());
        if kills > MOST_KILLS {
            return Err(format!("not done after {kills} kills"));
        }
    }
}

fn whole(case: &mut Case<'_>) -> Result<Duration, String> {
    let text = scenes::long(&mut case.random);
    fs::write(case.folder.join("scene.ron"), text).map_err(|e| e.to_string())?;
    let clock = std::time::Instant::now();
    let ending = program::finish(case.folder, &arguments("whole", "--overwrite"), UNDISTURBED)?;
    match ending.code {
        Some(0) => Ok(clock.elapsed()),
        _ => Err(format!("undisturbed: {ending:?}")),
    }
}

fn arguments<'a>(out: &'a str, go_on: &'a str) -> [&'a str; 7] {
    [
        "run",
        "scene.ron",
        "--out",
        out,
        "--checkpoint-every",
        "0.01",
        go_on,
    ]
}

fn same(folder: &Path, name: &str, ending: &Ending) -> Result<(), String> {
    if ending.code != Some(0) {
        return Err(format!("{ending:?}"));
    }
    same_files(&folder.join("whole"), &folder.join(name))
}

fn same_files(one: &Path, other: &Path) -> Result<(), String> {
    let [one, other] = [one, other].map(|folder| {
        let mut files = files(folder);
        files.retain(|(name, _)| !name.starts_with('.'));
        files
    });
    if let Some((a, _)) = one.iter().zip(&other).find(|(a, b)| a != b) {
        return Err(format!("{} differs", a.0));
    }
    if one.len() == other.len() {
        return Ok(());
    }
    Err(format!("{} files against {}", one.len(), other.len()))
}
