// SPDX-License-Identifier: Apache-2.0
// A video since its last key picture: what a decoder must be given to show the newest one.
import type { CompressedVideo } from "../data/messages.ts";

const keyUnit = 5;
const most = 300; // pictures; keys come each second

export function isKey(data: Uint8Array): boolean {
  for (let i = 0; i + 3 < data.length; i++)
    if (data[i] === 0 && data[i + 1] === 0 && data[i + 2] === 1 && (data[i + 3]! & 0x1f) === keyUnit)
      return true;
  return false;
}

export class VideoRun {
  /** Numbers of the pictures that are kept; −1: there is none. They grow over all keys. */
  first = -1;
  private pictures: CompressedVideo[] = [];
  private next = 0;

  get last(): number {
    return this.first < 0 ? -1 : this.first + this.pictures.length - 1;
  }

  at(number: number): CompressedVideo {
    return this.pictures[number - this.first]!;
  }

  push(picture: CompressedVideo): void {
    if (isKey(picture.data)) {
      this.pictures = [];
      this.first = this.next;
    }
    if (this.first < 0 || this.pictures.length >= most) this.first = -1; // until the next key
    else this.pictures.push(picture);
    this.next++;
  }
}
