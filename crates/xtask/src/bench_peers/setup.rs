//! What the contenders need: the command `vibro`, a Python environment of their own, three C programs. All of it lies
//! under `target/peers` and is made once.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::{command, venv};

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
    let target = command::target(root)?;
    let folder = target.join("peers");
    let sources = root.join("benches/peers");
    command::run(command::words(root, "cargo build --release --package vibroimpact-cli"))?;
    let hint = |why: String| format!("{why}\nhint: the peers need Python 3.11 or later with venv, and access to PyPI");
    let workshop = Workshop {
        python: venv::ready(root, &folder.join("venv"), &sources.join("requirements.txt")).map_err(hint)?,
        sources,
        vibro: target.join("release").join(format!("vibro{}", std::env::consts::EXE_SUFFIX)),
        folder,
    };
    compile(&workshop)?;
    Ok(workshop)
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
