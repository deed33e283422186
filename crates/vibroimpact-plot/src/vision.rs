//! Simulation of colours for colour-blind readers and grey printers.
//!
//! Dichromacy follows G. M. Machado, M. M. Oliveira and L. A. F. Fernandes, "A physiologically-based model for
//! simulation of color vision deficiency", IEEE Trans. Vis. Comput. Graph. 15 (2009) 1291-1298,
//! doi:10.1109/TVCG.2009.113: their matrices for severity 1.0 are applied to linear light. Grey is the luminance of
//! ITU-R BT.709.

use crate::colour::Colour;

/// A kind of colour vision, or a grey printer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Vision {
    /// Normal trichromatic vision.
    Normal,
    /// No long-wave (red) cones.
    Protanopia,
    /// No medium-wave (green) cones.
    Deuteranopia,
    /// A printer without colour.
    Grey,
}

impl Vision {
    /// The colour as it appears in this kind of vision.
    pub(crate) fn see(self, colour: Colour) -> Colour {
        let matrix = match self {
            Self::Normal => return colour,
            Self::Protanopia => [
                [0.152_286, 1.052_583, -0.204_868],
                [0.114_503, 0.786_281, 0.099_216],
                [-0.003_882, -0.048_116, 1.051_998],
            ],
            Self::Deuteranopia => [
                [0.367_322, 0.860_646, -0.227_968],
                [0.280_085, 0.672_501, 0.047_413],
                [-0.011_820, 0.042_940, 0.968_881],
            ],
            Self::Grey => [[0.212_6, 0.715_2, 0.072_2]; 3],
        };
        let [r, g, b] = colour.linear();
        let seen = matrix.map(|row| row[0] * r + row[1] * g + row[2] * b);
        Colour { a: colour.a, ..Colour::from_linear(seen) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn greys_stay_grey() {
        let grey = Colour::hex(0x80_8080);
        for eye in [Vision::Normal, Vision::Protanopia, Vision::Deuteranopia, Vision::Grey] {
            assert!(eye.see(grey).delta_e(grey) < 1.0, "{eye:?}");
        }
    }

    #[test]
    fn red_and_green_come_closer() {
        let (red, green) = (Colour::hex(0xd0_4040), Colour::hex(0x70_9030));
        let apart = red.delta_e(green);
        assert!(Vision::Deuteranopia.see(red).delta_e(Vision::Deuteranopia.see(green)) < apart / 2.0);
    }
}
