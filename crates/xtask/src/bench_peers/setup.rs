//! What the contenders need: the command `vibro`, a Python environment of their own, three C programs. All of it lies
//! under `target/peers` and is made once.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::command;

/// Compiler and flags of the peers in C.
pub(super) const COMPILE: &str = "gcc -O3 -march=native";
/// The peers in C, each a file beside `main.c`.
const C_PEERS: [&str; 3] = ["scan", "table", "safe"];

/// Where everything is.
#[derive(Clone)]
pub(super) struct Workshop {
    /// The folder for all that is built here.
    pub(super) folder: PathBuf,
    /// The Python of the environment.
    pub(super) python: PathBuf,
    /// The sources of the peers.
    pub(super) sources: PathBuf,
    /// The command under test.
    pub(super) vibro: PathBuf,
}

impl Workshop {
    /// A program, alone on one thread and with its caches under `target`.
    pub(super) fn command(&self, program: &Path) -> Command {
        let mut command = Command::new(program);
        command.stdin(Stdio::null()).current_dir(&self.folder);
        for threads in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"] {
            command.env(threads, "1");
        }
        command.env("PYTHONPYCACHEPREFIX", self.folder.join("pycache"));
        command.env("NUMBA_CACHE_DIR", self.folder.join("numba"));
        command
    }

    /// A peer in C.
    pub(super) fn c_peer(&self, name: &str) -> PathBuf {
        self.folder.join("bin").join(name)
    }
}

/// Builds what is missing or older than its source.
///
/// # Errors
/// The sentence that says which step failed.
pub(super) fn prepare(root: &Path) -> Result<Workshop, String> {
    let target = target(root)?;
    let folder = target.join("peers");
    let workshop = Workshop {
        python: folder.join("venv/bin/python"),
        sources: root.join("benches/peers"),
        vibro: target.join("release").join(format!("vibro{}", std::env::consts::EXE_SUFFIX)),
        folder,
    };
    command::run(command::words(root, "cargo build --release --package vibroimpact-cli"))?;
    python(root, &workshop)?;
    compile(&workshop)?;
    Ok(workshop)
}

/// The folder cargo builds in.
fn target(root: &Path) -> Result<PathBuf, String> {
    let unreadable = |why: String| format!("the answer of `cargo metadata` cannot be read: {why}");
    let output = command::words(root, "cargo metadata --no-deps --format-version 1")
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| format!("`cargo metadata` cannot be started: {error}"))?;
    let metadata: Value = serde_json::from_slice(&output.stdout).map_err(|error| unreadable(error.to_string()))?;
    let target = metadata["target_directory"].as_str().ok_or_else(|| unreadable("no target directory".to_owned()))?;
    Ok(PathBuf::from(target))
}

/// The environment with the pinned packages; made anew only when the pins have changed.
fn python(root: &Path, workshop: &Workshop) -> Result<(), String> {
    let pins = workshop.sources.join("requirements.txt");
    let wanted = fs::read_to_string(&pins).map_err(|error| format!("{} cannot be read: {error}", pins.display()))?;
    let stamp = workshop.folder.join("venv/installed.txt");
    if fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) {
        return Ok(());
    }
    let hint = |why: String| format!("{why}\nhint: the peers need Python 3.11 or later with venv, and access to PyPI");
    let mut make = command::words(root, "python3 -m venv");
    make.arg(workshop.folder.join("venv"));
    command::run(make).map_err(hint)?;
    let mut install = workshop.command(&workshop.python);
    install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--requirement"]).arg(&pins);
    command::run(install).map_err(hint)?;
    fs::write(&stamp, wanted).map_err(|error| format!("{} cannot be written: {error}", stamp.display()))
}

/// Compiles the peers in C. It takes a second, so it is done each time.
fn compile(workshop: &Workshop) -> Result<(), String> {
    let bin = workshop.folder.join("bin");
    fs::create_dir_all(&bin).map_err(|error| format!("{} cannot be made: {error}", bin.display()))?;
    let source = workshop.sources.join("c");
    for peer in C_PEERS {
        let mut gcc = command::words(&source, COMPILE);
        gcc.args(["-Wall", "-Wextra", "-o"]).arg(bin.join(peer)).args(["main.c", &format!("{peer}.c"), "-lm"]);
        command::run(gcc).map_err(|why| format!("{peer}.c is not compiled: {why}"))?;
    }
    Ok(())
}
