//! Tests of pages in headless Chromium, for several crates. A script in a copy of a page returns its findings for
//! each width, in light and dark mode.
//!
//! The browser is `CHROME` or a Chromium on the path. Without one, tests are skipped with a message, or fail if
//! `ACTIN_REQUIRE_BROWSER` is set, as in `.ci/run`.
#![allow(dead_code, reason = "each test binary uses some of it")]

use serde_json::Value;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const LIMIT: Duration = Duration::from_mins(8);

/// Returns the browser. A missing browser causes a message, or a panic if it is required.
pub(crate) fn browser() -> Option<PathBuf> {
    let found = actin_view::draw::browser();
    if found.is_none() {
        assert!(
            std::env::var_os("ACTIN_REQUIRE_BROWSER").is_none(),
            "ACTIN_REQUIRE_BROWSER is set, but no browser was found"
        );
        eprintln!("SKIPPED: no Chromium on the path: the page was NOT tested in a browser");
    }
    found
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    Light,
    Dark,
}

/// Returns the result of the script `probe` on `page` for each width (pixels).
pub(crate) fn probed(
    browser: &Path,
    (page, probe): (&str, &str),
    widths: &[u32],
    mode: Mode,
    folder: &Path,
) -> Vec<Value> {
    let probe = format!("<script>\n{probe}</script>");
    let copy = page.replacen("<head>", &format!("<head>{probe}"), 1);
    fs::write(folder.join("copy.html"), copy).unwrap();
    fs::write(folder.join("around.html"), around(widths)).unwrap();
    let text = dumped(browser, mode, folder);
    let found = widths.iter().map(|width| {
        let begin = format!("<pre id=\"w{width}\">");
        let place = text
            .find(&begin)
            .expect("the body of the surrounding page exists")
            + begin.len();
        let json = &text[place..place + text[place..].find("</pre>").unwrap()];
        serde_json::from_str(json).unwrap_or_else(|e| panic!("{width}: {e}: `{json}`"))
    });
    found.collect()
}

/// Returns a page that shows the copy in frames of each width and collects the results of the scripts. A window
/// cannot be as narrow as a phone.
fn around(widths: &[u32]) -> String {
    let mut left = 0;
    let frames = widths.iter().map(|width| {
        let frame = format!(
            "<pre id=\"w{width}\"></pre><iframe name=\"w{width}\" src=\"copy.html\" \
             style=\"position:fixed;top:0;left:{left}px;width:{width}px;height:900px;border:0\"></iframe>",
        );
        left += width + 10;
        frame
    });
    format!(
        "<!doctype html><meta charset=\"utf-8\"><script>\
         window.addEventListener('message', ({{ data }}) => {{\
         const json = JSON.stringify(data.found).replace(/[<>&]/g, (c) => '\\\\u00' + \
         c.charCodeAt(0).toString(16));\
         document.getElementById(data.name).textContent = json; }});</script>{}",
        frames.collect::<String>()
    )
}

/// Returns the surrounding page after all results have arrived. WebGL is rendered in software, and other parts of the
/// page without it, which takes half of the time.
fn dumped(browser: &Path, mode: Mode, folder: &Path) -> String {
    let dump = folder.join("dump.html");
    // Blink encodes dark as 0 and light as 1.
    let scheme = u8::from(mode == Mode::Light);
    let mut child = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--dump-dom"])
        .args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        .arg("--disable-gpu-compositing")
        .args(["--virtual-time-budget=240000", "--window-size=2500,1000"])
        .arg(format!("--blink-settings=preferredColorScheme={scheme}"))
        .args(["--no-first-run", "--disable-dev-shm-usage"])
        .arg(format!(
            "--user-data-dir={}",
            folder.join("profile").display()
        ))
        .arg(format!("file://{}", folder.join("around.html").display()))
        .stdout(File::create(&dump).unwrap())
        .stderr(Stdio::null())
        .spawn()
        .expect("the browser starts");
    let began = Instant::now();
    while child.try_wait().unwrap().is_none() && began.elapsed() < LIMIT {
        std::thread::sleep(Duration::from_millis(50));
    }
    let ended = child.try_wait().unwrap().is_some();
    if !ended {
        child.kill().unwrap();
    }
    child.wait().unwrap();
    assert!(ended, "the browser did not end within {LIMIT:?}");
    fs::read_to_string(dump).unwrap()
}

pub(crate) fn count(value: &Value) -> u64 {
    value
        .as_u64()
        .unwrap_or_else(|| panic!("no count: {value}"))
}
