#!/usr/bin/python3
"""Load test of the service, beside nginx and an Express server on the same machine. Needs wrk; nginx and node where they are
to be compared with. Run it with nothing else at work:

    bench/load.py [--throng build/release/cli/throng] [--minutes 10] [PART...]

Parts: status (jobs asked for by 64 connections, without and beside two workers that draw), submit (10 000 submissions, a
list of 1 000), archive (1 GiB), streams (64 event streams for 10 minutes beside normal traffic). Default: all.
"""
import argparse
import concurrent.futures
import hashlib
import http.client
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
JOB = {
    "scenario": "city_square/nearest_exit",
    "outputs": {"annotations": ["coco"]},
    "drones": [{"id": "d1", "start": [-24, -6, 20], "camera": {"width": 640, "height": 360, "pitch_deg": -60}}],
}
GIB = 1 << 30


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Server:
    def __init__(self, throng, folder, faults=None):
        self.data = pathlib.Path(folder) / "data"
        self.port = free_port()
        environment = dict(os.environ)
        if faults:
            environment["THRONG_FAULTS"] = faults
        self.process = subprocess.Popen(
            [throng, "serve", "--data", self.data, "--port", str(self.port)],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment,
        )
        self.process.stdout.readline()
        self.local = threading.local()

    def ask(self, method, path, body=None, headers=()):
        """On a connection of this thread's own that is kept."""
        data = None if body is None else json.dumps(body)
        for attempt in (1, 2):
            if getattr(self.local, "connection", None) is None:
                self.local.connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
                self.local.connection.connect()
                self.local.connection.sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            try:
                self.local.connection.request(method, path, data, {"Content-Type": "application/json", **dict(headers)})
                answer = self.local.connection.getresponse()
                return answer.status, answer.read()
            except (http.client.HTTPException, OSError):
                self.local.connection = None
                if attempt == 2:
                    raise

    def job(self, job):
        status, body = self.ask("POST", "/v1/jobs", job)
        assert status == 201, body
        return json.loads(body)["id"]

    def state(self, job):
        return json.loads(self.ask("GET", f"/v1/jobs/{job}")[1])["state"]

    def memory_mib(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text(encoding="utf-8").splitlines():
            if line.startswith("VmRSS"):
                return int(line.split()[1]) / 1024
        return 0

    def stop(self):
        self.process.terminate()
        self.process.wait(30)


def wrk(url, seconds=10, connections=64):
    if not shutil.which("wrk"):
        return "wrk is not there"
    out = subprocess.run(
        ["wrk", "-t2", f"-c{connections}", f"-d{seconds}s", "--latency", url], capture_output=True, encoding="utf-8"
    ).stdout
    rate = re.search(r"Requests/sec:\s*([\d.]+)", out)
    p99 = re.search(r"99%\s*([\d.]+\w+)", out)
    bad = re.search(r"Non-2xx.*", out)
    return f"{float(rate[1]):9.0f} requests/s, p99 {p99[1]}" + (f"  {bad[0]}" if bad else "")


class Nginx:
    """Answers a status-like text and serves a file, with two workers as Debian configures it."""

    def __init__(self, folder, text, root):
        self.port = free_port()
        self.folder = pathlib.Path(folder)
        (self.folder / "nginx.conf").write_text(
            f"""
worker_processes 2; error_log {folder}/error.log; pid {folder}/nginx.pid;
events {{ worker_connections 1024; }}
http {{ access_log off; sendfile on; tcp_nopush on; keepalive_requests 1000000;
  client_body_temp_path {folder}/b; proxy_temp_path {folder}/p; fastcgi_temp_path {folder}/f; uwsgi_temp_path {folder}/u;
  scgi_temp_path {folder}/s;
  server {{ listen 127.0.0.1:{self.port}; root {root};
    location = /status {{ default_type application/json; return 200 '{text}'; }} }} }}
""",
            encoding="utf-8",
        )
        self.process = subprocess.Popen(
            ["nginx", "-c", self.folder / "nginx.conf", "-g", "daemon off;"], stderr=subprocess.DEVNULL
        )
        time.sleep(0.5)

    def stop(self):
        self.process.terminate()
        self.process.wait()


class Express:
    SCRIPT = """
const express = require('express'); const app = express(); app.disable('x-powered-by');
const text = JSON.parse(process.argv[3]);
app.get('/status', (request, response) => response.json(text));
app.use(express.static(process.argv[4]));
app.listen(+process.argv[2], '127.0.0.1');
"""

    def __init__(self, folder, text, root):
        self.port = free_port()
        subprocess.run(["npm", "install", "--silent", "--prefix", folder, "express@4"], check=True, capture_output=True)
        (pathlib.Path(folder) / "server.js").write_text(self.SCRIPT, encoding="utf-8")
        self.process = subprocess.Popen(["node", "server.js", str(self.port), text, str(root)], cwd=folder)
        time.sleep(1.5)

    stop = Nginx.stop


def others(text, root):
    """Those of the two that this machine has, by name."""
    for name, program, kind in (("nginx", "nginx", Nginx), ("Express", "npm", Express)):
        if not shutil.which(program):
            print(f"  {name}: not here")
            continue
        folder = tempfile.mkdtemp()
        os.chmod(folder, 0o755)
        server = kind(folder, text, root)
        try:
            yield name, server
        finally:
            server.stop()
            shutil.rmtree(folder, ignore_errors=True)


def part_status(arguments, folder):
    server = Server(arguments.throng, folder, faults="slow:*:600")
    job = server.job(JOB)
    path = f"/v1/jobs/{job}"
    text = server.ask("GET", path)[1].decode()
    print(f"status of a job ({len(text)} bytes), 64 connections, 10 s:")
    print(f"  throng:            {wrk(f'http://127.0.0.1:{server.port}{path}')}")
    server.ask("POST", f"{path}/cancel")
    server.stop()
    for name, other in others(text.replace("'", ""), folder):
        print(f"  {name + ':':<18} {wrk(f'http://127.0.0.1:{other.port}/status')}")
    server = Server(arguments.throng, pathlib.Path(folder) / "busy")
    job = server.job(dict(JOB, runs=8))
    while json.loads(server.ask("GET", f"/v1/jobs/{job}")[1])["progress"].get("frames_done", 0) < 3:
        time.sleep(0.1)
    print(f"  throng, 2 workers: {wrk(f'http://127.0.0.1:{server.port}/v1/jobs/{job}')}")
    server.ask("POST", f"/v1/jobs/{job}/cancel")
    server.stop()


def part_submit(arguments, folder):
    server = Server(arguments.throng, folder, faults="slow:*:600")
    begun = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(16) as pool:
        accepted = set(pool.map(lambda i: server.job(dict(JOB, name=f"job {i}")), range(10_000)))
    took_s = time.monotonic() - begun
    print(f"10 000 submissions by 16 clients: {took_s:.1f} s")

    def listed():
        found, after = [], ""
        while True:
            page = json.loads(server.ask("GET", "/v1/jobs?limit=500" + (f"&after={after}" if after else ""))[1])
            found += [job["id"] for job in page["jobs"]]
            after = page["next"]
            if not after:
                return found

    print(f"  lost: {len(accepted - set(listed()))}, doubled: {len(listed()) - len(set(listed()))}")
    server.process.kill()
    server.process.wait()
    again = Server(arguments.throng, folder, faults="slow:*:600")
    server = again
    print(f"  lost after SIGKILL of the server: {len(accepted - set(listed()))}")
    for limit in (50, 500):
        times = []
        for _ in range(50):
            begun = time.monotonic()
            server.ask("GET", f"/v1/jobs?limit={limit}")
            times.append(1000 * (time.monotonic() - begun))
        print(f"  page of {limit} of 10 000 queued jobs: median {sorted(times)[25]:.1f} ms, worst {max(times):.1f} ms")
    print(f"  memory of the server: {server.memory_mib():.0f} MiB")
    server.stop()


def part_archive(arguments, folder):
    server = Server(arguments.throng, folder)
    small = dict(JOB, capture={"rate_hz": 1, "from_s": 1, "to_s": 2})
    job = server.job(small)
    while server.state(job) not in ("succeeded", "failed"):
        time.sleep(0.2)
    # A file of 1 GiB more, in the dataset and its manifest.
    dataset = server.data / "jobs" / job / "dataset"
    digest, crc = hashlib.sha256(), 0
    with open(dataset / "zz_big.bin", "wb") as file:
        for i in range(1024):
            block = hashlib.sha256(str(i).encode()).digest() * (1 << 15)
            file.write(block)
            digest.update(block)
            crc = zlib.crc32(block, crc)
    manifest = json.loads((dataset / "manifest.json").read_text(encoding="utf-8"))
    manifest["files"].append({"path": "zz_big.bin", "bytes": GIB, "sha256": digest.hexdigest(), "crc32": f"{crc:08x}"})
    (dataset / "manifest.json").write_text(json.dumps(manifest), encoding="utf-8")

    def speed(url):
        rates = []
        for _ in range(5):
            out = subprocess.run(
                ["curl", "-s", "-o", "/dev/null", "-w", "%{speed_download} %{size_download}", url],
                capture_output=True,
                encoding="utf-8",
            ).stdout.split()
            assert int(out[1]) >= GIB, out
            rates.append(float(out[0]) / 1e6)
        return f"{sorted(rates)[2]:6.0f} MB/s (of 5: {min(rates):.0f} to {max(rates):.0f})"

    print("1 GiB, one client (curl):")
    base = f"http://127.0.0.1:{server.port}/v1/jobs/{job}"
    before = server.memory_mib()
    print(f"  throng, tar:       {speed(base + '/archive')}")
    print(f"  throng, zip:       {speed(base + '/archive?format=zip')}")
    print(f"  throng, the file:  {speed(base + '/files/zz_big.bin')}")
    print(f"  memory of throng: {before:.0f} MiB before, {server.memory_mib():.0f} MiB after")
    os.chmod(folder, 0o755)
    root = pathlib.Path(folder) / "root"
    root.mkdir()
    os.link(dataset / "zz_big.bin", root / "big.bin")
    for name, other in others("{}", root):
        print(f"  {name + ':':<18} {speed(f'http://127.0.0.1:{other.port}/big.bin')}")
    server.stop()


def part_streams(arguments, folder):
    server = Server(arguments.throng, folder)
    seconds = 60 * arguments.minutes
    job = server.job(dict(JOB, runs=100, name="long"))
    while server.state(job) == "queued":
        time.sleep(0.1)
    ended, events = [], [0] * 64
    stopping = threading.Event()

    def follow(i):
        with socket.create_connection(("127.0.0.1", server.port), timeout=60) as stream:
            stream.sendall(b"GET /v1/events HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\n\r\n")
            while not stopping.is_set():
                data = stream.recv(65536)
                if not data:
                    ended.append(i)
                    return
                events[i] += data.count(b"\nevent: ") + data.startswith(b"event: ")

    for i in range(64):
        threading.Thread(target=follow, args=(i,), daemon=True).start()
    time.sleep(1)
    before, begun, worst, asked = server.memory_mib(), time.monotonic(), 0, 0
    while time.monotonic() - begun < seconds:
        at = time.monotonic()
        server.ask("GET", f"/v1/jobs/{job}")
        server.ask("GET", "/v1/jobs")
        worst = max(worst, time.monotonic() - at)
        asked += 2
        if asked % 100 == 0:
            status, body = server.ask("POST", "/v1/jobs", dict(JOB, name="beside"))
            server.ask("DELETE", f"/v1/jobs/{json.loads(body)['id']}")
        time.sleep(0.05)
    stopping.set()
    print(
        f"64 event streams for {seconds / 60:.0f} min beside {asked} requests and a job at work: {len(ended)} broke off, "
        f"{min(events)} to {max(events)} events each, slowest pair of requests {1000 * worst:.0f} ms, memory "
        f"{before:.0f} -> {server.memory_mib():.0f} MiB"
    )
    server.ask("POST", f"/v1/jobs/{job}/cancel")
    server.stop()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--throng", default=str(ROOT / "build/release/cli/throng"))
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("parts", nargs="*", choices=["status", "submit", "archive", "streams", []])
    arguments = parser.parse_args()
    for part in arguments.parts or ["status", "submit", "archive", "streams"]:
        with tempfile.TemporaryDirectory() as folder:
            globals()[f"part_{part}"](arguments, folder)
        sys.stdout.flush()


if __name__ == "__main__":
    main()
