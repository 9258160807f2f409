// SPDX-License-Identifier: Apache-2.0
// Samples of any channel to plain objects, with the decoders that Foxglove itself uses.
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader as IdlReader } from "@foxglove/omgidl-serialization";
import { parse as parseRos } from "@foxglove/rosmsg";
import { MessageReader as RosReader } from "@foxglove/rosmsg2-serialization";

/** A function from bytes (a DataView) to an object; undefined if nobody knows the type. */
export function decoder({ encoding, schema, schemaName, schemaEncoding }) {
  if (encoding === "json") {
    const text = new TextDecoder();
    return (data) => JSON.parse(text.decode(data));
  }
  if (schemaEncoding === "omgidl") {
    const reader = new IdlReader(schemaName, parseIDL(schema));
    return (data) => reader.readMessage(data);
  }
  if (schemaEncoding === "ros2msg") {
    const reader = new RosReader(parseRos(schema, { ros2: true }));
    return (data) => reader.readMessage(data);
  }
  return undefined;
}
