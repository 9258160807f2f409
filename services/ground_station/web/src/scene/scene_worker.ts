// SPDX-License-Identifier: Apache-2.0
// The scene's own thread.
import "./plain_colors.ts";
import type { FromScene, ToScene } from "./messages.ts";
import { SceneView } from "./view.ts";

const page = self as unknown as {
  onmessage: (event: MessageEvent<ToScene>) => void;
  postMessage(message: FromScene): void;
  view: SceneView | null; // for probe/scene.mjs
};
page.view = null;

page.onmessage = ({ data }) => {
  try {
    if (data.kind === "begin")
      page.view = new SceneView(data.canvas, data.ratio, (message) => page.postMessage(message));
    else page.view?.take(data);
  } catch (error) {
    page.view = null;
    page.postMessage({ kind: "failed", reason: (error as Error).message });
  }
};
