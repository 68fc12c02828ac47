//! Grammar rules in the user's words.

use std::collections::BTreeSet;

use super::Rule;

/// The names of expected rules, sorted, each once.
pub(super) fn names(rules: &[Rule]) -> Vec<String> {
    let rules = rules
        .iter()
        .flat_map(|r| members(*r).map_or(std::slice::from_ref(r), |m| m));
    let found: BTreeSet<(u8, String)> = rules.filter_map(|r| describe(*r)).collect();
    found.into_iter().map(|(_, text)| text).collect()
}

/// Without what may always follow and is never needed: operators, `else`, an index.
pub(super) fn essential(names: &[String]) -> Vec<String> {
    const CONTINUE: [&str; 6] = ["an operator", "`else`", "a unit", "`.`", "`[`", "`(`"];
    let needed: Vec<String> = (names.iter())
        .filter(|name| !CONTINUE.contains(&name.as_str()))
        .cloned()
        .collect();
    if needed.is_empty() { names.to_vec() } else { needed }
}

/// `a, b or c`, cut short where it is long.
pub(super) fn list(names: &[String]) -> String {
    const MOST: usize = 14;
    let shown = &names[..names.len().min(MOST)];
    match shown {
        [] => String::new(),
        [one] => one.clone(),
        _ if names.len() > MOST => format!("{} or another", shown.join(", ")),
        [init @ .., last] => format!("{} or {last}", init.join(", ")),
    }
}

/// What an entry would have begun with.
fn members(start: Rule) -> Option<&'static [Rule]> {
    Some(match start {
        Rule::item_only => &[
            Rule::kw_use,
            Rule::kw_let,
            Rule::kw_library,
            Rule::kw_task,
            Rule::kw_scene,
            Rule::kw_test,
            Rule::kw_study,
        ],
        Rule::entry_only => &[
            Rule::kw_use,
            Rule::kw_feature,
            Rule::kw_class,
            Rule::kw_classes,
            Rule::kw_rule,
            Rule::kw_layout,
        ],
        Rule::rule_statement_only => &[Rule::kw_for, Rule::kw_detect, Rule::kw_measure, Rule::kw_predict],
        Rule::task_statement_only => &[
            Rule::kw_library,
            Rule::kw_goal,
            Rule::kw_camera,
            Rule::kw_space,
            Rule::kw_views,
            Rule::kw_thresholds,
            Rule::kw_limit,
            Rule::kw_overlap,
            Rule::kw_method,
            Rule::kw_gain_floor,
            Rule::kw_inspected,
            Rule::kw_visibility,
            Rule::kw_verify,
            Rule::kw_insertion,
            Rule::kw_sensor_model,
        ],
        Rule::scene_statement_only => &[Rule::kw_backdrop, Rule::kw_object],
        Rule::test_statement_only => &[Rule::kw_library, Rule::kw_given, Rule::kw_expect],
        Rule::study_statement_only => &[
            Rule::kw_program,
            Rule::kw_task,
            Rule::kw_objects,
            Rule::kw_methods,
            Rule::kw_starts,
            Rule::kw_seeds,
            Rule::kw_noise,
            Rule::kw_published,
            Rule::kw_variant,
            Rule::kw_limit,
            Rule::kw_voxel,
            Rule::kw_sensor_model,
        ],
        Rule::row_only => &[Rule::row],
        Rule::place_only => &[Rule::place],
        _ => return None,
    })
}

/// A rank for sorting and the words; none for what says nothing to a user.
fn describe(expected: Rule) -> Option<(u8, String)> {
    let debug = format!("{expected:?}");
    if let Some(word) = debug.strip_prefix("kw_") {
        return Some((1, format!("`{word}`")));
    }
    let text = match expected {
        Rule::name => "a name",
        Rule::integer => "a whole number",
        Rule::edition => "an edition",
        Rule::line_end | Rule::EOI => return Some((9, "the end of the line".into())),
        Rule::comma => "`,`",
        Rule::colon => "`:`",
        Rule::equals => "`=`",
        Rule::arrow => "`->`",
        Rule::dot => "`.`",
        Rule::dots => "`..`",
        Rule::open_brace | Rule::fields | Rule::use_group => "`{`",
        Rule::close_brace => "`}`",
        Rule::open_paren | Rule::parameters => "`(`",
        Rule::close_paren => "`)`",
        Rule::open_bracket | Rule::index => "`[`",
        Rule::close_bracket => "`]`",
        Rule::plus | Rule::minus | Rule::times | Rule::slash => return Some((8, "an operator".into())),
        Rule::unit => "a unit",
        Rule::number | Rule::quantity => "a number",
        Rule::text => "a text",
        Rule::cell => "`0` or `1`",
        Rule::direction => "a direction",
        Rule::expr
        | Rule::line_expr
        | Rule::sum
        | Rule::line_sum
        | Rule::product
        | Rule::line_product
        | Rule::unary
        | Rule::call
        | Rule::reference
        | Rule::list
        | Rule::group
        | Rule::colour => "a value",
        Rule::argument => "an argument",
        Rule::parameter => "a parameter",
        Rule::type_name => "a type",
        Rule::feature_ref => "a feature",
        Rule::range => "a range",
        Rule::field => "a name and its value",
        Rule::row => "a class and its row",
        Rule::place => "a feature and its place",
        Rule::use_item | Rule::inclusion => "`use`",
        Rule::let_item => "`let`",
        Rule::library | Rule::library_of => "`library`",
        Rule::task => "`task`",
        Rule::scene => "`scene`",
        Rule::study => "`study`",
        Rule::program_of => "`program`",
        Rule::task_of => "`task`",
        Rule::voxel_of => "`voxel`",
        Rule::feature => "`feature`",
        Rule::class => "`class`",
        Rule::classes | Rule::classes_head => "`classes`",
        Rule::rule | Rule::rule_head => "`rule`",
        Rule::layout | Rule::layout_head => "`layout`",
        Rule::for_each => "`for`",
        Rule::detect
        | Rule::measure
        | Rule::predict
        | Rule::goal
        | Rule::camera
        | Rule::space
        | Rule::views
        | Rule::thresholds
        | Rule::limit
        | Rule::overlap
        | Rule::method
        | Rule::gain_floor
        | Rule::inspected
        | Rule::visibility
        | Rule::verify
        | Rule::insertion
        | Rule::sensor_model
        | Rule::backdrop
        | Rule::object
        | Rule::turned
        | Rule::marked
        | Rule::prior => return Some((1, format!("`{debug}`"))),
        Rule::objects | Rule::methods | Rule::starts | Rule::seeds | Rule::noise | Rule::published | Rule::variant => {
            return Some((1, format!("`{debug}`")));
        }
        Rule::test | Rule::given | Rule::expect | Rule::within => return Some((1, format!("`{debug}`"))),
        Rule::state => "a state like `detected`",
        Rule::supposed => "a feature and what is known of it",
        Rule::measured => "`=`",
        Rule::located | Rule::placed => "`at`",
        Rule::weighs => "`weight`",
        Rule::predicted => "`predicted`",
        Rule::of_value => "a value",
        Rule::of_feature => "a feature",
        Rule::of_classes => "`classes`",
        Rule::of_class => "`class`",
        Rule::of_rule => "`rule`",
        Rule::of_rules => "`rules`",
        Rule::of_next => "`next`",
        Rule::of_flag => "`not`",
        Rule::flag => "`confident` or `contradicted`",
        Rule::hole => "`{name}`",
        Rule::chunk | Rule::escape => "the end of the text (`\"`)",
        _ => return None,
    };
    Some((if text.starts_with('`') { 1 } else { 0 }, text.to_owned()))
}
