// SPDX-License-Identifier: Apache-2.0
// Places in a recording, kept by this browser under the file's name.

export interface Bookmark { time_s: number; name: string }

const key = (recording: string): string => `foretrack.bookmarks.${recording}`;

export function loadBookmarks(recording: string): Bookmark[] {
  try {
    const parsed: unknown = JSON.parse(localStorage.getItem(key(recording)) ?? "[]");
    return Array.isArray(parsed) ? (parsed as Bookmark[]) : [];
  } catch {
    return [];
  }
}

export function saveBookmarks(recording: string, bookmarks: Bookmark[]): void {
  localStorage.setItem(key(recording), JSON.stringify(bookmarks));
}
