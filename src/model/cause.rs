use std::error::Error;
use std::fmt;
use std::sync::Arc;

/// The error of a library behind an error of this program: its text and its sources.
///
/// Two causes are always equal: errors are compared by what this program found, and not by how a library words it.
#[derive(Clone)]
pub struct Cause(Arc<dyn Error + Send + Sync>);

impl Cause {
    /// Keeps an error of a library with its sources.
    pub fn new(error: impl Error + Send + Sync + 'static) -> Self {
        Self(Arc::new(error))
    }

    /// A finding of this program itself, where other findings of the same kind come from a library.
    pub fn finding(text: &'static str) -> Self {
        Self::told(text)
    }

    /// The text of an error that is no [`Error`], as those of libraries that do without `std`.
    pub fn told(text: impl fmt::Display) -> Self {
        Self::new(Told(text.to_string()))
    }

    /// Equal to every other cause.
    #[cfg(test)]
    pub fn any() -> Self {
        Self::finding("any cause")
    }
}

/// For `map_err`: makes an error that keeps the library's error as its [`Cause`].
pub fn with_cause<E: Error + Send + Sync + 'static, T>(make: impl FnOnce(Cause) -> T) -> impl FnOnce(E) -> T {
    move |error| make(Cause::new(error))
}

/// [`with_cause`] for an error that is no [`Error`]: only its text is kept.
pub fn with_told_cause<E: fmt::Display, T>(make: impl FnOnce(Cause) -> T) -> impl FnOnce(E) -> T {
    move |error| make(Cause::told(error))
}

/// An error's text and those of its sources, joined by `: `. A source whose text the error quotes is not repeated.
pub fn with_sources(error: &(dyn Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut next = error.source();
    while let Some(source) = next {
        let of_source = source.to_string();
        if !text.contains(&of_source) {
            text = format!("{text}: {of_source}");
        }
        next = source.source();
    }
    text
}

impl PartialEq for Cause {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Cause {}

impl fmt::Debug for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Error for Cause {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.0.source()
    }
}

#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct Told(String);

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq, thiserror::Error)]
    enum Outer {
        #[error("it cannot be read")]
        Unreadable(#[source] Cause),
        #[error("it cannot be read ({0})")]
        Quoted(#[source] Cause),
    }

    #[test]
    fn errors_are_equal_whatever_their_cause() {
        let number = "x".parse::<u8>().map_err(with_cause(Outer::Unreadable));
        assert_eq!(number, Err(Outer::Unreadable(Cause::finding("something else"))));
        assert_ne!(number, Err(Outer::Quoted(Cause::any())));
    }

    #[test]
    fn the_text_of_each_source_is_told_once() {
        let error = "x".parse::<u8>().map_err(with_cause(Outer::Unreadable)).unwrap_err();
        assert_eq!(with_sources(&error), "it cannot be read: invalid digit found in string");
        let error = "x".parse::<u8>().map_err(with_cause(Outer::Quoted)).unwrap_err();
        assert_eq!(with_sources(&error), "it cannot be read (invalid digit found in string)");
        assert!(error.source().is_some());
    }
}
