; What is coloured how. Each node has one capture: editors differ in which of several
; they take. Names are chosen so that what an editor does not know falls back to what
; it does: `@constant.numeric.unit` to `@constant.numeric` or `@constant`.

(comment) @comment
(doc_comment) @comment.documentation

; ---- Words of the language -----------------------------------------------------

[
  "vpl"
  "library"
  "feature"
  "class"
  "classes"
  "rule"
  "layout"
  "task"
  "scene"
  "test"
  "study"
  "program"
  "objects"
  "methods"
  "starts"
  "seeds"
  "noise"
  "published"
  "variant"
  "let"
  "many"
  "by"
  "prior"
  "detect"
  "measure"
  "predict"
  "at"
  "facing"
  "goal"
  "camera"
  "space"
  "voxel"
  "views"
  "thresholds"
  "limit"
  "overlap"
  "method"
  "gain_floor"
  "inspected"
  "visibility"
  "verify"
  "insertion"
  "sensor_model"
  "backdrop"
  "object"
  "turned"
  "marked"
  "as"
  "given"
  "expect"
  "confident"
  "contradicted"
  "next"
  "rules"
  "weight"
  "predicted"
  "predicts"
  "count"
  "within"
] @keyword

"use" @keyword.import

[
  "for"
  "each"
  "in"
] @keyword.repeat

[
  "else"
  "and"
  "not"
] @keyword.operator

; ---- Types, and what is declared -----------------------------------------------

(type (name) @type)

[
  (library name: (name) @type.definition)
  (class name: (name) @type.definition)
  (layout name: (name) @type.definition)
  (task name: (name) @type.definition)
  (scene name: (name) @type.definition)
  (study name: (name) @type.definition)
  (variant name: (name) @type.definition)
]

(let name: (name) @function)
(parameter name: (name) @variable.parameter)
(for_each name: (name) @variable.parameter)
(object name: (name) @variable)

; ---- What refers to them ---------------------------------------------------------

(use module: (name) @module)
(use path: (name) @module)
(use_group (name) @function)
(inclusion library: (name) @type.definition)
(library_of (name) @type.definition)
(task_of (name) @type.definition)
(row name: (name) @type.definition)
(marked (name) @type.definition)
(expect class: (name) @type.definition)

(call function: (name) @function.call)
(argument name: (name) @variable.parameter)
(field name: (name) @variable.other.member)
(reference . (name) @variable)
(reference attribute: (name) @variable.other.member)
(feature_name (name) @variable)
(index (name) @variable)

(goal (name) @constant.builtin)
(method (name) @constant.builtin)
(methods (name) @constant.builtin)
(noise (name) @constant.builtin)
(inspected (name) @constant.builtin)
(visibility (name) @constant.builtin)
(verify (name) @constant.builtin)
(insertion (name) @constant.builtin)
(supposed state: (name) @keyword)
(expect state: (name) @keyword)

; What could not be read is at least words.
(ERROR (name) @variable)

; ---- Values ------------------------------------------------------------------------

[
  (number)
  (cell)
  (edition)
] @constant.numeric

(unit) @constant.numeric.unit
(direction) @constant.builtin.direction
(colour) @constant.colour
(text) @string
(escape) @string.escape
(hole) @string.special

; ---- Marks -------------------------------------------------------------------------

[
  "->"
  "="
  ".."
] @operator

(unary operator: _ @operator)
(binary operator: _ @operator)

[
  ","
  ":"
  "."
  ";"
] @punctuation.delimiter

[
  "{"
  "}"
  "("
  ")"
  "["
  "]"
] @punctuation.bracket
