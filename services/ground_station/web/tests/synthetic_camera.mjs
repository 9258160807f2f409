// SPDX-License-Identifier: Apache-2.0
// What the camera of the made-up flight sees: pictures that are painted from where people are.
import { deflateSync } from "node:zlib";

import { headerOf, peopleAt, stampOf, vehicleAt } from "./synthetic.mjs";
import { keyPicture, repeatedPicture } from "./synthetic_video.mjs";

const full = { width: 640, height: 480, f: 320 };
const small = { width: 320, height: 240 };
const frame_id = "camera_optical_frame";
const colors = { 1: [230, 120, 60], 2: [80, 150, 230] };

/** Of the full image: where a cylinder on the ground stands. null: behind the camera. */
export function boxOf(t, index, { x, y }, radius = 0.25, height = 1.75) {
  const v = vehicleAt(t, index);
  const [dx, dy] = [x - v.x, y - v.y];
  const ahead = dx * Math.cos(v.yaw) + dy * Math.sin(v.yaw);
  const left = -dx * Math.sin(v.yaw) + dy * Math.cos(v.yaw);
  if (ahead < 0.3) return null;
  const px = (m) => (full.f * m) / ahead;
  const [u, foot] = [full.width / 2 - px(left), full.height / 2 + px(v.z)];
  return [u - px(radius), foot - px(height), u + px(radius), foot];
}

function cameraInfo(t, { width, height }) {
  const scale = width / full.width;
  const [f, cx, cy] = [full.f * scale, width / 2, height / 2];
  return { header: { ...headerOf(t), frame_id }, height, width, distortion_model: "plumb_bob",
    d: [0, 0, 0, 0, 0], k: [f, 0, cx, 0, f, cy, 0, 0, 1], r: [1, 0, 0, 0, 1, 0, 0, 0, 1],
    p: [f, 0, cx, 0, 0, f, cy, 0, 0, 0, 1, 0], binning_x: 0, binning_y: 0,
    roi: { x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: false } };
}

const table = Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});
const crc = (bytes) =>
  (bytes.reduce((c, byte) => table[(c ^ byte) & 255] ^ (c >>> 8), 0xffffffff) ^ 0xffffffff) >>> 0;

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  const out = Buffer.alloc(8 + body.length);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(crc(body), 4 + body.length);
  return out;
}

/** Rows of rgb. */
export function png({ width, height }, paint) {
  const raw = Buffer.alloc((3 * width + 1) * height);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) raw.set(paint(x, y), y * (3 * width + 1) + 1 + 3 * x);
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from([0x89, 80, 78, 71, 13, 10, 26, 10]), chunk("IHDR", head),
    chunk("IDAT", deflateSync(raw, { level: 1 })), chunk("IEND", Buffer.alloc(0))]);
}

function paintOf(t, index) {
  const scale = small.width / full.width;
  const boxes = peopleAt(t, index).map(({ id, ...at }) => ({ id, box: boxOf(t, index, at) }))
    .filter(({ box }) => box).map(({ id, box }) => [colors[id], box.map((px) => px * scale)]);
  return (x, y) => {
    const hit = boxes.find(([, [l, top, r, b]]) => x >= l && x < r && y >= top && y < b);
    if (hit) return hit[0];
    return y < small.height / 2 ? [120, 150, 180] : [70 + ((x + y) % 16), 85, 70];
  };
}

/** A portrait of a person, for questions about who it is. */
export const portrait = (id) => png({ width: 60, height: 120 }, () => colors[id]);

/** The samples that belong to one picture: [topic's name, message]. */
export function pictureAt(t, index) {
  return [["camera/ground/camera_info", cameraInfo(t, small)],
    ["camera/ground/image/compressed", { header: { ...headerOf(t), frame_id }, format: "png",
      data: png(small, paintOf(t, index)) }]];
}

/** The same as video: number 0 of each dozen is a key picture, and those after it repeat it. */
export function videoAt(t, index, number) {
  const paint = paintOf(t, index);
  const even = (x, y) => paint(x & ~1, y & ~1);
  const data = number % 12 === 0 ? keyPicture(small, even) : repeatedPicture(small, number % 12);
  return [["camera/ground/camera_info", cameraInfo(t, small)],
    ["camera/ground/video", { timestamp: stampOf(t), frame_id, data, format: "h264" }]];
}

export const colorInfoAt = (t) => ["camera/color/camera_info", cameraInfo(t, full)];
