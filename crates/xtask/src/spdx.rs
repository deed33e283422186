//! Licence expressions as crates state them: SPDX, and the older `MIT/Apache-2.0`.
//!
//! ```text
//! expression = both { ("OR" | "/") both }
//! both       = single { "AND" single }
//! single     = "(" expression ")" | licence [ "WITH" exception ]
//! ```

/// True where the expression can be satisfied with licences that `allowed` accepts: one side of
/// an `OR` is enough, both sides of an `AND` are needed. A licence with an exception is asked
/// for as one name, `Apache-2.0 WITH LLVM-exception`.
///
/// # Errors
/// The sentence that says what in the expression cannot be read.
pub(crate) fn satisfied(expression: &str, allowed: &dyn Fn(&str) -> bool) -> Result<bool, String> {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let mut reader = Reader { words: spaced.split_whitespace().collect(), next: 0, allowed };
    let answer = reader.expression()?;
    match reader.peek() {
        None => Ok(answer),
        Some(word) => Err(format!("`{word}` was not expected there")),
    }
}

struct Reader<'a> {
    words: Vec<&'a str>,
    next: usize,
    allowed: &'a dyn Fn(&str) -> bool,
}

impl<'a> Reader<'a> {
    fn peek(&self) -> Option<&'a str> {
        self.words.get(self.next).copied()
    }

    /// Steps over `word` if it comes next.
    fn take(&mut self, word: &str) -> bool {
        let found = self.peek() == Some(word);
        self.next += usize::from(found);
        found
    }

    // `|` and `&`, not `||` and `&&`: the right side must be read in any case

    fn expression(&mut self) -> Result<bool, String> {
        let mut answer = self.both()?;
        while self.take("OR") {
            answer |= self.both()?;
        }
        Ok(answer)
    }

    fn both(&mut self) -> Result<bool, String> {
        let mut answer = self.single()?;
        while self.take("AND") {
            answer &= self.single()?;
        }
        Ok(answer)
    }

    fn single(&mut self) -> Result<bool, String> {
        if self.take("(") {
            let answer = self.expression()?;
            return if self.take(")") { Ok(answer) } else { Err("a bracket is not closed".to_owned()) };
        }
        let licence = self.name()?;
        if self.take("WITH") {
            let exception = self.name()?;
            return Ok((self.allowed)(&format!("{licence} WITH {exception}")));
        }
        Ok((self.allowed)(licence))
    }

    fn name(&mut self) -> Result<&'a str, String> {
        match self.peek() {
            Some(word @ ("OR" | "AND" | "WITH" | "(" | ")")) => Err(format!("a licence was expected before `{word}`")),
            Some(word) => {
                self.next += 1;
                Ok(word)
            }
            None => Err("a licence was expected at the end".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ask(expression: &str) -> Result<bool, String> {
        satisfied(expression, &|licence| {
            ["MIT", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "Zlib"].contains(&licence)
        })
    }

    #[test]
    fn one_side_of_or_is_enough() {
        assert_eq!(ask("MIT"), Ok(true));
        assert_eq!(ask("GPL-3.0-only"), Ok(false));
        assert_eq!(ask("GPL-3.0-only OR MIT"), Ok(true));
        assert_eq!(ask("MIT OR GPL-3.0-only"), Ok(true));
        assert_eq!(ask("GPL-2.0-only OR GPL-3.0-only"), Ok(false));
        assert_eq!(ask("MIT/Apache-2.0"), Ok(true));
        assert_eq!(ask("GPL-3.0-only / MIT"), Ok(true));
    }

    #[test]
    fn both_sides_of_and_are_needed_and_and_binds_closer() {
        assert_eq!(ask("MIT AND Zlib"), Ok(true));
        assert_eq!(ask("MIT AND GPL-3.0-only"), Ok(false));
        assert_eq!(ask("(MIT OR GPL-3.0-only) AND Zlib"), Ok(true));
        assert_eq!(ask("(MIT OR Zlib) AND GPL-3.0-only"), Ok(false));
        assert_eq!(ask("MIT OR Zlib AND GPL-3.0-only"), Ok(true));
        assert_eq!(ask("GPL-3.0-only AND Zlib OR GPL-2.0-only"), Ok(false));
    }

    #[test]
    fn an_exception_is_part_of_the_name() {
        assert_eq!(ask("Apache-2.0 WITH LLVM-exception"), Ok(true));
        assert_eq!(ask("MIT WITH LLVM-exception"), Ok(false));
        assert_eq!(ask("GPL-3.0-only OR Apache-2.0 WITH LLVM-exception"), Ok(true));
    }

    #[test]
    fn a_near_name_is_another_licence() {
        assert_eq!(ask("MIT-0"), Ok(false));
        assert_eq!(ask("mit"), Ok(false));
        assert_eq!(ask("Apache-2.0+"), Ok(false));
    }

    #[test]
    fn what_cannot_be_read_is_an_error() {
        for expression in ["", "MIT OR", "OR MIT", "(MIT", "MIT)", "MIT Zlib", "MIT WITH", "()"] {
            assert!(ask(expression).is_err(), "{expression}");
        }
    }
}
