// SPDX-License-Identifier: Apache-2.0
// Our landmarks against the original's (@mediapipe/pose in headless Chromium) on pictures.
//   node bench/blazepose/compare.mjs [--model 0|1|2] [--program foretrack_perceive] [PICTURE.png...]
// Without pictures: those of the tests. Ends with 1 if the median of a picture is above 1 px.
// Needs Node 18 and Debian's chromium; fetches the package with npm the first time.
import {execFileSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {basename, dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {parseArgs} from 'node:util';

import {usualPictures} from './pictures.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '../..');
const {values: options, positionals} = parseArgs({
  allowPositionals: true,
  options: {
    model: {type: 'string'},
    program: {type: 'string', default: join(root, 'build/bin/foretrack_perceive')},
    limit: {type: 'string', default: '1.0'},
  },
});
const pictures = positionals.length ? positionals : usualPictures();
const original = join(root, 'models/mediapipe');
if (!existsSync(original))
  execFileSync(join(root, 'deploy/models/fetch.sh'), ['--package', original], {stdio: 'inherit'});

function run(program, args) {
  return JSON.parse(execFileSync(program, args, {maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'ignore']}));
}

function spread(values) {
  const sorted = [...values].sort((a, b) => a - b);
  return {median: sorted[Math.floor(sorted.length / 2)], most: sorted[sorted.length - 1]};
}

function compare(reference, ours, width, height) {
  const pixels = reference.landmarks.map((mark, k) => Math.hypot(
    mark.x * width - ours.landmarks[k].x_px, mark.y * height - ours.landmarks[k].y_px));
  const millimetres = reference.world.map((mark, k) => {
    const [x, y, z] = ours.landmarks[k].world_m;
    return 1e3 * Math.hypot(mark.x - x, mark.y - y, mark.z - z);
  });
  return {pixels: spread(pixels), millimetres: spread(millimetres)};
}

let worst = 0;
console.log('model  picture               landmarks px: median, most   world mm: median, most');
for (const model of options.model ? [options.model] : ['0', '1', '2']) {
  const reference = run('node', [join(here, 'reference.mjs'), '--model', model, ...pictures]);
  const name = ['lite', 'full', 'heavy'][Number(model)];
  const ours = run(options.program, ['--json', '--model', name, ...pictures.flatMap((file) => ['--image', file])]);
  reference.pictures.forEach((entry, k) => {
    const theirs = entry.frames[0], mine = ours.frames[k].people[0];
    const label = `${name.padEnd(6)} ${basename(entry.picture).padEnd(20)}`;
    if (!theirs.landmarks || !mine) {
      const same = !theirs.landmarks && !mine;
      if (!same) worst = Infinity;
      console.log(`${label}  ${same ? 'nobody, for both' : 'only one of the two sees a person'}`);
      return;
    }
    const {pixels, millimetres} = compare(theirs, mine, entry.width, entry.height);
    worst = Math.max(worst, pixels.median);
    console.log(`${label}  ${pixels.median.toFixed(4).padStart(12)} ${pixels.most.toFixed(4).padStart(10)}` +
      `     ${millimetres.median.toFixed(3).padStart(12)} ${millimetres.most.toFixed(3).padStart(8)}`);
  });
}
process.exit(worst <= Number(options.limit) ? 0 : 1);
