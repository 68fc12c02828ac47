//! Every code with its title and its page: E01 syntax and files, E02 names, E03
//! types and units, E04 task checks, E05 scenes, E06 what a command could not do,
//! E07 facts and questions about runs; W04 warnings and N04 notes about tasks.
//!
//! A code is declared here once; without its page `docs/diagnostics/CODE.md` the
//! crate does not build, and a test runs the programs of each page.

use std::fmt;
use std::str::FromStr;

use super::Severity;

macro_rules! codes {
    ($($code:ident $title:literal)*) => {
        /// The kind of a diagnostic.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Code {
            $(#[doc = $title] $code,)*
        }

        impl Code {
            /// All codes in order.
            pub const ALL: &[Code] = &[$(Code::$code,)*];
        }

        /// One line on what a code is about.
        pub fn title(code: Code) -> &'static str {
            match code {
                $(Code::$code => $title,)*
            }
        }

        /// The page of a code: Markdown, with a program that fails and one that does not.
        pub fn page(code: Code) -> &'static str {
            match code {
                $(Code::$code => include_str!(concat!("../../../docs/diagnostics/", stringify!($code), ".md")),)*
            }
        }

        fn written(code: Code) -> &'static str {
            match code {
                $(Code::$code => stringify!($code),)*
            }
        }
    };
}

codes! {
    E0101 "text that the grammar does not know"
    E0102 "the edition line `vpl 1` is missing or malformed"
    E0103 "a language edition that this program does not read"
    E0104 "an empty file"
    E0105 "a file that cannot be read"
    E0106 "a file that is too large"
    E0107 "a file that is no UTF-8 text"
    E0108 "brackets nested too deep, or a file too complex to read"
    E0109 "a mark of another language"
    E0110 "a malformed literal"
    E0111 "an import that cannot be followed"
    E0112 "modules that import each other in a circle"
    E0201 "an unknown name"
    E0202 "a name declared twice"
    E0203 "an unknown definition or primitive"
    E0204 "an unknown module or an unknown name in one"
    E0205 "an attribute out of reach of its rule"
    E0206 "an unknown attribute"
    E0207 "an unknown feature"
    E0208 "an unknown library, class, layout, task or object"
    E0209 "definitions that need each other in a circle"
    E0210 "an index that fits no family"
    E0211 "a name that hides another"
    E0212 "a template where a library is due"
    E0213 "a default that reads a parameter"
    E0301 "a value of the wrong type"
    E0302 "a missing or an unknown unit"
    E0303 "a missing argument"
    E0304 "an argument that is unknown, surplus or out of order"
    E0305 "values that cannot be combined"
    E0306 "an unknown word where one of a few is due"
    E0307 "a primitive that does not fit its feature"
    E0308 "a statement that is missing or surplus"
    E0309 "a value out of range"
    E0310 "a presence row of the wrong width"
    E0311 "priors that do not fit"
    E0312 "a program that expands too far"
    E0401 "two classes that nothing tells apart"
    E0402 "thresholds that do not fit the map"
    E0403 "views that cannot measure"
    E0404 "a map that does not fit in memory"
    E0405 "a library without a beginning"
    E0406 "a confidence that no class can reach"
    E0407 "rules that contradict each other"
    E0408 "features that one detector cannot tell apart"
    E0409 "prints that lie over each other"
    E0501 "a backdrop that does not enclose the views"
    E0502 "a marker without a place or a print"
    E0503 "a view inside an object"
    E0504 "an object that cannot be shown"
    E0505 "an object outside the space"
    E0506 "a study without anything to run"
    E0601 "a result that cannot be written"
    E0602 "a run that cannot be resumed"
    E0603 "a run that cannot be made"
    E0604 "a layout that would be another program"
    E0605 "a folder that a study cannot use"
    E0611 "a recording that cannot be used"
    E0612 "a file that is no OctoMap tree"
    E0701 "a fact that does not hold"
    E0702 "evidence that contradicts itself"
    E0703 "an expectation that cannot be checked"
    E0711 "a run log that cannot be read"
    E0712 "a file that is no run log"
    E0713 "a question about something that a run does not know"
    E0714 "a question about a view that a run does not have"
    W0401 "an attribute that has no value at first"
    W0402 "a feature that no class has"
    W0403 "a feature that every class has"
    W0404 "a feature that nothing detects"
    W0405 "a rule that can never fire"
    W0406 "predictions that nothing starts"
    W0407 "a marker too small to decode"
    W0408 "views of which some cannot measure"
    W0409 "a class that can never be certain"
    W0410 "a class that is certain before anything is seen"
    W0411 "a rule that says what another says"
    W0412 "a layout that leaves members of a family out"
    W0413 "a place where its own detector finds nothing"
    W0414 "a `near` that spans the space"
    W0415 "an object that is marked as a class of another name"
    W0416 "a mark without a print"
    W0417 "a layout that the space cannot hold"
    W0418 "a map of many gigabytes"
    W0419 "several places for one instance"
    N0401 "what recognition costs"
    N0402 "objects that no class is named after"
    N0403 "objects that reach out of the space"
}

impl Code {
    /// As it is written.
    pub fn as_str(self) -> &'static str {
        written(self)
    }

    /// What diagnostics of this code usually are, which is what its letter says.
    pub fn severity(self) -> Severity {
        match self.as_str().as_bytes() {
            [b'W', ..] => Severity::Warning,
            [b'N', ..] => Severity::Note,
            _ => Severity::Error,
        }
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// There is no such code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no such code")]
pub struct UnknownCode;

impl FromStr for Code {
    type Err = UnknownCode;

    fn from_str(text: &str) -> Result<Self, UnknownCode> {
        let named = Self::ALL.iter().find(|code| code.as_str().eq_ignore_ascii_case(text));
        named.copied().ok_or(UnknownCode)
    }
}
