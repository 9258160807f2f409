// SPDX-License-Identifier: Apache-2.0
// The photographs that the comparisons with the original use, as far as they are installed.
import {existsSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');

export function usualPictures() {
  return [
    join(root, 'tests/data/basketball.png'),
    '/usr/share/doc/opencv-doc/examples/data/basketball2.png',
    '/usr/lib/python3/dist-packages/skimage/data/astronaut.png',
  ].filter(existsSync);
}
