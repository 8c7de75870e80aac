// Warnings of a calibration in the words of the page: the service's name options of the command line.

/** Options in parentheses, such as "(--fix)" or "(--prior cx=640:20)", and what the form calls them. */
const kFields: Record<string, string> = { fix: "“Fixed”", tie: "“fx and fy are equal”", prior: "“About known”" };

export function warningText(warning: string): string {
  return warning.replace(/\(--(\w+)(?: (\w+)=([\d.]+):([\d.]+))?\)/g, (_, option: string, name?: string, mean?: string, sd?: string) => {
    const field = kFields[option] ?? `“${option}”`;
    return name ? `(${field}: ${name} = ${mean} ± ${sd})` : `(${field})`;
  });
}
