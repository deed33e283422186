//! A place in memory, for studies whose results are read at once and not kept.

use crate::shelf::{Item, Shelf};
use std::collections::BTreeMap;
use std::io;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

/// Objects in memory.
#[derive(Debug, Default)]
pub struct Memory {
    objects: Mutex<BTreeMap<String, Vec<u8>>>,
}

impl Memory {
    fn objects(&self) -> MutexGuard<'_, BTreeMap<String, Vec<u8>>> {
        self.objects.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Shelf for Memory {
    fn get(&self, key: &str) -> io::Result<Option<Vec<u8>>> {
        Ok(self.objects().get(key).cloned())
    }

    fn remove(&self, key: &str) -> io::Result<()> {
        self.objects().remove(key);
        Ok(())
    }

    fn put(&self, key: &str, bytes: &[u8]) -> io::Result<()> {
        self.objects().insert(key.to_owned(), bytes.to_vec());
        Ok(())
    }

    fn list(&self, prefix: &str) -> io::Result<Vec<Item>> {
        let objects = self.objects();
        let below = objects.range(prefix.to_owned()..).take_while(|(key, _)| key.starts_with(prefix));
        // nothing depends on the times of objects that no other process can see
        let item = |(key, bytes): (&String, &Vec<u8>)| Item {
            key: key.clone(),
            size: bytes.len() as u64,
            modified: SystemTime::UNIX_EPOCH,
        };
        Ok(below.map(item).collect())
    }

    fn sweep(&self) -> io::Result<()> {
        Ok(())
    }

    fn name(&self) -> String {
        "memory".to_owned()
    }
}
