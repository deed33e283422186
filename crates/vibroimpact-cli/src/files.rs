//! Output files. They are reserved before the computation, written under a temporary name, and renamed when complete.

use crate::failure::Failure;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Temporary files that are not complete yet.
static BEGUN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Removes incomplete temporary files before an exit that runs no destructors.
pub(crate) fn sweep() {
    for path in BEGUN.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        let _ = fs::remove_file(path);
    }
}

/// A place for a file that is known to be writable. The place does not change until the file is complete.
#[derive(Debug)]
pub(crate) struct Target {
    path: PathBuf,
    /// The final path with symbolic links resolved, the path of the temporary file, and the open temporary file. `None`
    /// for a pipe or device, which is written directly.
    beside: Option<(PathBuf, PathBuf, File)>,
    force: bool,
}

impl Target {
    /// Reserves `path`. An existing file is refused unless `force` is set.
    pub(crate) fn reserve(path: &Path, force: bool) -> Result<Self, Failure> {
        let name = path.display();
        if path.as_os_str().is_empty() {
            return Err(Failure::bad("the name of an output file is empty"));
        }
        let path = path.to_path_buf();
        match fs::metadata(&path) {
            Ok(found) if found.is_dir() => {
                return Err(Failure::bad(format!("`{name}` is a directory, not a file")));
            }
            Ok(found) if !found.is_file() => {
                return Ok(Self { path, beside: None, force });
            }
            Ok(_) if !force => {
                return Err(Failure::bad(format!(
                    "`{name}` exists already\nhint: choose another name, or --force to replace it"
                )));
            }
            _ => {}
        }
        let place = fs::canonicalize(&path).unwrap_or_else(|_| path.clone());
        let (Some(directory), Some(file)) = (place.parent(), place.file_name()) else {
            return Err(Failure::bad(format!("`{name}` is no name for a file")));
        };
        let directory = if directory.as_os_str().is_empty() { Path::new(".") } else { directory };
        let temporary = directory.join(format!(".{}.{}.tmp", file.to_string_lossy(), std::process::id()));
        let mut begun = BEGUN.lock().unwrap_or_else(PoisonError::into_inner);
        if begun.contains(&temporary) {
            return Err(Failure::bad(format!("`{name}` is asked for twice")));
        }
        // a temporary file of the same name may be left from a run that was killed
        let open = OpenOptions::new().write(true).create(true).truncate(true).open(&temporary);
        match open {
            Ok(file) => {
                begun.push(temporary.clone());
                Ok(Self { path, beside: Some((place.clone(), temporary, file)), force })
            }
            Err(error) => Err(Failure::bad(match error.kind() {
                // on special file systems such as /proc the directory exists, but no file can be created in it
                io::ErrorKind::NotFound if directory.is_dir() => {
                    format!("`{name}` cannot be written: the directory `{}` takes no files", directory.display())
                }
                io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => {
                    format!(
                        "`{name}` cannot be written: there is no directory `{0}`\nhint: `mkdir -p {0}` makes it",
                        directory.display()
                    )
                }
                _ => format!("`{name}` cannot be written in `{}`: {error}", directory.display()),
            })),
        }
    }

    /// Writes the whole file, which appears complete or not at all.
    pub(crate) fn write(mut self, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
        let name = format!("`{}`", self.path.display());
        self.put(content).map_err(|error| Failure::writing(name, &error))
    }

    fn put(&mut self, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        let Some((place, temporary, file)) = &self.beside else {
            let mut out = BufWriter::new(OpenOptions::new().write(true).open(&self.path)?);
            content(&mut out)?;
            return out.flush();
        };
        let mut out = BufWriter::with_capacity(1 << 16, file);
        content(&mut out)?;
        out.flush()?;
        drop(out);
        file.sync_all()?;
        // another program may have created the file in the meantime
        if !self.force && place.exists() {
            return Err(io::Error::from(io::ErrorKind::AlreadyExists));
        }
        fs::rename(temporary, place)?;
        forget(temporary);
        self.beside = None;
        Ok(())
    }
}

fn forget(path: &Path) {
    let mut begun = BEGUN.lock().unwrap_or_else(PoisonError::into_inner);
    begun.retain(|other| other != path);
}

impl Drop for Target {
    /// Removes the temporary file if it was not completed.
    fn drop(&mut self) {
        if let Some((_, temporary, _)) = &self.beside {
            let _ = fs::remove_file(temporary);
            forget(temporary);
        }
    }
}
