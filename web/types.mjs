// SPDX-License-Identifier: BSD-3-Clause
// Writes the TypeScript types of JSON Schemas: node types.mjs OUT NAME.schema.json... makes OUT/NAME.ts of each, with the type
// NameDocument of the whole and one of each definition.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';

const BASE = 'https://toposcope.org/schemas/';
/** What bears on no type, and what types are made of; a keyword that is neither is refused, so that none is passed over. */
const UNTYPED = ['$schema', '$id', 'title', 'description', 'definitions', 'contentEncoding', 'minimum', 'maximum', 'exclusiveMinimum', 'multipleOf', 'pattern', 'minLength', 'minProperties', 'propertyNames', 'uniqueItems', 'minItems', 'maxItems'];
const TYPED = ['$ref', 'const', 'enum', 'allOf', 'anyOf', 'oneOf', 'type', 'properties', 'required', 'additionalProperties', 'items'];

const pascal = (name) => name.split(/[_-]/).map((word) => word[0].toUpperCase() + word.slice(1)).join('');
const documentType = (name) => `${pascal(name)}Document`;
const comment = ({ description }) => (description ? `/** ${description} */\n` : '');
const key = (name) => (/^[A-Za-z_]\w*$/.test(name) ? name : `'${name}'`);
/** What every value has says nothing beside another type. */
const joined = (types, sign) => {
  const said = [...new Set(types.filter((type) => type !== 'unknown'))];
  if (said.length === 0 || (sign === ' | ' && said.length < new Set(types).size)) return 'unknown';
  return said.length === 1 ? said[0] : `(${said.join(sign)})`;
};

function typesOf(name, schema) {
  const imports = new Set();

  function reference(ref) {
    const [file, pointer = ''] = ref.split('#');
    const definition = pointer && pascal(pointer.replace('/definitions/', ''));
    if (file === '') return definition;
    const other = file.slice(BASE.length).replace(/\.schema\.json$/, '');
    if (file !== `${BASE}${other}.schema.json`) throw new Error(`${name}: $ref '${ref}' leads to no schema under ${BASE}`);
    imports.add(other);
    return `${other}.${definition || documentType(other)}`;
  }

  function object({ properties = {}, required = [], additionalProperties: more }) {
    const members = Object.entries(properties).map(([member, each]) => `${comment(each)}${key(member)}${required.includes(member) ? '' : '?'}: ${type(each)};`);
    const open = more !== undefined && more !== false;
    if (members.length === 0) return `Record<string, ${open ? type(more) : 'unknown'}>`;
    // Named members need not be of the type of all others, so that an index of it would be wrong.
    return `{\n${members.join('\n')}\n${open ? '[more: string]: unknown;\n' : ''}}`;
  }

  function array({ items = true, minItems, maxItems }) {
    const item = type(items);
    return minItems !== undefined && minItems === maxItems ? `[${Array(minItems).fill(item).join(', ')}]` : `${item}[]`;
  }

  function type(node) {
    if (node === true) return 'unknown';
    const strange = Object.keys(node).find((keyword) => !UNTYPED.includes(keyword) && !TYPED.includes(keyword));
    if (strange) throw new Error(`${name}: keyword '${strange}' has no type in web/types.mjs: teach it there`);
    if (node.$ref) return reference(node.$ref);
    if (node.const !== undefined) return JSON.stringify(node.const);
    if (node.enum) return joined(node.enum.map((each) => JSON.stringify(each)), ' | ');
    const simple = { string: 'string', number: 'number', integer: 'number', boolean: 'boolean', null: 'null' };
    const shapes = { object, array };
    const kinds = [node.type ?? (node.properties ? 'object' : [])].flat();
    const ofKinds = kinds.map((kind) => (kind === 'object' && !node.properties && (node.anyOf || node.oneOf) ? 'unknown' : (simple[kind] ?? shapes[kind](node))));
    const choices = [node.anyOf, node.oneOf].filter(Boolean).map((list) => joined(list.map(type), ' | '));
    return joined([joined(ofKinds, ' | '), ...(node.allOf ?? []).map(type), ...choices], ' & ');
  }

  const named = [...Object.entries(schema.definitions ?? {}).map(([each, node]) => [pascal(each), node]), [documentType(name), schema]];
  const texts = named.map(([each, node]) => `${comment(node)}export type ${each} = ${type(node)};\n`);
  return [`// Made of ${name}.schema.json by web/types.mjs.\n`, ...[...imports].map((other) => `import type * as ${other} from './${other}';\n`), ...texts].join('\n');
}

const [out, ...files] = process.argv.slice(2);
mkdirSync(out, { recursive: true });
for (const file of files) {
  const name = basename(file, '.schema.json');
  writeFileSync(join(out, `${name}.ts`), typesOf(name, JSON.parse(readFileSync(file, 'utf8'))));
}
