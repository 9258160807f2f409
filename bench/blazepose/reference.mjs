// SPDX-License-Identifier: Apache-2.0
// What the original (@mediapipe/pose, in headless Chromium) sees in pictures, as JSON.
//   node reference.mjs [--model 0|1|2] [--frames N] [--compact] [--gpu] [--chromium PROGRAM] PICTURE.png...
// Each picture is shown N times from a reset: the first time it is detected, then it is tracked.
// --compact: as tests/data/blazepose_reference.json (a row a landmark: pixels, visibility, metres).
// --package: the unpacked npm package; deploy/models/fetch.sh --package FOLDER makes it. Node 18.
import {spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {basename, dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {parseArgs} from 'node:util';

const here = dirname(fileURLToPath(import.meta.url));
const {values: options, positionals: pictures} = parseArgs({
  allowPositionals: true,
  options: {
    model: {type: 'string', default: '1'},
    frames: {type: 'string', default: '1'},
    gpu: {type: 'boolean', default: false},
    compact: {type: 'boolean', default: false},
    verbose: {type: 'boolean', default: false},
    chromium: {type: 'string', default: 'chromium'},
    package: {type: 'string', default: join(here, '../../models/mediapipe')},
    timeout: {type: 'string', default: '300'},
  },
});

// The listener of the package says landmarks only; the graph also has the regions.
function withRegions(source) {
  return source
      .replace('wants:["pose_landmarks",',
               'wants:["pose_rect_from_detection","pose_rect_from_landmarks","pose_detection",' +
                   '"pose_landmarks",')
      .replace('outs:{image:{type:"texture",stream:"image_transformed"},',
               'outs:{roi:{type:"proto",stream:"pose_rect_from_detection"},' +
                   'tracked:{type:"proto",stream:"pose_rect_from_landmarks"},' +
                   'detection:{type:"proto",stream:"pose_detection"},');
}

function answer(path) {
  if (path === '/') return ['text/html', readFileSync(join(here, 'page.html'))];
  if (path === '/job') {
    return ['application/json', JSON.stringify({
      model: Number(options.model), frames: Number(options.frames), cpu: !options.gpu,
      count: pictures.length})];
  }
  const picture = path.match(/^\/picture\/(\d+)$/);
  if (picture) return ['image/png', readFileSync(pictures[Number(picture[1])])];
  const part = path.match(/^\/pose\/([\w.]+)$/);
  if (!part) return null;
  const body = readFileSync(join(options.package, part[1]));
  if (part[1] === 'pose.js') return ['text/javascript', withRegions(body.toString())];
  if (part[1].endsWith('.js')) return ['text/javascript', body];
  return [part[1].endsWith('.wasm') ? 'application/wasm' : 'application/octet-stream', body];
}

// Model, name, and a row a landmark: x and y in pixels, visibility, world x, y, z in metres.
function compact(result) {
  const digits = (value, count) => Number(value.toFixed(count));
  const lines = result.pictures.map((entry) => JSON.stringify({
    model: Number(options.model), picture: basename(entry.picture),
    frames: entry.frames.map((frame) => frame.landmarks.map((mark, k) => {
      const {x, y, z} = frame.world[k];
      return [digits(mark.x * entry.width, 3), digits(mark.y * entry.height, 3),
        digits(mark.visibility, 4), digits(x, 5), digits(y, 5), digits(z, 5)];
    })),
  }));
  return lines.join(',\n');
}

function serve(done) {
  return createServer((request, response) => {
    if (request.url === '/done') {
      let body = '';
      request.on('data', (piece) => { body += piece; });
      request.on('end', () => { response.end(); done(JSON.parse(body)); });
      return;
    }
    let found = null;
    try {
      found = answer(request.url);
    } catch (error) {
      if (options.verbose) console.error(String(error));
    }
    response.writeHead(found ? 200 : 404, {'Content-Type': found ? found[0] : 'text/plain'});
    response.end(found ? found[1] : 'none');
  });
}

const profile = mkdtempSync(join(tmpdir(), 'foretrack-chromium-'));
let browser;
const result = await new Promise((resolve, reject) => {
  const server = serve(resolve);
  server.listen(0, '127.0.0.1', () => {
    browser = spawn(options.chromium, [
      '--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist', '--disable-extensions', '--no-first-run', '--force-color-profile=srgb',
      '--enable-logging=stderr', `--user-data-dir=${profile}`,
      `http://127.0.0.1:${server.address().port}/`,
    ], {stdio: ['ignore', 'ignore', options.verbose ? 'inherit' : 'ignore']});
    browser.on('error', reject);
    setTimeout(() => reject(new Error('the browser gave no answer')), 1000 * options.timeout).unref();
  });
}).catch((error) => ({error: String(error)}));
if (browser) browser.kill();
setTimeout(() => {
  rmSync(profile, {recursive: true, force: true, maxRetries: 5});
  if (result.error) {
    console.error(result.error);
    process.exit(1);
  }
  result.pictures.forEach((entry, k) => { entry.picture = pictures[k]; });
  process.stdout.write(options.compact ? compact(result) : JSON.stringify(result));
  process.exit(0);
}, 500);
