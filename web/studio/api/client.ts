// Requests to the service.
import { browserAddress } from "./base";
import { noteUnreachable } from "./reach";
import { demandKey } from "./session";
import type { Mistake, Problem } from "./types";

/** An answer other than success, or none. */
export class ApiError extends Error {
  constructor(
    readonly status: number, ///< 0: the service cannot be reached
    detail: string,
    readonly errors: Mistake[] = [],
  ) {
    super(detail);
  }
}

async function errorOf(response: Response): Promise<ApiError> {
  const problem = (await response.json().catch(() => null)) as Problem | null;
  return new ApiError(response.status, problem?.detail || `${response.status} ${response.statusText}`, problem?.errors);
}

/** Throws ApiError unless the service answers with success or 304. */
export async function request(path: string, init: RequestInit = {}): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(browserAddress(path), init);
  } catch (error) {
    if ((error as Error).name === "AbortError") throw error;
    noteUnreachable();
    throw new ApiError(0, "the service cannot be reached");
  }
  if (response.ok || response.status === 304) return response;
  const error = await errorOf(response);
  if (error.status === 401 && path !== "/v1/session") demandKey(error.message);
  throw error;
}

export async function getJson<T>(path: string, signal?: AbortSignal): Promise<T> {
  return (await request(path, { signal, headers: { Accept: "application/json" } })).json() as Promise<T>;
}

export async function sendJson<T>(method: string, path: string, body?: string, signal?: AbortSignal): Promise<T> {
  const headers: Record<string, string> = body === undefined ? {} : { "Content-Type": "application/json" };
  const response = await request(path, { method, body, headers, signal });
  return (response.status === 204 ? undefined : await response.json()) as T;
}

/** Bytes [first, last] of a file, and the size of the whole. */
export async function getRange(path: string, first: number, last: number): Promise<{ text: string; size: number }> {
  const response = await request(path, { headers: { Range: `bytes=${first}-${last}` } });
  const total = /\/(\d+)$/.exec(response.headers.get("Content-Range") ?? "");
  const bytes = await response.arrayBuffer();
  return { text: new TextDecoder().decode(bytes), size: total ? Number(total[1]) : bytes.byteLength };
}

/** Whatever was thrown, as an error that screens show. */
export function asApiError(error: unknown): ApiError {
  return error instanceof ApiError ? error : new ApiError(0, messageOf(error));
}

/** The message of whatever was thrown. */
export function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
