//! Every program of the tree, read by tree-sitter and by the compiler: the colours of
//! the one must be the token classes of the other.

mod programs;

use programs::{Program, Token, programs, root};
use tree_sitter::{Parser, Query, QueryCursor, StreamingIterator as _, Tree};

/// What each capture of `queries/highlights.scm` stands for.
const CLASSES: [(&str, &str); 25] = [
    ("comment", "Comment"),
    ("comment.documentation", "Doc"),
    ("keyword", "Keyword"),
    ("keyword.import", "Keyword"),
    ("keyword.repeat", "Keyword"),
    ("keyword.operator", "Keyword"),
    ("type", "Type"),
    ("type.definition", "Name"),
    ("function", "Name"),
    ("function.call", "Callee"),
    ("module", "Name"),
    ("variable", "Name"),
    ("variable.parameter", "Name"),
    ("variable.other.member", "Name"),
    ("constant.builtin", "Name"),
    ("constant.builtin.direction", "Direction"),
    ("constant.colour", "Colour"),
    ("constant.numeric", "Number"),
    ("constant.numeric.unit", "Unit"),
    ("string", "Text"),
    ("string.escape", "Text"),
    ("string.special", "Hole"),
    ("operator", "Operator"),
    ("punctuation.bracket", "Punctuation"),
    ("punctuation.delimiter", "Punctuation"),
];

/// The least share of all tokens of broken programs that must still agree. What the
/// compiler reads word by word, tree-sitter may read as something.
const LEAST_AGREEMENT: f64 = 0.9;
/// Fewer tokens of well-formed programs would mean that nothing was compared.
const LEAST_TOKENS: usize = 5_000;

fn tree(text: &str) -> Tree {
    let mut parser = Parser::new();
    parser.set_language(&tree_sitter_vpl::LANGUAGE.into()).unwrap();
    parser.parse(text, None).unwrap()
}

fn query(source: &str) -> Query {
    Query::new(&tree_sitter_vpl::LANGUAGE.into(), source).unwrap()
}

/// The capture of each byte: the innermost node's, as editors take it.
fn colours<'q>(query: &'q Query, tree: &Tree, text: &str) -> Vec<Option<&'q str>> {
    let mut captures = Vec::new();
    let mut cursor = QueryCursor::new();
    let mut found = cursor.captures(query, tree.root_node(), text.as_bytes());
    while let Some((matched, at)) = found.next() {
        let capture = matched.captures()[*at];
        let range = capture.node.byte_range();
        // What the parser supposed to be there has no bytes to colour.
        if !range.is_empty() {
            captures.push((range, query.capture_names()[capture.index as usize]));
        }
    }
    captures.sort_by_key(|(range, _)| (range.start, std::cmp::Reverse(range.end)));
    for pair in captures.windows(2) {
        assert!(
            pair[0].0 != pair[1].0 || pair[0].1 == pair[1].1,
            "two colours for one node: {pair:?}"
        );
    }
    let mut colours = vec![None; text.len()];
    for (range, name) in captures {
        colours[range].fill(Some(name));
    }
    colours
}

fn class(capture: &str) -> &'static str {
    let named = CLASSES.iter().find(|(name, _)| *name == capture);
    named.unwrap_or_else(|| panic!("`@{capture}` stands for no class")).1
}

/// The tokens whose colours are not their class's, a line each; and how many were compared.
fn disagreements(query: &Query, program: &Program) -> (Vec<String>, usize) {
    let colours = colours(query, &tree(&program.text), &program.text);
    // The class of a line's end is nobody's colour.
    let told = |t: &&Token| !["Newline", "Bad"].contains(&t.class.as_str());
    let all: Vec<&Token> = program.tokens.iter().filter(told).collect();
    let wrong = all.iter().filter_map(|token| {
        let mut bytes = colours[token.start..token.end].iter();
        let other = bytes.find(|colour| colour.map(class) != Some(token.class.as_str()))?;
        Some(difference(program, token, *other))
    });
    (wrong.collect(), all.len())
}

fn difference(program: &Program, token: &Token, found: Option<&str>) -> String {
    let before = &program.text[..token.start];
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap().chars().count() + 1;
    let written = &program.text[token.start..token.end];
    let found = found.map_or("no colour".to_owned(), |f| format!("@{f}"));
    format!(
        "{}:{line}:{column}: `{written}`: expected {}, found {found}",
        program.path, token.class
    )
}

/// Where tree-sitter could not read on, and what it found there.
fn error(path: &str, tree: &Tree) -> Option<String> {
    let mut node = tree.root_node();
    node.has_error().then(|| {
        while let Some(inner) = node.children(&mut tree.walk()).find(|child| child.has_error()) {
            node = inner;
        }
        let at = node.start_position();
        format!("{path}:{}:{}: {}", at.row + 1, at.column + 1, node.to_sexp())
    })
}

/// The disagreements over programs, and how many tokens were compared.
fn compare(programs: &[&Program]) -> (Vec<String>, usize) {
    let query = query(tree_sitter_vpl::HIGHLIGHTS);
    let each = programs.iter().map(|program| disagreements(&query, program));
    each.fold((Vec::new(), 0), |(mut said, compared), (wrong, tokens)| {
        said.extend(wrong);
        (said, compared + tokens)
    })
}

#[test]
fn well_formed_programs_parse_and_have_the_compilers_colours() {
    let whole: Vec<&Program> = programs().iter().filter(|p| p.well_formed).collect();
    let errors: Vec<String> = whole.iter().filter_map(|p| error(&p.path, &tree(&p.text))).collect();
    assert!(errors.is_empty(), "{}", errors.join("\n"));
    let (wrong, compared) = compare(&whole);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(compared > LEAST_TOKENS, "only {compared} tokens were compared");
}

#[test]
fn broken_programs_keep_their_colours_beside_the_mistake() {
    let broken: Vec<&Program> = programs().iter().filter(|p| !p.well_formed).collect();
    let (wrong, compared) = compare(&broken);
    let most = (1.0 - LEAST_AGREEMENT) * compared as f64;
    assert!(
        wrong.len() as f64 <= most,
        "{} of {compared} differ:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

/// A text is seldom whole while it is typed.
#[test]
fn a_program_that_ends_anywhere_is_read_to_its_end() {
    for program in programs().iter().filter(|p| p.well_formed) {
        for (end, _) in program.text.char_indices().step_by(197) {
            let found = tree(&program.text[..end]);
            assert_eq!(found.root_node().end_byte(), end, "{}", program.path);
        }
    }
}

#[test]
fn the_other_queries_find_what_they_name() {
    let whole = std::fs::read_to_string(root().join("examples/solids/solids.vpl")).unwrap();
    let tree = tree(&whole);
    for source in [
        tree_sitter_vpl::FOLDS,
        tree_sitter_vpl::INDENTS,
        tree_sitter_vpl::LOCALS,
    ] {
        let query = query(source);
        let mut seen = vec![false; query.capture_names().len()];
        let mut cursor = QueryCursor::new();
        let mut found = cursor.captures(&query, tree.root_node(), whole.as_bytes());
        while let Some((matched, at)) = found.next() {
            seen[matched.captures()[*at].index as usize] = true;
        }
        assert!(seen.iter().all(|seen| *seen), "{:?}: {seen:?}", query.capture_names());
    }
}
