// Knowledge of a lens before it is estimated, as text of the form and as the request holds it.

type Fixed = Record<string, number | null>;
type Priors = Record<string, { mean: number; sd: number }>;

const parts = (text: string) =>
  text
    .split(/[,;]/)
    .map((part) => part.trim())
    .filter(Boolean);

/** A number where the text is one; else the text, so that the service says what is wrong with it. */
export const numberOr = (text: string) => (text.trim() === "" || Number.isNaN(Number(text)) ? text : Number(text));

/** "k3, cx = 640": k3 stays where it starts, cx is 640. */
export function fixedOf(text: string): Record<string, unknown> {
  return Object.fromEntries(
    parts(text).map((part) => {
      const [name = "", value] = part.split("=").map((side) => side.trim());
      return [name, value === undefined ? null : numberOr(value)];
    }),
  );
}

/** "cx = 640 ± 20": a mean and its standard deviation; "+-" and ":" do as well. */
export function priorsOf(text: string): Record<string, unknown> {
  return Object.fromEntries(
    parts(text).map((part) => {
      const [name = "", value = ""] = part.split("=").map((side) => side.trim());
      const [mean = "", sd] = value.split(/±|\+-|:/).map((side) => side.trim());
      return [name, { mean: numberOr(mean), ...(sd === undefined ? {} : { sd: numberOr(sd) }) }];
    }),
  );
}

export const fixedText = (fixed: unknown) =>
  Object.entries((fixed ?? {}) as Fixed)
    .map(([name, value]) => (value === null ? name : `${name} = ${value}`))
    .join(", ");

export const priorText = (priors: unknown) =>
  Object.entries((priors ?? {}) as Priors)
    .map(([name, { mean, sd }]) => `${name} = ${mean} ± ${sd}`)
    .join(", ");
