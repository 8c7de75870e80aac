"""The part of the client that is about scenarios, calibrations, studies, keys, webhooks and the service itself."""

# Answers are JSON, which openapi.json describes and api_types.py names; nothing checks them once more.
# mypy: disable-error-code="no-any-return"

from __future__ import annotations

import datetime
import os
import ssl
import time
from pathlib import Path
from typing import Any, Iterator, Literal, Mapping, Sequence

from . import _events
from ._bundle import PathLike, bundle, json_bytes, path_of
from ._http import BROKEN, Http, multipart, part
from ._job_base import plain
from .api_types import (
    Calibration,
    CalibrationList,
    DeliveryList,
    EventList,
    Key,
    KeyList,
    Scenario,
    ScenarioList,
    Session,
    Study,
    StudyList,
    StudyPlan,
    StudyValues,
    Upload,
    Webhook,
    WebhookList,
)
from .errors import AccessError, ConflictError, JobFailedError

DEFAULT_URL = "http://127.0.0.1:8080"


class CatalogClient:
    """Base class of Client."""

    def __init__(
        self,
        url: str | None = None,
        key: str | None = None,
        *,
        timeout_s: float = 60.0,
        patience_s: float = 60.0,
        ssl_context: ssl.SSLContext | None = None,
    ) -> None:
        self._http = Http(
            url or os.environ.get("THRONG_URL") or DEFAULT_URL,
            key or os.environ.get("THRONG_KEY") or None,
            timeout_s,
            patience_s,
            ssl_context,
        )

    def __repr__(self) -> str:
        return f"Client({self._http.url!r})"

    # Scenarios.

    def scenarios(self) -> list[Scenario]:
        """The scenarios that jobs can name."""
        scenarios: list[Scenario] = []
        after: str | None = None
        while True:
            answer: ScenarioList = self._get("/v1/scenarios", {"after": after})
            scenarios += answer["scenarios"]
            after = answer["next"]
            if after is None:
                return scenarios

    def scenario(self, scenario_id: str) -> Scenario:
        return self._get(f"/v1/scenarios/{path_of(scenario_id)}")

    def scenario_plan(self, scenario_id: str) -> str:
        """The floor plan as SVG."""
        return self._bytes(f"/v1/scenarios/{path_of(scenario_id)}", {"format": "svg"}).decode("utf-8")

    def upload_scenario(self, path: PathLike, name: str, *, dry_run: bool = False) -> Upload:
        """Sends a folder, .zip or .tar of scenarios, or a blueprint (.json); jobs name them NAME/... . findings says
        what is odd about them."""
        is_blueprint = Path(path).suffix == ".json"
        return self._http.request(
            "POST",
            "/v1/scenarios",
            query={"name": name, "dry_run": dry_run},
            body=Path(path).read_bytes() if is_blueprint else bundle(path),
            content_type="application/json" if is_blueprint else "application/octet-stream",
        ).json()

    def remove_scenario(self, name: str) -> None:
        self._remove(f"/v1/scenarios/{path_of(name)}")

    # Calibrations.

    def calibrate(self, request: Mapping[str, Any], files: Sequence[PathLike] = ()) -> Calibration:
        """Queues a calibration (docs/calibration.md) with the files that the request names."""
        if not files:
            return self._send("POST", "/v1/calibrations", plain(request))
        parts: list[tuple[str, str | None, str, bytes]] = [
            ("request", None, "application/json", json_bytes(plain(request)))
        ]
        for i, file in enumerate(files):
            parts.append((f"file{i}", Path(file).name, "application/octet-stream", Path(file).read_bytes()))
        body, content_type = multipart(parts)
        return self._http.request("POST", "/v1/calibrations", body=body, content_type=content_type).json()

    def calibration(self, calibration_id: str) -> Calibration:
        """State and progress; `camera` once it has succeeded."""
        return self._get(f"/v1/calibrations/{part(calibration_id)}")

    def calibrations(self) -> Iterator[Calibration]:
        after: str | None = None
        while True:
            answer: CalibrationList = self._get("/v1/calibrations", {"limit": 100, "after": after})
            yield from answer["calibrations"]
            after = answer["next"]
            if after is None:
                return

    def wait_for_calibration(self, calibration_id: str, *, timeout_s: float = 600.0, check: bool = True) -> Calibration:
        """Waits for its end; JobFailedError where it failed, unless check=False."""
        deadline = time.monotonic() + timeout_s
        while True:
            calibration = self.calibration(calibration_id)
            if calibration["state"] not in ("queued", "running"):
                if check and calibration["state"] != "succeeded":
                    raise JobFailedError(why(calibration), calibration)
                return calibration
            if time.monotonic() > deadline:
                raise TimeoutError("the calibration has not ended in time")
            time.sleep(0.2)

    def calibration_result(
        self, calibration_id: str, name: Literal["camera", "opencv", "ros", "residuals", "points"]
    ) -> str:
        """The camera as JSON, as OpenCV's or ROS' YAML, the residuals as SVG, or the points as JSON."""
        return self._bytes(f"/v1/calibrations/{part(calibration_id)}/{part(name)}").decode("utf-8")

    def calibration_image(self, calibration_id: str, name: str) -> bytes:
        """An image of a board, as it was sent."""
        return self._bytes(f"/v1/calibrations/{part(calibration_id)}/images/{path_of(name)}")

    def remove_calibration(self, calibration_id: str) -> None:
        self._remove(f"/v1/calibrations/{part(calibration_id)}")

    # Studies.

    def submit_study(self, study: Mapping[str, Any]) -> Study:
        """Queues a study: cases times policies times paired runs (docs/study.md)."""
        return self._send("POST", "/v1/studies", plain(study))

    def check_study(self, study: Mapping[str, Any]) -> StudyPlan:
        """The plan of a study that is not queued; InvalidRequestError with everything that is wrong with it."""
        return self._http.request("POST", "/v1/studies", query={"dry_run": True}, json_body=plain(study)).json()

    def study(self, study_id: str) -> Study:
        """State and progress, its `plan`, and the `summary` of the runs that are there so far."""
        return self._get(f"/v1/studies/{part(study_id)}")

    def studies(self) -> Iterator[Study]:
        after: str | None = None
        while True:
            answer: StudyList = self._get("/v1/studies", {"limit": 100, "after": after})
            yield from answer["studies"]
            after = answer["next"]
            if after is None:
                return

    def wait_for_study(self, study_id: str, *, timeout_s: float = 86_400.0, check: bool = True) -> Study:
        """Waits for its end; JobFailedError where it failed or was cancelled, unless check=False."""
        deadline = time.monotonic() + timeout_s
        while True:
            study = self.study(study_id)
            if study["state"] not in ("queued", "running"):
                if check and study["state"] != "succeeded":
                    raise JobFailedError(why(study), study)
                return study
            if time.monotonic() > deadline:
                raise TimeoutError("the study has not ended in time")
            time.sleep(1.0)

    def change_study(
        self,
        study_id: str,
        *,
        priority: int | None = None,
        labels: Sequence[str] | None = None,
        keep: bool | None = None,
    ) -> Study:
        """Changes priority, labels, or whether the study is never removed for its age."""
        change = {"priority": priority, "labels": None if labels is None else list(labels), "keep": keep}
        body = {name: value for name, value in change.items() if value is not None}
        return self._send("PATCH", f"/v1/studies/{part(study_id)}", body, repeatable=True)

    def study_events(self, study_id: str, *, after: int = 0, follow: bool = False) -> Iterator[tuple[str, Any]]:
        """(type, event) of a study's past events. follow=True: also future ones, and ("progress", figures) in between,
        until the study has ended."""
        if follow:
            yield from _events.follow(self._http, f"/v1/studies/{part(study_id)}", after, None)
            return
        while True:
            page: EventList = self._get(f"/v1/studies/{part(study_id)}/events", {"after": after})
            for event in page["events"]:
                yield event["type"], event
            if not page["events"]:
                return
            after = page["next"]

    def cancel_study(self, study_id: str) -> Study:
        """Finished runs are kept for a retry. A study that has ended is returned as it is."""
        return self._cancel(f"/v1/studies/{part(study_id)}/cancel")

    def retry_study(self, study_id: str) -> Study:
        return self._send("POST", f"/v1/studies/{part(study_id)}/retry")

    def remove_study(self, study_id: str) -> None:
        self._remove(f"/v1/studies/{part(study_id)}")

    def study_values(self, study_id: str) -> StudyValues:
        """The figures of each run; there while the study runs, too."""
        return self._get(f"/v1/studies/{part(study_id)}/files/values.json")

    def study_file(self, study_id: str, name: str) -> bytes:
        """summary.json, summary.csv, summary.md, values.json or runs/CASE/POLICY/000.json."""
        return self._bytes(f"/v1/studies/{part(study_id)}/files/{path_of(name)}")

    def study_report(self, study_id: str) -> str:
        """The report as one HTML page."""
        return self._bytes(f"/v1/studies/{part(study_id)}/report").decode("utf-8")

    # Keys (administrators).

    def create_key(
        self,
        name: str,
        scope: Literal["read", "submit", "admin"] = "submit",
        *,
        max_jobs: int | None = None,
        max_bytes: int | None = None,
        max_priority: int = 0,
        expires_at: str | datetime.datetime | None = None,
    ) -> Key:
        """Makes a key; `key` of the answer is what callers send, and is shown once. It expires at a time with a zone, or
        a date, or after a duration ("30d", "12h", "2w"); what it has queued then goes on."""
        if isinstance(expires_at, datetime.datetime):
            expires_at = expires_at.isoformat()
        limits = {"max_jobs": max_jobs, "max_bytes": max_bytes, "max_priority": max_priority, "expires_at": expires_at}
        return self._send("POST", "/v1/keys", {"name": name, "scope": scope, **limits})

    def keys(self) -> list[Key]:
        answer: KeyList = self._get("/v1/keys")
        return answer["keys"]

    def revoke_key(self, key_id: str) -> None:
        self._remove(f"/v1/keys/{part(key_id)}")

    # Webhooks (administrators).

    def create_webhook(self, url: str, events: Sequence[str] | None = None) -> Webhook:
        """Has an address told of events; `secret` of the answer signs them and is shown once."""
        return self._send("POST", "/v1/webhooks", {"url": url, **({"events": list(events)} if events else {})})

    def webhooks(self) -> list[Webhook]:
        answer: WebhookList = self._get("/v1/webhooks")
        return answer["webhooks"]

    def webhook(self, webhook_id: str) -> Webhook:
        return self._get(f"/v1/webhooks/{part(webhook_id)}")

    def enable_webhook(self, webhook_id: str, enabled: bool = True) -> Webhook:
        return self._send("PATCH", f"/v1/webhooks/{part(webhook_id)}", {"enabled": enabled}, repeatable=True)

    def remove_webhook(self, webhook_id: str) -> None:
        self._remove(f"/v1/webhooks/{part(webhook_id)}")

    def webhook_deliveries(self, webhook_id: str, limit: int = 50) -> DeliveryList:
        return self._get(f"/v1/webhooks/{part(webhook_id)}/deliveries", {"limit": limit})

    def ping_webhook(self, webhook_id: str) -> Any:
        return self._send("POST", f"/v1/webhooks/{part(webhook_id)}/ping")

    # Catalogs, and the service itself.

    def people(self) -> Any:
        return self._get("/v1/people")

    def airframes(self) -> Any:
        return self._get("/v1/airframes")

    def policies(self) -> Any:
        return self._get("/v1/policies")

    def formats(self) -> Any:
        return self._get("/v1/formats")

    def schema(self) -> Any:
        """The JSON Schema of a job."""
        return self._get("/v1/schema")

    def schemas(self) -> Any:
        """The kinds of files that have a JSON Schema."""
        return self._get("/v1/schemas")

    def file_schema(self, name: str) -> Any:
        """The JSON Schema of a kind of file, such as blueprint."""
        return self._get(f"/v1/schemas/{path_of(name)}")

    def session(self) -> Session:
        """Whether the service needs a key, and the scope of this client's."""
        return self._get("/v1/session")

    def may_submit(self) -> bool:
        """Whether this client may send jobs, by its key's scope."""
        try:
            self._bytes("/v1/access/submit")
        except AccessError:
            return False
        return True

    def version(self) -> str:
        return str(self._get("/v1/version")["version"])

    def openapi(self) -> Any:
        return self._get("/openapi.json")

    def drain(self) -> None:
        """Has the service end once its running tasks have finished (administrators); jobs go on at its next start."""
        self._send("POST", "/v1/service/drain")

    def prometheus(self) -> str:
        """Figures of the service in Prometheus' text format."""
        return self._bytes("/metrics").decode("utf-8")

    def is_alive(self) -> bool:
        """Whether the service answers at all; never raises for one that does not."""
        try:
            with self._http.open("GET", "/healthz") as response:
                return response.status == 200
        except BROKEN:
            return False

    def is_ready(self) -> bool:
        """Whether jobs can be taken in and worked on."""
        try:
            with self._http.open("GET", "/readyz") as response:
                return response.status == 200
        except BROKEN:
            return False

    def _get(self, path: str, query: Mapping[str, Any] | None = None) -> Any:
        return self._http.request("GET", path, query=query).json()

    def _bytes(self, path: str, query: Mapping[str, Any] | None = None) -> bytes:
        return self._http.request("GET", path, query=query).body

    def _send(self, method: str, path: str, body: Any = None, *, repeatable: bool = False) -> Any:
        return self._http.request(method, path, json_body=body, repeatable=repeatable).json()

    def _cancel(self, path: str) -> Any:
        """Ends the job or study, or returns it as it is where it has ended already."""
        try:
            return self._send("POST", path)
        except ConflictError:
            ended = self._get(path.removesuffix("/cancel"))
            if ended["state"] not in _events.ENDED:
                raise
            return ended

    def _remove(self, path: str) -> None:
        self._http.request("DELETE", path, repeatable=False)


def why(job: Mapping[str, Any]) -> str:
    error = job.get("error") or {}
    lines = [
        f"{job['name']} ({job['id']}) {'was cancelled' if job['state'] == 'cancelled' else 'failed'}"
        + (f": {error.get('message')}" if error.get("message") else "")
    ]
    lines += ["  " + str(problem.get("message")) for problem in error.get("problems") or []]
    return "\n".join(lines)
