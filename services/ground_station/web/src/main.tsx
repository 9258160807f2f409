// SPDX-License-Identifier: Apache-2.0
import { render } from "preact";

import { pictures, telemetry } from "./links.ts";
import { Page } from "./ui/page.tsx";
import { Session } from "./ui/session.ts";
import { loadLanguage } from "./ui/words.ts";

const session = new Session(telemetry, pictures);

// A hidden page gets no frames, but must not grow old nor hold what came.
let drawn_ms = 0;
function frame(): void {
  drawn_ms = performance.now();
  session.frame();
  requestAnimationFrame(frame);
}
setInterval(() => {
  if (performance.now() - drawn_ms > 400) session.frame();
}, 500);
setInterval(() => session.changed(), 250);

const root = document.getElementById("page")!;
void loadLanguage().then(() => {
  root.textContent = "";
  session.frame(); // what came meanwhile
  render(<Page session={session} />, root);
});
requestAnimationFrame(frame);
Object.assign(window, { foretrack: session }); // for tests and for the curious
