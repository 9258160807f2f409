// SPDX-License-Identifier: Apache-2.0
// The first picture is drawn as soon as it is there, while the rest of the page is still being read; the
// page then goes on with it.
import { CdrReader } from "@foxglove/cdr";

import { seconds, type Time } from "../data/messages.ts";
import type { RawSample } from "../data/sample.ts";

const place = "#page > .loading"; // until the page is there
const mark = "first picture";

let early: { stamp_s: number; source: Promise<ImageBitmap> } | null = null;

/** The bytes are a view into a larger buffer, which goes on. */
export const decodeImage = (format: string, bytes: Uint8Array): Promise<ImageBitmap> =>
  createImageBitmap(new Blob([bytes.slice()], { type: `image/${format || "jpeg"}` }));

/** When the page's first picture was drawn, for who measures it. */
export function markFirst(): void {
  if (performance.getEntriesByName(mark).length === 0) performance.mark(mark);
}

function draw(source: ImageBitmap, time_s: number): void {
  const loading = document.querySelector(place);
  if (!loading) return;
  const figure = document.createElement("figure");
  const canvas = document.createElement("canvas");
  const caption = document.createElement("figcaption");
  [canvas.width, canvas.height] = [source.width, source.height];
  canvas.getContext("2d")!.drawImage(source, 0, 0);
  caption.textContent = `${new Date(1e3 * time_s).toISOString().slice(11, 19)} UTC`;
  figure.append(canvas, caption);
  loading.append(figure);
  markFirst();
}

/** A sample of sensor_msgs/CompressedImage, read without its schema, whose reader comes later. */
export function drawEarly({ data, time_s }: RawSample): void {
  if (early || !data || !document.querySelector(place)) return;
  const reader = new CdrReader(data);
  const stamp_s = seconds({ sec: reader.int32(), nanosec: reader.uint32() });
  reader.string(); // of its header
  const source = decodeImage(reader.string(), reader.uint8Array());
  early = { stamp_s, source };
  source.then((picture) => draw(picture, time_s), () => {}); // the page says what is wrong with it
}

/** The picture of this stamp, if it is the early one; it is given away once. */
export function takeEarly(stamp: Time): Promise<ImageBitmap> | null {
  if (early?.stamp_s !== seconds(stamp)) return null;
  const { source } = early;
  early = null;
  return source;
}
