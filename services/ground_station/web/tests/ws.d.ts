// The little that the tests use of it.
declare module "ws" {
  export default class WebSocket {
    constructor(url: string, protocols: string[]);
  }
}
