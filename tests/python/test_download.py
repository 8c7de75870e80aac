"""Downloads and their files: no service but a small one of this test's own."""

import http.server
import pathlib
import tempfile
import threading
import time
import unittest

import common
import throng
from throng import Client

ARCHIVE = b"an archive" * 1000


class Archive(http.server.BaseHTTPRequestHandler):
    def do_HEAD(self):
        self.answer()

    def do_GET(self):
        self.answer()
        self.wfile.write(ARCHIVE)

    def answer(self):
        self.server.requests += 1
        self.send_response(200)
        self.send_header("Content-Length", str(len(ARCHIVE)))
        self.send_header("Content-Disposition", 'attachment; filename="job.tar"')
        self.send_header("ETag", '"1"')
        self.end_headers()

    def log_message(self, *_):
        pass


class Downloads(unittest.TestCase):
    def setUp(self):
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Archive)
        self.server.requests = 0
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)
        self.url = f"http://127.0.0.1:{self.server.server_port}"
        self.client = Client(self.url)
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def download(self, path, **more):
        return self.client.download("j1", path, progress=False, verify=False, **more)

    def refused(self, expected, path, **more):
        with self.assertRaisesRegex(throng.OutputFileError, expected):
            self.download(path, **more)

    def test_a_missing_folder_is_named_before_anything_is_sent(self):
        self.refused("missing: found no such folder, expected one for x.tar", self.folder / "missing/x.tar")
        self.assertEqual(self.server.requests, 0)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_file_in_place_of_the_folder_is_named(self):
        (self.folder / "file").write_text("mine")
        self.refused("file: found no such folder", self.folder / "file/x.tar")

    def test_files_of_others_are_not_written_over(self):
        mine = self.folder / "job.tar"
        mine.write_text("mine")
        for path in (mine, self.folder):
            self.refused("job.tar: found a file that is there already, expected a new one, or overwrite=True", path)
        self.assertEqual(mine.read_text(), "mine")
        self.assertEqual(self.download(mine, overwrite=True).read_bytes(), ARCHIVE)

    def test_a_part_of_others_is_not_written_over(self):
        part = self.folder / "new.tar.part"
        part.write_text("mine")
        self.refused("new.tar.part: found a file that is there already", self.folder / "new.tar")
        self.assertEqual(part.read_text(), "mine")

    def test_a_file_that_cannot_be_written_is_no_fault_of_the_connection(self):
        (self.folder / "x.tar.part.json").mkdir()
        begin = time.monotonic()
        self.refused("x.tar.part.json: cannot be written: Is a directory", self.folder / "x.tar")
        self.assertLess(time.monotonic() - begin, self.client._http.patience_s / 2)

    def test_a_service_that_is_not_there_is_said_at_once(self):
        self.server.shutdown()
        self.server.server_close()
        client = Client(self.url)
        for call in (lambda: next(client.jobs()), lambda: client.download("j1", self.folder / "x.tar", progress=False)):
            begin = time.monotonic()
            with self.assertRaisesRegex(throng.ConnectionFailedError, "refused: is the service running"):
                call()
            self.assertLess(time.monotonic() - begin, client._http.patience_s / 2)

    def test_a_service_that_has_answered_is_tried_again_and_says_so(self):
        self.client._http.patience_s = 0.3
        self.client._http.request("GET", "/")
        self.server.shutdown()
        self.server.server_close()
        with self.assertLogs("throng", "WARNING") as logged, self.assertRaises(throng.ConnectionFailedError):
            next(self.client.jobs())
        self.assertIn("trying again for at most 0.3 s", logged.output[0])


common.main()
