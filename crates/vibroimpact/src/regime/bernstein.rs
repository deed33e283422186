//! Polynomials of the ninth degree on [0, 1] in Bernstein's form: a polynomial lies within the hull of its coefficients
//! there.

/// Number of coefficients of a polynomial of the ninth degree.
pub(crate) const TERMS: usize = 10;

/// $`\binom{k}{j} / \binom{9}{j}`$, row j.
const FROM_POWERS: [[f64; TERMS]; TERMS] = {
    let mut table = [[0.0; TERMS]; TERMS];
    let mut j = 0;
    while j < TERMS {
        let mut k = j;
        while k < TERMS {
            table[j][k] = TO_BERNSTEIN[k][j];
            k += 1;
        }
        j += 1;
    }
    table
};

/// $`\binom{j}{k} / \binom{9}{k}`$, row j.
const TO_BERNSTEIN: [[f64; TERMS]; TERMS] = {
    let mut table = [[0.0; TERMS]; TERMS];
    let mut j = 0;
    while j < TERMS {
        let mut k = 0;
        let mut value = 1.0;
        let (mut top, mut bottom) = (j, TERMS - 1);
        while k <= j {
            table[j][k] = value;
            if k < j {
                // the next quotient of binomial coefficients from this one
                #[allow(clippy::cast_precision_loss)]
                {
                    value = value * (top as f64) / (bottom as f64);
                }
                top -= 1;
                bottom -= 1;
            }
            k += 1;
        }
        j += 1;
    }
    table
};

/// The Bernstein coefficients of a polynomial, from its coefficients in powers.
pub(crate) fn bernstein(p: &[f64; TERMS]) -> [f64; TERMS] {
    let mut b = [0.0; TERMS];
    // column by column, so that vector instructions compute several values at once
    for (p, row) in p.iter().zip(&FROM_POWERS) {
        for (value, factor) in b.iter_mut().zip(row) {
            *value += p * factor;
        }
    }
    b
}
