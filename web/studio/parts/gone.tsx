// Instead of the screen of a job that is not there any more.
import { ApiError } from "../api/client";
import { ErrorBox } from "./elements";

export function GoneJob({ id }: { id: string }) {
  return (
    <ErrorBox error={new ApiError(404, `There is no job ${id}: it has been removed, or the address is wrong.`)}>
      <a class="button" href="/jobs">
        All jobs
      </a>
    </ErrorBox>
  );
}
