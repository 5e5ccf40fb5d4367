// Records what the Khronos glTF validator reports of the files in a folder, as the
// tests of crates/io/tests/import/validator read it. docs/testing.md says how to run it.
//
// usage: node record.mjs FOLDER > reports.txt
// FOLDER has the files, and the package gltf-validator in its node_modules.

import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';

const SEVERITIES = ['Error', 'Warning', 'Information', 'Hint'];
const RECORDED = SEVERITIES.slice(0, 2);

const folder = resolve(process.argv[2]);
const require = createRequire(join(folder, 'record.mjs'));
const validator = require('gltf-validator');

/** FNV-1a (Fowler, Noll, Vo), 64 bits. */
function fnv1a(bytes) {
  let hash = 0xcbf29ce484222325n;
  for (const byte of bytes) hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 0x100000001b3n);
  return hash.toString(16).padStart(16, '0');
}

/** All codes of the validator, as lines: group, severity, code. */
function codes() {
  const list = readFileSync(require.resolve('gltf-validator/ISSUES.md'), 'utf8');
  const lines = [];
  let group = '';
  for (const line of list.split('\n')) {
    group = line.match(/^## (\w+)/)?.[1] ?? group;
    const cells = line.split('|');
    const [code, severity] = [cells[1], cells.at(-2)];
    if (SEVERITIES.includes(severity)) lines.push(`code ${group} ${severity} ${code}`);
  }
  return lines;
}

/** What the validator reports of a file, as lines: severity, code, where. */
async function issues(name, bytes) {
  const read = async (uri) => new Uint8Array(readFileSync(join(folder, decodeURIComponent(uri))));
  const format = name.split('.').at(-1);
  const options = { uri: name, format, maxIssues: 0, externalResourceFunction: read };
  const report = await validator.validateBytes(new Uint8Array(bytes), options);
  const found = report.issues.messages.map(({ code, severity, pointer, offset }) =>
    `issue ${SEVERITIES[severity]} ${code} ${pointer ?? `byte ${offset}`}`.trim());
  return [...new Set(found)].filter((line) => RECORDED.includes(line.split(' ')[1])).sort();
}

console.log('# What the Khronos glTF validator reports of the files that crates/io/tests/import/validator makes.');
console.log('# Written by record.mjs in this folder; docs/testing.md says how.');
console.log(`validator ${validator.version()}`);
codes().forEach((line) => console.log(line));
for (const name of readdirSync(folder).filter((name) => /\.gl(b|tf)$/.test(name)).sort()) {
  const bytes = readFileSync(join(folder, name));
  console.log(`file ${fnv1a(bytes)} ${name}`);
  (await issues(name, bytes)).forEach((line) => console.log(line));
}
