//! Numbers written as expressions: `pi/2`, `-3*pi/4`, `(0.5 + 0.2)/2`.

/// Deeper nesting is no number that a person writes.
const DEEPEST: usize = 32;

/// The value of an expression, and whether it contains `pi`; `None` if the
/// text is no expression.
pub(super) fn evaluate(text: &str) -> Option<(f64, bool)> {
    let mut parser = Parser {
        rest: text,
        depth: 0,
        pi: false,
    };
    let value = parser.sum()?;
    parser
        .rest
        .trim_start()
        .is_empty()
        .then_some((value, parser.pi))
}

struct Parser<'t> {
    rest: &'t str,
    depth: usize,
    pi: bool,
}

impl Parser<'_> {
    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        loop {
            if self.take("+") {
                value += self.product()?;
            } else if self.take("-") {
                value -= self.product()?;
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.factor()?;
        loop {
            if self.take("*") {
                value *= self.factor()?;
            } else if self.take("/") {
                value /= self.factor()?;
            } else {
                return Some(value);
            }
        }
    }

    fn factor(&mut self) -> Option<f64> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let value = if self.take("-") {
            -self.factor()?
        } else if self.take("(") {
            let value = self.sum()?;
            self.take(")").then_some(value)?
        } else if self.take("pi") {
            self.pi = true;
            std::f64::consts::PI
        } else {
            self.number()?
        };
        self.depth -= 1;
        Some(value)
    }

    fn number(&mut self) -> Option<f64> {
        let mut length = self.digits(0);
        if self.rest[length..].starts_with('.') {
            length = self.digits(length + 1);
        }
        if self.rest[length..].starts_with(['e', 'E']) {
            let sign = usize::from(self.rest[length + 1..].starts_with(['+', '-']));
            length = self.digits(length + 1 + sign);
        }
        let (number, rest) = self.rest.split_at(length);
        self.rest = rest;
        number.parse().ok()
    }

    /// Where the digits that start at `from` end.
    fn digits(&self, from: usize) -> usize {
        let other = self.rest[from..].find(|c: char| !c.is_ascii_digit());
        other.map_or(self.rest.len(), |length| from + length)
    }

    fn take(&mut self, token: &str) -> bool {
        self.rest = self.rest.trim_start();
        let rest = self.rest.strip_prefix(token);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::evaluate;
    use std::f64::consts::PI;

    #[test]
    fn arithmetic_as_usual() {
        for (text, value) in [
            ("1.5", 1.5),
            ("-3*pi/4", -3.0 * PI / 4.0),
            ("pi/2", PI / 2.0),
            ("2 - 3 - 4", -5.0),
            ("8/2/2", 2.0),
            ("-(1 + 2)*2e-1", -3.0 * 0.2),
            ("--1", 1.0),
            (".5", 0.5),
        ] {
            assert_eq!(evaluate(text).map(|v| v.0), Some(value), "{text}");
        }
    }

    #[test]
    fn pi_is_told() {
        assert_eq!(evaluate("2*pi").map(|v| v.1), Some(true));
        assert_eq!(evaluate("2*3").map(|v| v.1), Some(false));
    }

    #[test]
    fn anything_else_is_no_number() {
        let deep = "(".repeat(100_000);
        for text in [
            "", "pie", "1 2", "1,2", "(1", "1+", "e5", "1e", "°", "nan", "inf", "0x1", "2pi", &deep,
        ] {
            assert_eq!(evaluate(text), None, "{text:.20}");
        }
    }
}
