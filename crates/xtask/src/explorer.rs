//! `cargo xtask explorer`: tests of the page of the explorer in a real browser, with a real server.
//!
//! The tests need packages from npm, in fixed versions, which are installed under the target folder. Without Node.js or
//! Chromium the tests are skipped, with a message.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};

use crate::command;
use crate::totals::skipped;

/// The folder of the tests and of the list of their packages.
const TESTS: &str = "crates/vibroimpact-web/e2e";
/// The variable with the path of the browser, if it is none of these.
const VARIABLE: &str = "CHROMIUM";
const BROWSERS: [&str; 2] = ["/usr/bin/chromium", "/usr/bin/chromium-browser"];

/// Builds the command as for the other tests, serves the page and runs the tests in the browser. Screenshots are kept
/// under the target folder.
///
/// # Errors
/// A message that states the failure.
pub(crate) fn test(root: &Path) -> Result<String, String> {
    if !command::succeeds(root, "node --version") || !command::succeeds(root, "npm --version") {
        return Ok(skipped("there is no Node.js with npm to drive a browser"));
    }
    let Some(browser) = browser() else {
        return Ok(skipped("there is no Chromium; its path may be given as CHROMIUM"));
    };
    let target = command::target(root)?;
    let folder = target.join("explorer");
    command::copy(&root.join(TESTS), &folder)?;
    let mut install = command::words(root, "npm ci --no-audit --no-fund --silent");
    install.current_dir(&folder);
    command::run(install)?;
    // a build without tests would have other features, and all dependent crates would be built again
    command::run(command::words(root, "cargo test --workspace --no-run --test cli"))?;
    let (server, url) = serve(root, &target.join("debug/vibro"))?;
    let mut tests = command::words(root, "node run.mjs");
    tests.current_dir(&folder).args([url.as_str(), "screenshots"]).env(VARIABLE, browser);
    // one test checks whether the server is idle
    tests.env("VIBRO_PID", server.0.id().to_string());
    tests.env("NO_PROXY", "127.0.0.1");
    command::run(tests)?;
    Ok(format!("the page works; its screenshots are in {}", folder.join("screenshots").display()))
}

fn browser() -> Option<PathBuf> {
    let given = std::env::var_os(VARIABLE).map(PathBuf::from);
    given.into_iter().chain(BROWSERS.map(PathBuf::from)).find(|path| path.exists())
}

/// A server that is stopped when the tests end, in any way.
struct Server(Child);

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Starts the explorer on a free port.
fn serve(root: &Path, vibro: &Path) -> Result<(Server, String), String> {
    let failed = |error: std::io::Error| format!("cannot start {}: {error}", vibro.display());
    let mut explore = command::words(root, &vibro.display().to_string());
    let explore = explore.args(["explore", "--no-open", "--port", "0"]).stdout(Stdio::piped());
    let mut server = Server(explore.spawn().map_err(failed)?);
    let mut url = String::new();
    if let Some(out) = server.0.stdout.take() {
        BufReader::new(out).read_line(&mut url).map_err(failed)?;
    }
    if url.starts_with("http://") {
        Ok((server, url.trim().to_owned()))
    } else {
        Err("the explorer gave no address".to_owned())
    }
}
