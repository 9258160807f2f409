// SPDX-License-Identifier: Apache-2.0
// Opens a recording: by its index, or, where that is missing, whole.
import type { IReadable } from "@mcap/core";

import { CutRecording } from "./cut_recording.ts";
import { IndexedRecording } from "./indexed_recording.ts";
import type { Recording } from "./recording.ts";

export { readableAt, readableOf } from "./readable.ts";

/** Throws what is wrong with it. */
export async function openMcap(name: string, readable: IReadable): Promise<Recording> {
  try {
    return await IndexedRecording.open(name, readable);
  } catch (error) {
    return CutRecording.open(name, readable).catch(() => {
      throw error;
    });
  }
}
