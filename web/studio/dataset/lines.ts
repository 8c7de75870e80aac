// Lines of a text that arrives by parts.

/** `onBytes` gets how long each part was. */
export async function* readLines(body: ReadableStream<Uint8Array>, onBytes: (count: number) => void): AsyncGenerator<string> {
  const reader = body.pipeThrough(new TextDecoderStream() as unknown as TransformStream<Uint8Array, string>).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    onBytes(value.length);
    const lines = (rest + value).split("\n");
    rest = lines.pop() ?? "";
    yield* lines;
  }
  if (rest) yield rest;
}
