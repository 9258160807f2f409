// SPDX-License-Identifier: Apache-2.0
// The networks by themselves: the same tensors through TensorFlow Lite and through ours.
//   node bench/blazepose/tensors.mjs [--json] [--random N] [--program pose_tensors] [PICTURE.png...]
// TensorFlow Lite is Google's WebAssembly build (npm: @tensorflow/tfjs-tflite, Apache-2.0), fetched
// the first time, and run by Node itself. Without pictures: those of the tests. "Rounding" is how far
// TensorFlow Lite's own outputs move when its input changes by 1e-7: no two implementations can be
// expected to agree better. Ends with 1 if a landmark or a box differs by more than --limit pixels
// of the network's input (of random tensors, and more than three times rounding). Needs Node 18.
import {execFileSync} from 'node:child_process';
import {createHash} from 'node:crypto';
import {existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {parseArgs} from 'node:util';

import {usualPictures} from './pictures.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const {values: options, positionals} = parseArgs({
  allowPositionals: true,
  options: {
    json: {type: 'boolean', default: false},
    random: {type: 'string', default: '5'},
    program: {type: 'string', default: join(root, 'build/bin/pose_tensors')},
    limit: {type: 'string', default: '0.01'},
  },
});

// Which numbers of an output are one quantity. `limited`: held against --limit.
const outputsOfLandmarks = [
  {what: 'landmarks x, y, z', unit: 'px', tensor: 'Identity', takes: (k) => k % 5 < 3, limited: true},
  {what: 'visibility, presence', unit: 'logit', tensor: 'Identity', takes: (k) => k % 5 >= 3},
  {what: 'pose flag', unit: 'probability', tensor: 'Identity_1'},
  {what: 'heat maps', unit: 'logit', tensor: 'Identity_3'},
  {what: 'world landmarks', unit: 'mm', tensor: 'Identity_4', scale: 1e3},
];
const networks = {
  pose_detection: [
    {what: 'boxes and key points', unit: 'px', tensor: 'Identity', limited: true},
    {what: 'scores', unit: 'logit', tensor: 'Identity_1'},
  ],
  pose_landmark_lite: outputsOfLandmarks,
  pose_landmark_full: outputsOfLandmarks,
  pose_landmark_heavy: outputsOfLandmarks,
};

const roundings = 4;  // of each input
const runtime = {
  npm: '@tensorflow/tfjs-tflite@0.0.1-alpha.10',
  sha256: 'ce63551608097a5ecb0f0128fc64c53c15843a851fcd17f83e66e1908a628d71',
  folder: join(root, 'models/tflite'),
};

function fetchRuntime() {
  mkdirSync(runtime.folder, {recursive: true});
  const pack = ['pack', '--silent', '--pack-destination', runtime.folder, runtime.npm];
  const archive = join(runtime.folder, execFileSync('npm', pack).toString().trim());
  const found = createHash('sha256').update(readFileSync(archive)).digest('hex');
  if (found !== runtime.sha256) throw new Error(`${archive}: its SHA-256 is not the expected one`);
  execFileSync('tar', ['-xzf', archive, '-C', runtime.folder, '--strip-components=1']);
  rmSync(archive);
}

async function loadRuntime() {
  const script = join(runtime.folder, 'wasm/tflite_web_api_cc_simd.js');
  if (!existsSync(script)) fetchRuntime();
  const wasmBinary = readFileSync(script.replace(/js$/, 'wasm'));
  return createRequire(import.meta.url)(script)({wasmBinary, printErr: () => {}});
}

function loadNetwork(tflite, name) {
  const file = readFileSync(join(root, 'models', `${name}.tflite`));
  const at = tflite._malloc(file.length);
  tflite.HEAPU8.set(file, at);
  const made = tflite.TFLiteWebModelRunner.CreateFromBufferAndOptions(at, file.length,
      {numThreads: 1, enableProfiling: false, maxProfilingBufferEntries: 1});
  if (!made.ok()) throw new Error(`${name}: ${made.errorMessage()}`);
  return made.value();
}

function floats(file) {
  const bytes = readFileSync(file);
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
}

function tensors(vector) {
  const all = Array.from({length: vector.size()}, (_, k) => vector.get(k));
  return Object.fromEntries(all.map((tensor) => [tensor.name, tensor]));
}

function runOriginal(network, input) {
  const [entry] = Object.values(tensors(network.GetInputs()));
  if (entry.data().length !== input.length) throw new Error('the input has another size');
  entry.data().set(input);
  if (!network.Infer()) throw new Error('TensorFlow Lite could not run the network');
  return Object.fromEntries(Object.entries(tensors(network.GetOutputs()))
      .map(([name, tensor]) => [name, Float32Array.from(tensor.data())]));
}

// Changed by at most 1e-7, with numbers of a linear congruential generator (Numerical Recipes).
function rounded(input, seed) {
  let state = seed;
  return input.map((value) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return value + 1e-7 * (2 * state / 2 ** 32 - 1);
  });
}

function differences(theirs, ours, output) {
  if (theirs.length !== ours.length) throw new Error(`${output.tensor} has another size`);
  const found = [];
  for (let k = 0; k < ours.length; ++k)
    if (!output.takes || output.takes(k)) found.push((output.scale ?? 1) * Math.abs(theirs[k] - ours[k]));
  return found;
}

// NaN, which is less than nothing, comes last.
function spread(values) {
  const sorted = Float64Array.from(values).sort();
  return {median: sorted[sorted.length >> 1], most: sorted[sorted.length - 1]};
}

// Differences of the cases of one kind, by output: ours, and what rounding makes of the original.
function compareCases(network, outputs, inputs) {
  const rows = outputs.map((output) => ({output, ours: [], rounding: []}));
  for (const file of inputs) {
    const input = floats(file);
    const theirs = runOriginal(network, input);
    for (const {output, ours} of rows)
      for (const d of differences(theirs[output.tensor], floats(file.replace(/input$/, output.tensor)), output))
        ours.push(d);
    for (let seed = 1; seed <= roundings; ++seed) {
      const again = runOriginal(network, rounded(input, seed));
      for (const {output, rounding} of rows)
        rounding.push(spread(differences(theirs[output.tensor], again[output.tensor], output)).most);
    }
  }
  return {inputs: inputs.length, differences: rows.map(({output: {what, unit, limited = false}, ours, rounding}) =>
    ({what, unit, limited, ...spread(ours), rounding: spread(rounding).most}))};
}

function compareNetwork(tflite, name, folder) {
  const network = loadNetwork(tflite, name);
  const files = readdirSync(folder).filter((file) => file.startsWith(`${name}.`) && file.endsWith('.input'));
  const compare = (isRandom) => compareCases(network, networks[name],
      files.filter((file) => file.includes('.random-') === isRandom).map((file) => join(folder, file)));
  return {network: name, photographs: compare(false), random: compare(true)};
}

function print(report) {
  const numbers = ({median = NaN, most = NaN, rounding = NaN}) =>
    [median, most, rounding].map((value) => value.toExponential(1).padStart(9)).join('');
  console.log(`${'difference: median, most, (rounding)'.padEnd(34)}  of photographs' regions      of random tensors`);
  for (const {network, photographs, random} of report) {
    console.log(`${network}: ${photographs.inputs} inputs of photographs, ${random.inputs} random`);
    photographs.differences.forEach((row, k) => console.log(
        `  ${`${row.what}, ${row.unit}`.padEnd(30)} ${numbers(row)}  ${numbers(random.differences[k])}`));
  }
}

function isKept({photographs, random}) {
  const limit = Number(options.limit);
  const within = (cases, roundingCounts) => cases.inputs === 0 || cases.differences.every(
      (row) => !row.limited || row.most <= Math.max(limit, roundingCounts * row.rounding));
  return photographs.inputs + random.inputs > 0 && within(photographs, 0) && within(random, 3);
}

const folder = mkdtempSync(join(tmpdir(), 'foretrack-tensors-'));
try {
  const pictures = positionals.length ? positionals : usualPictures();
  execFileSync(options.program, [folder, '--random', options.random, ...pictures], {stdio: 'pipe'});
  const tflite = await loadRuntime();
  const report = Object.keys(networks).map((name) => compareNetwork(tflite, name, folder));
  if (options.json) console.log(JSON.stringify(report, null, 1));
  else print(report);
  process.exitCode = report.every(isKept) ? 0 : 1;
} finally {
  rmSync(folder, {recursive: true, force: true});
}
