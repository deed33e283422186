//! `cargo xtask cost`: what a cold build costs, by package: seconds of processor time, and bytes in the program.
//!
//! This program stands between cargo and the compiler (`RUSTC_WRAPPER`): each time it runs the compiler and writes a line
//! with the package and the processor time into a log. `cargo xtask test` keeps such a log too, and warns if a cold build
//! has become more expensive than the recorded one.

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use crate::command;

/// The variable with the log to which this program writes as a compiler.
const LOG: &str = "VIBROIMPACT_COST_LOG";

/// The programs that cargo starts through a wrapper.
const COMPILERS: [&str; 2] = ["rustc", "clippy-driver"];

/// Packages whose cost is the measure for that of all others. They are large, and nothing here changes them, so the ratio is
/// nearly that of any machine.
const MEASURE: [&str; 3] = ["clap_builder", "syn", "usvg"];

/// The cost of all that a cold `cargo xtask test` compiles, in that of [`MEASURE`].
const RECORDED: f64 = 24.5;

/// A warning is printed above this part of the recorded cost.
const ALLOWED: f64 = 1.1;

/// How many packages are printed one by one.
const PRINTED: usize = 30;

/// Compiles, and adds the package and the seconds to the log, if cargo has started this program in place of a compiler.
pub(crate) fn compile(words: &[String]) -> Option<ExitCode> {
    let (log, (compiler, words)) = (std::env::var_os(LOG)?, words.split_first()?);
    if !Path::new(compiler).file_stem().is_some_and(|name| COMPILERS.iter().any(|known| name == *known)) {
        return None;
    }
    let status = match Command::new(compiler).args(words).status() {
        Ok(status) => status,
        Err(error) => {
            eprintln!("`{compiler}` cannot be started: {error}");
            return Some(ExitCode::FAILURE);
        }
    };
    // cargo asks for the version of the compiler without a package; a log that cannot be written costs only the measurement
    if let (Ok(package), Some(seconds)) = (std::env::var("CARGO_PKG_NAME"), seconds_of_children()) {
        let open = fs::OpenOptions::new().append(true).open(log);
        let _ = open.and_then(|mut file| file.write_all(format!("{package} {seconds:.2}\n").as_bytes()));
    }
    Some(ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1)))
}

/// The processor time in user mode of all processes that this one has waited for, on Linux: `proc(5)`, field 16 of `stat`.
fn seconds_of_children() -> Option<f64> {
    /// The unit, the same on all processors that Rust supports.
    const TICKS_PER_SECOND: f64 = 100.0;
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // the name of the program, which can contain anything, ends at the last bracket; field 3 follows
    let (_, fields) = stat.rsplit_once(')')?;
    let ticks: u32 = fields.split_whitespace().nth(13)?.parse().ok()?;
    Some(f64::from(ticks) / TICKS_PER_SECOND)
}

/// A log to which the commands of cargo add that are started with its variables.
pub(crate) struct Log(PathBuf);

impl Log {
    /// An empty log in a folder. `None` where processor time cannot be read or another program stands before the compiler.
    pub(crate) fn begin(folder: &Path) -> Option<Self> {
        seconds_of_children()?;
        if std::env::var_os("RUSTC_WRAPPER").is_some() {
            return None;
        }
        let log = folder.join("build-cost.log");
        fs::create_dir_all(folder).ok()?;
        fs::write(&log, "").ok()?;
        Some(Self(log))
    }

    /// The variables for a command that builds.
    pub(crate) fn variables(&self) -> Vec<(&'static str, PathBuf)> {
        let here = std::env::current_exe().into_iter();
        here.flat_map(|here| [("RUSTC_WRAPPER", here), (LOG, self.0.clone())]).collect()
    }

    /// The seconds of each package.
    fn seconds(&self) -> BTreeMap<String, f64> {
        let mut seconds = BTreeMap::new();
        for line in fs::read_to_string(&self.0).unwrap_or_default().lines() {
            if let Some((package, Ok(taken))) =
                line.split_once(' ').map(|(package, taken)| (package, taken.parse::<f64>()))
            {
                *seconds.entry(package.to_owned()).or_insert(0.0) += taken;
            }
        }
        seconds
    }

    /// A sentence on the cost of a cold build; `None` if not all was compiled.
    pub(crate) fn sentence(&self) -> Option<String> {
        let seconds = self.seconds();
        let measure: Option<f64> = MEASURE.iter().map(|name| seconds.get(*name)).sum();
        let all: f64 = seconds.values().sum();
        Some(compared(all, measure?))
    }
}

/// The cost of a cold build beside the recorded one.
fn compared(all: f64, measure: f64) -> String {
    let cost = all / measure;
    let names = MEASURE.join(", ");
    let sentence = format!("the build took {all:.0} s of processor time, {cost:.1} times that of {names}");
    if cost > ALLOWED * RECORDED {
        format!("warning: {sentence}; {RECORDED:.1} times are recorded in crates/xtask/src/cost.rs")
    } else {
        sentence
    }
}

/// Builds a package and all that it needs as for a release, in a folder of its own, and prints what that costs.
///
/// # Errors
/// A message if processor time cannot be read, or the build fails.
pub(crate) fn print(root: &Path, package: &str) -> Result<String, String> {
    let folder = command::target(root)?.join("cost");
    let _ = fs::remove_dir_all(&folder);
    let log =
        Log::begin(&folder).ok_or("processor time is measured on Linux only, and without another RUSTC_WRAPPER")?;
    // the names of functions say which crate they are from
    let mut build =
        command::words(root, "cargo build --release --locked --config profile.release.strip=false --package");
    build.arg(package).env("CARGO_TARGET_DIR", &folder);
    build.envs(log.variables());
    let before = seconds_of_children().unwrap_or(0.0);
    command::run(build)?;
    let all = seconds_of_children().unwrap_or(0.0) - before;
    let seconds = log.seconds();
    let bytes = program_in(&folder.join("release")).map(|program| bytes(root, &program)).unwrap_or_default();
    let mut rows: Vec<(&str, f64, u64)> = seconds
        .iter()
        .map(|(name, taken)| (name.as_str(), *taken, bytes.get(&name.replace('-', "_")).copied().unwrap_or(0)))
        .collect();
    rows.sort_by(|a, b| b.1.total_cmp(&a.1));
    println!("{:28} {:>9} {:>12}", "package", "user s", "bytes");
    for (name, taken, size) in rows.iter().take(PRINTED) {
        println!("{name:28} {taken:9.1} {size:12}");
    }
    let rest = rows.iter().skip(PRINTED).fold((0.0, 0), |sum, row| (sum.0 + row.1, sum.1 + row.2));
    println!("{:28} {:9.1} {:12}", format!("{} others", rows.len().saturating_sub(PRINTED)), rest.0, rest.1);
    let compiled: f64 = seconds.values().sum();
    println!("{:28} {:9.1}", "build scripts and cargo", all - compiled);
    Ok(format!("{} packages, {all:.0} s of processor time", rows.len()))
}

/// The program in a folder of a release: the other file without an ending there, a lock of cargo, begins with a dot.
fn program_in(folder: &Path) -> Option<PathBuf> {
    let files = fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path());
    files.filter(|path| path.is_file() && path.extension().is_none()).max()
}

/// The machine code of a program in bytes by crate, by the names of its functions; empty without `nm`.
fn bytes(root: &Path, program: &Path) -> BTreeMap<String, u64> {
    let mut bytes = BTreeMap::new();
    let mut list = command::words(root, "nm --demangle --print-size");
    list.arg(program);
    let Ok(output) = list.output() else { return bytes };
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let mut words = line.splitn(4, ' ').skip(1);
        let (Some(size), Some(kind), Some(name)) = (words.next(), words.next(), words.next()) else { continue };
        if matches!(kind, "t" | "T" | "w" | "W")
            && let Ok(size) = u64::from_str_radix(size, 16)
        {
            *bytes.entry(owner(name).to_owned()).or_insert(0) += size;
        }
    }
    bytes
}

/// The crate of a function by its name: that of the first path in it. A generic function counts for the crate that defines it.
fn owner(name: &str) -> &str {
    let name = name.trim_start_matches(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    let name = name.strip_prefix("mut ").or(name.strip_prefix("dyn ")).unwrap_or(name);
    name.split_once("::").map_or("", |(first, _)| first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_owner_is_the_first_crate() {
        assert_eq!(
            owner("<vibroimpact_study::plan::Plan as serde_core::de::Deserialize>::deserialize"),
            "vibroimpact_study"
        );
        assert_eq!(owner("core::ptr::drop_in_place<toml::Value>"), "core");
        assert_eq!(owner("<&mut serde_json::de::Deserializer<R> as x::Y>::z"), "serde_json");
        assert_eq!(owner("ZSTD_compress"), "");
    }

    #[test]
    fn a_log_is_summed_by_package_and_needs_the_measure() {
        let folder = tempfile::tempdir().expect("a folder");
        let log = Log(folder.path().join("log"));
        fs::write(&log.0, "syn 1.50\nsyn 0.5\nrayon 2\nno number\n").expect("a log");
        assert_eq!(log.seconds(), BTreeMap::from([("syn".to_owned(), 2.0), ("rayon".to_owned(), 2.0)]));
        assert_eq!(log.sentence(), None);
        fs::write(&log.0, "syn 1\nclap_builder 2\nusvg 1\nvibroimpact 96\n").expect("a log");
        assert!(log.sentence().is_some_and(|sentence| sentence.contains("100 s of processor time, 25.0 times")));
        assert!(compared(2.0 * RECORDED + 1.0, 1.0).starts_with("warning: "));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn time_of_children_is_read() {
        assert!(seconds_of_children().is_some_and(|seconds| (0.0..1e6).contains(&seconds)));
    }
}
