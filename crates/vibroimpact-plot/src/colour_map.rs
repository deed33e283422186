//! The colours of a continuous quantity.
//!
//! The map is viridis of N. J. Smith, S. van der Walt and E. Firing (2015), the default of matplotlib: equal steps of the
//! quantity are equal differences of colour, its lightness rises from one end to the other, so it can be read in grey
//! print, and its hues lie on the blue-yellow axis, which red-green blindness does not affect. The tests check this.

use crate::colour::Colour;

/// The number of colours of the map in a figure. Neighbours differ by less than an eye can see.
pub const COLOUR_STEPS: usize = 256;

/// The colour at a place in the map: 0 is the dark end, 1 the light end; other numbers are limited to this range.
#[must_use]
pub fn colour_at(place: f64) -> Colour {
    let place = if place.is_nan() { 0.0 } else { place.clamp(0.0, 1.0) };
    let colorous::Color { r, g, b } = colorous::VIRIDIS.eval_continuous(place);
    Colour { r, g, b, a: 255 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vision::Vision;

    fn colours() -> Vec<Colour> {
        (0..=16).map(|k| colour_at(f64::from(k) / 16.0)).collect()
    }

    #[test]
    fn equal_steps_are_equal_differences_of_colour() {
        let colours = colours();
        let steps: Vec<f64> = colours.windows(2).map(|pair| pair[0].delta_e(pair[1])).collect();
        let mean = steps.iter().sum::<f64>() / steps.len() as f64;
        // the map is uniform in CAM02-UCS, so steps in CIE 1976 differ somewhat
        assert!(steps.iter().all(|step| (0.5..1.9).contains(&(step / mean))), "{steps:?}");
    }

    /// Every eye, and a grey printer, sees the order of values.
    #[test]
    fn the_lightness_rises_for_every_eye() {
        for eye in [Vision::Normal, Vision::Protanopia, Vision::Deuteranopia, Vision::Grey] {
            let light: Vec<f64> = colours().into_iter().map(|colour| eye.see(colour).lab()[0]).collect();
            assert!(light.windows(2).all(|pair| pair[1] > pair[0] + 2.0), "{eye:?}: {light:?}");
        }
    }

    #[test]
    fn places_outside_have_the_colours_of_the_ends() {
        assert_eq!((colour_at(-1.0), colour_at(f64::NAN)), (colour_at(0.0), colour_at(0.0)));
        assert_eq!(colour_at(f64::INFINITY), colour_at(1.0));
        assert_eq!((colour_at(0.0).to_hex(), colour_at(1.0).to_hex()), ("#440154".into(), "#fde725".into()));
    }
}
