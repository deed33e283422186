//! The data common to all commands: the global options and the two output streams.

use crate::args::Globals;
use crate::exit::complain;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::signal;
use serde::Serialize;
use std::io::{self, BufWriter, Write};
use vibroimpact_study::Control;

pub(crate) struct Session {
    pub(crate) quiet: bool,
    pub(crate) force: bool,
    threads: usize,
}

impl Session {
    pub(crate) fn new(globals: Globals) -> Self {
        Self { quiet: globals.quiet, force: globals.force, threads: usize::from(globals.threads) }
    }

    /// The requested number of threads; 0 for one per processor.
    pub(crate) const fn threads(&self) -> usize {
        self.threads
    }

    /// Prints text to stdout.
    pub(crate) fn print(&self, text: &str) -> Result<(), Failure> {
        self.to_stdout(|out| out.write_all(text.as_bytes()))
    }

    /// Prints a JSON object to stdout on one line.
    pub(crate) fn print_json(&self, value: &impl Serialize) -> Result<(), Failure> {
        self.to_stdout(|out| {
            serde_json::to_writer(&mut *out, value)?;
            out.write_all(b"\n")
        })
    }

    pub(crate) fn to_stdout(&self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
        let mut out = BufWriter::with_capacity(1 << 16, io::stdout().lock());
        write(&mut out).and_then(|()| out.flush()).map_err(|error| {
            // the rest of the buffer cannot be written either
            let failure = Failure::writing("stdout", &error);
            drop(out.into_parts());
            failure
        })
    }

    /// Prints a remark to stderr, unless --quiet is set.
    pub(crate) fn note(&self, line: &str) {
        if !self.quiet {
            complain(line);
        }
    }

    /// Runs work with threads and stop flag, and with a progress bar if progress can be counted.
    pub(crate) fn watched<T>(&self, work: Option<(u64, &str)>, run: impl FnOnce(&Control<'_>) -> T) -> T {
        match work {
            Some((total, unit)) => self.tiled(total, unit, |control, _| run(control)),
            None => run(&Control { stop: signal::flag(), progress: &|_| {}, threads: self.threads }),
        }
    }

    /// Runs tiled work with threads, stop flag and progress bar.
    pub(crate) fn tiled<T>(&self, total: u64, unit: &str, work: impl FnOnce(&Control<'_>, &Progress) -> T) -> T {
        let progress = Progress::new(total, unit, (self.threads, self.quiet));
        let tell = |done| progress.at(done);
        let control = Control { stop: signal::flag(), progress: &tell, threads: self.threads };
        work(&control, &progress)
    }
}
