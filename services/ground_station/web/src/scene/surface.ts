// SPDX-License-Identifier: Apache-2.0
// What the camera's controls take for the element that is pointed at: a worker has none, so the page
// hands its events on.
import { EventDispatcher } from "three";

import type { InputEvent } from "./messages.ts";

export class Surface extends EventDispatcher<Record<string, InputEvent>> {
  readonly style = {};
  readonly ownerDocument = this; // where the controls listen while a pointer is down
  clientWidth = 0;
  clientHeight = 0;

  getRootNode(): this {
    return this;
  }
  getBoundingClientRect() {
    const { clientWidth: width, clientHeight: height } = this;
    return { left: 0, top: 0, width, height };
  }
  setPointerCapture(): void {} // the page does
  releasePointerCapture(): void {}

  hand(event: InputEvent): void {
    const prevented = { ...event, preventDefault: () => {} };
    this.dispatchEvent(prevented);
  }
}
