// Layouts of binary data that the program defines (layouts.json, which it writes).
import layouts from "../../../python/throng/layouts.json";

export { layouts };

type Numbers = "<f8" | "<f4" | "<u4" | "<u2" | "<i2" | "|u1";
const kBytes: Record<Numbers, number> = { "<f8": 8, "<f4": 4, "<u4": 4, "<u2": 2, "<i2": 2, "|u1": 1 };
const kReaders: Record<Numbers, (view: DataView, at: number) => number> = {
  "<f8": (view, at) => view.getFloat64(at, true),
  "<f4": (view, at) => view.getFloat32(at, true),
  "<u4": (view, at) => view.getUint32(at, true),
  "<u2": (view, at) => view.getUint16(at, true),
  "<i2": (view, at) => view.getInt16(at, true),
  "|u1": (view, at) => view.getUint8(at),
};

/** A binary record, described by fields as layouts.json has them: name, type and count of numbers. */
export class RecordLayout {
  readonly bytes: number = 0;
  private readonly places = new Map<string, { type: Numbers; at: number }>();

  constructor(fields: (string | number)[][]) {
    for (const [name, type, count] of fields as [string, Numbers, number][]) {
      this.places.set(name, { type, at: this.bytes });
      this.bytes += kBytes[type] * count;
    }
  }

  /** The number `index` of a field of the record that begins at the byte `at`. */
  read(view: DataView, at: number, field: string, index = 0): number {
    const place = this.places.get(field)!;
    return kReaders[place.type](view, at + place.at + kBytes[place.type] * index);
  }
}
