// Sizes of archives before they are downloaded: the service knows them without making one.
import { useEffect, useState } from "preact/hooks";
import { ApiError, request } from "../api/client";

export interface ArchiveSize {
  bytes: number | null; ///< null until it is known, and with an error
  error: ApiError | null;
}

/** An answer to HEAD has no text that could say why there is none: GET has, and fails as early. */
async function explain(address: string): Promise<ApiError> {
  try {
    const response = await request(address, { headers: { Range: "bytes=0-0" } });
    await response.body?.cancel();
  } catch (error) {
    if (error instanceof ApiError) return error;
  }
  return new ApiError(0, "the size of the download is not known");
}

export function useArchiveSize(address: string): ArchiveSize {
  const [state, setState] = useState<ArchiveSize & { address: string }>({ address: "", bytes: null, error: null });
  useEffect(() => {
    let isCurrent = true;
    const settle = (bytes: number | null, error: ApiError | null) => isCurrent && setState({ address, bytes, error });
    request(address, { method: "HEAD" }).then(
      (response) => settle(Number(response.headers.get("Content-Length")), null),
      async () => settle(null, await explain(address)),
    );
    return () => void (isCurrent = false);
  }, [address]);
  return state.address === address ? state : { bytes: null, error: null };
}
