//! A figure without colours: each colour of its SVG text becomes the grey of its luminance.

use crate::colour::Colour;
use crate::vision::Vision;

/// The mark before a colour. Text cannot contain it, because quotes in text are escaped.
const BEFORE: &str = "=\"#";
/// Number of digits of a colour.
const DIGITS: usize = 6;

/// The SVG text with all its colours replaced by greys. Images are not changed.
pub(crate) fn greyed(svg: &str) -> String {
    let mut parts = svg.split(BEFORE);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        out.push_str(BEFORE);
        let colour = part.get(..DIGITS).and_then(|digits| u32::from_str_radix(digits, 16).ok());
        match colour {
            Some(rgb) => {
                // to_hex begins with the same `#`
                out.push_str(&Vision::Grey.see(Colour::hex(rgb)).to_hex()[1..]);
                out.push_str(&part[DIGITS..]);
            }
            None => out.push_str(part),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::greyed;

    #[test]
    fn colours_become_greys_and_nothing_else_changes() {
        let svg = "<a fill=\"#ff0000\" href=\"#clip0\">fill=&quot;#ff0000&quot; #ff0000</a>";
        let grey = greyed(svg);
        assert_eq!(grey.replace("#7f7f7f\" href", "#ff0000\" href"), svg, "{grey}");
        assert!(grey.starts_with("<a fill=\"#7f7f7f\""), "{grey}");
    }
}
