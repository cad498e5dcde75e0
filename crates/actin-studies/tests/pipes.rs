//! Tasks with a closed pipe on standard output: no panic, the same exit code and files.
#![cfg(unix)]

use std::path::Path;
use std::process::{Command, Output, Stdio};

fn task(arguments: &[&str], out: Option<&Path>, has_reader: bool) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_actin-studies"));
    command.args(arguments).args(out.map(Path::as_os_str));
    command.stderr(Stdio::piped());
    if has_reader {
        return command.output().unwrap();
    }
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    command
        .stdout(writer)
        .spawn()
        .unwrap()
        .wait_with_output()
        .unwrap()
}

#[test]
fn a_closed_pipe_ends_no_task() {
    let folder = tempfile::tempdir().unwrap();
    let fit = ["fit-parameters", "--out"];
    let figure = ["reproduce-figures", "table1", "--quick", "--out"];
    let tasks: [(&[&str], &str); 4] = [
        (&["docs"], ""),
        (&fit, "curves.csv"),
        (&figure, "report.html"),
        (&["reproduce-figures", "fig99"], ""),
    ];
    for (i, (arguments, written)) in tasks.into_iter().enumerate() {
        let place = |name: &str| folder.path().join(format!("{i}-{name}"));
        let outs = ["read", "closed"].map(|name| (!written.is_empty()).then(|| place(name)));
        let read = task(arguments, outs[0].as_deref(), true);
        let closed = task(arguments, outs[1].as_deref(), false);
        assert_eq!(closed.status.code(), read.status.code(), "{arguments:?}");
        assert_eq!(closed.stderr, read.stderr, "{arguments:?}");
        assert!(i == 3 || (read.status.success() && !read.stdout.is_empty()));
        for out in outs.iter().flatten() {
            assert!(out.join(written).exists(), "{arguments:?}: no {written}");
        }
    }
}
