//! The harness's one error: what went wrong, where, and why.

use std::fmt;

/// What went wrong, where, and the cause beneath; always one line when printed.
#[derive(Debug)]
pub struct Error {
    what: String,
    place: Option<String>,
    cause: Option<Box<dyn std::error::Error + Send + Sync>>,
    exit: u8,
}

/// The harness's result.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// A run that broke: exit code 1.
    pub fn broken(what: impl Into<String>) -> Self {
        Self { what: what.into(), place: None, cause: None, exit: 1 }
    }

    /// Wrong usage or input: exit code 2. Say what would be accepted.
    pub fn usage(what: impl Into<String>) -> Self {
        Self { exit: 2, ..Self::broken(what) }
    }

    /// Where it went wrong: a path, a claim, a flag.
    pub fn at(mut self, place: impl fmt::Display) -> Self {
        self.place = Some(place.to_string());
        self
    }

    /// The cause beneath.
    pub fn because(mut self, cause: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Self {
        self.cause = Some(cause.into());
        self
    }

    /// The exit code that it deserves.
    pub fn exit_code(&self) -> u8 {
        self.exit
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut line = self.what.clone();
        if let Some(place) = &self.place {
            line = if line.is_empty() { place.clone() } else { format!("{place}: {line}") };
        }
        if let Some(cause) = &self.cause {
            let colon = if self.what.is_empty() && self.place.is_none() { "" } else { ": " };
            line = format!("{line}{colon}{cause}");
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        f.write_str(&words.join(" "))
    }
}

/// Any error of a library is the cause of one of ours. (So ours is none itself: it ends in `main`.)
impl<E: std::error::Error + Send + Sync + 'static> From<E> for Error {
    fn from(cause: E) -> Self {
        Error::broken("").because(cause)
    }
}

/// Adds the place to an input or output error.
pub(crate) trait At<T> {
    /// The error says what was tried and on which path.
    fn at(self, what: &str, path: &std::path::Path) -> Result<T>;
}

impl<T, E: Into<Box<dyn std::error::Error + Send + Sync>>> At<T> for std::result::Result<T, E> {
    fn at(self, what: &str, path: &std::path::Path) -> Result<T> {
        self.map_err(|cause| Error::broken(what).at(path.display()).because(cause))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_one_line() {
        let error = Error::usage("not a\nnumber").at("--beta").because("a\n cause");
        assert_eq!(error.to_string(), "--beta: not a number: a cause");
        assert_eq!(error.exit_code(), 2);
    }
}
