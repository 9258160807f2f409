// SPDX-License-Identifier: Apache-2.0
// The little that the tests use of it.
declare module "ws" {
  export default class WebSocket {
    constructor(url: string, protocols: string[]);
    on(event: "close", listener: (code: number, reason: Buffer) => void): void;
  }
}
