// SPDX-License-Identifier: Apache-2.0
// The newest picture on a canvas, an image or one of a video: drawn when there is a new one.
import { seconds } from "../data/messages.ts";
import type { Vehicle } from "../store/state.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { draw, placeIn } from "./draw.ts";
import { markFirst } from "./early.ts";
import { ImageReader } from "./images.ts";
import { type Box, boxAt, type Overlay, overlayOf } from "./overlay.ts";
import type { Picture } from "./picture.ts";
import { VideoReader } from "./video.ts";

const finger_px = 10;
const snapshot_px = 1280; // wide

/** How old a picture is by the flight's own clock, which the newest odometry tells. */
export function pictureAge_s(now_s: number, vehicle: Vehicle, stamp_s: number): number {
  const odometry = vehicle.latest["odometry"];
  if (!odometry) return NaN;
  const flight_s = seconds(odometry.message.header.stamp) + Math.max(0, now_s - odometry.time_s);
  return Math.max(0, flight_s - stamp_s);
}

interface Shown extends Picture { vehicle: string; generation: number }

export class PictureScreen {
  problem = "";
  private readonly canvas = document.createElement("canvas");
  private readonly context = this.canvas.getContext("2d", { alpha: false })!;
  private readonly observer = new ResizeObserver(() => this.fit());
  private shown: Shown | null = null;
  private overlay: Overlay | null = null;
  private readonly images = new ImageReader({ picture: (picture) => this.show(picture, false),
    problem: (text) => (this.problem = text) });
  private readonly video = new VideoReader({ picture: (picture) => this.show(picture, true),
    problem: (text) => this.giveUpVideo(text) });
  private looked_s = -1; // stamp of the bodies that are drawn
  private fedOf = ""; // whose pictures are decoded
  private request = 0;
  private pictures = 0;

  constructor(private readonly session: Session, private readonly host: HTMLElement) {
    this.canvas.setAttribute("role", "img");
    host.prepend(this.canvas);
    this.observer.observe(host);
    this.loop();
  }

  destroy(): void {
    cancelAnimationFrame(this.request);
    this.observer.disconnect();
    this.shown?.source.close();
    this.video.close();
    this.canvas.remove();
  }

  /** Its stamp, in seconds; null: there is none of this vehicle. */
  get stamp_s(): number | null {
    const { vehicle, generation } = this.session;
    const mine = this.shown && this.shown.vehicle === vehicle?.name &&
      this.shown.generation === generation;
    return mine ? seconds(this.shown!.header.stamp) : null;
  }

  /** Who is at this point of the canvas. */
  at(x: number, y: number): Box | null {
    if (!this.overlay || this.stamp_s === null) return null;
    const { clientWidth, clientHeight } = this.host;
    const place = placeIn(clientWidth, clientHeight, this.overlay);
    return boxAt(this.overlay, (x - place.x) / place.scale, (y - place.y) / place.scale,
      finger_px / place.scale);
  }

  get people(): Box[] {
    return this.stamp_s === null ? [] : this.overlay?.boxes ?? [];
  }

  /** As it is drawn, with what lies over it. */
  async snapshot(caption: string): Promise<Blob | null> {
    if (!this.shown || this.stamp_s === null) return null;
    const { source, width: wide, height: high } = this.shown;
    const scale = Math.max(1, snapshot_px / wide);
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [wide * scale, high * scale];
    const context = canvas.getContext("2d")!;
    draw(context, source, this.overlay, { x: 0, y: 0, scale }, 1.5, this.shown);
    context.font = "18px system-ui, sans-serif";
    const width = context.measureText(caption).width + 16;
    context.fillStyle = "#0b1015cc";
    context.fillRect(0, canvas.height - 28, width, 28);
    context.fillStyle = "#e6edf3";
    context.fillText(caption, 8, canvas.height - 9);
    return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  }

  private fit(): void {
    const ratio = Math.min(devicePixelRatio, 2);
    this.canvas.width = Math.round(this.host.clientWidth * ratio);
    this.canvas.height = Math.round(this.host.clientHeight * ratio);
    this.paint();
  }

  private readonly loop = (): void => {
    this.request = requestAnimationFrame(this.loop);
    const { vehicle } = this.session;
    if (this.shown && this.stamp_s === null) this.clear();
    // What was seen in a picture comes a moment after it.
    if (this.shown && vehicle?.looks.newest?.stamp_s !== this.looked_s) this.lay();
    if (!vehicle || this.host.clientWidth === 0) return; // nobody sees it
    this.follow(vehicle);
    if (this.session.showsVideo) this.video.feed(vehicle.video);
    if (!this.session.showsVideo || !this.session.video.runs) this.images.feed(vehicle);
  };

  // A decoder goes on with the video that it began.
  private follow({ name }: Vehicle): void {
    const of = `${name} ${this.session.generation} ${this.session.showsVideo}`;
    if (of === this.fedOf) return;
    this.fedOf = of;
    this.video.close();
    this.session.video.runs = false;
  }

  private show(picture: Picture, isVideo: boolean): void {
    const { vehicle, generation, video } = this.session;
    if (!vehicle || (isVideo ? !this.session.showsVideo : video.runs)) return picture.source.close();
    this.shown?.source.close();
    this.shown = { ...picture, vehicle: vehicle.name, generation };
    this.problem = "";
    if (isVideo) video.runs = true;
    this.host.dataset["kind"] = isVideo ? "video" : "image";
    this.renew();
  }

  private giveUpVideo(text: string): void {
    this.session.video.problem = text;
    this.session.video.runs = false;
    this.session.notice(t("No video: {why}. Images are shown.", { why: text }), true);
  }

  private lay(): void {
    const { vehicle, state } = this.session;
    if (!vehicle || !this.shown || this.stamp_s === null) return;
    this.looked_s = vehicle.looks.newest?.stamp_s ?? -1;
    this.overlay = overlayOf(state, vehicle, this.shown.header, this.shown);
    this.paint();
  }

  private renew(): void {
    const { vehicle } = this.session;
    if (!vehicle || !this.shown || this.stamp_s === null) return;
    this.lay();
    this.host.dataset["stamp"] = `${this.stamp_s}`;
    this.host.dataset["pictures"] = `${++this.pictures}`;
    this.host.dataset["lag"] =
      (1e3 * pictureAge_s(this.session.now_s, vehicle, this.stamp_s)).toFixed(0);
    markFirst();
    this.session.settle();
  }

  private paint(): void {
    if (!this.shown || this.canvas.width === 0) return;
    const place = placeIn(this.canvas.width, this.canvas.height, this.shown);
    const unit = this.host.clientWidth > 0 ? this.canvas.width / this.host.clientWidth : 1;
    const small = this.host.clientWidth < 300 ? 0.8 : 1;
    draw(this.context, this.shown.source, this.overlay, place, unit * small, this.shown);
  }

  private clear(): void {
    this.shown?.source.close();
    this.shown = null;
    this.overlay = null;
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
  }
}
