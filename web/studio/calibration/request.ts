// A request for a calibration by images of a board, and how it is sent.
import { request as send } from "../api/client";
import type { Calibration } from "../api/types";
import { fixedOf, fixedText, numberOr, priorsOf, priorText } from "./known";

export interface Settings {
  name: string;
  kind: "chessboard" | "charuco" | "circles";
  columns: string;
  rows: string;
  square: string;
  marker: string;
  dictionary: string;
  lens: string;
  skew: boolean;
  fix: string; ///< as in known.ts
  prior: string;
  isSquare: boolean; ///< fx and fy are equal
}

export interface ChosenImage {
  name: string; ///< as it is sent; no two are alike
  file: Blob;
  url: string; ///< of this browser, for <img>
}

export const kMaxBytes = 256 * 2 ** 20;
const kTypes = ["image/jpeg", "image/png"];
const kStorage = "throng.calibration";

export const kUsualSettings: Settings = {
  name: "",
  kind: "chessboard",
  columns: "9",
  rows: "6",
  square: "0.025",
  marker: "",
  dictionary: "4X4_50",
  lens: "auto",
  skew: false,
  fix: "",
  prior: "",
  isSquare: false,
};

export function storedSettings(): Settings {
  try {
    return { ...kUsualSettings, ...(JSON.parse(sessionStorage.getItem(kStorage) ?? "{}") as Partial<Settings>) };
  } catch {
    return kUsualSettings;
  }
}

export function storeSettings(settings: Settings): void {
  sessionStorage.setItem(kStorage, JSON.stringify(settings));
}

/** The settings of a calibration that was sent before. */
export function settingsOf(request: Record<string, unknown>): Settings {
  const board = (request["board"] ?? {}) as Record<string, unknown>;
  const text = (value: unknown, usual: string) => (value === undefined ? usual : String(value));
  return {
    name: text(request["name"], ""),
    kind: (board["kind"] as Settings["kind"] | undefined) ?? "chessboard",
    columns: text(board["columns"], "9"),
    rows: text(board["rows"], "6"),
    square: text(board["square"], "1"),
    marker: text(board["marker"], ""),
    dictionary: text(board["dictionary"], "4X4_50"),
    lens: text(request["lens"], "brown5"),
    skew: request["skew"] === true,
    fix: fixedText(request["fix"]),
    prior: priorText(request["prior"]),
    isSquare: "fx" in ((request["tie"] ?? {}) as object),
  };
}

export function requestOf(settings: Settings, images: ChosenImage[]): object {
  const { name, kind, columns, rows, square, marker, dictionary, lens, skew, fix, prior, isSquare } = settings;
  const board: Record<string, unknown> = { kind, columns: numberOr(columns), rows: numberOr(rows) };
  if (square.trim()) board["square"] = numberOr(square);
  if (kind === "charuco") {
    board["dictionary"] = dictionary;
    if (marker.trim()) board["marker"] = numberOr(marker);
  }
  return {
    ...(name.trim() ? { name: name.trim() } : {}),
    images: images.map((image) => image.name),
    board,
    lens,
    skew,
    ...(fix.trim() ? { fix: fixedOf(fix) } : {}),
    ...(prior.trim() ? { prior: priorsOf(prior) } : {}),
    ...(isSquare ? { tie: { fx: { to: "fy" } } } : {}),
  };
}

/** Images of a list of files beside those that are chosen, and in words why others are not taken. */
export function withFiles(chosen: ChosenImage[], files: File[]): { images: ChosenImage[]; refused: string[] } {
  const images = [...chosen];
  const refused: string[] = [];
  for (const file of files) {
    if (!kTypes.includes(file.type)) {
      refused.push(`${file.name} is neither JPEG nor PNG`);
      continue;
    }
    const dot = file.name.lastIndexOf(".");
    const stem = dot < 0 ? file.name : file.name.slice(0, dot);
    let name = file.name;
    for (let number = 2; images.some((image) => image.name === name); ++number)
      name = `${stem}_${number}${dot < 0 ? "" : file.name.slice(dot)}`;
    images.push({ name, file, url: URL.createObjectURL(file) });
  }
  return { images, refused };
}

/** Throws ApiError. */
export async function sendCalibration(settings: Settings, images: ChosenImage[]): Promise<Calibration> {
  const form = new FormData();
  form.append("request", JSON.stringify(requestOf(settings, images)));
  for (const image of images) form.append("file", image.file, image.name);
  return (await send("/v1/calibrations", { method: "POST", body: form })).json() as Promise<Calibration>;
}

export const imagePath = (id: string, name: string) => `/v1/calibrations/${id}/images/${encodeURIComponent(name)}`;

/** The images of a calibration that was sent before. Throws ApiError. */
export async function sentImages(calibration: Calibration): Promise<ChosenImage[]> {
  const names = (calibration.request["images"] ?? []) as string[];
  return Promise.all(
    names.map(async (name) => {
      const file = await (await send(imagePath(calibration.id, name))).blob();
      return { name, file, url: URL.createObjectURL(file) };
    }),
  );
}
