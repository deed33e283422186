//! Kinds of damage to the objects of a store.

use proptest::prelude::*;
use proptest::sample::Index;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;

/// All files of a store, by their names.
pub(super) type Files = BTreeMap<String, Vec<u8>>;

/// One kind of damage to an object of a store.
#[derive(Clone, Debug)]
pub(super) enum Damage {
    Flip(Index, Index, u8),
    Cut(Index, Index),
    Empty(Index),
    Delete(Index),
    Append(Index, Vec<u8>),
    Write(Index, &'static str),
    Swap(Index, Index),
    Folder(Index),
}

impl Damage {
    /// The strategy by which damage is drawn.
    pub(super) fn strategy() -> BoxedStrategy<Self> {
        let at = any::<Index>;
        let texts = prop::sample::select(vec![
            "{",
            "{}",
            "null",
            "[]",
            "\"\"",
            "{\"zarr_format\":3,\"node_type\":\"array\"}",
            "\u{0}\u{0}",
        ]);
        prop_oneof![
            5 => (at(), at(), 0..8_u8).prop_map(|(file, byte, bit)| Damage::Flip(file, byte, bit)),
            2 => (at(), at()).prop_map(|(file, end)| Damage::Cut(file, end)),
            1 => at().prop_map(Damage::Empty),
            2 => at().prop_map(Damage::Delete),
            1 => (at(), prop::collection::vec(any::<u8>(), 1..40)).prop_map(|(file, more)| Damage::Append(file, more)),
            2 => (at(), texts).prop_map(|(file, text)| Damage::Write(file, text)),
            2 => (at(), at()).prop_map(|(file, other)| Damage::Swap(file, other)),
            1 => at().prop_map(Damage::Folder),
        ]
        .boxed()
    }

    /// Selects the damaged object.
    fn place(&self) -> Index {
        let (Self::Flip(at, ..)
        | Self::Cut(at, _)
        | Self::Empty(at)
        | Self::Delete(at)
        | Self::Append(at, _)
        | Self::Write(at, _)
        | Self::Swap(at, _)
        | Self::Folder(at)) = self;
        *at
    }

    /// A description of the damage, with the names of the objects.
    pub(super) fn told(&self, files: &Files) -> String {
        let names: Vec<&String> = files.keys().collect();
        let name = *self.place().get(&names);
        let size = files[name].len().max(1);
        match self {
            Self::Flip(_, byte, bit) => format!("bit {bit} of byte {} of {name} flipped", byte.index(size)),
            Self::Cut(_, end) => format!("{name} cut to {} bytes", end.index(size)),
            Self::Empty(_) => format!("{name} empty"),
            Self::Delete(_) => format!("{name} deleted"),
            Self::Append(_, more) => format!("{name} with the bytes {more:?} after its end"),
            Self::Write(_, text) => format!("`{text}` in {name}"),
            Self::Swap(_, other) => format!("{} copied over {name}", other.get(&names)),
            Self::Folder(_) => format!("a folder in the place of {name}"),
        }
    }
}

/// All files under a folder.
pub(super) fn files(root: &Path) -> io::Result<Files> {
    let mut found = Files::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(root).unwrap_or(&path).to_string_lossy().into_owned();
                found.insert(name, fs::read(&path)?);
            }
        }
    }
    Ok(found)
}

/// Writes the files into a folder.
pub(super) fn write(files: &Files, root: &Path) -> io::Result<()> {
    for (name, bytes) in files {
        let path = root.join(name);
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::write(path, bytes)?;
    }
    Ok(())
}

/// Applies several kinds of damage, one after another.
pub(super) fn damage(files: &Files, root: &Path, damage: &[Damage]) -> io::Result<()> {
    let names: Vec<&String> = files.keys().collect();
    for one in damage {
        let path = root.join(one.place().get(&names));
        // an earlier damage may have removed the object
        let Ok(mut bytes) = fs::read(&path) else { continue };
        match one {
            Damage::Flip(_, byte, bit) if !bytes.is_empty() => {
                let k = byte.index(bytes.len());
                bytes[k] ^= 1 << bit;
            }
            Damage::Cut(_, end) => bytes.truncate(end.index(bytes.len().max(1))),
            Damage::Append(_, more) => bytes.extend(more),
            Damage::Write(_, text) => bytes = text.as_bytes().to_vec(),
            Damage::Swap(_, other) => bytes.clone_from(&files[*other.get(&names)]),
            Damage::Flip(..) | Damage::Empty(_) => bytes.clear(),
            Damage::Delete(_) | Damage::Folder(_) => {
                fs::remove_file(&path)?;
                if matches!(one, Damage::Folder(_)) {
                    fs::create_dir(&path)?;
                }
                continue;
            }
        }
        fs::write(&path, bytes)?;
    }
    Ok(())
}
