; What indents. `@indent` and `@outdent` are Helix's words, the others Neovim's.

[
  (use_group)
  (library)
  (class)
  (classes)
  (rule)
  (layout)
  (task)
  (fields)
  (scene)
  (test)
  (study)
  (variant)
  (list)
  (group)
  (call)
  (parameters)
] @indent @indent.begin

[
  "}"
  ")"
  "]"
] @outdent @indent.branch
