#!/usr/bin/env python3
"""Clients that mean no good, beside an honest one and a job that runs: at the bare port and through nginx.

usage: bench/hostile.py build/release/cli/throng [--clients 100] [--seconds 30]

Prints, for each of both routes, what an honest client waited for GET /v1/version (ms), the server's memory before, at most
and after, and whether the job made the bytes that it makes undisturbed. tests/cli/test_front.py runs a small one.
"""
import argparse
import dataclasses
import hashlib
import json
import os
import pathlib
import random
import shutil
import socket
import ssl
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request
import uuid

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "cli"))
from free_ports import free_ports  # noqa: E402
from service import start_service, wait_until  # noqa: E402

JOB = {
    "name": "hostile",
    "scenario": "city_square/nearest_exit",
    "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"width": 160, "height": 120, "pitch_deg": -60}}],
    "capture": {"rate_hz": 1, "from_s": 1, "to_s": 4},
}


class Throng:
    """A server of its own in a folder, with an administrator's key."""

    def __init__(self, program, folder):
        self.folder = pathlib.Path(folder)
        data = str(self.folder / "data")
        self.key = subprocess.run(
            [program, "keys", "create", "me", "--data", data, "--scope", "admin"],
            check=True,
            capture_output=True,
            encoding="utf-8",
        ).stdout.split()[-1]
        self.process, self.port = start_service(program, data, "--workers", "1")

    def resident_mb(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text(encoding="utf-8").splitlines():
            if line.startswith("VmRSS"):
                return int(line.split()[1]) / 1024
        return 0

    def stop(self):
        self.process.terminate()
        self.process.wait(120)


class Nginx:
    """docker/nginx.conf as it is, on other ports and with a certificate for this test. `changes` are (before, after)."""

    def __init__(self, folder, throng_port, changes=()):
        folder = pathlib.Path(folder)
        self.changes = changes
        tls = folder / "tls"
        subprocess.run(
            [ROOT / "docker" / "make_certificate.sh", tls, "localhost"], check=True, stdout=subprocess.DEVNULL
        )
        self.context = ssl.create_default_context(cafile=tls / "tls.crt")
        # It cannot be asked to choose its ports: another program may take one before it does.
        for attempts_left in (2, 1, 0):
            self.start(folder, tls, throng_port)
            try:
                wait_until(self.answers)
                return
            except RuntimeError:
                error = (folder / "error.log").read_text(encoding="utf-8") if (folder / "error.log").exists() else ""
                if not attempts_left or "Address already in use" not in error:
                    raise

    def start(self, folder, tls, throng_port):
        self.port, self.plain_port = free_ports(2)
        text = (ROOT / "docker" / "nginx.conf").read_text(encoding="utf-8")
        for before, after in (
            ("listen 8080;", f"listen 127.0.0.1:{self.plain_port};"),
            ("listen 8443 ssl", f"listen 127.0.0.1:{self.port} ssl"),
            ("server throng:8080", f"server 127.0.0.1:{throng_port}"),
            ("/etc/throng-tls", str(tls)),
            ("/tmp/nginx", str(folder / "nginx")),
            ("access_log /dev/stdout", f"access_log {folder}/access.log"),
            ("error_log stderr", f"error_log {folder}/error.log"),
            *self.changes,
        ):
            if before not in text:
                raise RuntimeError(f"docker/nginx.conf has no {before}")
            text = text.replace(before, after)
        conf = folder / "nginx.conf"
        conf.write_text(text, encoding="utf-8")
        # As root its workers would be nobody, who may not enter this folder.
        settings = "daemon off;" + (" user root;" if os.geteuid() == 0 else "")
        self.process = subprocess.Popen(
            [nginx_program(), "-c", conf, "-p", folder, "-g", settings], stderr=subprocess.DEVNULL
        )

    def answers(self):
        if self.process.poll() is not None:
            raise RuntimeError("nginx has ended")
        try:  # by its certificate: another program may have taken the port
            client = socket.create_connection(("127.0.0.1", self.port), 10)
            self.context.wrap_socket(client, server_hostname="localhost").close()
            return True
        except OSError:
            return False

    def stop(self):
        self.process.terminate()
        self.process.wait(120)


def nginx_program():
    return shutil.which("nginx", path=os.environ.get("PATH", "") + ":/usr/sbin")


@dataclasses.dataclass
class Front:
    """Address that clients connect to: the bare port, or nginx's."""

    port: int
    key: str
    context: ssl.SSLContext = None

    def request(self, path, body=None, method=None, headers=None, timeout=60):
        scheme = "https" if self.context else "http"
        name = "localhost" if self.context else "127.0.0.1"
        request = urllib.request.Request(
            f"{scheme}://{name}:{self.port}{path}",
            data=body,
            method=method,
            headers={"Authorization": f"Bearer {self.key}", **(headers or {})},
        )
        with urllib.request.urlopen(request, timeout=timeout, context=self.context) as answer:
            return answer.read()

    def request_patiently(self, path, body=None, headers=None, seconds=300):
        """Asks again while the connection breaks or the service is busy."""
        end = time.monotonic() + seconds
        while True:
            try:
                return self.request(path, body, headers=headers)
            except OSError as error:
                if getattr(error, "code", 503) not in (429, 503) or time.monotonic() > end:
                    raise
            time.sleep(0.3)

    def run_job(self):
        """Runs the job to its end; returns its images' and labels' bytes as one hash."""
        headers = {"Content-Type": "application/json", "Idempotency-Key": uuid.uuid4().hex}
        job = json.loads(self.request_patiently("/v1/jobs", json.dumps(JOB).encode(), headers))
        state = ""
        while state not in ("succeeded", "failed", "cancelled"):
            time.sleep(0.3)
            state = json.loads(self.request_patiently(f"/v1/jobs/{job['id']}"))["state"]
        if state != "succeeded":
            raise RuntimeError(f"the job {state}")
        manifest = json.loads(self.request_patiently(f"/v1/jobs/{job['id']}/manifest"))
        files = sorted((entry["path"], entry["sha256"]) for entry in manifest["files"])
        return hashlib.sha256(json.dumps(files).encode()).hexdigest()


class Hostile(threading.Thread):
    """One client that is rude in one way, again and again, from an address of its own."""

    KINDS = ("garbage", "half_open", "slow_headers", "slow_body", "endless_headers", "endless_body")

    def __init__(self, number, front, stop):
        super().__init__(daemon=True)
        self.kind = self.KINDS[number % len(self.KINDS)]
        self.address = f"127.0.{1 + number // 200}.{1 + number % 200}"
        self.front = front
        self.stop = stop
        self.random = random.Random(number)
        self.connections = 0

    def run(self):
        while not self.stop.is_set():
            try:
                with self.connect() as client:
                    self.connections += 1
                    getattr(self, self.kind)(client)
            except OSError:
                pass
            self.stop.wait(0.05)

    def connect(self):
        client = socket.create_connection(("127.0.0.1", self.front.port), 5, source_address=(self.address, 0))
        if self.front.context and self.kind not in ("garbage", "half_open"):
            client = self.front.context.wrap_socket(client, server_hostname="localhost")
        client.settimeout(15)
        return client

    def send_for_ever(self, client, piece, pause_s):
        while not self.stop.is_set():
            client.sendall(piece)
            self.stop.wait(pause_s)

    def garbage(self, client):
        client.sendall(self.random.randbytes(20_000))
        client.recv(1000)

    def half_open(self, client):
        client.recv(1000)

    def slow_headers(self, client):
        client.sendall(b"GET /v1/version HTTP/1.1\r\nHost: localhost\r\nX: ")
        self.send_for_ever(client, b"x", 0.5)

    def slow_body(self, client):
        client.sendall(
            b"POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
            b"Content-Length: 1000000\r\n\r\n"
        )
        self.send_for_ever(client, b" ", 0.5)

    def endless_headers(self, client):
        client.sendall(b"GET /v1/version HTTP/1.1\r\nHost: localhost\r\n")
        self.send_for_ever(client, b"X: " + b"y" * 4000 + b"\r\n", 0.005)

    def endless_body(self, client):
        client.sendall(
            b"POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
            b"Transfer-Encoding: chunked\r\n\r\n"
        )
        self.send_for_ever(client, b"10000\r\n" + b"z" * 0x10000 + b"\r\n", 0.01)


@dataclasses.dataclass
class Figures:
    waits_ms: list
    refused: int
    memory_mb: tuple  # before, at most, after
    job_hash: str
    connections: int
    recovered_ms: float


def attack(throng, front, clients, seconds):
    """Hostile clients for so long, or until the job that runs meanwhile has ended."""
    stop = threading.Event()
    crowd = [Hostile(i, front, stop) for i in range(clients)]
    before = throng.resident_mb()
    most = before
    for client in crowd:
        client.start()
    wait_until(lambda: sum(client.connections for client in crowd) >= clients)
    result = {}
    job = threading.Thread(target=lambda: result.update(hash=front.run_job()), daemon=True)
    job.start()
    waits, refused = [], 0
    end = time.monotonic() + seconds
    while time.monotonic() < end or job.is_alive():
        began = time.monotonic()
        try:
            front.request("/v1/version")
            waits.append((time.monotonic() - began) * 1000)
        except OSError:
            refused += 1
        most = max(most, throng.resident_mb())
        time.sleep(0.1)
    stop.set()
    began = time.monotonic()
    front.request("/v1/version")
    recovered = (time.monotonic() - began) * 1000
    for client in crowd:
        client.join(20)
    return Figures(
        waits,
        refused,
        (before, most, throng.resident_mb()),
        result.get("hash", ""),
        sum(client.connections for client in crowd),
        recovered,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("throng")
    parser.add_argument("--clients", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=30)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        throng = Throng(options.throng, folder)
        ways = {"bare port": Front(throng.port, throng.key)}
        nginx = Nginx(folder, throng.port) if nginx_program() else None
        if nginx:
            ways["nginx"] = Front(nginx.port, throng.key, nginx.context)
        undisturbed = ways["bare port"].run_job()
        for name, front in ways.items():
            found = attack(throng, front, options.clients, options.seconds)
            waits = sorted(found.waits_ms)
            before, most, after = found.memory_mb
            print(
                f"{name}: {options.clients} hostile clients, {found.connections} connections; honest GET: "
                f"{len(waits)} answered, {found.refused} not, median {waits[len(waits) // 2]:.0f} ms, "
                f"worst {waits[-1]:.0f} ms; memory {before:.0f} MB, at most {most:.0f}, after {after:.0f}; "
                f"job {'as undisturbed' if found.job_hash == undisturbed else 'DIFFERS'}"
            )
        if nginx:
            nginx.stop()
        throng.stop()


if __name__ == "__main__":
    main()
