//! Runs the code blocks of the README and of the book in order. Each page runs in its own empty folder, with the
//! built program on the path.
//!
//! | block | action |
//! |---|---|
//! | `sh` | run with `sh -e`; exit code 0 |
//! | `python` | run with a Python that has numpy; exit code 0 |
//! | `ron` | `actin check` accepts it |
//! | `rust` | not run here: a crate includes the page in its documentation tests |
//! | `text` after one of these | its lines occur in the output, in order; `...` matches anything |
//!
//! A comment in the line above a block changes this. `<!-- file: NAME -->` writes the block to a file, and
//! `<!-- exit: 2 -->` expects another exit code. `<!-- not run: REASON -->` skips the block.
#![cfg(unix)]

use crate::common::{python, with_actin};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

#[derive(Debug, PartialEq)]
struct Block {
    /// Line number of the opening fence, from 1.
    line: usize,
    language: String,
    /// The comment in the line above.
    directive: Option<String>,
    code: String,
}

fn blocks(text: &str) -> Vec<Block> {
    let mut all = Vec::new();
    let mut lines = (1..).zip(text.lines());
    let mut above = "";
    while let Some((line, opening)) = lines.next() {
        if let Some(language) = opening.strip_prefix("```") {
            let inside = lines.by_ref().map(|(_, line)| line);
            let code: Vec<&str> = inside.take_while(|line| !line.starts_with("```")).collect();
            let directive = above.strip_prefix("<!--");
            let directive = directive.and_then(|rest| rest.strip_suffix("-->"));
            all.push(Block {
                line,
                language: language.to_owned(),
                directive: directive.map(|d| d.trim().to_owned()),
                code: code.join("\n") + "\n",
            });
        }
        above = opening;
    }
    all
}

fn matches(pattern: &str, line: &str) -> bool {
    let mut parts = pattern.trim_end().split("...");
    let Some(mut rest) = line.trim_end().strip_prefix(parts.next().unwrap_or("")) else {
        return false;
    };
    let mut last = None;
    for part in parts {
        last = Some(part);
        let Some(at) = rest.find(part) else {
            return false;
        };
        rest = &rest[at + part.len()..];
    }
    rest.is_empty() || last == Some("") || last.is_some_and(|last| rest.ends_with(last))
}

fn missing<'a>(expected: &'a str, output: &str) -> Option<&'a str> {
    let mut lines = output.lines();
    expected
        .lines()
        .find(|pattern| !lines.any(|line| matches(pattern, line)))
}

struct Page {
    name: String,
    folder: TempDir,
    /// Output of the last block that ran; `None` after a skipped block.
    output: Option<String>,
    run: usize,
}

impl Page {
    fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            folder: tempfile::tempdir().unwrap(),
            output: None,
            run: 0,
        }
    }

    fn block(&mut self, block: &Block) {
        let place = format!("{}:{}", self.name, block.line);
        let directive = block.directive.as_deref().unwrap_or("");
        if let Some(file) = directive.strip_prefix("file:") {
            fs::write(self.folder.path().join(file.trim()), &block.code).unwrap();
            return;
        }
        if directive.starts_with("not run:") {
            self.output = None;
            return;
        }
        if block.language == "text" {
            if let Some(output) = &self.output {
                let missing = missing(&block.code, output);
                assert_eq!(missing, None, "{place}: not in the output:\n{output}");
            }
            return;
        }
        if block.language == "rust" {
            assert!(
                is_doc_test(&self.name),
                "{place}: no crate includes this page in its doc tests"
            );
            self.output = None;
            return;
        }
        let Some(mut command) = self.command(block, &place) else {
            self.output = None;
            return;
        };
        let code = directive.strip_prefix("exit:").unwrap_or("0").trim();
        let output = command.output().unwrap();
        let text = both(&output);
        let ended = output.status.code().map(|code| code.to_string());
        assert_eq!(ended.as_deref(), Some(code), "{place}: exit code; {text}");
        self.output = Some(text);
        self.run += 1;
    }

    fn command(&self, block: &Block, place: &str) -> Option<Command> {
        let (program, arguments) = match block.language.as_str() {
            "sh" => ("sh".to_owned(), vec!["-e", "-c", &block.code]),
            "python" => (
                python("numpy", "ACTIN_REQUIRE_PYTHON", place)?,
                vec!["-c", &block.code],
            ),
            "ron" => {
                fs::write(self.folder.path().join("block.ron"), &block.code).unwrap();
                ("actin".to_owned(), vec!["check", "block.ron"])
            }
            other => panic!("{place}: unknown language {other:?}"),
        };
        let mut command = with_actin(&program, self.folder.path());
        command.args(arguments).stdin(Stdio::null());
        Some(command)
    }
}

fn both(output: &Output) -> String {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    text(&output.stdout) + &text(&output.stderr)
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn is_doc_test(page: &str) -> bool {
    let include = format!("#[doc = include_str!(\"../../../{page}\")]");
    let crates = fs::read_dir(root().join("crates")).unwrap();
    let mut sources = crates.map(|entry| entry.unwrap().path().join("src/lib.rs"));
    sources.any(|lib| fs::read_to_string(lib).is_ok_and(|text| text.contains(&include)))
}

fn run(name: &str) -> usize {
    let text = fs::read_to_string(root().join(name)).unwrap();
    let mut page = Page::new(name);
    for block in blocks(&text) {
        page.block(&block);
    }
    page.run
}

fn run_folder(name: &str) -> usize {
    let entries = fs::read_dir(root().join(name)).unwrap();
    let files = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let pages = files.filter(|file| Path::new(file).extension().is_some_and(|e| e == "md"));
    pages.map(|file| run(&format!("{name}/{file}"))).sum()
}

#[test]
fn the_tutorial() {
    let ran = run("docs/tutorial.md");
    assert!(ran >= 5, "only {ran} blocks have run");
}

#[test]
fn the_readme() {
    assert!(run("README.md") >= 1);
}

#[test]
fn how_to_pages() {
    let ran = run_folder("docs/how-to");
    assert!(ran >= 4, "only {ran} blocks have run");
}

#[test]
fn reference_pages() {
    let ran = run_folder("docs/reference");
    assert!(ran >= 2, "only {ran} blocks have run");
}

#[test]
fn blocks_are_read_with_their_directives() {
    let text = "a\n<!-- exit: 2 -->\n```sh\nfalse\n```\n\n```python\nx = 1\n\ny = 2\n```\n";
    let found = blocks(text);
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].directive.as_deref(), Some("exit: 2"));
    assert_eq!((found[0].line, found[0].code.as_str()), (3, "false\n"));
    assert_eq!(found[1].directive, None);
    assert_eq!(found[1].code, "x = 1\n\ny = 2\n");
}

#[test]
fn output_that_differs_is_found() {
    assert!(matches("after ... steps, ... s", "after 12 steps, 0.1 s"));
    assert!(matches("energy ...", "energy 12"));
    assert!(!matches("after ... steps", "after 12 steps or so"));
    assert!(!matches("status: converged", "status: failed"));
    assert_eq!(missing("a\nc\n", "a\nb\nc\n"), None);
    assert_eq!(missing("c\na\n", "a\nb\nc\n"), Some("a"));
}

#[test]
#[should_panic(expected = "not in the output")]
fn a_page_with_stale_output_fails() {
    let mut page = Page::new("stale.md");
    for block in blocks("```sh\necho 1\n```\n```text\n2\n```\n") {
        page.block(&block);
    }
}
