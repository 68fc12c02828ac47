// Holds the extension's data to the language: every snippet is a well-formed program,
// every file that the manifest names exists, and lines indent as they should.
//
//   cargo build --example tokens && node editors/vscode/test.mjs target/debug/examples/tokens

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const here = new URL('.', import.meta.url).pathname;
const read = (file) => JSON.parse(readFileSync(join(here, file), 'utf8'));

/** What stands in a library, and not at the top. */
const ENTRIES = ['Rule', 'Definite rule', 'Presence table', 'Layout'];

/** A snippet as it is inserted, before anything is filled in. */
function inserted(body) {
  const innermost = /\$\{\d+:([^{}$]*(?:\{i\}[^{}$]*)?)\}/g;
  let text = body.join('\n').replace(/\$\{\d+\|([^,|]*)[^}]*\}/g, '$1').replace(/\$\d+/g, '');
  while (innermost.test(text)) text = text.replace(innermost, '$1');
  return text;
}

function programs() {
  return Object.entries(read('snippets.json')).map(([name, { body }]) => {
    const text = inserted(body);
    if (text.startsWith('vpl ')) return [name, text];
    return [name, ENTRIES.includes(name) ? `vpl 1\nlibrary l {\n${text}\n}\n` : `vpl 1\n${text}\n`];
  });
}

function snippetsAreWellFormed(tokens) {
  const folder = mkdtempSync(join(tmpdir(), 'vpl-snippets-'));
  try {
    for (const [name, text] of programs()) {
      const file = join(folder, 'snippet.vpl');
      writeFileSync(file, text);
      const { well_formed } = JSON.parse(execFileSync(tokens, [file], { encoding: 'utf8' }));
      assert(well_formed, `the snippet “${name}” is not well-formed:\n${text}`);
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function filesExist() {
  const { main, contributes } = read('package.json');
  const copied = ['./syntaxes/vpl.tmLanguage.json'];
  const named = [
    main,
    ...contributes.languages.map((language) => language.configuration),
    ...contributes.grammars.map((grammar) => grammar.path),
    ...contributes.snippets.map((snippets) => snippets.path),
  ];
  for (const file of named.filter((file) => !copied.includes(file))) {
    assert(existsSync(join(here, file)), `${file} does not exist`);
  }
}

function linesIndent() {
  const { increaseIndentPattern, decreaseIndentPattern } = read('language-configuration.json').indentationRules;
  const [increase, decrease] = [new RegExp(increaseIndentPattern), new RegExp(decreaseIndentPattern)];
  for (const line of ['library l {', '  rule -> a { // note }', 'let v = f(', '  ]) at [', 'test "a } b" {']) {
    assert(increase.test(line), `a line after \`${line}\` should be indented`);
  }
  for (const line of ['class a { b }', '// {', '/// (', 'let a = f("{")', 'limit 20 views', 'f(a) // {']) {
    assert(!increase.test(line), `a line after \`${line}\` should not be indented`);
  }
  for (const line of ['}', '  ]) at [0 m]', '  )']) {
    assert(decrease.test(line), `\`${line}\` should be outdented`);
  }
  assert(!decrease.test('  detect f()'));
}

const tokens = process.argv[2];
assert(tokens, 'usage: node test.mjs TOKENS, the program that `cargo build --example tokens` builds');
snippetsAreWellFormed(tokens);
filesExist();
linesIndent();
console.log(`${programs().length} snippets are well-formed; the manifest's files exist; lines indent`);
