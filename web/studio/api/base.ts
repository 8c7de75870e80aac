// The service may lie below a path of a proxy, such as https://example.org/throng/. Everything in Studio names addresses
// as the service knows them ("/jobs/ID", "/v1/jobs"); the proxy's path is added where an address goes to the browser.

/** "" or the path of the proxy without a slash at its end: the scripts are in assets/ of the service. */
export const kBase = /^https?:/.test(import.meta.url) ? new URL("..", import.meta.url).pathname.replace(/\/$/, "") : "";

/** An address of the service as the browser needs it. */
export const browserAddress = (address: string): string => (/^\/(?!\/)/.test(address) ? kBase + address : address);

/** A path in the browser's address bar or in a link, as the service knows it. */
export const servicePath = (path: string): string =>
  path === kBase || path.startsWith(`${kBase}/`) ? path.slice(kBase.length) || "/" : path;

/** The address of the service itself, for snippets that the user runs elsewhere. */
export const serviceUrl = (): string => location.origin + kBase;
