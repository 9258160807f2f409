// SPDX-License-Identifier: Apache-2.0
// A picture that can be drawn, and when and by which camera it was taken.
import type { Header } from "../data/messages.ts";

export interface Picture {
  header: Header;
  source: ImageBitmap | VideoFrame;
  width: number;
  height: number;
}

/** What becomes of a decoder's work. */
export interface Outcome {
  picture(picture: Picture): void;
  problem(text: string): void;
}
