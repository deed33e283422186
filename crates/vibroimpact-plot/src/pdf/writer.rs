//! The objects of a file of PDF while its page is drawn.

use std::collections::BTreeMap;

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::{Name, Pdf, Ref};
use resvg::tiny_skia::Transform;

use crate::error::PlotError;

/// The key of the resources of a page and of a tile.
pub(super) const RESOURCES: Name<'_> = Name(b"Resources");

/// The objects of the file, and what they have in common.
pub(super) struct Writer {
    pub(super) pdf: Pdf,
    /// The number of the next object.
    pub(super) next: Ref,
    /// The dictionary of the resources, for the page and the tiles of hatches.
    pub(super) shared: Ref,
    /// From figure units to points of the page.
    pub(super) to_page: Transform,
    /// The objects that drawings name, by kind and name.
    pub(super) resources: BTreeMap<&'static str, BTreeMap<String, Ref>>,
}

impl Writer {
    /// The number of a new resource, or `None` if the name has one.
    pub(super) fn add(&mut self, kind: &'static str, name: &str) -> Option<Ref> {
        let members = self.resources.entry(kind).or_default();
        if members.contains_key(name) {
            return None;
        }
        let id = self.next.bump();
        members.insert(name.to_owned(), id);
        Some(id)
    }
}

/// The six numbers of a transform in the order of PDF.
pub(super) fn matrix(t: Transform) -> [f32; 6] {
    [t.sx, t.ky, t.kx, t.sy, t.tx, t.ty]
}

/// Compressed bytes. Higher levels take longer and save little.
pub(super) fn packed(bytes: &[u8]) -> Vec<u8> {
    compress_to_vec_zlib(bytes, 6)
}

/// Something that no figure has.
pub(super) fn unknown(what: &str) -> PlotError {
    PlotError::Pdf(format!("{what} is not supported"))
}
