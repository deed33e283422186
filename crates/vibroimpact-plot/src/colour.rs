//! Colours: 8-bit sRGB with opacity, and their perceived difference.
//!
//! The difference is that of CIE 1976, the Euclidean distance in CIE L\*a\*b\* with white point D65 (CIE 15:2004). A
//! difference of about 2.3 is just noticeable side by side; patches in a legend need ten or more.

use serde::{Serialize, Serializer};

/// An sRGB colour with opacity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Colour {
    /// Red, 0 to 255.
    pub r: u8,
    /// Green, 0 to 255.
    pub g: u8,
    /// Blue, 0 to 255.
    pub b: u8,
    /// Opacity: 0 is invisible, 255 opaque.
    pub a: u8,
}

/// As `#rrggbbaa`.
impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(&format_args!("{}{:02x}", self.to_hex(), self.a))
    }
}

impl Colour {
    /// Black.
    pub const BLACK: Self = Self::hex(0x00_0000);
    /// White.
    pub const WHITE: Self = Self::hex(0xff_ffff);
    /// A dark grey for frames and walls.
    pub const GREY: Self = Self::hex(0x60_6060);

    /// The opaque colour `0xRRGGBB`.
    #[must_use]
    pub const fn hex(rgb: u32) -> Self {
        let [_, r, g, b] = rgb.to_be_bytes();
        Self { r, g, b, a: 255 }
    }

    /// The same colour with opacity `alpha`, limited to 0..=1.
    #[must_use]
    pub fn alpha(self, alpha: f64) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "cut to 0..=255 just before; NaN gives 0")]
        let a = (alpha.clamp(0.0, 1.0) * 255.0).round() as u8;
        Self { a, ..self }
    }

    /// The colour as `#rrggbb`, without its opacity.
    #[must_use]
    pub fn to_hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.r, self.g, self.b)
    }

    /// Linear-light red, green, blue in 0..=1 (IEC 61966-2-1).
    pub(crate) fn linear(self) -> [f64; 3] {
        [self.r, self.g, self.b].map(|v| {
            let v = f64::from(v) / 255.0;
            if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
        })
    }

    /// The opaque colour with these linear-light components, limited to 0..=1.
    pub(crate) fn from_linear(rgb: [f64; 3]) -> Self {
        let [r, g, b] = rgb.map(|v| {
            let v = v.clamp(0.0, 1.0);
            let v = if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
            #[expect(clippy::cast_possible_truncation, reason = "v lies in 0..=1")]
            let byte = (v * 255.0).round() as u8;
            byte
        });
        Self { r, g, b, a: 255 }
    }

    /// CIE L\*, a\*, b\* under D65.
    pub(crate) fn lab(self) -> [f64; 3] {
        let [r, g, b] = self.linear();
        let x = (0.412_456_4 * r + 0.357_576_1 * g + 0.180_437_5 * b) / 0.950_47;
        let y = 0.212_672_9 * r + 0.715_152_2 * g + 0.072_175_0 * b;
        let z = (0.019_333_9 * r + 0.119_192_0 * g + 0.950_304_1 * b) / 1.088_83;
        let [x, y, z] =
            [x, y, z].map(|t: f64| if t > 216.0 / 24_389.0 { t.cbrt() } else { (24_389.0 / 27.0 * t + 16.0) / 116.0 });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// The CIE 1976 colour difference to `other`.
    #[must_use]
    pub fn delta_e(self, other: Self) -> f64 {
        let (p, q) = (self.lab(), other.lab());
        (0..3).map(|i| (p[i] - q[i]).powi(2)).sum::<f64>().sqrt()
    }

    /// SVG attributes: `fill="#rrggbb"`, and `fill-opacity` if it is not opaque.
    pub(crate) fn paint(self, property: &str) -> String {
        let mut text = format!(" {property}=\"{}\"", self.to_hex());
        if self.a < 255 {
            let alpha = crate::number::N(f64::from(self.a) / 255.0);
            text.push_str(&format!(" {property}-opacity=\"{alpha}\""));
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::Colour;

    #[test]
    fn lab_of_known_colours() {
        // values of the sRGB primaries as tabulated by B. Lindbloom, brucelindbloom.com
        for (hex, lab) in [
            (0xff_ffff, [100.0, 0.0, 0.0]),
            (0x00_0000, [0.0, 0.0, 0.0]),
            (0xff_0000, [53.24, 80.09, 67.20]),
            (0x00_00ff, [32.30, 79.19, -107.86]),
        ] {
            let got = Colour::hex(hex).lab();
            for (got, want) in got.into_iter().zip(lab) {
                assert!((got - want).abs() < 0.02, "{hex:06x}: {got} for {want}");
            }
        }
    }

    #[test]
    fn linear_light_goes_there_and_back() {
        let c = Colour::hex(0x12_80fe);
        assert_eq!(Colour::from_linear(c.linear()), c);
        assert_eq!(c.alpha(0.5).paint("fill"), " fill=\"#1280fe\" fill-opacity=\"0.5\"");
        assert_eq!(c.alpha(f64::NAN).a, 0);
    }
}
