// SPDX-License-Identifier: Apache-2.0
// The two ways to the station, opened before the rest of the page is read, so that the first picture is
// under way meanwhile. Pictures have a connection of their own: on a link that loses packets what is
// lost of one holds up nothing of the other, and neither takes the other's share.
import { LiveLink } from "./data/live.ts";
import { query } from "./data/token.ts";
import { isOnDemand, pictureTopic } from "./data/topics.ts";
import { drawEarly } from "./picture/early.ts";
import { beginsWithPicture } from "./ui/layout.ts";

const scheme = location.protocol === "https:" ? "wss:" : "ws:";
const url = (): string => `${scheme}//${location.host}/ws${query()}`;

export const telemetry = new LiveLink(url, (topic) => !isOnDemand(topic));
export const pictures = new LiveLink(url, isOnDemand);

/** Until a session says what it wants: the picture that the page will begin with. */
pictures.onOffer(() => {
  const vehicle = pictures.offering()[0];
  if (!beginsWithPicture() || vehicle === undefined) return;
  pictures.onFirst(drawEarly);
  pictures.want([`/${vehicle}/${pictureTopic}`]);
});
