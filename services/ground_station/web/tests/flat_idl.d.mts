// SPDX-License-Identifier: Apache-2.0
export function flatIdl(type: string): string;
export const projectFolder: string;
