//! `actin view`: a page or a film of a run.

use crate::failure::Failure;
use crate::progress;
use actin_view::{Film, Limits, Palette, Run, is_page};
use std::fs;
use std::io::Write;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

#[derive(Debug, clap::Args)]
pub(crate) struct ViewArguments {
    /// Run directory of a finished, running or interrupted run.
    directory: PathBuf,
    /// HTML file to write; by default `view.html` in the run directory. An existing file is replaced only if it was
    /// written by `actin view`.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Opens the page in the browser.
    #[arg(long)]
    open: bool,
    /// Writes pictures 00001.png, 00002.png, ... into this new or empty folder instead of a page.
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["out", "open"])]
    film: Option<PathBuf>,
    /// Width and height of the pictures in pixels, at most 8192 each.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size, requires = "film")]
    size: [usize; 2],
    /// Total rotation of the camera during the film. If not zero, the film has at least 120 pictures by default.
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 0.0,
        requires = "film",
        allow_negative_numbers = true
    )]
    turn: f64,
    /// Number of pictures; by default the number of records. Records are repeated or skipped to fit.
    #[arg(long, value_name = "N", requires = "film")]
    pictures: Option<NonZero<usize>>,
}

/// Largest width and height of a picture, in pixels.
const WIDEST: usize = 8192;
/// Smallest default number of pictures of a film with a rotating camera.
const OF_A_TURN: usize = 120;

fn size(text: &str) -> Result<[usize; 2], String> {
    let sides = text.split_once('x').ok_or("not WxH, as in 1280x720")?;
    let side = |text: &str| match text.parse() {
        Ok(side) if (16..=WIDEST).contains(&side) => Ok(side),
        _ => Err(format!(
            "{text:?}: each side is a whole number from 16 to {WIDEST}"
        )),
    };
    Ok([side(sides.0)?, side(sides.1)?])
}

pub(crate) fn view(arguments: &ViewArguments) -> Result<(), Failure> {
    let run = Run::open(&arguments.directory, Limits::default());
    let run = run.map_err(|error| Failure::Input(error.to_string()))?;
    for remark in run.remarks() {
        println!("{remark}");
    }
    match &arguments.film {
        Some(folder) => film(arguments, &run, folder),
        None if run.has_changing_resolution() => {
            let place = arguments.directory.display();
            Err(Failure::Input(format!(
                "{place}: the resolution of this run changes with time, and a page shows one resolution only: \
                 use --film FOLDER for the whole run, or actin view {place}/stretches/0000 for one stretch"
            )))
        }
        None => page(arguments, &run),
    }
}

fn film(arguments: &ViewArguments, run: &Run, folder: &Path) -> Result<(), Failure> {
    let refused = |reason: &str| Failure::Input(format!("{}: {reason}", folder.display()));
    let is_empty = match fs::read_dir(folder) {
        Ok(mut entries) => entries.next().is_none(),
        Err(error) if folder.exists() => return Err(refused(&error.to_string())),
        Err(_) => true,
    };
    if !is_empty {
        return Err(refused(
            "is not empty: pictures are never overwritten; name another folder",
        ));
    }
    if !arguments.turn.is_finite() {
        return Err(Failure::Input("--turn: must be a finite number".into()));
    }
    let least = if arguments.turn == 0.0 { 0 } else { OF_A_TURN };
    let film = Film {
        size: arguments.size,
        pictures: Some(match arguments.pictures {
            Some(number) => number.get(),
            None => Film::default().count(run).max(least),
        }),
        turn: arguments.turn.to_radians(),
        ..Film::default()
    };
    let bar = progress::pictures(film.count(run));
    let written = film.write(run, folder, &|ready| bar.set_position(ready as u64));
    bar.finish_and_clear();
    written.map_err(|error| Failure::Unwritten(format!("{}: {error}", folder.display())))?;
    println!(
        "{} picture(s) written to {}",
        film.count(run),
        folder.display()
    );
    Ok(())
}

fn page(arguments: &ViewArguments, run: &Run) -> Result<(), Failure> {
    let out = arguments.out.clone();
    let out = out.unwrap_or_else(|| arguments.directory.join("view.html"));
    refuse_foreign(&out)?;
    let page = run.page(Palette::default());
    let unfinished = out.with_extension("html.unfinished");
    let written =
        actin_rundir::replace_file(&out, &unfinished, |file| file.write_all(page.as_bytes()));
    written.map_err(|error| Failure::Unwritten(format!("{}: {error}", out.display())))?;
    let (shown, all) = run.shown();
    println!(
        "{shown} of {all} records, {:.1} MB",
        1e-6 * page.len() as f64
    );
    println!("written to {}", out.display());
    if arguments.open {
        open(&out)?;
    }
    Ok(())
}

fn refuse_foreign(out: &Path) -> Result<(), Failure> {
    let refused = |reason: String| Err(Failure::Input(format!("{}: {reason}", out.display())));
    match fs::symlink_metadata(out) {
        Err(_) => return Ok(()),
        Ok(data) if !data.is_file() => {
            return refused("not a regular file; name another file".into());
        }
        Ok(_) => {}
    }
    match fs::read(out) {
        Ok(bytes) if is_page(&bytes) => Ok(()),
        Ok(_) => refused("exists and was not written by actin view; name another file".into()),
        Err(error) => refused(error.to_string()),
    }
}

fn open(page: &Path) -> Result<(), Failure> {
    let program = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(target_os = "windows") {
        "explorer"
    } else {
        "xdg-open"
    };
    let mut command = Command::new(program);
    command
        .arg(page)
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    let opened = command.spawn().map(drop);
    opened
        .map_err(|error| Failure::Input(format!("--open: {program}: {error}; the page is written")))
}
