//! Processes with limits: processor time, which does not depend on the load of the machine, memory, and wall time for
//! processes that wait.

use std::fs::File;
use std::io;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// The limits of a process.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Processor time in seconds.
    pub cpu: u64,
    /// Memory in bytes.
    pub memory: u64,
    /// Wall time.
    pub wall: Duration,
    /// Time after which it is interrupted, as by Ctrl-C.
    pub interrupt: Option<Duration>,
}

impl Default for Limits {
    /// Half a minute of processor time, for a question with a small budget, and 4 GiB of memory.
    fn default() -> Self {
        Self { cpu: 30, memory: 4 << 30, wall: Duration::from_secs(300), interrupt: None }
    }
}

/// The end of a process and its output.
#[derive(Debug)]
pub struct ProcessEnd {
    /// Its exit code; `None` if it was killed.
    pub code: Option<i32>,
    /// Its output.
    pub stdout: Vec<u8>,
    /// Its messages.
    pub stderr: String,
    /// Whether it ended without being killed for its time.
    pub ended: bool,
    /// Its wall time.
    pub took: Duration,
}

impl ProcessEnd {
    /// The exit code, if it is one of `codes`.
    pub(crate) fn ended_with(&self, codes: &[i32]) -> Result<i32, String> {
        match self.code {
            Some(code) if codes.contains(&code) => Ok(code),
            Some(code) => Err(format!("exit code {code}: {}", self.stderr)),
            None if self.ended => {
                Err(format!("it was killed, by a limit of time or memory or by an abort: {}", self.stderr))
            }
            None => Err(format!("it does not end, within {:.0} s", self.took.as_secs_f64())),
        }
    }
}

/// The command that starts `program` under the limits that a shell can set; without such a shell there are no limits.
pub(crate) fn limited(program: &Path, limits: &Limits) -> Command {
    if !cfg!(unix) {
        return Command::new(program);
    }
    // limits that the system does not support are ignored
    const SCRIPT: &str =
        r#"ulimit -c 0 2>/dev/null; ulimit -t "$1" 2>/dev/null; ulimit -v "$2" 2>/dev/null; shift 2; exec "$@""#;
    let mut command = Command::new("sh");
    command.args(["-c", SCRIPT, "sh", &limits.cpu.to_string(), &(limits.memory >> 10).to_string()]).arg(program);
    command
}

/// Runs a program in a folder. `scratch` is another folder for its output.
pub(crate) fn run(
    program: &Path,
    args: &[String],
    (folder, scratch): (&Path, &Path),
    limits: &Limits,
) -> io::Result<ProcessEnd> {
    let (out, err) = (scratch.join("stdout"), scratch.join("stderr"));
    let begun = Instant::now();
    let mut child = limited(program, limits)
        .args(args)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(File::create(&out)?)
        .stderr(File::create(&err)?)
        .spawn()?;
    let status = wait(&mut child, begun, limits)?;
    Ok(ProcessEnd {
        code: status.and_then(|status| status.code()),
        stdout: std::fs::read(&out)?,
        stderr: String::from_utf8_lossy(&std::fs::read(&err)?).into_owned(),
        ended: status.is_some(),
        took: begun.elapsed(),
    })
}

/// The status of a process; `None` if it had to be killed.
fn wait(child: &mut Child, begun: Instant, limits: &Limits) -> io::Result<Option<ExitStatus>> {
    let mut pause = Duration::from_micros(500);
    let mut asked = false;
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        let now = begun.elapsed();
        if now > limits.wall {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        if !asked && limits.interrupt.is_some_and(|after| now > after) {
            asked = true;
            // without this program, the time limit ends the process
            let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(20));
    }
}

/// Processor time of a process in seconds; `None` if the system does not provide it.
#[allow(clippy::cast_precision_loss)] // of seconds
pub(crate) fn processor_time(id: u32) -> Option<f64> {
    const TICKS: f64 = 100.0;
    let text = std::fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
    // the name of the program, in brackets, may contain blanks
    let mut fields = text.rsplit_once(')')?.1.split_whitespace().skip(11);
    let (user, system) = (fields.next()?.parse::<u64>().ok()?, fields.next()?.parse::<u64>().ok()?);
    Some((user + system) as f64 / TICKS)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(script: &str, limits: Limits) -> ProcessEnd {
        let scratch = tempfile::tempdir().expect("a folder for the test");
        let args = ["-c".to_owned(), script.to_owned()];
        run(Path::new("/bin/sh"), &args, (scratch.path(), scratch.path()), &limits).expect("the shell runs")
    }

    #[test]
    fn ends_are_told_apart() {
        let usual = Limits::default();
        let fine = shell("echo data; echo remark >&2; exit 2", usual);
        assert_eq!(
            (fine.ended_with(&[0, 2]), fine.stdout.as_slice(), fine.stderr.as_str()),
            (Ok(2), &b"data\n"[..], "remark\n")
        );
        assert!(fine.ended_with(&[0]).unwrap_err().contains("exit code 2"));
        assert!(shell("kill -ABRT $$", usual).ended_with(&[0]).unwrap_err().contains("killed"));
        let endless = shell("while :; do :; done", Limits { cpu: 1, ..usual });
        assert!(endless.ended_with(&[0]).is_err() && endless.took < Duration::from_secs(60));
        let waiting = shell("exec sleep 60", Limits { wall: Duration::from_millis(200), ..usual });
        assert!(waiting.ended_with(&[0]).unwrap_err().contains("does not end"));
        let stopped = shell(
            "trap 'exit 130' INT; while :; do sleep 0.05; done",
            Limits { interrupt: Some(Duration::from_millis(200)), ..usual },
        );
        assert_eq!(stopped.ended_with(&[130]), Ok(130));
    }

    #[test]
    fn time_of_this_process_is_known() {
        if cfg!(target_os = "linux") {
            assert!(processor_time(std::process::id()).is_some_and(|seconds| seconds >= 0.0));
        }
        assert_eq!(processor_time(u32::MAX), None);
    }
}
