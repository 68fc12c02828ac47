; What folds: every block in braces, and long lists.

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
  (call)
  (parameters)
] @fold
