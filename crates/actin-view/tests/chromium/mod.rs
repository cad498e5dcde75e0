//! Pages in headless Chromium, for the tests of several crates: what a probe, put into a copy of a page, finds
//! at each width, light and dark.
//!
//! Needs a browser: `CHROME`, or a Chromium on the path. Without one the tests say loudly that
//! they were skipped; where `ACTIN_REQUIRE_BROWSER` is set, as `.ci/run` does, they fail.
#![allow(dead_code, reason = "each test binary uses some of it")]

use serde_json::Value;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Far longer than a browser takes on a busy machine.
const LIMIT: Duration = Duration::from_mins(8);

/// The browser; nothing, told loudly, if there is none and none is required.
pub(crate) fn browser() -> Option<PathBuf> {
    let found = actin_view::draw::browser();
    if found.is_none() {
        assert!(
            std::env::var_os("ACTIN_REQUIRE_BROWSER").is_none(),
            "ACTIN_REQUIRE_BROWSER is set and there is no browser"
        );
        eprintln!("SKIPPED: no Chromium on the path: the page was NOT tested in a browser");
    }
    found
}

/// What a reader has asked the system for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    Light,
    Dark,
}

/// What the script `probe` tells of `page` at each width (pixels).
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
        let place = text.find(&begin).expect("the page around has its place") + begin.len();
        let json = &text[place..place + text[place..].find("</pre>").unwrap()];
        serde_json::from_str(json).unwrap_or_else(|e| panic!("{width}: {e}: `{json}`"))
    });
    found.collect()
}

/// A page that shows the copy in a frame of each width and keeps what the probes tell it. A window
/// itself cannot be as narrow as a phone.
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

/// The page around, as it stands when all that it waits for has happened. What a graphics card draws elsewhere
/// is drawn in software.
fn dumped(browser: &Path, mode: Mode, folder: &Path) -> String {
    let dump = folder.join("dump.html");
    // Blink counts: 0 is dark, 1 light.
    let scheme = u8::from(mode == Mode::Light);
    let mut child = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--dump-dom"])
        .args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
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

/// A number that counts.
pub(crate) fn count(value: &Value) -> u64 {
    value
        .as_u64()
        .unwrap_or_else(|| panic!("no count: {value}"))
}
