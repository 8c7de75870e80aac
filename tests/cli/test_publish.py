"""Datasets go up to an object store: whole, resumed after kills without sending again what is there, with faults of the network
and of the store, never over what others have put there; and credentials are seen by nobody but the process that sends.

usage: test_publish.py THRONG [unittest's arguments]
"""
import contextlib
import hashlib
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import threading
import unittest
import urllib.error
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from object_store import KEY_ID, SECRET, ObjectStore, error  # noqa: E402
from program import THRONG, FolderTest, throng, write_json  # noqa: E402
from service import ask, send, start_service, wait_until  # noqa: E402


PART_BYTES = 8 << 20
JOB = {
    "name": "small",
    "drones": [],
    "scenario": "city_square/nearest_exit",
    "crowd": {"agents": 5},
    "capture": {"to_s": 1},
}


def write_dataset(folder, small=12, large_bytes=0, seed=1):
    """A dataset as its manifest describes it: small files, and one that takes several parts."""
    folder = pathlib.Path(folder)
    numbers = random.Random(seed)
    files = {f"images/run000/d1/{i:06}.jpg": numbers.randbytes(2000 + i) for i in range(small)}
    files["exits/run000.csv"] = b""
    if large_bytes:
        files["formats/all.tar"] = numbers.randbytes(large_bytes)
    listed = []
    for name, content in sorted(files.items()):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
        listed.append({"path": name, "bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()})
    (folder / "manifest.json").write_text(json.dumps({"files": listed}))
    return folder


def files_of(folder, prefix=""):
    folder = pathlib.Path(folder)
    return {prefix + str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class Publishing(FolderTest):
    def setUp(self):
        super().setUp()
        self.store = self.enterContext(ObjectStore(self.folder / "store"))
        self.environment = self.clean_environment()

    def tearDown(self):
        self.assertEqual(self.store.wrong, [], "requests with wrong signatures or checksums")

    def clean_environment(self, **more):
        """Without credentials of whoever runs the test."""
        own = {name: value for name, value in os.environ.items() if not name.startswith("AWS_")}
        return {**own, "HOME": str(self.folder), **self.store.environment, **more}

    def throng(self, *words, code=0, **more):
        done = throng(*words, env={**self.environment, **more}, code=code)
        self.assert_secret(done.stdout + done.stderr)
        return done

    def assert_secret(self, text):
        for word in (SECRET, KEY_ID):
            self.assertNotIn(word, text)

    def kill_at(self, dataset, address, is_it_time):
        """Publishes until is_it_time(request), then kills the program; that request is lost."""
        process = subprocess.Popen(
            [THRONG, "publish", dataset, address], env=self.environment, stderr=subprocess.DEVNULL
        )
        self.store.fault = self.killing(process, is_it_time)
        self.assertEqual(process.wait(), -signal.SIGKILL)
        self.settle()

    @staticmethod
    def killing(process, is_it_time):
        """A fault that kills a process once it is time; this and all further requests are lost."""
        is_killed = threading.Event()

        def fault(request):
            if is_killed.is_set() or is_it_time(request):
                is_killed.set()
                process.kill()
                return "drop"
            return None

        return fault

    def settle(self):
        """Waits until requests of a process that was killed have had their effect, and forgets them."""
        wait_until(lambda: self.store.busy == 0)
        self.store.forget()

    def test_a_dataset_is_there_byte_by_byte_and_the_manifest_comes_last(self):
        dataset = write_dataset(self.folder / "dataset", large_bytes=2 * PART_BYTES + 5)
        done = self.throng("publish", dataset, "s3://data/some/day=1/set")
        expected = files_of(dataset, "some/day=1/set/")
        self.assertEqual(self.store.objects(), expected)
        size = sum(map(len, expected.values()))
        self.assertEqual(done.stdout, f"s3://data/some/day=1/set: {len(expected)} objects, {size} bytes\n")
        self.assertEqual(self.store.requests[-1]["key"], "some/day=1/set/manifest.json")
        listing = self.store.requests[-3]
        self.assertEqual(listing["query"], {"list-type": "2", "prefix": "some/day=1/set/"})
        parts = [request["bytes"] for request in self.store.sent() if "partNumber" in request["query"]]
        self.assertEqual(sorted(parts), [5, PART_BYTES, PART_BYTES])

        self.store.forget()
        self.assertEqual(self.throng("publish", dataset, "s3://data/some/day=1/set/").stdout, done.stdout)
        self.assertEqual(self.store.sent("PUT") + self.store.sent("POST"), [])

    def test_many_files_are_listed_page_by_page(self):
        dataset = write_dataset(self.folder / "dataset", small=1100)
        self.throng("publish", dataset, "s3://data/set")
        self.assertEqual(len(self.store.objects()), 1102)
        self.assertTrue([one for one in self.store.requests if "continuation-token" in one["query"]])
        self.store.forget()
        self.throng("publish", dataset, "s3://data/set")
        self.assertEqual(self.store.sent(), [])

    def test_credentials_and_endpoint_from_files(self):
        dataset = write_dataset(self.folder / "dataset", small=1)
        credentials = self.folder / "credentials"
        credentials.write_text(
            f"[default]\naws_access_key_id = nobody\n\n[mine]\naws_access_key_id = {KEY_ID}\n"
            f"aws_secret_access_key = {SECRET}\n"
        )
        (self.folder / ".aws").mkdir()
        endpoint = self.environment.pop("AWS_ENDPOINT_URL_S3")
        (self.folder / ".aws" / "config").write_text(f"[profile mine]\nregion=eu-north-1\nendpoint_url = {endpoint}\n")
        for name in ("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY"):
            del self.environment[name]
        done = self.throng("publish", dataset, "s3://data/set", code=3)
        self.assertIn("AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY", done.stderr)
        self.environment.update(AWS_PROFILE="mine", AWS_SHARED_CREDENTIALS_FILE=str(credentials))
        self.throng("publish", dataset, "s3://data/set")
        self.assertEqual(self.store.objects(), files_of(dataset, "set/"))

    def test_a_kill_in_the_middle_of_a_large_file(self):
        dataset = write_dataset(self.folder / "dataset", small=3, large_bytes=4 * PART_BYTES)
        parts = []

        def is_third(request):
            if "partNumber" in request["query"]:
                parts.append(request)
            # Two parts have arrived for good: the store has their checksums.
            return len(parts) > 2 and wait_until(lambda: len(list(self.store.uploads()[0].glob("*.md5"))) > 1)

        self.kill_at(dataset, "s3://data/set", is_third)
        self.assertNotIn("set/manifest.json", self.store.objects())
        there = {int(part.stem) for part in self.store.uploads()[0].glob("*.md5")}
        self.throng("publish", dataset, "s3://data/set")
        sent = {int(part["query"]["partNumber"]) for part in self.store.sent() if "partNumber" in part["query"]}
        self.assertEqual(sent, {1, 2, 3, 4} - there)
        self.assertEqual(self.store.objects(), files_of(dataset, "set/"))
        self.assertEqual(self.store.uploads(), [])

    def test_a_kill_in_the_middle_of_many_files(self):
        dataset = write_dataset(self.folder / "dataset", small=60)
        self.kill_at(dataset, "s3://data/set", lambda _: len(self.store.objects()) > 20)
        there = set(self.store.objects())
        self.assertGreater(len(there), 20)
        self.assertNotIn("set/manifest.json", there)
        self.throng("publish", dataset, "s3://data/set")
        self.assertEqual({request["key"] for request in self.store.sent()}, set(files_of(dataset, "set/")) - there)
        self.assertEqual(self.store.objects(), files_of(dataset, "set/"))

    def test_an_interruption_ends_cleanly(self):
        dataset = write_dataset(self.folder / "dataset", small=60)
        process = subprocess.Popen(
            [THRONG, "publish", dataset, "s3://data/set"], env=self.environment, stderr=subprocess.PIPE, text=True
        )
        signals = [signal.SIGINT]  # a second one would end it at once

        def interrupt(request):
            if request["method"] == "PUT" and signals:
                process.send_signal(signals.pop())

        self.store.fault = interrupt
        self.assertIn("cancelled", process.communicate()[1])
        self.assertEqual(process.returncode, 130)
        self.store.forget()
        self.throng("publish", dataset, "s3://data/set")
        self.assertEqual(self.store.objects(), files_of(dataset, "set/"))

    def test_faults_of_the_network_and_the_store(self):
        dataset = write_dataset(self.folder / "dataset", small=8, large_bytes=PART_BYTES + 1)
        for fault in ("drop", "slow_down", "corrupt", "lose_answer", "truncate"):
            with self.subTest(fault):
                seen = set()

                def once(request):
                    """The first request of each kind and object meets the fault."""
                    kind = (request["method"], request["key"], *sorted(request["query"]))
                    damages_nothing = fault == "corrupt" and (request["bytes"] == 0 or request["method"] != "PUT")
                    if kind in seen or damages_nothing or (fault == "truncate" and request["method"] == "HEAD"):
                        return None
                    seen.add(kind)
                    return fault

                self.store.fault = once
                self.throng("publish", dataset, f"s3://data/{fault}")
                self.store.forget()
                found = {key: value for key, value in self.store.objects().items() if key.startswith(fault + "/")}
                self.assertEqual(found, files_of(dataset, fault + "/"))
                self.assertEqual(self.store.uploads(), [])

    def test_an_upload_that_the_store_completes_with_an_error(self):
        dataset = write_dataset(self.folder / "dataset", small=1, large_bytes=PART_BYTES + 1)
        answers = [(200, error("InternalError"), ()), (200, b" \n" + error("InternalError"), ())]
        original = self.store.own_answer

        def own_answer(request):
            if request["method"] == "POST" and "uploadId" in request["query"] and answers:
                return answers.pop()
            return original(request)

        self.store.own_answer = own_answer
        self.throng("publish", dataset, "s3://data/set")
        self.assertEqual(answers, [])
        self.assertEqual(self.store.objects(), files_of(dataset, "set/"))

    def test_without_a_listing_that_shows_all_there_is_no_manifest(self):
        dataset = write_dataset(self.folder / "dataset", small=3)
        original = self.store.own_answer

        def own_answer(request):
            if "list-type" in request["query"]:
                return 200, b"<ListBucketResult><IsTruncated>false</IsTruncated></ListBucketResult>", ()
            return original(request)

        self.store.own_answer = own_answer
        done = self.throng("publish", dataset, "s3://data/set", code=3)
        self.assertIn("the listing shows 0 of 4 objects", done.stderr)
        self.assertNotIn("set/manifest.json", self.store.objects())

    def test_a_listing_without_an_end_is_refused(self):
        dataset = write_dataset(self.folder / "dataset", small=3)
        original = self.store.own_answer
        page = b"<ListBucketResult><IsTruncated>true</IsTruncated>%s</ListBucketResult>"

        def own_answer(request):
            if "list-type" in request["query"]:
                return 200, page % b"<NextContinuationToken>same</NextContinuationToken>", ()
            return original(request)

        self.store.own_answer = own_answer
        done = self.throng("publish", dataset, "s3://data/set", code=3)
        self.assertIn("goes on with the page that it just sent", done.stderr)

    def test_nothing_of_others_is_overwritten(self):
        first = write_dataset(self.folder / "first", seed=1)
        self.throng("publish", first, "s3://data/set")
        before = self.store.objects()
        self.store.forget()
        second = write_dataset(self.folder / "second", seed=2)
        done = self.throng("publish", second, "s3://data/set", code=2)
        self.assertIn("s3://data/set/manifest.json: found another dataset", done.stderr)
        self.assertEqual(self.store.sent(), [])
        # Likewise without the manifest: a dataset whose upload was broken off is somebody's, too.
        (self.store.folder / "data/set/manifest.json._S3rver_object").unlink()
        (self.store.folder / "data/set/manifest.json._S3rver_metadata.json").unlink()
        before.pop("set/manifest.json")
        done = self.throng("publish", second, "s3://data/set", code=2)
        self.assertIn("nothing is overwritten", done.stderr)
        self.assertEqual(self.store.objects(), before)

    def test_a_changed_file_does_not_go_up(self):
        dataset = write_dataset(self.folder / "dataset", small=2)
        image = dataset / "images/run000/d1/000001.jpg"
        image.write_bytes(image.read_bytes()[::-1])
        done = self.throng("publish", dataset, "s3://data/set", code=2)
        self.assertIn("000001.jpg: found a file that was changed or lost", done.stderr)
        self.assertNotIn("set/images/run000/d1/000001.jpg", self.store.objects())
        self.assertNotIn("set/manifest.json", self.store.objects())
        image.unlink()
        self.store.forget()
        self.throng("publish", dataset, "s3://data/set", code=2)
        self.assertEqual(self.store.sent(), [])
        (dataset / "manifest.json").write_text('{"files": [{"path": "../secret", "bytes": 1, "sha256": ""}]}')
        self.assertIn('found "../secret"', self.throng("publish", dataset, "s3://data/set", code=2).stderr)

    def test_refusals(self):
        dataset = write_dataset(self.folder / "dataset", small=1)
        for address in ("data/set", "s3://", "s3://UPPER/x", "s3://data//x", "s3://data/../x", "s3://data/x y"):
            self.assertIn("s3://BUCKET/PREFIX", self.throng("publish", dataset, address, code=2).stderr)
        done = self.throng("publish", dataset, f"s3://user:{SECRET}@data/x", code=2)
        self.assertIn("an address with a user or password in it", done.stderr)
        self.assertIn("no such bucket", self.throng("publish", dataset, "s3://elsewhere/x", code=2).stderr)
        self.assertIn("no manifest.json", self.throng("publish", self.folder, "s3://data/x", code=2).stderr)
        url = f"http://user:{SECRET}@127.0.0.1"
        self.throng("publish", dataset, "s3://data/x", code=2, AWS_ENDPOINT_URL_S3=url)
        self.assertEqual(self.store.sent(), [])
        requests = len(self.store.requests)
        self.store.own_answer = lambda _: (403, error("AccessDenied", f"{KEY_ID} may not"), ())
        done = self.throng("publish", dataset, "s3://data/x", code=3)
        self.assertIn("AccessDenied: *** may not", done.stderr)
        self.assertEqual(len(self.store.requests), requests + 1, "a refusal is final")

    def test_a_wrong_secret(self):
        dataset = write_dataset(self.folder / "dataset", small=1)
        done = self.throng("publish", dataset, "s3://data/x", code=3, AWS_SECRET_ACCESS_KEY="a-wrong-secret")
        self.assertIn("SignatureDoesNotMatch", done.stderr)
        self.assertNotIn("a-wrong-secret", done.stderr)
        self.assertNotIn("StringToSign", done.stderr)
        self.assertEqual(self.store.objects(), {})
        self.store.wrong.clear()

    def test_a_run_publishes_its_dataset(self):
        job = write_json(self.folder / "job.json", {**JOB, "outputs": {"publish": "s3://elsewhere/set"}})
        out = self.folder / "out"
        self.throng("run", job, "-o", out, code=2)
        self.throng("run", job, "-o", out, "--publish", "s3://data/set", code=3, AWS_SECRET_ACCESS_KEY="")
        self.assertFalse(out.exists(), "it simulates although it cannot publish")
        done = self.throng("run", job, "-o", out, "--publish", "s3://data/set")
        dataset = files_of(out / "dataset", "set/")
        self.assertIn(f"s3://data/set: {len(dataset)} objects", done.stdout)
        self.assertEqual(self.store.objects(), dataset)
        self.assertEqual(self.store.uploads(), [])
        self.assertNotIn("publish", json.loads(dataset["set/manifest.json"])["job"]["outputs"])
        # The same dataset goes elsewhere without being made again.
        made = (out / "dataset/manifest.json").stat().st_mtime_ns
        self.throng("run", job, "-o", out, "--publish", "s3://data/other")
        self.assertEqual((out / "dataset/manifest.json").stat().st_mtime_ns, made)
        self.assertEqual(json.loads((out / "published.json").read_text())["address"], "s3://data/other")
        self.assert_secret("".join(value.decode(errors="replace") for value in files_of(out).values()))
        # Nobody simulates what has no place to go.
        done = self.throng("run", job, "-o", self.folder / "again", "--publish", "s3://data/set", code=2)
        self.assertIn("s3://data/set: found a dataset", done.stderr)

    def test_the_service_publishes_where_it_may(self):
        log = open(self.folder / "log", "w+b")
        self.addCleanup(log.close)
        answers = []

        def request(port, path, body=None):
            try:
                with send(f"http://127.0.0.1:{port}{path}", body) as response:
                    answers.append(response.read().decode(errors="replace"))
                    return response.status, json.loads(answers[-1]) if path.startswith("/v1") else None
            except urllib.error.HTTPError as refusal:
                with refusal:
                    answers.append(refusal.read().decode())
                return refusal.code, json.loads(answers[-1])

        def job(address):
            return {**JOB, "outputs": {"publish": address}}

        data = self.folder / "data"
        options = ["--publish-to", "s3://data/team/a", "--publish-to", "s3://elsewhere"]
        process, port = start_service(THRONG, data, *options, env=self.environment, stdout=log, stderr=log)
        environments = []

        def look_at_environments(_request):
            for children in pathlib.Path(f"/proc/{process.pid}/task").glob("*/children"):
                for pid in [process.pid, *children.read_text().split()]:
                    with contextlib.suppress(OSError):
                        environments.append(pathlib.Path(f"/proc/{pid}/environ").read_text(errors="replace"))

        self.store.fault = look_at_environments
        try:
            for path in ("/v1/jobs", "/v1/jobs?dry_run"):
                for address in ("s3://data/team/ab", "s3://data/team", "s3://other/team/a"):
                    code, answer = request(port, path, job(address))
                    self.assertEqual((code, answer["errors"][0]["pointer"]), (400, "/outputs/publish"))
                    self.assertIn("s3://data/team/a or below", answer["errors"][0]["expected"])
            self.assertEqual(request(port, "/v1/jobs?dry_run", job("s3://data/team/a/1"))[0], 200)

            def ended(name):
                return wait_until(
                    lambda: (row := request(port, f"/v1/jobs/{name}")[1])["state"] not in ("queued", "running") and row
                )

            # Somebody else's object is in the way: the job fails, its dataset is kept.
            theirs = self.store.folder / "data/team/a/1/metrics.json._S3rver_object"
            theirs.parent.mkdir(parents=True)
            theirs.write_bytes(b"{}")
            metadata = theirs.with_name("metrics.json._S3rver_metadata.json")
            metadata.write_text("{}")
            failed = ended(request(port, "/v1/jobs", job("s3://data/team/a/1"))[1]["id"])
            self.assertEqual(failed["state"], "failed")
            self.assertIn("nothing is overwritten", failed["error"]["message"])
            with send(f"http://127.0.0.1:{port}/v1/jobs/{failed['id']}/archive") as archive:
                self.assertIn(b"manifest.json", archive.read())
            theirs.unlink()
            metadata.unlink()
            request(port, f"/v1/jobs/{failed['id']}/retry", {})
            done = ended(failed["id"])
            self.assertEqual(done["state"], "succeeded", done["error"])
            objects = self.store.objects()
            publishing = done["progress"]["publishing"]
            size = sum(map(len, objects.values()))
            self.assertEqual(
                publishing,
                {
                    "address": "s3://data/team/a/1",
                    "bytes_done": size,
                    "bytes_total": size,
                    "objects": len(objects),
                },
            )
            self.assertEqual(objects, files_of(data / "jobs" / done["id"] / "dataset", "team/a/1/"))
            missing = ended(request(port, "/v1/jobs", job("s3://elsewhere/x"))[1]["id"])
            self.assertEqual(missing["error"]["problems"][0]["found"], "no such bucket")
            self.assertFalse((data / "jobs" / missing["id"] / "work").exists(), "it simulates all the same")
        finally:
            process.send_signal(signal.SIGTERM)
            process.wait(300)
        log.seek(0)
        if os.geteuid() == 0:
            self.assertTrue(any("THRONG_SUPERVISOR_PID" in text for text in environments), "that of a worker")
        for text in (
            *environments,
            log.read().decode(),
            *answers,
            *(part.decode(errors="replace") for part in files_of(data).values()),
        ):
            self.assert_secret(text)

    def test_a_service_that_is_killed_goes_on_publishing(self):
        data = self.folder / "data"
        options = {"env": self.environment}
        process, port = start_service(THRONG, data, "--publish-to", "s3://data", **options)
        self.store.fault = self.killing(process, lambda request: len(self.store.objects()) > 1)
        job = {**JOB, "outputs": {"publish": "s3://data/set"}}
        name = ask(f"http://127.0.0.1:{port}/v1/jobs", job)["id"]
        process.wait()
        self.settle()
        there = set(self.store.objects())
        self.assertNotIn("set/manifest.json", there)
        process, port = start_service(THRONG, data, "--publish-to", "s3://data", **options)
        try:

            def state():
                return ask(f"http://127.0.0.1:{port}/v1/jobs/{name}")["state"]

            wait_until(lambda: state() != "running")
            self.assertEqual(state(), "succeeded")
        finally:
            process.send_signal(signal.SIGTERM)
            process.wait(300)
        expected = files_of(data / "jobs" / name / "dataset", "set/")
        self.assertEqual(self.store.objects(), expected)
        self.assertEqual({request["key"] for request in self.store.sent()}, set(expected) - there)

    def test_the_service_needs_credentials_and_an_address(self):
        for name in ("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY"):
            self.environment.pop(name)
        self.throng("serve", "--data", self.folder / "data", "--port", 0, "--publish-to", "s3://data", code=3)
        done = self.throng("serve", "--data", self.folder / "data", "--port", 0, "--publish-to", "data", code=2)
        self.assertIn('--publish-to: found "data"', done.stderr)


if __name__ == "__main__":
    unittest.main()
