//! Images: the cells of rasters.

use pdf_writer::{Content, Filter, Name};
use resvg::tiny_skia::Pixmap;
use resvg::usvg::{Image, ImageKind};

use super::writer::{Writer, packed, unknown};
use crate::error::PlotError;

impl Writer {
    /// Draws an image of PNG bytes with one pixel for each unit, as the group around it expects.
    pub(super) fn image(&mut self, image: &Image, out: &mut Content) -> Result<(), PlotError> {
        let ImageKind::PNG(png) = image.kind() else { return Err(unknown("an image that is no PNG")) };
        let picture = Pixmap::decode_png(png).map_err(|e| PlotError::Pdf(e.to_string()))?;
        let size = |side: u32| i32::try_from(side).map_err(|_| unknown("an image of this size"));
        let (width, height) = (size(picture.width())?, size(picture.height())?);
        let pixels = || picture.pixels().iter().map(|pixel| pixel.demultiply());
        let colours: Vec<u8> = pixels().flat_map(|c| [c.red(), c.green(), c.blue()]).collect();
        let opacities: Vec<u8> = pixels().map(|c| c.alpha()).collect();
        let transparent = opacities.iter().any(|a| *a < 255).then(|| self.next.bump());
        let name = format!("image-{}", self.next.get());
        let Some(id) = self.add("XObject", &name) else { return Ok(()) };
        if let Some(mask) = transparent {
            let bytes = packed(&opacities);
            let mut object = self.pdf.image_xobject(mask, &bytes);
            object.filter(Filter::FlateDecode);
            object.width(width).height(height).bits_per_component(8).color_space().device_gray();
        }
        let bytes = packed(&colours);
        let mut object = self.pdf.image_xobject(id, &bytes);
        object.filter(Filter::FlateDecode);
        object.width(width).height(height).bits_per_component(8).color_space().device_rgb();
        if let Some(mask) = transparent {
            object.s_mask(mask);
        }
        drop(object);
        // an image fills the square from 0 to 1, its first row at the upper edge
        let (width, height) = (image.size().width(), image.size().height());
        out.save_state().transform([width, 0.0, 0.0, -height, 0.0, height]);
        out.x_object(Name(name.as_bytes())).restore_state();
        Ok(())
    }
}
