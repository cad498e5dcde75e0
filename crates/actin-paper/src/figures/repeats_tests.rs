//! The command writes the same bytes again, on one thread or on two, and the numbers that are committed.

use super::*;
use std::collections::BTreeMap;
use std::path::Path;
use tempfile::TempDir;

/// Artefacts that take a second or two together and cover the kinds of work: states that are drawn,
/// motions of several resolutions, equilibria of several samplings, paths of several filaments, and
/// fits, each spread over threads where it is more than one run.
const CHEAP: [&str; 8] = [
    "fig1", "fig2", "fig3", "fig4", "fig7", "fig9", "table1", "table3",
];

/// Which artefacts the process that [`a_run_of_its_own`] runs in shall compute, where it shall write, and on
/// how many threads.
const IDS: &str = "ACTIN_FIGURES_IDS";
const OUT: &str = "ACTIN_FIGURES_OUT";
const THREADS: &str = "ACTIN_FIGURES_THREADS";

/// The work of one process. Tables of one process share what they compute, so that runs to be
/// compared need processes of their own.
#[test]
#[ignore = "started by the test below"]
fn a_run_of_its_own() {
    // Without them it was not the test below that started this one: there is nothing to do.
    let [Ok(ids), Ok(out), Ok(threads)] = [IDS, OUT, THREADS].map(std::env::var) else {
        return;
    };
    let options = Options {
        ids: ids.split(',').map(String::from).collect(),
        out: out.into(),
        quick: true,
        threads: Some(threads.parse().unwrap()),
        fresh: false,
        print: false,
        palette: Palette::default(),
    };
    reproduce(&options, &|line| println!("{line}")).unwrap();
}

/// Runs the command for some artefacts.
fn run(ids: &[&str], threads: usize) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let output = std::process::Command::new(std::env::current_exe().unwrap())
        .args([
            "figures::repeats_tests::a_run_of_its_own",
            "--exact",
            "--ignored",
        ])
        .env(IDS, ids.join(","))
        .env(OUT, folder.path())
        .env(THREADS, threads.to_string())
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success() && told.contains("1 passed"),
        "{told}"
    );
    folder
}

/// The files of a run by name. The page holds the time that it took.
fn files(out: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(out).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let written = paths.filter(|path| path.is_file()).map(|path| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (name, fs::read(path).unwrap())
    });
    written.filter(|(name, _)| name != "report.html").collect()
}

/// The records of a run, times left out: titles, settings and captions, which the page shows.
fn record(out: &Path, id: &str) -> serde_json::Value {
    let path = out.join(".artefacts").join(format!("{id}.json"));
    let mut record: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let artefact = record["artefact"].as_object_mut().unwrap();
    assert!(artefact.remove("wall_s").unwrap().as_f64() >= Some(0.0));
    record
}

/// The numbers of a run are those of `docs/report-quick.json` and, where a full run computes the same,
/// of `docs/report.json`.
fn assert_current(out: &Path) {
    let rows = report::read(&out.join("report.json")).unwrap();
    let stale = crate::committed::stale(&rows).unwrap();
    assert!(
        stale.is_empty(),
        "{} rows are stale:\n{}",
        stale.len(),
        stale.join("\n")
    );
}

/// All other artefacts, once. Symptom of the plausible bug: a change of a model that leaves the committed
/// numbers, and the documents with them, as they were.
#[test]
fn committed_numbers_come_out_again() {
    let ids = EXPERIMENTS.map(|e| e.id);
    let rest: Vec<&str> = ids.into_iter().filter(|id| !CHEAP.contains(id)).collect();
    assert_current(run(&rest, 2).path());
}

/// Two processes, of one thread and of two. Symptoms of the plausible bugs: runs put together as they finish,
/// a sum in the order of threads, a random start that is not seeded, a table in the order of a hash.
#[test]
fn threads_and_repetition_change_no_byte() {
    let first = run(&CHEAP, 1);
    assert_current(first.path());
    let expected = files(first.path());
    let count = |kind: &str| expected.keys().filter(|name| name.ends_with(kind)).count();
    assert!(expected.contains_key("report.json"));
    assert!(count(".svg") >= 9 && count(".csv") >= 7 && count("_view.json") >= 5);
    let again = run(&CHEAP, 2);
    let written = files(again.path());
    assert!(expected.keys().eq(written.keys()));
    for (name, bytes) in &expected {
        assert!(*bytes == written[name], "{name} on two threads");
    }
    for id in CHEAP {
        let [one, other] = [&first, &again].map(|folder| record(folder.path(), id));
        assert!(one == other, "record of {id} on two threads");
    }
}
