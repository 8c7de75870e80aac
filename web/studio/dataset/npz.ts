// The array of a .npz file, which is a ZIP file.
import { npyOf } from "./npy";

const kEndOfDirectory = 0x06054b50;

/** The place and the packed size of the first member of a ZIP file. */
function firstMember(view: DataView): { start: number; size: number; isDeflated: boolean } {
  let end = view.byteLength - 22;
  while (end >= 0 && view.getUint32(end, true) !== kEndOfDirectory) --end;
  if (end < 0) throw new Error("the array is not in a ZIP file");
  const entry = view.getUint32(end + 16, true);
  const local = view.getUint32(entry + 42, true);
  return {
    start: local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true),
    size: view.getUint32(entry + 20, true),
    isDeflated: view.getUint16(entry + 10, true) === 8,
  };
}

/** The only array of a .npz file. */
export async function npzOf(buffer: ArrayBuffer): Promise<{ shape: number[]; values: Float32Array }> {
  const { start, size, isDeflated } = firstMember(new DataView(buffer));
  const packed = buffer.slice(start, start + size);
  if (!isDeflated) return npyOf(packed);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return npyOf(await new Response(stream).arrayBuffer());
}
