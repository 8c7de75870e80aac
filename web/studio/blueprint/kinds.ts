// The kinds of elements that a blueprint has (docs/blueprint.md), and what each one holds.
import type { Json, JsonObject } from "../form/json";

export type Point = [number, number]; ///< m, x to the east, y to the north

export interface FieldSpec {
  key: string; ///< of its member; "a/b" of a member of a member
  label: string;
  type: "text" | "number" | "choice" | "check" | "exit";
  unit?: string;
  choices?: string[];
  usual?: string; ///< shown where nothing is said
  isRequired?: boolean;
}

export interface Kind {
  name: string;
  label: string;
  key: string; ///< that draws one in the plan
  list: readonly string[]; ///< where the blueprint has them
  shape: "polygon" | "segment" | "point";
  outline?: string; ///< of a polygon: its member; a "box" is one as well
  place?: string; ///< of a point: its member
  idPrefix?: string; ///< of what needs an id
  fields: FieldSpec[];
  members: JsonObject; ///< of a new one, beside its geometry
}

const kDoing: FieldSpec = {
  key: "doing",
  label: "Doing",
  type: "choice",
  choices: ["stroll", "wait", "cross", "leave", "watch"],
  isRequired: true,
};
const number = (key: string, label: string, unit = "", usual = ""): FieldSpec => ({ key, label, type: "number", unit, usual });
const kId: FieldSpec = { key: "id", label: "Id", type: "text", isRequired: true };
const kFacades = [
  "plaster",
  "brick",
  "historic",
  "modern",
  "concrete",
  "warehouse",
  "glass",
  "blank",
  "hedge",
  "screen",
  "railing",
  "fence",
];
const kRoofKinds = ["flat", "gabled", "hipped", "half_hipped", "mansard", "shed", "sawtooth", "pyramid", "dome"];
const kCoverings = ["gravel", "tiles", "slate", "metal", "grass", "felt"];
const kPropKinds = [
  "tree",
  "bench",
  "lamp_post",
  "bin",
  "car",
  "bollard",
  "stall",
  "barrier",
  "fence",
  "kiosk",
  "tent",
  "stage",
  "train",
  "fountain",
  "bush",
  "planter",
  "van",
  "delivery_truck",
  "food_truck",
  "bus",
  "moped",
  "motorcycle",
  "bicycle",
  "bicycle_rack",
  "cargo_bike",
  "traffic_sign",
  "traffic_light",
  "street_sign",
  "parking_meter",
  "post_box",
  "hydrant",
  "newspaper_box",
  "advertising_column",
  "bus_stop",
  "cabinet",
  "phone_booth",
  "vending_machine",
  "wheelie_bin",
  "wheelie_bins",
  "recycling_container",
  "skip",
  "garbage_bags",
  "cafe_table",
  "beer_table",
  "picnic_table",
  "a_board",
  "flower_pots",
  "wall_box",
  "info_board",
  "swing",
  "slide",
  "spring_rider",
  "sandbox",
  "statue",
  "flagpole",
  "drinking_fountain",
  "scaffold",
  "construction_fence",
  "cone",
  "portable_toilet",
  "crates",
  "pallet",
  "cardboard",
  "market_goods",
  "flower_stand",
  "clothes_rack",
  "kick_scooter",
  "charging_station",
  "main_stage",
  "line_array",
  "led_screen",
  "mixing_tower",
  "delay_tower",
  "crowd_barrier",
  "camera_crane",
  "drink_stand",
  "beach_flag",
  "goal",
  "team_bench",
  "advertising_board",
  "turnstile",
  "queue_rail",
  "vendor_cart",
  "floodlight_mast",
  "train_cab",
  "catenary_mast",
  "platform_canopy",
  "departure_board",
  "station_clock",
  "name_board",
  "ticket_machine",
  "luggage",
  "taxi",
  "platform_shelter",
  "rowboat",
  "barge",
  "pontoon",
];
const kPropFields: FieldSpec[] = [
  { key: "kind", label: "Kind", type: "choice", choices: kPropKinds, isRequired: true },
  number("yaw_deg", "Heading", "deg", "0"),
  number("scale", "Scale", "", "1"),
];

export const kKinds: Kind[] = [
  {
    name: "building",
    label: "Building",
    key: "b",
    list: ["buildings"],
    shape: "polygon",
    outline: "footprint",
    idPrefix: "building",
    fields: [
      kId,
      { ...number("height_m", "Height", "m"), isRequired: true },
      { key: "facade", label: "Facade", type: "choice", choices: kFacades, usual: "by number" },
      { key: "color", label: "Color", type: "text", usual: "#rrggbb" },
      { key: "roof/kind", label: "Roof", type: "choice", choices: kRoofKinds, usual: "by number" },
      { key: "roof/material", label: "Roof of", type: "choice", choices: kCoverings, usual: "by kind" },
      number("roof/height_m", "Roof height", "m", "by pitch"),
      number("roof/pitch_deg", "Roof pitch", "deg", "by kind"),
      { key: "roof/color", label: "Roof color", type: "text", usual: "#rrggbb" },
    ],
    members: { height_m: 9 },
  },
  {
    name: "exit",
    label: "Exit",
    key: "e",
    list: ["exits"],
    shape: "segment",
    idPrefix: "exit",
    fields: [kId, { key: "open", label: "Open", type: "check", usual: "true" }],
    members: {},
  },
  {
    name: "area",
    label: "Area",
    key: "a",
    list: ["ground", "areas"],
    shape: "polygon",
    outline: "corners",
    fields: [
      {
        key: "material",
        label: "Material",
        type: "choice",
        choices: ["pavers", "asphalt", "grass", "concrete", "dirt", "water"],
        isRequired: true,
      },
      { key: "kerb", label: "Kerb", type: "choice", choices: ["0", "1"], usual: "0" },
      number("level_m", "Water level", "m", "-2.5"),
    ],
    members: { material: "grass" },
  },
  {
    name: "stand",
    label: "Stand",
    key: "t",
    list: ["stands"],
    shape: "segment",
    idPrefix: "stand",
    fields: [
      kId,
      number("rows", "Rows", "", "20"),
      number("row_depth_m", "Row depth", "m", "0.85"),
      number("row_rise_m", "Row rise", "m", "0.38"),
      number("front_height_m", "Front height", "m", "1"),
      { key: "roof", label: "Roof", type: "check", usual: "false" },
      number("vomitories", "Openings", "", "0"),
      { key: "text", label: "Text", type: "text" },
      number("spectators/count", "Spectators", "", "0"),
      number("spectators/leave_at_s", "Leave at", "s", "never"),
    ],
    members: {},
  },
  {
    name: "group",
    label: "Group",
    key: "g",
    list: ["people", "groups"],
    shape: "polygon",
    outline: "area",
    fields: [kDoing, { ...number("count", "People"), isRequired: true }],
    members: { doing: "stroll", count: 40 },
  },
  {
    name: "queue",
    label: "Queue",
    key: "q",
    list: ["people", "lines"],
    shape: "segment",
    fields: [{ ...number("count", "People"), isRequired: true }],
    members: { count: 8 },
  },
  {
    name: "source",
    label: "Source",
    key: "s",
    list: ["people", "sources"],
    shape: "segment",
    fields: [
      kDoing,
      number("per_minute", "People per minute"),
      number("until_s", "Until", "s", "600"),
      { key: "exit", label: "Comes in by", type: "exit", usual: "its segment" },
      { key: "towards", label: "Goes to", type: "exit", usual: "by chance" },
    ],
    members: { doing: "cross", per_minute: 20 },
  },
  {
    name: "hazard",
    label: "Hazard",
    key: "h",
    list: ["disasters"],
    shape: "point",
    place: "position",
    fields: [
      { key: "kind", label: "Kind", type: "choice", choices: ["explosion", "fire", "attacker", "collapse", "gas"], isRequired: true },
      number("start_s", "Starts", "s", "0"),
      number("radius_m", "Radius", "m", "2"),
      number("growth_mps", "Growth", "m/s", "0"),
      number("max_radius_m", "Max radius", "m", "1000"),
      number("noticed_m", "Noticed from", "m", "by kind"),
      number("blocked_m", "Blocks", "m", "by kind"),
      number("hurts_m", "Hurts within", "m", "by kind"),
    ],
    members: { kind: "fire", start_s: 5 },
  },
  {
    name: "drone",
    label: "Drone",
    key: "d",
    list: ["drones"],
    shape: "point",
    place: "start",
    idPrefix: "d",
    fields: [kId, number("yaw_deg", "Heading", "deg", "0")],
    members: { yaw_deg: 0 },
  },
  {
    name: "prop",
    label: "Prop",
    key: "p",
    list: ["props"],
    shape: "point",
    place: "position",
    fields: kPropFields,
    members: { kind: "tree" },
  },
  {
    name: "row",
    label: "Row of props",
    key: "r",
    list: ["rows"],
    shape: "segment",
    fields: [...kPropFields, { ...number("apart_m", "Apart", "m"), isRequired: true }],
    members: { kind: "bench", apart_m: 4 },
  },
  {
    name: "marking",
    label: "Marking",
    key: "m",
    list: ["ground", "markings"],
    shape: "segment",
    fields: [
      { key: "kind", label: "Kind", type: "choice", choices: ["line", "dashes", "crossing"], isRequired: true },
      number("width_m", "Width", "m", "by kind"),
    ],
    members: { kind: "dashes" },
  },
  {
    name: "scatter",
    label: "Scattered props",
    key: "",
    list: ["scatter"],
    shape: "polygon",
    outline: "area",
    fields: [number("count", "Most of them"), number("seed", "Seed"), number("apart_m", "Apart", "m", "3")],
    members: { kinds: ["tree"], count: 10, seed: 1 },
  },
];

export const kindNamed = (name: string): Kind => kKinds.find((kind) => kind.name === name)!;

/** A yard with two exits, which can be run as it stands. */
export const kFirstBlueprint: JsonObject = {
  name: "My place",
  ground: { min: [-40, -30], max: [40, 30], material: "pavers" },
  inside: { min: [-28, -20], max: [28, 20] },
  exits: [
    { id: "west", from: [-20, -3], to: [-20, 3] },
    { id: "east", from: [20, -2], to: [20, 2] },
  ],
  buildings: [
    { id: "north", box: [-20, 10, 20, 18], height_m: 9 },
    { id: "south", box: [-20, -18, 20, -10], height_m: 12 },
    { id: "west_wall", box: [-20.4, 3, -20, 10], height_m: 2 },
    { id: "west_wall2", box: [-20.4, -10, -20, -3], height_m: 2 },
    { id: "east_wall", box: [20, 2, 20.4, 10], height_m: 2 },
    { id: "east_wall2", box: [20, -10, 20.4, -2], height_m: 2 },
  ] as Json,
  drones: [{ id: "d1", start: [0, -8, 25], yaw_deg: 90 }],
  people: {
    groups: [{ doing: "stroll", box: [-18, -8, 18, 8], count: 60 }],
    sources: [{ doing: "cross", exit: "west", towards: "east", per_minute: 20 }],
  },
};
