// Prints a recording's messages as lines of JSON, read by @mcap/core and @foxglove/rosmsg2-serialization.
// usage: node read_mcap.mjs NODE_MODULES FILE
import { open } from "node:fs/promises";
import { createRequire } from "node:module";

const [packages, path] = process.argv.slice(2);
const require = createRequire(`${packages}/`);
const { McapIndexedReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const { decompress } = require("fzstd");

const file = await open(path);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, length) => {
    const bytes = new Uint8Array(Number(length));
    await file.read(bytes, 0, bytes.length, Number(offset));
    return bytes;
  },
};
const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };
const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
const readers = new Map();
for (const [id, schema] of reader.schemasById) {
  readers.set(id, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
}

function plain(key, value) {
  if (value instanceof Uint8Array) return Buffer.from(value).toString("base64");
  if (ArrayBuffer.isView(value)) return Array.from(value);
  return value;
}

const counts = { messages: Number(reader.statistics.messageCount), chunks: reader.chunkIndexes.length };
process.stdout.write(`${JSON.stringify({ profile: reader.header.profile, ...counts })}\n`);
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const type = reader.schemasById.get(channel.schemaId).name;
  const content = readers.get(channel.schemaId).readMessage(message.data);
  const line = { topic: channel.topic, type, time_ns: Number(message.logTime), message: content };
  process.stdout.write(`${JSON.stringify(line, plain)}\n`);
}
