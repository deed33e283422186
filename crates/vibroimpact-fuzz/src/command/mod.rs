//! Command lines of `vibro`: each must give an answer or a refusal within its time, and the same one when repeated.

mod draw;
mod folder;
mod machines;

use crate::case::Property;
use crate::limits::{Limits, ProcessEnd, run};
use crate::rules;
use proptest::prelude::*;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::TempDir;
use vibroimpact_report::question::quoted;
use vibroimpact_report::{Units, answer};
use vibroimpact_study::{Control, Plan};

/// A command line, and whether its budget is very large.
#[derive(Clone, Debug)]
pub struct CommandCase {
    words: Vec<String>,
    heavy: bool,
    /// The text of the machine file in the folder, for questions about machines.
    machine: Option<String>,
}

/// The family of command lines.
#[derive(Debug)]
pub struct Commands {
    vibro: PathBuf,
    scratch: TempDir,
}

/// Only a question answered within this time is repeated.
const SOON: Duration = Duration::from_secs(4);
/// Time after which a question of a large budget is interrupted.
const INTERRUPT: Duration = Duration::from_millis(1500);

impl Commands {
    /// Tests this command.
    ///
    /// # Errors
    /// If there is no such command, or no folder for temporary files.
    pub fn new(vibro: &Path) -> io::Result<Self> {
        let vibro =
            vibro.canonicalize().map_err(|why| io::Error::new(why.kind(), format!("{}: {why}", vibro.display())))?;
        Ok(Self { vibro, scratch: TempDir::new()? })
    }

    /// Runs a line in its own folder. Returns the end of the process and the names of new files.
    fn ask(&self, words: &[String], machine: Option<&str>, limits: &Limits) -> io::Result<(ProcessEnd, Vec<String>)> {
        // always the same name, because some answers contain it
        let folder = self.scratch.path().join("case");
        if folder.exists() {
            fs::remove_dir_all(&folder)?;
        }
        fs::create_dir(&folder)?;
        let files: Vec<(&str, &str)> =
            folder::FILES.into_iter().chain(machine.map(|text| (machines::FILE, text))).collect();
        for (name, text) in &files {
            fs::write(folder.join(name), text)?;
        }
        let ran = run(&self.vibro, words, (&folder, self.scratch.path()), limits)?;
        let mut left = Vec::new();
        for entry in fs::read_dir(&folder)? {
            let name = entry?.file_name().to_string_lossy().into_owned();
            match files.iter().find(|(file, _)| *file == name) {
                Some((_, text)) if fs::read_to_string(folder.join(&name)).is_ok_and(|now| now == *text) => {}
                _ => left.push(name),
            }
        }
        Ok((ran, left))
    }
}

impl Property for Commands {
    type Case = CommandCase;

    fn strategy(&self) -> BoxedStrategy<CommandCase> {
        let heavy =
            prop::sample::select(&folder::HEAVY[..]).prop_map(|line| line.split(' ').map(str::to_owned).collect());
        prop_oneof![
            40 => (draw::lines(), machines::files())
                .prop_map(|(words, text)| CommandCase { words, heavy: false, machine: Some(text) }),
            1 => heavy.prop_map(|words| CommandCase { words, heavy: true, machine: None }),
        ]
        .boxed()
    }

    fn describe(&self, case: &CommandCase) -> String {
        let quoted: Vec<String> = case.words.iter().map(|word| quoted(word)).collect();
        let line = format!("vibro {}{}", quoted.join(" "), if case.heavy { "   # and Ctrl-C" } else { "" });
        match &case.machine {
            Some(text) if line.contains(machines::FILE) => format!("{line}\n# {}\n{text}", machines::FILE),
            _ => line,
        }
    }

    fn check(&mut self, case: &CommandCase) -> Result<(), String> {
        let failed = |why: io::Error| format!("the command cannot be run: {why}");
        let interrupt = case.heavy.then_some(INTERRUPT);
        let limits = Limits { interrupt, ..Limits::default() };
        let (ran, left) = self.ask(&case.words, case.machine.as_deref(), &limits).map_err(failed)?;
        // a run whose time is spent can be resumed, like one after Ctrl-C
        let stops = case.heavy || case.words.iter().any(|word| word.starts_with("--budget"));
        let code = ran.ended_with(if stops { &[0, 1, 2, 130] } else { &[0, 1, 2] })?;
        let verb = case.words.first().map_or("", String::as_str);
        if code != 0 {
            rules::sentence(&ran.stderr)?;
            // the faults of a store are the answer of `verify`
            if !ran.stdout.is_empty() && verb != "verify" {
                return Err(format!("exit code {code} with {} bytes on stdout: {}", ran.stdout.len(), ran.stderr));
            }
            // existing stores are kept; a failed figure leaves no file
            let kept = |name: &&String| name.ends_with(".zarr") || name.ends_with(".zarr.costs");
            if let Some(name) = left.iter().find(|name| code != 130 && !kept(name)) {
                return Err(format!("exit code {code} and a file `{name}` is left: {}", ran.stderr));
            }
            return Ok(());
        }
        if !ran.stderr.is_empty() {
            rules::sentence(&ran.stderr)?;
        }
        if case.heavy || matches!(verb, "bench" | "estimate" | "status") {
            return Ok(());
        }
        let has = |flag: &str| case.words.iter().any(|word| word == flag || word.starts_with(&format!("{flag}=")));
        if has("--json") && !has("--help") && !has("--version") {
            told(verb, &ran.stdout, has("--store") || matches!(verb, "run" | "settle-many"), !has("--rule"))?;
        }
        if ran.took < SOON {
            again(self, case, &ran)?;
        }
        Ok(())
    }
}

/// Checks that the object can be parsed, contains what programs need, and that its plan gives the same object.
fn told(verb: &str, stdout: &[u8], stored: bool, plain: bool) -> Result<(), String> {
    let object = rules::object(stdout)?;
    if stored || matches!(verb, "resume" | "verify" | "status") {
        return Ok(());
    }
    rules::answer(verb, &object)?;
    // a plan has the units of a machine only if its results are in them
    let nondimensional = object.get("system").is_none_or(|system| system.get("scales").is_none());
    let reproducible = nondimensional || object.get("units").is_some_and(|units| units == "si");
    let Some(plan) = object.get("plan").filter(|_| plain && reproducible) else { return Ok(()) };
    let plan = Plan::from_text(&plan.to_string()).map_err(|why| format!("the plan it prints does not read: {why}"))?;
    let asked = answer(&plan, Units::default(), &Control { threads: 1, ..Control::default() });
    let second = asked.map_err(|why| format!("the plan it prints is refused: {why}"))?;
    let second = second.named(object["system"]["name"].as_str().unwrap_or_default()).json();
    let first = String::from_utf8_lossy(stdout);
    same(first.trim_end().as_bytes(), second.as_bytes()).map_err(|why| format!("its plan gives another answer: {why}"))
}

/// Checks that the same line with another number of threads gives the same bytes.
fn again(commands: &Commands, case: &CommandCase, first: &ProcessEnd) -> Result<(), String> {
    if case.words.iter().any(|word| word.starts_with("--threads")) {
        return Ok(());
    }
    let words: Vec<String> = ["--threads=3".to_owned()].into_iter().chain(case.words.iter().cloned()).collect();
    let (second, _) =
        commands.ask(&words, case.machine.as_deref(), &Limits::default()).map_err(|why| why.to_string())?;
    if second.code != first.code {
        return Err(format!("the same question with --threads=3 ends with {:?}: {}", second.code, second.stderr));
    }
    same(&first.stdout, &second.stdout)
        .map_err(|why| format!("the same question with --threads=3 has another answer: {why}"))
}

/// Checks that two outputs are equal.
pub(crate) fn same(a: &[u8], b: &[u8]) -> Result<(), String> {
    if a == b {
        return Ok(());
    }
    let at = a.iter().zip(b).take_while(|(a, b)| a == b).count();
    let part = |text: &[u8]| {
        let from = at.saturating_sub(40).min(text.len());
        String::from_utf8_lossy(&text[from..(at + 40).min(text.len())]).into_owned()
    };
    Err(format!("at byte {at}: `{}` and `{}`", part(a), part(b)))
}
