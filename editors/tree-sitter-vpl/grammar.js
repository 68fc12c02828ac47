/**
 * VPL for editors: highlighting, folding and indentation while a text is being typed.
 *
 * The compiler's grammar is `grammar/vpl.pest`; this one reads every program that it
 * reads, and some that it refuses. Two things carry it without an external scanner:
 *
 * - A newline is whitespace, except where a statement may end: there it is a token,
 *   and the parser's state tells the lexer which it is. So newlines count in braces
 *   and at the top, and nowhere inside parentheses and brackets.
 * - Words are names unless the grammar expects them: `at` is a keyword after a place
 *   and a legal name everywhere else.
 */

/** Statements or items, one a line. */
const lines = ($, rule) =>
  seq(optional($._lines), optional(seq(rule, repeat(seq($._lines, rule)), optional($._lines))));

/** `{ … }` around statements. */
const block = ($, rule) => seq('{', lines($, rule), '}');

/** Between parentheses or brackets: commas, a trailing one is allowed. */
const comma_separated = (rule) => seq(rule, repeat(seq(',', rule)), optional(','));

/** Between braces: commas, newlines, or both. */
const braced_list = ($, rule) =>
  seq(
    '{',
    optional($._lines),
    optional(seq(rule, repeat(seq($._separator, rule)), optional($._separator))),
    '}',
  );

module.exports = grammar({
  name: 'vpl',

  word: ($) => $.name,

  extras: ($) => [/[ \t\r\n]/, $.comment, $.doc_comment],

  rules: {
    file: ($) =>
      seq(
        optional($._lines),
        choice(
          seq($.header, repeat(seq($._lines, $._item)), optional($._lines)),
          optional(seq($._item, repeat(seq($._lines, $._item)), optional($._lines))),
        ),
      ),

    header: ($) => seq('vpl', optional($.edition)),
    edition: (_) => /[A-Za-z0-9._]+/,

    _line_end: (_) => choice(/\r\n?|\n/, ';'),
    _lines: ($) => repeat1($._line_end),
    _separator: ($) => choice(seq(',', optional($._lines)), seq($._lines, optional(seq(',', optional($._lines))))),

    comment: (_) => token(/\/\/[^\r\n]*/),
    doc_comment: (_) => token(prec(1, /\/\/\/[^\r\n]*/)),

    name: (_) => /[A-Za-z_][A-Za-z0-9_]*/,

    // ---- Items --------------------------------------------------------------

    _item: ($) => choice($.use, $.let, $.library, $.task, $.scene, $.test, $.study),

    // use std.cameras.kinect_v2 · use std.solids.{a, b} · use "parts/markers.vpl".{a, b}
    use: ($) =>
      seq(
        'use',
        field('module', choice($.text, $.name)),
        repeat(seq('.', field('path', $.name))),
        optional(seq('.', $.use_group)),
      ),
    use_group: ($) => braced_list($, $.name),

    // let above(bottom: polygon, height: length = 1 m) = behind(face: bottom, depth: height)
    let: ($) => seq('let', field('name', $.name), optional($.parameters), '=', field('value', $._expression)),
    parameters: ($) => seq('(', optional(comma_separated($.parameter)), ')'),
    parameter: ($) =>
      seq(field('name', $.name), ':', field('type', $.type), optional(seq('=', field('default', $._expression)))),
    type: ($) => choice($.name, seq('[', $.type, ']')),

    // ---- Libraries ----------------------------------------------------------

    library: ($) => seq('library', field('name', $.name), optional($.parameters), block($, $._entry)),
    _entry: ($) => choice($.inclusion, $.feature, $.class, $.classes, $.rule, $.layout),

    // use tagged_box(width: 300 mm)
    inclusion: ($) => seq('use', choice($.call, field('library', $.name))),

    // feature code[1..7] : marker
    feature: ($) => seq('feature', field('name', $.feature_name), ':', field('type', $.type), optional('many')),
    feature_name: ($) => seq($.name, optional($.index)),
    index: ($) => seq('[', choice($.range, alias($.integer, $.number), $.name), ']'),
    range: ($) => seq(alias($.integer, $.number), '..', alias($.integer, $.number)),
    integer: (_) => /[0-9]+/,

    // class prism { bottom, prism_side } prior 30 %
    class: ($) => seq('class', field('name', $.name), braced_list($, $.feature_name), optional($.prior)),
    prior: ($) => seq('prior', $._expression),

    // classes by code[1..7] { tk1 1 0 1 0 1 1 1 … }
    classes: ($) => seq('classes', 'by', $.feature_name, repeat(seq(',', $.feature_name)), block($, $.row)),
    row: ($) => seq(field('name', $.name), repeat($.cell), optional($.prior)),
    cell: (_) => /[01]/,

    // rule bottom, prism_side -> prism_shape { … }
    rule: ($) => seq($._rule_head, block($, $._rule_statement)),
    _rule_head: ($) =>
      seq(
        'rule',
        optional(seq(field('antecedent', $.feature_name), repeat(seq(',', field('antecedent', $.feature_name))))),
        '->',
        field('consequent', $.feature_name),
      ),
    _rule_statement: ($) => choice($.for_each, $.detect, $.measure, $.predict),
    for_each: ($) => seq('for', 'each', field('name', $.name), 'in', field('value', $.reference)),
    detect: ($) => seq('detect', $._expression),
    measure: ($) => seq('measure', $._expression),
    predict: ($) => seq('predict', $._expression),

    // layout hull { code[1] at [450 mm, 0 mm, 250 mm] facing +x … }
    layout: ($) => seq('layout', field('name', $.name), block($, $.place)),
    place: ($) => seq($.feature_name, 'at', $._expression, 'facing', $._expression),

    // ---- Tasks --------------------------------------------------------------

    task: ($) => seq('task', field('name', $.name), block($, $._task_statement)),
    _task_statement: ($) =>
      choice(
        $.library_of,
        $.goal,
        $.camera,
        $.space,
        $.views,
        $.thresholds,
        $.limit,
        $.overlap,
        $.method,
        $.gain_floor,
        $.inspected,
        $.visibility,
        $.verify,
        $.insertion,
        $.sensor_model,
      ),
    library_of: ($) => seq('library', $.name),
    goal: ($) => seq('goal', $.name, optional(seq('and', $.name))),
    camera: ($) => seq('camera', $._expression),
    space: ($) => seq('space', $._expression, 'at', $._expression, 'voxel', $._expression),
    views: ($) => seq('views', $._expression),
    thresholds: ($) => seq('thresholds', $.fields),
    limit: ($) => seq('limit', $._expression),
    overlap: ($) => seq('overlap', $._expression),
    method: ($) => seq('method', $.name),
    gain_floor: ($) => seq('gain_floor', $._expression),
    inspected: ($) => seq('inspected', $.name),
    visibility: ($) => seq('visibility', $.name),
    verify: ($) => seq('verify', $.name),
    insertion: ($) => seq('insertion', $.name),
    sensor_model: ($) => seq('sensor_model', $.fields),

    fields: ($) => braced_list($, $.field),
    field: ($) => seq(field('name', $.name), ':', $._expression),

    // ---- Scenes -------------------------------------------------------------

    scene: ($) => seq('scene', field('name', $.name), block($, $._scene_statement)),
    _scene_statement: ($) => choice($.backdrop, $.object),
    backdrop: ($) => seq('backdrop', $._expression),
    // object tk1 = tank() at [0 mm, 0 mm, 600 mm] turned 24 deg marked tanks.hull as tk1
    object: ($) =>
      seq(
        'object',
        field('name', $.name),
        '=',
        $._expression,
        'at',
        $._expression,
        optional($.turned),
        optional($.marked),
      ),
    turned: ($) => seq('turned', $._expression),
    // The layout and the class may be missing: the compiler reads on and asks for them.
    marked: ($) =>
      seq(
        'marked',
        field('library', $.name),
        optional(seq('.', field('layout', $.name))),
        optional(seq('as', field('class', $.name))),
      ),

    // ---- Facts --------------------------------------------------------------

    // test "tk5 and tk9 differ in code 3" { … }
    test: ($) => seq('test', field('name', $.text), block($, $._test_statement)),
    _test_statement: ($) => choice($.library_of, $.given, $.expect),

    // given code[7] detected, code[4] absent · given bottom = polygon([…])
    given: ($) => seq('given', $.supposed, repeat(seq(',', $.supposed))),
    supposed: ($) => seq($.feature_name, choice($.measured, $.located, field('state', $.name))),
    measured: ($) => seq('=', $._expression),
    located: ($) => seq('at', $._expression, 'facing', $._expression),

    expect: ($) => seq('expect', $._expected),
    _expected: ($) =>
      choice(
        seq('classes', field('class', $.name), repeat(seq(',', field('class', $.name)))),
        seq('class', field('class', $.name), $._expression, optional($.within)),
        seq(optional('not'), choice('confident', 'contradicted')),
        seq('next', $.feature_name, repeat(seq(',', $.feature_name))),
        seq($._rule_head, 'predicts', $._expression),
        seq('rules', $._expression),
        seq($._expression, '=', $._expression, optional($.within)),
        seq($._expression, 'count', $._expression),
        seq($.feature_name, choice($.weighs, $.predicted, $.placed, field('state', $.name))),
      ),
    weighs: ($) => seq('weight', $._expression, optional($.within)),
    predicted: ($) => seq('predicted', $._expression),
    placed: ($) => seq('at', $._expression, optional(seq('facing', $._expression)), optional($.within)),
    within: ($) => seq('within', $._expression),

    // ---- Studies ------------------------------------------------------------

    // study reconstruction { program "solids.vpl"; methods gn, random; starts 16 }
    study: ($) => seq('study', field('name', $.name), block($, $._study_statement)),
    _study_statement: ($) =>
      choice(
        $.program_of,
        $.task_of,
        $.objects,
        $.methods,
        $.starts,
        $.seeds,
        $.noise,
        $.published,
        $.variant,
        $._study_setting,
      ),
    program_of: ($) => seq('program', $.text),
    task_of: ($) => seq('task', $.name),
    objects: ($) => seq('objects', $._expression, repeat(seq(',', $._expression))),
    methods: ($) => seq('methods', $.name, repeat(seq(',', $.name))),
    starts: ($) => seq('starts', $._expression),
    seeds: ($) => seq('seeds', $._expression),
    noise: ($) => seq('noise', $.name, repeat(seq(',', $.name))),
    published: ($) => seq('published', $.text),
    // variant octomap { sensor_model { hit: 70 %, miss: 40 % } }
    variant: ($) => seq('variant', field('name', $.name), block($, $._study_setting)),
    _study_setting: ($) =>
      choice(
        $.camera,
        $.views,
        $.thresholds,
        $.limit,
        $.overlap,
        $.gain_floor,
        $.inspected,
        $.verify,
        $.sensor_model,
        $.voxel_of,
        $.backdrop,
      ),
    voxel_of: ($) => seq('voxel', $._expression),

    // ---- Expressions --------------------------------------------------------

    _expression: ($) => choice($.fallback, $.binary, $.unary, $._operand),
    // `a else b` is b while a has no value yet.
    fallback: ($) => prec.left(1, seq($._expression, 'else', $._expression)),
    binary: ($) =>
      choice(
        prec.left(2, seq($._expression, field('operator', choice('+', '-')), $._expression)),
        prec.left(3, seq($._expression, field('operator', choice('*', '/')), $._expression)),
      ),
    unary: ($) => prec(4, seq(field('operator', '-'), $._operand)),
    _operand: ($) => choice($.direction, $.quantity, $.text, $.colour, $.list, $.group, $.call, $.reference),

    // `+x`, `-z`: a world axis. A minus before any other word negates it.
    // The `°?` never matches: what is no word cannot be taken for a keyword, and a
    // keyword could stand apart from its sign.
    direction: (_) => seq(choice('+', '-'), token.immediate(/[xyz]°?/)),
    quantity: ($) => seq($.number, optional($.unit)),
    number: (_) => /[0-9]+(\.[0-9]+)?([eE][+-]?[0-9]+)?/,
    unit: ($) => choice('%', '°', $.name),
    text: ($) => seq('"', repeat(choice($.hole, $.escape, $._chunk)), token.immediate('"')),
    hole: (_) => token.immediate(/\{[A-Za-z_][A-Za-z0-9_]*\}/),
    escape: (_) => token.immediate(/\\[^\r\n]/),
    _chunk: (_) => token.immediate(prec(1, /[^"\\{\r\n]+/)),
    colour: (_) => /#[A-Za-z0-9]+/,
    list: ($) => seq('[', optional(comma_separated($._expression)), ']'),
    group: ($) => seq('(', $._expression, ')'),
    call: ($) => seq(field('function', $.name), '(', optional(comma_separated($.argument)), ')'),
    argument: ($) => seq(optional(seq(field('name', $.name), ':')), field('value', $._expression)),
    reference: ($) => seq($.name, optional($.index), repeat(seq('.', field('attribute', $.name)))),
  },
});
