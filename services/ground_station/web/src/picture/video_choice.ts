// SPDX-License-Identifier: Apache-2.0
// Whether the picture is shown as video: the operator's choice, which this browser keeps.
import { canShowVideo } from "./video.ts";

const key = "foretrack.picture";

export class VideoChoice {
  possible = false; // this browser decodes it
  runs = false; // a picture of it was shown
  problem = ""; // why it was given up, until it is chosen anew
  private wanted_ = localStorage.getItem(key) === "video";

  constructor() {
    void canShowVideo().then((can) => (this.possible = can));
  }

  get wanted(): boolean {
    return this.wanted_;
  }
  set wanted(wanted: boolean) {
    this.wanted_ = wanted;
    this.problem = "";
    this.runs = false;
    localStorage.setItem(key, wanted ? "video" : "images");
  }
  get on(): boolean {
    return this.wanted_ && this.possible && this.problem === "";
  }
}
