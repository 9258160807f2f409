// SPDX-License-Identifier: Apache-2.0
// A recording of the made-up flight, in the shape of the station's: one channel a topic, omgidl.
import { McapWriter, TempBuffer } from "@mcap/core";

import { flatIdl } from "./flat_idl.mjs";
import { encode, samplesAt, schemaNameOf, typeOf } from "./synthetic.mjs";
import { pictureAt, videoAt } from "./synthetic_camera.mjs";

/** Bytes of an MCAP file; log times are begin_s + the flight's own time from 0 to seconds. */
export async function syntheticRecording({ begin_s, seconds, vehicles = ["uav1"],
  pictures = false, video = false }) {
  const buffer = new TempBuffer();
  const writer = new McapWriter({ writable: buffer, chunkSize: 200000 });
  await writer.start({ profile: "ros2", library: "test" });
  const channels = new Map();
  for (let step = 1; step <= 100 * seconds; step++)
    for (const [index, vehicle] of vehicles.entries())
      for (const [name, message] of [...samplesAt(step / 100, step, index),
        ...(pictures && step % 10 === 0 ? pictureAt(step / 100, index) : []),
        ...(video && step % 10 === 5 ? videoAt(step / 100, index, (step - 5) / 10) : [])]) {
        const topic = `/${vehicle}/${name}`;
        if (!channels.has(topic)) channels.set(topic, await register(writer, topic, typeOf(name)));
        const logTime = BigInt(Math.round((begin_s + step / 100) * 1e6)) * 1000n;
        await writer.addMessage({ channelId: channels.get(topic), sequence: step, logTime,
          publishTime: logTime, data: encode(typeOf(name), message) });
      }
  await writer.end();
  return buffer.get();
}

async function register(writer, topic, type) {
  const schemaId = await writer.registerSchema({ name: schemaNameOf(type), encoding: "omgidl",
    data: new TextEncoder().encode(flatIdl(type)) });
  return writer.registerChannel({ schemaId, topic, messageEncoding: "cdr", metadata: new Map() });
}
