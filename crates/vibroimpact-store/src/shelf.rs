//! The place of the objects of a store. An object has a name and bytes, and is written completely or not at all.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::SystemTime;

/// An object and the time when it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// Its name, with parts separated by `/`.
    pub key: String,
    /// Its length in bytes.
    pub size: u64,
    /// Time when it was written, according to the place.
    pub modified: SystemTime,
}

/// A place for objects. Readers see an object as it was before or after a write, never in between, even if the writer
/// is killed.
pub trait Shelf: Send + Sync {
    /// The object, if there is one.
    ///
    /// # Errors
    /// If the place cannot be read.
    fn get(&self, key: &str) -> io::Result<Option<Vec<u8>>>;

    /// The last `count` bytes of an object, and its length, if there is one.
    ///
    /// # Errors
    /// If the place cannot be read.
    fn tail(&self, key: &str, count: usize) -> io::Result<Option<(Vec<u8>, u64)>> {
        let end = |bytes: Vec<u8>| (bytes[bytes.len().saturating_sub(count)..].to_vec(), bytes.len() as u64);
        Ok(self.get(key)?.map(end))
    }

    /// `count` bytes of an object from `from`, or fewer where it ends, if there is one.
    ///
    /// # Errors
    /// If the place cannot be read.
    fn range(&self, key: &str, from: u64, count: u64) -> io::Result<Option<Vec<u8>>> {
        let place = |at: u64, bytes: &[u8]| usize::try_from(at).unwrap_or(usize::MAX).min(bytes.len());
        let part = |bytes: Vec<u8>| bytes[place(from, &bytes)..place(from.saturating_add(count), &bytes)].to_vec();
        Ok(self.get(key)?.map(part))
    }

    /// Removes an object. That there is none is no error.
    ///
    /// # Errors
    /// If the place cannot be written.
    fn remove(&self, key: &str) -> io::Result<()>;

    /// Writes an object. Replaces the object with the same name, if there is one.
    ///
    /// # Errors
    /// If the place cannot be written; the previous object is then unchanged.
    fn put(&self, key: &str, bytes: &[u8]) -> io::Result<()>;

    /// The objects whose names begin with `prefix`, in the order of their names.
    ///
    /// # Errors
    /// If the place cannot be read.
    fn list(&self, prefix: &str) -> io::Result<Vec<Item>>;

    /// Removes unfinished files of writers that were killed.
    ///
    /// # Errors
    /// If the place cannot be read.
    fn sweep(&self) -> io::Result<()>;

    /// The name of the place, for messages.
    fn name(&self) -> String;
}

/// A folder of a file system.
#[derive(Debug)]
pub struct Folder {
    /// As it was given.
    path: PathBuf,
    /// Absolute, because a process can change its working folder.
    place: PathBuf,
}

/// Number of files begun by this process. It makes the names of unfinished files unique within the process.
static BEGUN: AtomicU64 = AtomicU64::new(0);

/// The end of the names of unfinished files. These names begin with a dot, and readers of Zarr ignore them.
const UNFINISHED: &str = ".tmp";

/// Maximum number of attempts to write a file whose unfinished file was removed by another process.
const ATTEMPTS: u32 = 8;

impl Folder {
    /// The folder at `path`, which need not exist yet.
    #[must_use]
    pub fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), place: std::path::absolute(path).unwrap_or_else(|_| path.to_owned()) }
    }

    /// An object for reading, if there is one.
    fn open(&self, key: &str) -> io::Result<Option<File>> {
        there(File::open(self.place.join(key)))
    }

    fn unfinished(name: &str) -> bool {
        name.starts_with('.') && name.ends_with(UNFINISHED)
    }

    /// Calls `found` for each file below `from`.
    fn walk(from: &Path, found: &mut dyn FnMut(&Path, &fs::DirEntry) -> io::Result<()>) -> io::Result<()> {
        for entry in there(fs::read_dir(from))?.into_iter().flatten() {
            let entry = entry?;
            let path = entry.path();
            // a file that another process has just renamed or removed is not an error
            match there(entry.file_type())? {
                Some(kind) if kind.is_dir() => Self::walk(&path, found)?,
                Some(_) => found(&path, &entry)?,
                None => {}
            }
        }
        Ok(())
    }

    fn try_put(beside: &Path, place: &Path, bytes: &[u8]) -> io::Result<()> {
        let mut file = File::create(beside)?;
        file.write_all(bytes)?;
        drop(file);
        fs::rename(beside, place)
    }
}

/// What is found; `None` if nothing is there.
fn there<T>(found: io::Result<T>) -> io::Result<Option<T>> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

impl Shelf for Folder {
    fn get(&self, key: &str) -> io::Result<Option<Vec<u8>>> {
        there(fs::read(self.place.join(key)))
    }

    fn tail(&self, key: &str, count: usize) -> io::Result<Option<(Vec<u8>, u64)>> {
        let Some(mut file) = self.open(key)? else { return Ok(None) };
        let length = file.metadata()?.len();
        file.seek(SeekFrom::Start(length.saturating_sub(count as u64)))?;
        let mut bytes = Vec::with_capacity(count);
        file.read_to_end(&mut bytes)?;
        Ok(Some((bytes, length)))
    }

    fn range(&self, key: &str, from: u64, count: u64) -> io::Result<Option<Vec<u8>>> {
        let Some(mut file) = self.open(key)? else { return Ok(None) };
        file.seek(SeekFrom::Start(from))?;
        let mut bytes = Vec::new();
        file.take(count).read_to_end(&mut bytes)?;
        Ok(Some(bytes))
    }

    fn remove(&self, key: &str) -> io::Result<()> {
        let path = self.place.join(key);
        there(fs::remove_file(&path))?;
        // folders that have become empty; one that another process is filling is not removed, or made again by it
        for folder in path.ancestors().skip(1).take_while(|folder| *folder != self.place) {
            if fs::remove_dir(folder).is_err() {
                break;
            }
        }
        Ok(())
    }

    fn put(&self, key: &str, bytes: &[u8]) -> io::Result<()> {
        let place = self.place.join(key);
        let (Some(folder), Some(name)) = (place.parent(), place.file_name()) else {
            return Err(io::ErrorKind::InvalidInput.into());
        };
        let number = BEGUN.fetch_add(1, Ordering::Relaxed);
        let own = format!(".{}.{}.{}{number}{UNFINISHED}", name.to_string_lossy(), std::process::id(), host());
        let beside = folder.join(own);
        let mut outcome = Self::try_put(&beside, &place, bytes);
        // the folder does not exist yet, or another process removed the unfinished file when it ended (which it does
        // only once)
        for _ in 0..ATTEMPTS {
            if !outcome.as_ref().is_err_and(|error| error.kind() == io::ErrorKind::NotFound) {
                break;
            }
            outcome = fs::create_dir_all(folder).and_then(|()| Self::try_put(&beside, &place, bytes));
        }
        if outcome.is_err() {
            let _ = fs::remove_file(&beside);
        }
        outcome
    }

    fn list(&self, prefix: &str) -> io::Result<Vec<Item>> {
        let mut items = Vec::new();
        // objects with this prefix are in the folder named by the prefix up to its last slash
        let from = prefix.rfind('/').map_or(self.place.clone(), |end| self.place.join(&prefix[..end]));
        Self::walk(&from, &mut |path, entry| {
            let Ok(relative) = path.strip_prefix(&self.place) else { return Ok(()) };
            let parts: Vec<_> = relative.iter().map(|part| part.to_string_lossy()).collect();
            let key = parts.join("/");
            if key.starts_with(prefix)
                && !parts.last().is_some_and(|name| Self::unfinished(name))
                && let Some(found) = there(entry.metadata())?
            {
                items.push(Item { key, size: found.len(), modified: found.modified()? });
            }
            Ok(())
        })?;
        items.sort_by(|a, b| a.key.cmp(&b.key));
        Ok(items)
    }

    fn sweep(&self) -> io::Result<()> {
        Self::walk(&self.place, &mut |path, _| {
            if path.file_name().is_some_and(|name| Self::unfinished(&name.to_string_lossy())) {
                // if another process is still writing this file, it writes it again
                let _ = fs::remove_file(path);
            }
            Ok(())
        })
    }

    fn name(&self) -> String {
        self.path.display().to_string()
    }
}

/// A name that differs between machines that share a file system.
pub(crate) fn host() -> String {
    let name = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    let plain: String = name.trim().chars().filter(char::is_ascii_alphanumeric).take(20).collect();
    if plain.is_empty() { plain } else { plain + "." }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A record that is written after the working folder has changed goes to the place meant at first.
    #[test]
    fn a_relative_folder_keeps_its_place() {
        let folder = Folder::new(Path::new("some/store"));
        assert_eq!(folder.name(), "some/store");
        assert!(folder.place.is_absolute() && folder.place.ends_with("some/store"));
    }

    #[test]
    fn objects_are_whole_and_leftovers_are_swept() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("new/store");
        let shelf = Folder::new(&place);
        assert_eq!((shelf.get("a/zarr.json").unwrap(), shelf.list("").unwrap()), (None, vec![]));
        for bytes in [b"first".as_slice(), b"second"] {
            shelf.put("a/zarr.json", bytes).unwrap();
            assert_eq!(shelf.get("a/zarr.json").unwrap().as_deref(), Some(bytes));
        }
        shelf.put("a/c/1/0", b"chunk").unwrap();
        shelf.put("ab", b"").unwrap();
        fs::write(place.join("a/c/1/.0.123.7.tmp"), b"half").unwrap();
        let keys = |prefix| shelf.list(prefix).unwrap().into_iter().map(|item| item.key).collect::<Vec<_>>();
        assert_eq!(keys(""), ["a/c/1/0", "a/zarr.json", "ab"]);
        assert_eq!(keys("a/"), ["a/c/1/0", "a/zarr.json"]);
        assert_eq!(keys("a/c/"), ["a/c/1/0"]);
        shelf.put("a/parts", b"0123456789").unwrap();
        assert_eq!(shelf.tail("a/parts", 3).unwrap(), Some((b"789".to_vec(), 10)));
        assert_eq!(shelf.tail("a/parts", 30).unwrap(), Some((b"0123456789".to_vec(), 10)));
        assert_eq!(shelf.range("a/parts", 8, 9).unwrap().as_deref(), Some(b"89".as_slice()));
        assert_eq!((shelf.tail("a/none", 3).unwrap(), shelf.range("a/none", 0, 9).unwrap()), (None, None));
        shelf.put(".tiles/3/7", b"tile").unwrap();
        for key in ["a/parts", ".tiles/3/7", ".tiles/3/7"] {
            shelf.remove(key).unwrap();
        }
        assert!(!place.join(".tiles").exists() && place.join("a").exists());
        shelf.sweep().unwrap();
        assert!(!place.join("a/c/1/.0.123.7.tmp").exists() && place.join("a/c/1/0").exists());
    }
}
