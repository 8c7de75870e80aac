"""The service's HTTP API (docs/api.md) as Python methods."""

# Answers are JSON, which openapi.json describes and api_types.py names; nothing checks them once more.
# mypy: disable-error-code="no-any-return"

from __future__ import annotations

import os
import time
import uuid
from pathlib import Path
from typing import Any, Callable, Iterator, Literal, Mapping, Sequence, Union

from . import _download, _events
from ._bundle import PathLike, bundle, json_bytes, path_of
from ._catalog_client import CatalogClient, why
from ._http import multipart, part, query_string
from ._job_base import Part, plain
from ._live import LiveFlight
from ._progress import ProgressBar
from ._trajectories import Trajectories, read_trajectories
from ._words import counted
from .api_types import DryRun, Event, EventList, ImageList, Job, JobList
from .api_types import LiveFlight as LiveFlightAnswer
from .api_types import LogList, PreviewList, Progress
from .errors import JobFailedError
from .tables import Table, read_csv

JobLike = Union[Mapping[str, Any], Part]


class Client(CatalogClient):
    """A service of throng. Methods raise ServiceError with what the service says is wrong.

    >>> client = Client("http://127.0.0.1:8080", key="throng_...")
    >>> job = client.submit({"scenario": "city_square/everyday"})
    >>> client.watch(job["id"])
    >>> dataset = throng.Dataset(client.download(job["id"], "datasets/"))

    Without url and key, $THRONG_URL and $THRONG_KEY are used. patience_s is how long a broken connection, or a service
    that restarts, is waited for; ssl_context is for custom certificates.
    """

    # Jobs.

    def submit(
        self,
        job: JobLike,
        *,
        scenario: PathLike | None = None,
        priority: int = 0,
        labels: Sequence[str] = (),
        idempotency_key: str | None = None,
    ) -> Job:
        """Queues a job: a dict as docs/job.md says, or a throng.job.Job.

        scenario is a folder, .zip or .tar with custom scenarios, which the job names bundle/NAME. The submission
        is repeated when the connection breaks, and makes one job at most.
        """
        return self._submit(
            job,
            scenario,
            {"priority": priority or None, "label": list(labels)},
            {"Idempotency-Key": idempotency_key or uuid.uuid4().hex},
        )

    def dry_run(self, job: JobLike, *, scenario: PathLike | None = None) -> DryRun:
        """Only checks the job: runs, shards, frames, estimates, warnings, and the job with all defaults.
        InvalidRequestError names all mistakes."""
        return self._submit(job, scenario, {"dry_run": True}, {})

    def _submit(
        self, job: JobLike, scenario: PathLike | None, query: Mapping[str, Any], headers: Mapping[str, str]
    ) -> Any:
        if scenario is None:
            return self._http.request(
                "POST", "/v1/jobs", query=query, json_body=plain(job), headers=headers, repeatable=True
            ).json()
        body, content_type = multipart(
            [
                ("job", None, "application/json", json_bytes(plain(job))),
                ("scenario", "scenario.zip", "application/octet-stream", bundle(scenario)),
            ]
        )
        return self._http.request(
            "POST", "/v1/jobs", query=query, body=body, content_type=content_type, headers=headers, repeatable=True
        ).json()

    def job(self, job_id: str) -> Job:
        """A job with its state and progress."""
        return self._get(f"/v1/jobs/{part(job_id)}")

    def jobs(
        self,
        *,
        state: str | Sequence[str] | None = None,
        label: str | None = None,
        name: str | None = None,
        oldest_first: bool = False,
        page: int = 100,
    ) -> Iterator[Job]:
        """All jobs that fit, page by page as they are asked for, without what they were asked to do (`job`)."""
        after: str | None = None
        while True:
            query = {
                "state": [state] if isinstance(state, str) else state,
                "label": label,
                "name": name,
                "limit": page,
                "sort": "oldest" if oldest_first else None,
                "after": after,
            }
            answer: JobList = self._get("/v1/jobs", query)
            yield from answer["jobs"]
            after = answer["next"]
            if after is None:
                return

    def change(
        self, job_id: str, *, priority: int | None = None, labels: Sequence[str] | None = None, keep: bool | None = None
    ) -> Job:
        """Changes priority, labels, or whether the job is never removed for its age."""
        change = {"priority": priority, "labels": None if labels is None else list(labels), "keep": keep}
        body = {name: value for name, value in change.items() if value is not None}
        return self._send("PATCH", f"/v1/jobs/{part(job_id)}", body, repeatable=True)

    def cancel(self, job_id: str) -> Job:
        """Ends a queued or running job; what it has published stays for retry(). A job that has ended is returned as it
        is: it may end at any moment, so this is no error."""
        return self._cancel(f"/v1/jobs/{part(job_id)}/cancel")

    def retry(self, job_id: str) -> Job:
        """Queues a job again that failed, at least in part, or was cancelled."""
        return self._send("POST", f"/v1/jobs/{part(job_id)}/retry")

    def clone(
        self, job_id: str, changes: Mapping[str, Any] | None = None, *, idempotency_key: str | None = None
    ) -> Job:
        """Queues a new job like this one; changes is a JSON merge patch, for example {"seed": 2}."""
        headers = {"Idempotency-Key": idempotency_key or uuid.uuid4().hex}
        return self._http.request(
            "POST", f"/v1/jobs/{part(job_id)}/clone", json_body=plain(changes or {}), headers=headers, repeatable=True
        ).json()

    def remove(self, job_id: str) -> None:
        """Ends a job and removes all its files."""
        self._remove(f"/v1/jobs/{part(job_id)}")

    def events(
        self, job_id: str | None = None, *, after: int = 0, follow: bool = False, wait_s: int = 0
    ) -> Iterator[Event]:
        """Past events of a job, or of all jobs. follow=True: also future ones, until the job has ended."""
        if follow and job_id is not None:
            for kind, event in _events.follow(self._http, f"/v1/jobs/{part(job_id)}", after, None):
                if kind not in ("progress", "preview"):
                    yield event  # type: ignore[misc]
            return
        path = "/v1/events" if job_id is None else f"/v1/jobs/{part(job_id)}/events"
        while True:
            page: EventList = self._get(path, {"after": after, "wait_s": 30 if follow else wait_s})
            yield from page["events"]
            if not page["events"] and not follow:
                return
            after, wait_s = page["next"], 0

    def watch(
        self,
        job_id: str,
        *,
        progress: bool = True,
        callback: Callable[[Progress], None] | None = None,
        timeout_s: float | None = None,
        check: bool = True,
    ) -> Job:
        """Waits for the job's end and returns it, with a progress bar (also in notebooks).

        JobFailedError where it failed or was cancelled, unless check=False; TimeoutError after timeout_s. A partial job
        counts as done.
        """
        job = self.job(job_id)
        bar = ProgressBar(job["name"]) if progress else None
        deadline = None if timeout_s is None else time.monotonic() + timeout_s
        try:
            for kind, data in _events.follow(self._http, f"/v1/jobs/{part(job_id)}", 0, deadline):
                if kind != "progress":
                    continue
                if callback is not None:
                    callback(data)  # type: ignore[arg-type]
                if bar is not None:
                    _draw(bar, data)
        finally:
            if bar is not None:
                bar.close()
        job = self.job(job_id)
        if check and job["state"] in ("failed", "cancelled"):
            raise JobFailedError(why(job), job)
        return job

    # Results.

    def download(
        self,
        job_id: str,
        path: PathLike = ".",
        *,
        format: Literal["tar", "zip"] = "tar",
        include: Sequence[str] | None = None,
        runs: str | None = None,
        split: str | None = None,
        verify: bool = True,
        progress: bool = True,
        overwrite: bool = False,
    ) -> Path:
        """Downloads the dataset's archive, going on where an earlier call broke off; returns its path.

        A file that is there already is only written over with overwrite.

        path is a file, or a folder (made where it ends with "/") for the name that the service proposes. include, runs
        and split choose a part, for example include=["images", "coco"], runs="0-3,7". With verify every file is
        compared with its SHA-256.
        """
        query = {
            "format": None if format == "tar" else format,
            "include": ",".join(include) if include else None,
            "runs": runs,
            "split": split,
        }
        target = f"/v1/jobs/{part(job_id)}/archive{query_string(query)}"
        out = Path(path)
        if os.fspath(path).endswith(("/", os.sep)):
            out.mkdir(parents=True, exist_ok=True)
        if out.is_dir():
            head = self._http.request("HEAD", target, repeatable=True)
            out = out / _download.file_name_from(head.headers, f"{job_id}.{format}")
        _download.check_output(out, overwrite=overwrite)
        bar = ProgressBar(f"downloading {out.name}") if progress else None

        def report(done: int, total: int) -> None:
            if bar is not None:
                bar.update(done / total if total else 0.0, f"{done / 1e6:.1f} of {total / 1e6:.1f} MB", "downloading")

        try:
            _download.fetch(self._http, target, out, report)
        finally:
            if bar is not None:
                bar.close()
        if verify:
            _download.check(out, complete=not (include or runs or split))
        return out

    def manifest(self, job_id: str) -> dict[str, Any]:
        """Every file of the dataset with its size and SHA-256."""
        return self._get(f"/v1/jobs/{part(job_id)}/manifest")

    def images(
        self, job_id: str, *, run: str | None = None, camera: str | None = None, offset: int = 0, limit: int = 100
    ) -> ImageList:
        """A page of the dataset's images, and how many each camera took in each run."""
        query = {"run": run, "camera": camera, "offset": offset, "limit": limit}
        return self._get(f"/v1/jobs/{part(job_id)}/images", query)

    def file(self, job_id: str, name: str) -> bytes:
        """One file of the dataset."""
        return self._bytes(f"/v1/jobs/{part(job_id)}/files/{path_of(name)}")

    def metrics(self, job_id: str, run: int | None = None) -> Any:
        """Figures of all runs, or of one run, which is there once that run was measured (docs/metrics.md)."""
        return self._get(
            f"/v1/jobs/{part(job_id)}/metrics" if run is None else f"/v1/jobs/{part(job_id)}/runs/{run}/metrics"
        )

    def exits(self, job_id: str, run: int = 0) -> Table:
        """The exits of one run, frame by frame."""
        path = f"/v1/jobs/{part(job_id)}/runs/{run}/metrics.csv"
        return read_csv(self._bytes(path), self._http.url + path)

    def trace(self, job_id: str, run: int, path: PathLike) -> Path:
        """Downloads the trace of one run (docs/trace.md) to a file, which throng.Trace reads; returns its path."""
        _download.fetch(self._http, f"/v1/jobs/{part(job_id)}/runs/{run}/trace", Path(path), lambda done, total: None)
        return Path(path)

    def trajectories(
        self, job_id: str, run: int, *, from_s: float = 0.0, to_s: float | None = None, every_s: float = 1.0
    ) -> Trajectories:
        """Positions of all people in a run at some times, without the rest of the trace."""
        query = {"from_s": from_s, "to_s": to_s, "every_s": every_s}
        return read_trajectories(self._bytes(f"/v1/jobs/{part(job_id)}/runs/{run}/trajectories{query_string(query)}"))

    def report(self, job_id: str, *, timeout_s: float = 300.0) -> str:
        """All runs as one HTML page; waits while it is made."""
        deadline = time.monotonic() + timeout_s
        while True:
            answer = self._http.request("GET", f"/v1/jobs/{part(job_id)}/report")
            if answer.status != 202:
                return answer.body.decode("utf-8")
            if time.monotonic() > deadline:
                raise TimeoutError("the report was not made in time")
            time.sleep(min(2.0, float(answer.headers.get("Retry-After") or 1)))

    def plan(self, job_id: str) -> str:
        """The floor plan of the job's scenario as SVG."""
        return self._bytes(f"/v1/jobs/{part(job_id)}/plan").decode("utf-8")

    # Live flights.

    def live(self, job: JobLike, *, record: bool = False) -> LiveFlight:
        """Begins a live flight of a job's drones: its first run, as the job would simulate it. record: for recording()."""
        answer = self._http.request("POST", "/v1/live", json_body={"job": plain(job), "record": record}).json()
        return LiveFlight(self._http, answer)

    def live_flights(self) -> list[LiveFlightAnswer]:
        """One's own, also those that have just ended."""
        return self._http.request("GET", "/v1/live").json()["flights"]

    def live_flight(self, flight_id: str) -> LiveFlight:
        """One that was begun elsewhere."""
        return LiveFlight(self._http, self._http.request("GET", f"/v1/live/{part(flight_id)}").json())

    def logs(self, job_id: str) -> LogList:
        """Names and sizes of what the workers said."""
        return self._get(f"/v1/jobs/{part(job_id)}/logs")

    def log(self, job_id: str, name: str) -> str:
        return self._bytes(f"/v1/jobs/{part(job_id)}/logs/{part(name)}").decode("utf-8", "replace")

    def previews(self, job_id: str) -> PreviewList:
        """Images with drawn annotations, also while the job runs."""
        return self._get(f"/v1/jobs/{part(job_id)}/previews")

    def preview(self, job_id: str, name: str, *, clean: bool = False) -> bytes:
        """A JPEG; clean=True: without annotations."""
        return self._bytes(f"/v1/jobs/{part(job_id)}/previews/{path_of(name)}", {"clean": clean})


def _draw(bar: ProgressBar, data: Mapping[str, Any]) -> None:
    done, total = data.get("frames_done", 0), data.get("frames_total", 0)
    left = data.get("remaining_s")
    text = f"{data.get('stage', '')}, {done} of {counted(total, 'frame')}" + (f", {left:.0f} s left" if left else "")
    publishing = data.get("publishing")
    if data.get("stage") == "publishing" and publishing:
        done, total = publishing["bytes_done"], publishing["bytes_total"]
        text = f"publishing, {done / 1e6:.1f} of {total / 1e6:.1f} MB"
    bar.update(done / total if total else 0.0, text, str(data.get("stage", "")))
