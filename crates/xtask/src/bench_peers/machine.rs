//! What the numbers were measured on and with.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use super::setup::Workshop;
use crate::command;

/// Name and value, in the order of the page.
pub(super) type Facts = Vec<(&'static str, String)>;

/// Asks the machine and the programs; what does not answer is `unknown`.
pub(super) fn describe(root: &Path, workshop: &Workshop) -> Facts {
    let cores = std::thread::available_parallelism().map_or_else(|_| "unknown".to_owned(), |n| n.to_string());
    let python = |code: &str| {
        let mut command = workshop.command(&workshop.python);
        command.args(["-c", code]);
        first_line(command)
    };
    let package = |name: &str| python(&format!("import importlib.metadata as m; print(m.version('{name}'))"));
    let mut vibro = workshop.command(&workshop.vibro);
    vibro.arg("--version");
    vec![
        ("processor", processor(root)),
        ("cores visible", cores),
        ("system", python("import platform; print(platform.system(), platform.machine(), *platform.libc_ver())")),
        ("vibroimpact", first_line(vibro)),
        ("Rust", first_line(command::words(root, "rustc --version"))),
        ("C", first_line(command::words(root, "gcc --version"))),
        ("Python", python("import platform; print(platform.python_version())")),
        ("NumPy", package("numpy")),
        ("SciPy", package("scipy")),
        ("Numba", package("numba")),
        ("heyoka (Python package)", package("heyoka")),
        ("lanes heyoka recommends", python("import heyoka; print(heyoka.recommended_simd_size())")),
    ]
}

/// The name the processor gives itself, from Linux or macOS.
fn processor(root: &Path) -> String {
    let named = fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    named.unwrap_or_else(|| first_line(command::words(root, "sysctl -n machdep.cpu.brand_string")))
}

fn first_line(mut command: Command) -> String {
    let output = command.stderr(Stdio::null()).output().ok().filter(|output| output.status.success());
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned()).unwrap_or_default();
    text.lines().next().map_or_else(|| "unknown".to_owned(), |line| line.trim().to_owned())
}
