// Lines of a file that stays on the service: parts are fetched as they are needed.
import { getRange } from "../api/client";

const kBlockBytes = 128 * 1024;
const kMaxBlocks = 128;

export interface Line {
  text: string;
  start: number; ///< offset in bytes
  end: number; ///< of the next line
}

/** The file's text has to be ASCII, as the dataset's JSON is: offsets count bytes. */
export class LineFile {
  private readonly blocks = new Map<number, Promise<string>>();

  constructor(
    private readonly path: string,
    readonly size: number,
  ) {}

  private block(index: number): Promise<string> {
    const known = this.blocks.get(index);
    if (known) return known;
    const first = index * kBlockBytes;
    const text = getRange(this.path, first, Math.min(first + kBlockBytes, this.size) - 1).then((answer) => answer.text);
    text.catch(() => this.blocks.delete(index));
    this.blocks.set(index, text);
    if (this.blocks.size > kMaxBlocks) this.blocks.delete(this.blocks.keys().next().value!);
    return text;
  }

  /** The line that begins at an offset; null at the end of the file. */
  async lineAt(start: number): Promise<Line | null> {
    if (start >= this.size) return null;
    let text = "";
    for (let index = Math.floor(start / kBlockBytes); index * kBlockBytes < this.size; ++index) {
      const block = await this.block(index);
      const part = block.slice(Math.max(0, start - index * kBlockBytes));
      const end = part.indexOf("\n");
      if (end >= 0) return { text: text + part.slice(0, end), start, end: start + text.length + end + 1 };
      text += part;
    }
    return { text, start, end: this.size };
  }

  /** The first line that begins at an offset or after it. */
  private async lineFrom(offset: number): Promise<Line | null> {
    if (offset === 0) return this.lineAt(0);
    const before = await this.lineAt(offset - 1);
    return before ? this.lineAt(before.end) : null;
  }

  /** The first line that is not before what is looked for, in a file whose lines are ordered so. */
  async find(isBefore: (line: Line) => Promise<boolean>): Promise<Line | null> {
    let low = 0; // a line begins here, and all lines before are before it
    let high = this.size;
    while (low < high) {
      const middle = Math.floor((low + high) / 2);
      const line = await this.lineFrom(middle);
      if (line && line.start < high && (await isBefore(line))) low = line.end;
      else if (middle === low || !line || line.start >= high) {
        // No line begins between: those from `low` on are few.
        let next = await this.lineAt(low);
        while (next && next.start < high && (await isBefore(next))) next = await this.lineAt(next.end);
        return next;
      } else high = middle;
    }
    return this.lineAt(low);
  }
}
