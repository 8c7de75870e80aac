// A client of Foxglove's WebSocket protocol for tests: does what lines of JSON on stdin say, and prints what happens.
// usage: node foxglove_client.mjs NODE_MODULES URL
import { createRequire } from "node:module";
import { createInterface } from "node:readline";

const [packages, url] = process.argv.slice(2);
const require = createRequire(`${packages}/`);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { WebSocket } = require("ws");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader, MessageWriter } = require("@foxglove/rosmsg2-serialization");

function plain(_key, value) {
  if (value instanceof Uint8Array) {
    return { bytes: value.length, head: Buffer.from(value.subarray(0, 3)).toString("hex") };
  }
  if (ArrayBuffer.isView(value)) return Array.from(value);
  return typeof value === "bigint" ? Number(value) : value;
}

function print(event, fields) {
  process.stdout.write(`${JSON.stringify({ event, ...fields }, plain)}\n`);
}

const socket = new WebSocket(url, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
const client = new FoxgloveClient({ ws: socket });
const channels = new Map(); // by topic
const services = new Map(); // by name
const subscriptions = new Map(); // topic and reader by id
const advertised = new Map(); // ids by topic, encoding and schema

client.on("error", (error) => print("error", { message: String(error) }));
client.on("close", () => {
  print("close", {});
  process.exit(0);
});
client.on("serverInfo", (info) => print("serverInfo", { info }));
client.on("status", ({ level, message }) => print("status", { level, message }));
client.on("time", ({ timestamp }) => print("time", { time_ns: timestamp }));
client.on("advertise", (list) => {
  for (const channel of list) channels.set(channel.topic, channel);
  print("advertise", { topics: Object.fromEntries(list.map((each) => [each.topic, each.schemaName])) });
});
client.on("advertiseServices", (list) => {
  for (const service of list) services.set(service.name, service);
  print("advertiseServices", { services: list.map((each) => each.name) });
});
client.on("parameterValues", ({ parameters, id }) => {
  print("parameterValues", { id, values: Object.fromEntries(parameters.map((each) => [each.name, each.value])) });
});
client.on("message", ({ subscriptionId, timestamp, data }) => {
  const { topic, reader } = subscriptions.get(subscriptionId);
  print("message", { topic, time_ns: timestamp, message: reader.readMessage(data) });
});
client.on("serviceCallResponse", ({ callId, encoding, data }) => {
  print("answer", { id: callId, encoding, answer: JSON.parse(new TextDecoder().decode(data)) });
});
client.on("serviceCallFailure", ({ callId, message }) => print("failure", { id: callId, message }));

function encode({ encoding, schema, definition, message, text }) {
  if (text !== undefined) return Buffer.from(text, "latin1");
  if (encoding === "cdr") return new MessageWriter(parse(definition, { ros2: true })).writeMessage(message);
  return Buffer.from(JSON.stringify(message));
}

const actions = {
  subscribe({ topics }) {
    for (const topic of topics) {
      const channel = channels.get(topic);
      const reader = new MessageReader(parse(channel.schema, { ros2: true }));
      subscriptions.set(client.subscribe(channel.id), { topic, reader });
    }
  },
  unsubscribe({ topics }) {
    for (const [id, { topic }] of subscriptions) {
      if (topics.includes(topic)) client.unsubscribe(id);
    }
  },
  publish(given) {
    const { topic, encoding = "json", schema = "" } = given;
    const key = `${topic} ${encoding} ${schema}`;
    if (!advertised.has(key)) advertised.set(key, client.advertise({ topic, encoding, schemaName: schema }));
    client.sendMessage(advertised.get(key), encode({ ...given, encoding }));
  },
  get({ names, id }) {
    client.getParameters(names, id);
  },
  set({ parameters, id }) {
    client.setParameters(
      Object.entries(parameters).map(([name, value]) => ({ name, value })),
      id,
    );
  },
  watch({ names }) {
    client.subscribeParameterUpdates(names);
  },
  call({ service, id, request, encoding = "json", text }) {
    const bytes = new TextEncoder().encode(text ?? JSON.stringify(request));
    const data = new DataView(bytes.buffer);
    client.sendServiceCallRequest({ serviceId: services.get(service)?.id ?? 99, callId: id, encoding, data });
  },
  send({ text, hex }) {
    socket.send(text ?? Buffer.from(hex, "hex"));
  },
  rest() {
    socket._socket.pause();
    print("rests", {});
  },
  resume() {
    socket._socket.resume();
  },
  close() {
    client.close();
  },
};

createInterface({ input: process.stdin }).on("line", (line) => {
  const action = JSON.parse(line);
  actions[action.do](action);
});
