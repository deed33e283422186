//! Expressions of the parameters of a machine: numbers, names, `+ - * / ^`, parentheses, `pi`, and a few functions.
//!
//! `^` binds closest and to the right, a sign in front binds weaker than `^`: `-2^2` is -4. The functions come from
//! `libm`, so an expression has the same bits on every platform.

use super::named::Named;
use thiserror::Error;

/// An expression that has no value.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ExpressionError {
    /// A sign or the end where a number is expected.
    #[error("the expression `{text}` has {found} where a number, a name or a parenthesis is expected")]
    Expected {
        /// The expression.
        text: String,
        /// What stands there.
        found: String,
    },
    /// Something after the end of the expression.
    #[error("the expression `{text}` does not end before {found}")]
    Rest {
        /// The expression.
        text: String,
        /// What stands there.
        found: String,
    },
    /// A parenthesis that is not closed.
    #[error("the expression `{0}` lacks a closing parenthesis")]
    Open(String),
    /// More nested parts than any formula has.
    #[error("the expression is nested too deeply")]
    Deep,
    /// A name that is no parameter.
    #[error("`{name}` is no parameter of this machine\nhint: {known}")]
    Unknown {
        /// The name.
        name: String,
        /// The known names, as a sentence.
        known: String,
    },
    /// A value that is not finite.
    #[error("the expression `{text}` is {value}, which is not a finite number")]
    NotFinite {
        /// The expression.
        text: String,
        /// Its value.
        value: f64,
    },
}

/// The largest depth of parentheses and signs.
const DEPTH: u32 = 64;

/// The functions, by name.
type Function = fn(f64) -> f64;
const FUNCTIONS: [(&str, Function); 6] = [
    ("sqrt", libm::sqrt),
    ("sin", libm::sin),
    ("cos", libm::cos),
    ("tan", libm::tan),
    ("exp", libm::exp),
    ("abs", libm::fabs),
];

/// Whether a name has a meaning in expressions, so that no parameter can have it.
pub(super) fn reserved(name: &str) -> bool {
    name == "pi" || FUNCTIONS.iter().any(|(known, _)| *known == name)
}

/// The value of an expression.
pub(super) fn evaluate(text: &str, parameters: &Named<f64>) -> Result<f64, ExpressionError> {
    let mut reader = Reader { text, rest: text, parameters, depth: 0 };
    let value = reader.sum()?;
    if !reader.rest.trim_start().is_empty() {
        return Err(ExpressionError::Rest { text: text.to_owned(), found: reader.found() });
    }
    if value.is_finite() { Ok(value) } else { Err(ExpressionError::NotFinite { text: text.to_owned(), value }) }
}

struct Reader<'a> {
    text: &'a str,
    rest: &'a str,
    parameters: &'a Named<f64>,
    depth: u32,
}

impl Reader<'_> {
    /// Whether one of these signs is next; it is passed then.
    fn passes(&mut self, signs: &[char]) -> Option<char> {
        self.rest = self.rest.trim_start();
        let sign = self.rest.chars().next().filter(|sign| signs.contains(sign))?;
        self.rest = &self.rest[sign.len_utf8()..];
        Some(sign)
    }

    /// What is next, for an error.
    fn found(&self) -> String {
        self.rest.trim_start().chars().next().map_or_else(|| "its end".to_owned(), |sign| format!("`{sign}`"))
    }

    fn sum(&mut self) -> Result<f64, ExpressionError> {
        let mut value = self.product()?;
        while let Some(sign) = self.passes(&['+', '-']) {
            let other = self.product()?;
            value = if sign == '+' { value + other } else { value - other };
        }
        Ok(value)
    }

    fn product(&mut self) -> Result<f64, ExpressionError> {
        let mut value = self.signed()?;
        while let Some(sign) = self.passes(&['*', '/']) {
            let other = self.signed()?;
            value = if sign == '*' { value * other } else { value / other };
        }
        Ok(value)
    }

    fn signed(&mut self) -> Result<f64, ExpressionError> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(ExpressionError::Deep);
        }
        let value = match self.passes(&['+', '-']) {
            Some('-') => -self.signed()?,
            Some(_) => self.signed()?,
            None => {
                let base = self.atom()?;
                if self.passes(&['^']).is_some() { libm::pow(base, self.signed()?) } else { base }
            }
        };
        self.depth -= 1;
        Ok(value)
    }

    fn atom(&mut self) -> Result<f64, ExpressionError> {
        if self.passes(&['(']).is_some() {
            return self.closed();
        }
        self.rest = self.rest.trim_start();
        let end = |text: &str, inside: fn(char) -> bool| text.find(|c| !inside(c)).unwrap_or(text.len());
        let word = &self.rest[..end(self.rest, |c| c.is_ascii_alphanumeric() || c == '_')];
        if word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            self.rest = &self.rest[word.len()..];
            return self.named(word);
        }
        let digits = end(self.rest, |c| c.is_ascii_digit() || c == '.');
        let (mantissa, rest) = self.rest.split_at(digits);
        // an exponent belongs to a number only with a digit behind it
        let exponent = rest.strip_prefix(['e', 'E']).map_or(0, |after| {
            let unsigned = after.strip_prefix(['+', '-']).unwrap_or(after);
            let count = end(unsigned, |c| c.is_ascii_digit());
            if count > 0 { rest.len() - unsigned.len() + count } else { 0 }
        });
        let length = mantissa.len() + exponent;
        let value = self.rest[..length]
            .parse()
            .map_err(|_| ExpressionError::Expected { text: self.text.to_owned(), found: self.found() })?;
        self.rest = &self.rest[length..];
        Ok(value)
    }

    /// What stands in a parenthesis that is open, up to its end.
    fn closed(&mut self) -> Result<f64, ExpressionError> {
        let value = self.sum()?;
        self.passes(&[')']).map(|_| value).ok_or_else(|| ExpressionError::Open(self.text.to_owned()))
    }

    fn named(&mut self, name: &str) -> Result<f64, ExpressionError> {
        if let Some((_, function)) = FUNCTIONS.iter().find(|(known, _)| *known == name) {
            let open = self.passes(&['(']).is_some();
            let expected = || ExpressionError::Expected { text: self.text.to_owned(), found: self.found() };
            return if open { self.closed().map(function) } else { Err(expected()) };
        }
        if name == "pi" {
            return Ok(core::f64::consts::PI);
        }
        self.parameters.get(name).copied().ok_or_else(|| ExpressionError::Unknown {
            name: name.to_owned(),
            known: match self.parameters.names() {
                names if names.is_empty() => "it has none; a table [parameters] holds them".to_owned(),
                names => format!("its parameters are {}", names.join(", ")),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, ExpressionError> {
        evaluate(text, &Named::from_iter([("mu", 0.25), ("e1", 2.0)]))
    }

    #[test]
    fn values() {
        for (text, wanted) in [
            ("1/(1+mu)", 0.8),
            ("-2^2", -4.0),
            ("2^-1", 0.5),
            ("2^3^2", 512.0),
            ("2 - 3 - 4", -5.0),
            ("8/2/2", 2.0),
            ("2*-3", -6.0),
            ("e1*1e1 + .5", 20.5),
            ("sqrt(4)*pi", 2.0 * core::f64::consts::PI),
            ("abs(-mu)", 0.25),
            ("1e3", 1000.0),
            ("2E-2", 0.02),
        ] {
            assert_eq!(value(text), Ok(wanted), "{text}");
        }
    }

    #[test]
    fn what_has_no_value_is_explained() {
        for (text, said) in [
            ("", "has its end where"),
            ("1 +", "has its end where"),
            ("1 + *", "has `*` where"),
            ("(1", "lacks a closing"),
            ("1)", "does not end before `)`"),
            ("2 mu", "does not end before `m`"),
            ("2e", "does not end before `e`"),
            ("nu", "`nu` is no parameter of this machine\nhint: its parameters are mu, e1"),
            ("sqrt mu", "has `m` where"),
            ("1/0", "is inf"),
            ("sqrt(-1)", "is NaN"),
            ("1..2", "has `1` where"),
        ] {
            let told = value(text).expect_err(text).to_string();
            assert!(told.contains(said), "{text}: {told}");
        }
        assert_eq!(value(&"(".repeat(9999)), Err(ExpressionError::Deep));
        assert_eq!(value(&"-".repeat(9999)), Err(ExpressionError::Deep));
    }
}
