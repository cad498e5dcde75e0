//! Tests of the cache with cheap experiments.

use super::*;
use actin_draw::report::{Picture, save};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

const SILENT: ProgressSink<'static> = &|_| ();

#[test]
fn every_artefact_has_a_title() {
    for experiment in EXPERIMENTS {
        assert!(texts::title(experiment.0).is_ok(), "{}", experiment.0);
    }
}

static FOLDERS: AtomicUsize = AtomicUsize::new(0);

struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
        let name = format!("actin-figures-{}-{number}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Experiment with one picture and one table.
fn drawn(draft: &mut Draft<'_>) -> Result<(), String> {
    let (id, out) = (draft.id, draft.out);
    let file = format!("{id}.svg");
    save(out, &file, "<svg/>")?;
    save(out, &format!("{id}.csv"), "a,b\n")?;
    draft.settings = "seeds 0 to 3".into();
    // Checks that numbers are restored exactly.
    draft.row("third", "nm", 1.0 / 3.0, "");
    draft.pictures.push(Picture {
        file,
        caption: "Seen".into(),
    });
    Ok(())
}

fn one(draft: &mut Draft<'_>) -> Result<(), String> {
    draft.attempt(&[1, 2, 3], |_| ());
    drawn(draft)
}

const BOTH: [Experiment; 2] = [("fig1", one), ("fig2", drawn)];

fn options(out: &Path) -> Options {
    Options {
        ids: Vec::new(),
        out: out.to_path_buf(),
        quick: true,
        threads: None,
        fresh: false,
        print: false,
        palette: Palette::default(),
    }
}

fn reasons(options: &Options, fingerprint: &str) -> [Option<String>; 2] {
    let cache = Cache::new(&options.out, fingerprint.to_owned()).unwrap();
    BOTH.map(|e| artefact(&e, &cache, options, SILENT).unwrap().1)
}

#[test]
fn cached_artefacts_are_restored_exactly() {
    let folder = Folder::new();
    let options = options(&folder.0);
    let first = artefacts(&BOTH, &options, SILENT).unwrap();
    let again = artefacts(&BOTH, &options, SILENT).unwrap();
    assert_eq!(first, again);
    let outdated = "program, scenes or settings have changed".to_owned();
    assert_eq!(reasons(&options, "other")[0], Some(outdated));
    assert_eq!(reasons(&options, "other"), [None, None]);
    let cache = Cache::new(&folder.0, "other".into()).unwrap();
    assert_eq!(cache.find("fig1").unwrap().runs, 3);
}

/// Cases: missing picture, changed table, broken record, explicit request.
#[test]
fn only_invalid_artefacts_are_recomputed() {
    let folder = Folder::new();
    let out = folder.0.as_path();
    let options = options(out);
    let all = || reasons(&options, "same");
    let because = |reason: &str| Some(reason.to_owned());
    assert_eq!(
        all(),
        [
            because("not computed before"),
            because("not computed before")
        ]
    );
    fs::remove_file(out.join("fig1.svg")).unwrap();
    assert_eq!(all(), [because("fig1.svg is missing"), None]);
    fs::write(out.join("fig2.csv"), "a,c\n").unwrap();
    assert_eq!(all(), [None, because("fig2.csv has been changed")]);
    let record = out.join(".artefacts").join("fig2.json");
    let text = fs::read_to_string(&record).unwrap();
    fs::write(&record, &text[..text.len() / 2]).unwrap();
    assert!(
        all()[1]
            .as_ref()
            .unwrap()
            .starts_with("its record cannot be read: ")
    );
    assert_eq!(all(), [None, None]);
    let fresh = Options {
        fresh: true,
        print: false,
        ..options.clone()
    };
    let requested = || because("recomputation requested");
    assert_eq!(reasons(&fresh, "same"), [requested(), requested()]);
}

static FAILS: AtomicBool = AtomicBool::new(true);

/// Experiment that writes a file and fails in its first call only.
fn stops(draft: &mut Draft<'_>) -> Result<(), String> {
    save(draft.out, "half.csv", "a")?;
    if FAILS.swap(false, Ordering::Relaxed) {
        return Err("stopped".into());
    }
    drawn(draft)
}

/// Files of an unfinished artefact are discarded; finished artefacts are kept.
#[test]
fn interrupted_command_is_continued() {
    let folder = Folder::new();
    let options = options(&folder.0);
    let experiments = [BOTH[0], ("fig2", stops)];
    assert_eq!(
        artefacts(&experiments, &options, SILENT).unwrap_err(),
        "stopped"
    );
    let names = || -> BTreeSet<String> {
        let entries = fs::read_dir(&folder.0).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
        names.collect()
    };
    let finished = [".artefacts", "fig1.csv", "fig1.svg"];
    assert!(names().iter().eq(finished), "{:?}", names());
    let cache = Cache::new(&folder.0, cache::fingerprint(&options.choices()).unwrap()).unwrap();
    let again = experiments.map(|e| artefact(&e, &cache, &options, SILENT).unwrap().1);
    assert_eq!(again, [None, Some("not computed before".to_owned())]);
    assert!(names().contains("fig2.svg"));
}

#[test]
fn fingerprint_depends_on_options_that_affect_results() {
    let quick = options(Path::new("a"));
    let full = Options {
        quick: false,
        ..quick.clone()
    };
    let elsewhere = Options {
        out: "b".into(),
        threads: Some(1),
        ..quick.clone()
    };
    let of = |options: &Options| cache::fingerprint(&options.choices()).unwrap();
    assert_ne!(of(&quick), of(&full));
    assert_eq!(of(&quick), of(&elsewhere));
}
