// SPDX-License-Identifier: Apache-2.0
import type { Browser, Page } from "playwright-core";

export const hasChromium: boolean;
export function launch(options?: { scene?: boolean }): Promise<Browser>;
export function open(browser: Browser, url: string,
  options?: { width?: number; height?: number; name?: string }):
  Promise<Page & { problems: string[] }>;
export function expectText(page: Page, selector: string, pattern: RegExp, timeout?: number):
  Promise<string>;
export function firstPicture_ms(page: Page): Promise<number>;
