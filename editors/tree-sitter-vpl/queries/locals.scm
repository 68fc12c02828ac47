; Where names are declared, and where they count.

[
  (file)
  (let)
  (library)
  (rule)
] @local.scope

(let name: (name) @local.definition)
(parameter name: (name) @local.definition)
(for_each name: (name) @local.definition)
(feature name: (feature_name (name) @local.definition))

(reference . (name) @local.reference)
(call function: (name) @local.reference)
