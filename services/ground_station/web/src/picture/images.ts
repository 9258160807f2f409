// SPDX-License-Identifier: Apache-2.0
// Pictures that come one by one: the newest is decoded, one at a time.
import type { CompressedImage } from "../data/messages.ts";
import type { Vehicle } from "../store/state.ts";
import { decodeImage, takeEarly } from "./early.ts";
import type { Outcome } from "./picture.ts";

export class ImageReader {
  private taken: CompressedImage | null = null; // the last that was decoded, or is
  private decoding = false;

  constructor(private readonly outcome: Outcome) {}

  feed(vehicle: Vehicle): void {
    const image = vehicle.latest["camera/ground/image/compressed"]?.message;
    if (!image || image === this.taken || this.decoding) return;
    this.taken = image;
    void this.decode(image);
  }

  private async decode(image: CompressedImage): Promise<void> {
    this.decoding = true;
    try {
      const source = await (takeEarly(image.header.stamp) ?? decodeImage(image.format, image.data));
      const { width, height } = source;
      this.outcome.picture({ header: image.header, source, width, height });
    } catch (error) {
      this.outcome.problem((error as Error).message);
    } finally {
      this.decoding = false;
    }
  }
}
