// Arrays of NumPy.

/** A .npy file of little-endian float32 in C order. */
export function npyOf(buffer: ArrayBuffer): { shape: number[]; values: Float32Array } {
  const view = new DataView(buffer);
  const isLong = view.getUint8(6) >= 2; // version 2: four bytes of length
  const start = isLong ? 12 : 10;
  const end = start + (isLong ? view.getUint32(8, true) : view.getUint16(8, true));
  const header = new TextDecoder().decode(buffer.slice(start, end));
  const shape = /'shape': \(([^)]*)\)/
    .exec(header)?.[1]
    ?.split(",")
    .filter((part) => part.trim())
    .map(Number);
  if (!shape || !header.includes("'<f4'") || header.includes("'fortran_order': True"))
    throw new Error("the array is not of float32 in C order");
  return { shape, values: new Float32Array(buffer.slice(end)) };
}
