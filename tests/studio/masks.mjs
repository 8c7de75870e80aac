// An oracle of masks, apart from Studio's decoder: docs/formats.md, "COCO instances".

/** Pixels of a mask as the set of y * width + x. */
export function pixelsOf({ size: [height, width], counts }) {
  const numbers = [];
  let groups = [];
  for (const letter of counts) {
    const code = letter.charCodeAt(0) - 48;
    groups.push(code & 31);
    if (code >= 32) continue;
    let value = groups.reduce((sum, bits, index) => sum + bits * 32 ** index, 0);
    if (groups.at(-1) >= 16) value -= 32 ** groups.length;
    numbers.push(value);
    groups = [];
  }
  for (let i = 3; i < numbers.length; ++i) numbers[i] += numbers[i - 2];
  const pixels = new Set();
  let at = 0;
  numbers.forEach((length, index) => {
    for (let i = 0; i < length; ++i, ++at) {
      if (index % 2 === 1) pixels.add((at % height) * width + Math.floor(at / height));
    }
  });
  if (at > height * width) throw new Error("a mask is longer than its image");
  return pixels;
}
