//! Which tokens stand apart, and which lines go on.

use crate::lang::syntax::{Token, TokenClass};

/// Whether a bracket opens.
pub(super) fn is_open(written: &str) -> bool {
    matches!(written, "(" | "[" | "{")
}

/// Whether a token is written against a bracket that follows it: `f(`, `code[`.
pub(super) fn takes_bracket(class: TokenClass) -> bool {
    matches!(class, TokenClass::Name | TokenClass::Callee)
}

/// Whether a statement goes on in the next line behind a token.
pub(super) fn continues(token: &Token, text: &str) -> bool {
    match token.class {
        TokenClass::Operator => matches!(token.text(text), "+" | "-" | "*" | "/" | "="),
        TokenClass::Keyword => token.text(text) == "else",
        TokenClass::Punctuation => token.text(text) == ",",
        _ => false,
    }
}

/// Whether a line inside brackets may begin with a token.
pub(super) fn goes_on_with(token: &Token, text: &str) -> bool {
    match token.class {
        TokenClass::Operator => matches!(token.text(text), "+" | "-" | "*" | "/"),
        TokenClass::Keyword => token.text(text) == "else",
        _ => false,
    }
}

/// Reads tokens one after the other, and says where a space belongs.
#[derive(Default)]
pub(super) struct Spacer {
    last: Option<Token>,
    /// Whether the last token is a sign that belongs to the next.
    sign: bool,
    /// Whether the next colon stands apart, as behind a feature.
    feature: bool,
}

impl Spacer {
    /// Whether a space stands before a token; brackets are told whether they are `close`.
    pub(super) fn before(&mut self, token: Token, text: &str) -> bool {
        let written = token.text(text);
        let apart = self.last.is_some_and(|last| self.apart(last, token, text));
        if token.class == TokenClass::Keyword {
            self.feature = written == "feature";
        }
        self.sign = written == "-" && self.last.is_none_or(|last| !ends_value(&last, text));
        self.last = Some(token);
        apart
    }

    /// A new statement begins: what stood before it is no operand.
    pub(super) fn restart(&mut self) {
        self.last = None;
        self.sign = false;
        self.feature = false;
    }

    fn apart(&self, last: Token, token: Token, text: &str) -> bool {
        let (before, written) = (last.text(text), token.text(text));
        if self.sign {
            // `-x` is a direction, `- x` the opposite of `x`.
            return token.class == TokenClass::Name && matches!(written, "x" | "y" | "z");
        }
        if matches!(last.class, TokenClass::Text | TokenClass::Hole)
            && (last.class, token.class) != (TokenClass::Text, TokenClass::Text)
            && matches!(token.class, TokenClass::Text | TokenClass::Hole)
        {
            return last.end != token.start;
        }
        match (before, written) {
            ("(" | "[" | "." | "..", _) | (_, ")" | "]" | "," | "." | ".." | ";") => false,
            (_, ":") => self.feature,
            (_, "(" | "[") => !takes_bracket(last.class),
            _ => true,
        }
    }
}

/// Whether a minus behind a token subtracts.
fn ends_value(token: &Token, text: &str) -> bool {
    match token.class {
        TokenClass::Keyword | TokenClass::Operator => false,
        TokenClass::Punctuation => matches!(token.text(text), ")" | "]" | "}"),
        _ => true,
    }
}
