// SPDX-License-Identifier: Apache-2.0
// Between the world frame and WGS84, as PX4 projects: azimuthal, equidistant, on a sphere.
import type { Vehicle } from "../store/state.ts";

export interface Wgs84 { lat_deg: number; lon_deg: number }
export type Metres = [number, number]; // east, north of the world's origin

const radius_m = 6371000;
const rad = Math.PI / 180;

export function toMetresOf(origin: Wgs84, { lat_deg, lon_deg }: Wgs84): Metres {
  const [lat, ref] = [lat_deg * rad, origin.lat_deg * rad];
  const along = (lon_deg - origin.lon_deg) * rad;
  const cosine = Math.sin(ref) * Math.sin(lat) + Math.cos(ref) * Math.cos(lat) * Math.cos(along);
  const c = Math.acos(Math.min(1, Math.max(-1, cosine)));
  const k = radius_m * (c > 1e-12 ? c / Math.sin(c) : 1);
  const north = Math.cos(ref) * Math.sin(lat) - Math.sin(ref) * Math.cos(lat) * Math.cos(along);
  return [k * Math.cos(lat) * Math.sin(along), k * north];
}

export function toWgs84(origin: Wgs84, [east_m, north_m]: Metres): Wgs84 {
  const [x, y] = [east_m / radius_m, north_m / radius_m];
  const [c, ref] = [Math.hypot(x, y), origin.lat_deg * rad];
  if (c < 1e-15) return { lat_deg: origin.lat_deg, lon_deg: origin.lon_deg };
  const lat = Math.asin(Math.cos(c) * Math.sin(ref) + (y * Math.sin(c) * Math.cos(ref)) / c);
  const along = Math.atan2(x * Math.sin(c),
    c * Math.cos(ref) * Math.cos(c) - y * Math.sin(ref) * Math.sin(c));
  return { lat_deg: lat / rad, lon_deg: origin.lon_deg + along / rad };
}

/** Of the world frame, which is the flight controller's; null: it knows no global position. */
export function originOf(vehicle: Vehicle | undefined): Wgs84 | null {
  const local = vehicle?.latest["fmu/out/vehicle_local_position"]?.message;
  if (!local?.xy_global) return null;
  return { lat_deg: local.ref_lat, lon_deg: local.ref_lon };
}

/** Seven places: a centimetre. */
export const placeText = ({ lat_deg, lon_deg }: Wgs84): string =>
  `${Math.abs(lat_deg).toFixed(7)}° ${lat_deg < 0 ? "S" : "N"} ` +
  `${Math.abs(lon_deg).toFixed(7)}° ${lon_deg < 0 ? "W" : "E"}`;
