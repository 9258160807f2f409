// SPDX-License-Identifier: Apache-2.0
// What lets this page in, where the station asks for it; kept for this tab.
const key = "foretrack.token";

// #token=… is taken out of the address.
function tokenOfAddress(): string | null {
  const token = new URLSearchParams(location.hash.slice(1)).get("token");
  if (!token) return null;
  sessionStorage.setItem(key, token);
  history.replaceState(null, "", location.pathname + location.search);
  return token;
}

let current = tokenOfAddress() ?? sessionStorage.getItem(key) ?? "";

export const token = (): string => current;

export function setToken(typed: string): void {
  current = typed.trim();
  sessionStorage.setItem(key, current);
}

/** A WebSocket of a browser cannot carry headers. */
export const query = (): string => (current ? `?token=${encodeURIComponent(current)}` : "");
