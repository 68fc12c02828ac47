// Holds the TextMate grammar to the compiler: every token of every program has a scope
// that stands for its class.
//
//   cargo run --example tokens -- $(git ls-files '*.vpl') | node editors/textmate/test/agreement.mjs
//
// Reads the compiler's tokens from standard input, as `examples/tokens.rs` prints them.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import oniguruma from 'vscode-oniguruma';
import textmate from 'vscode-textmate';

/** What a scope stands for: the first of these that its name begins with. */
const CLASSES = [
  ['comment.line.documentation', 'Doc'],
  ['comment.line.double-slash', 'Comment'],
  ['keyword.operator.word', 'Keyword'],
  ['keyword.operator', 'Operator'],
  ['keyword.other.unit', 'Unit'],
  ['keyword.control', 'Keyword'],
  ['storage.modifier', 'Keyword'],
  ['support.type', 'Type'],
  ['support.constant', 'Name'],
  ['entity.name.function', 'Callee'],
  ['entity.name.type', 'Name'],
  ['entity.name.variable', 'Name'],
  ['variable', 'Name'],
  ['constant.numeric', 'Number'],
  ['constant.other.colour', 'Colour'],
  ['constant.other.placeholder', 'Hole'],
  ['constant.language.direction', 'Direction'],
  ['constant.character.escape', 'Text'],
  ['string.quoted.double', 'Text'],
  ['punctuation', 'Punctuation'],
];

/** The least share of all tokens of broken programs that must still agree. */
const LEAST_AGREEMENT = 0.9;
/** Fewer tokens of well-formed programs would mean that nothing was compared. */
const LEAST_TOKENS = 5000;

async function grammar() {
  const require = createRequire(import.meta.url);
  await oniguruma.loadWASM(readFileSync(require.resolve('vscode-oniguruma/release/onig.wasm')));
  const source = new URL('../vpl.tmLanguage.json', import.meta.url);
  const registry = new textmate.Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () => textmate.parseRawGrammar(readFileSync(source, 'utf8'), source.pathname),
  });
  return registry.loadGrammar('source.vpl');
}

/** The innermost scope of every byte. */
function scopes(grammar, text) {
  const found = [];
  let state = textmate.INITIAL;
  for (const line of text.split(/(?<=\n)/)) {
    const written = line.replace(/\r?\n$/, '');
    const { tokens, ruleStack } = grammar.tokenizeLine(written, state);
    state = ruleStack;
    for (const token of tokens) {
      const bytes = Buffer.byteLength(written.slice(token.startIndex, token.endIndex));
      found.push(...Array(bytes).fill(token.scopes.at(-1)));
    }
    found.push(...Array(Buffer.byteLength(line) - Buffer.byteLength(written)).fill('end of line'));
  }
  return found;
}

function classOf(scope) {
  return CLASSES.find(([prefix]) => scope.startsWith(prefix))?.[1];
}

/** `file:line:column: …` for every token whose scope stands for another class. */
function disagreements(grammar, { file, tokens }, text) {
  const bytes = Buffer.from(text);
  const all = scopes(grammar, text);
  return tokens.flatMap(([expected, start, end]) => {
    const found = all.slice(start, end).find((scope) => classOf(scope) !== expected);
    if (found === undefined) return [];
    const before = bytes.subarray(0, start).toString().split('\n');
    const place = `${file}:${before.length}:${before.at(-1).length + 1}`;
    return [`${place}: \`${bytes.subarray(start, end)}\`: expected ${expected}, found ${found}`];
  });
}

/** What is compared: the class of a line's end is nobody's colour. */
const told = ([name]) => name !== 'Newline' && name !== 'Bad';

/** The disagreements over some programs, and how many tokens were compared. */
function judge(grammar, programs) {
  const each = programs.map((program) => {
    const tokens = program.tokens.filter(told);
    const text = readFileSync(program.file, 'utf8');
    return { wrong: disagreements(grammar, { ...program, tokens }, text), compared: tokens.length };
  });
  return {
    wrong: each.flatMap(({ wrong }) => wrong),
    compared: each.reduce((sum, { compared }) => sum + compared, 0),
  };
}

const programs = readFileSync(0, 'utf8').split('\n').filter(Boolean).map((line) => JSON.parse(line));
const vpl = await grammar();
const whole = judge(vpl, programs.filter((program) => program.well_formed));
const broken = judge(vpl, programs.filter((program) => !program.well_formed));
console.log(`well-formed programs: ${whole.wrong.length} of ${whole.compared} tokens differ`);
console.log(`broken programs: ${broken.wrong.length} of ${broken.compared} tokens differ`);

const tooMany = broken.wrong.length > (1 - LEAST_AGREEMENT) * broken.compared;
const complaints = [...whole.wrong, ...(tooMany ? broken.wrong : [])];
complaints.forEach((line) => console.error(line));
if (complaints.length > 0 || whole.compared < LEAST_TOKENS) process.exit(1);
