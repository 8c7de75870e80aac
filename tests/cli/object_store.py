"""An object store for tests: s3rver from npm, which checks signatures, behind a proxy of this process.

The proxy checks every request on its own, from the specification of Signature Version 4: the signature, and that the body has
the SHA-256 and the MD5 that its headers say. It notes requests, makes faults, and answers what s3rver lacks from what lies in
s3rver's folder: ListMultipartUploads, ListParts, AbortMultipartUpload, and NoSuchUpload.
"""
import base64
import contextlib
import hashlib
import hmac
import http.client
import http.server
import pathlib
import re
import shutil
import subprocess
import threading
import urllib.parse

PACKAGES = pathlib.Path(__file__).resolve().parents[2] / "build" / "web" / "node_modules"
BUCKET = "data"
KEY_ID = "AKIDTHRONG0TEST7F3A"
SECRET = "wJalr/secret+of+the+tests/9Qx"

_SERVER = """
const [packages, folder, bucket, key, secret] = process.argv.slice(1);
const S3rver = require(packages + '/@20minutes/s3rver');
require(packages + '/@20minutes/s3rver/lib/models/account').DUMMY_ACCOUNT.createKeyPair(key, secret);
new S3rver({port: 0, address: '127.0.0.1', silent: true, directory: folder, configureBuckets: [{name: bucket}]})
  .run().then((address) => console.log(address.port));
process.stdin.resume().on('end', () => process.exit());
"""


def error(code, message="of the tests"):
    return f"<Error><Code>{code}</Code><Message>{message}</Message><AWSAccessKeyId>{KEY_ID}</AWSAccessKeyId></Error>".encode()


def signature_of(method, target, headers, authorization):
    """The signature that a request should have, by the specification."""
    scope, signed = re.fullmatch(
        r"AWS4-HMAC-SHA256 Credential=[^/]+/(\S+), ?SignedHeaders=([a-z0-9;-]+), ?Signature=[0-9a-f]{64}", authorization
    ).groups()
    path, _, query = target.partition("?")
    lines = [method, path, "&".join(sorted(query.split("&"))) if query else ""]
    lines += [f"{name}:{' '.join(headers.get(name, 'nothing').split())}" for name in signed.split(";")]
    lines += ["", signed, headers["x-amz-content-sha256"]]
    canonical = hashlib.sha256("\n".join(lines).encode()).hexdigest()
    text = "\n".join(["AWS4-HMAC-SHA256", headers["x-amz-date"], scope, canonical])
    key = ("AWS4" + SECRET).encode()
    for word in scope.split("/"):
        key = hmac.new(key, word.encode(), hashlib.sha256).digest()
    return hmac.new(key, text.encode(), hashlib.sha256).hexdigest()


class _Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    store: "ObjectStore"

    def log_message(self, *_):
        pass

    def answer(self, status, body=b"", headers=()):
        self.send_response(status)
        for name, value in headers:
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def handle(self):
        try:
            super().handle()
        except ConnectionError:  # the program was killed, or stopped
            pass

    def handle_request(self):
        length = int(self.headers.get("Content-Length", 0))
        body = self.rfile.read(length)
        if len(body) < length:
            raise ConnectionError
        path, _, query = self.path.partition("?")
        values = dict(urllib.parse.parse_qsl(query, keep_blank_values=True))
        key = urllib.parse.unquote(path)[1:].partition("/")[2]
        request = {"method": self.command, "key": key, "query": values, "bytes": len(body)}
        headers = {name.lower(): value for name, value in self.headers.items()}
        self.check(headers, body)
        fault = self.store.note(request)
        if fault == "drop":
            self.close_connection = True
            return None
        if fault == "slow_down":
            return self.answer(503, error("SlowDown") if self.command != "HEAD" else b"")
        if fault == "corrupt":
            body = bytes([body[0] ^ 1]) + body[1:]
        answer = self.store.own_answer(request) or self.forward(body)
        if fault == "lose_answer":
            self.close_connection = True
            return None
        if fault == "truncate":
            self.send_response(answer[0])
            self.send_header("Content-Length", str(len(answer[1]) + 1))
            self.end_headers()
            self.wfile.write(answer[1])
            self.close_connection = True
            return None
        if self.command == "HEAD":
            self.send_response(answer[0])
            for name, value in answer[2]:
                self.send_header(name, value)
            return self.end_headers()
        return self.answer(*answer)

    def do_request(self):
        with self.store.at_work():
            self.handle_request()

    do_GET = do_HEAD = do_PUT = do_POST = do_DELETE = do_request

    def check(self, headers, body):
        wrong = self.store.wrong
        if headers.get("x-amz-content-sha256") != hashlib.sha256(body).hexdigest():
            wrong.append(f"{self.command} {self.path}: SHA-256")
        if body and headers.get("content-md5") != base64.b64encode(hashlib.md5(body).digest()).decode():
            wrong.append(f"{self.command} {self.path}: MD5")
        authorization = headers.get("authorization", "")
        if not authorization.endswith(signature_of(self.command, self.path, headers, authorization)):
            wrong.append(f"{self.command} {self.path}: signature")

    def forward(self, body):
        connection = http.client.HTTPConnection("127.0.0.1", self.store.server_port)
        connection.request(self.command, self.path, body, dict(self.headers.items()))
        response = connection.getresponse()
        text = response.read()
        kept = [
            (name, value)
            for name, value in response.getheaders()
            if name.lower() not in ("connection", "transfer-encoding", "keep-alive")
            and (name.lower() != "content-length" or self.command == "HEAD")
        ]
        connection.close()
        return response.status, text, kept


class ObjectStore:
    """Runs as long as the block `with ObjectStore(folder) as store`."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.requests = []
        self.wrong = []  # requests that were not signed, or not with the body's checksums
        self.fault = lambda request: None  # drop, slow_down, corrupt, lose_answer, truncate
        self.busy = 0  # requests that may still change something
        self._lock = threading.Lock()

    def __enter__(self):
        self.folder.mkdir(parents=True)
        # It encrypts places in listings by DES.
        command = [
            "node",
            "--openssl-legacy-provider",
            "-e",
            _SERVER,
            str(PACKAGES),
            str(self.folder),
            BUCKET,
            KEY_ID,
            SECRET,
        ]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.server_port = int(self.process.stdout.readline())
        self.proxy = http.server.ThreadingHTTPServer(("127.0.0.1", 0), type("Handler", (_Handler,), {"store": self}))
        self.proxy.daemon_threads = True
        self.thread = threading.Thread(target=self.proxy.serve_forever, args=(0.02,))
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.proxy.shutdown()
        self.thread.join()
        self.proxy.server_close()
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()

    @property
    def environment(self):
        return {
            "AWS_ACCESS_KEY_ID": KEY_ID,
            "AWS_SECRET_ACCESS_KEY": SECRET,
            "AWS_ENDPOINT_URL_S3": f"http://127.0.0.1:{self.proxy.server_port}",
        }

    def note(self, request):
        with self._lock:
            self.requests.append(request)
            return self.fault(request)

    @contextlib.contextmanager
    def at_work(self):
        with self._lock:
            self.busy += 1
        try:
            yield
        finally:
            with self._lock:
                self.busy -= 1

    def sent(self, method="PUT"):
        """Requests with a body that were sent since the last call of forget()."""
        return [request for request in self.requests if request["method"] == method]

    def forget(self):
        self.requests = []
        self.fault = lambda request: None

    def objects(self):
        """The bytes of all objects by their keys, as s3rver keeps them."""
        suffix = "._S3rver_object"
        folder = self.folder / BUCKET
        return {str(path.relative_to(folder))[: -len(suffix)]: path.read_bytes() for path in folder.rglob("*" + suffix)}

    def uploads(self):
        """Folders of uploads that were begun and not completed."""
        return sorted((self.folder / BUCKET).glob("*uploads/*"))

    def own_answer(self, request):
        """The answer to a call that s3rver lacks."""
        query = request["query"]
        if request["method"] == "GET" and "uploads" in query:
            found = [(upload, (upload / "key").read_text()) for upload in self.uploads()]
            entries = "".join(
                f"<Upload><Key>{key}</Key><UploadId>{upload.name}</UploadId></Upload>"
                for upload, key in found
                if key.startswith(query["prefix"])
            )
            return 200, f"<ListMultipartUploadsResult>{entries}</ListMultipartUploadsResult>".encode(), ()
        if "uploadId" not in query:
            return None
        upload = next((upload for upload in self.uploads() if upload.name == query["uploadId"]), None)
        if upload is None:  # s3rver has an internal error
            return 404, error("NoSuchUpload"), ()
        if request["method"] not in ("GET", "DELETE"):
            return None
        if request["method"] == "DELETE":
            shutil.rmtree(upload)
            return 204, b"", ()
        parts = sorted((int(part.stem), part) for part in upload.glob("*.md5"))
        entries = "".join(
            f"<Part><PartNumber>{number}</PartNumber><Size>{(upload / str(number)).stat().st_size}</Size>"
            f"<ETag>&quot;{part.read_text()}&quot;</ETag></Part>"
            for number, part in parts
        )
        return 200, f"<ListPartsResult>{entries}</ListPartsResult>".encode(), ()
