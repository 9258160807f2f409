// SPDX-License-Identifier: Apache-2.0
// The made-up camera's pictures as H.264 (ITU-T H.264, baseline): each key picture as plain samples
// (I_PCM), and after it pictures that repeat it (P, all skipped). Annex B.

class Bits {
  bytes = [];
  held = 0;
  count = 0;

  put(value, bits) {
    for (let i = bits - 1; i >= 0; i--) {
      this.held = (this.held << 1) | ((value >> i) & 1);
      if (++this.count % 8 === 0) {
        this.bytes.push(this.held & 255);
        this.held = 0;
      }
    }
    return this;
  }
  /** ue(v) of the standard, 9.1. */
  ue(value) {
    const length = Math.floor(Math.log2(value + 1));
    return this.put(0, length).put(value + 1, length + 1);
  }
  align() {
    while (this.count % 8 !== 0) this.put(0, 1);
    return this;
  }
  end() {
    return this.put(1, 1).align().bytes;
  }
}

/** With its start code, and nothing in it that looks like one. */
function unit(head, payload) {
  const out = [0, 0, 0, 1, head];
  let zeros = 0;
  for (const byte of payload) {
    if (zeros >= 2 && byte <= 3) {
      out.push(3);
      zeros = 0;
    }
    out.push(byte);
    zeros = byte === 0 ? zeros + 1 : 0;
  }
  return Uint8Array.from(out);
}

const frameBits = 4;

function parameterSets({ width, height }) {
  const sps = new Bits().put(66, 8).put(0xc0, 8).put(31, 8).ue(0).ue(frameBits - 4).ue(2).ue(1)
    .put(0, 1).ue(width / 16 - 1).ue(height / 16 - 1).put(1, 1).put(1, 1).put(0, 1).put(0, 1);
  const pps = new Bits().ue(0).ue(0).put(0, 2).ue(0).ue(0).ue(0).put(0, 1).put(0, 2)
    .ue(0).ue(0).ue(0).put(0, 3);
  return [unit(0x67, sps.end()), unit(0x68, pps.end())];
}

const clip = (value) => Math.min(254, Math.max(1, Math.round(value)));

/** Full colour, as BT.601 has it. */
function yuv([r, g, b]) {
  return [clip(16 + 0.257 * r + 0.504 * g + 0.098 * b), clip(128 - 0.148 * r - 0.291 * g + 0.439 * b),
    clip(128 + 0.439 * r - 0.368 * g - 0.071 * b)];
}

/** paint: rgb of a pixel, whole in blocks of two. */
export function keyPicture(size, paint) {
  const { width, height } = size;
  const bits = new Bits().ue(0).ue(7).ue(0).put(0, frameBits).ue(0).put(0, 1).put(0, 1).ue(0);
  for (let my = 0; my < height; my += 16)
    for (let mx = 0; mx < width; mx += 16) {
      bits.ue(25).align(); // I_PCM
      for (let y = 0; y < 16; y++)
        for (let x = 0; x < 16; x++) bits.bytes.push(yuv(paint(mx + x, my + y))[0]);
      for (const plane of [1, 2])
        for (let y = 0; y < 16; y += 2)
          for (let x = 0; x < 16; x += 2) bits.bytes.push(yuv(paint(mx + x, my + y))[plane]);
    }
  return Buffer.concat([...parameterSets(size), unit(0x65, bits.end())]);
}

/** number: of pictures since the key, from 1. */
export function repeatedPicture({ width, height }, number) {
  const bits = new Bits().ue(0).ue(5).ue(0).put(number % 16, frameBits).put(0, 1).put(0, 1)
    .put(0, 1).ue(0).ue((width / 16) * (height / 16));
  return Buffer.from(unit(0x41, bits.end()));
}
