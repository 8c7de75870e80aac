// Parts of Studio without a browser: annotations by ranges of a large file, masks, values of the form, camera footprints.
// usage: node modules_test.mjs PACKAGES
import assert from "node:assert/strict";
import { test } from "node:test";
import { importStudio } from "./bundle.mjs";
import { pixelsOf } from "./masks.mjs";

const [packages] = process.argv.slice(2);
const coco = await importStudio(packages, "dataset/coco.ts");
const rle = await importStudio(packages, "dataset/rle.ts");
const json = await importStudio(packages, "form/json.ts");
const schema = await importStudio(packages, "form/schema.ts");
const statistics = await importStudio(packages, "compare/statistics.ts");
const { differencesOf: differences } = await importStudio(packages, "compare/differences.ts");
const events = await importStudio(packages, "run/events.ts");
const exits = await importStudio(packages, "run/exit_states.ts");
const elements = await importStudio(packages, "blueprint/elements.ts");
const kinds = await importStudio(packages, "blueprint/kinds.ts");
const camera = await importStudio(packages, "calibration/camera.ts");
const names = await importStudio(packages, "blueprint/names.ts");
const scale = await importStudio(packages, "charts/scale.ts");
const running = await importStudio(packages, "study/running.ts");
const subjects = await importStudio(packages, "compare/subjects.ts");
const { footprint } = await importStudio(packages, "form/footprint.ts");

/** Numbers that look random and are the same in each run. */
function sequence(seed) {
  let state = seed;
  return (limit) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * limit);
  };
}

/** A file as throng writes it: ids count a camera's frames, lines are ordered by run, frame and camera. */
function annotationFile({ runs, cameras, frames, people, skippedRuns = [], seed = 1 }) {
  const next = sequence(seed);
  const images = [];
  const annotations = [];
  const tracks = [];
  for (let run = 0; run < runs; ++run) {
    if (skippedRuns.includes(run)) continue;
    const name = `run${String(run).padStart(3, "0")}`;
    for (let agent = 0; agent < people; ++agent) tracks.push({ id: run * 1000000 + agent * 3 + 1, run: name, group: null });
    for (let frame = 0; frame < frames; ++frame) {
      cameras.forEach((camera, index) => {
        const id = (run * cameras.length + index) * frames + frame + 1;
        const file = `images/${name}/${camera}/${String(frame).padStart(6, "0")}.jpg`;
        images.push({ id, file_name: file, width: 64, height: 36, run: name, camera_id: camera, frame, pad: "x".repeat(next(3000)) });
        const visible = next(people + 1);
        for (let agent = 0; agent < visible; ++agent) {
          annotations.push({
            id: id * 100000 + agent * 3 + 1,
            image_id: id,
            track_id: run * 1000000 + agent * 3 + 1,
            pad: "y".repeat(next(900)),
          });
        }
      });
    }
  }
  const lines = (list) => list.map((record) => JSON.stringify(record)).join(",\n");
  const text = `{"info":{"description":"test"},\n"licenses":[],\n"categories":[{"id":1}],\n"tracks":[\n${lines(tracks)}\n],\n"images":[\n${lines(images)}\n],\n"annotations":[\n${lines(annotations)}\n]}\n`;
  return { text, images, annotations, tracks };
}

/** The answer of GET /v1/jobs/{id}/images?limit=1. */
function listOf(images) {
  const runs = new Map();
  for (const { run, camera_id: camera, frame } of images) {
    const cameras = runs.get(run) ?? runs.set(run, new Map()).get(run);
    const known = cameras.get(camera) ?? { camera, images: 0, first: frame, last: frame };
    cameras.set(camera, { ...known, images: known.images + 1, last: frame });
  }
  return {
    images: images.slice(0, 1).map((image) => ({ path: image.file_name })),
    total: images.length,
    runs: [...runs].map(([run, cameras]) => ({ run, cameras: [...cameras.values()].sort((a, b) => (a.camera < b.camera ? -1 : 1)) })),
  };
}

/** A service with one dataset; counts the bytes that it sends. */
function serve(file) {
  const bytes = Buffer.from(file.text);
  const sent = { bytes: 0 };
  globalThis.fetch = async (address, { headers }) => {
    if (address.includes("/images?")) return new Response(JSON.stringify(listOf(file.images)));
    assert.equal(address, "/v1/jobs/job/files/annotations/instances.json");
    const [, first, last] = /^bytes=(\d+)-(\d+)$/.exec(new Headers(headers).get("Range"));
    const part = bytes.subarray(Number(first), Number(last) + 1);
    sent.bytes += part.length;
    return new Response(part, { status: 206, headers: { "Content-Range": `bytes ${first}-${last}/${bytes.length}` } });
  };
  return sent;
}

const kLayouts = [
  { runs: 1, cameras: ["d1"], frames: 1, people: 3 },
  { runs: 3, cameras: ["d1"], frames: 40, people: 40 },
  // Not in the order of their names: the job's order decides.
  { runs: 2, cameras: ["view", "a", "d2"], frames: 60, people: 60 },
  { runs: 4, cameras: ["d1", "d2"], frames: 30, people: 50, skippedRuns: [1] },
  { runs: 1, cameras: ["d1", "d2"], frames: 5, people: 1 },
];

for (const layout of kLayouts) {
  test(`labels by ranges: ${JSON.stringify(layout)}`, async () => {
    const file = annotationFile(layout);
    serve(file);
    const dataset = await coco.Dataset.open("job");
    for (const record of file.images) {
      const name = dataset.imageAt(record.run, record.camera_id, record.frame);
      assert.deepEqual(name, coco.imageOf(record.file_name));
      const { image, annotations } = await dataset.labelsOf(name);
      assert.equal(image.file_name, name.path);
      assert.deepEqual(
        annotations,
        file.annotations.filter((entry) => entry.image_id === image.id),
      );
    }
    for (const track of file.tracks) assert.deepEqual(await dataset.trackOf(track.id), track);
    assert.equal(await dataset.trackOf(2), null);
  });
}

test("one image of a large file needs a small part of it", async () => {
  const file = annotationFile({ runs: 4, cameras: ["d1", "d2"], frames: 600, people: 60, seed: 7 });
  const sent = serve(file);
  const dataset = await coco.Dataset.open("job");
  const name = coco.imageOf("images/run002/d2/000123.jpg");
  const { image, annotations } = await dataset.labelsOf(name);
  assert.deepEqual(
    annotations,
    file.annotations.filter((entry) => entry.image_id === image.id),
  );
  assert.ok(file.text.length > 50e6);
  console.log(`# ${sent.bytes} of ${file.text.length} bytes`);
  assert.ok(sent.bytes < 8e6, `${sent.bytes} of ${file.text.length} bytes`);
});

test("neighbors are the next frames and cameras", async () => {
  serve(annotationFile({ runs: 2, cameras: ["b", "a"], frames: 3, people: 2, skippedRuns: [0] }));
  const dataset = await coco.Dataset.open("job");
  const image = dataset.imageAt("run001", "b", 2);
  assert.equal(dataset.neighbor(image, -1, 0).path, "images/run001/b/000001.jpg");
  assert.equal(dataset.neighbor(image, 0, -1).path, "images/run001/a/000002.jpg");
  assert.equal(dataset.neighbor(image, 1, 0), null);
  assert.equal(dataset.neighbor(image, 0, 1), null);
  assert.equal(dataset.imageAt("run000", "a", 0), null);
  assert.equal(coco.imageOf("images/../job.json"), null);
});

test("an image that the annotations lack is reported", async () => {
  const file = annotationFile({ runs: 1, cameras: ["d1"], frames: 3, people: 4 });
  serve(file);
  const dataset = await coco.Dataset.open("job");
  await assert.rejects(dataset.labelsOf(coco.imageOf("images/run000/d1/000007.jpg")), /do not hold/);
});

/** docs/formats.md, "counts": groups of five bits, lowest first. */
function encoded(runs) {
  let text = "";
  runs.forEach((run, index) => {
    let value = index > 2 ? run - runs[index - 2] : run;
    for (;;) {
      const bits = value & 31;
      value >>= 5;
      const isLast = (value === 0 && !(bits & 16)) || (value === -1 && bits & 16);
      text += String.fromCharCode(48 + (isLast ? bits : bits | 32));
      if (isLast) break;
    }
  });
  return text;
}

test("masks are read as they are written", () => {
  const next = sequence(5);
  for (let round = 0; round < 50; ++round) {
    const size = [1 + next(70), 1 + next(90)];
    const runs = [];
    for (let left = size[0] * size[1]; left > 0; ) {
      const run = Math.min(left, next(3) === 0 ? next(2000) + 1 : next(40) + 1);
      runs.push(run);
      left -= run;
    }
    for (const mask of [
      { size, counts: encoded(runs) },
      { size, counts: runs },
    ]) {
      const pixels = new Set();
      rle.forEachRun(mask, (x, y, length) => {
        for (let i = 0; i < length; ++i) pixels.add((y + i) * size[1] + x);
      });
      assert.deepEqual([...pixels].sort(), [...pixelsOf({ size, counts: encoded(runs) })].sort());
    }
  }
});

test("values of the form are set and removed", () => {
  const job = { scenario: "a", drones: [{ id: "d1" }, { id: "d2", camera: { width: 64 } }] };
  assert.deepEqual(json.withValue(job, ["drones", 1, "camera", "width"], undefined).drones[1], { id: "d2" });
  assert.deepEqual(json.withValue(job, ["drones", 0], undefined).drones, [job.drones[1]]);
  assert.deepEqual(json.withValue(job, ["crowd", "agents"], 5).crowd, { agents: 5 });
  assert.equal(job.crowd, undefined);
  assert.equal(json.pointerOf(["a/b", "c~d", 3]), "/a~1b/c~0d/3");
});

test("a copied job keeps what differs from the defaults", () => {
  const part = { type: "object", default: {}, properties: { width: { default: 1280 }, height: { default: 720 } } };
  const description = {
    properties: {
      scenario: {},
      runs: { default: 1 },
      camera: part,
      drones: { items: { required: ["id"], properties: { id: { default: "x" }, camera: part } } },
    },
    required: ["scenario"],
  };
  const job = { scenario: "a", runs: 1, camera: { width: 1280, height: 720 }, drones: [{ id: "x", camera: { width: 640, height: 720 } }] };
  assert.deepEqual(schema.withoutDefaults(job, description), { scenario: "a", drones: [{ id: "x", camera: { width: 640 } }] });
});

test("footprints are those of a pinhole camera", () => {
  // Straight down from 10 m with a square image of 90 degrees: 20 m × 20 m; the top of the image is ahead.
  const down = footprint({ x: 1, y: 2, height: 10, yawDeg: 0, pitchDeg: -90, hfovDeg: 90, aspect: 1 });
  const expected = [
    [11, 12],
    [11, -8],
    [-9, -8],
    [-9, 12],
  ];
  down.forEach(([x, y], index) => assert.ok(Math.hypot(x - expected[index][0], y - expected[index][1]) < 1e-9));
  // Along the heading the edges of the image are at the pitch plus and minus half the vertical angle.
  const ahead = footprint({ x: 0, y: 0, height: 10, yawDeg: 90, pitchDeg: -45, hfovDeg: 60, aspect: 2 });
  const half = Math.atan(Math.tan(Math.PI / 6) / 2);
  assert.ok(Math.abs(ahead[0][1] - 10 / Math.tan(Math.PI / 4 - half)) < 1e-9);
  assert.ok(Math.abs(ahead[3][1] - 10 / Math.tan(Math.PI / 4 + half)) < 1e-9);
  assert.ok(ahead[0][0] < 0 && ahead[1][0] > 0);
  // Rays to the sky end somewhere.
  for (const point of footprint({ x: 0, y: 0, height: 10, yawDeg: 30, pitchDeg: 0, hfovDeg: 90, aspect: 1.5 })) {
    assert.ok(point.every(Number.isFinite) && Math.hypot(...point) < 200);
  }
});

test("states of exits last until the next frame", () => {
  const rows = [
    [0, "a", "idle"],
    [0, "b", "closed"],
    [2, "a", "flowing"],
    [2, "b", "closed"],
    [4, "a", "flowing"],
    [4, "b", "idle"],
  ];
  const csv = `frame,time_s,exit,queue,state\n${rows.map(([time, exit, state]) => `0,${time},${exit},3,${state}`).join("\n")}\n`;
  const histories = exits.historiesOf(csv, 6);
  assert.deepEqual(histories, [
    {
      id: "a",
      spans: [
        { from_s: 0, to_s: 2, state: "idle" },
        { from_s: 2, to_s: 6, state: "flowing" },
      ],
    },
    {
      id: "b",
      spans: [
        { from_s: 0, to_s: 4, state: "closed" },
        { from_s: 4, to_s: 6, state: "idle" },
      ],
    },
  ]);
  assert.equal(exits.stateAt(histories[1], 3.9), "closed");
  assert.equal(exits.stateAt(histories[1], 6), "idle");
  assert.deepEqual(exits.historiesOf("frame,time_s,exit,state\n", 6), []);
});

test("intervals are those of Student's distribution", () => {
  // Tables of the two-sided 95 % quantile.
  const table = {
    1: 12.7062,
    2: 4.30265,
    3: 3.18245,
    4: 2.77645,
    9: 2.26216,
    10: 2.22814,
    29: 2.04523,
    30: 2.04227,
    99: 1.98422,
    999: 1.96234,
  };
  for (const [degrees, expected] of Object.entries(table)) {
    assert.ok(
      Math.abs(statistics.studentQuantile(Number(degrees)) - expected) < 1e-4 * expected,
      `${degrees}: ${statistics.studentQuantile(Number(degrees))}`,
    );
  }
  const { count, mean, margin } = statistics.summaryOf([4, 7, 13, 16]);
  assert.deepEqual([count, mean], [4, 10]);
  assert.ok(Math.abs(margin - 3.18245 * Math.sqrt(30 / 4)) < 1e-3);
  assert.deepEqual(statistics.summaryOf([3]), { count: 1, mean: 3, margin: null });
});

test("bands keep the last value of runs that end earlier", () => {
  assert.equal(statistics.quantileOf([5, 1, 3, 2], 0.5), 2.5);
  assert.equal(statistics.quantileOf([7], 0.25), 7);
  const band = statistics.bandOf([
    [0, 1],
    [0, 0, 0.5],
    [0, 0.5, 0.5],
  ]);
  assert.deepEqual(band.median, [0, 0.5, 0.5]);
  assert.deepEqual(band.low, [0, 0.25, 0.5]);
  assert.deepEqual(band.high, [0, 0.75, 0.75]);
  assert.deepEqual(statistics.bandOf([]), { median: [], low: [], high: [] });
});

test("jobs differ in the smallest parts that differ", () => {
  const a = { name: "a", seed: 1, drones: [{ id: "d1", start: [1, 2, 3] }], outputs: { annotations: ["coco"] }, same: { x: [1] } };
  const b = {
    name: "b",
    seed: 1,
    drones: [{ id: "d1", start: [1, 2, 4] }],
    outputs: { annotations: ["coco", "exits"], previews: 2 },
    same: { x: [1] },
  };
  assert.deepEqual(differences([a, b]), [
    {
      pointer: "/drones/0/start",
      values: [
        [1, 2, 3],
        [1, 2, 4],
      ],
    },
    { pointer: "/outputs/annotations", values: [["coco"], ["coco", "exits"]] },
    { pointer: "/outputs/previews", values: [undefined, 2] },
  ]);
  assert.deepEqual(differences([a, { ...a, name: "c" }]), []);
  // Lists of different length are one value.
  assert.deepEqual(
    differences([{ drones: [{ id: "x" }] }, { drones: [{ id: "x" }, { id: "y" }] }]).map((entry) => entry.pointer),
    ["/drones"],
  );
  assert.deepEqual(differences([{ seed: 1 }, { seed: 1 }, { seed: 3 }]), [{ pointer: "/seed", values: [1, 1, 3] }]);
});

test("events of a run come in order, each with its kind", () => {
  const drone = { id: "d1", falling_s: 12.5, landed_s: null, battery_flat_s: null, collisions: { person: 2, building: 1 } };
  const metrics = {
    alarm_s: 8,
    by_person: { agent: [4, 17], hurt_s: [null, 13] },
    drones: [drone, { ...drone, id: "d2", falling_s: null, collisions: {} }],
    exits: [
      {
        id: "gate",
        clogs: [
          { from_s: 9, until_s: 11, ended: true },
          { from_s: 30, until_s: 40, ended: false },
        ],
      },
      { id: "door", clogs: [] },
    ],
  };
  assert.deepEqual(
    events.eventsOf(metrics).map(({ time_s, kind, text }) => [time_s, kind, text]),
    [
      [8, "alarm", "alarm"],
      [9, "clog", "clog at gate, until 11.0 s"],
      [12.5, "drone", "drone d1 falls"],
      [13, "hurt", "person 17 is hurt"],
      [30, "clog", "clog at gate, not ended"],
    ],
  );
  assert.equal(events.collisionText(metrics), "d1 with person 2×, d1 with building 1×");
  assert.deepEqual(events.eventsOf({ alarm_s: null }), []);
  assert.equal(events.collisionText({ alarm_s: null }), null);
});

const kArea = (points) =>
  points.reduce((sum, [x, y], i) => sum + (x * points[(i + 1) % points.length][1] - points[(i + 1) % points.length][0] * y) / 2, 0);

test("elements of a blueprint are added, moved and reshaped; outlines stay counter-clockwise", () => {
  const { added, elementAt, elementsOf, moved, removed, withCorner, withNewCorner, withoutCorner } = elements;
  const first = kinds.kFirstBlueprint;
  assert.equal(elementsOf(first).length, 11);
  const kind = (name) => kinds.kindNamed(name);
  const drawn = added(first, kind("building"), [5, 5], [1, 2]);
  assert.deepEqual(drawn.path, ["buildings", 6]);
  const at = (document, pointer) => elementAt(elementsOf(document), pointer);
  assert.deepEqual(drawn.document.buildings[6].box, [1, 2, 5, 5]);
  assert.equal(first.buildings.length, 6, "the first blueprint is as it was");
  // A wall's outline has its length and thickness, whatever its direction.
  for (const end of [
    [10, 0],
    [0, 10],
    [-10, 0],
    [0, -10],
    [6, 8],
  ]) {
    const wall = added(first, kind("building"), [0, 0], end, true).document.buildings[6];
    assert.ok(Math.abs(kArea(wall.footprint) - 4) < 0.02, String(end));
  }
  const building = at(drawn.document, "/buildings/6/height_m");
  assert.equal(building.pointer, "/buildings/6");
  assert.deepEqual(moved(drawn.document, building, [0.5, -1]).buildings[6].box, [1.5, 1, 5.5, 4]);
  assert.deepEqual(withCorner(drawn.document, building, 0, [0, 1]).buildings[6].box, [0, 1, 5, 5]);
  assert.deepEqual(withCorner(drawn.document, building, 0, [7, 9]).buildings[6].box, [5, 5, 7, 9], "pulled over the opposite corner");
  assert.equal(withCorner(drawn.document, building, 0, [5, 0]), drawn.document, "no box without a width");
  const split = withNewCorner(drawn.document, building, 0);
  assert.deepEqual(split.buildings[6].footprint, [
    [1, 2],
    [3, 2],
    [5, 2],
    [5, 5],
    [1, 5],
  ]);
  const pentagon = at(split, "/buildings/6");
  const turned = withCorner(split, pentagon, 1, [3, 20]);
  assert.ok(kArea(turned.buildings[6].footprint) > 0);
  assert.equal(withoutCorner(split, pentagon, 1).buildings[6].footprint.length, 4);
  const drone = at(first, "/drones/0/start");
  assert.deepEqual(moved(first, drone, [1, 2]).drones[0].start, [1, -6, 25], "its height stays");
  assert.equal(removed(first, at(first, "/exits/0")).exits.length, 1);
  assert.equal(at(first, "/exits"), undefined);
  assert.equal(added(added(first, kind("exit"), [0, 0], [1, 0]).document, kind("exit"), [0, 0], [1, 0]).document.exits[3].id, "exit2");
});

test("a calibration's cells, digits and residuals", () => {
  const view = (points) => ({
    width: 80,
    height: 60,
    views: [{ image: "a", points: points.map(([u, v, used = true]) => ({ pixel: [u, v], residual_px: null, used })) }],
  });
  const cells = camera.coveredCells(
    view([
      [-0.5, -0.5],
      [9.4, 0],
      [9.5, 0],
      [79.4, 59.4],
      [40, 30, false],
      [-3, 0],
    ]),
  );
  assert.deepEqual(
    cells.flatMap((is, index) => (is ? [index] : [])),
    [0, 1, 47],
  );
  assert.deepEqual(camera.valueText({ name: "fx", value: 900.123456, deviation: 0.0234 }), ["900.123", "± 0.023"]);
  assert.deepEqual(camera.valueText({ name: "fx", value: 900.123456, deviation: 23.4 }), ["900", "± 23"]);
  assert.deepEqual(camera.valueText({ name: "k3", value: 0, deviation: null }), ["0", "open"]);
  assert.deepEqual(camera.valueText({ name: "k3", value: 0.5, deviation: 0 }), ["0.5", "fixed"]);
  assert.equal(camera.residualScale({ width: 1280, rms_px: 0.13 }), 200);
  assert.equal(camera.residualScale({ width: 1280, rms_px: 100 }), 1);
});

test("a running mean is the mean of the first values, with the interval of Student's t", () => {
  const values = [3, 5, null, 4, 12, 6.5];
  const known = values.filter((value) => value !== null);
  const means = running.runningMeans(values);
  assert.equal(means.length, known.length);
  means.forEach(({ count, mean, margin }, index) => {
    const { mean: expected, margin: half } = statistics.summaryOf(known.slice(0, index + 1));
    assert.equal(count, index + 1);
    assert.ok(Math.abs(mean - expected) < 1e-12);
    assert.ok(half === null ? margin === null : Math.abs(margin - half) < 1e-9);
  });
  assert.deepEqual(running.differencesOf([3, null, 5], [1, 2, null]), [2, null, null]);
});

test("names that would cover another one are left out, but for the selected element's", () => {
  const document = {
    buildings: [
      { id: "left", box: [0, 0, 1, 1] },
      { id: "right", box: [2, 0, 3, 1] },
    ],
  };
  const list = elements.elementsOf(document);
  const shown = (selected, unit) => [...names.placedNames(list, selected, unit).values()].map((name) => name.text).sort();
  assert.deepEqual(shown(null, 0.1), ["left", "right"]);
  assert.deepEqual(shown(null, 1), ["left"]);
  assert.deepEqual(shown(list[1], 1), ["right"]);
});

test("an address names jobs and single runs to compare", () => {
  const choices = subjects.choicesOf(new URLSearchParams("job=ja1&job=ja1:2&job=ja1&job=../x&job=jb:99999&job=jb:0"));
  assert.deepEqual(choices, [
    { id: "ja1", run: null },
    { id: "ja1", run: 2 },
    { id: "jb", run: 0 },
  ]);
  assert.equal(subjects.addressOf(choices, 1.25), "/compare?job=ja1&job=ja1:2&job=jb:0&t=1.3");
});

test("messages of a live flight are read however they arrive", async () => {
  const { messagesOf } = await importStudio(packages, "live/messages.ts");
  const framed = (type, body) => {
    const head = Buffer.alloc(5);
    head.write(type, "latin1");
    head.writeUInt32LE(body.length, 1);
    return Buffer.concat([head, body]);
  };
  const state = Buffer.alloc(24 + 44 + 2 * 12);
  state.writeUInt8(2, 0);
  state.writeUInt8(1, 1);
  state.writeUInt16LE(1, 2);
  state.writeUInt32LE(2, 4);
  state.writeDoubleLE(12.5, 8);
  state.writeFloatLE(0.5, 16);
  state.writeUInt32LE(9, 20);
  [1, 2, 30, Math.SQRT1_2, 0, 0, Math.SQRT1_2, 4].forEach((value, index) => state.writeFloatLE(value, 24 + 4 * index));
  state.writeUInt32LE(1 | 4, 24 + 32);
  state.writeFloatLE(-45, 24 + 36);
  state.writeFloatLE(20, 24 + 40);
  [
    [3, -4, 15708, 2, 1],
    [5, 6, -1, 0, 5],
  ].forEach(([x, y, yaw, kind, flags], index) => {
    const at = 68 + 12 * index;
    state.writeFloatLE(x, at);
    state.writeFloatLE(y, at + 4);
    state.writeInt16LE(yaw, at + 8);
    state.writeUInt8(kind, at + 10);
    state.writeUInt8(flags, at + 11);
  });
  const image = Buffer.alloc(16 + 3);
  image.writeDoubleLE(12.4, 0);
  image.writeUInt32LE(8, 8);
  image.writeUInt32LE(1, 12);
  image.write("jpg", 16);
  const bytes = Buffer.concat([
    framed("H", Buffer.from('{"people":2}')),
    framed("A", Buffer.alloc(0)),
    framed("S", state),
    framed("P", image),
    framed("E", Buffer.from('{"message":"it is over"}')),
  ]);
  for (const part of [1, 17, bytes.length]) {
    const body = new ReadableStream({
      start(controller) {
        for (let at = 0; at < bytes.length; at += part) controller.enqueue(new Uint8Array(bytes.subarray(at, at + part)));
        controller.close();
      },
    });
    const messages = [];
    for await (const message of messagesOf(body)) messages.push(message);
    assert.deepEqual(
      messages.map(({ type }) => type),
      ["hello", "world", "image", "end"],
    );
    const { value } = messages[1];
    assert.deepEqual([value.timeS, value.factor, value.sequence, value.isPaused], [12.5, 0.5, 9, true]);
    assert.deepEqual(value.drones[0].position, [1, 2, 30]);
    assert.ok(Math.abs(value.drones[0].yaw - Math.PI / 2) < 1e-6);
    assert.deepEqual([value.drones[0].hasBeacon, value.drones[0].isOnMission, value.drones[0].isRunning], [true, false, true]);
    assert.deepEqual(value.drones[0].gimbalDeg, [-45, 20]);
    assert.deepEqual([...value.people.y], [-4, 6]);
    assert.ok(Math.abs(value.people.yaw[0] - 1.5708) < 1e-6);
    assert.deepEqual([...value.people.flags], [1, 5]);
    assert.equal(await messages[2].value.jpeg.text(), "jpg");
    assert.equal(messages[3].error, "it is over");
  }
});

test("an axis has round ticks around its values, with zero only where it is asked for", () => {
  const values = [30.7, 38.2, 48.9];
  assert.deepEqual(scale.scaleOf(values, 5, false), { low: 30, high: 50, ticks: [30, 35, 40, 45, 50] });
  assert.deepEqual(scale.scaleOf(values).ticks, [0, 10, 20, 30, 40, 50]);
  assert.deepEqual(scale.scaleOf([-3, 8]).ticks, [-5, 0, 5, 10]);
  const { low, high } = scale.scaleOf([7, 7], 5, false);
  assert.ok(low <= 7 && high > low && high >= 7);
});

test("people of a flight walk as far as they have gone, and lie where they have fallen", async () => {
  const { Walkers } = await importStudio(packages, "live/walkers.ts");
  const worldOf = (timeS, x, flags) => ({
    timeS,
    people: {
      x: Float32Array.from(x),
      y: new Float32Array(3),
      yaw: Float32Array.from([3.1, 0, 0]),
      state: new Uint8Array(3),
      flags: Uint8Array.from(flags),
    },
  });
  const walkers = new Walkers({ people: 3, roles: [0, 0, 2] });
  const [before, now] = [worldOf(0, [0, 5, 0], [1, 1, 1]), worldOf(0.1, [0.14, 5, 0], [1, 1 | 4, 1])];
  now.people.yaw[0] = -3.1;
  walkers.step(before, now, 0, 0);
  const [near, far] = walkers.group.children;
  const { aFrom, aTo, aLook } = near.geometry.attributes;
  assert.deepEqual([near.geometry.instanceCount, far.geometry.instanceCount], [2, 0], "absent people are not shown");
  const close = (value, expected) => assert.ok(Math.abs(value - expected) < 1e-5, `${value} is not ${expected}`);
  close(aTo.getW(0) - aFrom.getW(0), (2 * Math.PI * 0.14) / 1.4);
  close(aTo.getZ(0) - aFrom.getZ(0), 2 * (Math.PI - 3.1)); // the short way around
  close(aLook.getW(0), 1);
  close(aTo.getW(1) - aFrom.getW(1), 0);
  close(aLook.getW(1), -1);
  // Only people next to the drone have legs if there are thousands.
  const many = {
    timeS: 0,
    people: {
      x: Float32Array.from({ length: 2000 }, (_, i) => i / 100),
      y: new Float32Array(2000),
      yaw: new Float32Array(2000),
      state: new Uint8Array(2000),
      flags: new Uint8Array(2000).fill(1),
    },
  };
  const crowd = new Walkers({ people: 2000, roles: Array(2000).fill(0) });
  for (let step = 0; step < 20; ++step) crowd.step(many, many, 0, 0);
  const counts = crowd.group.children.map((mesh) => mesh.geometry.instanceCount);
  assert.ok(counts[0] > 200 && counts[0] < 400 && counts[0] + counts[1] === 2000, `${counts}`);
  walkers.step(now, worldOf(0.2, [0.28, 5, 0], [1, 5, 1]), 0, 0);
  close(aFrom.getW(0), (2 * Math.PI * 0.14) / 1.4);
});

test("smoke rises where dangers are, as far as they reach", async () => {
  const { Smoke, reachOf } = await importStudio(packages, "live/smoke.ts");
  const fire = { kind: "fire", position: [3, 4], start_s: 10, radius_m: 1, growth_mps: 0.5, max_radius_m: 4 };
  assert.deepEqual(
    [9, 10, 12, 100].map((time) => reachOf(fire, time)),
    [0, 1, 2, 4],
  );
  const smoke = new Smoke({ smoke: 0.5, dangers: [fire, { ...fire, kind: "gas" }] });
  smoke.frame(9);
  assert.deepEqual(
    smoke.group.children.map((mesh) => mesh.visible),
    [false, false],
  );
  smoke.frame(12);
  const [flaming, gas] = smoke.group.children;
  assert.ok(flaming.visible && flaming.material.uniforms.uReach.value === 2 && flaming.material.uniforms.uStrength.value === 0.5);
  assert.ok(flaming.geometry.instanceCount > gas.geometry.instanceCount, "a fire has flames");
  assert.equal(new Smoke({ smoke: 0, dangers: [fire] }).group.children.length, 0);
});

test("positions of a run are read from their bytes", async () => {
  const { readPositions, unseenAt } = await importStudio(packages, "run/trajectories.ts");
  const bytes = new DataView(new ArrayBuffer(24 + 8 + 3 + 3 * 6));
  [
    [0, 1],
    [4, 1],
    [8, 3],
  ].forEach(([at, value]) => bytes.setUint32(at, value, true));
  [
    [12, -10],
    [16, 5],
    [20, 0.5],
  ].forEach(([at, value]) => bytes.setFloat32(at, value, true));
  [0, 1, 3].forEach((role, agent) => bytes.setUint8(32 + agent, role));
  [
    [4, 2],
    [1, 1],
    [65535, 65535],
  ].forEach(([x, y], agent) => [x, y].forEach((value, axis) => bytes.setUint16(35 + 6 * agent + 2 * axis, value, true)));
  const positions = readPositions(bytes.buffer);
  assert.deepEqual(unseenAt(positions, 0, 2, new Set()), [[-8, 6]], "neither hazards nor absent people");
  assert.deepEqual(unseenAt(positions, 0, 2, new Set([2000001])), []);
  assert.deepEqual(unseenAt(positions, 1, 2, new Set()), []);
});

test("a copy of a case has an id of its own, and crowds and drones are as in a job", async () => {
  const { freeId, withCopy } = await importStudio(packages, "study/study_form.tsx");
  const { withJobParts, withoutFields } = await importStudio(packages, "study/study_schema.ts");
  assert.equal(freeId("case_1", ["case_1", "case_2"]), "case_3");
  assert.deepEqual(withCopy([{ id: "a" }, { id: "b", runs: 1 }], 1), [{ id: "a" }, { id: "b", runs: 1 }, { id: "b_2", runs: 1 }]);
  const study = {
    properties: { cases: { items: { properties: { crowd: { $ref: "#/definitions/crowd" } } } } },
    definitions: { crowd: { description: "As in a job." } },
  };
  const crowd = { title: "Crowd", properties: { agents: {}, model: {} } };
  const merged = withJobParts(study, { properties: { crowd } });
  assert.deepEqual(merged.properties.cases.items.properties.crowd, crowd);
  assert.deepEqual(Object.keys(withoutFields(crowd, [["agents"]]).properties), ["model"]);
});
